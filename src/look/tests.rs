//! Quantitative tests of the look on a trodden corridor.

use super::*;
use crate::marks::Mark;
use crate::math::srgb::{self, light_of};
use crate::math::{SplitMix64, Vec2, exp, vec2};
use crate::patterns::{Cause, PatternLibrary};
use crate::plan::FloorPlan;
use crate::stamps::{StampOptions, Stamper, TexelGrid};
use crate::sums::FloorSums;
use crate::walls::{Outline, Walls, WallsOptions};
use std::sync::LazyLock;

/// Texel density of all test floors, texels per metre.
const DENSITY: f64 = 100.0;
const LENGTH_M: f64 = 12.0;
const WIDTH_M: f64 = 4.0;
/// Thickness of the walls around, metres.
const WALL_M: f64 = 0.5;
const PEOPLE: u32 = 1000;

/// CIE L* of linear luminance.
pub(in crate::look) fn lightness(linear: [f32; 3]) -> f64 {
    srgb::lightness(srgb::luminance(linear.map(f64::from)))
}

#[test]
fn lightness_of_the_light_vinyl_is_about_78() {
    assert!((lightness(light_of([197, 192, 182])) - 78.0).abs() < 0.5);
}

/// A floor with its sums.
struct SummedFloor {
    walls: Walls,
    sums: FloorSums,
}

/// A corridor from west to east, open at both ends, walked by 1000 people.
static CORRIDOR: LazyLock<SummedFloor> = LazyLock::new(|| {
    let walls = walls(LENGTH_M, WIDTH_M + 2.0 * WALL_M, |p| p.y > WALL_M && p.y < WALL_M + WIDTH_M);
    let grid = grid(LENGTH_M, WIDTH_M + 2.0 * WALL_M);
    let library = PatternLibrary::built_in();
    let stamper = Stamper::new(&library, grid, &StampOptions::default()).unwrap();
    let mut sums = FloorSums::new(grid);
    sums.add(&stamper, &walls, &people(&library));
    SummedFloor { walls, sums }
});

/// An empty room of 4 x 3 m.
static ROOM: LazyLock<SummedFloor> = LazyLock::new(|| {
    let walls = walls(5.0, 4.0, |p| p.x > 0.5 && p.x < 4.5 && p.y > 0.5 && p.y < 3.5);
    SummedFloor { walls, sums: FloorSums::new(grid(5.0, 4.0)) }
});

fn grid(width_m: f64, height_m: f64) -> TexelGrid {
    TexelGrid { texels_per_metre: DENSITY, width: (width_m * DENSITY) as u32, height: (height_m * DENSITY) as u32 }
}

fn walls(width_m: f64, height_m: f64, is_floor: impl Fn(Vec2) -> bool) -> Walls {
    let pixel_m = 0.1;
    let (columns, rows) = ((width_m / pixel_m).round() as usize, (height_m / pixel_m).round() as usize);
    let floor = (0..columns * rows).map(|n| {
        let (column, row) = (n % columns, rows - 1 - n / columns);
        u8::from(is_floor(vec2(column as f64 + 0.5, row as f64 + 0.5) * pixel_m))
    });
    let plan = FloorPlan::from_mask(columns as u32, rows as u32, pixel_m, floor.collect());
    Walls::trace(&plan, &WallsOptions::default())
}

