use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context;
use clap::Args;
use trodden::Error;
use trodden::plan::{self, FloorPlan};
use trodden::routes;
use trodden::scenario::{self, Scenario};
use trodden::show::edit::{EditPage, edit_page_html};
use trodden::walls::Walls;

use super::arguments::ScenarioArguments;
use super::print::Refused;
use super::{Common, print};

/// Write a page on which a plan is put right by clicking: classes, scale, entrances, stops, routes
///
/// The page is one file that opens from disk in any browser, without network. Its Save downloads the scenario and the
/// paint over the plan; both belong beside the plan.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden edit plan.png                   to plan-edit.html; open it in a browser
  trodden edit plan.toml -o /tmp/p.html   goes on with a scenario

Then: click, Save, put both files beside the plan, and bake the scenario.")]
pub struct Edit {
    #[command(flatten)]
    scenario: ScenarioArguments,
    /// The page to write [default: the plan's name and -edit.html, beside it]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Replace the page if it is there
    #[arg(long)]
    force: bool,
}

impl Edit {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        if self.scenario.is_standard_input() {
            let message = "the page has to name its plan, and standard input has no name".to_string();
            return Err(Refused { message, hint: Some("save the plan to a file first".into()) }.into());
        }
        let path = self.scenario.path.clone().unwrap_or_default();
        let scenario = self.scenario.scenario()?;
        let output = self.output.clone().unwrap_or_else(|| beside(&path));
        let file = print::plan_file(&output, self.force, &scenario.input_files())?;
        let html = self.page(&path, &scenario).map_err(|error| match error.downcast::<Error>() {
            Ok(error) => self.scenario.explain(error),
            Err(error) => error,
        })?;
        print::save(html.as_bytes(), file)?;
        if !common.quiet {
            print::line(format!("wrote {}: open it in a browser", output.display()))?;
        }
        Ok(ExitCode::SUCCESS)
    }

    fn page(&self, path: &Path, scenario: &Scenario) -> anyhow::Result<String> {
        let image = scenario.plan_path().map_err(Error::from)?;
        // A plan that cannot be baked is what the page is for.
        let options = plan::PlanOptions { unfinished: true, ..scenario.plan_options() };
        let read = |options| plan::read(&image, options).map_err(Error::from);
        let plan = read(&options)?;
        let unpainted = match &options.paint {
            Some(_) => Some(read(&plan::PlanOptions { paint: None, ..options.clone() })?),
            None => None,
        };
        let picture = plan::picture(&image, &options, &plan).map_err(Error::from)?;
        let (routes, lack) = ways(&plan, scenario);
        let is_toml = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
        let read_text = || std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()));
        let toml = if is_toml { read_text()? } else { String::new() };
        let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let paint_file = scenario.plan.paint.as_ref().and_then(|paint| paint.file_name()).map(Path::new);
        let is_yaml = image.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("yaml"));
        Ok(edit_page_html(&EditPage {
            title: &stem,
            image: &scenario.name().to_string_lossy(),
            scenario_file: &format!("{stem}.toml"),
            paint_file: &paint_file.map_or_else(|| format!("{stem}-paint.png"), |name| name.display().to_string()),
            toml: &toml,
            writes_scale: !is_toml && !is_yaml,
            names_rooms: !scenario::schema()["properties"]["room"].is_null(),
            plan: &plan,
            unpainted: unpainted.as_ref(),
            picture: &picture,
            routes: &routes,
            routes_are_written: !scenario.routes.routes.is_empty(),
            lack: lack.as_deref(),
        }))
    }
}

/// The routes through a plan, or why there are none.
fn ways(plan: &FloorPlan, scenario: &Scenario) -> (Vec<routes::Route>, Option<String>) {
    if !plan.floor.contains(&1) {
        return (Vec::new(), Some("no floor was found: paint floor, walls and doors".to_string()));
    }
    let walls = Walls::trace(plan, &scenario.walls);
    match routes::find(plan, &walls, &scenario.routes) {
        Ok(routes) => (routes, None),
        Err(error) => (Vec::new(), Some(error.to_string())),
    }
}

/// A path for the page beside the plan.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_os_string();
    name.push("-edit.html");
    path.with_file_name(name)
}
