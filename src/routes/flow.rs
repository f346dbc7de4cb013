use super::field::Field;
use super::ground::Ground;
use super::lattice::BLOCK_CELLS;
use super::sheet::{ConductiveSheet, NONE};
use crate::math::{Vec2, vec2};

/// Longest detour with flow: metres, plus a share of the path length.
const DETOUR_M: f64 = 4.0;
const DETOUR_SHARE: f64 = 0.16;
/// Upper bound of their sum, metres.
const MOST_DETOUR_M: f64 = 24.0;
/// Relative conductance along a wall, and the clearances over which it grows to 1, metres.
const WALL_SHARE: f64 = 0.04;
const WALL_M: [f64; 2] = [0.15, 0.65];
/// Clearance below which people drift off a wall, metres, and the drift's slope at the wall.
const OFF_WALLS_M: f64 = 0.4;
const OFF_WALLS: f64 = 0.5;
/// Weight of the steepest descent against the flow, per metre of cell size: it leads out of niches with hardly any
/// flow.
const DOWN_SHARE: f64 = 0.003;

/// Slack places have a smaller slope than the mean around. Conductance falls to `SLACK_LEAVES` at the first share of
/// the mean and stays full from the second share on.
const SLACK: [f64; 2] = [0.65, 0.95];
const SLACK_LEAVES: f64 = 0.02;
/// Side of the tiles for means around a cell, metres; a mean reaches about 1.5 tiles.
const AROUND_M: f64 = 1.0;

/// Flow of people from one place to another over all reasonable paths: a direction per cell.
///
/// Potential flow: people enter evenly over the start's cells and spread like a current in a sheet, `div(s grad p) =
/// source`, with `p = 0` at the goal. They fill a corridor evenly over its width, fan out in a hall, divide among the
/// gaps between pillars and use all lanes of a bend. Conductance falls with the length of the detour through a place,
/// and along walls. A current has no dead ends: from every place in the flow it leads to the goal.
///
/// A current also enters niches and side corridors that people pass. So it is solved twice; where it is slack in the
/// first solution, conductance is low in the second.
#[derive(Debug)]
pub(crate) struct Flow {
    /// Index in `ahead` of the first cell of each lattice block, or [`NONE`].
    first: Vec<u32>,
    /// Unit vectors times 127; zero off the flow.
    ahead: Vec<[i8; 2]>,
}

impl Flow {
    /// Computes the flow from the start cells down a field; empty if the field reaches no start.
    pub(crate) fn new(ground: &Ground, starts: &[usize], to: &Field) -> Flow {
        let seeds: Vec<usize> = starts.iter().copied().filter(|&c| to.of_cell(c).is_finite()).collect();
        let longest_m = seeds.iter().map(|&c| to.of_cell(c)).fold(0.0, f64::max);
        let most_m = (DETOUR_M + DETOUR_SHARE * longest_m).min(MOST_DETOUR_M);
        // Detour: distances to start and goal, minus the distance of the longest direct path.
        let over_m = |cell: usize, walked_m: f64| walked_m + to.of_cell(cell) - longest_m;
        let offsets = seeds.iter().map(|&c| (c, (longest_m - to.of_cell(c)) as f32)).collect();
        let walked = Field::spread(ground, offsets, |cell, value| over_m(cell, value) < most_m);
        let cells: Vec<usize> = (0..ground.lattice.len()).filter(|&c| walked.of_cell(c).is_finite()).collect();
        let conducts = |cell: usize| {
            let detour = (over_m(cell, walked.of_cell(cell)) / most_m).clamp(0.0, 1.0);
            let near = 1.0 - detour;
            let off_wall = ((ground.cell_clearance_m(cell) - WALL_M[0]) / (WALL_M[1] - WALL_M[0])).clamp(0.0, 1.0);
            ((near * near) * (near * near)).max(1e-4) * (WALL_SHARE + (1.0 - WALL_SHARE) * off_wall)
        };
        let loose: Vec<f64> = cells.iter().map(|&cell| conducts(cell)).collect();
        let guess = cells.iter().map(|&cell| to.of_cell(cell)).collect();
        let mut sheet = ConductiveSheet::new(&ground.lattice, cells, &loose, |cell| to.of_cell(cell) <= 0.0);
        let first = sheet.potential(&seeds, guess);
        sheet.conduct(&tightened(&sheet, &loose, &first, ground.lattice.cell_m()));
        let potential = sheet.potential(&seeds, first);
        Flow::of_currents(ground, to, &sheet, sheet.currents(&potential))
    }

