//! What lies on a floor as single things: stains, trails of drips, trodden chewing gum, grit, and the faint rubs that
//! soles leave along the way people walk.

use super::cells::{again, rise, smooth};
use super::lattice::TexelWindow;
use super::noise::{self, Channel};
use super::settings::{AgeLook, DwellLook};
use crate::math::sin_cos;

/// Side of the squares that hold spots, metres, and how far a spot may reach out of its square.
const SQUARE_M: f64 = 0.5;
const REACH_M: f64 = 0.3;
/// Coarser floors show no single things.
const LEAST_TEXELS_PER_M: f64 = 5.0;
/// Squares are asked this often for gum and stains, and for rubs and grit.
const TRIES: u32 = 6;
const MANY_TRIES: u32 = 24;
/// Spills per stain for every piece of gum beyond that of passes.
const SPILT: f32 = 0.5;
/// Share of rings among what is spilt where people stand.
const RINGS: f32 = 0.35;
/// Distance over which traffic is compared to find its direction, metres.
const ASIDE_M: f64 = 0.3;

/// Optical densities over a window.
#[derive(Default)]
pub(super) struct Spots {
    /// Stains and drips.
    pub stains: Vec<f32>,
    /// Gum, grit and rubs.
    pub marks: Vec<f32>,
}

#[derive(Clone, Copy)]
struct Spot {
    centre: [f64; 2],
    radius_m: f64,
    density: f32,
    /// Additional density of a dried rim.
    rim: f32,
    /// How far its outline bulges, of its radius: the ring of a cup does not.
    bulge: f32,
    word: u32,
}

/// A rub of a sole: a bent, tapered streak.
#[derive(Clone, Copy)]
struct Rub {
    centre: [f64; 2],
    along: [f64; 2],
    half_length_m: f64,
    width_m: f64,
    bend: f64,
    density: f32,
}

impl Spots {
    /// Lays spots out over a window; `passes` tells how many have passed a place, `seconds` how long people stood there.
    pub fn lay_out(
        &mut self,
        window: &TexelWindow,
        (age, dwell): (&AgeLook, &DwellLook),
        seed: u64,
        (passes, seconds): (impl Fn([f64; 2]) -> f32, impl Fn([f64; 2]) -> f32),
    ) {
        self.stains.clear();
        self.marks.clear();
        if window.texels_per_metre < LEAST_TEXELS_PER_M {
            return;
        }
        let area = window.area_m();
        let squares = |low: f64, high: f64| {
            ((low - REACH_M) / SQUARE_M).floor() as i64 as i32..=((high + REACH_M) / SQUARE_M).floor() as i64 as i32
        };
        let key = noise::key(seed, Channel::Spots);
        let per_square = (SQUARE_M * SQUARE_M) as f32;
        for j in squares(area.min.y, area.max.y) {
            for i in squares(area.min.x, area.max.x) {
                let at = |u: f64, v: f64| [(f64::from(i) + u) * SQUARE_M, (f64::from(j) + v) * SQUARE_M];
                let middle = at(0.5, 0.5);
                let passed = passes(middle);
                let busy = (passed / 1000.0).sqrt().min(5.0);
                let stood = dwell.gum * (seconds(middle) / 1000.0).sqrt().min(2.0);
                for n in 0..TRIES {
                    let word = noise::hash(key ^ noise::mix(n), i, j);
                    let centre = at(f64::from(again(word, 1)), f64::from(again(word, 2)));
                    let apart = at(f64::from(again(word, 13)), f64::from(again(word, 14)));
                    let [gum, stain] = [3, 4].map(|n| again(word, n) * TRIES as f32 / per_square);
                    let most_gum = age.gum_per_m2 * (busy + stood);
                    if gum < most_gum {
                        self.gum(window, centre, word);
                    }
                    let centre = if gum < most_gum { apart } else { centre };
                    if stain < age.stains_per_m2 {
                        self.stain(window, centre, word);
                    } else if stain < age.stains_per_m2 * (1.0 + SPILT * stood) {
                        self.spill(window, centre, word);
                    }
                }
                let way = (age.rubs_per_m2 * busy > 0.0).then(|| heading(middle, passed, &passes)).flatten();
                for n in 0..MANY_TRIES {
                    let word = noise::hash(key ^ noise::mix(100 + n), i, j);
                    let centre = at(f64::from(again(word, 1)), f64::from(again(word, 2)));
                    let [rub, grit] = [3, 4].map(|n| again(word, n) * MANY_TRIES as f32 / per_square);
                    if rub < age.rubs_per_m2 * busy {
                        rub_of(centre, way, word).add_to(window, &mut self.marks);
                    }
                    if grit < age.grit_per_m2 * (0.25 + busy) {
                        let radius_m = 0.0012 + 0.0035 * f64::from(again(word, 5) * again(word, 6));
                        Spot { centre, radius_m, density: 0.9, rim: 0.0, bulge: 0.2, word }
                            .add_to(window, &mut self.marks);
                    }
                }
            }
        }
    }

