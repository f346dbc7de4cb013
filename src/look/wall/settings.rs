use std::path::PathBuf;

use super::material::WallMaterial;
use crate::look::colours::{BAG, CLOTH, SKIN, SOIL_WET};
use crate::look::octaves::{NoiseLook, Octave};
use crate::math::srgb::Srgb8;
use crate::options::options;

options! {
    /// The look of walls: the section `[wall]`.
    ///
    /// Densities are optical densities D, as on the floor. A stain's density follows from the touches S of its cause and from
    /// their mean E around: n = strength (w E + g (S - E)) with w = total_passes / people for whom touches were drawn, and
    /// g = sqrt(w), at most 8; D = density n / (density + n). Where many have touched, a closed soft patch grows; what one
    /// touch left stays single and faint. Where w is 1 or less, it is n = strength w S.
    pub struct WallLook {
        /// "matt" or "gloss" paint, "concrete", "brick", or "tile" up to 1.5 m with paint above: colour, texture, how stains stay on it.
        material: WallMaterial = WallMaterial::Matt;
        /// Colour in sRGB of the clean wall; left out: the material's.
        colour: Option<Srgb8> = None, eg "[228, 227, 223]";
        /// How much of the material's own texture shows: the stipple of a roller, formwork, bricks.
        ///
        /// 0 is dead flat, 1 as the material has it. With 0, painted walls that nobody touches take next to no space in files.
        texture: f32 = 1.0, in 0.0..=3.0;
        /// Or an image of the clean wall, repeated.
        image: Option<PathBuf> = None, eg "\"brick.png\"";
        /// Width and height of the wall that the image shows.
        image_size_m: [f64; 2] = [2.0, 2.0], in 0.01..=1000.0, unit "m";
        /// Of the clean wall; left out: the material's.
        roughness: Option<f32> = None, in 0.0..=1.0, eg "0.85";
        /// How many people have passed since it was painted or washed.
        ///
        /// Walls are painted far less often than floors are cleaned to the ground.
        total_passes: u64 = 200_000, in 1.0..=1e9;
        /// Factor on simulated touches as they are: the paper's way.
        every_touch: f32 = 0.0, in 0.0..=20.0;
        /// Stains of hands.
        skin: StainLook = StainLook::default();
        /// Stains of arms and shoulders.
        cloth: StainLook = StainLook { density: 0.34, spread_m: 0.07, colour: CLOTH, ..StainLook::default() };
        /// Stains of bags, cases, trolleys.
        bag: StainLook = StainLook { density: 0.42, colour: BAG, ..StainLook::default() };
        /// Stains of shoes.
        rubber: StainLook = StainLook { strength: 3.0, density: 1.1, spread_m: 0.03, colour: [40, 42, 46] };
        /// Paint that bags and trolleys have knocked off outer corners and jambs; 0: none.
        chips: f32 = 1.0, in 0.0..=10.0;
        /// Splashes of mopping.
        splash: SplashLook = SplashLook::default();
        /// Grey film low on the wall.
        dust: WallDustLook = WallDustLook::default();
        /// The board along the foot of the wall.
        skirting: SkirtingLook = SkirtingLook::default();
        /// Width of the frames around doors up to 1.6 m wide, images of frames; 0: none.
        frame_m: f32 = 0.06, in 0.0..=0.3, unit "m";
        /// Colour of the frames, sRGB.
        frame_colour: Srgb8 = [150, 152, 152];
        /// Colour of the sides of counters, sRGB.
        counter_colour: Srgb8 = [150, 128, 102];
        /// Colour of the sides of gates, sRGB: counters that are narrower than half a metre.
        gate_colour: Srgb8 = [172, 175, 177];
        /// Unevenness of all dirt, along the wall and up.
        noise: NoiseLook = NoiseLook {
            fine: Octave { size_m: 0.012, sd: 0.14 },
            middle: Octave { size_m: 0.09, sd: 0.20 },
            coarse: Octave { size_m: 0.6, sd: 0.22 },
        };
    }
}

options! {
    /// Stains of one kind of touch.
    #[derive(Copy)]
    pub struct StainLook {
        /// Factor on the touches.
        strength: f32 = 3.0, in 0.0..=20.0;
        /// Optical density where the wall takes up no more of it.
        density: f32 = 0.50, in 0.0..=3.0;
        /// How far simulated touches are evened out, for those beside them.
        ///
        /// Standard deviation of a Gaussian.
        spread_m: f64 = 0.06, in 0.005..=0.5, unit "m";
        /// Colour of a thick layer, sRGB: the darker a channel, the more light of it the dirt absorbs.
        colour: Srgb8 = SKIN;
    }
}

options! {
    /// The splash band of mopping.
    #[derive(Copy)]
    pub struct SplashLook {
        /// Optical density that mopping leaves at the foot of the wall.
        density: f32 = 0.09, in 0.0..=3.0;
        /// Where the splash band is nearly gone; it thins out softly.
        height_m: f32 = 0.12, in 0.01..=1.0, unit "m";
        /// How uneven it is.
        unevenness: f32 = 0.7, in 0.0..=1.5;
        /// Drips that ran down.
        drips_per_metre: f32 = 0.1, in 0.0..=20.0;
        /// Colour, sRGB.
        colour: Srgb8 = SOIL_WET;
    }
}

options! {
    /// Dust: D = density exp(-h / reach) at the height h up to three times the reach, and D = hands around 1.15 m.
    #[derive(Copy)]
    pub struct WallDustLook {
        /// Optical density of dust at the foot of the wall.
        density: f32 = 0.05, in 0.0..=3.0;
        /// Falls to 1/e in this height.
        reach_m: f32 = 0.05, in 0.02..=3.0, unit "m";
        /// Optical density of a film at hand height along all walls.
        hands: f32 = 0.0, in 0.0..=3.0;
        /// Colour, sRGB.
        colour: Srgb8 = [150, 142, 129];
    }
}

options! {
    /// A skirting board: an image of one, with dust on its upper edge.
    #[derive(Copy)]
    pub struct SkirtingLook {
        /// Of a skirting board; 0: none.
        ///
        /// Height, metres, 0 (none) to 0.5.
        height_m: f32 = 0.08, in 0.0..=0.5, unit "m";
        /// Colour, sRGB.
        colour: Srgb8 = [190, 187, 180];
    }
}

impl WallLook {
    /// Returns the look of a wall without texture, skirting board and frames.
    pub(in crate::look) fn plain(&self) -> WallLook {
        WallLook {
            texture: 0.0,
            skirting: SkirtingLook { height_m: 0.0, ..self.skirting },
            frame_m: 0.0,
            ..self.clone()
        }
    }

    /// Returns the look of a clean wall.
    pub(in crate::look) fn clean(&self) -> WallLook {
        let clean = |stain: StainLook| StainLook { strength: 0.0, ..stain };
        WallLook {
            every_touch: 0.0,
            chips: 0.0,
            skin: clean(self.skin),
            cloth: clean(self.cloth),
            bag: clean(self.bag),
            rubber: clean(self.rubber),
            splash: SplashLook { density: 0.0, drips_per_metre: 0.0, ..self.splash },
            dust: WallDustLook { density: 0.0, hands: 0.0, ..self.dust },
            ..self.clone()
        }
    }
}
