use image::RgbImage;

use super::canvas::{LINE_PX, PlanCanvas, text_width};
use super::style::{FASTEST_M_S, PAPER, PLAIN_FLOOR, SOLID, TEXT, scale_bar, speed_colour};
use crate::formation::KeyFormation;
use crate::math::srgb::Srgb8;
use crate::math::{Vec2, vec2};
use crate::motion::Ensemble;

/// Pixels of the picture's longer side, of its frame, and of the curve below it.
const LONGEST_PX: f64 = 1200.0;
const MARGIN_PX: usize = 24;
const CURVE_PX: usize = 160;
/// Room beside the people, metres; radius of a dot for one of them, metres and least pixels.
const BESIDE_M: f64 = 1.0;
const DOT_M: f64 = 0.16;
const LEAST_DOT_PX: f64 = 2.5;
/// Points of a way that are drawn at most.
const MOST_POINTS: usize = 600;

/// Draws key formations of a motion: everybody's way as a thin line, in each key formation a dot for each, numbered and
/// coloured by time. Below, over time, how far people are from where the keys lead them, `distances_m`, frame by frame from
/// the first key to the last (see [`KeyFormation::distances_m`]).
pub fn draw_keys(motion: &Ensemble, keys: &[KeyFormation], distances_m: &[f64]) -> RgbImage {
    let bounds = motion.bounds_m().grown(BESIDE_M);
    let height_m = bounds.height().max(0.2 * bounds.width());
    let size = vec2(bounds.width().max(0.7 * height_m), height_m);
    let mut canvas = PlanCanvas::new(size, LONGEST_PX, [MARGIN_PX, CURVE_PX + 3 * MARGIN_PX], PAPER);
    let [left, top] = canvas.corner.map(|c| c as i64);
    let [width, height] = canvas.plan_px.map(|c| c as i64);
    canvas.fill([left, top], [width, height], PLAIN_FLOOR);
    let middle = (bounds.min + bounds.max) * 0.5;
    let on = |p: Vec2| p - middle + size * 0.5;
    let every = motion.moments().div_ceil(MOST_POINTS).max(1);
    let moments: Vec<usize> = (0..motion.moments()).step_by(every).collect();
    for pair in moments.windows(2) {
        for (a, b) in motion.places_at(pair[0]).iter().zip(motion.places_at(pair[1])) {
            canvas.line_m(on(*a), on(*b), 1.0, SOLID, 0.35);
        }
    }
    let span_s = [0, keys.len().saturating_sub(1)].map(|k| keys.get(k).map_or(0.0, |key| key.time_s));
    let share = |time_s: f64| (time_s - span_s[0]) / (span_s[1] - span_s[0]).max(1e-9);
    let colour = |key: &KeyFormation| speed_colour(0.9 * FASTEST_M_S * share(key.time_s));
    let dot_px = (DOT_M * canvas.pixels_per_metre).max(LEAST_DOT_PX);
    for key in keys {
        for place in &key.places_m {
            let at = canvas.px(on(*place));
            canvas.ellipse(at, vec2(1.0, 0.0), [dot_px; 2], colour(key));
        }
    }
    for (k, key) in keys.iter().enumerate() {
        let highest = key.places_m.iter().max_by(|a, b| a.y.total_cmp(&b.y));
        let at = canvas.px(on(*highest.unwrap_or(&middle))) - vec2(0.0, dot_px + 14.0);
        canvas.label(at, &format!("{} ({:.1} s)", k + 1, key.time_s), colour(key), PAPER);
    }
    let panel = Panel { left, top: top + height + MARGIN_PX as i64, width };
    let marks: Vec<(f64, Srgb8)> = keys.iter().map(|key| (share(key.time_s), colour(key))).collect();
    panel.draw(&mut canvas, distances_m, &marks);
    let below = panel.top + CURVE_PX as i64 + 8;
    scale_bar(&mut canvas, [left + width, below], width as f64 / 6.0);
    canvas.picture
}

/// Where the curve lies, pixels.
struct Panel {
    left: i64,
    top: i64,
    width: i64,
}

impl Panel {
    fn draw(&self, canvas: &mut PlanCanvas, distances_m: &[f64], marks: &[(f64, Srgb8)]) {
        let (size, high) = ([self.width, CURVE_PX as i64], CURVE_PX as f64 - 2.0 * LINE_PX as f64);
        canvas.fill([self.left, self.top], size, PLAIN_FLOOR);
        let most_m = distances_m.iter().copied().fold(0.0, f64::max);
        let at = |share: f64, metres: f64| {
            let up = CURVE_PX as f64 - 2.0 - metres / most_m.max(1e-9) * high;
            vec2(self.left as f64 + share * self.width as f64, self.top as f64 + up)
        };
        for &(share, colour) in marks {
            let foot = at(share, 0.0);
            canvas.line(foot, foot - vec2(0.0, high), 2.0, colour, 0.8);
        }
        let last = distances_m.len().saturating_sub(1).max(1) as f64;
        let every = distances_m.len().div_ceil(MOST_POINTS).max(1);
        let points: Vec<Vec2> =
            distances_m.iter().enumerate().step_by(every).map(|(k, &metres)| at(k as f64 / last, metres)).collect();
        for pair in points.windows(2) {
            canvas.line(pair[0], pair[1], 2.0, TEXT, 1.0);
        }
        let said = format!("mean distance from where the key formations lead, up to {most_m:.2} m");
        let fits = text_width(&said) + 12 <= self.width;
        let said = if fits { said } else { format!("up to {most_m:.2} m off") };
        canvas.text([self.left + 6, self.top + 6], &said, TEXT, None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_drawn_as_dots_in_the_colours_of_their_times() {
        let places = |x: f64| [vec2(x, 0.0), vec2(x, 3.0)];
        let motion = Ensemble::new(1.0, 0.0, vec![0, 1], (0..=10).flat_map(|k| places(f64::from(k))).collect());
        let key = |time_s: f64| KeyFormation { time_s, places_m: places(time_s).to_vec() };
        let picture = draw_keys(&motion, &[key(0.0), key(10.0)], &[0.0; 11]);
        // Ten metres and one on each side are 1200 px; each dot covers a disc of 16 cm.
        let of = |colour: Srgb8| picture.pixels().filter(|p| p.0 == colour).count() as f64;
        let dots_px = 2.0 * std::f64::consts::PI * 16.0 * 16.0;
        for share in [0.0, 0.9] {
            let found = of(speed_colour(share * FASTEST_M_S));
            assert!((0.9 * dots_px..2.5 * dots_px).contains(&found), "{found} of {dots_px}");
        }
    }
}