    /// A flat, round spot of 1.5 to 4 cm that feet have blackened.
    fn gum(&mut self, window: &TexelWindow, centre: [f64; 2], word: u32) {
        let radius_m = 0.008 + 0.012 * f64::from(again(word, 5) * again(word, 6));
        let density = 0.25 + 0.75 * again(word, 7) * again(word, 8);
        Spot { centre, radius_m, density, rim: 0.06, bulge: 0.16, word }.add_to(window, &mut self.marks);
    }

    /// The ring of a cup or a bottle, or what dripped from it.
    fn spill(&mut self, window: &TexelWindow, centre: [f64; 2], word: u32) {
        if again(word, 12) > RINGS {
            return self.stain(window, centre, word);
        }
        let radius_m = 0.03 + 0.012 * f64::from(again(word, 5));
        let rim = 0.05 + 0.25 * again(word, 6) * again(word, 7);
        Spot { centre, radius_m, density: 0.01, rim, bulge: 0.0, word }.add_to(window, &mut self.stains);
    }

    /// A pale stain with a rim where it dried, or a trail of drips.
    fn stain(&mut self, window: &TexelWindow, centre: [f64; 2], word: u32) {
        let faint = again(word, 5) * again(word, 5);
        if again(word, 9) < 0.45 {
            let radius_m = 0.02 + 0.09 * f64::from(again(word, 6) * again(word, 7));
            let (density, rim) = (0.02 + 0.10 * faint, 0.03 + 0.16 * faint);
            let spot = Spot { centre, radius_m, density, rim, bulge: 0.2, word };
            return spot.add_to(window, &mut self.stains);
        }
        let turn = again(word, 10) * std::f32::consts::TAU;
        let (sin, cos) = sin_cos(f64::from(turn));
        let along = [cos, sin];
        for drop in 0..3 + (again(word, 11) * 7.0) as u32 {
            let word = noise::mix(word ^ (drop + 77));
            let way = 0.5 * (f64::from(again(word, 1)) - 0.5);
            let aside = 0.05 * (f64::from(again(word, 2)) - 0.5);
            let centre = [centre[0] + way * along[0] - aside * along[1], centre[1] + way * along[1] + aside * along[0]];
            let radius_m = 0.003 + 0.009 * f64::from(again(word, 3) * again(word, 4));
            let density = 0.08 + 0.30 * faint;
            Spot { centre, radius_m, density, rim: 0.1, bulge: 0.12, word }.add_to(window, &mut self.stains);
        }
    }
}

/// Direction of traffic at a place: across the way in which it changes most. `None` where it is even.
fn heading(middle: [f64; 2], passed: f32, passes: impl Fn([f64; 2]) -> f32) -> Option<[f64; 2]> {
    let [x, y] = middle;
    let dx = f64::from(passes([x + ASIDE_M, y]) - passes([x - ASIDE_M, y]));
    let dy = f64::from(passes([x, y + ASIDE_M]) - passes([x, y - ASIDE_M]));
    let change = (dx * dx + dy * dy).sqrt();
    (change > 0.15 * f64::from(passed)).then(|| [-dy / change, dx / change])
}

fn rub_of(centre: [f64; 2], way: Option<[f64; 2]>, word: u32) -> Rub {
    let spread = if way.is_some() { 0.9 } else { 3.2 };
    let turn = spread * f64::from(again(word, 5) + again(word, 6) - 1.0);
    let (sin, cos) = sin_cos(turn);
    let [a, b] = way.unwrap_or([1.0, 0.0]);
    let faint = again(word, 7);
    let cubed = faint * faint * faint;
    Rub {
        centre,
        along: [a * cos - b * sin, a * sin + b * cos],
        half_length_m: 0.012 + 0.11 * f64::from(again(word, 8) * again(word, 9)),
        width_m: 0.003 + 0.008 * f64::from(again(word, 10)),
        bend: 0.5 * f64::from(again(word, 11) - 0.5),
        // Lognormal in spirit: most are hardly seen, one in thirty is black.
        density: 0.08 + 0.3 * cubed + 1.0 * faint * faint * cubed * cubed * cubed,
    }
}

