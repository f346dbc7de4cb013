//! Quantitative tests of the look of touched walls.

use std::sync::LazyLock;

use super::shade::{DUST, SPLASH};
use super::*;
use crate::look::tests::{lightness, mean, median, sd};
use crate::look::{Look, LookError, ResolvedBlock};
use crate::math::srgb::light_of;
use crate::math::{SplitMix64, exp};
use crate::patterns::Cause;
use crate::plan::FloorPlan;
use crate::stamps::{DENSITY_ONE, WallGrid};
use crate::sums::WallSums;
use crate::walls::{Walls, WallsOptions};

const HEIGHT_M: f64 = 2.6;
/// Number of people for whom touches are drawn.
pub(super) const PEOPLE: u32 = 20_000;
/// Length of the corridor's walls, metres.
const LENGTH_M: f64 = 8.0;
/// Position of the door jamb along the corridor's first wall, metres.
const JAMB_M: f64 = 4.0;
/// Zone that W1 ignores: splash band and its scuffs, metres.
const SPLASH_ZONE_M: f64 = 0.15;

/// Walls with their sums.
pub(super) struct SummedWalls {
    pub walls: Walls,
    pub sums: WallSums,
}

/// A corridor of 8 m; people pass its first wall within reach.
static PLAIN: LazyLock<SummedWalls> = LazyLock::new(|| {
    let mut scene = corridor(200.0);
    passers_by(&mut scene.sums, 10_000);
    scene
});

/// The same corridor with people who push off a door jamb in the first wall.
static DOOR: LazyLock<SummedWalls> = LazyLock::new(|| {
    let mut scene = corridor(200.0);
    passers_by(&mut scene.sums, 10_000);
    jamb(&mut scene.sums);
    scene
});

fn corridor(texels_per_metre: f64) -> SummedWalls {
    scene((LENGTH_M * 10.0) as usize, 24, texels_per_metre, |_, row| (2..22).contains(&row))
}

/// A room of 3 x 2 m: one closed face.
fn room(texels_per_metre: f64) -> SummedWalls {
    scene(34, 24, texels_per_metre, |column, row| (2..32).contains(&column) && (2..22).contains(&row))
}

/// Walls of a plan with pixels of 10 cm.
pub(super) fn scene(
    columns: usize,
    rows: usize,
    texels_per_metre: f64,
    is_floor: impl Fn(usize, usize) -> bool,
) -> SummedWalls {
    let floor = (0..columns * rows).map(|n| u8::from(is_floor(n % columns, n / columns))).collect();
    let plan = FloorPlan::from_mask(columns as u32, rows as u32, 0.1, floor);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let grid = WallGrid::covering(&walls, HEIGHT_M, texels_per_metre).unwrap();
    SummedWalls { sums: WallSums::new(grid), walls }
}

/// Adds a soft spot to the first face: centre and size, metres, and its density.
pub(super) fn touch(sums: &mut WallSums, cause: Cause, middle_m: [f64; 2], size_m: [f64; 2], density: f64) {
    let t = sums.grid().texels_per_metre;
    let [(i0, width), (j0, height)] = [0, 1].map(|axis| {
        let low = ((middle_m[axis] - 0.5 * size_m[axis]) * t).floor().max(0.0);
        (low as u32, (((middle_m[axis] + 0.5 * size_m[axis]) * t).ceil() - low).max(0.0) as usize)
    });
    let height = height.min((sums.grid().height - j0) as usize);
    // Means over a texel, of 3 x 3 samples.
    let value = |n: usize| {
        let places = (0..9).map(|k| {
            let x = ((f64::from(i0) + (n % width) as f64 + (k % 3) as f64 / 3.0 + 1.0 / 6.0) / t - middle_m[0]) * 2.0;
            let y = ((f64::from(j0) + (n / width) as f64 + (k / 3) as f64 / 3.0 + 1.0 / 6.0) / t - middle_m[1]) * 2.0;
            let (x, y) = (x / size_m[0], y / size_m[1]);
            let off = x * x + y * y;
            (1.0 - off).max(0.0).sqrt()
        });
        (places.sum::<f64>() / 9.0 * density * f64::from(DENSITY_ONE)).round() as u32
    };
    let values: Vec<u32> = (0..width * height).map(value).collect();
    sums.add_block(cause, 0, i0, j0, [width, height], &values);
}

