//! Guesses the scale of a plan from what has a usual size: doors, walls, the printed sheet.

use std::ops::RangeInclusive;

use super::arcs;
use super::clearance::opened;
use super::components::{Component, Components, Neighbours};
use super::drawing::{Drawing, is_on};
use super::gap_widths::{coloured_doors, doorways};
use super::likely::{Likelihood, Usual};
use super::scale::{self, PlanScale, ScaleSource, rounded};
use super::symbols::{FEWEST_STROKES, groups};
use super::thick::{self, transposed};
use super::{ASSUMED_M_PER_PX, understand};
use crate::math::ln;

/// How far one scale may be from another to be the same, and how many are tried: a sheet may be 2.5 times as wide as its
/// building.
const SAME_SCALE: f64 = 0.12;
const TRIES: usize = 9;
/// Usual radius of a door's leaf, and width of a doorway. Gaps are between dashes and pillars too.
const LEAF: Usual = Usual { metres: 0.865, spread: 0.12, wrong: 0.5 };
const DOORWAY: Usual = Usual { metres: 0.88, spread: 0.15, wrong: 0.6 };
/// How many leaves and doorways count at most.
const MOST_LEAVES: f64 = 5.0;
const MOST_DOORWAYS: f64 = 4.0;
/// Usual thickness of inner and outer walls.
const WALLS: [Usual; 2] =
    [Usual { metres: 0.13, spread: 0.35, wrong: 0.1 }, Usual { metres: 0.32, spread: 0.3, wrong: 0.1 }];
/// Usual larger side of a building, and height of letters.
const BUILDING: Usual = Usual { metres: 22.0, spread: 0.8, wrong: 0.1 };
const LETTER: Usual = Usual { metres: 0.27, spread: 0.5, wrong: 0.3 };
/// Largest letter, as a share of the image's longer side.
const LETTER_SHARE: f64 = 0.03;
/// As how many leaves one counts that hangs in a gap, where other gaps have none.
const HUNG_WEIGHT: f64 = 4.0;
/// Widths of doors that a scale explains, metres.
const DOOR_RANGE_M: [f64; 2] = [0.68, 1.15];
/// Least weight of leaves and doorways that decide a scale.
const FEWEST_LEAVES: f64 = 2.0;
const FEWEST_DOORS: f64 = 4.0;
/// Of gaps in a drawing with lettering, which no robot maps.
const FEWEST_DOORS_LETTERED: f64 = 3.5;
/// Larger sides of buildings at which doors are sought where fewer leaves than so many fit, metres.
const BUILDINGS_M: [f64; 4] = [8.0, 13.0, 21.0, 34.0];
const FEW_FITTING: f64 = 3.0;
/// How many times as many leaves and gaps decide together, and beside how many times as many gaps leaves are few.
const BOTH: f64 = 1.5;
const FEW_LEAVES: f64 = 4.0;
/// Radius of the rounded corners of chairs and tables at most, pixels, where doors are drawn as finely.
const CHAIR_PX: f64 = 22.0;
/// Widths of gaps that nobody passes, metres, which show that the scale is wrong if there are so many of them, and how sure
/// the other one is.
const NARROWEST_M: [f64; 2] = [0.3, 0.6];
const FEWEST_NARROW: usize = 3;
const BY_PASSAGES: f64 = 0.6;
/// Width of narrow passages without doors, metres.
const PASSAGE_M: f64 = 1.05;
/// Greatest thickness of a stroke of colour, pixels, and in the thickness of walls that are drawn thick.
const COLOURED_STROKE_PX: f64 = 4.0;
const STROKE_IN_WALLS: f64 = 0.4;
/// Lightness below which a pixel may be of an arc thinner than a pixel.
const FINE: u8 = 180;
/// Range of the width of a door in thicknesses of a wall that is drawn thick, by its leaf and as a gap.
const DOOR_IN_WALLS: [f64; 2] = [1.5, 14.0];
const WIDEST_GAP_IN_WALLS: f64 = 20.0;
/// Range of the width of a door as a share of the building's larger side.
const DOOR_IN_BUILDING: [f64; 2] = [0.008, 0.25];
/// A guess from few gaps that is less sure than this gives way to the usual scale of indoor maps.
const UNSURE: f64 = 0.25;
/// Length of buildings, metres.
const USUAL_BUILDING_M: RangeInclusive<f64> = 6.0..=150.0;
/// How far beyond what walls say the usual scale may lie.
const FAR: f64 = 3.0;
/// A guess as near to the usual scale of indoor maps takes that.
const USUAL_REACH: f64 = 0.04;
/// Least length of a piece of wall, as a share of the image's longer side.
const LONG_SHARE: f64 = 0.04;
/// Scales of printed plans, the usual ones first, and how near to the doors' guess one of them must be.
const PRINTED: [f64; 9] = [100.0, 50.0, 200.0, 75.0, 25.0, 250.0, 20.0, 500.0, 1000.0];
const PRINTED_REACH: f64 = 0.14;
/// Resolutions that programs write without meaning them, dots per inch.
const MEANINGLESS_DPI: [f64; 3] = [72.0, 90.0, 96.0];

