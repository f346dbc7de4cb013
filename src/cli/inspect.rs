use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;
use trodden::Error;
use trodden::plan::{self, FloorPlan, Opening, Region, RegionRole};
use trodden::routes::{self, Route};
use trodden::scenario::Scenario;
use trodden::show::draw_plan;
use trodden::walls::{Face, Walls};

use super::arguments::ScenarioArguments;
use super::{Common, print};

/// Show what is understood of a plan: scale, size, walls, openings, floor, routes
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden inspect plan.png --picture understood.png
  trodden inspect plan.toml --json | jq '.routes[].length_m'

In the picture walls that run from side to side of the image are blue, closed ones brown; openings are green and
named; floor is blue-grey, white that nobody reaches is hatched; routes are dashed, their gates violet.")]
pub struct Inspect {
    #[command(flatten)]
    scenario: ScenarioArguments,
    /// Print JSON: metres of the plan frame, origin at the image's lower left, y up
    #[arg(long)]
    json: bool,
    /// Draw it too, as a PNG
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    /// Replace the picture if it is there
    #[arg(long, requires = "picture")]
    force: bool,
}

/// Plan, walls and routes of a scenario.
pub struct Understood {
    pub plan: FloorPlan,
    pub walls: Walls,
    pub routes: Vec<Route>,
}

#[derive(Serialize)]
struct Json<'a> {
    width_px: u32,
    height_px: u32,
    metres_per_pixel: f64,
    width_m: f64,
    height_m: f64,
    walls: &'a [Face],
    openings: &'a [Opening],
    regions: &'a [Region],
    routes: &'a [Route],
    warnings: &'a [String],
}

impl Understood {
    /// Reads the plan, traces its walls and finds the routes.
    pub fn of(scenario: &Scenario, common: &Common) -> Result<Understood, Error> {
        let plan = plan::read(&scenario.plan_path()?, &scenario.plan_options())?;
        if !common.quiet {
            for warning in &plan.warnings {
                print::to_stderr(&print::warning(warning, common));
            }
        }
        let walls = Walls::trace(&plan, &scenario.walls);
        let routes = routes::find(&plan, &walls, &scenario.routes)?;
        Ok(Understood { plan, walls, routes })
    }
}

impl Inspect {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let scenario = self.scenario.scenario()?;
        let begin = |path: &PathBuf| print::plan_file(path, self.force, &scenario.input_files());
        let picture = self.picture.as_ref().map(begin).transpose()?;
        let understood = Understood::of(&scenario, common).map_err(|error| self.scenario.explain(error))?;
        let Understood { plan, walls, routes } = &understood;
        if self.json {
            print::line(serde_json::to_string_pretty(&Json {
                width_px: plan.width_px,
                height_px: plan.height_px,
                metres_per_pixel: plan.metres_per_pixel,
                width_m: plan.width_m(),
                height_m: plan.height_m(),
                walls: &walls.faces,
                openings: &plan.openings,
                regions: &plan.regions,
                routes,
                warnings: &plan.warnings,
            })?)?;
        } else if !common.quiet {
            self.tell(&understood)?;
        }
        if let (Some(path), Some(file)) = (&self.picture, picture) {
            print::save_picture(&draw_plan(plan, walls, routes), file)?;
            if !self.json && !common.quiet {
                print::line(format!("picture   {}", path.display()))?;
            }
        }
        Ok(ExitCode::SUCCESS)
    }

    fn tell(&self, Understood { plan, walls, routes }: &Understood) -> anyhow::Result<()> {
        print::line(format!(
            "size      {:.2} x {:.2} m: {} x {} px at {} m per pixel",
            plan.width_m(),
            plan.height_m(),
            plan.width_px,
            plan.height_px,
            plan.metres_per_pixel
        ))?;
        print::line(format!("floor     {}", regions(plan)))?;
        let length: f64 = walls.faces.iter().map(Face::length_m).sum();
        let closed = walls.faces.iter().filter(|face| face.closed).count();
        let open = walls.faces.len() - closed;
        print::line(format!("walls     {length:.1} m: {open} open and {closed} closed faces"))?;
        for (index, opening) in plan.openings.iter().enumerate() {
            let centre = opening.centre_m();
            print::line(format!(
                "{:<9} {:<12} {:6.2} m wide, around [{:.2}, {:.2}]",
                if index == 0 { "openings" } else { "" },
                opening.name,
                opening.width_m(),
                centre.x,
                centre.y
            ))?;
        }
        for (index, route) in routes.iter().enumerate() {
            print::line(format!(
                "{:<9} {:<28}  {:5.1} m, {:2.0} % of the people",
                if index == 0 { "routes" } else { "" },
                route.name,
                route.length_m,
                route.share * 100.0
            ))?;
        }
        Ok(())
    }
}

/// Describes the area of the floor and of other white regions.
fn regions(plan: &FloorPlan) -> String {
    let of = |role: RegionRole| {
        let areas = plan.regions.iter().filter(|region| region.role == role).map(|region| region.area_m2);
        (areas.clone().count(), areas.sum::<f64>())
    };
    let (floors, floor_m2) = of(RegionRole::Floor);
    let plural = if floors == 1 { "" } else { "s" };
    let mut text = format!("{floor_m2:.1} m2 in {floors} region{plural}");
    for (role, name) in [(RegionRole::Outside, "outside"), (RegionRole::Unreached, "that nobody reaches")] {
        let (count, area_m2) = of(role);
        if count > 0 {
            text.push_str(&format!(", {area_m2:.1} m2 in {count} {name}"));
        }
    }
    text
}
