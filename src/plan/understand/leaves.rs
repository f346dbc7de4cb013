//! Leaves and arcs of doors whose gaps are known.

use super::gaps::Gap;
use crate::math::sin_cos;

/// Least share of an arc that is drawn.
const DRAWN: f64 = 0.7;
/// Radii of arcs, as shares of the gap's length: one leaf, or two.
const RADII: [f64; 9] = [1.0, 0.95, 1.05, 0.9, 1.1, 0.5, 0.47, 0.53, 0.85];
/// Places along an arc that are looked at.
const PLACES: usize = 24;

/// Least share of a leaf that is drawn, and of its arc, where lines close the gap as in a window.
const LEAF_DRAWN: f64 = 0.85;
const ARC_DRAWN: f64 = 0.9;
/// How far a leaf is from the line through its hinge, metres and pixels.
const LEAF_M: f64 = 0.07;
const LEAF_PX: f64 = 2.5;

/// A quarter circle of ink about an end of a gap, in the gap's frame.
struct Arc {
    /// Where the hinge is along the wall and across it.
    hinge: [f64; 2],
    /// 1 or -1: the way along the wall in which the closed leaf lies, and across it that in which it opens.
    ways: [f64; 2],
    radius: f64,
    /// Share that is drawn of what lies beyond the wall's face.
    drawn: f64,
}

/// Finds the arcs of a door's leaves: the best one for each hinge and side of the wall.
fn arcs(gap: &Gap, ink: &[u8], metres_per_pixel: f64) -> Vec<Arc> {
    let ([from, to], middle) = gap.middle();
    let (length, thick) = (to - from, gap.thickness());
    let slack = slack(metres_per_pixel);
    let directions: [(f64, f64); PLACES] =
        std::array::from_fn(|k| sin_cos(std::f64::consts::FRAC_PI_2 * (k as f64 + 0.5) / PLACES as f64));
    let mut found = Vec::new();
    for (hinge, way) in [(from, 1.0), (to, -1.0)] {
        for side in [-1.0, 1.0] {
            // Share of an arc that is drawn, if that is enough and more than `most`.
            let drawn = |across: f64, radius: f64, most: f64| {
                let is_beyond = |&&(sine, _): &&(f64, f64)| side * (across - middle) + radius * sine >= 0.5 * thick;
                let seen = directions.iter().filter(is_beyond).count();
                if 2 * seen < PLACES {
                    return None;
                }
                let mut left = seen;
                for &(sine, cosine) in directions.iter().filter(is_beyond) {
                    left -= usize::from(!(-3..=3).any(|step| {
                        let r = radius + slack * f64::from(step) / 3.0;
                        gap.pixel(hinge + way * r * cosine, across + side * r * sine).is_some_and(|at| ink[at] != 0)
                    }));
                    let share = left as f64 / seen as f64;
                    if share <= most || share < DRAWN {
                        return None;
                    }
                }
                Some(left as f64 / seen as f64)
            };
            let mut best: Option<Arc> = None;
            // The hinge may be at either face of the wall or between: what lies in the wall is not drawn.
            for face in [0.5, 0.0, 0.25, -0.25, -0.5] {
                for radius in RADII.map(|share| length * share) {
                    let across = middle + side * thick * face;
                    let most = best.as_ref().map_or(0.0, |best| best.drawn);
                    if let Some(drawn) = drawn(across, radius, most) {
                        best = Some(Arc { hinge: [hinge, across], ways: [way, side], radius, drawn });
                    }
                }
            }
            found.extend(best);
        }
    }
    found
}

/// How far from an arc its stroke may be, pixels.
fn slack(metres_per_pixel: f64) -> f64 {
    (0.03 / metres_per_pixel).max(1.5)
}

