//! The net of walls in a drawing: thick strokes, and hollow or hatched ones once filled.

use super::super::PlanClass;
use super::super::components::{Component, Components, Neighbours, Run};
use super::super::doors::bend;
use super::super::drawing::is_on;
use super::super::thick::{Thickness, grow, open};
use super::border;
use super::directions::SHADOW_SHARE;
use super::doubtful;
use super::gaps::{self, Gap, Limits};
use super::leaves;
use crate::math::sin_cos;

/// Least share of the least box around a building that is enclosed by its walls.
const ENCLOSED_SHARE: f64 = 0.45;
/// Least share of a building's floor that its doors connect.
pub(super) const CONNECTED: f64 = 0.6;
/// Greatest width of a door, metres; of an opening to the outside, without which the walls enclose no building.
pub(super) const WIDEST_DOOR_M: f64 = 2.6;
pub(super) const WIDEST_ENTRANCE_M: f64 = 6.5;
/// Narrowest door across the end of a corridor, metres: between pieces of furniture are narrower gaps.
const NARROWEST_END_M: f64 = 0.7;
/// Greatest width of a gap that only a line closes and that is a door, metres.
const WIDEST_CLOSED_DOOR_M: f64 = 1.6;
/// Least and greatest width of a sliding entrance, metres, and greatest thickness of its leaves, metres and walls.
const ENTRANCE_M: [f64; 2] = [1.2, 6.0];
/// How far a jamb of a door without a leaf stands out from other walls at least, metres and door widths.
const LEAST_JAMB_M: f64 = 0.15;
const LEAST_JAMB: f64 = 0.15;
const THICKEST_LEAF_M: f64 = 0.3;
const LEAF_IN_WALLS: f64 = 0.75;
/// Greatest width of a window that is a single line, metres.
const WIDEST_PANE_M: f64 = 3.2;
/// Least share of a gap that a single line in the blue of panes fills, and that a bar of another colour does.
const PANE_SHARE: f64 = 0.3;
const BAR_SHARE: f64 = 0.4;
/// Least area of a room that a door leads to, square metres.
pub(super) const LEAST_ROOM_M2: f64 = 2.0;
/// Least width of a gate that is a single line, metres.
const NARROWEST_GATE_M: f64 = 2.3;
/// Greatest side of a column between massive walls, metres, and its greatest length in its thickness.
const LONGEST_COLUMN_M: f64 = 2.5;
const COLUMN_SLENDER: f64 = 1.8;
/// Largest column or piece of furniture that is drawn as thick as walls, metres.
const COLUMN_M: f64 = 0.75;
/// The same for outlines as far apart as those of walls.
const OUTLINED_M: f64 = 2.5;
/// Least side of a column, metres and pixels.
const LEAST_COLUMN_M: f64 = 0.15;
const LEAST_COLUMN_PX: f64 = 5.0;
/// How much of the shadow of a scanner's lid lies at the image's sides at least.
const SHADOW_IN_RIM: f64 = 0.97;
/// How far before the panes of a window a partition may end, pixels, and how far it leads away from them, in the window's
/// thicknesses.
const BESIDE_PANE_PX: usize = 3;
const PARTITION_SLENDER: f64 = 4.0;
/// Share of its box above which a piece encloses no rooms.
const MASS_FILL: f64 = 0.7;
/// Least share of a column that is ink.
const COLUMN_INK: f64 = 0.85;

/// How many times as thick as thin walls most walls are where thin ones are kept from their windows, and the square that tells
/// them, as a share of their thickness.
const MUCH_THICKER: f64 = 1.8;
const WALL_SQUARE: f64 = 0.6;
/// Shares of a row of a window that are neither a line nor the pane, and share of its rows that may be so.
const CROSSED: [f64; 2] = [0.06, 0.8];
const MOST_CROSSED: f64 = 0.25;

/// Walls, and what closes them to a building.
pub(super) struct Net {
    /// 1 for wall.
    pub(super) wall: Vec<u8>,
    pub(super) doors: Vec<Gap>,
    pub(super) windows: Vec<Gap>,
    /// 1 for all that cannot be reached from the image's sides; without walls, doors and windows.
    pub(super) inside: Vec<u8>,
    /// Share of the box around the walls that is enclosed.
    pub(super) enclosed: f64,
}