/// What is measured in a drawing, pixels.
struct Measures {
    /// Thickness of walls that are drawn thick.
    wall: Option<f64>,
    /// Widths of doorways, each with its weight.
    doorways: Vec<(f64, f64)>,
    /// Radii of the quarter circles of door leaves, each with its weight.
    leaves: Vec<(f64, f64)>,
    /// Bounds of the building: least x and y, then one beyond the greatest.
    bounds: Option<[[u32; 2]; 2]>,
    /// Height of letters.
    letter: Option<f64>,
}

/// Metres per pixel from the width of the building, if walls are found.
///
/// What is building shows once the scale is known: the first scale counts at which the building is as wide as it is.
/// Dimension lines and the sheet's frame make it too wide at first.
/// `guess` is what doors or printed numbers say.
pub(super) fn of_width(drawing: &Drawing, width_m: f64, guess: f64) -> Option<f64> {
    let [min, end] = Walls::of(drawing).bounds?;
    let rough = width_m / f64::from(end[0] - min[0]);
    let of_building = |scale: f64| {
        let [min, end] = understand::extent(drawing, scale)?;
        Some(width_m / f64::from(end[0] - min[0]))
    };
    // Those near to the guess come first: a sheet's frame with its title block looks like a building too.
    let mut tries: Vec<f64> =
        std::iter::successors(Some(rough), |tried| Some(tried * (1.0 + SAME_SCALE))).take(TRIES).collect();
    tries.push(guess);
    tries.sort_by(|a, b| ln(a / guess).abs().total_cmp(&ln(b / guess).abs()));
    let is_same = |scale: &f64, tried: f64| (scale / tried - 1.0).abs() <= SAME_SCALE;
    let found = tries.into_iter().find_map(|tried| of_building(tried).filter(|scale| is_same(scale, tried)));
    Some(found.map_or(rough, |scale| of_building(scale).unwrap_or(scale)))
}

