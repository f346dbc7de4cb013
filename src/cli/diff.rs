use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use trodden::Error;
use trodden::export::diff::{Comparison, DiffOptions, ImageDiff, diff};

use super::arguments::number_within;
use super::{Common, print};

/// Compare two bakes, or two images, texel by texel
///
/// Of bakes, all files are compared: images texel by texel, the rest byte by byte; only report.json may differ. Values of
/// PNG files are 0 to 1, those of EXR files as they are in the file: sums are whole numbers.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden diff out/monday out/tuesday                         the same to the bit?
  trodden diff a.png b.png --tolerance 0.02 --picture where.png
  trodden diff a b --tolerance 0.02 --share 0.001 --most 0.2  a few texels may differ, none by much

Exit codes: 0 the same, 1 different, 2 they could not be compared.")]
pub struct Diff {
    /// A bake's folder, or an image: PNG or EXR
    #[arg(value_name = "A")]
    a: PathBuf,
    /// What to compare it with
    #[arg(value_name = "B")]
    b: PathBuf,
    /// A texel differs if one of its channels differs by more
    #[arg(long, value_name = "D", default_value_t = 0.0, value_parser = not_negative, allow_negative_numbers = true)]
    tolerance: f64,
    /// Which share of the texels may differ, 0 to 1
    #[arg(long, value_name = "S", default_value_t = 0.0, value_parser = share, allow_negative_numbers = true)]
    share: f64,
    /// No texel may differ by more than this [default: no limit]
    #[arg(long, value_name = "D", value_parser = not_negative, allow_negative_numbers = true)]
    most: Option<f64>,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Draw a heat map of where they differ, as a PNG
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    /// Replace the picture if it is there
    #[arg(long, requires = "picture")]
    force: bool,
}

impl Diff {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        match self.compare(common) {
            Ok(true) => Ok(ExitCode::FAILURE),
            Ok(false) => Ok(ExitCode::SUCCESS),
            Err(error) if print::is_broken_pipe(&error) => Err(error),
            Err(error) => {
                print::failure(&error, common);
                Ok(ExitCode::from(NOT_COMPARED))
            }
        }
    }

    /// Compares the two; returns whether they differ.
    fn compare(&self, common: &Common) -> anyhow::Result<bool> {
        let options = DiffOptions {
            fail: self.tolerance,
            fail_share: self.share,
            hard_fail: self.most.unwrap_or(DiffOptions::default().hard_fail),
        };
        let inputs = [&self.a, &self.b].map(|compared| print::files_of(compared)).concat();
        let picture = self.picture.as_ref().map(|path| print::plan_file(path, self.force, &inputs)).transpose()?;
        let comparison = diff(&self.a, &self.b, &options).map_err(Error::from)?;
        if self.json {
            print::line(serde_json::to_string_pretty(&comparison)?)?;
        } else if !common.quiet {
            self.tell(&comparison)?;
        }
        if let Some(file) = picture {
            print::save_picture(&comparison.heat_map.picture(), file)?;
        }
        Ok(comparison.failed())
    }

    fn tell(&self, comparison: &Comparison) -> anyhow::Result<()> {
        for image in &comparison.images {
            print::line(sentence(image))?;
        }
        for file in &comparison.different {
            print::line(format!("{file}: different"))?;
        }
        for file in &comparison.missing {
            print::line(format!("{file}: missing in both, though a manifest lists it"))?;
        }
        for (files, folder) in [(&comparison.only_in_a, &self.a), (&comparison.only_in_b, &self.b)] {
            for file in files {
                print::line(format!("{file}: only in {}", folder.display()))?;
            }
        }
        print::line(match (comparison.failed(), comparison.largest()) {
            (true, _) => "different".to_string(),
            (false, 0.0) => "the same".to_string(),
            (false, largest) => format!("within the tolerance; at most {largest} apart"),
        })
    }
}

/// Exit code if the two cannot be compared.
const NOT_COMPARED: u8 = 2;

fn sentence(image: &ImageDiff) -> String {
    if image.largest == 0.0 {
        return format!("{}: the same", image.file);
    }
    let [x, y] = image.largest_px;
    format!(
        "{}: at most {:.4} (channel {} at pixel {x}, {y}), {:.6} in the mean; {:.3} % of the texels over the tolerance",
        image.file,
        image.largest,
        image.largest_channel,
        image.mean,
        image.share_over * 100.0
    )
}

fn not_negative(text: &str) -> Result<f64, String> {
    // This form also rejects NaN.
    text.parse().ok().filter(|number: &f64| *number >= 0.0).ok_or_else(|| "allowed are numbers from 0 on".to_string())
}

fn share(text: &str) -> Result<f64, String> {
    number_within(text, [0.0, 1.0])
}