/// Adds the touches of people who pass a plain wall within reach: per metre and 1000 of them a hand (0.01 per person and
/// 10 m), half a bag, a fifth of a shoe.
fn passers_by(sums: &mut WallSums, people: u32) {
    let length_m = LENGTH_M * f64::from(people) / 1000.0;
    let mut rng = SplitMix64::new(11);
    let along = |rng: &mut SplitMix64| 0.4 + (LENGTH_M - 0.8) * f64::from(rng.unit());
    let load = |rng: &mut SplitMix64, median: f64| median * exp(0.9 * f64::from(rng.normal()));
    for n in 0..length_m as usize {
        let size_m = if n % 4 == 0 { [0.40, 0.07] } else { [0.09, 0.12] };
        let middle_m = [along(&mut rng), 1.08 + 0.1 * f64::from(rng.normal())];
        touch(sums, Cause::Hand, middle_m, size_m, load(&mut rng, 0.05));
    }
    for _ in 0..(0.5 * length_m) as usize {
        let middle_m = [along(&mut rng), f64::from(rng.range(0.2, 0.6))];
        touch(sums, Cause::Bag, middle_m, [0.25, 0.05], load(&mut rng, 0.06));
    }
    for _ in 0..(0.2 * length_m) as usize {
        let middle_m = [along(&mut rng), f64::from(rng.range(0.03, 0.14))];
        touch(sums, Cause::Shoe, middle_m, [0.07, 0.02], load(&mut rng, 0.2));
    }
}

/// Adds the touches of 400 of 10 000 people, who push off the jamb of a door.
fn jamb(sums: &mut WallSums) {
    let mut rng = SplitMix64::new(12);
    for _ in 0..400 {
        let middle_m = [JAMB_M + 0.06 * f64::from(rng.normal()), 1.2 + 0.1 * f64::from(rng.normal())];
        touch(sums, Cause::Hand, middle_m, [0.09, 0.12], 0.05 * exp(0.9 * f64::from(rng.normal())));
    }
}

pub(super) fn look(material: WallMaterial) -> Look {
    let mut look = Look::default();
    look.wall.material = material;
    // The people of the sums are the wall's whole history.
    look.wall.total_passes = u64::from(PEOPLE);
    look
}

/// Resolves a block and writes out its background.
pub(super) fn resolve(resolver: &WallResolver<'_>, [i0, j0]: [i64; 2], [width, height]: [usize; 2]) -> ResolvedBlock {
    let mut block = resolver.resolve(0, i0, j0, width, height);
    if block.empty {
        block.resize(width * height, &WALL_LAYERS);
        block.clear(0..width * height, resolver.background());
    }
    block
}

/// A resolved part of the first face, with the same part of the clean wall.
pub(super) struct Resolved {
    pub width: usize,
    pub dirty: ResolvedBlock,
    pub clean: ResolvedBlock,
}

pub(super) fn resolved(scene: &SummedWalls, look: &Look, along_m: [f64; 2], up_m: [f64; 2]) -> Resolved {
    let t = scene.sums.grid().texels_per_metre;
    let part = |look: &Look| {
        let resolver = WallResolver::new(&scene.sums, &scene.walls, look, PEOPLE).unwrap();
        let [i, j] = [along_m, up_m].map(|[from, to]| [from, to].map(|metres| (metres * t).round() as i64));
        resolve(&resolver, [i[0], j[0]], [(i[1] - i[0]) as usize, (j[1] - j[0]) as usize])
    };
    let width = ((along_m[1] * t).round() - (along_m[0] * t).round()) as usize;
    Resolved { width, dirty: part(look), clean: part(&look.clean()) }
}

impl Resolved {
    /// Change of lightness by dirt, per texel.
    fn change(&self) -> Vec<f64> {
        let of = |block: &ResolvedBlock| -> Vec<f64> {
            block.base_color.iter().map(|&colour| lightness(light_of(colour))).collect()
        };
        of(&self.dirty).into_iter().zip(of(&self.clean)).map(|(dirty, clean)| dirty - clean).collect()
    }