/// Lengths of a gap's leaves, pixels: those with an arc and the straight stroke from the hinge to its far end. Furniture
/// behind a window may look like an arc.
pub(super) fn hung(gap: &Gap, ink: &[u8], metres_per_pixel: f64) -> Vec<f64> {
    let (_, middle) = gap.middle();
    let beside = (LEAF_M / metres_per_pixel).max(LEAF_PX).round() as i32;
    let has_leaf = |arc: &&Arc| {
        let ([hinge, across], [way, side]) = (arc.hinge, arc.ways);
        // Beyond the wall's face.
        let least = (0.5 * gap.thickness() - side * (across - middle)).max(0.0) + 1.0;
        let places = || (0..PLACES).map(|k| least + (0.95 * arc.radius - least) * (k as f64 + 0.5) / PLACES as f64);
        let on_line = |aside: i32, place: f64| {
            let at = gap.pixel(hinge + way * f64::from(aside), across + side * place);
            at.is_some_and(|at| ink[at] != 0)
        };
        let share = |aside: i32| {
            places().filter(|&place| on_line(aside, place) || on_line(aside + 1, place)).count() as f64 / PLACES as f64
        };
        (-beside..beside).any(|aside| share(aside) >= LEAF_DRAWN)
    };
    let arcs = arcs(gap, ink, metres_per_pixel);
    arcs.iter().filter(|arc| arc.drawn >= ARC_DRAWN).filter(has_leaf).map(|arc| arc.radius).collect()
}

/// The hinge and the far end of the open leaf whose arc is drawn best, pixels of the image.
pub(super) fn open_leaf(gap: &Gap, ink: &[u8], metres_per_pixel: f64) -> Option<[[f64; 2]; 2]> {
    let arcs = arcs(gap, ink, metres_per_pixel);
    let best = arcs.iter().reduce(|best, arc| if arc.drawn > best.drawn { arc } else { best })?;
    let [hinge, across] = best.hinge;
    Some([[hinge, across], [hinge, across + best.ways[1] * best.radius]].map(|at| gap.place(at)))
}

/// Lists the pixels of a door's leaves and arcs: quarter circles about an end of the gap, and the way to their far end.
pub(super) fn symbol(gap: &Gap, ink: &[u8], metres_per_pixel: f64) -> Vec<usize> {
    let slack = slack(metres_per_pixel);
    let mut found = Vec::new();
    for Arc { hinge: [hinge, across], ways: [way, side], radius, .. } in arcs(gap, ink, metres_per_pixel) {
        // The ring, and the leaf that is swung open.
        let reach = radius + 2.0 * slack + 2.0;
        let (wide, leaf) = (slack + 1.5, (LEAF_M / metres_per_pixel).max(LEAF_PX));
        let steps = reach.ceil() as i32 + 3;
        let pixel = |a: f64, b: f64| gap.pixel(hinge + way * a, across + side * b).filter(|&at| ink[at] != 0);
        // What stands near the leaf's end is no part of it.
        let is_drawn = |b: f64| (-6..=(2.0 * leaf) as i32).any(|a| pixel(f64::from(a) * 0.5, b).is_some());
        let mut beyond = (0..).map(|k| radius + 0.5 * f64::from(k)).take_while(|&b| b <= reach);
        let end = beyond.find(|&b| !is_drawn(b)).unwrap_or(reach);
        // Half steps, so that slanted grids meet all pixels.
        for a in -6..=2 * steps {
            for b in -6..=2 * steps {
                let (a, b) = (f64::from(a) * 0.5, f64::from(b) * 0.5);
                let distance = (a * a + b * b).sqrt();
                let on_ring = (distance - radius).abs() <= wide;
                let on_leaf = a <= leaf && b <= end;
                if (on_ring || on_leaf)
                    && let Some(at) = pixel(a, b)
                {
                    found.push(at);
                }
            }
        }
    }
    found
}

