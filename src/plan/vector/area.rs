//! Areas of a drawing as loops on a fine grid, and how much of each pixel they cover.

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::{IntOverlayOptions, Overlay};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;

use super::piece::signed_area;
use crate::math::{Rect, Vec2, vec2};

/// Steps of the grid in a metre: fine enough that a rounded corner is not seen, coarse enough for the integers.
const STEPS_PER_M: f64 = (1u32 << 16) as f64;

type Point = IntPoint<i64>;

/// An area with holes: outer loops counter-clockwise, holes clockwise, metres.
#[derive(Clone, Debug, Default)]
pub(super) struct Area {
    shapes: Vec<Vec<Vec<Point>>>,
}

impl Area {
    /// What any of these shapes covers. A shape of several loops has holes where loops lie in others.
    pub(super) fn union(shapes: impl IntoIterator<Item = Vec<Vec<Vec2>>>) -> Area {
        let mut contours = Vec::new();
        for mut loops in shapes {
            loops.retain(|points| points.len() > 2);
            match &mut loops[..] {
                [] => {}
                [one] if !crosses_itself(one) => {
                    if signed_area(one) < 0.0 {
                        one.reverse();
                    }
                    contours.push(one.iter().copied().map(steps).collect());
                }
                many => {
                    let own = vec![many.iter().map(|points| points.iter().copied().map(steps).collect()).collect()];
                    contours.extend(Area::tidied(&own, FillRule::EvenOdd).into_iter().flatten());
                }
            }
        }
        Area { shapes: Area::tidied(&vec![contours], FillRule::NonZero) }
    }

    fn tidied(shapes: &Vec<Vec<Vec<Point>>>, rule: FillRule) -> Vec<Vec<Vec<Point>>> {
        let mut overlay = Overlay::from_subj_custom(shapes, IntOverlayOptions::default(), Default::default());
        overlay.overlay(OverlayRule::Subject, rule)
    }

    /// Without another area.
    pub(super) fn minus(&self, other: &Area) -> Area {
        if other.shapes.is_empty() || self.shapes.is_empty() {
            return self.clone();
        }
        let options = IntOverlayOptions::default();
        let mut overlay = Overlay::from_subj_and_clip_custom(&self.shapes, &other.shapes, options, Default::default());
        Area { shapes: overlay.overlay(OverlayRule::Difference, FillRule::NonZero) }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    /// All loops, the area on their left, metres.
    pub(super) fn loops(&self) -> impl Iterator<Item = Vec<Vec2>> + '_ {
        self.shapes.iter().flatten().map(|contour| contour.iter().copied().map(metres).collect())
    }
}

/// Whether two edges of a loop with few corners cross; loops of many corners are taken to.
fn crosses_itself(points: &[Vec2]) -> bool {
    const FEW: usize = 40;
    let n = points.len();
    if n > FEW {
        return true;
    }
    let edge = |k: usize| (points[k], points[(k + 1) % n]);
    let side = |(a, b): (Vec2, Vec2), p: Vec2| (b - a).cross(p - a);
    let cross =
        |e: (Vec2, Vec2), f: (Vec2, Vec2)| side(e, f.0) * side(e, f.1) < 0.0 && side(f, e.0) * side(f, e.1) < 0.0;
    (0..n).any(|i| (i + 2..n).any(|j| cross(edge(i), edge(j))))
}

fn steps(p: Vec2) -> Point {
    let step = |v: f64| (v * STEPS_PER_M).round() as i64;
    Point::new(step(p.x), step(p.y))
}

fn metres(p: Point) -> Vec2 {
    vec2(p.x as f64 / STEPS_PER_M, p.y as f64 / STEPS_PER_M)
}

/// The pixels of a plan, in image order: row 0 at the top.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    pub(super) bounds: Rect,
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) metres_per_pixel: f64,
}

impl Grid {
    /// From metres to pixels, whole numbers at pixel edges.
    pub(super) fn px(&self, p: Vec2) -> Vec2 {
        let top = self.bounds.min.y + self.height as f64 * self.metres_per_pixel;
        vec2(p.x - self.bounds.min.x, top - p.y) / self.metres_per_pixel
    }

    /// The pixel at a place in metres.
    pub(super) fn index(&self, p: Vec2) -> Option<usize> {
        let p = self.px(p);
        let inside = p.x >= 0.0 && p.y >= 0.0 && p.x < self.width as f64 && p.y < self.height as f64;
        inside.then(|| p.y as usize * self.width + p.x as usize)
    }
}

