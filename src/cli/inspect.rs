use std::collections::BTreeMap;
use std::fmt::Debug;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;
use serde::Serialize;
use trodden::Error;
use trodden::look::Material;
use trodden::math::Vec2;
use trodden::plan::PlanClass::{self, Floor, Outside, Wall};
use trodden::plan::{self, FloorPlan, FurniturePiece, Opening, Paint, PlanScale, PlanWindow, Region, RegionRole};
use trodden::rooms::{Entrance, Life, Room, Rooms, Use};
use trodden::routes::{Navigation, Route};
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
  trodden inspect plan.png --paint over.png          to be painted over: key plan.paint reads it

In the picture walls that run from side to side of the image are blue, closed ones brown; openings are green and
named; floor is blue-grey, white that nobody reaches is hatched; routes are dashed, their gates violet. Doors, windows,
furniture and notes have colours that the legend names.")]
pub struct Inspect {
    #[command(flatten)]
    scenario: ScenarioArguments,
    /// Print JSON: metres of the plan frame, origin at the image's lower left, y up
    #[arg(long)]
    json: bool,
    /// Draw it too, as a PNG
    #[arg(long, value_name = "FILE")]
    picture: Option<PathBuf>,
    /// Write it in class colours too, as a PNG of the plan's size, to be painted over
    #[arg(long, value_name = "FILE")]
    paint: Option<PathBuf>,
    /// Replace the pictures if they are there
    #[arg(long)]
    force: bool,
}

/// Plan, walls and routes of a scenario.
pub struct Understood {
    pub plan: FloorPlan,
    pub walls: Walls,
    pub routes: Vec<Route>,
    /// Its rooms, and what it is for; `None` where people only cross it.
    pub life: Option<Arc<Life>>,
}

/// A room, and its floor.
#[derive(Serialize)]
struct RoomWithFloor<'a> {
    #[serde(flatten)]
    room: &'a Room,
    floor: Material,
}

/// A door, by its middle.
#[derive(Serialize)]
struct Door {
    at_m: Vec2,
    width_m: f64,
}

#[derive(Serialize)]
struct Json<'a> {
    width_px: u32,
    height_px: u32,
    metres_per_pixel: f64,
    scale: &'a PlanScale,
    width_m: f64,
    height_m: f64,
    walls: &'a [Face],
    openings: &'a [Opening],
    regions: &'a [Region],
    areas_m2: BTreeMap<String, f64>,
    routes: &'a [Route],
    doors: Vec<Door>,
    windows: &'a [PlanWindow],
    furniture: &'a [FurniturePiece],
    rooms: &'a [RoomWithFloor<'a>],
    entrances: &'a [Entrance],
    #[serde(rename = "use")]
    building: Option<Use>,
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
        if walls.faces.is_empty() && !common.quiet {
            let message = "no walls were found: all is floor; `[plan] threshold` sets which tones are wall";
            print::to_stderr(&print::warning(message, common));
        }
        let (routes, ways) = Navigation::find(&plan, &walls, &scenario.routes)?;
        Ok(Understood { plan, walls, routes, life: ways.life().cloned() })
    }
}

impl Inspect {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let scenario = self.scenario.scenario()?;
        let begin = |path: &PathBuf| print::plan_file(path, self.force, &scenario.input_files());
        let picture = self.picture.as_ref().map(begin).transpose()?;
        let paint = self.paint.as_ref().map(begin).transpose()?;
        let understood = Understood::of(&scenario, common).map_err(|error| self.scenario.explain(error))?;
        let Understood { plan, walls, routes, life } = &understood;
        let found;
        let rooms = match life {
            Some(life) => &life.rooms,
            None => {
                found = Rooms::find(plan, walls);
                &found
            }
        };
        let look = scenario.clone().with_floors(life.as_deref(), walls).look;
        let places: Vec<Vec2> = rooms.rooms.iter().map(|room| room.inside_m).collect();
        let floors = look.floors_at(&places, walls).map_err(Error::from)?.into_iter().map(|floor| floor.material);
        let rooms_with_floors: Vec<RoomWithFloor> =
            rooms.rooms.iter().zip(floors).map(|(room, floor)| RoomWithFloor { room, floor }).collect();
        if self.json {
            print::line(serde_json::to_string_pretty(&Json {
                width_px: plan.width_px,
                height_px: plan.height_px,
                metres_per_pixel: plan.metres_per_pixel,
                scale: &plan.scale,
                width_m: plan.width_m(),
                height_m: plan.height_m(),
                walls: &walls.faces,
                openings: &plan.openings,
                regions: &plan.regions,
                areas_m2: areas(plan).into_iter().map(|(class, area_m2)| (name(class), area_m2)).collect(),
                routes,
                doors: doors(plan),
                windows: &plan.windows,
                furniture: &plan.furniture,
                rooms: &rooms_with_floors,
                entrances: &rooms.entrances,
                building: life.as_ref().map(|life| life.r#use),
                warnings: &plan.warnings,
            })?)?;
        } else if !common.quiet {
            self.tell(&understood, &rooms_with_floors, &rooms.entrances)?;
        }
        if let (Some(path), Some(file)) = (&self.picture, picture) {
            print::save_picture(&draw_plan(plan, walls, routes), file)?;
            if !self.json && !common.quiet {
                print::line(format!("picture   {}", path.display()))?;
            }
        }
        if let (Some(path), Some(file)) = (&self.paint, paint) {
            print::save_picture(&plan.painted_picture(), file)?;
            if !self.json && !common.quiet {
                print::line(format!("paint     {}: {}", path.display(), legend()))?;
            }
        }
        Ok(ExitCode::SUCCESS)
    }