/// Footfalls of people who walk straight in both directions, with some heel marks. Most walk in the middle, all at
/// least 28 cm from walls. The last 300 people are fresh.
fn people(library: &PatternLibrary) -> Vec<Mark> {
    let mut rng = SplitMix64::new(7);
    let mut marks = Vec::new();
    for person in 0..PEOPLE {
        let spread = 0.5 * f64::from(rng.unit()) + 0.25 * f64::from(rng.unit() + rng.unit());
        let y = WALL_M + 0.28 + (WIDTH_M - 0.56) * spread;
        let heading = if rng.unit() < 0.5 { vec2(1.0, 0.0) } else { vec2(-1.0, 0.0) };
        let step_m = f64::from(rng.range(0.64, 0.80));
        let load = if person >= PEOPLE - 300 { 0.01 * exp(1.4 * f64::from(rng.normal())) } else { 0.0 };
        let pattern = library.pick(Cause::Sole, f64::from(rng.unit()), None).unwrap();
        let wear = rng.next_u64() as u32;
        let mut way_m = f64::from(rng.unit()) * step_m;
        let mut step = 0;
        while way_m < LENGTH_M + 2.0 {
            let side = if step % 2 == 0 { 0.04 } else { -0.04 };
            let sway = 0.03 * f64::from(rng.normal());
            let x = if heading.x > 0.0 { way_m - 1.0 } else { LENGTH_M + 1.0 - way_m };
            marks.push(Mark {
                cause: Cause::Sole,
                place_m: vec2(x, y + sway) + heading.left() * side,
                heading,
                mirrored: step % 2 == 1,
                pattern,
                length_m: 0.28,
                smear_m: 0.01,
                twist_rad: 0.0,
                forefoot: 0.0,
                effort: 0.0,
                stood_s: 0.0,
                wheel_m: 0.0,
                strength: rng.range(0.85, 1.15),
                soil: (load * 2.68 / (f64::from(step / 2) + 2.68)) as f32,
                wet: 0.0,
                wear,
                variation: rng.next_u64(),
            });
            step += 1;
            way_m += step_m + 0.02 * f64::from(rng.normal());
        }
    }
    for _ in 0..20 {
        let place_m = vec2(f64::from(rng.unit()) * LENGTH_M, WALL_M + WIDTH_M * f64::from(rng.unit()));
        let strength = (0.25 * exp(0.8 * f64::from(rng.normal()))) as f32;
        let pattern = library.pick(Cause::Heel, f64::from(rng.unit()), None).unwrap();
        let heel = Mark {
            cause: Cause::Heel,
            place_m,
            heading: vec2(0.6, 0.8),
            mirrored: false,
            pattern,
            length_m: rng.range(0.02, 0.12),
            smear_m: 0.0,
            twist_rad: 0.0,
            forefoot: 0.0,
            effort: 0.0,
            stood_s: 0.0,
            wheel_m: 0.0,
            strength,
            soil: 0.0,
            wet: 0.0,
            wear: 0,
            variation: rng.next_u64(),
        };
        marks.push(heel);
    }
    marks
}

/// A resolved floor with its lightness.
struct Resolved {
    width: usize,
    block: ResolvedBlock,
    lightness: Vec<f64>,
    clean: f64,
}

fn resolved(scene: &SummedFloor, look: &Look) -> Resolved {
    let resolver = FloorResolver::new(&scene.sums, &scene.walls, look, PEOPLE).unwrap();
    let TexelGrid { width, height, .. } = scene.sums.grid();
    let block = resolver.resolve(0, 0, width as usize, height as usize);
    let lightness = block.base_color.iter().map(|&colour| lightness(light_of(colour))).collect();
    let clean = self::lightness(light_of(resolver.background().base_color));
    Resolved { width: width as usize, block, lightness, clean }
}

fn look(preset: &str, material: Material) -> Look {
    let look = Look::preset(preset).unwrap();
    Look { floor: FloorLook { material, ..look.floor }, ..look }
}

impl Resolved {
    fn layer(&self, name: &str) -> &[f32] {
        &self.block.layers.iter().find(|layer| layer.name == name).unwrap().values
    }

    /// Values of a plane in a rectangle of texels.
    fn cut<T: Copy>(&self, plane: &[T], columns: std::ops::Range<usize>, rows: std::ops::Range<usize>) -> Vec<T> {
        rows.flat_map(|row| plane[row * self.width..][columns.clone()].to_vec()).collect()
    }