/// How much of each pixel shapes cover. Of each row of pixels it holds the stretch that their edges reach.
pub(super) struct Coverage {
    rows: Vec<Stretch>,
    share: Vec<f32>,
}

/// Pixels of a row, one after the other in image order.
struct Stretch {
    row: usize,
    column: usize,
    /// Its place among the shares.
    start: usize,
    end: usize,
}

/// A piece of an edge within one row: from `x0` to `x1`, `tall` of the row's height.
struct Step {
    row: usize,
    x0: f64,
    x1: f64,
    tall: f64,
}

impl Coverage {
    /// Exact share of each pixel that loops cover, which have their area on the same side and do not overlap.
    ///
    /// Coordinates are pixels, y down. Each edge adds to a row how far right of it the row's pixels lie; summed from
    /// the left, that is the share.
    pub(super) fn of(loops: &[Vec<Vec2>], width: usize, height: usize) -> Coverage {
        let all = || loops.iter().flatten();
        let least = |of: fn(&Vec2) -> f64| all().map(of).fold(f64::INFINITY, f64::min).max(0.0);
        let most = |of: fn(&Vec2) -> f64, end: usize| all().map(of).fold(0.0, f64::max).min(end as f64).ceil() as usize;
        let from = [(least(|p| p.x) as usize).min(width), (least(|p| p.y) as usize).min(height)];
        let to = [most(|p| p.x, width).max(from[0]), most(|p| p.y, height).max(from[1])];
        let each_step = |each: &mut dyn FnMut(Step)| {
            for points in loops {
                (0..points.len()).for_each(|k| cut(from, to, points[k], points[(k + 1) % points.len()], each));
            }
        };
        let mut reach = vec![[usize::MAX, 0]; to[1] - from[1]];
        each_step(&mut |step| {
            let [first, last] = &mut reach[step.row];
            (*first, *last) = ((*first).min(step.x0 as usize), (*last).max(step.x1 as usize + 1));
        });
        let mut rows = Vec::with_capacity(reach.len());
        let mut start = 0;
        for (row, [first, last]) in reach.into_iter().enumerate() {
            let column = first.min(last);
            let end = start + last + 1 - column;
            rows.push(Stretch { row: from[1] + row, column, start, end });
            start = end;
        }
        let mut share = vec![0f32; start];
        each_step(&mut |step| {
            let stretch = &rows[step.row];
            add(&mut share[stretch.start..stretch.end], stretch.column, &step);
        });
        for stretch in &mut rows {
            let mut sum = 0.0;
            for step in &mut share[stretch.start..stretch.end] {
                sum += *step;
                *step = sum.abs().min(1.0);
            }
            // Columns beyond the last take what lies right of all edges.
            stretch.end = stretch.end.min(stretch.start + (to[0] - from[0]).saturating_sub(stretch.column));
            stretch.column += from[0];
        }
        Coverage { rows, share }
    }

    /// Number of pixels that it holds.
    pub(super) fn pixels(&self) -> usize {
        self.share.len()
    }

    /// Calls with the index of each pixel that is covered, and its share.
    pub(super) fn for_each(&self, width: usize, mut each: impl FnMut(usize, f32)) {
        for stretch in &self.rows {
            let start = stretch.row * width + stretch.column;
            let shares = self.share[stretch.start..stretch.end].iter().enumerate();
            shares.filter(|(_, share)| **share > 1e-3).for_each(|(k, share)| each(start + k, *share));
        }
    }
}

/// Cuts an edge into its pieces in the rows `from..to`, columns counted from the first.
fn cut(from: [usize; 2], to: [usize; 2], a: Vec2, b: Vec2, each: &mut dyn FnMut(Step)) {
    let (sign, top, bottom) = if a.y < b.y { (1.0, a, b) } else { (-1.0, b, a) };
    let height = bottom.y - top.y;
    if height <= 0.0 {
        return;
    }
    let slope = (bottom.x - top.x) / height;
    let (left, right) = (from[0] as f64, to[0] as f64);
    let first = top.y.max(from[1] as f64);
    let last = bottom.y.min(to[1] as f64);
    // Where the edge enters or leaves the picture at its left or right side.
    let crossings = [left, right].map(|side| top.y + (side - top.x) / slope);
    let mut y = first;
    while y < last {
        let row = y as usize;
        let turns = crossings.into_iter().filter(|at| *at > y).fold(last, f64::min);
        let next = ((row + 1) as f64).min(turns);
        let at = |y: f64| (top.x + (y - top.y) * slope).clamp(left, right) - left;
        let (x0, x1) = (at(y), at(next));
        each(Step { row: row - from[1], x0: x0.min(x1), x1: x0.max(x1), tall: sign * (next - y) });
        y = next;
    }
}

