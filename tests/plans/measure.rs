//! How well a plan was read.

use trodden::plan::{FloorPlan, PlanClass, PlanOptions, read};
use trodden::rooms::Rooms;
use trodden::walls::{Walls, WallsOptions};

use super::styles::{Case, Drawn, Truth, draw};

/// Least share of a room's free floor that people can walk on.
const ROOM_SHARE: f64 = 0.85;

/// What was read of a case against the truth.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    pub style: &'static str,
    pub building: &'static str,
    pub clean: bool,
    pub rooms: [usize; 2],
    pub missing_rooms: Vec<&'static str>,
    /// Rooms that the floor is divided into as the building is, and those that are rooms of the floor but none of the building.
    pub divided: usize,
    pub false_rooms: usize,
    pub wall_iou: f64,
    pub doors: [usize; 2],
    /// Doors that are none.
    pub false_doors: usize,
    /// Square metres of letters, lines or furniture taken as wall.
    pub notes_as_wall_m2: f64,
    /// Share of the furniture's area that is furniture.
    pub furniture: f64,
    /// Paper that became floor, square metres.
    pub paper_m2: f64,
    pub error: Option<String>,
}

pub fn measure(case: &Case) -> Measured {
    let drawn: Drawn = draw(case);
    let folder = tempfile::tempdir().unwrap();
    let path = drawn.save(folder.path());
    let truth = &drawn.truth;
    let options = PlanOptions { metres_per_pixel: Some(truth.metres_per_pixel), ..PlanOptions::default() };
    let mut measured = Measured {
        style: case.style.name,
        building: (case.building)().name,
        clean: case.style.clean,
        rooms: [0, truth.room_names.len()],
        doors: [0, truth.doors.len()],
        ..Measured::default()
    };
    match read(&path, &options) {
        Ok(plan) => compare(&plan, truth, &mut measured),
        Err(error) => measured.error = Some(error.to_string()),
    }
    measured
}

fn compare(plan: &FloorPlan, truth: &Truth, measured: &mut Measured) {
    let m2 = plan.metres_per_pixel * plan.metres_per_pixel;
    let count = |of: &dyn Fn(usize) -> bool| (0..truth.wall.len()).filter(|&at| of(at)).count() as f64;
    let is_wall = |at: usize| matches!(plan.classes[at], PlanClass::Wall | PlanClass::Window);
    let is_true_wall = |at: usize| truth.wall[at] != 0 || truth.window[at] != 0;
    for (k, name) in (1..).zip(&truth.room_names) {
        let free = |at: usize| truth.rooms[at] == k && truth.furniture[at] == 0;
        let all = count(&free);
        if count(&|at| free(at) && plan.floor[at] != 0) >= ROOM_SHARE * all {
            measured.rooms[0] += 1;
        } else {
            measured.missing_rooms.push(name);
        }
    }
    divide(plan, truth, measured);
    let width = plan.width_px as usize;
    let height = plan.height_px as usize;
    let near = |at: usize, reach: usize, of: &dyn Fn(usize) -> bool| {
        let (x, y) = (at % width, at / width);
        (y.saturating_sub(reach)..=(y + reach).min(height - 1))
            .any(|y| (x.saturating_sub(reach)..=(x + reach).min(width - 1)).any(|x| of(y * width + x)))
    };
    let (both, either) = (count(&|at| is_wall(at) && is_true_wall(at)), count(&|at| is_wall(at) || is_true_wall(at)));
    measured.wall_iou = both / either.max(1.0);
    // Of lines as thin as pixels, what lies beside counts.
    let thin = count(&is_true_wall) * m2 < 0.04 * count(&|at| truth.floor[at] != 0) * m2;
    if thin {
        let found = count(&|at| is_true_wall(at) && near(at, 2, &is_wall));
        let right = count(&|at| is_wall(at) && near(at, 2, &is_true_wall));
        let (all, of) = (count(&is_true_wall), count(&is_wall));
        measured.wall_iou = (found / all.max(1.0)).min(right / of.max(1.0));
    }
    for door in &truth.doors {
        let [a, b] = [door.from, door.to].map(|p| plan.px_to_m(p));
        let is_it = |found: &&trodden::plan::PlanDoor| {
            let apart = (a + b) * 0.5;
            apart.distance((found.from_m + found.to_m) * 0.5) < 0.3 && (found.width_m() - a.distance(b)).abs() < 0.3
        };
        measured.doors[0] += usize::from(plan.doors.iter().any(|found| is_it(&found)));
    }
    measured.false_doors = plan.doors.len() - measured.doors[0].min(plan.doors.len());
    let is_note = |at: usize| truth.notes[at] != 0 || truth.furniture[at] != 0;
    let wrong = |at: usize| plan.classes[at] == PlanClass::Wall && is_note(at) && !near(at, 3, &is_true_wall);
    measured.notes_as_wall_m2 = count(&wrong) * m2;
    let furniture = count(&|at| truth.furniture[at] != 0);
    measured.furniture = if furniture > 0.0 {
        count(&|at| truth.furniture[at] != 0 && plan.classes[at].is_furniture()) / furniture
    } else {
        1.0
    };
    measured.paper_m2 =
        count(&|at| plan.floor[at] != 0 && truth.floor[at] == 0 && !near(at, 3, &|at| truth.floor[at] != 0)) * m2;
}