    /// Lightness of the corridor's lane, its middle 2 m, as rows.
    fn lane(&self) -> Vec<Vec<f64>> {
        let from = ((WALL_M + WIDTH_M / 2.0 - 1.0) * DENSITY) as usize;
        (from..from + 200).map(|row| self.cut(&self.lightness, 100..1100, row..row + 1)).collect()
    }

    /// Rows of texels in a range of distances, centimetres, from the corridor's south wall.
    fn beside_wall(&self, cm: std::ops::Range<usize>) -> std::ops::Range<usize> {
        let wall = (WALL_M * DENSITY) as usize;
        wall + cm.start..wall + cm.end
    }
}

pub(in crate::look) fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let (sum, count) = values.into_iter().fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count)
}

pub(in crate::look) fn sd(values: &[f64]) -> f64 {
    let middle = mean(values.iter().copied());
    mean(values.iter().map(|value| (value - middle) * (value - middle))).sqrt()
}

pub(in crate::look) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Subtracts the mean over a square of `2 reach + 1` texels from rows.
fn without_large_scale(rows: &[Vec<f64>], reach: usize) -> Vec<Vec<f64>> {
    let blurred = |line: &[f64]| -> Vec<f64> {
        (0..line.len())
            .map(|k| mean(line[k.saturating_sub(reach)..(k + reach + 1).min(line.len())].iter().copied()))
            .collect()
    };
    let across: Vec<Vec<f64>> = rows.iter().map(|row| blurred(row)).collect();
    let columns: Vec<Vec<f64>> =
        (0..rows[0].len()).map(|k| blurred(&across.iter().map(|row| row[k]).collect::<Vec<_>>())).collect();
    let inner = reach..rows.len() - reach;
    inner.map(|j| (reach..rows[0].len() - reach).map(|i| rows[j][i] - columns[i][j]).collect()).collect()
}

#[test]
fn a_broad_lane_darkens_by_the_right_amount() {
    for (preset, low, high) in [("commuters", -12.0, -6.0), ("heavy", -20.0, -15.0), ("wet", -14.0, -6.0)] {
        let floor = resolved(&CORRIDOR, &look(preset, Material::Vinyl));
        let lane = median(floor.lane().concat()) - floor.clean;
        let of = |name| median(floor.cut(floor.layer(name), 100..1100, 150..350).into_iter().map(f64::from).collect());
        println!(
            "{preset}: lane {lane:.1}, presence {:.2}, film D {:.3}, dust {:.3}",
            of("presence"),
            of("film"),
            of("dust")
        );
        assert!((low..=high).contains(&lane), "{preset}: {lane}");
        let mut texels = floor.lane().concat();
        texels.sort_by(f64::total_cmp);
        let [darkest, film] = [0, texels.len() / 100].map(|n| texels[n] - floor.clean);
        println!("{preset}: darkest {darkest:.1}, darkest hundredth {film:.1}");
        // Heel marks, gum and wet prints stand out from the lane without being holes.
        assert!(film > -25.3 && darkest > -34.0, "{preset}: {film}, {darkest}");
    }
}

#[test]
fn the_lane_is_smooth_and_has_no_step_rhythm() {
    for (preset, high) in [("commuters", 2.0), ("heavy", 2.0), ("wet", 3.0)] {
        let floor = resolved(&CORRIDOR, &look(preset, Material::Vinyl));
        let fine = sd(&without_large_scale(&floor.lane(), 12).concat());
        println!("{preset}: sd below 25 cm {fine:.2}");
        assert!((0.9..=high).contains(&fine), "{preset}: {fine}");

        let rows = without_large_scale(&floor.lane(), 12);
        let correlation = |lag: usize| {
            let pairs = |row: &Vec<f64>| mean(row.iter().zip(&row[lag..]).map(|(a, b)| a * b));
            mean(rows.iter().map(pairs))
        };
        let at = |cm: usize| correlation(cm) / correlation(0);
        for step in [66, 72, 78] {
            assert!(at(step).abs() < 0.06, "{preset}: correlation {} at a step of {step} cm", at(step));
        }
    }
}

