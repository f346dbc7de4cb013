//! What stands in rooms beside their walls: door leaves, furniture, windows. Stills, page and scene take it from here.

mod doors;
mod finish;
mod furniture;
mod prism;
mod shape;
mod windows;

pub(crate) use finish::Finish;
pub(crate) use prism::{Fitting, LeafUse};
pub(crate) use windows::Window;

use crate::math::{Vec2, exp};
use crate::walls::{Doorway, Walls};
use shape::{bounds, contains, distance_m};

/// What takes light from the floor: a footprint and the height of its underside, metres.
#[derive(Clone, Debug)]
struct Occluder {
    footprint: Vec<Vec2>,
    low_m: f64,
    /// Half the size of its box, metres.
    half: Vec2,
    centre: Vec2,
    /// Distance in which the shadow at its foot fades, metres.
    fades_m: f64,
}

/// Everything that stands in the rooms of a plan.
#[derive(Debug, Default)]
pub(crate) struct Fittings {
    pub all: Vec<Fitting>,
    pub windows: Vec<Window>,
    /// Per face of the walls: whether prisms stand for it.
    pub replaced: Vec<bool>,
    occluders: Vec<Occluder>,
}

/// Darkening of the floor at the foot of furniture: share.
const FOOT: f64 = 0.55;
/// Share of the light that a board over the floor takes of what it covers.
const COVERED: f64 = 0.9;
/// Distance beyond which furniture takes no light, metres.
pub(super) const SHADE_M: f64 = 1.2;

impl Fittings {
    /// The fittings of rooms of a height, metres.
    pub fn of(walls: &Walls, doorways: &[Doorway], height_m: f64) -> Fittings {
        let mut fittings = Fittings { replaced: vec![false; walls.faces.len()], ..Fittings::default() };
        if height_m <= 0.0 {
            return fittings;
        }
        let mut blocks = Vec::new();
        furniture::add(walls, height_m, (&mut fittings.all, &mut fittings.replaced), &mut blocks);
        fittings.all.extend(doors::leaves(walls, doorways, height_m));
        fittings.windows = windows::of(walls, height_m);
        fittings.all.extend(fittings.windows.iter().flat_map(Window::parts));
        let standing = fittings.all.iter().map(|fitting| (&fitting.footprint, fitting.span_m));
        let blocks = blocks.iter().map(|(footprint, height_m)| (footprint, [0.0, *height_m]));
        fittings.occluders =
            standing.chain(blocks).filter_map(|(footprint, span)| Occluder::of(footprint, span)).collect();
        fittings
    }

    /// Bounds of the floor that each thing darkens, in their order.
    pub fn shaded(&self) -> impl Iterator<Item = crate::math::Rect> + '_ {
        self.occluders.iter().map(|occluder| bounds(&occluder.footprint).grown(SHADE_M))
    }

    /// Share of the light that boards over the floor leave at a place, of those that are numbered.
    pub fn under_boards(&self, numbers: &[u32], p: Vec2) -> f64 {
        let boards = numbers.iter().map(|&n| &self.occluders[n as usize]).filter(|board| board.low_m > 0.1);
        1.0 - COVERED * boards.map(|board| board.covers(p)).sum::<f64>().min(1.0)
    }

    /// Share of the light that is left at a place of the floor beside what stands on it, of those that are numbered.
    pub fn beside_feet(&self, numbers: &[u32], p: Vec2) -> f64 {
        let feet = numbers.iter().map(|&n| &self.occluders[n as usize]).filter(|foot| foot.low_m <= 0.1);
        feet.map(|foot| {
            let away = if contains(&foot.footprint, p) { 0.0 } else { distance_m(&foot.footprint, p) };
            1.0 - FOOT * exp(-away / foot.fades_m)
        })
        .product()
    }
}

impl Occluder {
    fn of(footprint: &[Vec2], [low_m, high_m]: [f64; 2]) -> Option<Occluder> {
        // Thin parts high up take no light that one would miss.
        let area = bounds(footprint);
        let size = (area.width() * area.height()).sqrt();
        if low_m > 0.8 || (low_m > 0.1 && size < 0.25) {
            return None;
        }
        let fades_m = 0.018 + 0.11 * size.min(1.0) * (high_m / 0.5).min(1.0);
        let half = crate::math::vec2(area.width(), area.height()) * 0.5;
        Some(Occluder { footprint: footprint.to_vec(), low_m, half, centre: area.centre(), fades_m })
    }

    /// Share of the light of an even sky that its box takes from a place of the floor (Howell, A catalog of radiation heat
    /// transfer configuration factors, B-4).
    fn covers(&self, p: Vec2) -> f64 {
        let away = self.centre - p;
        let h = self.low_m;
        let corner = |x: f64, y: f64| {
            let (x, y) = (x / h, y / h);
            let (a, b) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
            let angle = |t: f64| crate::math::atan2(t, 1.0);
            (x / a * angle(y / a) + y / b * angle(x / b)) / std::f64::consts::TAU
        };
        let (x0, x1) = (away.x - self.half.x, away.x + self.half.x);
        let (y0, y1) = (away.y - self.half.y, away.y + self.half.y);
        (corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0)).max(0.0)
    }
}