/// What a drawing shows beside its walls. What is drawn in colour is 1 each; empty without any.
#[derive(Clone, Copy)]
pub(super) struct Hints<'a> {
    /// Strokes in the blue of panes.
    pub(super) panes: &'a [u8],
    /// Strokes in other hints.
    pub(super) bars: &'a [u8],
    /// Directions of slanted windows, radians below a right angle.
    pub(super) slanted: &'a [f64],
}

/// What walls and doors are sought.
pub(super) struct Sought<'a> {
    /// Greatest depth of gaps, pixels.
    pub(super) thickest: usize,
    /// Greatest width of doors to the outside, metres; within they are up to [`WIDEST_DOOR_M`] wide.
    pub(super) widest_m: f64,
    /// Whether walls are as thick as those of churches.
    pub(super) is_massive: bool,
    /// Thickness of strokes that are no walls, pixels.
    pub(super) stroke_px: usize,
    /// Whether a sheet's frame may be around them.
    pub(super) is_framed: bool,
    pub(super) hints: Hints<'a>,
}

impl Net {
    /// Finds the net among what is surely dark in `core`; `dark` adds its edges.
    ///
    /// `raw` is what is dark in the drawing, before hollow walls were filled; `ink` has lighter strokes as well.
    pub(super) fn find(
        core: &[u8],
        dark: &[u8],
        raw: &[u8],
        ink: &[u8],
        width: usize,
        metres_per_pixel: f64,
        &Sought { thickest, widest_m, is_massive, stroke_px, is_framed, hints }: &Sought,
    ) -> Option<Net> {
        // Fills join the strokes of frames that stand apart.
        let mut core = core.to_vec();
        if is_framed {
            border::drop(&mut core, ink, width, metres_per_pixel);
        }
        let Thickness { square: side, thinnest, usual } =
            Thickness::of(&core, width, metres_per_pixel, is_massive, stroke_px)?;
        let px = |metres: f64| (metres / metres_per_pixel).round() as usize;
        let mut wall = open(&core, width, side);
        drop(core);
        drop_crumbs(&mut wall, width, (thinnest * 0.8).max(LEAST_COLUMN_M / metres_per_pixel).max(LEAST_COLUMN_PX));
        let limits = Limits {
            shortest: px(0.5),
            shortest_pane: px(0.15).max(2),
            longest: px(16.0),
            thinnest: ((thinnest * 0.75) as usize).max(2),
            thickest,
            slanted: hints.slanted,
        };
        let is_wide = |gap: &Gap| (px(ENTRANCE_M[0])..=px(ENTRANCE_M[1])).contains(&gap.length());
        let is_entrance = |gap: &Gap| gap.turns || gap.slides && is_wide(gap);
        if usual >= MUCH_THICKER * thinnest {
            clear_windows(&mut wall, ink, width, &limits, ((usual * WALL_SQUARE) as usize).max(side + 1));
        }
        drop_leaves(&mut wall, ink, width, &limits, [ENTRANCE_M[1], THICKEST_LEAF_M].map(px), is_entrance);
        let strokes = strokes_of(ink, &wall);
        let mut found = gaps::find(&wall, &strokes, width, &limits);
        if is_massive {
            // Columns are as thick as massive walls; what is drawn between them is no window.
            let columns = columns(&wall, width, LONGEST_COLUMN_M / metres_per_pixel);
            found.retain(|gap| gap.ends.iter().all(|&at| columns[at] == 0));
        }
        found.iter_mut().for_each(|gap| gap.turns = is_wide(gap) && leaves::revolves(gap, ink));
        // A door may be closed by lines along both faces of the wall; its leaf tells it from a window.
        let has_leaf = |gap: &Gap| {
            let hung = || leaves::hung(gap, &strokes, metres_per_pixel);
            (limits.shortest..=px(WIDEST_DOOR_M)).contains(&gap.length()) && !hung().is_empty() || gap.turns
        };
        let share = |gap: &Gap, mask: &[u8]| {
            let pixels = gap.pixels();
            let on = pixels.iter().filter(|&&at| is_on(mask, at)).count();
            on as f64 / pixels.len().max(1) as f64
        };
        // A bar of colour is a single line, however thick.
        found.iter_mut().filter(|gap| share(gap, hints.bars) >= BAR_SHARE).for_each(|gap| gap.strokes = 1);
        let is_window = |gap: &Gap| {
            (gap.strokes >= 2
                || gap.strokes == 1 && share(gap, hints.panes) >= PANE_SHARE
                || gap.strokes == 1 && gap.length() > px(WIDEST_CLOSED_DOOR_M) && gap.length() <= px(WIDEST_PANE_M))
                && !is_entrance(gap)
                && !has_leaf(gap)
        };
        let (windows, doors): (Vec<Gap>, Vec<Gap>) = found.into_iter().partition(is_window);
        let is_hung = |gap: &Gap| {
            gap.length() >= px(NARROWEST_END_M) && !leaves::symbol(gap, &strokes, metres_per_pixel).is_empty()
        };
        // Between a wall and a basin or column before it, or a pier that hardly stands out, there is no wall for a door.
        let pillars = columns(&wall, width, COLUMN_M / metres_per_pixel);
        let has_jamb = |gap: &Gap| {
            let least = px(LEAST_JAMB_M).max((LEAST_JAMB * gap.length() as f64) as usize);
            let is_jamb = |(length, end): (usize, usize)| length >= least && pillars[end] == 0;
            let stands_out = || gap.jamb_lengths(&wall, least).into_iter().zip(gap.ends).any(is_jamb);
            gap.strokes > 0 || gap.slides || gap.turns || stands_out()
        };
        let is_door = |gap: &Gap| {
            (gap.length() <= px(WIDEST_DOOR_M) || is_entrance(gap)) && (!gap.at_end && has_jamb(gap) || is_hung(gap))
        };
        // Without them the walls may enclose no building: wide openings, and the ends of corridors.
        let may_lead_out = |gap: &Gap| widest_m > WIDEST_DOOR_M && gap.length() <= px(widest_m);
        let mut doors: Vec<Gap> = doors.into_iter().filter(|gap| is_door(gap) || may_lead_out(gap)).collect();
        let unusual: Vec<[usize; 2]> = doors.iter().filter(|gap| !is_door(gap)).map(|gap| gap.ends).collect();
        doubtful::drop_thicker_than_walls(&mut doors, &windows, has_leaf, |doors| {
            enclosed(&wall, doors, &windows, width)
        });
        let largest = [COLUMN_M, OUTLINED_M].map(px);
        doubtful::drop_beside_furniture(&mut doors, &windows, (&wall, raw), width, largest, has_leaf);
        drop(strokes);
        let mut windows = windows;
        let kept = keep_building(&mut wall, raw, width, &doors, &windows)?;
        for gaps in [&mut doors, &mut windows] {
            gaps.retain(|gap| gap.ends.iter().all(|&at| wall[at] != 0));
        }
        // The fringe of walls: what an opening by a square takes off slanted walls.
        let reach = side / 2 + 1;
        let near = grow(&wall, width, reach);
        let rest: Vec<u8> = dark.iter().zip(&wall).map(|(&d, &w)| u8::from(d != 0 && w == 0)).collect();
        let pieces = Components::of(&rest, width, 1, Neighbours::Eight);
        let touching = grow(&wall, width, 1);
        for piece in &pieces.all {
            let pixels = || pieces.runs(piece).iter().flat_map(|r| (r.from..r.to).map(move |x| (r.y, x)));
            let index = |(y, x): (u32, u32)| y as usize * width + x as usize;
            if pixels().all(|p| near[index(p)] != 0) && pixels().any(|p| touching[index(p)] != 0) {
                pieces.paint(piece, &mut wall, width, 1);
            }
        }
        trim(&mut wall, raw, ink, width, &doors, &windows);
        let mut inside = enclosed(&wall, &doors, &windows, width);
        doors.retain(|gap| {
            let is_kept = !unusual.contains(&gap.ends) || gap.leads_out(&inside);
            if !is_kept {
                gap.pixels().into_iter().for_each(|at| inside[at] = 1);
            }
            is_kept
        });
        // Between columns within a hall stand rails, steps and benches.
        let columns = columns(&wall, width, LONGEST_COLUMN_M / metres_per_pixel);
        let is_within = |gap: &Gap| gap.ends.iter().all(|&at| columns[at] != 0) && !gap.leads_out(&inside);
        let within: Vec<Gap> = [&mut doors, &mut windows]
            .map(|gaps| gaps.extract_if(.., |gap| is_within(gap)))
            .into_iter()
            .flatten()
            .collect();
        within.iter().flat_map(Gap::pixels).for_each(|at| inside[at] = 1 - wall[at]);
        // Gates of a hall that has no other way in, not the windows of a house.
        let is_single = |gap: &Gap| gap.strokes == 1;
        let is_gate = |gap: &Gap| is_single(gap) && gap.length() >= px(NARROWEST_GATE_M);
        let only_gates = windows.iter().filter(|gap| is_single(gap)).all(is_gate);
        if only_gates && !doors.iter().any(|gap| gap.leads_out(&inside)) {
            doors.extend(windows.extract_if(.., |gap| is_gate(gap)));
        }
        let may_open = |gap: &Gap| is_single(gap) && share(gap, hints.panes) < PANE_SHARE;
        doubtful::open_closed_rooms(
            &mut doors,
            &mut windows,
            &inside,
            width,
            LEAST_ROOM_M2 / (metres_per_pixel * metres_per_pixel),
            may_open,
        );
        let mut net = Net { wall, doors, windows, inside, enclosed: 0.0 };
        net.enclosed = net.inside_px() / least_box(&net.wall, width, kept).max(1.0);
        Some(net)
    }