#[test]
fn the_margin_is_quiet_and_the_skirting_dirty() {
    let floor = resolved(&CORRIDOR, &look("commuters", Material::Vinyl));
    let band = |cm| mean(floor.cut(&floor.lightness, 100..1100, floor.beside_wall(cm)));
    let (margin, skirting) = (band(10..25), band(0..4));
    println!("margin {:.2}, skirting {:.2}", margin - floor.clean, skirting - margin);
    assert!((margin - floor.clean).abs() < 3.0, "margin {margin}, clean {}", floor.clean);
    assert!(skirting < margin - 5.0, "skirting {skirting}, margin {margin}");

    let edge = floor.layer("edge");
    let along: Vec<f64> = (0..1200)
        .map(|k| mean(floor.cut(edge, k..k + 1, floor.beside_wall(0..4)).into_iter().map(f64::from)))
        .collect();
    let variation = sd(&along) / mean(along.iter().copied());
    println!("edge: mean D {:.3}, CV {variation:.2}", mean(along.iter().copied()));
    assert!(variation >= 0.3, "the line varies by {variation}");
}

#[test]
fn inner_corners_hold_more() {
    let mut ratios = Vec::new();
    for seed in 1..=12 {
        let floor = resolved(&ROOM, &Look { seed, ..look("commuters", Material::Vinyl) });
        let edge = floor.layer("edge");
        let density = |columns, rows| mean(floor.cut(edge, columns, rows).into_iter().map(f64::from));
        // Strips of 10 cm along the south and north walls, 4 cm deep, in and between corners.
        for rows in [50..54, 346..350] {
            let corners = density(50..60, rows.clone()) + density(440..450, rows.clone());
            ratios.push(0.5 * corners / density(100..400, rows));
        }
    }
    let ratio = mean(ratios);
    println!("corner ratio {ratio:.2}");
    assert!((1.5..=2.0).contains(&ratio), "corners hold {ratio} times as much");
}

#[test]
fn nothing_is_black() {
    for preset in ["commuters", "heavy", "wet"] {
        let floor = resolved(&CORRIDOR, &look(preset, Material::Vinyl));
        let least = floor.block.base_color.iter().flatten().min().unwrap();
        assert!(*least >= 50, "{preset}: {least}");
    }
}

#[test]
fn a_dark_floor_is_lighter_in_the_lane() {
    // Dust over black rubber is light and grey: brown dirt alone would make 7.7 of the heavy look.
    for (preset, lighter) in [("commuters", 4.0..=8.0), ("heavy", 10.0..=16.0)] {
        let floor = resolved(&CORRIDOR, &look(preset, Material::Dark));
        let lane = median(floor.lane().concat()) - floor.clean;
        println!("dark, {preset}: lane {lane:+.1}");
        assert!(lighter.contains(&lane), "{preset}: {lane}");
    }
}

#[test]
fn film_varies_as_its_noise_does() {
    let mut steady = Look::default();
    for octave in [&mut steady.noise.fine, &mut steady.noise.middle, &mut steady.noise.coarse] {
        octave.sd = 0.0;
    }
    let (even, uneven) = (resolved(&CORRIDOR, &steady), resolved(&CORRIDOR, &Look::default()));
    let rows = 200..300;
    let even = even.cut(even.layer("film"), 0..1200, rows.clone());
    let uneven = uneven.cut(uneven.layer("film"), 0..1200, rows);
    let ratios: Vec<f64> = uneven.iter().zip(&even).map(|(a, b)| f64::from(a / b)).collect();
    let (mean, variation) = (mean(ratios.iter().copied()), sd(&ratios));
    println!("noise: mean {mean:.3}, sd {variation:.3}");
    assert!((mean - 1.0).abs() < 0.08, "{mean}");
    // sqrt(0.10^2 + 0.12^2 + 0.15^2), with the finest octave slightly attenuated by texels of 1 cm.
    assert!((0.17..0.25).contains(&variation), "{variation}");
}