/// Adds a piece of an edge to a stretch of its row that begins at a column.
fn add(shares: &mut [f32], column: usize, &Step { x0, x1, tall, .. }: &Step) {
    let (first, last) = (x0 as usize, x1 as usize);
    if first == last {
        // Right of the edge lies all of the pixel but the mean of its ends.
        let beyond = 1.0 - ((x0 + x1) * 0.5 - first as f64);
        shares[first - column] += (tall * beyond) as f32;
        shares[first + 1 - column] += (tall * (1.0 - beyond)) as f32;
        return;
    }
    let per_x = tall / (x1 - x0);
    let mut before = 0.0;
    for pixel in first..=last {
        let (from, to) = (x0.max(pixel as f64), x1.min((pixel + 1) as f64));
        let share = (to - from) * per_x;
        let beyond = share * (1.0 - ((from + to) * 0.5 - pixel as f64));
        // This pixel gets what lies right of the edge in it, and all of what crossed before.
        shares[pixel - column] += (beyond + before) as f32;
        before = share - beyond;
    }
    shares[last + 1 - column] += before as f32;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shares(loops: &[Vec<Vec2>], width: usize, height: usize) -> Vec<f32> {
        let mut out = vec![0.0; width * height];
        Coverage::of(loops, width, height).for_each(width, |at, share| out[at] = share);
        out
    }

    #[test]
    fn each_pixel_gets_the_share_that_is_covered() {
        let square = vec![vec2(0.5, 0.25), vec2(2.5, 0.25), vec2(2.5, 1.75), vec2(0.5, 1.75)];
        assert_eq!(shares(&[square], 3, 2), [0.375, 0.75, 0.375, 0.375, 0.75, 0.375]);
        let triangle = vec![vec2(0.0, 0.0), vec2(4.0, 0.0), vec2(0.0, 2.0)];
        let got = shares(std::slice::from_ref(&triangle), 4, 2);
        for (got, want) in got.iter().zip([1.0, 1.0, 0.75, 0.25, 0.75, 0.25, 0.0, 0.0]) {
            assert!((got - want).abs() < 1e-6, "{got} instead of {want}");
        }
        let moved: Vec<Vec2> = triangle.iter().map(|p| *p - vec2(1.0, 0.0)).collect();
        let got = shares(&[moved], 4, 2);
        for (got, want) in got.iter().zip([1.0, 0.75, 0.25, 0.0, 0.25, 0.0, 0.0, 0.0]) {
            assert!((got - want).abs() < 1e-6, "{got} instead of {want}, cut on the left");
        }
    }

    #[test]
    fn a_thin_slanted_line_holds_the_pixels_beside_it_only() {
        let band = vec![vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(2000.0, 1000.0), vec2(1998.0, 1000.0)];
        let coverage = Coverage::of(&[band], 2000, 1000);
        assert!(coverage.pixels() < 8000, "{} of 2 million", coverage.pixels());
        let mut all = 0.0;
        coverage.for_each(2000, |at, share| {
            assert!((at % 2000).abs_diff(at / 2000 * 2) < 6);
            all += f64::from(share);
        });
        assert!((all - 2000.0).abs() < 1.0, "{all}");
    }

    #[test]
    fn overlapping_shapes_become_one_and_loops_inside_are_holes() {
        let square =
            |x: f64, side: f64| vec![vec2(x, x), vec2(x + side, x), vec2(x + side, x + side), vec2(x, x + side)];
        let area = |area: &Area| area.loops().map(|l| signed_area(&l)).sum::<f64>();
        let both = Area::union([vec![square(0.0, 2.0)], vec![square(1.0, 2.0)]]);
        assert!((area(&both) - 7.0).abs() < 1e-3);
        let ring = Area::union([vec![square(0.0, 4.0), square(1.0, 2.0)]]);
        assert!((area(&ring) - 12.0).abs() < 1e-3);
        assert!((area(&ring.minus(&Area::union([vec![square(-1.0, 2.0)]]))) - 11.0).abs() < 1e-3);
    }
}
