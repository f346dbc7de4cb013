//! Stills: rooms in perspective, the same on any number of threads, and what is said of cameras that see nothing.

use image::RgbImage;
use trodden::Silent;
use trodden::export::TextureSource;
use trodden::export::{Camera, CameraError};
use trodden::look::{Background, ResolvedBlock};
use trodden::math::vec2;
use trodden::plan::{FloorPlan, PlanClass};
use trodden::show::Rooms;
use trodden::show::still::{StillError, Surfaces};
use trodden::sums::FloorSums;
use trodden::walls::{Walls, WallsOptions};

use super::golden::{EXACT, assert_golden};

/// Texels per metre.
const DENSITY: f64 = 20.0;

/// A floor whose texels are a pure function of their place.
struct Painted<F>(F);

/// A floor of one colour and a roughness, 0 to 255.
struct Plain([u8; 3], u8);

impl TextureSource for Plain {
    fn layers(&self) -> &[&'static str] {
        &[]
    }

    fn background(&self) -> Background {
        Background { base_color: self.0, mask: [0; 4], orm: [255, self.1, 0] }
    }

    fn resolve(&self, _: i64, _: i64, width: usize, height: usize) -> ResolvedBlock {
        ResolvedBlock {
            base_color: vec![self.0; width * height],
            orm: vec![[255, self.1, 0]; width * height],
            ..ResolvedBlock::default()
        }
    }
}

fn on_plain(rooms: &Rooms, from: &Camera, roughness: u8) -> RgbImage {
    on_colour(rooms, from, [150; 3], roughness)
}

fn on_colour(rooms: &Rooms, from: &Camera, colour: [u8; 3], roughness: u8) -> RgbImage {
    let floor = Plain(colour, roughness);
    let coat = Surfaces { floor: &floor, floor_texels_per_metre: DENSITY, small: None, walls: None };
    rooms.draw(from, [320, 180], &[coat], &Silent).unwrap().remove(0)
}

fn level(pixel: &image::Rgb<u8>) -> f64 {
    pixel.0.iter().map(|&c| f64::from(c)).sum::<f64>() / 3.0
}

/// A plan of 10 cm to a pixel: where it is floor, and what the rest is.
fn walls_of(size: [usize; 2], class: impl Fn(usize, usize) -> PlanClass) -> Walls {
    let [width, height] = size;
    let classes: Vec<PlanClass> = (0..width * height).map(|k| class(k % width, k / width)).collect();
    let floor = classes.iter().map(|class| u8::from(*class == PlanClass::Floor)).collect();
    let mut plan = FloorPlan::from_mask(width as u32, height as u32, 0.1, floor);
    plan.classes = classes;
    Walls::trace(&plan, &WallsOptions::default())
}

/// A floor of wood makes walls warm, most at their feet, and the ceiling warmer; a grey floor leaves them as they are.
#[test]
fn floors_throw_their_colour_onto_walls_and_ceiling() {
    let walls = walls_of([160, 90], |x, y| {
        if (5..155).contains(&x) && (5..85).contains(&y) { PlanClass::Floor } else { PlanClass::Wall }
    });
    let rooms = Rooms::new(&walls, &[], 2.6);
    // The wall ahead is 8 m away: its foot, its head and the ceiling over it, in 180 rows.
    let warmth = |colour: [u8; 3]| {
        let picture = on_colour(&rooms, &camera("7.3,4.5,1.3,0,0"), colour, 255);
        [104..112, 72..78, 40..56].map(|rows: std::ops::Range<u32>| {
            let all = rows.flat_map(|y| (60..260).map(move |x| (x, y)));
            let [red, blue] = all.fold([0.0, 0.0], |[red, blue], (x, y)| {
                let pixel = picture.get_pixel(x, y).0;
                [red + f64::from(pixel[0]), blue + f64::from(pixel[2])]
            });
            red / blue
        })
    };
    let (wood, grey) = (warmth([168, 120, 76]), warmth([150; 3]));
    let [foot, head, ceiling] = [0, 1, 2].map(|k| wood[k] / grey[k]);
    assert!(foot > 1.15 && head > 1.05 && foot > head + 0.04 && ceiling > 1.2, "{foot:.3} {head:.3} {ceiling:.3}");
}

