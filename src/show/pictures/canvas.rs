//! A picture that is drawn on in plan metres: anti-aliased lines, filled rectangles, small text.

use image::{Rgb, RgbImage};

use crate::math::srgb::Srgb8;
use crate::math::{Vec2, vec2};
use crate::patterns::font;

/// Size of a dot of the letters, pixels.
const DOT: u32 = 2;

/// A line of text's height with the space below, pixels.
pub(in crate::show) const LINE_PX: i64 = ((font::HEIGHT + 3) * DOT) as i64;

/// A picture with a plan on it: the plan's lower-left corner lies `margin` pixels from the left and `below` pixels from
/// the lower edge.
#[derive(Clone, Debug)]
pub(in crate::show) struct PlanCanvas {
    pub(in crate::show) picture: RgbImage,
    pub(in crate::show) pixels_per_metre: f64,
    /// Size of the plan, pixels.
    pub(in crate::show) plan_px: [usize; 2],
    /// Pixel of the picture's left and upper edge of the plan.
    pub(in crate::show) corner: [usize; 2],
}

impl PlanCanvas {
    /// A canvas for a plan of `size_m`, whose longer side takes about `longest_px`, at most 100 px a metre.
    pub(in crate::show) fn new(size_m: Vec2, longest_px: f64, [margin, below]: [usize; 2], paper: Srgb8) -> PlanCanvas {
        let pixels_per_metre = (longest_px / size_m.x.max(size_m.y).max(1e-3)).min(100.0);
        let plan_px = [size_m.x, size_m.y].map(|m| ((m * pixels_per_metre).ceil() as usize).max(1));
        let [width, height] = [plan_px[0] + 2 * margin, plan_px[1] + margin + below];
        let picture = RgbImage::from_pixel(width as u32, height as u32, Rgb(paper));
        PlanCanvas { picture, pixels_per_metre, plan_px, corner: [margin, margin] }
    }

    /// From the plan frame to pixels from the picture's upper left, y down.
    pub(in crate::show) fn px(&self, p: Vec2) -> Vec2 {
        let [left, top] = self.corner.map(|c| c as f64);
        vec2(left + p.x * self.pixels_per_metre, top + self.plan_px[1] as f64 - p.y * self.pixels_per_metre)
    }

    /// Lays a colour over a pixel.
    pub(in crate::show) fn blend(&mut self, x: i64, y: i64, colour: Srgb8, share: f64) {
        let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { return };
        if let Some(pixel) = self.picture.get_pixel_mut_checked(x, y) {
            for (value, new) in pixel.0.iter_mut().zip(colour) {
                let mixed = f64::from(*value) + (f64::from(new) - f64::from(*value)) * share.clamp(0.0, 1.0);
                *value = mixed.round() as u8;
            }
        }
    }

    /// Fills a rectangle of pixels.
    pub(in crate::show) fn fill(&mut self, [left, top]: [i64; 2], [width, height]: [i64; 2], colour: Srgb8) {
        for y in top..top + height {
            for x in left..left + width {
                self.blend(x, y, colour, 1.0);
            }
        }
    }

    /// A line with flat ends between two pixels' places, `width` pixels wide.
    ///
    /// A pixel's share is that of a box of one pixel moved across the line: exact along the axes, close elsewhere.
    pub(in crate::show) fn line(&mut self, a: Vec2, b: Vec2, width: f64, colour: Srgb8, share: f64) {
        let length = a.distance(b);
        let Some(along) = (b - a).normalized().filter(|_| a.is_finite() && b.is_finite()) else { return };
        let reach = width * 0.5 + 1.0;
        let (low, high) = (vec2(a.x.min(b.x), a.y.min(b.y)), vec2(a.x.max(b.x), a.y.max(b.y)));
        let limit = |v: f64, most: u32| v.clamp(0.0, f64::from(most)) as i64;
        let (most_x, most_y) = (self.picture.width(), self.picture.height());
        for y in limit(low.y - reach, most_y)..=limit(high.y + reach, most_y) {
            for x in limit(low.x - reach, most_x)..=limit(high.x + reach, most_x) {
                let from_a = vec2(x as f64 + 0.5, y as f64 + 0.5) - a;
                let (t, aside) = (from_a.dot(along), from_a.cross(along).abs());
                let across = (width * 0.5 + 0.5 - aside).clamp(0.0, width.min(1.0));
                let ends = (t + 0.5).clamp(0.0, 1.0).min((length - t + 0.5).clamp(0.0, 1.0));
                if across * ends > 0.0 {
                    self.blend(x, y, colour, share * across * ends);
                }
            }
        }
    }