impl Rub {
    fn add_to(&self, window: &TexelWindow, plane: &mut Vec<f32>) {
        let density = window.texels_per_metre;
        let reach = self.half_length_m + self.width_m + 1.0 / density;
        let Some((columns, rows)) = texels_near(window, self.centre, reach) else { return };
        plane.resize(window.texels(), 0.0);
        // A streak thinner than a texel is a texel wide, and fainter.
        let half_width = 0.5 * self.width_m.max(1.0 / density);
        let share = (0.5 * self.width_m / half_width) as f32;
        let soft = 0.5 / density;
        for row in rows {
            for column in columns.clone() {
                let x = ((window.i0 + column as i64) as f64 + 0.5) / density - self.centre[0];
                let y = ((window.j0 + row as i64) as f64 + 0.5) / density - self.centre[1];
                let t = (x * self.along[0] + y * self.along[1]) / self.half_length_m;
                let aside = y * self.along[0] - x * self.along[1] + self.bend * self.half_length_m * t * t;
                // Sharp where the sole sets down, fading on.
                let taper = rise(t as f32, -1.1, -0.8) * (1.0 - rise(t as f32, -0.6, 1.1));
                let across =
                    1.0 - rise(aside.abs() as f32, (half_width - soft).max(0.0) as f32, (half_width + soft) as f32);
                plane[row * window.width + column] += self.density * share * taper * across;
            }
        }
    }
}

/// Columns and rows of a window within a distance of a place, metres.
fn texels_near(
    window: &TexelWindow,
    [x, y]: [f64; 2],
    reach: f64,
) -> Option<(std::ops::Range<usize>, std::ops::Range<usize>)> {
    let range = |centre: f64, first: i64, count: usize| {
        let texel = |metres: f64| ((metres * window.texels_per_metre).floor() as i64 - first).clamp(-1, count as i64);
        texel(centre - reach).max(0) as usize..(texel(centre + reach) + 1).clamp(0, count as i64) as usize
    };
    let (columns, rows) = (range(x, window.i0, window.width), range(y, window.j0, window.height));
    (!columns.is_empty() && !rows.is_empty()).then_some((columns, rows))
}

impl Spot {
    fn add_to(&self, window: &TexelWindow, plane: &mut Vec<f32>) {
        let density = window.texels_per_metre;
        let reach = (1.0 + 2.0 * self.bulge as f64) * 1.1 * self.radius_m + 1.0 / density;
        let Some((columns, rows)) = texels_near(window, self.centre, reach) else { return };
        plane.resize(window.texels(), 0.0);
        // A spot smaller than a texel takes its share of it.
        let radius = self.radius_m.max(0.5 / density);
        let share = (self.radius_m / radius) * (self.radius_m / radius);
        let soft = (0.5 / (density * radius)).max(0.05) as f32;
        let signed = |n: u32| 2.0 * again(self.word, n) - 1.0;
        let [two, three] = [[20, 21], [22, 23]].map(|of| of.map(signed));
        for row in rows {
            for column in columns.clone() {
                let x = ((window.i0 + column as i64) as f64 + 0.5) / density - self.centre[0];
                let y = ((window.j0 + row as i64) as f64 + 0.5) / density - self.centre[1];
                let (u, v) = (x / radius, y / radius);
                let from_centre = ((u * u + v * v).sqrt() as f32).max(1e-4);
                if from_centre > 1.2 + 2.0 * self.bulge + soft {
                    continue;
                }
                // Two and three lobes, and bays.
                let (c, s) = (u as f32 / from_centre, v as f32 / from_centre);
                let lobes = two[0] * (c * c - s * s) + two[1] * 2.0 * c * s;
                let thirds = three[0] * c * (c * c - 3.0 * s * s) + three[1] * s * (3.0 * c * c - s * s);
                let bays = smooth(self.word, 2.3 * f64::from(c) + 9.0 + 0.7 * u, 2.3 * f64::from(s) + 9.0 + 0.7 * v);
                let distance = from_centre / (1.0 + self.bulge * (0.6 * lobes + 0.5 * thirds + 0.7 * bays)).max(0.4);
                let inside = 1.0 - rise(distance, 1.0 - soft, 1.0 + soft);
                // A rim dries unevenly.
                let rim = rise(distance, 0.72, 0.95) * inside * (1.0 + 0.4 * bays);
                plane[row * window.width + column] += (self.density * inside + self.rim * rim) * share as f32;
            }
        }
    }
}