/// Two rooms with a door between them: its leaf stands open in one of them, in wood, beside the way through.
#[test]
fn a_door_has_a_leaf_that_stands_open() {
    let walls = walls_of([130, 60], |x, y| {
        let room = (5..62).contains(&x) || (64..125).contains(&x);
        let is_floor = (room && (5..55).contains(&y)) || ((62..64).contains(&x) && (34..43).contains(&y));
        if is_floor { PlanClass::Floor } else { PlanClass::Wall }
    });
    let doorways = walls.doorways();
    assert_eq!(doorways.len(), 1);
    let wood = |rooms: &Rooms, from: &str| {
        let picture = on_plain(rooms, &camera(from), 220);
        let is_wood = |pixel: &&image::Rgb<u8>| pixel.0[0] > 90 && f64::from(pixel.0[0]) > 1.2 * f64::from(pixel.0[2]);
        picture.pixels().filter(is_wood).count() as f64 / f64::from(picture.width() * picture.height())
    };
    let views = ["2.2,3.0,1.7,-10,-8", "10.4,3.0,1.7,190,-8"];
    let [hung, bare] = [&doorways[..], &[]].map(|doorways| {
        let rooms = Rooms::new(&walls, doorways, 2.6);
        views.map(|from| wood(&rooms, from)).into_iter().fold(0.0, f64::max)
    });
    assert!(hung > 0.02 && bare < 0.002, "{hung} of the picture is a leaf, {bare} without doors");
}

/// A ceiling is tiles of unlike tone with lamps between them.
#[test]
fn a_ceiling_has_lamps_and_tiles() {
    let walls = walls_of([120, 90], |x, y| {
        if (5..115).contains(&x) && (5..85).contains(&y) { PlanClass::Floor } else { PlanClass::Wall }
    });
    let picture = on_plain(&Rooms::new(&walls, &[], 2.6), &camera("2,4.5,1.0,0,50"), 220);
    let levels: Vec<f64> = picture.pixels().map(level).collect();
    let lamps = levels.iter().filter(|level| **level > 246.0).count() as f64 / levels.len() as f64;
    assert!((0.01..0.3).contains(&lamps), "{lamps} of the ceiling are lamps");
    // Away from lamps, neighbouring patches differ: by tiles, joints and light.
    let mean = |i: usize, j: usize| {
        let patch = (0..64).map(|k| levels[(j * 8 + k / 8) * 320 + i * 8 + k % 8]);
        patch.sum::<f64>() / 64.0
    };
    let patches: Vec<f64> = (0..22).flat_map(|j| (0..40).map(move |i| (i, j))).map(|(i, j)| mean(i, j)).collect();
    let tiles: Vec<f64> = patches.into_iter().filter(|level| *level < 225.0).collect();
    let middle = tiles.iter().sum::<f64>() / tiles.len() as f64;
    let spread =
        (tiles.iter().map(|level| (level - middle) * (level - middle)).sum::<f64>() / tiles.len() as f64).sqrt();
    assert!((130.0..215.0).contains(&middle) && (3.0..30.0).contains(&spread), "{middle} +- {spread}");
}

/// A smooth floor mirrors lamps as soft streaks: clearly brighter than a matt one, without razor edges.
#[test]
fn smooth_floors_mirror_lamps_softly() {
    let walls = walls_of([200, 90], |x, y| {
        if (5..195).contains(&x) && (5..85).contains(&y) { PlanClass::Floor } else { PlanClass::Wall }
    });
    let rooms = Rooms::new(&walls, &[], 2.6);
    let [smooth, matt] = [90, 250].map(|roughness| on_plain(&rooms, &camera("1.5,4.5,1.7,0,-14"), roughness));
    let gain = |x: u32, y: u32| level(smooth.get_pixel(x, y)) - level(matt.get_pixel(x, y));
    let floor = || (70..178).flat_map(|y| (20..300).map(move |x| (x, y)));
    let most = floor().map(|(x, y)| gain(x, y)).fold(f64::NEG_INFINITY, f64::max);
    let edge = floor().map(|(x, y)| (gain(x, y) - gain(x + 1, y)).abs().max((gain(x, y) - gain(x, y + 1)).abs()));
    let edge = edge.fold(0.0, f64::max);
    assert!(most > 25.0 && edge < 0.45 * most, "lamps lighten by {most}, at an edge by {edge}");
}

