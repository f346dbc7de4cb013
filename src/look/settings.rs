use std::path::PathBuf;

use super::colours::{DUST, RUBBER, SOIL_DRY, SOIL_WET, WHEELS};
use super::material::Material;
use super::octaves::NoiseLook;
use super::wall::WallLook;
use crate::math::srgb::Srgb8;
use crate::options::options;

options! {
    /// The look: settings that turn sums into textures. Changing them needs no new simulation.
    ///
    /// A look file is TOML with these keys; keys that it leaves out keep the value of the preset that it names:
    ///
    /// ```toml
    /// preset = "heavy"
    /// [floor]
    /// material = "dark"
    /// [film]
    /// density = 0.6
    /// ```
    ///
    /// Densities are optical densities D: dirt covers the floor with opacity 1 - exp(-D).
    pub struct Look {
        /// "commuters", "heavy", "wet" or "paper": what this section's keys start from.
        preset: String = "commuters".to_string();
        /// Another number, another noise.
        seed: u64 = 1;
        /// How many people the floor has seen; the simulated ones stand for them.
        total_passes: u64 = 20_000, in 1.0..=1e9;
        /// Value in sRGB below which dirt darkens nothing.
        darkest: f32 = 50.0, in 0.0..=255.0;
        /// The clean floor.
        floor: FloorLook = FloorLook::default();
        /// The grey film that all passes leave together: the lane.
        film: FilmLook = FilmLook::default();
        /// What people leave where they stand: in lines, at counters and machines, by benches.
        dwell: DwellLook = DwellLook::default();
        /// Lines of cases on wheels, trolleys, prams and wheelchairs.
        wheels: WheelsLook = WheelsLook::default();
        /// What lies everywhere, also where nobody walks.
        age: AgeLook = AgeLook::default();
        /// What cleaning takes and leaves.
        mop: MopLook = MopLook::default();
        /// Wear: lost wax, polish, bare wood.
        wear: WearLook = WearLook::default();
        /// Single prints that can be read.
        prints: PrintsLook = PrintsLook::default();
        /// Rain outside: what wet shoes bring in.
        wet: WetLook = WetLook::default();
        /// Black marks of heels and toes.
        scuffs: ScuffsLook = ScuffsLook::default();
        /// The dirty line along the skirting, where no mop reaches.
        edge: EdgeLook = EdgeLook::default();
        /// Dust off the lanes.
        dust: DustLook = DustLook::default();
        /// Unevenness of film and dust, in plan space: it does not move when the texel density changes.
        noise: NoiseLook = NoiseLook::default();
        /// The walls: all of the above but `seed` and `darkest` is about the floor.
        wall: WallLook = WallLook::default();
        /// Parts of the floor with a material of their own; later ones lie over earlier ones.
        area: Vec<AreaLook> = Vec::new();
    }
}

options! {
    /// The clean floor.
    pub struct FloorLook {
        /// What is under the dirt.
        material: Material = Material::Vinyl;
        /// Colour in sRGB of the clean floor; left out: the material's.
        colour: Option<Srgb8> = None, eg "[198, 194, 186]";
        /// How much of the material's own texture shows.
        ///
        /// 0 is flat, 1 as the material has it.
        texture: f32 = 1.0, in 0.0..=3.0;
        /// Or an image of the clean floor, repeated; or a folder with images of colour, roughness, height and normals.
        ///
        /// Images of a folder are known by their names, as libraries of materials give them: `wood_diff.jpg`,
        /// `wood_rough.jpg`, `wood_disp.png`, `wood_nor_gl.png`, or `Wood_Color.png`, `Wood_NormalDX.png` and so on.
        image: Option<PathBuf> = None, eg "\"oak.png\"";
        /// Width and height of the floor that the image shows.
        image_size_m: [f64; 2] = [2.0, 2.0], in 0.01..=1000.0, unit "m";
        /// How far a folder's image of the height goes from black to white.
        image_height_mm: f32 = 2.0, in 0.0..=100.0, unit "mm";
        /// Of the clean floor; left out: the material's.
        roughness: Option<f32> = None, in 0.0..=1.0, eg "0.35";
        /// Where many have walked; left out: the material's.
        roughness_trodden: Option<f32> = None, in 0.0..=1.0, eg "0.5";
        /// Side of a tile, material "tile".
        tile_m: f64 = 0.3, in 0.02..=5.0, unit "m";
        /// Width of a joint, material "tile".
        joint_m: f64 = 0.004, in 0.0..=0.05, unit "m";
    }
}

