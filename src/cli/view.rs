use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use trodden::bake::{View, view};
use trodden::export::{Camera, FOV_DEG};
use trodden::look::Look;
use trodden::show::still::STILL_SIZES_PX;
use trodden::{Error, Progress, Stage};

use super::arguments::number_within;
use super::progress::Watch;
use super::{Common, print};

/// Draw a finished bake in perspective, from any place
///
/// Without a camera, from the height of eyes where there is most to see. Floor and walls are resolved from the sums that
/// the bake keeps, as finely as the picture shows them.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden view out/station                              to out/station-view.png
  trodden view out/station --birds-eye -o above.png     the whole plan from above
  trodden view out/station --camera 12.5,3,1.7,90,-5 --fov 60 --size 2560x1440
  trodden view out/station --clean -o before.png        the same without dirt

A camera is x,y,z in metres from the plan's lower left corner and above the floor, heading in degrees counter-clockwise
from the plan's +x, pitch upward in degrees. From above the walls one looks into the open rooms.")]
pub struct ViewCommand {
    /// The folder that a bake left
    #[arg(value_name = "BAKE")]
    bake: PathBuf,
    /// Where to look from: x,y,z,heading,pitch in metres and degrees
    #[arg(long, value_name = "X,Y,Z,H,P", allow_hyphen_values = true)]
    camera: Option<String>,
    /// Look at the whole plan from above
    #[arg(long, conflicts_with = "camera")]
    birds_eye: bool,
    /// Horizontal angle of view in degrees, 5 to 140 [default: 64, from above 30]
    #[arg(long, value_name = "DEG", value_parser = fov, allow_negative_numbers = true)]
    fov: Option<f64>,
    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "1920x1080", value_parser = size)]
    size: [u32; 2],
    /// Without any dirt
    #[arg(long)]
    clean: bool,
    /// Grade it with another look: TOML with the keys of a scenario's [look]
    #[arg(long, value_name = "FILE")]
    look: Option<PathBuf>,
    /// The picture to write, a PNG [default: the bake's name and -view.png]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the picture if it is there
    #[arg(long)]
    force: bool,
}

impl ViewCommand {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let view_from = View {
            camera: self.camera.as_deref().map(str::parse).transpose().map_err(Error::from)?,
            birds_eye: self.birds_eye,
            fov_deg: self.fov,
            size_px: self.size,
            clean: self.clean,
            look: self.look.as_deref().map(Look::read).transpose().map_err(Error::from)?,
        };
        let output = self.output.clone().unwrap_or_else(|| beside(&self.bake));
        let watch = Watch::new(common);
        let mut inputs: Vec<PathBuf> = print::files_of(&self.bake).into_iter().chain(self.look.clone()).collect();
        if let Some(mut look) = view_from.look.clone() {
            inputs.extend(look.images().into_iter().flatten().map(|image| image.clone()));
        }
        let file = print::plan_file(&output, self.force, &inputs)?;
        let (picture, camera) = view(&self.bake, &view_from, &watch)?;
        watch.advance(Stage::Stills, 1.0);
        print::save_picture(&picture, file)?;
        if !common.quiet {
            tell(&output, &camera)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn tell(output: &Path, camera: &Camera) -> anyhow::Result<()> {
    print::line(format!("{}: --camera {camera} --fov {}", output.display(), camera.fov_deg))
}

/// Returns a path for a picture beside the bake's folder, in which only bakes write.
fn beside(bake: &Path) -> PathBuf {
    let bake = bake.canonicalize().unwrap_or_else(|_| bake.to_path_buf());
    let mut name = bake.file_name().unwrap_or_default().to_os_string();
    name.push("-view.png");
    bake.with_file_name(name)
}

fn fov(text: &str) -> Result<f64, String> {
    number_within(text, FOV_DEG)
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let [low, high] = STILL_SIZES_PX;
    let side = |text: &str| text.trim().parse().ok().filter(|side| (low..=high).contains(side));
    let sides = text.split_once(['x', 'X']).and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| format!("two whole numbers of {low} to {high} with an x between them, such as 1920x1080"))
}