    /// A line with flat ends between two places of the plan.
    pub(in crate::show) fn line_m(&mut self, a: Vec2, b: Vec2, width: f64, colour: Srgb8, share: f64) {
        self.line(self.px(a), self.px(b), width, colour, share);
    }

    /// A dashed line between two places of the plan; dashes go on from `phase` pixels, the new phase is given back.
    pub(in crate::show) fn dashed_m(&mut self, [a, b]: [Vec2; 2], width: f64, colour: Srgb8, phase: f64) -> f64 {
        const DASH: f64 = 10.0;
        const PERIOD: f64 = 16.0;
        let (a, b) = (self.px(a), self.px(b));
        let length = a.distance(b);
        let mut at = -phase;
        while at < length && length > 0.0 {
            let (from, to) = (at.max(0.0), (at + DASH).min(length));
            if to > from {
                self.line(a.lerp(b, from / length), a.lerp(b, to / length), width, colour, 1.0);
            }
            at += PERIOD;
        }
        (phase + length) % PERIOD
    }

    /// An arrow head whose point is at `tip`.
    pub(in crate::show) fn arrow_m(&mut self, from: Vec2, tip: Vec2, colour: Srgb8) {
        let tip = self.px(tip);
        let Some(back) = (self.px(from) - tip).normalized() else { return };
        for side in [back.left(), -back.left()] {
            self.line(tip, tip + back * 12.0 + side * 6.0, 2.5, colour, 1.0);
        }
    }

    /// Text with a halo of the paper's colour, its upper-left corner at a pixel.
    pub(in crate::show) fn text(&mut self, at: [i64; 2], text: &str, colour: Srgb8, halo: Option<Srgb8>) {
        for (spread, colour) in [(2, halo), (0, Some(colour))] {
            if let Some(colour) = colour {
                self.letters(at, text, colour, i64::from(DOT), spread);
            }
        }
    }

    /// Letters whose dots have a side of `dot` pixels, and go over it by `spread` all around.
    pub(in crate::show) fn letters(&mut self, [left, top]: [i64; 2], text: &str, colour: Srgb8, dot: i64, spread: i64) {
        for (n, character) in (0..).zip(text.chars()) {
            let left = left + n * i64::from(font::WIDTH + 1) * dot;
            for (row, bits) in (0..).zip(font::rows(character)) {
                for column in (0..font::WIDTH).filter(|column| bits >> (font::WIDTH - 1 - column) & 1 == 1) {
                    let (x, y) = (left + i64::from(column) * dot - spread, top + row * dot - spread);
                    self.fill([x, y], [dot + 2 * spread; 2], colour);
                }
            }
        }
    }

    /// A filled ellipse around a pixel's place: `axes` are half its size along the unit vector `along` and across it, pixels.
    pub(in crate::show) fn ellipse(&mut self, middle: Vec2, along: Vec2, [a, b]: [f64; 2], colour: Srgb8) {
        let reach = a.max(b) + 1.0;
        if !middle.is_finite() {
            return;
        }
        let limit = |v: f64, most: u32| v.clamp(0.0, f64::from(most)) as i64;
        let (most_x, most_y) = (self.picture.width(), self.picture.height());
        for y in limit(middle.y - reach, most_y)..=limit(middle.y + reach, most_y) {
            for x in limit(middle.x - reach, most_x)..=limit(middle.x + reach, most_x) {
                let from = vec2(x as f64 + 0.5, y as f64 + 0.5) - middle;
                let (u, v) = (from.dot(along) / a, from.cross(along) / b);
                let radius = (u * u + v * v).sqrt();
                // Distance from the edge: to first order, exact at the edge itself.
                let slope = (u * u / (a * a) + v * v / (b * b)).sqrt();
                let beyond = if slope > 0.0 { (radius - 1.0) * radius / slope } else { -reach };
                let share = (0.5 - beyond).clamp(0.0, 1.0);
                if share > 0.0 {
                    self.blend(x, y, colour, share);
                }
            }
        }
    }