/// Guesses the metres per pixel. `dots_per_inch` is what the file says of its print.
pub(super) fn guess(drawing: &Drawing, dots_per_inch: Option<f64>) -> (f64, PlanScale) {
    if drawing.scanned {
        let evidence = "the usual scale of robots' maps".to_owned();
        return scale::found(ASSUMED_M_PER_PX, ScaleSource::Assumed, 0.5, [0.01, 0.1], evidence);
    }
    let mut measures = Measures::of(drawing);
    let dots = dots_per_inch.filter(|dots| MEANINGLESS_DPI.iter().all(|m| (m - dots).abs() > 0.6));
    // The usual scales come first.
    let printed = |[low, high]: [f64; 2]| {
        let dots = dots?;
        let each = PRINTED.iter().map(|&scale| (scale, rounded(0.0254 / dots * scale)));
        let (scale, value) = each.into_iter().find(|&(_, value)| (low..=high).contains(&value))?;
        Some((value, format!("; at 1:{scale}, as the file's {dots:.0} dots per inch allow")))
    };
    let mut likely = measures.likelihood().guess();
    let has_doors = measures.doors(likely.value).is_some();
    // Where no leaf fits, gaps may be gates: the largest leaf tells another scale. Few leaves may be the corners of showers
    // and bathtubs.
    let other = match measures.misfit(likely.value).filter(|_| has_doors) {
        Some(largest) => Some(LEAF.metres / largest),
        None => (!has_doors || measures.has_few_leaves()).then_some(likely.value),
    };
    // The rounded corners of many chairs outnumber doors that are drawn as finely.
    let are_small = measures.are_small(likely.value);
    // Leaves that hang in gaps of walls are told from other arcs; arcs that are drawn by hand are told by the gaps alone.
    let (hung, weight) = match (measures.wall, other) {
        (Some(_), Some(scale)) => (understand::leaf_lengths(drawing, scale), if has_doors { HUNG_WEIGHT } else { 1.0 }),
        (None, _) if measures.fitting(likely.value) < FEW_FITTING || are_small => {
            (measures.larger_side().map_or(Vec::new(), |px| hung_leaves(drawing, px, likely.value)), HUNG_WEIGHT)
        }
        _ => (Vec::new(), 1.0),
    };
    if !hung.is_empty() {
        if are_small {
            measures.leaves.clear();
        }
        measures.leaves.extend(hung.into_iter().map(|length| (length, weight)));
        likely = measures.likelihood().guess();
    }
    let by_passages = measures.by_passages(likely.value);
    if let Some(scale) = by_passages {
        likely.range[1] = likely.range[1].max(scale / BY_PASSAGES);
        likely.range[0] = scale * BY_PASSAGES;
        (likely.value, likely.sureness) = (scale, likely.sureness * BY_PASSAGES);
    }
    if let Some((count, width)) = measures.doors(likely.value) {
        // Where most gaps are none of doors, as in scans, some of a width say little.
        let share = count / measures.candidates().max(1e-9);
        // So do few gaps without leaves.
        let gaps_only = if measures.leaves.is_empty() { count / (count + FEWEST_DOORS) } else { 1.0 };
        likely.sureness *= (0.4 + 0.6 * share) * gaps_only;
        if share < 0.5 || gaps_only < 0.6 {
            likely.range = [likely.range[0].min(likely.value * 0.6), likely.range[1].max(likely.value * 1.6)];
        }
        let number = measures.number(likely.value);
        let evidence = format!("{number} doors about {width:.0} pixels wide, taken for {:.2} m", width * likely.value);
        let [low, high] = likely.range;
        let is_unsure = likely.sureness < UNSURE && by_passages.is_none();
        if is_unsure && (low..=high).contains(&ASSUMED_M_PER_PX) {
            return scale::found(ASSUMED_M_PER_PX, ScaleSource::Assumed, likely.sureness, likely.range, evidence);
        }
        let near = [1.0 - PRINTED_REACH, 1.0 + PRINTED_REACH].map(|share| likely.value * share);
        if let Some((value, print)) = printed(near) {
            let range = [value * 0.97, value * 1.03];
            return scale::found(value, ScaleSource::Guessed, likely.sureness.max(0.9), range, evidence + &print);
        }
        let is_usual = (likely.value / ASSUMED_M_PER_PX - 1.0).abs() <= USUAL_REACH;
        let value = if is_usual { ASSUMED_M_PER_PX } else { rounded(likely.value) };
        return scale::found(value, ScaleSource::Guessed, likely.sureness, likely.range, evidence);
    }
    let of_cells = || scale::of_cells(drawing.width, &drawing.lightness);
    if let Some(of_map) = scale::of_squares(drawing.square_px).or_else(of_cells) {
        return of_map;
    }
    let evidence = measures.wall.map_or(String::new(), |wall| format!("walls about {wall:.0} pixels thick"));
    if let Some((value, print)) = printed(likely.range).filter(|_| measures.wall.is_some()) {
        return scale::found(value, ScaleSource::Guessed, likely.sureness.max(0.4), likely.range, evidence + &print);
    }
    let [low, high] = likely.range;
    let range = [low.min(ASSUMED_M_PER_PX * 0.4), high.max(ASSUMED_M_PER_PX * 2.0)];
    // Walls alone are no measure: masses of wall are as thick as you like. But a building has a usual size.
    let is_possible = (low / FAR..=high * FAR).contains(&ASSUMED_M_PER_PX);
    let longest_px = measures.bounds.map_or(0, |[min, end]| (end[0] - min[0]).max(end[1] - min[1]));
    let is_usual = USUAL_BUILDING_M.contains(&(f64::from(longest_px) * ASSUMED_M_PER_PX));
    if is_possible || is_usual || measures.wall.is_none() {
        return scale::found(ASSUMED_M_PER_PX, ScaleSource::Assumed, likely.sureness.min(0.2), range, evidence);
    }
    scale::found(rounded(likely.value), ScaleSource::Guessed, likely.sureness, likely.range, evidence)
}