    /// Share of the inside that its doors join.
    pub(super) fn joined(&self, width: usize) -> f64 {
        let mut free = self.inside.clone();
        self.doors.iter().flat_map(Gap::pixels).for_each(|at| free[at] = 1);
        let mut built: Vec<u8> = free.iter().zip(&self.wall).map(|(&free, &wall)| free | wall).collect();
        self.windows.iter().flat_map(Gap::pixels).for_each(|at| built[at] = 1);
        joined(&free, &built, width)
    }

    /// Area of the inside, pixels.
    pub(super) fn inside_px(&self) -> f64 {
        self.inside.iter().filter(|&&inside| inside != 0).count() as f64
    }

    /// Number of the doors that lead outside.
    pub(super) fn ways_out(&self) -> usize {
        self.doors.iter().filter(|gap| gap.leads_out(&self.inside)).count()
    }

    /// Whether the net encloses rooms as a building does.
    pub(super) fn is_building(&self) -> bool {
        self.enclosed >= ENCLOSED_SHARE
    }
}

/// Share of what is `free` that is connected, 1 each; of buildings that stand apart, as floors on one sheet do, within each.
/// `built` marks walls and all within.
pub(super) fn joined(free: &[u8], built: &[u8], width: usize) -> f64 {
    /// Least share of all that a building has.
    const LEAST: f64 = 0.2;
    let buildings = Components::of(built, width, 1, Neighbours::Eight);
    let building_at = buildings.index(width);
    let pieces = Components::of(free, width, 1, Neighbours::Four);
    // All of a building, and its largest piece.
    let mut areas = vec![[0usize; 2]; buildings.all.len()];
    for piece in &pieces.all {
        let Some(building) = building_at(pieces.first(piece, width)) else { continue };
        let [all, largest] = &mut areas[building];
        (*all, *largest) = (*all + piece.area, piece.area.max(*largest));
    }
    let all = areas.iter().map(|[all, _]| all).sum::<usize>() as f64;
    let large = areas.iter().filter(|[of_building, _]| *of_building as f64 >= LEAST * all);
    if all > 0.0 { large.map(|[_, largest]| largest).sum::<usize>() as f64 / all } else { 1.0 }
}

