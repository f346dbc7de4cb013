//! Walls and windows as areas: filled shapes, thick lines, centre lines, and what lies between two parallel lines.

use rustc_hash::FxHashMap;

use super::piece::{Piece, signed_area};
use crate::math::{Vec2, vec2};

/// Thickness of a wall that is drawn as one thin line, metres.
const USUAL_M: f64 = 0.1;
/// Distances between the two lines of a wall, metres.
const PAIR_M: std::ops::RangeInclusive<f64> = 0.03..=0.65;
/// Lines from this width on are walls as thick as they are drawn, metres.
const THICK_LINE_M: f64 = 0.045;
/// A closed shape of at most this thickness is a piece of wall, metres.
const THIN_M: f64 = 0.65;
/// A closed shape of at most this size is a column, metres.
const COLUMN_M: f64 = 1.5;
/// Lightness (luma) up to which a filled shape is solid, whatever its form.
const DARK: u32 = 200;
/// Interruptions of one of a wall's lines up to this length are branches, metres.
const BRANCH_M: f64 = 0.55;
/// Lines are parallel if the sine of the angle between them is at most this: 4 degrees.
const PARALLEL: f64 = 0.07;
/// Share of a line along which another one runs for the two to be a wall.
const PAIRED: f64 = 0.3;
/// Ends of lines closer than this meet, metres.
const MEET_M: f64 = 0.01;
/// Most ends in one place that make its corner full.
const MOST_MEETING: usize = 1000;
/// Side of a cell of the grid that finds neighbours, metres.
const CELL_M: f64 = 1.0;
/// Most entries of that grid.
const MOST_CELLS: usize = 8_000_000;

/// Most lines that are compared with all lines in their cells. So many, long and close, are no walls.
const MOST_COMPARED: usize = 300_000_000;

/// Whether curves count: windows and doors are drawn with swings, walls are not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Curves {
    Solid,
    LeftOut,
}

/// The shapes that pieces of walls or windows cover, in metres.
pub(super) fn shapes(pieces: &[&Piece], curves: Curves) -> Vec<Vec<Vec<Vec2>>> {
    let mut shapes = Vec::new();
    let mut thin: Vec<[Vec2; 2]> = Vec::new();
    let mut thick: Vec<([Vec2; 2], f64)> = Vec::new();
    for piece in pieces {
        if piece.curved && !piece.closed && curves == Curves::LeftOut {
            continue;
        }
        let width = piece.stroke.map_or(0.0, |stroke| stroke.width);
        let solid = is_solid(piece);
        if solid {
            shapes.push(piece.loops.clone());
        }
        if width >= THICK_LINE_M && piece.fill.is_none() {
            thick.extend(piece.segments().map(|segment| (segment, width)));
        } else if !solid {
            thin.extend(piece.segments());
        }
    }
    thin.retain(|[a, b]| a.distance(*b) > 1e-6);
    let centre = pairs(&thin, &mut shapes);
    thick.extend(centre.into_iter().map(|segment| (segment, USUAL_M)));
    bands(&thick, &mut shapes);
    shapes
}

/// Whether a closed shape is solid itself, rather than the outline of what walls enclose.
fn is_solid(piece: &Piece) -> bool {
    if !piece.closed {
        return false;
    }
    let luma = |[r, g, b]: [u8; 3]| (299 * u32::from(r) + 587 * u32::from(g) + 114 * u32::from(b)) / 1000;
    if piece.fill.is_some_and(|colour| luma(colour) <= DARK) {
        return true;
    }
    let bounds = piece.bounds();
    let thickness = 2.0 * piece.area_enclosed() / piece.perimeter().max(1e-9);
    thickness <= THIN_M || bounds.width().max(bounds.height()) <= COLUMN_M
}

/// Thickness of shapes that are walls for sure, metres or units: filled ones that are long and thin.
pub(super) fn thickness(piece: &Piece) -> Option<f64> {
    let [one] = &piece.loops[..] else { return None };
    if piece.fill.is_none() || !piece.closed {
        return piece.stroke.map(|stroke| stroke.width).filter(|width| *width > 0.0);
    }
    // Of a rectangle's half outline and area follow both sides.
    let (half, area) = (piece.perimeter() * 0.5, signed_area(one).abs());
    let root = (half * half - 4.0 * area).max(0.0).sqrt();
    let (long, short) = ((half + root) * 0.5, (half - root) * 0.5);
    (short > 0.0 && long > 3.0 * short).then_some(short)
}