/// A window is a bright pane, and lights the floor before it.
#[test]
fn windows_are_bright_and_light_the_floor() {
    let walls = |with: bool| {
        walls_of([130, 90], |x, y| match (x, y) {
            (8..122, 8..82) => PlanClass::Floor,
            (50..80, ..8) if with => PlanClass::Window,
            _ => PlanClass::Wall,
        })
    };
    let [with, without] = [true, false].map(|with| Rooms::new(&walls(with), &[], 2.6));
    // The image's upper side is north.
    let from = camera("6.5,2.6,1.7,90,-14");
    let [with, without] = [with, without].map(|rooms| on_plain(&rooms, &from, 240));
    let bright = |picture: &RgbImage| {
        let pane = (110..210).flat_map(|x| (20..80).map(move |y| (x, y)));
        pane.filter(|&(x, y)| level(picture.get_pixel(x, y)) > 228.0).count()
    };
    assert!(bright(&with) > 1000 && bright(&without) < 100, "{} and {}", bright(&with), bright(&without));
    let floor = |picture: &RgbImage, rows: std::ops::Range<u32>| {
        let sum: f64 = rows
            .clone()
            .flat_map(|y| (140..180).map(move |x| (x, y)))
            .map(|(x, y)| level(picture.get_pixel(x, y)))
            .sum();
        sum / (f64::from(rows.end - rows.start) * 40.0)
    };
    let before = |picture: &RgbImage| floor(picture, 104..112) / floor(picture, 165..175);
    assert!(before(&with) > 1.06 * before(&without), "{} and {}", before(&with), before(&without));
}

/// The automatic camera sees floor, and far, though pillars and tables stand about.
#[test]
fn automatic_cameras_see_floor_and_depth() {
    let walls = walls_of([240, 130], |x, y| {
        let inside = (5..235).contains(&x) && (5..125).contains(&y);
        let pillar = (x + 20) % 45 < 6 && (y + 10) % 45 < 6;
        let table = (x % 60) < 16 && (30..38).contains(&(y % 60));
        match (inside, pillar, table) {
            (true, true, _) | (false, ..) => PlanClass::Wall,
            (true, false, true) => PlanClass::Table,
            _ => PlanClass::Floor,
        }
    });
    let rooms = Rooms::new(&walls, &[], 2.6);
    let grid = trodden::stamps::TexelGrid::covering(24.0, 13.0, DENSITY).unwrap();
    let from = rooms.eye_level(&FloorSums::new(grid));
    let red = Painted(|_, _| [255, 0, 0]);
    let coat = Surfaces { floor: &red, floor_texels_per_metre: DENSITY, small: None, walls: None };
    let picture = rooms.draw(&from, [320, 180], &[coat], &Silent).unwrap().remove(0);
    let is_floor = |pixel: &&image::Rgb<u8>| pixel.0[0] > 60 && pixel.0[0].saturating_sub(pixel.0[1]) > 45;
    let share = picture.pixels().filter(is_floor).count() as f64 / f64::from(320 * 180);
    assert!(share >= 0.35, "{share} of what {from} sees is floor");
    // One looks over tables: only walls and pillars end what is seen.
    let is_high = |p: trodden::math::Vec2| {
        let (x, y) = ((p.x * 10.0) as i64, ((13.0 - p.y) * 10.0) as i64);
        !(5..235).contains(&x) || !(5..125).contains(&y) || ((x + 20) % 45 < 6 && (y + 10) % 45 < 6)
    };
    let reaches = |turn_deg: i32| {
        let (sine, cosine) = trodden::math::sin_cos((from.heading_deg + f64::from(turn_deg)).to_radians());
        (1..=80).all(|k| !is_high(from.place_m() + vec2(cosine, sine) * (f64::from(k) * 0.1)))
    };
    let deep = (-30..=30).step_by(2).filter(|turn_deg| reaches(*turn_deg)).count();
    assert!(deep >= 12, "{deep} of 31 looks from {from} reach 8 m");
}