#[test]
fn roughness_goes_from_clean_to_trodden() {
    for (material, clean, lane) in [
        (Material::Vinyl, 0.35, 0.50),
        (Material::Terrazzo, 0.30, 0.22),
        (Material::Concrete, 0.75, 0.55),
        (Material::Wood, 0.40, 0.60),
        (Material::Carpet, 0.95, 0.95),
    ] {
        let floor = resolved(&CORRIDOR, &look("commuters", material));
        let rough = |rows| {
            let values = floor.cut(&floor.block.orm, 100..1100, rows);
            median(values.into_iter().map(|orm| f64::from(orm[1]) / 255.0).collect())
        };
        let (margin, middle) = (rough(floor.beside_wall(18..25)), rough(floor.beside_wall(195..205)));
        println!("{material:?}: {margin:.2} to {middle:.2}");
        assert!((margin - clean).abs() < 0.06, "{material:?}: {margin} at the margin");
        assert!((middle - lane).abs() < 0.05, "{material:?}: {middle} in the lane");
    }
}

#[test]
fn openings_are_as_trodden_as_the_rest() {
    let mut look = look("commuters", Material::Vinyl);
    look.noise.coarse.sd = 0.0;
    look.mop.takes = 0.0;
    let floor = resolved(&CORRIDOR, &look);
    let film = floor.layer("film");
    let lane = |columns| mean(floor.cut(film, columns, 150..350).into_iter().map(f64::from));
    let inside = lane(300..400);
    for end in [lane(0..4), lane(1196..1200), lane(0..100), lane(1100..1200)] {
        assert!((end / inside - 1.0).abs() < 0.1, "{end} at an end, {inside} inside");
    }
}

#[test]
fn the_paper_paints_prints_over_each_other_and_nothing_else() {
    let floor = resolved(&CORRIDOR, &look("paper", Material::Vinyl));
    for name in ["film", "scuff", "edge", "dust"] {
        assert!(floor.layer(name).iter().all(|&value| value == 0.0), "{name}");
    }
    let (passes, soil) = (floor.layer("passes"), floor.layer("soil"));
    assert!(passes.iter().zip(soil).all(|(passes, soil)| (soil - 0.8 * passes).abs() < 1e-5 * (1.0 + soil)));
    assert!(median(floor.lane().concat()) < floor.clean - 3.0);
}

#[test]
fn a_rectangle_shows_the_same_texels_as_the_whole() {
    for material in [Material::Vinyl, Material::Tile, Material::Wood, Material::Carpet] {
        let look = look("commuters", material);
        let resolver = FloorResolver::new(&CORRIDOR.sums, &CORRIDOR.walls, &look, PEOPLE).unwrap();
        let whole = resolver.resolve(-40, -10, 400, 300);
        for (i0, j0, width, height) in [(-40, -10, 400, 100), (3, 37, 61, 90), (100, 60, 128, 128), (-3, 33, 9, 3)] {
            let part = resolver.resolve(i0, j0, width, height);
            for n in 0..width * height {
                let (i, j) = (i0 + (n % width) as i64, j0 + (n / width) as i64);
                let m = (j + 10) as usize * 400 + (i + 40) as usize;
                let of = |block: &ResolvedBlock, n: usize| {
                    let layers: Vec<u32> = block.layers.iter().map(|layer| layer.values[n].to_bits()).collect();
                    (block.base_color[n], block.mask[n], block.orm[n], layers)
                };
                assert_eq!(of(&part, n), of(&whole, m), "{material:?}: texel {i}, {j}");
            }
        }
    }
}