/// Fills what lies between lines that run side by side. Returns the lines without another beside them.
fn pairs(lines: &[[Vec2; 2]], shapes: &mut Vec<Vec<Vec<Vec2>>>) -> Vec<[Vec2; 2]> {
    let Some(mut cells) = Cells::of(lines) else { return lines.to_vec() };
    let before = shapes.len();
    let mut paired = vec![false; lines.len()];
    let mut widest = 0.0f64;
    for (k, &[a, b]) in lines.iter().enumerate() {
        let length = a.distance(b);
        let along = (b - a) / length;
        // By side: the lines beside this one as stretches of it, and their distances at both ends.
        let mut beside: [Vec<Stretch>; 2] = Default::default();
        let Some(near) = cells.near(a, b) else {
            shapes.truncate(before);
            return lines.to_vec();
        };
        for other in near {
            let [c, d] = lines[other];
            let (c, d) = if (d - c).dot(along) < 0.0 { (d, c) } else { (c, d) };
            let direction = (d - c) / c.distance(d);
            if other == k || direction.cross(along).abs() > PARALLEL {
                continue;
            }
            let (from, to) = ((c - a).dot(along), (d - a).dot(along));
            let (low, high) = (from.max(0.0), to.min(length));
            if high - low < 1e-6 || to - from < 1e-9 {
                continue;
            }
            let off = |at: f64| {
                let (at_c, at_d) = (along.cross(c - a), along.cross(d - a));
                at_c + (at_d - at_c) * (at - from) / (to - from)
            };
            let middle = off((low + high) * 0.5);
            if PAIR_M.contains(&middle.abs()) {
                let side = usize::from(middle > 0.0);
                beside[side].push(Stretch { low, high, off: [off(low), off(high)], middle: middle.abs() });
            }
        }
        let mut covered = 0.0f64;
        for stretches in &mut beside {
            // The nearest line is the wall's other side.
            let nearest = stretches.iter().map(|s| s.middle).fold(f64::INFINITY, f64::min);
            stretches.retain(|s| s.middle <= nearest * 1.1 + 0.01);
            stretches.sort_by(|s, t| s.low.total_cmp(&t.low).then(s.high.total_cmp(&t.high)));
            let mut merged: Vec<Stretch> = Vec::new();
            for stretch in stretches.iter() {
                match merged.last_mut() {
                    Some(last) if stretch.low - last.high <= BRANCH_M => {
                        if stretch.high > last.high {
                            (last.high, last.off[1]) = (stretch.high, stretch.off[1]);
                        }
                    }
                    _ => merged.push(*stretch),
                }
            }
            for mut stretch in merged {
                // At a corner the outer line is longer by the thickness of the wall that meets.
                if stretch.low <= BRANCH_M {
                    stretch.low = 0.0;
                }
                if length - stretch.high <= BRANCH_M {
                    stretch.high = length;
                }
                widest = widest.max(stretch.middle);
                covered = covered.max((stretch.high - stretch.low) / length);
                let place = |at: f64, off: f64| a + along * at + along.left() * off;
                let (low, high, [first, last]) = (stretch.low, stretch.high, stretch.off);
                shapes.push(vec![vec![place(low, 0.0), place(high, 0.0), place(high, last), place(low, first)]]);
            }
        }
        paired[k] = covered >= PAIRED;
    }
    // Short lines between the ends of a wall's two lines close it.
    let ends = Ends::of(lines.iter().zip(&paired).filter(|(_, paired)| **paired).map(|(line, _)| *line));
    let is_cap = |[a, b]: [Vec2; 2]| a.distance(b) <= widest + MEET_M && ends.meets(a) && ends.meets(b);
    let alone = lines.iter().zip(&paired).filter(|(line, paired)| !**paired && !is_cap(**line));
    alone.map(|(line, _)| *line).collect()
}

#[derive(Clone, Copy)]
struct Stretch {
    low: f64,
    high: f64,
    off: [f64; 2],
    middle: f64,
}

