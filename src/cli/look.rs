use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Subcommand, ValueEnum};
use serde::Serialize;
use trodden::Error;
use trodden::look::{FitMeasure, FitOptions, FittedLook, Look, Material};
use trodden::scenario::Preset;

use super::print::Refused;
use super::{Common, arguments, print};

/// Make looks: the settings that turn the sums of a bake into textures
#[derive(Args)]
pub struct LookCommand {
    #[command(subcommand)]
    command: LookSubcommand,
}

#[derive(Subcommand)]
enum LookSubcommand {
    Fit(Box<Fit>),
}

/// Measure a photograph of a real floor, and write the look that reproduces it
///
/// The floor between four corners is straightened; the slope of the light on it is taken out; colours of margin and lane,
/// unevenness, black marks and the line at a wall are measured. Our floor, with as many people over each spot, is resolved
/// again and again until it has the same measures. What one photograph does not tell keeps the preset's value.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden look fit hall.jpg --metres 4,3 -o hall.toml       the photograph is the floor, seen from above
  trodden look fit hall.jpg --metres 4,3 --corners 820,410 2310,395 3020,2240 150,2290 --wall upper -o hall.toml
  trodden look fit hall.jpg --metres 4,3 --clean 900,500,1040,580 --material wood --passes 5000 -o hall.toml
  trodden resolve out/station --look hall.toml              the look over a bake

Photograph in even light without the camera's shadow, from lane to quiet margin, with 100 px per metre or more.")]
struct Fit {
    /// The photograph: PNG, JPEG, TIFF or BMP
    #[arg(value_name = "PHOTO")]
    photo: PathBuf,
    /// Width and height of the rectangle of floor between the corners, metres
    #[arg(long, value_name = "W,H", value_parser = numbers::<2>)]
    metres: [f64; 2],
    /// Its upper left, upper right, lower right and lower left corner in pixels of the photograph [default: the photograph's]
    #[arg(long, value_name = "X,Y", num_args = 4, value_parser = numbers::<2>)]
    corners: Vec<[f64; 2]>,
    /// A part without any dirt: two opposite corners in pixels of the photograph [default: none]
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = numbers::<4>)]
    clean: Option<[f64; 4]>,
    /// Sides of the rectangle that stand at a wall: their dirty line is measured
    #[arg(long, value_name = "SIDE", value_delimiter = ',', num_args = 1..)]
    wall: Vec<Side>,
    /// What the floor is made of
    #[arg(long, value_name = "NAME", default_value = "vinyl", value_parser = material)]
    material: Material,
    /// How many people have walked over the lane: the look's film is that after 1000
    #[arg(long, value_name = "N", default_value = "1000", value_parser = super::resolve::passes)]
    passes: u64,
    /// What is not measured is that of this look
    #[arg(long, value_name = "NAME", default_value = "commuters", value_parser = arguments::preset())]
    preset: Preset,
    /// The look to write
    #[arg(short, long, value_name = "LOOK.toml")]
    output: PathBuf,
    /// The photograph and our floor beside each other, as a PNG [default: the look's name and _fit.png]
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Replace look and picture if they are there
    #[arg(long)]
    force: bool,
}

/// A side of the rectangle of floor, as the photograph shows it straightened.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Side {
    Upper,
    Right,
    Lower,
    Left,
}

#[derive(Serialize)]
struct Json<'a> {
    texels_per_metre: f64,
    measures: Vec<JsonMeasure<'a>>,
    look: serde_json::Value,
    kept: Vec<Kept<'a>>,
}

#[derive(Serialize)]
struct JsonMeasure<'a> {
    #[serde(flatten)]
    measure: &'a FitMeasure,
    off: f64,
}

#[derive(Serialize)]
struct Kept<'a> {
    key: &'a str,
    why: &'a str,
}

impl LookCommand {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let LookSubcommand::Fit(fit) = &self.command;
        fit.run(common)
    }
}

impl Fit {
    fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let inputs = [self.photo.clone()];
        let picture_path = self.picture.clone().unwrap_or_else(|| {
            let name = self.output.file_stem().unwrap_or_default().to_string_lossy();
            self.output.with_file_name(format!("{name}_fit.png"))
        });
        if picture_path == self.output {
            let message = format!("look and picture would be one file, {}", self.output.display());
            return Err(Refused {
                message,
                hint: Some("name the look with .toml, or the picture with --picture".into()),
            }
            .into());
        }
        let output = print::plan_file(&self.output, self.force, &inputs)?;
        let picture = print::plan_file(&picture_path, self.force, &inputs)?;
        let options = FitOptions {
            corners: <[[f64; 2]; 4]>::try_from(self.corners.clone()).ok(),
            clean: self.clean,
            walls: [Side::Upper, Side::Right, Side::Lower, Side::Left].map(|side| self.wall.contains(&side)),
            material: self.material,
            passes: self.passes as f64,
            start: Look::preset(self.preset.name()).unwrap_or_default(),
            ..FitOptions::new(self.metres)
        };
        let fitted = FittedLook::of_photo(&self.photo, &options).map_err(Error::from)?;
        print::save(fitted.toml.as_bytes(), output)?;
        print::save_picture(&fitted.picture, picture)?;
        if self.json {
            print::line(serde_json::to_string_pretty(&json(&fitted))?)?;
        } else if !common.quiet {
            table(&fitted)?;
            print::line(format!("wrote {}, drawn to {}", self.output.display(), picture_path.display()))?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn json(fitted: &FittedLook) -> Json<'_> {
    let measures = fitted.measures.iter();
    Json {
        texels_per_metre: fitted.texels_per_metre,
        measures: measures.map(|measure| JsonMeasure { measure, off: measure.ours - measure.photo }).collect(),
        look: fitted.look.settings(),
        kept: fitted.kept.iter().map(|[key, why]| Kept { key, why }).collect(),
    }
}

fn table(fitted: &FittedLook) -> anyhow::Result<()> {
    print::line(format!("at {} texels per metre", fitted.texels_per_metre))?;
    print::line(format!("{:<33} {:>8} {:>8} {:>8}", "measure", "photo", "ours", "off"))?;
    for FitMeasure { name, unit, photo, ours } in &fitted.measures {
        print::line(format!("{name:<33} {photo:>8.2} {ours:>8.2} {:>+8.2}  {unit}", ours - photo))?;
    }
    print::line("not told by one photograph, so that the preset's values stay:")?;
    fitted.kept.iter().try_for_each(|[key, why]| print::line(format!("  {key}: {why}")))
}

fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let finite = arguments::listed(text).filter(|parts: &[f64; N]| parts.iter().all(|number| number.is_finite()));
    finite.ok_or_else(|| format!("{N} numbers are wanted, with commas"))
}

fn material(name: &str) -> Result<Material, String> {
    serde_json::from_value(name.into()).map_err(|error| error.to_string().replace("variant", "material"))
}