    /// Text around a pixel, moved so that all of it is seen.
    pub(in crate::show) fn label(&mut self, at: Vec2, text: &str, colour: Srgb8, halo: Srgb8) {
        let [width, height] = [text_width(text), i64::from(font::HEIGHT * DOT)];
        let within =
            |at: f64, size: i64, most: u32| (at as i64 - size / 2).clamp(3, (i64::from(most) - size - 3).max(3));
        let left = within(at.x, width, self.picture.width());
        let top = within(at.y, height, self.picture.height());
        self.text([left, top], text, colour, Some(halo));
    }
}

/// Width of a text, pixels.
pub(in crate::show) fn text_width(text: &str) -> i64 {
    text.chars().count() as i64 * i64::from((font::WIDTH + 1) * DOT)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn canvas() -> PlanCanvas {
        PlanCanvas::new(vec2(1.0, 1.0), 100.0, [0, 0], [255; 3])
    }

    /// Ink on a white canvas, in pixels.
    fn ink(canvas: &PlanCanvas) -> f64 {
        canvas.picture.pixels().map(|p| 1.0 - f64::from(p.0[0]) / 255.0).sum()
    }

    #[test]
    fn a_line_takes_as_much_ink_as_its_area_in_any_direction() {
        for (b, width) in
            [(vec2(90.0, 20.0), 2.0), (vec2(20.0, 80.0), 3.0), (vec2(80.0, 61.0), 1.0), (vec2(72.0, 71.5), 0.5)]
        {
            let mut canvas = canvas();
            let a = vec2(20.0, 20.0);
            canvas.line(a, b, width, [0; 3], 1.0);
            let area = a.distance(b) * width;
            assert!((ink(&canvas) - area).abs() < 0.05 * area, "{b:?}: {} of {area}", ink(&canvas));
        }
    }

    #[test]
    fn an_ellipse_takes_as_much_ink_as_its_area_in_any_direction() {
        for (along, axes) in [(vec2(1.0, 0.0), [9.0, 4.0]), (vec2(0.6, 0.8), [3.0, 12.0]), (vec2(0.0, 1.0), [5.0, 5.0])]
        {
            let mut canvas = canvas();
            canvas.ellipse(vec2(50.3, 49.8), along, axes, [0; 3]);
            let area = std::f64::consts::PI * axes[0] * axes[1];
            assert!((ink(&canvas) - area).abs() < 0.05 * area, "{axes:?}: {} of {area}", ink(&canvas));
            assert!(canvas.picture.get_pixel(50, 49).0 == [0; 3]);
        }
        let mut canvas = canvas();
        canvas.ellipse(vec2(1e9, -50.0), vec2(1.0, 0.0), [4.0, 4.0], [0; 3]);
        canvas.ellipse(vec2(f64::NAN, 5.0), vec2(1.0, 0.0), [4.0, 4.0], [0; 3]);
        assert_eq!(ink(&canvas), 0.0);
    }

    #[test]
    fn lines_far_outside_or_of_no_length_draw_nothing() {
        let mut canvas = canvas();
        canvas.line(vec2(-500.0, -10.0), vec2(500.0, -10.0), 3.0, [0; 3], 1.0);
        canvas.line(vec2(5.0, 5.0), vec2(5.0, 5.0), 3.0, [0; 3], 1.0);
        canvas.line(vec2(f64::NAN, 5.0), vec2(5.0, f64::INFINITY), 3.0, [0; 3], 1.0);
        assert_eq!(ink(&canvas), 0.0);
    }

    #[test]
    fn the_plans_origin_is_at_the_lower_left() {
        let canvas = PlanCanvas::new(vec2(2.0, 1.0), 100.0, [10, 30], [255; 3]);
        assert_eq!(canvas.picture.dimensions(), (120, 90));
        assert_eq!(canvas.px(Vec2::ZERO), vec2(10.0, 60.0));
        assert_eq!(canvas.px(vec2(2.0, 1.0)), vec2(110.0, 10.0));
    }

    #[test]
    fn labels_stay_on_the_picture() {
        let mut canvas = canvas();
        canvas.label(vec2(-50.0, 500.0), "west", [0; 3], [255; 3]);
        assert!(ink(&canvas) > 50.0);
    }
}