/// Lines with a thickness. Where ends meet, they are lengthened so that the corner is full.
fn bands(lines: &[([Vec2; 2], f64)], shapes: &mut Vec<Vec<Vec<Vec2>>>) {
    let ends = Ends::of(lines.iter().map(|(line, _)| *line));
    for (k, &([a, b], thickness)) in lines.iter().enumerate() {
        let along = (b - a) / a.distance(b).max(1e-9);
        let half = thickness * 0.5;
        let longer = |end: Vec2, outward: Vec2| {
            let corner = |other: usize| {
                let [c, d] = lines[other / 2].0;
                // Away from the corner.
                let away = if other.is_multiple_of(2) { d - c } else { c - d };
                let away = away / away.length().max(1e-9);
                let (sine, cosine) = (outward.cross(away).abs(), outward.dot(away));
                // Half the turn's tangent; of sharp corners the tip is left out.
                let tangent = if cosine > -0.999 { sine / (1.0 + cosine) } else { 0.0 };
                half.max(lines[other / 2].1 * 0.5) * tangent.min(1.2)
            };
            ends.at(end).take(MOST_MEETING).filter(|&other| other / 2 != k).map(corner).fold(0.0, f64::max)
        };
        let (a, b) = (a - along * longer(a, -along), b + along * longer(b, along));
        let side = along.left() * half;
        shapes.push(vec![vec![a - side, b - side, b + side, a + side]]);
    }
}

/// Ends of lines, found by their place.
struct Ends {
    /// Cell, number of the end (two for each line), place; ascending.
    sorted: Vec<([i64; 2], usize, Vec2)>,
}

impl Ends {
    fn of(lines: impl Iterator<Item = [Vec2; 2]>) -> Ends {
        let mut sorted: Vec<_> = lines.flatten().enumerate().map(|(k, p)| (cell(p, MEET_M), k, p)).collect();
        sorted.sort_unstable_by_key(|a| (a.0, a.1));
        Ends { sorted }
    }

    /// The ends that meet at a place.
    fn at(&self, p: Vec2) -> impl Iterator<Item = usize> + '_ {
        let [x, y] = cell(p, MEET_M);
        let cells = (-1..=1).flat_map(move |dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
        cells
            .flat_map(move |cell| {
                let from = self.sorted.partition_point(|end| end.0 < cell);
                self.sorted[from..].iter().take_while(move |end| end.0 == cell)
            })
            .filter(move |end| end.2.distance(p) <= MEET_M)
            .map(|end| end.1)
    }

    fn meets(&self, p: Vec2) -> bool {
        self.at(p).next().is_some()
    }
}

fn cell(p: Vec2, side: f64) -> [i64; 2] {
    [p.x, p.y].map(|v| (v / side).floor() as i64)
}

/// Lines by the cells that they pass.
struct Cells {
    lines: FxHashMap<[i64; 2], Vec<u32>>,
    /// By line, the number of the last search that found it.
    found: Vec<u32>,
    searches: u32,
    compared: usize,
}

impl Cells {
    /// `None` if the lines are too long to be walls.
    fn of(lines: &[[Vec2; 2]]) -> Option<Cells> {
        let mut cells = Cells { lines: FxHashMap::default(), found: vec![0; lines.len()], searches: 0, compared: 0 };
        let mut entries = 0;
        for (k, &[a, b]) in lines.iter().enumerate() {
            for cell in passed(a, b) {
                entries += 1;
                if entries > MOST_CELLS {
                    return None;
                }
                cells.lines.entry(cell).or_default().push(k as u32);
            }
        }
        Some(cells)
    }

    /// Lines near a line, ascending; `None` once too many were compared.
    fn near(&mut self, a: Vec2, b: Vec2) -> Option<Vec<usize>> {
        self.searches += 1;
        let mut near: Vec<usize> = Vec::new();
        let mut before = None;
        for [x, y] in passed(a, b) {
            for cell in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy])) {
                // Those around the cell before were looked at.
                if before.is_some_and(|[p, q]: [i64; 2]| (cell[0] - p).abs() <= 1 && (cell[1] - q).abs() <= 1) {
                    continue;
                }
                let lines = self.lines.get(&cell).map_or(&[][..], Vec::as_slice);
                self.compared += lines.len();
                for &line in lines {
                    if std::mem::replace(&mut self.found[line as usize], self.searches) != self.searches {
                        near.push(line as usize);
                    }
                }
            }
            if self.compared > MOST_COMPARED {
                return None;
            }
            before = Some([x, y]);
        }
        near.sort_unstable();
        Some(near)
    }
}

