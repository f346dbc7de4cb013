use std::path::PathBuf;
use std::process::ExitCode;

use clap::{ArgGroup, Args};
use trodden::Error;
use trodden::files::{LARGEST_IMAGE_BYTES, check_not_input, files_in, read_input};
use trodden::patterns::{
    Cause, Form, ImportEntry, ImportError, ImportOptions, ImportedPattern, PatternsError, PhotoScale, SavedPattern,
    import_picture, name_of_photo,
};

use super::{Common, arguments, print};

/// Take a stain from a photograph into a folder of patterns
///
/// The wall's own colour and the light on it are taken out: a smooth surface is fitted around the stain, and what is
/// darker than it becomes the pattern, cut out with a soft edge and brought to 10 px/cm.
#[derive(Args)]
#[command(group(ArgGroup::new("size").required(true).args(["scale", "length_cm"])))]
#[command(after_help = "\
Examples:
  trodden patterns import wall.jpg --cause hand --form palm --scale 42
  trodden patterns import scuff.jpg --cause shoe --length-cm 6.5 --rotate 12 --into my-patterns --picture seen.png
  trodden patterns import hall.jpg --cause bag --crop 1200,800,900,400 --scale 18 --name case_scrape --share 0.3

Photograph straight on, in even light, with a hand's breadth of clean wall around the stain.")]
pub struct Import {
    /// The photograph: PNG, JPEG, TIFF or BMP
    #[arg(value_name = "PHOTO")]
    photo: PathBuf,
    /// What left the stain: sole, heel, hand, arm, shoulder, bag, shoe
    #[arg(long, value_name = "CAUSE", value_parser = cause)]
    cause: Cause,
    /// What kind of stain it is: palm, drag, fingertips (hand); toe, heel_line, sole (shoe)
    #[arg(long, value_name = "FORM", value_parser = form)]
    form: Option<Form>,
    /// Pixels of the photograph per centimetre of the wall
    #[arg(long, value_name = "PX_PER_CM", allow_negative_numbers = true)]
    scale: Option<f64>,
    /// Or the length of the stain along its drag, centimetres
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    length_cm: Option<f64>,
    /// The part of the photograph to look at: left, top, width and height in pixels
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop)]
    crop: Option<[u32; 4]>,
    /// Turn it counter-clockwise, so that the drag (or the toes) point to the right
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_negative_numbers = true)]
    rotate: f64,
    /// Name of the pattern [default: that of the photograph]
    #[arg(long, value_name = "NAME")]
    name: Option<String>,
    /// How often it occurs among those of its cause [default: as often as the others on average]
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    share: Option<f64>,
    /// What it is, in words
    #[arg(long, value_name = "TEXT", default_value = "")]
    description: String,
    /// The folder; it and its patterns.toml are made if there are none
    #[arg(long, value_name = "FOLDER", default_value = "patterns")]
    into: PathBuf,
    /// Replace a pattern of this name, and the picture if it is there
    #[arg(long)]
    force: bool,
    /// Draw the photograph, its density and the pattern beside each other, as a PNG
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
}

impl Import {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let ours = |error: PatternsError| Error::from(error);
        let size = match (self.scale, self.length_cm) {
            (Some(scale), _) => PhotoScale::PxPerCm(scale),
            (None, length_cm) => PhotoScale::LengthCm(length_cm.unwrap_or(f64::NAN)),
        };
        let options =
            ImportOptions { cause: self.cause, form: self.form, size, crop: self.crop, rotate_deg: self.rotate };
        let name = self.name.clone().unwrap_or_else(|| name_of_photo(&self.photo));
        let inputs: Vec<PathBuf> = files_in(&self.into).into_iter().chain([self.photo.clone()]).collect();
        let picture = self.picture.as_ref().map(|path| print::plan_file(path, self.force, &inputs)).transpose()?;
        // With --force, an earlier pattern of this name is replaced, but never the photograph.
        check_not_input(&self.into.join(format!("{name}.png")), std::slice::from_ref(&self.photo))
            .map_err(Error::from)?;
        let bytes = read_input(&self.photo, LARGEST_IMAGE_BYTES).map_err(|error| {
            ours(ImportError::Unreadable { reason: format!("{}: {error}", self.photo.display()) }.into())
        })?;
        let import = ImportedPattern::from_photo(&bytes, &options).map_err(|error| ours(error.into()))?;
        // First, so that the picture exists even if the name is taken in the folder.
        if let Some(file) = picture {
            print::save_picture(&import_picture(&import), file)?;
        }
        let entry = ImportEntry { name, share: self.share, description: self.description.clone(), force: self.force };
        let listed = import.save(&self.into, &entry).map_err(ours)?;
        if !common.quiet {
            self.report(&import, &listed)?;
        }
        Ok(ExitCode::SUCCESS)
    }

    fn report(&self, import: &ImportedPattern, listed: &SavedPattern) -> anyhow::Result<()> {
        let [length_cm, breadth_cm] = import.stain_cm;
        let lighter = if import.lighter { ", lighter than the wall" } else { "" };
        print::line(format!(
            "found a stain of {length_cm:.1} x {breadth_cm:.1} cm at {:.1} px/cm{lighter}",
            import.px_per_cm
        ))?;
        let clean = import.peak_density / import.wall_noise.max(1e-6);
        let verdict = match clean {
            40.0.. => "clean",
            12.0.. => "fair",
            _ => "poor: even light, a closer photograph or a tighter --crop help",
        };
        print::line(format!(
            "density up to {:.2}; the wall around it is even to {:.3}: {verdict}",
            import.peak_density, import.wall_noise
        ))?;
        print::line(format!("written to {}, share {}", listed.image.display(), listed.share))?;
        if listed.of_cause == 1 {
            let (cause, file) = (import.cause.name(), listed.listing.display());
            print::line(format!("it is the only {cause} in {file}: every {cause} will look like it"))?;
        }
        if let Some(path) = &self.picture {
            print::line(format!("drawn to {}", path.display()))?;
        }
        Ok(())
    }
}

fn cause(name: &str) -> Result<Cause, String> {
    let known = Cause::ALL.map(Cause::name);
    Cause::ALL.into_iter().find(|cause| cause.name() == name).ok_or_else(|| format!("known are {}", known.join(", ")))
}

fn form(name: &str) -> Result<Form, String> {
    let known = Form::ALL.map(Form::name);
    Form::ALL.into_iter().find(|form| form.name() == name).ok_or_else(|| format!("known are {}", known.join(", ")))
}

fn crop(text: &str) -> Result<[u32; 4], String> {
    arguments::listed(text).ok_or_else(|| "four whole numbers are wanted: left,top,width,height".to_owned())
}