impl<F: Fn(i64, i64) -> [u8; 3] + Sync> TextureSource for Painted<F> {
    fn layers(&self) -> &[&'static str] {
        &[]
    }

    fn background(&self) -> Background {
        Background { base_color: [197, 192, 182], mask: [0; 4], orm: [255, 200, 0] }
    }

    fn resolve(&self, i0: i64, j0: i64, width: usize, height: usize) -> ResolvedBlock {
        let texel = |k: usize| (self.0)(i0 + (k % width) as i64, j0 + (k / width) as i64);
        ResolvedBlock {
            base_color: (0..width * height).map(texel).collect(),
            orm: vec![[255, 200, 0]; width * height],
            ..ResolvedBlock::default()
        }
    }
}

/// A corridor 12 m long and 3 m wide that is open in the west, with a pillar.
fn corridor() -> Walls {
    let (width, height) = (130, 50);
    let floor = |k: usize| {
        let (x, y) = (k % width, k / width);
        let pillar = (70..76).contains(&x) && (14..20).contains(&y);
        u8::from(x < 120 && (10..40).contains(&y) && !pillar)
    };
    let plan = FloorPlan::from_mask(width as u32, height as u32, 0.1, (0..width * height).map(floor).collect());
    Walls::trace(&plan, &WallsOptions::default())
}

fn camera(text: &str) -> Camera {
    text.parse().unwrap()
}

fn drawn(camera: &Camera, size: [u32; 2], floor: &(impl Fn(i64, i64) -> [u8; 3] + Sync)) -> RgbImage {
    let floor = Painted(floor);
    let coat = Surfaces { floor: &floor, floor_texels_per_metre: DENSITY, small: None, walls: None };
    let rooms = Rooms::new(&corridor(), &[], 2.6);
    rooms.draw(camera, size, &[coat], &Silent).unwrap().remove(0)
}

/// A board of squares of half a metre.
fn board(i: i64, j: i64) -> [u8; 3] {
    if (i.div_euclid(10) + j.div_euclid(10)) % 2 == 0 { [90, 84, 76] } else { [205, 200, 190] }
}

#[test]
fn a_corridor_at_eye_level_and_from_above() {
    assert_golden("still_eye_level", &drawn(&camera("11,2.2,1.7,184,-9"), [112, 63], &board), EXACT);
    let above = Rooms::new(&corridor(), &[], 2.6).birds_eye([112, 63]);
    assert_golden("still_birds_eye", &drawn(&above, [112, 63], &board), EXACT);
}

/// Daylight falls evenly through a wide opening, without spots and without a dark sill; and before it the exposure is
/// such that a floor's pattern is still seen.
#[test]
fn an_entrance_is_lit_evenly_and_not_overexposed() {
    // A hall 12 m long and 10 m wide that is open in the west.
    let floor = (0..130 * 120).map(|k| u8::from(k % 130 < 120 && (10..110).contains(&(k / 130)))).collect();
    let plan = FloorPlan::from_mask(130, 120, 0.1, floor);
    let rooms = Rooms::new(&Walls::trace(&plan, &WallsOptions::default()), &[], 2.6);
    let grey = |_: i64, _: i64| [197, 192, 182];
    // West is up; a pixel is 4 cm of the floor.
    let shown = |floor: &(dyn Fn(i64, i64) -> [u8; 3] + Sync), camera: &str| {
        let floor = Painted(floor);
        let coat = Surfaces { floor: &floor, floor_texels_per_metre: DENSITY, small: None, walls: None };
        rooms
            .draw(&Camera { fov_deg: 90.0, ..camera.parse().unwrap() }, [120, 120], &[coat], &Silent)
            .unwrap()
            .remove(0)
    };
    let down = shown(&grey, "1,6,2.4,180,-89");
    let level = |x: u32, y: u32| i32::from(down.get_pixel(x, y).0[1]);
    // From the opening to 2 m before it, 3 m along it.
    for y in 36..84 {
        let row: Vec<i32> = (24..96).map(|x| level(x, y)).collect();
        let [least, most] = [row.iter().min().unwrap(), row.iter().max().unwrap()];
        assert!(most - least <= 14, "row {y}: {least} to {most}");
    }
    let column: Vec<i32> = (28..84).rev().map(|y| level(60, y)).collect();
    assert!(column.windows(4).all(|near| near[3] >= near[0] - 6), "{column:?}");

    let squares = shown(&board, "3,6,1.7,180,-40");
    let mut seen: Vec<u8> =
        (40..120).flat_map(|y| (0..120).map(move |x| (x, y))).map(|(x, y)| squares[(x, y)].0[1]).collect();
    seen.sort_unstable();
    let [dark, light] = [seen[seen.len() / 10], seen[seen.len() * 9 / 10]];
    assert!(light <= 235 && light - dark >= 60, "squares of L* 36 and 80 are shown as {dark} and {light}");
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| drawn(&camera("3,2.5,1.7,5,-12"), [320, 180], &board))
    };
    let one = on(1);
    assert!(one == on(2) && one == on(4));
}

