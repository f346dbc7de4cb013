//! Small scenes for the tests of stamps and sums.

use super::{FaceSpan, TexelGrid, WallGrid};
use crate::marks::{Contact, Mark};
use crate::math::{SplitMix64, Vec2, sin_cos, vec2};
use crate::patterns::{Cause, Pattern, PatternLibrary};
use crate::plan::FloorPlan;
use crate::walls::{Walls, WallsOptions};

/// A sole of two ellipses with bars across, and a heel mark.
pub(crate) fn library() -> PatternLibrary {
    let sole = |x: f64, y: f64| {
        let inside = |cx: f64, rx: f64, ry: f64| {
            let (u, v) = ((x - cx) / rx, (y - 55.0) / ry);
            u * u + v * v < 1.0
        };
        let bars = if (x / 12.0).fract() < 0.6 { 255 } else { 90 };
        if inside(190.0, 90.0, 48.0) || inside(45.0, 40.0, 32.0) { bars } else { 0 }
    };
    let heel = |x: f64, y: f64| {
        let taper = 1.0 - (x / 30.0 - 1.0).abs();
        if (y - 4.0).abs() < 1.0 + 2.5 * taper { (255.0 * taper) as u8 } else { 0 }
    };
    PatternLibrary {
        patterns: vec![pattern("sole", Cause::Sole, [290, 110], sole), pattern("heel", Cause::Heel, [60, 8], heel)],
    }
}

fn pattern(name: &str, cause: Cause, [width, height]: [u32; 2], coverage: impl Fn(f64, f64) -> u8) -> Pattern {
    let at = |k: u32| coverage(f64::from(k % width) + 0.5, f64::from(k / width) + 0.5);
    Pattern {
        name: name.into(),
        description: String::new(),
        cause,
        form: None,
        length_cm: f64::from(width) / 10.0,
        share: 1.0,
        lengths_cm: None,
        width_px: width,
        height_px: height,
        coverage: (0..width * height).map(at).collect(),
    }
}

/// A room of the given size, metres, with walls of 0.1 m, drawn at 10 px/m.
pub(crate) fn room(width_m: f64, height_m: f64) -> Walls {
    let [w, h] = [width_m, height_m].map(|m| (m * 10.0).round() as usize + 2);
    let floor = (0..w * h).map(|k| u8::from(k % w > 0 && k % w < w - 1 && k / w > 0 && k / w < h - 1)).collect();
    Walls::trace(&FloorPlan::from_mask(w as u32, h as u32, 0.1, floor), &WallsOptions::default())
}

pub(crate) fn grid(texels_per_metre: f64, width_m: f64, height_m: f64) -> TexelGrid {
    let count = |m: f64| (m * texels_per_metre).ceil() as u32;
    TexelGrid { texels_per_metre, width: count(width_m), height: count(height_m) }
}

/// A footfall of the library's sole, without variation.
pub(crate) fn footfall(place_m: Vec2, angle_rad: f64) -> Mark {
    let (sin, cos) = sin_cos(angle_rad);
    Mark {
        cause: Cause::Sole,
        place_m,
        heading: vec2(cos, sin),
        mirrored: false,
        pattern: 0,
        length_m: 0.29,
        smear_m: 0.0,
        twist_rad: 0.0,
        forefoot: 0.0,
        effort: 0.0,
        stood_s: 0.0,
        wheel_m: 0.0,
        strength: 1.0,
        soil: 0.0,
        wet: 0.0,
        wear: 0,
        variation: 1,
    }
}

/// Footfalls, every third with soil, every fifth with effort, whiles of standing, wheels and heel marks, evenly over and
/// around a rectangle.
pub(crate) fn crowd(count: usize, width_m: f64, height_m: f64, seed: u64) -> Vec<Mark> {
    let rng = &mut SplitMix64::new(seed);
    (0..count)
        .map(|k| {
            let mut draw = |low: f32, high: f32| f64::from(rng.range(low, high));
            let place = vec2(draw(-0.2, width_m as f32 + 0.2), draw(-0.2, height_m as f32 + 0.2));
            let mut mark = footfall(place, draw(-3.2, 3.2));
            mark.length_m = draw(0.22, 0.33) as f32;
            mark.smear_m = draw(0.0, 0.03) as f32;
            mark.twist_rad = (draw(-0.6, 0.6) as f32).max(0.0);
            mark.strength = draw(0.5, 1.5) as f32;
            mark.mirrored = k % 2 == 0;
            mark.variation = rng.next_u64();
            mark.wear = rng.next_u64() as u32 % 20;
            if k % 3 == 0 {
                mark.soil = rng.range(0.0, 0.1);
                mark.wet = 2.0 * mark.soil;
            }
            if k % 5 == 2 {
                mark.effort = 1.5;
            }
            if k % 10 == 7 {
                mark.stood_s = 3.0;
            }
            if k % 10 == 4 {
                mark.wheel_m = 0.015;
            }
            if k % 10 == 0 {
                mark = Mark { cause: Cause::Heel, pattern: 1, length_m: mark.length_m * 0.25, ..mark };
            }
            mark
        })
        .collect()
}

