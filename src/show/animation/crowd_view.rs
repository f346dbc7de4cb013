use image::{Rgb, RgbImage};

use super::options::{AnimationColour, AnimationOptions};
use super::trails::Trails;
use crate::crowd::Arrival;
use crate::math::srgb::Srgb8;
use crate::math::{Vec2, vec2};
use crate::motion::Walker;
use crate::plan::FloorPlan;
use crate::show::pictures::canvas::{PlanCanvas, text_width};
use crate::show::pictures::drawing::{draw_ground, draw_walls};
use crate::show::pictures::stuck::draw_cross;
use crate::show::pictures::style::{FASTEST_M_S, PAPER, PLAIN_FLOOR, ROUTES, TEXT, scale_bar, speed_colour};
use crate::walls::Walls;

/// Room around the plan, pixels.
const MARGIN: usize = 10;
/// Room below it for clock and scales, pixels.
const FOOTER: usize = 58;
/// A picture is at least this wide: clock and scales need it.
const NARROWEST: usize = 420;

/// Half the shoulders' width and half the chest's depth, with clothes, metres.
const BODY_M: [f64; 2] = [0.24, 0.15];
/// Least half shoulder width at which a person is drawn, pixels.
const SMALLEST_PX: f64 = 3.4;
/// How strong a tail is at the body.
const TAIL: f64 = 0.5;
/// The line around a body.
pub(super) const OUTLINE: Srgb8 = [44, 44, 52];
/// Size of the clock's dots, pixels.
const CLOCK_DOT: i64 = 3;

/// The plan from above, on which people are drawn.
pub(super) struct CrowdView<'a> {
    ground: PlanCanvas,
    arrivals: &'a [Arrival],
    colour: AnimationColour,
}