    fn layer(&self, name: &str) -> &[f32] {
        &self.dirty.layers.iter().find(|layer| layer.name == name).unwrap().values
    }

    fn roughness_change(&self) -> f64 {
        let of = |block: &ResolvedBlock| mean(block.orm.iter().map(|orm| f64::from(orm[1]) / 255.0));
        of(&self.dirty) - of(&self.clean)
    }

    fn mask(&self) -> [f64; 4] {
        [0, 1, 2, 3].map(|n| mean(self.dirty.mask.iter().map(|mask| f64::from(mask[n]))))
    }
}

fn share(values: &[f64], is: impl Fn(f64) -> bool) -> f64 {
    values.iter().filter(|&&value| is(value)).count() as f64 / values.len() as f64
}

const MATERIALS: [WallMaterial; 3] = [WallMaterial::Matt, WallMaterial::Gloss, WallMaterial::Concrete];
const WITH_MASONRY: [WallMaterial; 5] =
    [WallMaterial::Matt, WallMaterial::Gloss, WallMaterial::Concrete, WallMaterial::Brick, WallMaterial::Tile];

#[test]
fn a_plain_wall_is_almost_clean() {
    let mut scene = corridor(200.0);
    passers_by(&mut scene.sums, 1000);
    for material in MATERIALS {
        let wall = resolved(&scene, &look(material), [0.0, LENGTH_M], [SPLASH_ZONE_M, HEIGHT_M]);
        let dark = share(&wall.change(), |change| change < -3.0);
        println!("{material:?}: {:.2} % of the area more than 3 L* darker", 100.0 * dark);
        assert!(dark < 0.01, "{material:?}: {dark}");
        // But there is some dirt.
        assert!(material != WallMaterial::Matt || dark > 0.0005, "{material:?}: {dark}");
    }
}

#[test]
fn touches_gather_at_a_jamb() {
    let core = [[JAMB_M - 0.05, JAMB_M + 0.05], [1.12, 1.28]];
    let wall = resolved(&DOOR, &look(WallMaterial::Matt), core[0], core[1]);
    let dark = median(wall.change());
    println!("jamb: {dark:.1} L*");
    assert!((-15.0..=-6.0).contains(&dark), "{dark}");

    // A closed patch without distinct touches or gaps.
    let uneven = sd(&wall.change());
    assert!(uneven < 3.0, "the patch varies by {uneven}");

    // Visibly dirty area per metre of wall, square metres.
    let dirty = |scene: &SummedWalls, along_m: [f64; 2]| {
        let wall = resolved(scene, &look(WallMaterial::Matt), along_m, [0.2, HEIGHT_M]);
        (HEIGHT_M - 0.2) * share(&wall.change(), |change| change < -3.0)
    };
    let (jamb, plain) = (dirty(&DOOR, [JAMB_M - 0.1, JAMB_M + 0.1]), dirty(&PLAIN, [0.4, LENGTH_M - 0.4]));
    println!("visibly dirty: jamb {jamb:.3}, plain {plain:.4} m2 a metre");
    assert!(jamb > 10.0 * plain, "jamb {jamb}, plain {plain}");
}

