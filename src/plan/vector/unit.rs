//! How large a drawing is: from its unit, or from the widths of its doors and the thickness of its walls.

use super::doors::{arc_of, long_axis};
use super::piece::{Unit, VectorPlan, bounds_of};
use super::solid::thickness;
use crate::plan::{PlanClass, PlanScale, ScaleSource};

/// Scales of drawings on paper.
const PAPER_SCALES: [f64; 15] =
    [1.0, 10.0, 20.0, 25.0, 50.0, 75.0, 100.0, 125.0, 150.0, 200.0, 250.0, 300.0, 400.0, 500.0, 1000.0];
/// Units of drawings without paper, metres: millimetre to metre, inch and foot.
const UNITS_M: [f64; 6] = [0.001, 0.01, 0.1, 1.0, 0.0254, 0.3048];
/// Usual width of a door and usual thickness of a wall, metres.
const DOOR_M: f64 = 0.9;
const WALL_M: f64 = 0.17;
/// The longer side of a building, metres.
const BUILDING_M: [f64; 2] = [3.0, 500.0];
/// A known unit is doubted if doors come out beyond this, metres.
const DOOR_DOUBT_M: std::ops::RangeInclusive<f64> = 0.45..=2.2;
/// How sure a scale is, and by which factor it may be off: doors are 0.7 to 1.2 m wide, walls 0.1 to 0.4 m thick.
const SURE_BY_DOORS: f64 = 0.85;
const SURE_BY_WALLS: f64 = 0.5;
const DOORS_OFF: f64 = 1.3;
const WALLS_OFF: f64 = 2.0;

/// What of a drawing tells its size, in its own units.
#[derive(Debug)]
struct Evidence {
    door: Option<f64>,
    wall: Option<f64>,
    longer_side: f64,
}

/// Metres of a unit, and what to tell the user about it.
pub(super) fn metres_per_unit(plan: &VectorPlan) -> (Option<(f64, PlanScale)>, Option<String>) {
    let evidence = Evidence::of(plan);
    let guess = |candidates: &mut dyn Iterator<Item = f64>| evidence.best(candidates);
    let everything = || UNITS_M.into_iter().chain(PAPER_SCALES.map(|scale| scale * 0.0254 / 96.0));
    let sure = |metres: f64| Some((metres, PlanScale::known(ScaleSource::Drawing, metres)));
    let guessed = |metres: f64| Some((metres, evidence.guessed(metres)));
    match plan.unit {
        Unit::Sure(metres) => (sure(metres), None),
        Unit::Metres(metres) => {
            let door = evidence.door.map(|door| door * metres);
            let side = evidence.longer_side * metres;
            let doubtful = door.is_some_and(|door| !DOOR_DOUBT_M.contains(&door)) || !(2.0..=3000.0).contains(&side);
            match guess(&mut everything()).filter(|_| doubtful) {
                Some(better) => {
                    let found = match door {
                        Some(door) => format!("doors would be {door:.3} m wide"),
                        None => format!("the building would be {side:.1} m long"),
                    };
                    let warning = format!("the drawing's unit of {metres} m cannot be: {found}; {better} m was taken");
                    (guessed(better), Some(warning))
                }
                None => (sure(metres), None),
            }
        }
        Unit::Paper(metres) => match guess(&mut PAPER_SCALES.map(|scale| scale * metres).into_iter()) {
            Some(guess) => {
                let scale = (guess / metres).round();
                (guessed(guess), Some(format!("the scale was taken for 1:{scale}, {}", evidence.says(guess))))
            }
            None => (None, None),
        },
        Unit::Unknown => match guess(&mut everything()) {
            Some(guess) => (
                guessed(guess),
                Some(format!("the drawing has no unit: {guess:.6} m was taken, {}", evidence.says(guess))),
            ),
            None => (None, None),
        },
    }
}

impl Evidence {
    fn of(plan: &VectorPlan) -> Evidence {
        let of = |class: PlanClass| plan.pieces.iter().filter(move |piece| piece.class == Some(class));
        let arcs: Vec<f64> = of(PlanClass::Door).filter_map(arc_of).map(|arc| arc.radius).collect();
        let straight = || of(PlanClass::Door).filter(|piece| !piece.curved).filter_map(long_axis);
        let doors = if arcs.is_empty() { straight().map(|[a, b]| a.distance(b)).collect() } else { arcs };
        let building = of(PlanClass::Wall).chain(of(PlanClass::Window)).flat_map(|piece| piece.points());
        let bounds = bounds_of(building).or_else(|| bounds_of(plan.pieces.iter().flat_map(|piece| piece.points())));
        Evidence {
            door: median(doors),
            wall: median(of(PlanClass::Wall).filter_map(thickness).collect()),
            longer_side: bounds.map_or(0.0, |bounds| bounds.width().max(bounds.height())),
        }
    }

    /// The candidate that fits best; `None` without evidence, or if none fits.
    fn best(&self, candidates: &mut dyn Iterator<Item = f64>) -> Option<f64> {
        if self.door.is_none() && self.wall.is_none() {
            return None;
        }
        // Factors by which doors and walls are off; walls vary more.
        let off =
            |size: Option<f64>, usual: f64, m: f64| size.map_or(1.0, |size| (size * m / usual).max(usual / (size * m)));
        let cost = |m: f64| 3.0 * off(self.door, DOOR_M, m) + off(self.wall, WALL_M, m);
        let fits = |m: &f64| {
            let side = self.longer_side * m;
            (BUILDING_M[0]..=BUILDING_M[1]).contains(&side)
                && off(self.door, DOOR_M, *m) < 1.6
                && off(self.wall, WALL_M, *m) < 3.5
        };
        let best = candidates.filter(fits).min_by(|a, b| cost(*a).total_cmp(&cost(*b)));
        // Doors alone tell a scale that no convention has.
        best.or_else(|| self.door.map(|door| DOOR_M / door))
    }

    fn says(&self, m: f64) -> String {
        match (self.door, self.wall) {
            (Some(door), _) => format!("at which doors are {:.2} m wide", door * m),
            (None, Some(wall)) => format!("at which walls are {:.2} m thick", wall * m),
            (None, None) => String::new(),
        }
    }

    /// How sure a scale is that doors or walls tell: these differ more.
    fn guessed(&self, m: f64) -> PlanScale {
        let (evidence, sureness, off) = match (self.door, self.wall) {
            (Some(door), _) => (format!("doors, {:.2} m wide", door * m), SURE_BY_DOORS, DOORS_OFF),
            (None, Some(wall)) => (format!("walls, {:.2} m thick", wall * m), SURE_BY_WALLS, WALLS_OFF),
            (None, None) => (String::new(), 0.0, WALLS_OFF),
        };
        PlanScale { source: ScaleSource::Guessed, sureness, range: [m / off, m * off], evidence }
    }
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.retain(|value| value.is_finite() && *value > 0.0);
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}