/// The cells of places along a line, half a cell apart.
fn passed(a: Vec2, b: Vec2) -> impl Iterator<Item = [i64; 2]> {
    let steps = (a.distance(b) / (0.5 * CELL_M)).ceil().max(1.0) as usize;
    let mut last = None;
    (0..=steps).filter_map(move |k| {
        let at = cell(a.lerp(b, k as f64 / steps as f64), CELL_M);
        (last.replace(at) != Some(at)).then_some(at)
    })
}

/// The smallest convex loop around points, counter-clockwise.
pub(super) fn hull(points: impl Iterator<Item = Vec2>) -> Vec<Vec2> {
    let mut points: Vec<Vec2> = points.collect();
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = Vec2>| {
        let mut chain: Vec<Vec2> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..] {
                if (b - a).cross(p - b) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut loop_ = half(&mut points.iter().copied());
    loop_.extend(half(&mut points.iter().rev().copied()));
    loop_
}

/// Corners of a rectangle along a line, `half` to either side.
pub(super) fn box_along(a: Vec2, b: Vec2, half: f64) -> Vec<Vec2> {
    let side = (b - a).normalized().unwrap_or(vec2(1.0, 0.0)).left() * half;
    vec![a - side, b - side, b + side, a + side]
}

#[cfg(test)]
mod tests {
    use super::super::area::Area;
    use super::*;

    fn area(pieces: &[Piece]) -> f64 {
        let pieces: Vec<&Piece> = pieces.iter().collect();
        Area::union(shapes(&pieces, Curves::Solid)).loops().map(|l| signed_area(&l)).sum()
    }

    fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> Vec<Vec2> {
        vec![vec2(x0, y0), vec2(x1, y0), vec2(x1, y1), vec2(x0, y1)]
    }

    #[test]
    fn between_an_outer_and_an_inner_outline_is_wall() {
        let outer = Piece::line(rectangle(0.0, 0.0, 10.0, 6.0), true);
        let inner = Piece::line(rectangle(0.3, 0.3, 9.7, 5.7), true);
        assert!((area(&[outer, inner]) - (60.0 - 9.4 * 5.4)).abs() < 1e-3);
    }

    #[test]
    fn two_lines_with_caps_and_a_branch_are_solid() {
        // A wall of 0.2 m with a branch of 0.1 m upward from its upper line, open at its right end.
        let line = |x0, y0, x1, y1| Piece::line(vec![vec2(x0, y0), vec2(x1, y1)], false);
        let wall = [
            line(0.0, 0.0, 6.0, 0.0),
            line(0.0, 0.2, 2.0, 0.2),
            line(2.1, 0.2, 6.0, 0.2),
            line(0.0, 0.0, 0.0, 0.2),
            line(2.0, 0.2, 2.0, 3.0),
            line(2.1, 0.2, 2.1, 3.0),
            line(2.0, 3.0, 2.1, 3.0),
        ];
        let solid = area(&wall);
        assert!((solid - (1.2 + 0.28)).abs() < 2e-3, "{solid}");
    }

    #[test]
    fn centre_lines_get_a_thickness_and_full_corners() {
        let l = Piece::line(vec![vec2(0.0, 0.0), vec2(4.0, 0.0), vec2(4.0, 3.0)], false);
        let solid = area(&[l]);
        // Two arms of 0.1 m and the outer quarter of the corner.
        assert!((solid - 0.7).abs() < 1e-3, "{solid}");
        let room = Piece::line(rectangle(0.0, 0.0, 4.0, 3.0), true);
        assert!((area(&[room]) - (4.1 * 3.1 - 3.9 * 2.9)).abs() < 1e-3);
    }

    #[test]
    fn a_hull_goes_round() {
        let points = [vec2(0.0, 0.0), vec2(1.0, 1.0), vec2(2.0, 0.0), vec2(2.0, 2.0), vec2(0.0, 2.0), vec2(1.0, 0.0)];
        assert_eq!(hull(points.into_iter()), [vec2(0.0, 0.0), vec2(2.0, 0.0), vec2(2.0, 2.0), vec2(0.0, 2.0)]);
    }
}