/// Fine squares far away are seen as their mean: neither single ones nor waves of them.
#[test]
fn a_fine_pattern_far_away_shows_its_mean() {
    let fine = |i: i64, j: i64| if (i + j) % 2 == 0 { [20; 3] } else { [250; 3] };
    let from = camera("0.6,2.5,1.7,0,0").with_fov(90.0);
    let mean = |_: i64, _: i64| [188u8; 3]; // half of the light of 20 and of 250
    let (seen, expected) = (drawn(&from, [320, 240], &fine), drawn(&from, [320, 240], &mean));
    // Floor 7 to 10 m away, where a pixel covers a texel across and some along.
    let rows = 240 / 2 + 27..240 / 2 + 38;
    let mut worst = 0;
    for y in rows {
        for x in 150..170 {
            let (a, b) = (seen.get_pixel(x, y).0[1], expected.get_pixel(x, y).0[1]);
            worst = worst.max(a.abs_diff(b));
        }
    }
    assert!(worst <= 20, "{worst}");
}

/// The pillar's edges stand where their projection says, to the pixel.
#[test]
fn a_known_point_is_seen_at_the_known_pixel() {
    // Level and along +x, 4 m before the pillar's face, which reaches from y = 3.0 to 3.6 and hides the corner beyond.
    let from = camera("3,3.1,1.7,0,0").with_fov(90.0);
    let picture = drawn(&from, [400, 300], &|_, _| [200; 3]);
    // 200 px at the distance 1 with 90 degrees: its edges are 0.5 / 4 * 200 = 25 px and 5 px beside the middle.
    let step = |x: u32| {
        let [a, b] = [x - 1, x].map(|x| i32::from(picture.get_pixel(x, 150).0[1]));
        (a - b).abs()
    };
    for (expected, around) in [(175, 166..186), (205, 196..216)] {
        let edge = around.max_by_key(|&x| step(x)).unwrap();
        assert!(i64::from(edge).abs_diff(expected) <= 1, "the edge is at {edge}");
    }
}

#[test]
fn cameras_that_see_nothing_are_refused_with_a_place_that_does() {
    let rooms = Rooms::new(&corridor(), &[], 2.6);
    let refused = |text: &str| rooms.check(&camera(text)).unwrap_err();
    // In the pillar, in the wall beside the corridor, far beyond the plan.
    for (text, beyond) in [("7.3,3.3,1.7,0,0", false), ("5,0.4,1.7,0,0", true), ("-40,2,1.7,0,0", true)] {
        let StillError::NotOnFloor { beyond: found, nearest_m, .. } = refused(text) else { panic!("{text}") };
        assert_eq!(found, beyond, "{text}");
        let [x, y] = nearest_m;
        rooms.check(&camera(&format!("{x},{y},1.7,0,0"))).unwrap();
        let [from_x, from_y, _] = camera(text).position_m;
        let nearest = vec2(from_x, from_y).distance(vec2(x, y));
        assert!(beyond || nearest < 1.5, "{text}: {nearest_m:?}");
        let error = trodden::Error::from(refused(text));
        assert!(error.hint().unwrap().contains(&format!("{x:.2},{y:.2}")), "{:?}", error.hint());
    }
    // Above the walls it may be anywhere.
    rooms.check(&camera("7.3,3.3,2.7,0,-45")).unwrap();
    rooms.check(&camera("-40,2,20,0,-30")).unwrap();
}