/// Lengths of the leaves that hang in the gaps of walls, pixels, by the size of a building, or the `likely` scale, at which most
/// of them are doors.
fn hung_leaves(drawing: &Drawing, building_px: f64, likely: f64) -> Vec<f64> {
    let doors = |scale: f64| -> Vec<f64> {
        let mut hung = understand::leaf_lengths(drawing, scale);
        hung.retain(|&px| is_door_width(px, scale));
        hung
    };
    let mut found: Vec<Vec<f64>> =
        BUILDINGS_M.into_iter().map(|metres| metres / building_px).chain([likely]).map(doors).collect();
    found.sort_by_key(Vec::len);
    found.pop().filter(|hung| hung.len() as f64 >= FEWEST_LEAVES).unwrap_or_default()
}

/// Walls of a drawing without strokes that are thinner, without what is too short, without frames.
struct Walls {
    mask: Vec<u8>,
    thickness: Option<f64>,
    bounds: Option<[[u32; 2]; 2]>,
}

impl Walls {
    fn of(drawing: &Drawing) -> Walls {
        let width = drawing.width;
        let thickness = wall_thickness(drawing);
        let solid = match thickness {
            Some(wall) => opened(&drawing.dark, width, (wall * 0.12).max(1.0)),
            None => drawing.dark.clone(),
        };
        let pieces = Components::of(&solid, width, 1, Neighbours::Eight);
        let long = LONG_SHARE * width.max(drawing.height) as f64;
        let mut walls: Vec<&Component> =
            pieces.all.iter().filter(|piece| f64::from(piece.larger_side()) >= long).collect();
        let frames: Vec<usize> = (0..walls.len()).filter(|&k| is_frame(&pieces, walls[k])).collect();
        if frames.len() < walls.len() {
            let mut k = 0;
            walls.retain(|_| {
                k += 1;
                !frames.contains(&(k - 1))
            });
        }
        let mut mask = vec![0; solid.len()];
        walls.iter().for_each(|piece| pieces.paint(piece, &mut mask, width, 1));
        Walls { mask, thickness, bounds: bounds(&walls, thickness.is_some()) }
    }
}