options! {
    /// A part of the floor with a material of its own: give its outline, or a place in the room that has it.
    pub struct AreaLook {
        /// Its outline: two opposite corners, or three and more corners in a row, [x, y] in metres.
        outline: Vec<[f64; 2]> = Vec::new(), in -10000.0..=10000.0, unit "m", eg "[[2.0, 1.0], [6.5, 4.0]]";
        /// Or a place in a room, which ends at walls and doorways.
        room: Option<[f64; 2]> = None, in -10000.0..=10000.0, unit "m", eg "[3.0, 2.5]";
        /// The clean floor there.
        floor: FloorLook = FloorLook::default();
    }
}

options! {
    /// The film: D = density ln(1 + per_pass n) / ln(1 + 1000 per_pass) for n passes, times noise.
    ///
    /// A logarithm, as every further pass adds less, but a busy lane still shows against a quieter one.
    pub struct FilmLook {
        /// Optical density after 1000 passes over a spot.
        density: f32 = 0.72, in 0.0..=3.0;
        /// What the first pass adds, relative to the density of an e-fold of passes.
        per_pass: f32 = 0.03, in 0.0..=1.0;
        /// How far simulated passes are evened out, for those beside them.
        ///
        /// Standard deviation of the Gaussian that evens out the simulated passes.
        ///
        /// It stands for the people who were not simulated and walked beside. The deviation of single passes is kept,
        /// scaled by 1/sqrt(w).
        spread_m: f64 = 0.0, in 0.0..=0.5, unit "m";
        /// Colour, sRGB.
        colour: Srgb8 = SOIL_DRY;
    }
}

options! {
    /// Standing: D = density ln(1 + per_second s) / ln(1 + 1000 per_second) for s seconds that soles stood, added to the film.
    pub struct DwellLook {
        /// Optical density of the film where soles stood for 1000 seconds; 0 switches it off.
        density: f32 = 0.2, in 0.0..=3.0;
        /// What the first second adds, relative to the density of an e-fold of seconds.
        per_second: f32 = 0.01, in 0.0..=1.0;
        /// Factor on gum, drips and rings of cups where people stand; 0 leaves them to passes.
        gum: f32 = 16.0, in 0.0..=100.0;
    }
}

options! {
    /// Wheels: D = density (1 - exp(-per_wheel n)) for n wheels. One leaves a line; the lines of many are a soft band.
    pub struct WheelsLook {
        /// Optical density where many wheels have rolled; 0: none.
        density: f32 = 0.22, in 0.0..=3.0;
        /// What a wheel adds, of what is still missing.
        per_wheel: f32 = 0.2, in 0.0..=1.0;
        /// Colour, sRGB.
        colour: Srgb8 = WHEELS;
    }
}

options! {
    /// Age: a thin film and single stains everywhere.
    pub struct AgeLook {
        /// Optical density of the film where nobody walks.
        density: f32 = 0.05, in 0.0..=3.0;
        /// Stains and trails of drips.
        stains_per_m2: f32 = 0.12, in 0.0..=20.0, unit "1/m2";
        /// Faint rubs of soles along the way where 1000 have passed; they grow with the square root of passes.
        rubs_per_m2: f32 = 24.0, in 0.0..=90.0, unit "1/m2";
        /// Grit, twice that on lanes.
        grit_per_m2: f32 = 14.0, in 0.0..=60.0, unit "1/m2";
        /// Trodden chewing gum where 1000 have passed; it grows with the square root of passes.
        gum_per_m2: f32 = 0.25, in 0.0..=20.0, unit "1/m2";
    }
}

options! {
    /// Cleaning: a mop or machine goes back and forth along the longer way of each place.
    pub struct MopLook {
        /// Share of the film that it takes where it passes.
        takes: f32 = 0.4, in 0.0..=0.95;
        /// People who walk between two cleanings: fewer keep lanes lighter.
        ///
        /// People who walk between two cleanings: what can be taken of the film tends to that of `every` / `takes` people.
        every: f32 = 1000.0, in 1.0..=1e9, unit "people";
        /// Width of a pass.
        width_m: f64 = 0.55, in 0.1..=3.0, unit "m";
        /// How unevenly it takes: streaks, swings and borders of passes.
        unevenness: f32 = 0.625, in 0.0..=3.0;
    }
}