/// Pattern indices of [`wall_library`].
pub(crate) const CLOUD: u16 = 0;
pub(crate) const DRAG: u16 = 1;
pub(crate) const SCUFF: u16 = 2;

/// A hand's soft cloud, denser on its right; a hand's fading drag; a shoe's thin line; a sole.
pub(crate) fn wall_library() -> PatternLibrary {
    let soft = |x: f64| (1.0 - x).clamp(0.0, 1.0);
    let cloud = |x: f64, y: f64| {
        let (u, v) = ((x - 100.0) / 92.0, (y - 60.0) / 52.0);
        (255.0 * soft(u * u + v * v) * (0.6 + 0.4 * u)) as u8
    };
    let drag = |x: f64, y: f64| {
        let finger = soft(((y / 20.0).fract() - 0.5).abs() * 3.0);
        let ends = (x / 30.0).min((400.0 - x) / 300.0).clamp(0.0, 1.0);
        (255.0 * finger * ends * soft(((y - 40.0) / 40.0).abs() - 0.2)) as u8
    };
    let scuff = |x: f64, y: f64| if (y - 5.0).abs() < 2.0 && (x - 40.0).abs() < 35.0 { 255 } else { 0 };
    PatternLibrary {
        patterns: vec![
            pattern("cloud", Cause::Hand, [200, 120], cloud),
            pattern("drag", Cause::Hand, [400, 80], drag),
            pattern("scuff", Cause::Shoe, [80, 10], scuff),
            library().patterns.swap_remove(0),
        ],
    }
}

/// Walls of the given lengths, metres, each closed or open, 2.6 m high.
pub(crate) fn wall_grid(texels_per_metre: f64, faces: &[(f64, bool)]) -> WallGrid {
    let texels = |metres: f64| (metres * texels_per_metre - 1e-6).ceil() as u32;
    let span = |&(length_m, closed): &(f64, bool)| FaceSpan { width: texels(length_m), length_m, closed };
    WallGrid { texels_per_metre, height_m: 2.6, height: texels(2.6), faces: faces.iter().map(span).collect() }
}

/// A cloud of its pattern's size on face 0.
pub(crate) fn touch(along_m: f64, height_m: f64) -> Contact {
    Contact {
        cause: Cause::Hand,
        face: 0,
        along_m,
        height_m,
        direction_rad: 0.0,
        pattern: CLOUD,
        mirrored: false,
        length_m: 0.2,
        breadth_m: 0.12,
        strength: 0.5,
        variation: 1,
    }
}

/// Contacts of all kinds, evenly over the faces of a grid and their surroundings.
pub(crate) fn touches(count: usize, grid: &WallGrid, seed: u64) -> Vec<Contact> {
    let rng = &mut SplitMix64::new(seed);
    let mut one = |k: usize| {
        let face = rng.next_u64() % grid.faces.len() as u64;
        let mut draw = |low: f32, high: f32| f64::from(rng.range(low, high));
        let length_m = grid.faces[face as usize].length_m as f32;
        let base = Contact {
            face: face as u32,
            direction_rad: draw(-3.2, 3.2) as f32,
            mirrored: k.is_multiple_of(2),
            strength: draw(0.02, 0.6) as f32,
            ..touch(draw(-0.2, length_m + 0.2), draw(-0.1, 2.7))
        };
        let (long, broad) = (draw(0.1, 0.3) as f32, draw(0.05, 0.15) as f32);
        let base = Contact { variation: rng.next_u64(), length_m: long, breadth_m: broad, ..base };
        match k % 3 {
            0 => base,
            1 => Contact { pattern: DRAG, length_m: 2.0 * long, ..base },
            _ => Contact { cause: Cause::Shoe, pattern: SCUFF, breadth_m: 0.1 * broad, ..base },
        }
    };
    (0..count).map(&mut one).collect()
}