    fn tell(
        &self,
        Understood { plan, walls, routes, life }: &Understood,
        rooms: &[RoomWithFloor],
        entrances: &[Entrance],
    ) -> anyhow::Result<()> {
        print::line(format!(
            "size      {:.2} x {:.2} m: {} x {} px at {} m per pixel",
            plan.width_m(),
            plan.height_m(),
            plan.width_px,
            plan.height_px,
            plan.metres_per_pixel
        ))?;
        print::line(format!("scale     {}", scale(&plan.scale)))?;
        print::line(format!("floor     {}", regions(plan)))?;
        let rest = areas(plan).into_iter().filter(|(class, _)| !matches!(class, Outside | Floor | Wall));
        let rest: Vec<String> = rest.map(|(class, area_m2)| format!("{} {area_m2:.1} m2", name(class))).collect();
        if !rest.is_empty() {
            print::line(format!("found     {}", rest.join(", ")))?;
        }
        for line in [told_doors(plan), told_windows(plan), told_furniture(plan)].into_iter().flatten() {
            print::line(line)?;
        }
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
        tell_rooms(rooms, entrances)?;
        if let Some(life) = life {
            let how = if life.guessed { ", as far as the rooms tell" } else { "" };
            print::line(format!("use       {}{how}", life.r#use.name()))?;
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

/// Lists the rooms with area, kind, floor and doors, and the doors to the outside.
fn tell_rooms(rooms: &[RoomWithFloor], entrances: &[Entrance]) -> anyhow::Result<()> {
    let doors = entrances.iter().filter(|entrance| entrance.opening.is_none());
    for (index, door) in doors.enumerate() {
        let head = if index == 0 { "entrances" } else { "" };
        let at = door.at_m;
        print::line(format!("{head:<9} {:<12} {:6.2} m wide, at [{:.2}, {:.2}]", door.name, door.width_m, at.x, at.y))?;
    }
    for (index, RoomWithFloor { room, floor }) in rooms.iter().enumerate() {
        let head = if index == 0 { "rooms" } else { "" };
        let (area_m2, kind, doors, at) = (room.area_m2, room.kind.name(), room.doors, room.inside_m);
        let plural = if doors == 1 { "" } else { "s" };
        let door = format!("{doors} door{plural}");
        print::line(format!(
            "{head:<9} {:<12} {area_m2:6.1} m2, {kind:<8}  {:<8}  {door:<8}  around [{:.2}, {:.2}]",
            room.name,
            name(floor),
            at.x,
            at.y
        ))?;
    }
    Ok(())
}

/// Doors, as pictures and drawings show them.
fn doors(plan: &FloorPlan) -> Vec<Door> {
    let drawn = plan.drawn.iter().flat_map(|drawn| drawn.doors.iter().copied());
    let jambs = plan.doors.iter().map(|door| [door.from_m, door.to_m]).chain(drawn);
    jambs.map(|[a, b]| Door { at_m: a.lerp(b, 0.5), width_m: a.distance(b) }).collect()
}

fn told_doors(plan: &FloorPlan) -> Option<String> {
    let widths: Vec<f64> = doors(plan).iter().map(|door| door.width_m).collect();
    let (least_m, most_m) = (widths.iter().copied().reduce(f64::min)?, widths.iter().copied().reduce(f64::max)?);
    Some(format!("doors     {}, {least_m:.2} to {most_m:.2} m wide", widths.len()))
}

fn told_windows(plan: &FloorPlan) -> Option<String> {
    let length_m: f64 = plan.windows.iter().map(|window| window.from_m.distance(window.to_m)).sum();
    (!plan.windows.is_empty()).then(|| format!("windows   {}, {length_m:.1} m in all", plan.windows.len()))
}

fn told_furniture(plan: &FloorPlan) -> Option<String> {
    let mut counts = BTreeMap::new();
    plan.furniture.iter().for_each(|piece| *counts.entry(piece.class).or_insert(0usize) += 1);
    let height = |class: PlanClass| match class.height_m() {
        Some(height) => format!("{height} m high"),
        None if class == PlanClass::Stairs => "walked on".to_owned(),
        None => "to the ceiling".to_owned(),
    };
    let told = |(&class, count): (&PlanClass, &usize)| format!("{count} {} ({})", name(class), height(class));
    let told: Vec<String> = counts.iter().map(told).collect();
    (!told.is_empty()).then(|| format!("furniture {}", told.join(", ")))
}

/// The colours of the paints.
fn legend() -> String {
    let named = |paint: Paint| {
        let [r, g, b] = paint.colour();
        format!("{} #{r:02x}{g:02x}{b:02x}", paint.name())
    };
    Paint::all().map(named).collect::<Vec<_>>().join(", ")
}

/// Where the scale comes from, and how sure it is.
fn scale(scale: &PlanScale) -> String {
    let source = scale.source.name();
    if scale.sureness >= 1.0 {
        return source.to_string();
    }
    let evidence = if scale.evidence.is_empty() { String::new() } else { format!(" by {}", scale.evidence) };
    let [low, high] = scale.range;
    format!("{source}{evidence}: {:.0} % sure, {low:.4} to {high:.4} m per pixel are possible", scale.sureness * 100.0)
}

fn name(value: impl Debug) -> String {
    format!("{value:?}").to_lowercase()
}

/// Square metres of each class of the plan that there is.
fn areas(plan: &FloorPlan) -> BTreeMap<PlanClass, f64> {
    let mut counts = BTreeMap::new();
    plan.classes.iter().for_each(|&class| *counts.entry(class).or_insert(0usize) += 1);
    let pixel_m2 = plan.metres_per_pixel * plan.metres_per_pixel;
    counts.into_iter().map(|(class, count)| (class, count as f64 * pixel_m2)).collect()
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