/// Bounds of all walls that are drawn thick. Among thin lines there are notes: bounds of the piece with the most ink and of
/// all that reach into them.
fn bounds(walls: &[&Component], are_thick: bool) -> Option<[[u32; 2]; 2]> {
    let main = walls.iter().max_by_key(|piece| (piece.area, std::cmp::Reverse(piece.min)))?;
    let (mut min, mut end) = (main.min, main.end);
    loop {
        let before = (min, end);
        let margin = [0, 1].map(|axis| (end[axis] - min[axis]) / 50);
        for piece in walls {
            let reaches =
                |axis: usize| piece.min[axis] < end[axis] + margin[axis] && piece.end[axis] + margin[axis] > min[axis];
            if are_thick || (reaches(0) && reaches(1)) {
                for axis in 0..2 {
                    min[axis] = min[axis].min(piece.min[axis]);
                    end[axis] = end[axis].max(piece.end[axis]);
                }
            }
        }
        if (min, end) == before {
            return Some([min, end]);
        }
    }
}

/// Whether a piece is a rectangle of thin lines.
fn is_frame(pieces: &Components, piece: &Component) -> bool {
    let [width, height] = piece.size();
    let margin = (width.max(height) / 100).max(3);
    let ring = 2 * (width + height) as usize * margin as usize;
    let on_ring = |x: u32, y: u32| {
        x < piece.min[0] + margin
            || x + margin >= piece.end[0]
            || y < piece.min[1] + margin
            || y + margin >= piece.end[1]
    };
    let on = |run: &super::components::Run| (run.from..run.to).filter(|&x| on_ring(x, run.y)).count();
    piece.area < ring && pieces.runs(piece).iter().map(on).sum::<usize>() * 50 >= piece.area * 49
}

/// Thickness of the walls, pixels, if they are drawn thick: thicker than strokes are.
fn wall_thickness(drawing: &Drawing) -> Option<f64> {
    const MOST_SAMPLES: usize = 20_000;
    let (width, height) = (drawing.width, drawing.height);
    let limit = width.max(height) / 8 + 1;
    let places: Vec<usize> = (0..drawing.dark.len()).filter(|&at| drawing.dark[at] != 0).collect();
    let run = |at: usize, stride: usize, before: usize, after: usize| {
        let back = (1..=before.min(limit)).take_while(|k| drawing.dark[at - k * stride] != 0).count();
        let on = (1..=after.min(limit)).take_while(|k| drawing.dark[at + k * stride] != 0).count();
        back + on + 1
    };
    let step = places.len().div_ceil(MOST_SAMPLES).max(1);
    let runs = places.iter().step_by(step).map(|&at| {
        let (x, y) = (at % width, at / width);
        run(at, 1, x, width - 1 - x).min(run(at, width, y, height - 1 - y))
    });
    // Masses of wall around rooms are no walls.
    let mut runs: Vec<usize> = runs.filter(|&run| run <= limit / 2).collect();
    runs.sort_unstable();
    let at = |runs: &[usize], share: f64| runs.get((runs.len() as f64 * share) as usize).copied().unwrap_or(0);
    // Strokes are thinner than half of what most of the ink is in.
    let much = at(&runs, 0.7);
    if much < 4 {
        return None;
    }
    runs.retain(|&run| run * 2 >= much);
    // Beside a few thin walls, most of the ink is in strokes.
    Some(at(&runs, 0.5)).filter(|&wall| wall > 2).map(|wall| wall as f64)
}

impl Measures {
    fn of(drawing: &Drawing) -> Measures {
        let walls = Walls::of(drawing);
        // Panes and leaves may be drawn in a colour.
        let thickest = walls.thickness.map_or(COLOURED_STROKE_PX, |wall| wall * STROKE_IN_WALLS);
        let of_colour = thick::strokes(&drawing.coloured, drawing.width, thickest);
        let is_of_colour = |at: usize| is_on(&of_colour, at);
        let is_ink = |x: usize, y: usize| {
            let at = y * drawing.width + x;
            drawing.dark[at] != 0 || is_of_colour(at)
        };
        // Between thin lines there are gaps of all kinds.
        let doorways_px = match walls.thickness {
            None => coloured_doors(drawing),
            Some(_) => {
                let upright = doorways(&transposed(&walls.mask, drawing.width), drawing.height, |y, x| is_ink(x, y));
                let mut all = doorways(&walls.mask, drawing.width, is_ink);
                all.extend(upright);
                all
            }
        };
        let (dark, letter) = without_letters(&drawing.dark, drawing.width);
        let mut leaves = arcs::leaves(&dark, drawing.width);
        if (leaves.len() as f64) < FEWEST_LEAVES && !drawing.scanned {
            let is_fine = |(at, &lightness): (usize, &u8)| u8::from(lightness < FINE || is_of_colour(at));
            let fine: Vec<u8> = drawing.lightness.iter().enumerate().map(is_fine).collect();
            leaves = arcs::leaves(&without_letters(&fine, drawing.width).0, drawing.width);
        }
        Measures { wall: walls.thickness, doorways: doorways_px, leaves, bounds: walls.bounds, letter }.restricted()
    }