#[test]
fn stains_have_their_colours_and_roughness() {
    let mut scene = corridor(100.0);
    for (n, cause) in Cause::WALL.into_iter().enumerate() {
        for _ in 0..100 {
            touch(&mut scene.sums, cause, [1.0 + n as f64, 1.2], [0.5, 0.5], 0.05);
        }
    }
    let at = |cause: Cause, material| {
        let along_m = 1.0 + cause.on_wall().unwrap() as f64;
        resolved(&scene, &look(material), [along_m - 0.1, along_m + 0.1], [1.1, 1.3])
    };
    let colour = |block: &ResolvedBlock, n: usize| mean(block.base_color.iter().map(|colour| f64::from(colour[n])));
    for (cause, channel) in [(Cause::Hand, 0), (Cause::Arm, 1), (Cause::Shoulder, 1), (Cause::Bag, 1), (Cause::Shoe, 2)]
    {
        let wall = at(cause, WallMaterial::Matt);
        let mask = wall.mask();
        assert!(mask[channel] > 40.0, "{cause:?}: {mask:?}");
        for (n, value) in mask.into_iter().enumerate().filter(|&(n, _)| n != channel) {
            assert!(value < 3.0, "{cause:?}: channel {n} of the mask is {value}");
        }
    }
    let [skin, rubber] = [Cause::Hand, Cause::Shoe].map(|cause| at(cause, WallMaterial::Matt));
    // Yellow-grey: absorbs more blue than red; rubber absorbs all colours alike, and more.
    let [clean, skin, rubber] =
        [&skin.clean, &skin.dirty, &rubber.dirty].map(|block| [0, 1, 2].map(|n| colour(block, n)));
    println!("clean {clean:.0?}, skin {skin:.0?}, rubber {rubber:.0?}");
    assert!(skin[0] / skin[2] > 1.015 * clean[0] / clean[2], "{skin:?}");
    assert!(rubber[0] / rubber[2] < skin[0] / skin[2] && rubber[1] < skin[1] - 15.0, "{rubber:?}");

    let [matt, gloss] = [WallMaterial::Matt, WallMaterial::Gloss].map(|material| at(Cause::Hand, material));
    println!("roughness: matt {:+.3}, gloss {:+.3}", matt.roughness_change(), gloss.roughness_change());
    assert!((-0.2..=-0.1).contains(&matt.roughness_change()), "{}", matt.roughness_change());
    assert!((0.05..=0.3).contains(&gloss.roughness_change()), "{}", gloss.roughness_change());
}

#[test]
fn nothing_is_black() {
    let mut scene = corridor(100.0);
    touch(&mut scene.sums, Cause::Shoe, [1.0, 0.3], [0.5, 0.5], 900.0);
    for material in MATERIALS {
        let mut look = look(material);
        look.wall.rubber.density = 3.0;
        look.wall.rubber.colour = [0, 0, 0];
        let wall = resolved(&scene, &look, [0.8, 1.2], [0.0, 0.5]);
        let least = wall.dirty.base_color.iter().flatten().min().unwrap();
        assert!((50..70).contains(least), "{material:?}: {least}");
    }
}

#[test]
fn materials_take_stains_differently() {
    let of = |material, name: &str| {
        let wall = resolved(&DOOR, &look(material), [0.4, LENGTH_M - 0.4], [0.0, 1.6]);
        mean(wall.layer(name).iter().map(|&density| f64::from(density)))
    };
    let [matt, gloss, concrete] =
        MATERIALS.map(|material| [of(material, "hand"), of(material, "shoe"), of(material, "splash")]);
    println!("matt {matt:.5?}, gloss {gloss:.5?}, concrete {concrete:.5?}");
    assert!(concrete[0] < 0.35 * matt[0], "skin stays on concrete");
    assert!(concrete[1] > 0.9 * matt[1], "rubber does not stay on concrete");
    assert!(concrete[2] > 1.2 * matt[2], "splashes do not stay on concrete");
    assert!(gloss[0] < 0.8 * matt[0] && gloss[0] > concrete[0], "gloss is not wiped");
    assert!(gloss[2] < matt[2]);
}