/// Whether people reach most of the floor inside; if not, doors were not understood.
pub(super) fn is_connected(classes: &[PlanClass], inside: &[u8], width: usize) -> bool {
    let free =
        |(class, &inside): (&PlanClass, &u8)| u8::from(*class == PlanClass::Door || (inside != 0 && !class.is_solid()));
    let free: Vec<u8> = classes.iter().zip(inside).map(free).collect();
    let is_built = |(class, &inside): (&PlanClass, &u8)| {
        u8::from(inside != 0 || matches!(class, PlanClass::Wall | PlanClass::Window | PlanClass::Door))
    };
    let built: Vec<u8> = classes.iter().zip(inside).map(is_built).collect();
    joined(&free, &built, width) >= CONNECTED
}

/// What is drawn beside walls.
fn strokes_of(ink: &[u8], wall: &[u8]) -> Vec<u8> {
    ink.iter().zip(wall).map(|(&i, &w)| u8::from(i != 0 && w == 0)).collect()
}

/// Takes off a wall mask what lies along a side of the windows of walls that are as thick as a square: a line of a window and
/// the edge of a bed or counter before it are together as thick as thin walls.
fn clear_windows(wall: &mut [u8], ink: &[u8], width: usize, limits: &Limits, square: usize) {
    let thick = open(wall, width, square);
    let limits = Limits { thinnest: square, ..*limits };
    let windows = gaps::find_upright(&thick, &strokes_of(ink, &thick), width, &limits);
    // Thin walls go on in the middle of thick ones; lines of a paving cross there.
    let is_free = |gap: &&Gap| {
        let ([from, to], across) = gap.middle();
        let share = |mask: &[u8], across: f64| {
            let on = (from as usize..to as usize).filter_map(|at| gap.pixel(at as f64 + 0.5, across));
            on.filter(|&at| mask[at] != 0).count() as f64 / (to - from)
        };
        let rows = gap.thickness();
        let is_crossed = |row: &f64| (CROSSED[0]..CROSSED[1]).contains(&share(ink, across - 0.5 * rows + row + 0.5));
        let crossed = (0..rows as usize).map(|row| row as f64).filter(is_crossed).count() as f64;
        share(wall, across) == 0.0 && crossed <= MOST_CROSSED * rows
    };
    let windows = windows.iter().filter(|gap| gap.strokes >= 2).filter(is_free);
    let cleared: Vec<usize> = windows.flat_map(Gap::pixels).filter(|&at| thick[at] == 0).collect();
    cleared.into_iter().for_each(|at| wall[at] = 0);
}