    fn likelihood(&self) -> Likelihood {
        let mut likelihood = Likelihood::prior();
        likelihood.add(&self.leaves, &[LEAF], MOST_LEAVES);
        likelihood.add(&self.doorways, &[DOORWAY], MOST_DOORWAYS);
        likelihood.add(&self.wall.map(|px| (px, 1.0)).into_iter().collect::<Vec<_>>(), &WALLS, 1.0);
        likelihood.add(&self.larger_side().map(|px| (px, 1.0)).into_iter().collect::<Vec<_>>(), &[BUILDING], 1.0);
        likelihood.add(&self.letter.map(|px| (px, 1.0)).into_iter().collect::<Vec<_>>(), &[LETTER], 1.0);
        likelihood
    }

    /// Weight of all that may be doors.
    fn candidates(&self) -> f64 {
        self.leaves.iter().chain(&self.doorways).map(|door| door.1).sum()
    }

    fn larger_side(&self) -> Option<f64> {
        self.bounds.map(|[min, end]| f64::from((end[0] - min[0]).max(end[1] - min[1])))
    }

    /// Number of the doors that a scale explains and their mean width, pixels; `None` for too few.
    fn doors(&self, scale: f64) -> Option<(f64, f64)> {
        let fits = |door: &&(f64, f64)| is_door_width(door.0, scale);
        let sum = |doors: &[(f64, f64)]| {
            doors.iter().filter(fits).fold([0.0, 0.0], |[n, sum], &(px, weight)| [n + weight, sum + px * weight])
        };
        let ([leaves, leaf_sum], [gaps, gap_sum]) = (sum(&self.leaves), sum(&self.doorways));
        let all: f64 = self.leaves.iter().map(|leaf| leaf.1).sum();
        // Quarter circles of any size are the grain of a scan.
        let are_doors = leaves >= FEWEST_LEAVES && leaves * 5.0 >= all * 2.0;
        let fewest = if self.letter.is_some() { FEWEST_DOORS_LETTERED } else { FEWEST_DOORS };
        let are_both = leaves >= FEWEST_LEAVES && leaves + gaps >= BOTH * fewest;
        (are_doors || gaps >= fewest || are_both).then(|| (leaves + gaps, (leaf_sum + gap_sum) / (leaves + gaps)))
    }

    /// Number of the leaves or doorways that are doors by a scale, of which there are more.
    fn number(&self, scale: f64) -> usize {
        let number = |doors: &[(f64, f64)]| doors.iter().filter(|door| is_door_width(door.0, scale)).count();
        number(&self.leaves).max(number(&self.doorways))
    }

    /// Weight of the leaves that are doors by a scale.
    fn fitting(&self, scale: f64) -> f64 {
        self.leaves.iter().filter(|leaf| is_door_width(leaf.0, scale)).map(|leaf| leaf.1).sum()
    }

    /// Whether the leaves that are doors by a scale are no larger than the corners of chairs, where walls are lines.
    fn are_small(&self, scale: f64) -> bool {
        let mut fitting = self.leaves.iter().map(|leaf| leaf.0).filter(|&px| is_door_width(px, scale)).peekable();
        self.wall.is_none() && fitting.peek().is_some() && fitting.all(|px| px < CHAIR_PX)
    }