#[test]
fn the_splash_band_is_low_and_uneven() {
    let mut look = look(WallMaterial::Matt);
    look.wall.splash.drips_per_metre = 0.0;
    let wall = resolved(&PLAIN, &look, [0.0, LENGTH_M], [0.0, 0.4]);
    let splash = wall.layer("splash");
    let row = |j: usize| -> Vec<f64> { splash[j * wall.width..][..wall.width].iter().map(|&d| f64::from(d)).collect() };
    let rows = |from_cm: usize, to_cm: usize| mean((2 * from_cm..2 * to_cm).map(|j| mean(row(j))));
    println!("splash by height: {:.3} {:.3} {:.3} {:.4}", rows(0, 2), rows(2, 6), rows(6, 12), rows(13, 30));
    assert!(rows(0, 2) > 0.04, "{}", rows(0, 2));
    assert!(rows(0, 2) > rows(2, 6) && rows(2, 6) > 1.5 * rows(6, 12));
    assert!(rows(13, 30) < 0.04 * rows(0, 2), "{}", rows(13, 30));
    assert!(splash[wall.width * 60..].iter().all(|&density| density == 0.0), "splashes above 30 cm");

    // The upper edge varies, and stretches are missing.
    let edge_cm: Vec<f64> = (0..wall.width)
        .map(|i| (0..40).rev().find(|&j| splash[j * wall.width + i] > 0.012).map_or(0.0, |j| 0.5 * (j + 1) as f64))
        .collect();
    println!("edge: mean {:.1} cm, sd {:.1} cm", mean(edge_cm.iter().copied()), sd(&edge_cm));
    assert!(sd(&edge_cm) > 1.5);
    // No height at which it is cut off: neighbouring heights are about as frequent.
    let most = (1..40).map(|n| share(&edge_cm, |edge| (edge - 0.5 * f64::from(n)).abs() < 0.1)).fold(0.0, f64::max);
    assert!(most < 0.16, "{most} of the band ends at one height");
    let along = row(10);
    let variation = sd(&along) / mean(along.iter().copied());
    assert!(variation > 0.4, "the band varies by {variation}");
}

#[test]
fn drips_are_rare_and_never_evenly_spaced() {
    let grid = WallGrid {
        texels_per_metre: 100.0,
        height_m: HEIGHT_M,
        height: 260,
        faces: vec![crate::stamps::FaceSpan { width: 100_000, length_m: 1000.0, closed: false }],
    };
    let strip = strip::FaceStrip::of(&grid, 0).unwrap();
    let look = SplashLook { drips_per_metre: 0.5, ..SplashLook::default() };
    let drips = splash::Splash::new(look, 3);
    let mut places: Vec<f64> = drips.places_of_drips(&strip.window(&(0..100_000), &(0..50)), &strip);
    places.sort_by(f64::total_cmp);
    places.iter_mut().for_each(|place| *place /= 100.0);
    println!("{} drips on 1000 m", places.len());
    assert!((400..600).contains(&places.len()), "{}", places.len());

    let gaps: Vec<f64> = places.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let variation = sd(&gaps) / mean(gaps.iter().copied());
    assert!(variation > 1.0, "gaps vary by {variation}: too even");

    // No distance is more frequent than others, apart from those within one splash.
    let count = |from_m: f64| {
        let mut pairs = 0;
        for (n, place) in places.iter().enumerate() {
            let farther = places[n + 1..].iter().take_while(|other| **other < place + from_m + 0.1);
            pairs += farther.filter(|other| **other >= place + from_m).count();
        }
        pairs as f64
    };
    let counts: Vec<f64> = (3..60).map(|n| count(0.1 * f64::from(n))).collect();
    let expected = mean(counts.iter().copied());
    for (n, count) in counts.iter().enumerate() {
        let off = (count - expected).abs() / expected.sqrt();
        assert!(off < 5.0, "{count} pairs {:.1} m apart, {expected:.0} expected", 0.1 * (n + 3) as f64);
    }
}

#[test]
fn texel_density_does_not_change_the_picture() {
    for material in MATERIALS {
        let pictures: Vec<Vec<[f64; 3]>> = [50.0, 200.0, 400.0]
            .into_iter()
            .map(|t| {
                let mut scene = corridor(t);
                jamb(&mut scene.sums);
                touch(&mut scene.sums, Cause::Shoe, [4.4, 0.2], [0.08, 0.03], 0.4);
                let wall = resolved(&scene, &look(material), [3.5, 4.7], [0.0, 1.5]);
                let cell = (0.1 * t) as usize;
                let means = (0..15 * 12).map(|n| {
                    let (column, row) = (n % 12 * cell, n / 12 * cell);
                    let texels = (0..cell * cell).map(|m| (row + m / cell) * wall.width + column + m % cell);
                    let colours: Vec<[f32; 3]> = texels.map(|m| light_of(wall.dirty.base_color[m])).collect();
                    [0, 1, 2].map(|c| mean(colours.iter().map(|colour| f64::from(colour[c]))))
                });
                means.collect()
            })
            .collect();
        for picture in &pictures[1..] {
            let changes: Vec<f64> = pictures[0]
                .iter()
                .zip(picture)
                .map(|(a, b)| lightness(a.map(|c| c as f32)) - lightness(b.map(|c| c as f32)))
                .collect();
            let most = changes.iter().fold(0.0, |most: f64, change| most.max(change.abs()));
            println!("{material:?}: largest change {most:.2}, mean {:.3} L*", mean(changes.iter().copied()));
            assert!(most < 2.0 && sd(&changes) < 0.5, "{material:?}: {most}");
        }
    }
}