/// Takes the leaves of sliding entrances off a wall mask: bars that stand alone in a gap of a thicker wall. They are
/// up to so long and thick, pixels.
fn drop_leaves(
    wall: &mut [u8],
    ink: &[u8],
    width: usize,
    limits: &Limits,
    [longest, thickest]: [usize; 2],
    is_entrance: impl Fn(&Gap) -> bool,
) {
    /// Least length of a leaf in its thicknesses, and share of it that lies within the gap.
    const SLENDER: f64 = 3.0;
    const WITHIN: f64 = 0.95;
    let pieces = Components::of(wall, width, 1, Neighbours::Eight);
    let is_bar = |piece: &&Component| {
        let [w, h] = piece.size().map(f64::from);
        let (length, thick) = ((w * w + h * h).sqrt(), bend(pieces.runs(piece)));
        length <= longest as f64 && thick <= thickest as f64 && length >= SLENDER * thick
    };
    let bars: Vec<&Component> = pieces.all.iter().filter(is_bar).collect();
    if bars.is_empty() {
        return;
    }
    let mut rest = wall.to_vec();
    bars.iter().for_each(|bar| pieces.paint(bar, &mut rest, width, 0));
    for gap in gaps::find(&rest, &strokes_of(ink, &rest), width, limits).iter().filter(|gap| is_entrance(gap)) {
        let within: std::collections::BTreeSet<usize> = gap.pixels().into_iter().collect();
        for bar in &bars {
            let pixels = pieces.runs(bar).iter().flat_map(|run| {
                let row = run.y as usize * width;
                row + run.from as usize..row + run.to as usize
            });
            let inside = pixels.filter(|at| within.contains(at)).count() as f64;
            if inside >= WITHIN * bar.area as f64 && bend(pieces.runs(bar)) <= LEAF_IN_WALLS * gap.thickness() {
                pieces.paint(bar, wall, width, 0);
            }
        }
    }
}