    /// A larger scale, where nobody could pass several gaps between walls by this one: the narrowest are doors, and the others
    /// openings without any, as on maps of museums. `None` where leaves are drawn.
    fn by_passages(&self, scale: f64) -> Option<f64> {
        let is_narrow = |px: f64| (NARROWEST_M[0]..NARROWEST_M[1]).contains(&(px * scale));
        let mut narrow: Vec<f64> =
            self.doorways.iter().filter(|&&(px, weight)| weight >= 1.0 && is_narrow(px)).map(|gap| gap.0).collect();
        narrow.sort_by(f64::total_cmp);
        let is_found = self.leaves.is_empty() && narrow.len() >= FEWEST_NARROW;
        is_found.then(|| PASSAGE_M / narrow[narrow.len() / 2])
    }

    /// Whether there are few leaves, at all or for so many gaps.
    fn has_few_leaves(&self) -> bool {
        let [leaves, gaps] = [&self.leaves, &self.doorways].map(|all| all.iter().map(|door| door.1).sum::<f64>());
        leaves <= FEW_FITTING || leaves * FEW_LEAVES <= gaps
    }

    /// The largest leaf, pixels, if none is of a door by a scale.
    fn misfit(&self, scale: f64) -> Option<f64> {
        let largest = self.leaves.iter().map(|leaf| leaf.0).reduce(f64::max);
        largest.filter(|_| !self.leaves.iter().any(|leaf| is_door_width(leaf.0, scale)))
    }

    /// Leaves out widths that are none of doors: beside the walls' thickness and the building's size.
    fn restricted(mut self) -> Measures {
        let building =
            self.larger_side().map_or(0.0..=f64::INFINITY, |px| px * DOOR_IN_BUILDING[0]..=px * DOOR_IN_BUILDING[1]);
        let in_walls =
            |px: f64, most: f64| self.wall.is_none_or(|wall| (DOOR_IN_WALLS[0]..=most).contains(&(px / wall)));
        self.leaves.retain(|&(px, _)| building.contains(&px) && in_walls(px, DOOR_IN_WALLS[1]));
        self.doorways.retain(|&(px, _)| building.contains(&px) && in_walls(px, WIDEST_GAP_IN_WALLS));
        // Arcs of a few pixels are in any clutter.
        self.leaves.iter_mut().for_each(|leaf| leaf.1 *= ((leaf.0 - 8.0) / 14.0).clamp(0.1, 1.0));
        self
    }
}

/// Whether a width in pixels is that of a door by a scale.
fn is_door_width(px: f64, scale: f64) -> bool {
    (DOOR_RANGE_M[0]..=DOOR_RANGE_M[1]).contains(&(px * scale))
}

/// Takes lettering out of a drawing: groups of small strokes. Returns the height of letters too, pixels.
fn without_letters(dark: &[u8], width: usize) -> (Vec<u8>, Option<f64>) {
    let pieces = Components::of(dark, width, 1, Neighbours::Eight);
    let largest = LETTER_SHARE * width.max(dark.len() / width) as f64;
    let small: Vec<&Component> = pieces.all.iter().filter(|p| f64::from(p.larger_side()) <= largest).collect();
    let mut rest = dark.to_vec();
    let mut heights = Vec::new();
    for letter in groups(&small).into_iter().filter(|group| group.len() >= FEWEST_STROKES).flatten() {
        pieces.paint(letter, &mut rest, width, 0);
        let [w, h] = letter.size();
        // Dashes, dots and flakes have no height of letters.
        if h >= 5 && w * 6 >= h && w <= h * 2 {
            heights.push(h);
        }
    }
    heights.sort_unstable();
    let height = heights.get(heights.len() / 2).filter(|_| heights.len() >= 2 * FEWEST_STROKES).map(|&h| f64::from(h));
    (rest, height)
}