options! {
    /// Wear, 1 - exp(-n / passes) with the passes that the material stands.
    pub struct WearLook {
        /// Factor on wear of colour and gloss.
        strength: f32 = 1.0, in 0.0..=3.0;
        /// How much more steps wear that turn, stop or set out; 0: all steps wear alike.
        turns: f32 = 1.0, in 0.0..=10.0;
    }
}

options! {
    /// Readable prints.
    pub struct PrintsLook {
        /// Factor on the soil of fresh prints.
        soil: f32 = 9.0, in 0.0..=50.0;
        /// Optical density that every print paints: the paper's way.
        every_pass: f32 = 0.0, in 0.0..=3.0;
        /// Colour, sRGB.
        colour: Srgb8 = SOIL_DRY;
    }
}

options! {
    /// Rain outside: tracks of wet shoes, from the entrances from outside inwards, and puddles.
    pub struct WetLook {
        /// Factor on the dirt of wet tracks; 0: a dry day.
        tracks: f32 = 0.0, in 0.0..=20.0;
        /// How much of the water has not dried: it shines, and darkens floors that take it up.
        water: f32 = 0.0, in 0.0..=1.0;
        /// Optical density of the line at the edge of puddles, which stand where many wet shoes came.
        puddles: f32 = 0.0, in 0.0..=3.0;
    }
}

options! {
    /// Heel and toe marks.
    pub struct ScuffsLook {
        /// Factor on heel and toe marks.
        strength: f32 = 1.8, in 0.0..=20.0;
        /// Colour, sRGB.
        colour: Srgb8 = RUBBER;
    }
}

options! {
    /// The skirting line: D = density exp(-d / reach) at the distance d from the wall, broken up along the wall.
    pub struct EdgeLook {
        /// Optical density of the skirting line at the wall.
        density: f32 = 0.30, in 0.0..=3.0;
        /// Falls to 1/e in this distance.
        reach_m: f32 = 0.04, in 0.005..=0.5, unit "m";
        /// How broken the line is.
        ///
        /// Relative unevenness along the wall (standard deviation of the logarithm).
        unevenness: f32 = 0.45, in 0.0..=1.5;
        /// How many times as much lies in an inner corner.
        corner: f32 = 1.75, in 1.0..=4.0;
        /// How far a corner is felt.
        corner_radius_m: f32 = 0.10, in 0.01..=0.5, unit "m";
        /// Colour, sRGB.
        colour: Srgb8 = SOIL_WET;
    }
}

options! {
    /// Dust: D = density exp(-d / reach), walked off as the film grows.
    pub struct DustLook {
        /// Optical density of dust at the wall.
        density: f32 = 0.10, in 0.0..=3.0;
        /// Falls to 1/e in this distance.
        reach_m: f32 = 0.30, in 0.02..=3.0, unit "m";
        /// Colour, sRGB.
        colour: Srgb8 = DUST;
    }
}

impl AgeLook {
    /// A floor without age.
    pub(super) fn none() -> AgeLook {
        AgeLook { density: 0.0, stains_per_m2: 0.0, rubs_per_m2: 0.0, grit_per_m2: 0.0, gum_per_m2: 0.0 }
    }
}

impl Look {
    /// Returns the same look without dirt and wear.
    pub fn clean(&self) -> Look {
        let mut look = Look { wall: self.wall.clean(), ..self.clone() };
        look.film.density = 0.0;
        look.dwell.density = 0.0;
        look.wheels.density = 0.0;
        look.age = AgeLook::none();
        look.wear.strength = 0.0;
        look.prints.soil = 0.0;
        look.prints.every_pass = 0.0;
        look.wet = WetLook::default();
        look.scuffs.strength = 0.0;
        look.edge.density = 0.0;
        look.dust.density = 0.0;
        look
    }

    /// Paths of the images, or of folders of images, of floor, wall and areas.
    pub fn images(&mut self) -> Vec<Option<&mut PathBuf>> {
        let areas = self.area.iter_mut().map(|area| area.floor.image.as_mut());
        [self.floor.image.as_mut(), self.wall.image.as_mut()].into_iter().chain(areas).collect()
    }
}