#[test]
fn automatic_cameras_stand_on_the_floor_away_from_walls() {
    let walls = corridor();
    let rooms = Rooms::new(&walls, &[], 2.6);
    let grid = trodden::stamps::TexelGrid::covering(13.0, 5.0, DENSITY).unwrap();
    let camera = rooms.eye_level(&FloorSums::new(grid));
    assert_eq!(camera.position_m[2], 1.7);
    assert!(walls.nearest(camera.place_m(), 5.0).unwrap().distance_m >= 0.48, "{camera}");
    rooms.check(&camera).unwrap();
}

/// All corners of the plan are in the picture, and it fills it.
#[test]
fn the_birds_eye_frames_the_plan() {
    let rooms = Rooms::new(&corridor(), &[], 2.6);
    for size in [[192, 108], [100, 200], [300, 60]] {
        let from = rooms.birds_eye(size);
        let coat = Painted(|_, _| [255, 0, 0]);
        let coat = Surfaces { floor: &coat, floor_texels_per_metre: DENSITY, small: None, walls: None };
        let picture = rooms.draw(&from, size, &[coat], &Silent).unwrap().remove(0);
        let red: Vec<(u32, u32)> = picture
            .enumerate_pixels()
            .filter(|(.., pixel)| pixel.0[0].saturating_sub(pixel.0[1].max(pixel.0[2])) > 40)
            .map(|(x, y, _)| (x, y))
            .collect();
        let [width, height] = size;
        let span = |values: Vec<u32>| [*values.iter().min().unwrap(), *values.iter().max().unwrap()];
        let across = span(red.iter().map(|p| p.0).collect());
        let up = span(red.iter().map(|p| p.1).collect());
        assert!(
            across[0] > 0 && across[1] < width - 1 && up[0] > 0 && up[1] < height - 1,
            "{size:?} {across:?} {up:?}"
        );
        let filled = |[low, high]: [u32; 2], of: u32| f64::from(high - low) / f64::from(of);
        assert!(filled(across, width).max(filled(up, height)) > 0.55, "{size:?}: {across:?} {up:?}");
    }
}

#[test]
fn absurd_cameras_and_sizes_are_errors() {
    let parse = |text: &str| text.parse::<Camera>().unwrap_err();
    assert!(matches!(parse("1,2,3"), CameraError::Parts { found: 3, .. }));
    assert!(matches!(parse(""), CameraError::Parts { .. }));
    assert!(matches!(parse("1,2,x,0,0"), CameraError::NotANumber { name: "z", .. }));
    for (text, name) in [
        ("1,2,0,0,0", "z"),
        ("1,2,-1,0,0", "z"),
        ("1,2,1.7,400,0", "heading"),
        ("1,2,1.7,0,-95", "pitch"),
        ("NaN,2,1.7,0,0", "x"),
        ("1,inf,1.7,0,0", "y"),
    ] {
        let error = parse(text);
        assert!(matches!(error, CameraError::Number { name: found, .. } if found == name), "{text}: {error}");
    }
    let rooms = Rooms::new(&corridor(), &[], 2.6);
    assert!(matches!(
        rooms.check(&camera("3,2,1.7,0,0").with_fov(f64::NAN)),
        Err(StillError::Camera(CameraError::Number { name: "fov", .. }))
    ));
    let coat = Painted(board);
    let coat = Surfaces { floor: &coat, floor_texels_per_metre: DENSITY, small: None, walls: None };
    assert!(rooms.draw(&camera("3,2,1.7,0,0"), [0, 5], &[coat], &Silent).is_err());
    assert_eq!(camera("3, 2,1.7, 0,0").to_string(), "3.00,2.00,1.70,0.0,0.0");
}

/// Straight down, straight along walls, from a doorway's edge: rays of all kinds end somewhere.
#[test]
fn rays_along_walls_and_straight_down_end() {
    for text in
        ["3,2.5,1.7,0,-89", "3,2.5,1.7,90,89", "6,2.5,30,0,-89", "0.001,1.001,0.05,0,0", "11.999,3.999,2.59,180,0"]
    {
        let picture = drawn(&camera(text), [64, 48], &board);
        assert!(picture.pixels().any(|pixel| pixel.0 != [0; 3]), "{text}");
    }
}