impl<'a> CrowdView<'a> {
    pub(super) fn new(
        plan: &FloorPlan,
        walls: &Walls,
        arrivals: &'a [Arrival],
        options: &AnimationOptions,
    ) -> CrowdView<'a> {
        let size_m = vec2(plan.width_m(), plan.height_m());
        let longest = f64::from(options.size_px) - 2.0 * MARGIN as f64;
        let width = (size_m.x / size_m.x.max(size_m.y).max(1e-3) * longest) as usize;
        let beside = MARGIN.max(NARROWEST.saturating_sub(width) / 2);
        let mut ground = PlanCanvas::new(size_m, longest, [beside, MARGIN + FOOTER], PAPER);
        draw_ground(&mut ground, plan, walls, PLAIN_FLOOR);
        draw_walls(&mut ground, walls, false);
        let mut scene = CrowdView { ground, arrivals, colour: options.colour };
        scene.draw_scales();
        scene
    }

    pub(super) fn size_px(&self) -> [u32; 2] {
        [self.ground.picture.width(), self.ground.picture.height()]
    }

    /// Upper edge of the footer.
    fn footer(&self) -> i64 {
        (self.ground.corner[1] + self.ground.plan_px[1] + MARGIN) as i64
    }

    fn draw_scales(&mut self) {
        const SPEEDS_PX: i64 = 120;
        let (width, top) = (i64::from(self.ground.picture.width()), self.footer() + 6);
        scale_bar(&mut self.ground, [width - MARGIN as i64 - 4, top], 110.0);
        if self.colour == AnimationColour::Speed {
            let left = width / 2 - 20;
            for x in 0..SPEEDS_PX {
                let speed = FASTEST_M_S * x as f64 / SPEEDS_PX as f64;
                self.ground.fill([left + x, top], [1, 10], speed_colour(speed));
            }
            self.ground.text([left - 5, top + 18], "0", TEXT, None);
            let end = format!("{FASTEST_M_S} m/s");
            self.ground.text([left + SPEEDS_PX - 10, top + 18], &end, TEXT, None);
        }
    }

    /// Everybody at a moment, and crosses where people got stuck.
    pub(super) fn picture(&self, time_s: f64, walkers: &[Walker], tails: &Trails, stuck: &[Vec2]) -> RgbImage {
        let mut canvas = self.ground.clone();
        for (walker, places) in walkers.iter().zip(tails.places()) {
            self.draw_tail(&mut canvas, walker, places);
        }
        for walker in walkers.iter().filter(|walker| self.is_on_plan(walker.position_m)) {
            self.draw_body(&mut canvas, walker);
        }
        for &place in stuck {
            draw_cross(&mut canvas, self.ground.px(place), 6.0);
        }
        let top = self.footer() + 4;
        let clock = clock(time_s);
        canvas.letters([MARGIN as i64 + 2, top], &clock, TEXT, CLOCK_DOT, 0);
        let people = if walkers.len() == 1 { "1 person".to_string() } else { format!("{} people", walkers.len()) };
        canvas.text([MARGIN as i64 + 2, top + 28], &people, TEXT, None);
        canvas.picture
    }

    /// People still outside the plan are not drawn.
    fn is_on_plan(&self, place: Vec2) -> bool {
        let [width, height] = self.ground.plan_px.map(|side| side as f64 / self.ground.pixels_per_metre);
        place.x >= 0.0 && place.y >= 0.0 && place.x <= width && place.y <= height
    }

    fn colour(&self, walker: &Walker) -> Srgb8 {
        match self.colour {
            AnimationColour::Speed => speed_colour(walker.velocity_m_s.length()),
            AnimationColour::Route => {
                let route = self.arrivals.get(walker.id as usize).map_or(0, |arrival| arrival.route);
                ROUTES[route % ROUTES.len()]
            }
        }
    }

    /// Where somebody has just been, the longer ago the paler.
    fn draw_tail(&self, canvas: &mut PlanCanvas, walker: &Walker, places: &[Vec2]) {
        let (colour, width) = (self.colour(walker), (BODY_M[1] * canvas.pixels_per_metre).max(0.7 * SMALLEST_PX));
        let count = places.len() as f64;
        for (n, pair) in places.windows(2).enumerate().filter(|(_, pair)| pair.iter().all(|&p| self.is_on_plan(p))) {
            canvas.line_m(pair[0], pair[1], width, colour, TAIL * (1.0 - n as f64 / count));
        }
    }

    /// A body from above: shoulders across the way, the head a little forward.
    fn draw_body(&self, canvas: &mut PlanCanvas, walker: &Walker) {
        let colour = self.colour(walker);
        let facing = walker.heading.or_else(|| walker.velocity_m_s.normalized()).unwrap_or(vec2(1.0, 0.0));
        let along = vec2(facing.x, -facing.y);
        let at = canvas.px(walker.position_m);
        let shoulders = (BODY_M[0] * canvas.pixels_per_metre).max(SMALLEST_PX);
        let axes = [shoulders * BODY_M[1] / BODY_M[0], shoulders];
        canvas.ellipse(at, along, axes.map(|axis| axis + 0.9), OUTLINE);
        canvas.ellipse(at, along, axes.map(|axis| axis - 0.1), colour);
        // Where there is room to see it, a head: which way somebody faces.
        if shoulders > 1.3 * SMALLEST_PX {
            let head = axes[0] * 0.62;
            canvas.ellipse(at + along * (axes[0] * 0.42), along, [head, head], OUTLINE);
        }
    }

    /// The label of an animation's speed, and the place of its upper-left pixel.
    pub(super) fn speed_label(&self, speed: f64) -> ([usize; 2], RgbImage) {
        const WIDTH: usize = 100;
        let left = MARGIN + 2 + 110;
        let top = self.footer() as usize + 11;
        let mut label = PlanCanvas {
            picture: RgbImage::from_pixel(WIDTH as u32, 16, Rgb(PAPER)),
            pixels_per_metre: 1.0,
            plan_px: [0, 0],
            corner: [0, 0],
        };
        let text = format!("{} x", (speed * 100.0).round() / 100.0);
        label.text([(WIDTH as i64 - text_width(&text)).max(0) / 2, 1], &text, TEXT, None);
        ([left, top], label.picture)
    }
}

/// Minutes and seconds, with hours where there are some.
pub(super) fn clock(time_s: f64) -> String {
    let seconds = time_s.max(0.0) as u64;
    let (hours, minutes, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    if hours > 0 { format!("{hours}:{minutes:02}:{seconds:02}") } else { format!("{minutes}:{seconds:02}") }
}