/// Whether three or four wings turn about the middle of a gap, between the two shells of a drum.
pub(super) fn revolves(gap: &Gap, ink: &[u8]) -> bool {
    /// Degrees between directions that are looked at; how wide a wing is at most, and how uneven wings stand.
    const STEP: usize = 2;
    const WIDEST: usize = 24;
    const UNEVEN: usize = 12;
    /// How far off the gap's middle wings meet at most, as a share of half the gap, and in which steps places are tried.
    const MEET: f64 = 0.2;
    const STEPS: i32 = 3;
    /// Radii at which wings are crossed, and between which the drum lies, as shares of half the gap.
    const CROSSED: [f64; 2] = [0.35, 0.6];
    const DRUM: [f64; 2] = [0.75, 1.35];
    /// Directions off the wall in which a shell is looked for, degrees; its least share, and greatest ratio of its radii.
    const SHELL: [i32; 4] = [25, 30, 35, 40];
    const SHELL_DRAWN: f64 = 0.75;
    const ROUND: f64 = 1.1;
    let ([from, to], across) = gap.middle();
    let half = 0.5 * (to - from);
    let is_drawn = |along: f64, across: f64| gap.pixel(along, across).is_some_and(|at| ink[at] != 0);
    // Wings meet in the middle: most doors are empty there.
    let reach = (MEET * half).ceil() as i32;
    let near = |x: i32, y: i32| is_drawn(from + half + f64::from(x), across + f64::from(y));
    if !(-reach..=reach).any(|y| (-reach..=reach).any(|x| near(x, y))) {
        return false;
    }
    let directions: Vec<(f64, f64)> = (0..360).map(|degrees| sin_cos(f64::from(degrees).to_radians())).collect();
    let is_ink = |[x, y]: [f64; 2], degrees: usize, radius: f64| {
        let (sine, cosine) = directions[degrees];
        is_drawn(x + radius * cosine, y + radius * sine)
    };
    // Directions of the wings that a circle crosses, degrees.
    let wings = |middle: [f64; 2], share: f64| -> Option<Vec<usize>> {
        let on: Vec<usize> = (0..360).step_by(STEP).filter(|&k| is_ink(middle, k, share * half)).collect();
        let starts = on.iter().copied().filter(|&k| !on.contains(&((k + 360 - STEP) % 360)));
        let wing = |start: usize| {
            let width = (0..360).step_by(STEP).find(|k| !on.contains(&((start + k) % 360)))?;
            (width <= WIDEST).then_some((start + width / 2) % 360)
        };
        let mut found: Vec<usize> = starts.map(wing).collect::<Option<_>>()?;
        found.sort_unstable();
        let count = found.len();
        let apart = |k: usize| (found[(k + 1) % count] + 360 - found[k]) % 360;
        let is_even = (3..=4).contains(&count) && (0..count).all(|k| apart(k).abs_diff(360 / count) <= UNEVEN);
        is_even.then_some(found)
    };
    let has_drum = |middle: [f64; 2], wings: &[usize]| {
        let sides = SHELL.into_iter().flat_map(|k| [k, -k, 180 + k, 180 - k]).map(|k| k.rem_euclid(360) as usize);
        let is_free = |k: &usize| wings.iter().all(|wing| wing.abs_diff(*k) > WIDEST / 2);
        let free: Vec<usize> = sides.filter(is_free).collect();
        let shell = |k: &usize| {
            let mut radii =
                (0..).map(|step| DRUM[0] * half + f64::from(step) * 0.5).take_while(|r| *r <= DRUM[1] * half);
            radii.find(|&radius| is_ink(middle, *k, radius))
        };
        let radii: Vec<f64> = free.iter().filter_map(shell).collect();
        let (least, most) = radii.iter().fold((f64::MAX, 0.0_f64), |(a, b), &r| (a.min(r), b.max(r)));
        radii.len() as f64 >= SHELL_DRAWN * free.len() as f64 && !radii.is_empty() && most <= ROUND * least
    };
    // The gap may be cut off beside the drum.
    (-STEPS..=STEPS).flat_map(|x| (-STEPS..=STEPS).map(move |y| [x, y])).any(|off| {
        let [x, y] = off.map(|step| f64::from(step) / f64::from(STEPS) * MEET * half);
        let middle = [from + half + x, across + y];
        let Some(inner) = wings(middle, CROSSED[0]) else { return false };
        let Some(outer) = wings(middle, CROSSED[1]) else { return false };
        let is_straight = inner.len() == outer.len() && inner.iter().zip(&outer).all(|(a, b)| a.abs_diff(*b) <= UNEVEN);
        is_straight && has_drum(middle, &inner)
    })
}