/// Area of the least rectangle of any direction around the walls within a box, square pixels.
fn least_box(wall: &[u8], width: usize, [x0, y0, x1, y1]: [u32; 4]) -> f64 {
    const TURNS: i32 = 18;
    let mut rim: Vec<[f64; 2]> = Vec::new();
    for y in y0..y1 {
        let row = &wall[y as usize * width..][x0 as usize..x1 as usize];
        if let (Some(first), Some(last)) = (row.iter().position(|&w| w != 0), row.iter().rposition(|&w| w != 0)) {
            rim.extend([first, last + 1].map(|x| [x as f64, f64::from(y)]));
        }
    }
    let side = |way: [f64; 2]| {
        let at = rim.iter().map(|[x, y]| x * way[0] + y * way[1]);
        let range = at.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
        range[1] - range[0]
    };
    let turned = (0..TURNS).map(|k| {
        let (sine, cosine) = sin_cos(std::f64::consts::FRAC_PI_2 * f64::from(k) / f64::from(TURNS));
        side([cosine, sine]) * side([-sine, cosine])
    });
    turned.fold(f64::INFINITY, f64::min)
}

/// Leaves the pieces of a wall mask that belong to the building: those joined by doors and windows to the most wall,
/// columns among them, and other buildings. Returns the box around the main one.
fn keep_building(wall: &mut [u8], raw: &[u8], width: usize, doors: &[Gap], windows: &[Gap]) -> Option<[u32; 4]> {
    let pieces = Components::of(wall, width, 1, Neighbours::Eight);
    let piece_at = pieces.index(width);
    let mut group: Vec<usize> = (0..pieces.all.len()).collect();
    fn top(group: &[usize], mut k: usize) -> usize {
        while group[k] != k {
            k = group[k];
        }
        k
    }
    let mut join = |a: usize, b: usize| {
        let [a, b] = [a, b].map(|k| top(&group, k));
        group[a.max(b)] = a.min(b);
    };
    for gap in doors.iter().chain(windows) {
        if let [Some(a), Some(b)] = gap.ends.map(&piece_at) {
            join(a, b);
        }
    }
    // A partition may end a little before the panes of a glass front.
    for window in windows {
        let is_level = window.along()[0].abs() > window.along()[1].abs();
        let is_partition = |&k: &usize| {
            let [w, h] = pieces.all[k].size().map(f64::from);
            let across = if is_level { h } else { w };
            across >= PARTITION_SLENDER * window.thickness()
                && pieces.all[k].area as f64 <= (w + h) * window.thickness()
        };
        let beside = [BESIDE_PANE_PX, BESIDE_PANE_PX * width];
        let near = |at: usize| beside.into_iter().flat_map(move |by| [at.wrapping_sub(by), at + by]);
        let Some(jamb) = piece_at(window.ends[0]) else { continue };
        window
            .pixels()
            .into_iter()
            .flat_map(near)
            .filter_map(&piece_at)
            .filter(is_partition)
            .for_each(|k| join(jamb, k));
    }
    let tops: Vec<usize> = (0..group.len()).map(|k| top(&group, k)).collect();
    let mut area = vec![0usize; group.len()];
    let mut around = vec![[u32::MAX, u32::MAX, 0, 0]; group.len()];
    for (piece, &top) in pieces.all.iter().zip(&tops) {
        area[top] += piece.area;
        let b = &mut around[top];
        *b = [b[0].min(piece.min[0]), b[1].min(piece.min[1]), b[2].max(piece.end[0]), b[3].max(piece.end[1])];
    }
    // Panels of a screen and filled boxes enclose nothing.
    let is_mass = |k: usize| {
        let [x0, y0, x1, y1] = around[k].map(f64::from);
        area[k] as f64 > MASS_FILL * (x1 - x0) * (y1 - y0)
    };
    let mut order: Vec<usize> = (0..area.len()).filter(|&k| area[k] > 0).collect();
    order.sort_by_key(|&k| (is_mass(k), std::cmp::Reverse(area[k]), k));
    let main = *order.first()?;
    let box_of = around[main];
    // The shadow of a scanner's lid lies along the image's sides, and no door joins it to the building.
    let height = wall.len() / width;
    let rim = ((SHADOW_SHARE * width.max(height) as f64) as usize).min(width.min(height) / 2);
    let is_shadow = |piece: &Component| {
        let along = pieces.runs(piece).iter().map(|run| {
            let (y, [from, to]) = (run.y as usize, [run.from, run.to].map(|x| x as usize));
            let beside = rim.clamp(from, to) - from + to - (width - rim).clamp(from, to);
            if y < rim || y >= height - rim { to - from } else { beside }
        });
        along.sum::<usize>() as f64 >= SHADOW_IN_RIM * piece.area as f64
    };
    let inside = |p: &Component| {
        p.min[0] >= box_of[0] && p.min[1] >= box_of[1] && p.end[0] <= box_of[2] && p.end[1] <= box_of[3]
    };
    for (piece, &top) in pieces.all.iter().zip(&tops) {
        let ink = || {
            let dark = |r: &Run| {
                let row = r.y as usize * width;
                raw[row + r.from as usize..row + r.to as usize].iter().filter(|&&d| d != 0).count()
            };
            pieces.runs(piece).iter().map(dark).sum::<usize>() as f64
        };
        let other_building = area[top] * 5 >= area[main] && !is_mass(top) && !is_shadow(piece);
        let column = inside(piece) && ink() >= COLUMN_INK * piece.area as f64;
        if top != main && !other_building && !column {
            pieces.paint(piece, wall, width, 0);
        }
    }
    Some(box_of)
}