#[test]
fn a_rectangle_shows_the_same_texels_as_the_whole() {
    for material in WITH_MASONRY {
        let mut look = look(material);
        look.wall.skirting.height_m = 0.083;
        look.wall.splash.drips_per_metre = 5.0;
        let resolver = WallResolver::new(&DOOR.sums, &DOOR.walls, &look, PEOPLE).unwrap();
        let whole = resolve(&resolver, [600, -20], [300, 340]);
        for (i0, j0, width, height) in [(600, -20, 300, 40), (610, 3, 61, 90), (700, 160, 128, 128), (899, 319, 1, 1)] {
            let part = resolve(&resolver, [i0, j0], [width, height]);
            for n in 0..width * height {
                let (i, j) = (i0 + (n % width) as i64, j0 + (n / width) as i64);
                assert_eq!(
                    texel(&part, n),
                    texel(&whole, ((j + 20) * 300 + i - 600) as usize),
                    "{material:?}: {i}, {j}"
                );
            }
        }
    }
}

/// All values of a block at a texel.
fn texel(block: &ResolvedBlock, n: usize) -> ([u8; 3], [u8; 4], [u8; 3], Vec<u32>) {
    let layers = block.layers.iter().map(|layer| layer.values[n].to_bits()).collect();
    (block.base_color[n], block.mask[n], block.orm[n], layers)
}

#[test]
fn beyond_an_open_strip_its_edge_goes_on() {
    let resolver = WallResolver::new(&DOOR.sums, &DOOR.walls, &Look::default(), PEOPLE).unwrap();
    let span = DOOR.sums.grid().faces[0].width as i64;
    let rows = i64::from(DOOR.sums.grid().height);
    for (i0, j0) in [(-24, -24), (span - 24, rows - 24), (-70, 10), (span + 9, 10), (30, -90), (30, rows + 3)] {
        let block = resolve(&resolver, [i0, j0], [48, 48]);
        for n in 0..48 * 48 {
            let (i, j) = (i0 + (n % 48) as i64, j0 + (n / 48) as i64);
            let edge = resolve(&resolver, [i.clamp(0, span - 1), j.clamp(0, rows - 1)], [1, 1]);
            // Compares all texels on two lines and some elsewhere: each needs a separate block.
            if n % 48 == 5 || n / 48 == 7 || n % 97 == 0 {
                assert_eq!(texel(&block, n), texel(&edge, 0), "{i}, {j}");
            }
        }
    }
}

#[test]
fn a_closed_face_goes_round_without_a_seam() {
    let mut scene = room(100.0);
    let width = scene.sums.grid().faces[0].width;
    assert_eq!(width, 1000);
    // Hands across the seam, with parts at both ends of the strip.
    for _ in 0..30 {
        touch(&mut scene.sums, Cause::Hand, [9.95, 1.2], [0.1, 0.2], 0.02);
        touch(&mut scene.sums, Cause::Hand, [0.05, 1.2], [0.1, 0.2], 0.02);
    }
    let mut look = look(WallMaterial::Concrete);
    look.wall.splash.drips_per_metre = 3.0;
    look.wall.skin.strength = 10.0;
    let resolver = WallResolver::new(&scene.sums, &scene.walls, &look, PEOPLE).unwrap();
    let once = resolve(&resolver, [0, 0], [1000, 200]);
    let twice = resolve(&resolver, [-300, 0], [2400, 200]);
    for n in 0..2400 * 200 {
        let i = (n as i64 % 2400 - 300).rem_euclid(1000) as usize;
        assert_eq!(texel(&twice, n), texel(&once, n / 2400 * 1000 + i), "texel {n}");
    }
    // Adjacent columns at the seam differ no more than others.
    for kind in [0, SPLASH, DUST] {
        let values = &once.layers[kind].values;
        let step = |i: usize| {
            let next = (i + 1) % 1000;
            mean((0..200).map(|j| f64::from((values[j * 1000 + i] - values[j * 1000 + next]).abs())))
        };
        let steps: Vec<f64> = (0..999).map(step).collect();
        let most = steps.iter().fold(0.0, |most: f64, step| most.max(*step));
        assert!(step(999) <= most, "{}: {} at the seam, {most} elsewhere", WALL_LAYERS[kind], step(999));
    }
}

