//! Materials of furniture, doors and windows.

use crate::math::srgb::Srgb8;
use crate::walls::{COUNTER_M, TABLES_M};

/// Lower furniture is a seat, metres; others are tables, fixtures, counters and gates.
pub(super) const SEATS_M: f64 = 0.6;

/// What a fitting is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Finish {
    /// Veneer of a door leaf.
    Door,
    /// Light wood of table tops and benches.
    Wood,
    /// Lacquered steel of legs and frames.
    Steel,
    /// Brushed metal of handles and gates.
    Metal,
    /// Dark fabric of chairs.
    Seat,
    /// Fabric of sofas.
    Upholstery,
    /// Bed linen.
    Linen,
    /// Top of a counter.
    Counter,
    /// Ceramic of basins.
    Ceramic,
    /// White frames of windows.
    WindowFrame,
    /// A window's glass: the day behind it.
    Pane,
}

impl Finish {
    /// All, in the order of [`SceneSurface::Fitting`](crate::show::scene::SceneSurface::Fitting).
    pub const ALL: [Finish; 11] = [
        Finish::Door,
        Finish::Wood,
        Finish::Steel,
        Finish::Metal,
        Finish::Seat,
        Finish::Upholstery,
        Finish::Linen,
        Finish::Counter,
        Finish::Ceramic,
        Finish::WindowFrame,
        Finish::Pane,
    ];

    /// What furniture of a height is made of that is drawn as a block.
    pub fn of_block(top_m: f64) -> Finish {
        match top_m {
            top if top < SEATS_M => Finish::Upholstery,
            top if top < TABLES_M => Finish::Wood,
            top if top < COUNTER_M => Finish::Ceramic,
            _ => Finish::Counter,
        }
    }

    /// Name of its material in the scene.
    pub fn name(self) -> &'static str {
        ["door", "wood", "steel", "metal", "seat", "upholstery", "linen", "counter", "ceramic", "window_frame", "pane"]
            [self as usize]
    }

    /// Base colour, sRGB.
    pub fn colour(self) -> Srgb8 {
        match self {
            Finish::Door => [190, 172, 146],
            Finish::Wood => [206, 190, 164],
            Finish::Steel => [58, 60, 63],
            Finish::Metal => [158, 160, 162],
            Finish::Seat => [46, 50, 60],
            Finish::Upholstery => [92, 98, 104],
            Finish::Linen => [222, 220, 214],
            Finish::Counter => [84, 74, 66],
            Finish::Ceramic => [232, 232, 228],
            Finish::WindowFrame => [226, 226, 222],
            Finish::Pane => [235, 242, 250],
        }
    }

    /// Roughness, 0 to 1.
    pub fn roughness(self) -> f32 {
        match self {
            Finish::Seat | Finish::Upholstery | Finish::Linen => 0.9,
            Finish::Door | Finish::Wood => 0.45,
            Finish::Counter | Finish::WindowFrame | Finish::Steel => 0.4,
            Finish::Metal => 0.3,
            Finish::Ceramic | Finish::Pane => 0.15,
        }
    }

    /// How much its grain varies its light: share.
    pub fn grain(self) -> f32 {
        match self {
            Finish::Door => 0.12,
            Finish::Wood => 0.12,
            Finish::Counter | Finish::Metal => 0.05,
            Finish::Seat | Finish::Upholstery | Finish::Linen => 0.08,
            _ => 0.0,
        }
    }
}