/// Compares the rooms into which doors divide the floor.
fn divide(plan: &FloorPlan, truth: &Truth, measured: &mut Measured) {
    let found = Rooms::find(plan, &Walls::trace(plan, &WallsOptions::default()));
    // Pixels of each true room, the last for what lies in none, by found room.
    let mut shared = vec![vec![0usize; found.rooms.len()]; truth.room_names.len() + 1];
    for at in (0..truth.wall.len()).filter(|&at| plan.floor[at] != 0) {
        let (x, y) = (at % plan.width_px as usize, at / plan.width_px as usize);
        if let Some(room) = found.at(plan.px_to_m([x as f64 + 0.5, y as f64 + 0.5])) {
            let own = usize::from(truth.rooms[at]).checked_sub(1).unwrap_or(truth.room_names.len());
            shared[own][room] += 1;
        }
    }
    let total = |room: usize| shared.iter().map(|row| row[room]).sum::<usize>();
    let mut right = vec![false; found.rooms.len()];
    for row in &shared[..truth.room_names.len()] {
        let Some(best) = (0..row.len()).max_by_key(|&room| row[room]) else { continue };
        let is_whole = |part: usize, all: usize| part as f64 >= ROOM_SHARE * all as f64;
        if is_whole(row[best], row.iter().sum()) && is_whole(row[best], total(best)) {
            measured.divided += 1;
            right[best] = true;
        }
    }
    measured.false_rooms = right.iter().filter(|right| !**right).count();
}

/// One line of the table.
pub fn row(m: &Measured) -> String {
    if let Some(error) = &m.error {
        return format!("| {} | {} | {error} | | | | | | |", m.style, m.building);
    }
    format!(
        "| {} | {} | {} of {} | {} ({}) | {:.3} | {} of {} ({}) | {:.2} | {:.0} % | {:.1} |{}",
        m.style,
        m.building,
        m.rooms[0],
        m.rooms[1],
        m.divided,
        m.false_rooms,
        m.wall_iou,
        m.doors[0],
        m.doors[1],
        m.false_doors,
        m.notes_as_wall_m2,
        100.0 * m.furniture,
        m.paper_m2,
        if m.missing_rooms.is_empty() { String::new() } else { format!(" without {}", m.missing_rooms.join(", ")) }
    )
}

pub const HEAD: &str = "| plan | building | rooms | divided (false) | walls, IoU | doors (false) | notes as wall, m2 | furniture | paper as floor, m2 |\n|---|---|---|---|---|---|---|---|---|";