#[test]
fn a_clean_look_shows_no_dirt() {
    let dirty = resolved(&DOOR, &Look::default(), [3.5, 4.5], [0.0, 1.5]);
    assert!(dirty.dirty.layers.iter().any(|layer| layer.values.iter().any(|&density| density > 0.0)));
    for preset in crate::look::LOOK_PRESETS {
        let look = Look::preset(preset).unwrap().clean();
        let look = Look { wall: look.wall.plain(), ..look };
        look.check().unwrap();
        let resolver = WallResolver::new(&DOOR.sums, &DOOR.walls, &look, PEOPLE).unwrap();
        let block = resolve(&resolver, [700, 0], [200, 300]);
        assert!(block.layers.iter().all(|layer| layer.values.iter().all(|&density| density == 0.0)), "{preset}");
        assert!(block.mask.iter().all(|mask| *mask == [0; 4]), "{preset}");
        let [_, rough, _] = resolver.background().orm;
        assert!(block.orm.iter().all(|orm| orm[1].abs_diff(rough) <= 1), "{preset}");
    }
}

#[test]
fn the_paper_paints_touches_over_each_other_and_nothing_else() {
    let wall = resolved(&DOOR, &Look::preset("paper").unwrap(), [3.5, 4.5], [0.0, 1.5]);
    for name in ["splash", "dust", "arm"] {
        assert!(wall.layer(name).iter().all(|&density| density == 0.0), "{name}");
    }
    let mut sums = vec![0; 200 * 300];
    DOOR.sums.read(Cause::Hand, 0, 700, 0, 200, 300, &mut sums);
    for (&sum, &density) in sums.iter().zip(wall.layer("hand")) {
        // Invisible densities count as 0.
        assert!((sum as f32 / DENSITY_ONE - density).abs() < 0.002);
    }
    assert!(sums.iter().any(|&sum| sum > 0));
}

#[test]
fn history_gathers_where_people_do_and_lone_touches_stay_faint() {
    let density = |scene: &SummedWalls, total_passes: u64, [along, up]: [f64; 2]| {
        let mut look = look(WallMaterial::Matt);
        look.wall.total_passes = total_passes;
        let wall = resolved(scene, &look, [along - 0.02, along + 0.02], [up - 0.02, up + 0.02]);
        mean(wall.layer("hand").iter().map(|&density| f64::from(density)))
    };
    let mut lone = corridor(200.0);
    touch(&mut lone.sums, Cause::Hand, [2.0, 1.2], [0.1, 0.12], 0.05);
    // Fewer passes than drawn, as many, fifty times as many.
    let single = [1_000, 20_000, 1_000_000].map(|total| density(&lone, total, [2.0, 1.2]));
    let jamb = [1_000, 20_000, 1_000_000].map(|total| density(&DOOR, total, [JAMB_M, 1.2]));
    println!("one touch {single:.3?}, jamb {jamb:.3?}");
    assert!(single[0] < single[1] && single[1] < 0.12 && single[2] < 0.85 * jamb[2], "{single:?}");
    assert!(jamb[0] < jamb[1] && jamb[1] > 0.25 && jamb[2] < 0.7, "{jamb:?}");
}