    fn of_currents(ground: &Ground, to: &Field, sheet: &ConductiveSheet, currents: Vec<Vec2>) -> Flow {
        let lattice = &ground.lattice;
        let mut first = vec![NONE; lattice.len() / BLOCK_CELLS];
        let mut ahead = Vec::new();
        for (&cell, current) in sheet.cells().iter().zip(currents) {
            let block = &mut first[cell / BLOCK_CELLS];
            if *block == NONE {
                *block = ahead.len() as u32;
                ahead.resize(ahead.len() + BLOCK_CELLS, [0, 0]);
            }
            let down = to.slope(ground, cell).unwrap_or_default() * (DOWN_SHARE * lattice.cell_m());
            let along = current + down;
            let along = along + off_walls(ground, cell) * along.length();
            if let Some(unit) = along.normalized() {
                let byte = |v: f64| (v * 127.0).round() as i8;
                ahead[*block as usize + cell % BLOCK_CELLS] = [byte(unit.x), byte(unit.y)];
            }
        }
        Flow { first, ahead }
    }

    /// Whether people of the flow pass a cell.
    pub(super) fn holds(&self, cell: usize) -> bool {
        let first = self.first[cell / BLOCK_CELLS];
        first != NONE && self.ahead[first as usize + cell % BLOCK_CELLS] != [0, 0]
    }

    /// Unit vector along the flow at `p`; `None` off the flow.
    #[inline]
    pub(crate) fn at(&self, ground: &Ground, p: Vec2) -> Option<Vec2> {
        let mut sum = Vec2::ZERO;
        for (cell, weight) in ground.lattice.stencil(p) {
            let Some(cell) = cell else { continue };
            let first = self.first[cell / BLOCK_CELLS];
            if first != NONE {
                let [x, y] = self.ahead[first as usize + cell % BLOCK_CELLS];
                sum += vec2(f64::from(x), f64::from(y)) * weight;
            }
        }
        let squared = sum.length_squared();
        (squared > 100.0).then(|| sum / squared.sqrt())
    }
}

/// Returns the conductances `loose` of a sheet, reduced at slack places.
fn tightened(sheet: &ConductiveSheet, loose: &[f64], potential: &[f64], cell_m: f64) -> Vec<f64> {
    let slopes = sheet.slopes(potential);
    let currents: Vec<f64> = slopes.iter().zip(loose).map(|(slope, conducts)| slope * conducts).collect();
    let side =
        [1u32, 2, 4, 8, 16].into_iter().rfind(|&side| f64::from(side) * cell_m < std::f64::consts::SQRT_2 * AROUND_M);
    let means = sheet.means_around(&slopes, &currents, side.unwrap_or(1) as usize);
    let left = |slope: f64, mean: f64| {
        let share = if mean > 0.0 { slope / mean } else { 1.0 };
        ((share - SLACK[0]) / (SLACK[1] - SLACK[0])).clamp(SLACK_LEAVES, 1.0)
    };
    loose.iter().zip(slopes.iter().zip(means)).map(|(conducts, (&slope, mean))| conducts * left(slope, mean)).collect()
}

/// Direction away from a near wall: zero from [`OFF_WALLS_M`] on and midway between two walls.
fn off_walls(ground: &Ground, cell: usize) -> Vec2 {
    let own = ground.cell_clearance_m(cell);
    let near = (1.0 - own / OFF_WALLS_M).max(0.0);
    if near == 0.0 {
        return Vec2::ZERO;
    }
    let [west, east, south, north] =
        ground.lattice.around(cell).map(|b| if b == usize::MAX { own } else { ground.cell_clearance_m(b) });
    vec2(east - west, north - south) * (0.5 / ground.lattice.cell_m() * OFF_WALLS * near)
}