/// Takes off the rim of filled walls where it is ink but not dark: less than half of such a pixel is wall. At gaps it stays:
/// a jamb of another colour leaves no slit.
fn trim(wall: &mut [u8], raw: &[u8], ink: &[u8], width: usize, doors: &[Gap], windows: &[Gap]) {
    let at_gap = gaps::mask(doors.iter().chain(windows), wall.len());
    let beside = |at: usize| [at.wrapping_sub(1), at + 1, at.wrapping_sub(width), at + width].into_iter();
    let is_rim = |at: usize| {
        wall[at] != 0
            && raw[at] == 0
            && ink[at] != 0
            && beside(at).any(|b| wall.get(b).is_some_and(|&w| w == 0))
            && !beside(at).any(|b| is_on(&at_gap, b))
    };
    let rim: Vec<usize> = (0..wall.len()).filter(|&at| is_rim(at)).collect();
    for at in rim {
        wall[at] = 0;
    }
}

/// The pieces of a wall mask that stand alone and are about as long as thick, up to `longest` pixels.
fn columns(wall: &[u8], width: usize, longest: f64) -> Vec<u8> {
    let pieces = Components::of(wall, width, 1, Neighbours::Eight);
    let mut columns = vec![0; wall.len()];
    let is_column = |piece: &&Component| {
        let [w, h] = piece.size().map(f64::from);
        w.max(h) <= longest && w.max(h) <= COLUMN_SLENDER * w.min(h)
    };
    pieces.all.iter().filter(is_column).for_each(|piece| pieces.paint(piece, &mut columns, width, 1));
    columns
}

/// Takes off what is smaller than a square of `side`: crossings of strokes.
fn drop_crumbs(wall: &mut [u8], width: usize, side: f64) {
    let pieces = Components::of(wall, width, 1, Neighbours::Eight);
    for piece in pieces.all.iter().filter(|p| (p.area as f64) < side * side) {
        pieces.paint(piece, wall, width, 0);
    }
}

/// Marks what neither walls nor doors nor windows are and what the image's sides do not reach.
fn enclosed(wall: &[u8], doors: &[Gap], windows: &[Gap], width: usize) -> Vec<u8> {
    let height = wall.len() / width;
    let mut free: Vec<u8> = wall.iter().map(|&w| u8::from(w == 0)).collect();
    for at in doors.iter().chain(windows).flat_map(|gap| gap.pixels()) {
        free[at] = 0;
    }
    let pieces = Components::of(&free, width, 1, Neighbours::Four);
    for piece in &pieces.all {
        if piece.is_at_side(width, height) {
            pieces.paint(piece, &mut free, width, 0);
        }
    }
    free
}