#[test]
fn the_floor_goes_on_16_texels_beyond_its_edge() {
    let resolver = FloorResolver::new(&CORRIDOR.sums, &CORRIDOR.walls, &Look::default(), PEOPLE).unwrap();
    // The floor's south edge is at row 50.
    let block = resolver.resolve(200, 0, 64, 60);
    let row = |j: usize| block.base_color[j * 64..(j + 1) * 64].to_vec();
    for j in 34..50 {
        assert_eq!(row(j), row(50), "row {j}");
    }
    assert!(row(33).iter().all(|&colour| colour == resolver.background().base_color));
    assert!(resolver.resolve(0, 0, 64, 30).empty);
    assert!(resolver.resolve(-500, -500, 256, 256).empty);
    assert!(!resolver.resolve(0, 20, 64, 30).empty);
}

/// The corridor with a table of 2 x 1 m in its middle: who puts furniture of his own there sees a floor, hardly trodden.
#[test]
fn the_floor_goes_on_under_a_table() {
    let with_table = |height_m| {
        let points_m = [[5.0, 2.0], [7.0, 2.0], [7.0, 3.0], [5.0, 3.0]].map(|[x, y]| vec2(x, y)).to_vec();
        let table = Outline { points_m, openings: Vec::new(), furniture_m: Some(height_m), windows_m: Vec::new() };
        let walls = Walls::from_outlines([CORRIDOR.walls.outlines(), &[table]].concat()).unwrap();
        let library = PatternLibrary::built_in();
        let mut sums = FloorSums::new(CORRIDOR.sums.grid());
        let stamper = Stamper::new(&library, sums.grid(), &StampOptions::default()).unwrap();
        sums.add(&stamper, &walls, &people(&library));
        resolved(&SummedFloor { walls, sums }, &look("commuters", Material::Vinyl))
    };
    let [table, counter] = [0.75, 1.0].map(with_table);
    let beneath = table.cut(&table.lightness, 560..640, 235..265);
    println!("clean {:.1}, under a table {:.1}, sd {:.2}", table.clean, mean(beneath.clone()), sd(&beneath));
    assert!((table.clean - mean(beneath.clone())).abs() < 4.0 && sd(&beneath) > 0.3);
    // Dirt gathers along what stands on the floor, and not below the edge of a board on legs.
    let along = |floor: &Resolved| mean(floor.cut(&floor.lightness, 510..690, 196..200));
    println!("along a counter {:.1}, along a table {:.1}", along(&counter), along(&table));
    assert!(along(&counter) < along(&table) - 3.0);
}

#[test]
fn smooth_lanes_have_no_bands() {
    // Means of 8 x 8 texels follow the unrounded colour in steps far below 1.
    let mut look = look("commuters", Material::Vinyl);
    look.floor.texture = 0.0;
    let floor = resolved(&CORRIDOR, &look);
    let green: Vec<f64> = floor.block.base_color.iter().map(|colour| f64::from(colour[1])).collect();
    let means: Vec<f64> = (60..430)
        .step_by(8)
        .flat_map(|row| (0..1200).step_by(8).map(move |column| (column, row)))
        .map(|(column, row)| mean(floor.cut(&green, column..column + 8, row..row + 8)))
        .collect();
    let near_whole = means.iter().filter(|value| (*value - value.round()).abs() < 0.1).count() as f64;
    let share = near_whole / means.len() as f64;
    assert!((0.1..0.35).contains(&share), "{share} of the means lie within 0.1 of a whole number");
}

#[test]
fn nobody_cannot_stand_for_a_history() {
    let error = FloorResolver::new(&ROOM.sums, &ROOM.walls, &Look::default(), 0).err().unwrap();
    assert!(error.to_string().contains("no simulated people"), "{error}");
    let look = Look { film: FilmLook { density: f32::NAN, ..FilmLook::default() }, ..Look::default() };
    let error = FloorResolver::new(&ROOM.sums, &ROOM.walls, &look, 1).err().unwrap();
    assert_eq!(error.to_string(), "film.density is NaN, allowed is 0 to 3");
}
