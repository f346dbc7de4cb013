use super::colours::SOIL_WET;
use super::octaves::{NoiseLook, Octave};
use super::settings::{EdgeLook, FilmLook, IngrainedLook, Look, PrintsLook, ScuffsLook};
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
        film: FilmLook { density: 0.67, colour: [98, 89, 76], ..look.film },
        ingrained: IngrainedLook { density: 0.20, ..look.ingrained },
        // Scuffs show less under so dense a film.
        scuffs: ScuffsLook { strength: 0.9, ..look.scuffs },
        edge: EdgeLook { density: 0.45, reach_m: 0.05, ..look.edge },
        wall: heavy_wall(look.wall),
        // A complete film is even.
        noise: NoiseLook {
            fine: Octave { sd: 0.07, ..look.noise.fine },
            middle: Octave { sd: 0.06, ..look.noise.middle },
            coarse: Octave { sd: 0.11, ..look.noise.coarse },
        },
        ..look
    }
}

fn wet() -> Look {
    let look = Look::default();
    Look {
        film: FilmLook { colour: SOIL_WET, ..look.film },
        prints: PrintsLook { soil: 4.5, colour: SOIL_WET, ..look.prints },
        noise: NoiseLook { middle: Octave { sd: 0.14, ..look.noise.middle }, ..look.noise },
        // Wet floors are mopped more often.
        wall: WallLook { splash: SplashLook { density: 0.30, drips_per_metre: 0.5, ..look.wall.splash }, ..look.wall },
        ..look
    }
}

fn paper() -> Look {
    let mut look = Look { total_passes: 1, ..Look::default() };
    look.film.density = 0.0;
    look.ingrained.density = 0.0;
    look.prints.soil = 0.0;
    look.prints.every_pass = 0.06;
    look.scuffs.strength = 0.0;
    look.edge.density = 0.0;
    look.dust.density = 0.0;
    look.floor.texture = 0.0;
    for octave in [&mut look.noise.fine, &mut look.noise.middle, &mut look.noise.coarse] {
        octave.sd = 0.0;
    }
    look.wall = WallLook { every_touch: 1.0, texture: 0.0, ..look.wall.clean() };
    look
}

fn heavy_wall(wall: WallLook) -> WallLook {
    let denser = |stain: StainLook, by: f32| StainLook { density: by * stain.density, ..stain };
    WallLook {
        total_passes: 100_000,
        skin: denser(wall.skin, 1.3),
        cloth: denser(wall.cloth, 1.3),
        bag: denser(wall.bag, 1.25),
        rubber: denser(wall.rubber, 1.2),
        splash: SplashLook { density: 0.34, drips_per_metre: 0.6, ..wall.splash },
        dust: WallDustLook { density: 0.09, ..wall.dust },
        ..wall
    }
}
