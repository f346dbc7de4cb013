use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context;
use clap::Args;
use trodden::math::Vec2;
use trodden::plan::Opening;
use trodden::routes::{Place, PlaceRequest, Route, RouteRequest};
use trodden::scenario::{self, Scenario};

use super::arguments::{STANDARD_OUTPUT, ScenarioArguments};
use super::inspect::Understood;
use super::print::Refused;
use super::{Common, print};

/// Write a scenario for a plan, with every default written out and explained
///
/// The openings that were found in the plan and the routes between them are written too, so that they can be edited.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden init plan.png --metres-per-pixel 0.05      to plan.toml
  trodden init plan.png --preset paper -o paper.toml
  trodden init --schema > scenario.schema.json       lets editors complete and check scenarios in this folder")]
pub struct Init {
    #[command(flatten)]
    scenario: ScenarioArguments,
    /// The file to write; - prints it [default: the plan's name with the ending .toml, beside it]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the file if it is there
    #[arg(long)]
    force: bool,
    /// Print the JSON Schema of scenarios instead: with it, editors complete and check their keys
    #[arg(long, exclusive = true)]
    schema: bool,
}

impl Init {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        if self.schema {
            print::text(&format!("{:#}\n", scenario::schema()))?;
            return Ok(ExitCode::SUCCESS);
        }
        let output = self.file();
        let mut scenario = self.scenario.scenario()?;
        if self.scenario.is_standard_input() && scenario.folder != Path::new("") {
            let message = "a scenario has to name its plan, and standard input has no name".to_string();
            return Err(Refused { message, hint: Some("save the plan to a file first".into()) }.into());
        }
        let begin = |path: &PathBuf| print::plan_file(path, self.force, &scenario.input_files());
        let file = output.as_ref().map(begin).transpose()?;
        let understood = Understood::of(&scenario, common).map_err(|error| self.scenario.explain(error))?;
        // Maps and drawings tell their own scale, drawings in another unit than pixels.
        let tells_scale = is_ros_map(&scenario.plan_path()?) || understood.plan.drawn.is_some();
        if scenario.plan.scale.is_none() && !tells_scale {
            scenario.plan.metres_per_pixel = Some(understood.plan.metres_per_pixel);
        }
        if scenario.routes.routes.is_empty() {
            scenario.routes.routes = requests(&understood);
        }
        move_to(&mut scenario, output.as_deref().and_then(Path::parent).unwrap_or(Path::new("")))?;
        let text = format!("{}{}{}", HEADER, openings(&understood), scenario.to_toml());
        let (Some(output), Some(file)) = (output, file) else {
            print::text(&text)?;
            return Ok(ExitCode::SUCCESS);
        };
        print::save(text.as_bytes(), file)?;
        if !common.quiet {
            print::line(format!("wrote {}; `trodden bake {}` bakes it", output.display(), output.display()))?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Returns the file to write, `None` for standard output.
    fn file(&self) -> Option<PathBuf> {
        let beside_plan = || match self.scenario.is_standard_input() {
            true => PathBuf::from(STANDARD_OUTPUT),
            false => self.scenario.path.clone().unwrap_or_default().with_extension("toml"),
        };
        Some(self.output.clone().unwrap_or_else(beside_plan)).filter(|path| path != Path::new(STANDARD_OUTPUT))
    }
}

const HEADER: &str = "\
#:schema scenario.schema.json
# A scenario for trodden: what is baked, and how. Every key is written out with the value that it would have anyway;
# delete what you do not want to change, and it follows the preset again. Metres are those of the plan frame: origin
# at the image's lower left, y up.
";

/// Returns a TOML comment that lists the openings by name, for use in routes.
fn openings(understood: &Understood) -> String {
    let of = |opening: &Opening| format!("\"{}\" ({:.1} m wide)", opening.name, opening.width_m());
    let names: Vec<String> = understood.plan.openings.iter().map(of).collect();
    if names.is_empty() { "\n".to_string() } else { format!("# Openings of the plan: {}\n\n", names.join(", ")) }
}

/// Returns the routes found in the plan as requests of a scenario.
fn requests(understood: &Understood) -> Vec<RouteRequest> {
    let request = |place: Place| match place {
        Place::Opening(index) => PlaceRequest::Opening(understood.plan.openings[index].name.clone()),
        Place::Area([from, to]) => PlaceRequest::Area([centimetres(from), centimetres(to)]),
    };
    let of = |route: &Route| RouteRequest {
        name: Some(route.name.clone()),
        from: request(route.start),
        to: request(route.goal),
        via: route.via.iter().map(|via| request(via.place).into()).collect(),
        share: (route.share * 1000.0).round() / 1000.0,
        arrivals: None,
    };
    // People who live in the building do so without routes.
    understood.routes.iter().filter(|route| route.life.is_none()).map(of).collect()
}

fn centimetres(p: Vec2) -> [f64; 2] {
    [p.x, p.y].map(|metres| (metres * 100.0).round() / 100.0)
}

fn is_ros_map(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("yaml") || ending.eq_ignore_ascii_case("yml"))
}

/// Makes a scenario's paths relative to another folder.
fn move_to(scenario: &mut Scenario, folder: &Path) -> anyhow::Result<()> {
    if same_folder(&scenario.folder, folder) {
        return Ok(());
    }
    let absolute = |path: PathBuf| {
        std::path::absolute(&path).with_context(|| format!("cannot make {} an absolute path", path.display()))
    };
    scenario.image = scenario.image_path().map(absolute).transpose()?;
    scenario.plan.paint = scenario.paint_path().map(absolute).transpose()?;
    scenario.motion_file = scenario.given_recording().map(|(file, _)| absolute(file)).transpose()?;
    scenario.pattern_folder = scenario.pattern_path().map(absolute).transpose()?;
    scenario.folder = folder.to_path_buf();
    Ok(())
}

fn same_folder(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| std::fs::canonicalize(if path.as_os_str().is_empty() { Path::new(".") } else { path });
    a == b || matches!((real(a), real(b)), (Ok(a), Ok(b)) if a == b)
}