#[test]
fn clean_paint_is_all_background() {
    for material in [WallMaterial::Matt, WallMaterial::Gloss] {
        let scene = room(200.0);
        let mut look = look(material);
        look.wall = look.wall.plain();
        let resolver = WallResolver::new(&scene.sums, &scene.walls, &look, PEOPLE).unwrap();
        assert!(resolver.resolve(0, 0, 70, 256, 480).empty, "nobody touched it above the drips");
        assert!(!resolver.resolve(0, 0, 0, 256, 256).empty);
        // Clean texels are even, so that files compress.
        let resolver = WallResolver::new(&DOOR.sums, &DOOR.walls, &look, PEOPLE).unwrap();
        let block = resolver.resolve(0, 0, 0, 1600, 520);
        let clean = resolver.background();
        let even = (0..1600 * 520).filter(|&n| block.layers.iter().all(|layer| layer.values[n] == 0.0));
        let even: Vec<usize> = even.collect();
        assert!(even.iter().all(|&n| (block.base_color[n], block.mask[n]) == (clean.base_color, clean.mask)));
        assert!(even.iter().all(|&n| block.orm[n] == clean.orm));
        let above = even.iter().filter(|&&n| n >= 1600 * 70).count() as f64 / (1600.0 * 450.0);
        println!("{material:?}: {:.0} % of the wall above the splashes is clean", 100.0 * above);
        assert!(above > 0.6, "{above}");
    }
    // A roller leaves a stipple: 0.6 L* up and down.
    let resolver = WallResolver::new(&PLAIN.sums, &PLAIN.walls, &look(WallMaterial::Matt), PEOPLE).unwrap();
    let block = resolver.resolve(0, 0, 400, 1600, 110);
    let stipple: Vec<f64> = block.base_color.iter().map(|&colour| lightness(light_of(colour))).collect();
    let rough: Vec<f64> = block.orm.iter().map(|orm| f64::from(orm[1]) / 255.0).collect();
    println!("stipple {:.2} L*, roughness {:.3}", sd(&stipple), sd(&rough));
    assert!((0.35..0.9).contains(&sd(&stipple)) && (0.004..0.04).contains(&sd(&rough)));
    // Concrete has a texture.
    let resolver = WallResolver::new(&PLAIN.sums, &PLAIN.walls, &look(WallMaterial::Concrete), PEOPLE).unwrap();
    let block = resolver.resolve(0, 0, 280, 256, 240);
    let grain: Vec<f64> = block.base_color.iter().map(|colour| f64::from(colour[1])).collect();
    assert!(sd(&grain) > 2.0);
}

#[test]
fn a_skirting_board_stands_at_the_foot() {
    let mut look = Look::default();
    look.wall.skirting = SkirtingLook { height_m: 0.08, colour: [60, 60, 60] };
    look.wall.texture = 0.0;
    let wall = resolved(&PLAIN, &look.clean(), [1.0, 2.0], [0.0, 0.2]);
    let row = |j: usize| mean(wall.clean.base_color[j * 200..(j + 1) * 200].iter().map(|colour| f64::from(colour[1])));
    assert!((58.0..62.0).contains(&row(2)) && (58.0..62.0).contains(&row(14)), "{} {}", row(2), row(14));
    assert!(row(15) < 60.0, "there is no lip: {}", row(15));
    assert!(row(16) > 200.0, "{}", row(16));
}

#[test]
fn errors_are_named() {
    let scene = room(50.0);
    let error =
        |people: u32, look: &Look, walls: &Walls| WallResolver::new(&scene.sums, walls, look, people).err().unwrap();
    let nobody = error(0, &Look::default(), &scene.walls);
    assert!(nobody.to_string().contains("no simulated people"), "{nobody}");
    let mut look = Look::default();
    look.wall.skin.density = f32::NAN;
    assert_eq!(error(1, &look, &scene.walls).to_string(), "wall.skin.density is NaN, allowed is 0 to 3");
    let other = error(1, &Look::default(), &PLAIN.walls);
    assert_eq!(other.to_string(), "the sums are those of 1 wall faces, but the plan has 2");
    let mut look = Look::default();
    look.wall.image = Some("nowhere.png".into());
    assert!(matches!(error(1, &look, &scene.walls), LookError::Image { .. }));

    let resolver = WallResolver::new(&scene.sums, &scene.walls, &Look::default(), 1).unwrap();
    assert!(resolver.resolve(1, 0, 0, 8, 8).empty && resolver.resolve(0, 0, 0, 0, 8).empty);
}
