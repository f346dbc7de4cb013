//! How things touch a wall: rubs, dabs, and the wall's own texture that breaks both up. Centimetres; +x is the way
//! of the drag, +y up.

use trodden::math::{Vec2, exp, vec2};

use super::super::noise;
use super::super::shape::{smoothstep, unturned};

/// Something drawn along the wall: soft at its sides, of streaks that come on and give out one by one.
#[derive(Clone, Copy)]
pub struct Rub {
    /// Where it begins and ends.
    pub from: f64,
    pub to: f64,
    /// y of its middle line at the start, half way, and at the end.
    pub bend: [f64; 3],
    /// Half its breadth there.
    pub half: [f64; 3],
    /// How much it leaves, about 0 to 1.
    pub strength: f64,
    /// Shares of the length: over which it comes on, and from which it fades.
    pub attack: f64,
    pub hold: f64,
    /// How much of its breadth is soft edge, 0 to 1.
    pub soft: f64,
    /// How streaky it is, 0 to 1, and how broad a streak is.
    pub streaks: f64,
    pub streak: f64,
    /// How patchy it is, 0 to 1, and how large a patch is.
    pub patches: f64,
    pub patch: f64,
    pub seed: u64,
}

/// Something set down on the wall.
#[derive(Clone, Copy)]
pub struct Dab {
    pub middle: Vec2,
    pub radii: Vec2,
    /// Radians counter-clockwise.
    pub turned: f64,
    pub strength: f64,
    /// How much of it is soft edge, 0 to 1.
    pub soft: f64,
    /// How far its edge strays, share of the radius.
    pub ragged: f64,
    pub seed: u64,
}

/// What the wall's texture makes of a touch.
#[derive(Clone, Copy)]
pub struct Wall {
    /// 0: the touch reaches into the texture (skin, dust); 1: only onto its heights (rubber, hard edges).
    pub hard: f64,
    /// How strong the texture is, 0 to 1.
    pub stipple: f64,
    pub seed: u64,
}

/// The parabola through three points at 0, 1/2 and 1.
fn through([a, b, c]: [f64; 3], t: f64) -> f64 {
    a + t * ((4.0 * b - 3.0 * a - c) + t * (2.0 * (a + c) - 4.0 * b))
}

impl Rub {
    /// What it leaves on a smooth wall.
    pub fn load(&self, p: Vec2) -> f64 {
        let length = self.to - self.from;
        let t = (p.x - self.from) / length;
        if !(-0.2..=1.2).contains(&t) {
            return 0.0;
        }
        let half = through(self.half, t.clamp(0.0, 1.0)).max(0.05);
        // The hand that draws it is not quite steady.
        let sway = 0.10 * half * noise::value(vec2(p.x, 0.0), 0.22 * length + half, self.seed);
        let off = p.y - through(self.bend, t) - sway;
        if off.abs() > 1.5 * half {
            return 0.0;
        }
        let ragged = 0.20 * noise::cloudy(p, 0.9 * half, 3, self.seed + 1);
        let body = smoothstep(1.12, 1.12 - 0.15 - 0.95 * self.soft, (off / half).abs() + ragged);
        let streak = self.streak_at(p.x, off);
        // Each streak comes on and gives out at a place of its own.
        let early = noise::value(vec2(0.0, off), 1.6 * self.streak, self.seed + 2);
        let late = noise::value(vec2(7.0, off), 1.6 * self.streak, self.seed + 3);
        let on = smoothstep(0.0, 1.0, (t + 0.5 * self.attack * early) / self.attack.max(1e-3));
        let fade = smoothstep(1.0, 0.0, (t - self.hold + 0.16 * late * self.streaks) / (1.0 - self.hold));
        // Never before its beginning, whatever the streaks do: the image would cut it off.
        let level = on * fade * smoothstep(0.0, 0.6 * self.attack, t);
        let patchy = 1.0 + 1.5 * self.patches * noise::cloudy(p, self.patch, 3, self.seed + 4);
        // Where little is left, only the strongest streaks still draw.
        let drawn = level + self.streaks * (0.45 + 0.65 * (1.0 - level)) * streak;
        self.strength * body * drawn.max(0.0) * smoothstep(0.0, 0.08, level) * patchy.max(0.0)
    }

    /// Noise that is long along the rub and narrow across, in [-1, 1].
    fn streak_at(&self, x: f64, off: f64) -> f64 {
        let at = |stretch: f64, breadth: f64, n: u64| {
            noise::value(vec2(x * breadth / stretch, off), breadth, self.seed + 10 + n)
        };
        let broad = at(14.0, self.streak, 0);
        let middle = at(9.0, 0.45 * self.streak, 1);
        let fine = at(4.0, 0.2 * self.streak, 2);
        0.5 * broad + 0.32 * middle + 0.18 * fine
    }
}

impl Dab {
    /// What it leaves on a smooth wall.
    pub fn load(&self, p: Vec2) -> f64 {
        let q = unturned(p - self.middle, self.turned);
        let d = vec2(q.x / self.radii.x, q.y / self.radii.y).length();
        if d > 1.6 {
            return 0.0;
        }
        let size = 0.7 * (self.radii.x + self.radii.y);
        let strays = self.ragged * noise::cloudy(p, size, 3, self.seed);
        let uneven = 1.0 + 0.35 * noise::cloudy(p, 0.6 * size, 2, self.seed + 1);
        self.strength * uneven.max(0.0) * smoothstep(1.15, 1.15 - 0.12 - 1.03 * self.soft, d + strays)
    }
}

impl Wall {
    /// Coverage of a touch by the sum of the loads on a place.
    pub fn take(&self, load: f64, p: Vec2) -> f64 {
        if load <= 0.0 {
            return 0.0;
        }
        // Touches over each other fill up what is still clean.
        let load = 1.0 - exp(-1.1 * load);
        let height = self.stipple * self.height(p);
        let into = load * (1.0 + 0.45 * height);
        let rests = 0.5 - 0.5 * height;
        let onto = smoothstep(rests - 0.10, rests + 0.42, 1.45 * load) * load.max(0.35 * load.sqrt());
        into + (onto - into) * self.hard
    }

    /// What a roller leaves in paint: lumps of 2 to 4 mm, with finer grain on them. In [-1, 1].
    fn height(&self, p: Vec2) -> f64 {
        let lumps =
            noise::value(p, 0.34, self.seed + 90) + 0.8 * noise::value(p.rotated(vec2(0.8, 0.6)), 0.21, self.seed + 91);
        let grain = noise::value(p.rotated(vec2(0.6, 0.8)), 0.11, self.seed + 92);
        (0.62 * lumps + 0.5 * grain).clamp(-1.0, 1.0)
    }
}
