use super::colours::SOIL_WET;
use super::octaves::{NoiseLook, Octave};
use super::settings::{
    AgeLook, DwellLook, EdgeLook, FilmLook, Look, MopLook, PrintsLook, ScuffsLook, WetLook, WheelsLook,
};
use super::wall::{SplashLook, StainLook, WallDustLook, WallLook};

/// Names of the presets, in the order of help texts.
pub const LOOK_PRESETS: [&str; 4] = ["commuters", "heavy", "wet", "paper"];

impl Look {
    /// Returns the settings of a preset in `LOOK_PRESETS`; `None` for other names.
    ///
    /// - `commuters`: an office or a station in dry weather, mopped daily. The default.
    /// - `heavy`: the same floor long overdue for a deep clean, walls long overdue for a coat of paint.
    /// - `wet`: a rainy day; darker soil, visible prints, an uneven film.
    /// - `paper`: only overlapping prints, as in Takenaka, Tanaka and Sagawa, *Expression of indoor grime by human
    ///   walk*.
    pub fn preset(name: &str) -> Option<Look> {
        let look = match name {
            "commuters" => Look::default(),
            "heavy" => heavy(),
            "wet" => wet(),
            "paper" => paper(),
            _ => return None,
        };
        Some(Look { preset: name.to_string(), ..look })
    }
}

fn heavy() -> Look {
    let look = Look::default();
    Look {
        total_passes: 50_000,
        film: FilmLook { density: 0.92, ..look.film },
        age: AgeLook { density: 0.13, stains_per_m2: 0.5, gum_per_m2: 0.6, rubs_per_m2: 36.0, grit_per_m2: 20.0 },
        dwell: DwellLook { density: 0.26, ..look.dwell },
        wheels: WheelsLook { density: 0.28, ..look.wheels },
        mop: MopLook { takes: 0.2, unevenness: 1.3, ..look.mop },
        scuffs: ScuffsLook { strength: 2.2, ..look.scuffs },
        noise: NoiseLook { fine: Octave { sd: 0.07, ..look.noise.fine }, ..look.noise },
        edge: EdgeLook { density: 0.45, reach_m: 0.05, ..look.edge },
        wall: heavy_wall(look.wall),
        ..look
    }
}

fn wet() -> Look {
    let look = Look::default();
    Look {
        // Rain brings in more than dry days do.
        film: FilmLook { density: 0.9, colour: SOIL_WET, ..look.film },
        age: AgeLook { stains_per_m2: 0.6, ..look.age },
        // Rain lays the dust.
        prints: PrintsLook { soil: 4.0, colour: SOIL_WET, ..look.prints },
        wet: WetLook { tracks: 3.0, water: 0.9, puddles: 0.3 },
        noise: NoiseLook { middle: Octave { sd: 0.1, ..look.noise.middle }, ..look.noise },
        // Wet floors are mopped more often.
        wall: WallLook { splash: SplashLook { density: 0.13, drips_per_metre: 0.25, ..look.wall.splash }, ..look.wall },
        ..look
    }
}

fn paper() -> Look {
    let mut look = Look { total_passes: 1, ..Look::default() };
    look.film.density = 0.0;
    look.dwell.density = 0.0;
    look.wheels.density = 0.0;
    look.age = AgeLook::none();
    look.mop.takes = 0.0;
    look.wear.strength = 0.0;
    look.prints.soil = 0.0;
    look.prints.every_pass = 0.8;
    look.scuffs.strength = 0.0;
    look.edge.density = 0.0;
    look.dust.density = 0.0;
    look.floor.texture = 0.0;
    for octave in [&mut look.noise.fine, &mut look.noise.middle, &mut look.noise.coarse] {
        octave.sd = 0.0;
    }
    look.wall = WallLook { every_touch: 1.0, ..look.wall.clean().plain() };
    look
}

fn heavy_wall(wall: WallLook) -> WallLook {
    let denser = |stain: StainLook, by: f32| StainLook { density: by * stain.density, ..stain };
    WallLook {
        total_passes: 500_000,
        skin: denser(wall.skin, 1.3),
        cloth: denser(wall.cloth, 1.3),
        bag: denser(wall.bag, 1.25),
        rubber: denser(wall.rubber, 1.2),
        splash: SplashLook { density: 0.14, drips_per_metre: 0.25, ..wall.splash },
        dust: WallDustLook { density: 0.09, ..wall.dust },
        ..wall
    }
}
