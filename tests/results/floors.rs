//! Floors of two sample plans, walked whole: what an artist sees between a busy gate and an untrodden corner.

use std::path::Path;
use std::sync::LazyLock;

use trodden::crowd::Simulation;
use trodden::look::{FloorResolver, Look, MopLook, WearLook};
use trodden::marks::{Footfalls, Origin};
use trodden::math::srgb::light;
use trodden::math::{Vec2, vec2};
use trodden::motion::{Frame, Motion, People};
use trodden::patterns::PatternLibrary;
use trodden::scenario::{Overrides, Scenario};
use trodden::stamps::{Stamper, TexelGrid};
use trodden::sums::FloorSums;
use trodden::walls::Walls;

const TEXELS_PER_M: usize = 100;
/// Side of the squares that are compared, texels.
const SQUARE: usize = 20;

struct Trodden {
    walls: Walls,
    sums: FloorSums,
    people: u32,
    look: Look,
}

fn walked(name: &str, people: u32) -> Trodden {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans").join(name);
    let scenario = Scenario::open(&path, &Overrides { people: Some(people), ..Overrides::default() }).unwrap();
    let plan = trodden::plan::read(&scenario.plan_path().unwrap(), &scenario.plan_options()).unwrap();
    let walls = Walls::trace(&plan, &scenario.walls);
    let routes = trodden::routes::find(&plan, &walls, &scenario.routes).unwrap();
    let library = PatternLibrary::built_in();
    let bodies = People::new(scenario.seed, scenario.bodies.clone());
    let mut crowd = Simulation::new(&plan, &walls, &routes, &bodies, &scenario.crowd).unwrap();
    let origins = Origin::of_arrivals(crowd.arrivals().iter().map(|arrival| arrival.from_outside), 300);
    let mut footfalls = Footfalls::new(&bodies, &walls, &library, &scenario.marks, origins).unwrap();
    let grid = TexelGrid::covering(plan.width_m(), plan.height_m(), TEXELS_PER_M as f64).unwrap();
    let (stamper, mut sums) = (Stamper::new(&library, grid, &scenario.stamps).unwrap(), FloorSums::new(grid));
    let (mut frame, mut marks) = (Frame::default(), Vec::new());
    while crowd.next_frame(&mut frame).unwrap() {
        footfalls.push(&frame, &mut marks);
    }
    footfalls.finish(&mut marks);
    footfalls.take_lasting(&mut marks);
    sums.add(&stamper, &walls, &marks);
    // On vinyl everywhere: the figures are of one floor.
    let look = Look { total_passes: scenario.look.total_passes, ..Look::default() };
    Trodden { walls, sums, people, look }
}

/// The station's gates, 1000 people.
static STATION: LazyLock<Trodden> = LazyLock::new(|| walked("station.toml", 1000));
/// Corridors of 5 m, 400 people.
static CORRIDORS: LazyLock<Trodden> = LazyLock::new(|| walked("corridors.toml", 400));

/// L*, a*, b* of linear sRGB.
fn lab(rgb: [f64; 3]) -> [f64; 3] {
    let row = |m: [f64; 3], white: f64| {
        let t = (m[0] * rgb[0] + m[1] * rgb[1] + m[2] * rgb[2]) / white;
        if t > 0.008_856 { libm::cbrt(t) } else { (903.3 * t + 16.0) / 116.0 }
    };
    let x = row([0.4124, 0.3576, 0.1805], 0.9505);
    let y = row([0.2126, 0.7152, 0.0722], 1.0);
    let z = row([0.0193, 0.1192, 0.9505], 1.089);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// A square of floor away from walls.
struct Square {
    /// Passes in the whole history.
    passes: f64,
    /// Seconds that soles stood in the whole history.
    stood_s: f64,
    lab: [f64; 3],
    /// Mean level of each mask.
    mask: [f64; 4],
}

struct Floor {
    squares: Vec<Square>,
    clean: [f64; 3],
    lightness: Vec<f64>,
    /// The mask of passes.
    passes: Vec<u8>,
    width: usize,
}

/// Resolves a piece of the floor: lower left corner, width and height, metres.
fn resolved(trodden: &Trodden, look: &Look, [x, y, width, height]: [f64; 4]) -> Floor {
    let resolver = FloorResolver::new(&trodden.sums, &trodden.walls, look, trodden.people).unwrap();
    let texels = |metres: f64| (metres * TEXELS_PER_M as f64) as usize;
    let (columns, rows) = (texels(width), texels(height));
    let block = resolver.resolve(texels(x) as i64, texels(y) as i64, columns, rows);
    let layer = |name: &str| &block.layers.iter().find(|layer| layer.name == name).unwrap().values;
    let (presence, dwell) = (layer("presence"), layer("dwell"));
    let weight = look.total_passes as f64 / f64::from(trodden.people);
    let linear = |k: usize| block.base_color[k].map(|byte| f64::from(light(byte)));
    let mut squares = Vec::new();
    for j in (0..rows - SQUARE).step_by(SQUARE) {
        for i in (0..columns - SQUARE).step_by(SQUARE) {
            let middle =
                vec2(x, y) + vec2((i + SQUARE / 2) as f64, (j + SQUARE / 2) as f64) * (1.0 / TEXELS_PER_M as f64);
            let near = trodden.walls.nearest(middle, 2.0).map_or(2.0, |nearest| nearest.distance_m);
            if !trodden.walls.is_inside(middle) || near < 0.4 {
                continue;
            }
            let within = || (0..SQUARE * SQUARE).map(|n| (j + n / SQUARE) * columns + i + n % SQUARE);
            let count = (SQUARE * SQUARE) as f64;
            let mean = |channel: usize| within().map(|k| linear(k)[channel]).sum::<f64>() / count;
            let whole = |layer: &[f32]| weight * within().map(|k| f64::from(layer[k])).sum::<f64>() / count;
            let (passes, stood_s) = (whole(presence), whole(dwell));
            let mask = [0, 1, 2, 3].map(|n| within().map(|k| f64::from(block.mask[k][n])).sum::<f64>() / count);
            squares.push(Square { passes, stood_s, lab: lab([mean(0), mean(1), mean(2)]), mask });
        }
    }
    let clean = lab(resolver.background().base_color.map(|byte| f64::from(light(byte))));
    let lightness = (0..columns * rows).map(|k| lab(linear(k))[0]).collect();
    let passes = block.mask.iter().map(|mask| mask[1]).collect();
    Floor { squares, clean, lightness, passes, width: columns }
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0usize), |(sum, count), value| (sum + value, count + 1));
    assert!(count >= 5, "only {count} squares");
    sum / count as f64
}

impl Floor {
    fn of(&self, passes: std::ops::Range<f64>, part: usize) -> f64 {
        mean(self.squares.iter().filter(|square| passes.contains(&square.passes)).map(|square| square.lab[part]))
    }
}

const GATES: [f64; 4] = [20.0, 12.0, 14.0, 14.0];

/// The station's look after a history so long that many places have seen 430 people.
fn busy_look() -> Look {
    Look { total_passes: 2 * STATION.look.total_passes, ..STATION.look.clone() }
}

#[test]
fn busy_and_quiet_ways_are_told_apart_and_untrodden_floor_has_aged() {
    let floor = resolved(&STATION, &busy_look(), GATES);
    let (side, busy) = (floor.of(38.0..60.0, 0), floor.of(330.0..560.0, 0));
    let untrodden = floor.of(0.0..2.0, 0);
    println!("clean {:.1}, untrodden {untrodden:.1}, 48 passes {side:.1}, 430 passes {busy:.1}", floor.clean[0]);
    assert!(side - busy >= 7.0, "48 and 430 passes differ by {:.1} L*", side - busy);
    assert!(untrodden - side >= 1.5, "{untrodden:.1}, {side:.1}");
    assert!((0.4..4.0).contains(&(floor.clean[0] - untrodden)), "untrodden floor is {untrodden:.1}");
}

#[test]
fn floors_that_are_mopped_more_often_are_lighter_where_people_walk() {
    let every = |every: f32| {
        let look = busy_look();
        resolved(&STATION, &Look { mop: MopLook { every, ..look.mop.clone() }, ..look }, GATES)
    };
    let [often, usual, seldom] = [100.0, 1000.0, 5000.0].map(every);
    let lane = |floor: &Floor| floor.of(330.0..560.0, 0);
    println!("lanes {:.1}, {:.1}, {:.1}", lane(&often), lane(&usual), lane(&seldom));
    assert!(lane(&often) - lane(&usual) >= 2.5 && lane(&usual) - lane(&seldom) >= 2.5);
    // An untrodden corner has nothing to take, and what is trodden in stays.
    let corner = |floor: &Floor| floor.of(0.0..2.0, 0);
    assert!((corner(&often) - corner(&seldom)).abs() < 1.0, "{}, {}", corner(&often), corner(&seldom));
    assert!(often.of(38.0..60.0, 0) - lane(&often) >= 4.0, "lanes are gone");
    // Passes are counted, not cleaned.
    assert_eq!(often.passes, seldom.passes);
}

/// Levels of film and of passes that shaders get.
#[test]
fn masks_use_their_range() {
    let floor = resolved(&STATION, &busy_look(), GATES);
    let level = |passes: std::ops::Range<f64>, mask: usize| {
        mean(floor.squares.iter().filter(|square| passes.contains(&square.passes)).map(|square| square.mask[mask]))
    };
    let [film, passes] = [0, 1].map(|mask| (level(38.0..60.0, mask), level(330.0..560.0, mask)));
    println!("film {film:?}, passes {passes:?}");
    assert!(film.1 > 100.0 && film.1 - film.0 > 40.0, "film of 48 and 430 passes: {film:?}");
    assert!(passes.1 - passes.0 > 40.0 && passes.1 < 200.0, "passes of 48 and 430: {passes:?}");
    let full = floor.passes.iter().filter(|&&level| level == 255).count();
    assert_eq!(full, 0, "the mask of passes is full at {full} texels");
}

#[test]
fn lanes_are_warm() {
    let floor = resolved(&STATION, &STATION.look, GATES);
    let dark = floor.squares.iter().filter(|square| (8.0..10.0).contains(&(floor.clean[0] - square.lab[0])));
    let warmer = mean(dark.map(|square| square.lab[2])) - floor.clean[2];
    println!("b* {warmer:+.1} at L* -9");
    assert!((2.0..5.0).contains(&warmer), "b* {warmer:+.1}");
}

#[test]
fn heavy_is_heavier_everywhere() {
    let commuters = resolved(&STATION, &STATION.look, GATES);
    let heavy =
        resolved(&STATION, &Look { total_passes: STATION.look.total_passes, ..Look::preset("heavy").unwrap() }, GATES);
    for (light, dirty) in commuters.squares.iter().zip(&heavy.squares) {
        assert!(dirty.lab[0] < light.lab[0] + 1.0, "{:.1} {:.1}", dirty.lab[0], light.lab[0]);
    }
    let darker = mean(commuters.squares.iter().zip(&heavy.squares).map(|(a, b)| a.lab[0] - b.lab[0]));
    assert!(darker > 2.0, "heavy is {darker:.1} L* darker");
}

#[test]
fn joints_of_tiles_are_far_dirtier_than_tiles() {
    let mut look = STATION.look.clone();
    look.floor.material = trodden::look::Material::Tile;
    let [dirty, clean] = [look.clone(), look.clean()].map(|look| resolved(&STATION, &look, GATES));
    // Joints lie at multiples of 30 cm: on two texels, of which each has half of the joint's 4 mm.
    const SHARE: f64 = 0.2;
    let luminance = |lightness: f64| libm::pow((lightness + 16.0) / 116.0, 3.0);
    let [clean, dirty] = [&clean, &dirty].map(|floor| {
        let (mut joints, mut tiles) = (Vec::new(), Vec::new());
        for (k, &lightness) in floor.lightness.iter().enumerate() {
            let [x, y] = [k % floor.width + 2000, k / floor.width + 1200].map(|n| n % 30);
            let is_amid = |n: usize| (8..22).contains(&n);
            if (([0, 29].contains(&x)) && is_amid(y)) || ([0, 29].contains(&y) && is_amid(x)) {
                joints.push(luminance(lightness));
            } else if is_amid(x) && is_amid(y) {
                tiles.push(luminance(lightness));
            }
        }
        let [joint, tile] = [joints, tiles].map(|values| values.iter().sum::<f64>() / values.len() as f64);
        let joint = (joint - (1.0 - SHARE) * tile) / SHARE;
        [joint, tile].map(|light| 116.0 * libm::cbrt(light) - 16.0)
    });
    let [joint, tile] = [clean[0] - dirty[0], clean[1] - dirty[1]];
    println!("joints {joint:.1}, tiles {tile:.1}: {:.1} times", joint / tile);
    // A joint of 4 mm takes 0.4 of a texel of a centimetre, which is then three to five times as dirty as a tile's.
    let texel = 0.4 * joint + 0.6 * tile;
    assert!((3.0..5.0).contains(&(texel / tile)), "{joint:.1} and {tile:.1}");
}

/// Lightness over clean along a stretch of wall of 2 m: of the first 4 cm, and of 10 to 25 cm.
fn beside(resolver: &FloorResolver<'_>, walls: &Walls, middle: Vec2, along: Vec2) -> Option<[f64; 2]> {
    let clean = lab(resolver.background().base_color.map(|byte| f64::from(light(byte))))[0];
    let inward = [along.left(), along.left() * -1.0].into_iter().find(|n| walls.is_inside(middle + *n * 0.2))?;
    let side = 260;
    let [i0, j0] = [middle.x, middle.y].map(|metres| (metres * TEXELS_PER_M as f64) as i64 - side / 2);
    let block = resolver.resolve(i0, j0, side as usize, side as usize);
    let band = |from: f64, to: f64| {
        let mut values = Vec::new();
        for step in 0..200 {
            for depth in 0..((to - from) * TEXELS_PER_M as f64).round() as usize {
                let out = from + (depth as f64 + 0.5) / TEXELS_PER_M as f64;
                let p = middle + along * (f64::from(step) / 100.0 - 1.0) + inward * out;
                let [i, j] = [p.x, p.y].map(|metres| (metres * TEXELS_PER_M as f64) as i64);
                let texel = block.base_color[((j - j0) * side + i - i0) as usize];
                values.push(lab(texel.map(|byte| f64::from(light(byte))))[0] - clean);
            }
        }
        values.iter().sum::<f64>() / values.len() as f64
    };
    Some([band(0.0, 0.04), band(0.10, 0.25)])
}

#[test]
fn corridors_have_a_quiet_margin_and_a_dirty_line_at_the_skirting() {
    let trodden = &*CORRIDORS;
    for (preset, margin_at_least) in [("commuters", -3.0), ("heavy", -6.0)] {
        let look = Look::preset(preset).unwrap();
        let resolver = FloorResolver::new(&trodden.sums, &trodden.walls, &look, trodden.people).unwrap();
        let (mut margins, mut lines) = (Vec::new(), Vec::new());
        for outline in trodden.walls.outlines() {
            for k in 0..outline.points_m.len() {
                let [a, b] = outline.edge(k);
                let (length, Some(along)) = (a.distance(b), (b - a).normalized()) else { continue };
                if length < 6.0 || outline.opening(k).is_some() {
                    continue;
                }
                // Far from corners.
                let Some([line, margin]) = beside(&resolver, &trodden.walls, a.lerp(b, 0.37), along) else { continue };
                margins.push(margin);
                lines.push(line - margin);
            }
        }
        margins.sort_by(f64::total_cmp);
        let dirty = lines.iter().filter(|line| **line <= -5.0).count();
        let middle = margins[margins.len() / 2];
        println!(
            "{preset}: {} stretches, margin {middle:.1} ({:.1} at worst), line on {dirty}",
            lines.len(),
            margins[0]
        );
        assert!(lines.len() >= 10 && middle >= margin_at_least, "{preset}: {middle:.1}");
        assert!(dirty * 10 >= lines.len() * 9, "{preset}: {lines:.1?}");
    }
}

/// The ticket machines and the lines before them.
const MACHINES: [f64; 4] = [8.0, 15.0, 10.0, 4.0];

#[test]
fn floors_darken_where_people_stand_and_only_there() {
    let with = &STATION.look;
    let mut without = with.clone();
    (without.dwell.density, without.dwell.gum) = (0.0, 0.0);
    let [with, without] = [with, &without].map(|look| resolved(&STATION, look, MACHINES));
    let darker = |seconds: std::ops::Range<f64>| {
        let squares = with.squares.iter().zip(&without.squares).filter(|(square, _)| seconds.contains(&square.stood_s));
        mean(squares.map(|(with, without)| without.lab[0] - with.lab[0]))
    };
    let (stood, passed_by) = (darker(200.0..f64::INFINITY), darker(0.0..1.0));
    println!("{stood:.1} L* darker where people stood, {passed_by:.2} elsewhere");
    assert!((3.0..12.0).contains(&stood), "{stood:.1}");
    assert!((0.0..0.3).contains(&passed_by), "{passed_by:.2}");
}

/// Entrance from the street, its first 12 m inwards.
const ENTRANCE: [f64; 4] = [14.5, 0.1, 4.5, 12.0];

#[test]
fn rain_comes_in_at_the_entrance_and_ends_after_a_few_steps() {
    let wet = Look::preset("wet").unwrap();
    let dry = Look { wet: Look::default().wet, ..wet.clone() };
    let [x, y, width, height] = ENTRANCE.map(|metres| metres * TEXELS_PER_M as f64);
    let [wet, dry] = [&wet, &dry].map(|look| {
        let resolver = FloorResolver::new(&STATION.sums, &STATION.walls, look, STATION.people).unwrap();
        resolver.resolve(x as i64, y as i64, width as usize, height as usize)
    });
    let shares = |from_m: f64, to_m: f64| {
        let texels = || (from_m * TEXELS_PER_M as f64 * width) as usize..(to_m * TEXELS_PER_M as f64 * width) as usize;
        let lightness = |rgb: [u8; 3]| lab(rgb.map(|byte| f64::from(light(byte))))[0];
        let darker = texels().filter(|&k| lightness(wet.base_color[k]) < lightness(dry.base_color[k]) - 3.0).count();
        let shining = texels().filter(|&k| f64::from(wet.orm[k][1]) < 0.8 * f64::from(dry.orm[k][1])).count();
        [darker, shining].map(|count| count as f64 / texels().len() as f64)
    };
    let [door, inside, far] = [shares(0.0, 1.5), shares(3.0, 5.0), shares(9.0, 12.0)];
    println!("darker and shining: {door:.3?} at the door, {inside:.3?} after 3 to 5 m, {far:.4?} after 9 m");
    assert!(door.iter().all(|share| (0.1..0.6).contains(share)), "{door:?}");
    assert!(inside.iter().all(|share| (0.005..0.1).contains(share)), "{inside:?}");
    assert!(far.iter().all(|&share| share < 0.001), "{far:?}");
}

/// Wear per pass of a piece of floor, by `floor_wear`, without noise.
fn wear_per_pass(trodden: &Trodden, [x, y, width, height]: [f64; 4], turns: f32) -> f64 {
    let mut look = Look { total_passes: 100_000, ..Look::default() };
    // A level is a small step.
    look.wear = WearLook { strength: 3.0, turns };
    for octave in [&mut look.noise.fine, &mut look.noise.middle, &mut look.noise.coarse] {
        octave.sd = 0.0;
    }
    let resolver = FloorResolver::new(&trodden.sums, &trodden.walls, &look, trodden.people).unwrap();
    let texels = |metres: f64| (metres * TEXELS_PER_M as f64) as usize;
    let block = resolver.resolve(texels(x) as i64, texels(y) as i64, texels(width), texels(height));
    let wear: f64 = block.relief.iter().map(|relief| f64::from(relief[0])).sum();
    let presence = block.layers.iter().find(|layer| layer.name == "presence").unwrap();
    wear / presence.values.iter().map(|&passes| f64::from(passes)).sum::<f64>()
}

#[test]
fn turns_gates_and_counters_wear_more_per_pass_than_straight_ways() {
    let station = ([34.0, 34.0, 4.0, 5.0], &*STATION);
    let mut missed = Vec::new();
    let corridors = ([2.0, 20.5, 30.0, 3.0], &*CORRIDORS);
    for (what, (straight, trodden), place) in [
        ("ticket gates in", station, [25.0, 18.8, 7.2, 1.6]),
        ("ticket gates out", station, [41.6, 21.4, 7.2, 1.6]),
        ("ticket machines", station, [9.0, 17.2, 8.0, 1.2]),
        ("ticket office", station, [35.0, 18.8, 2.0, 0.8]),
        ("door of the toilets", station, [44.9, 33.0, 1.2, 1.4]),
        ("turn of a corridor", corridors, [18.0, 57.0, 4.0, 2.5]),
    ] {
        let ratio = |turns: f32| wear_per_pass(trodden, place, turns) / wear_per_pass(trodden, straight, turns);
        let (with, without) = (ratio(1.0), ratio(0.0));
        println!("{what}: {with:.2} times the straight way's wear per pass, {without:.2} by passes alone");
        assert!((0.8..1.1).contains(&without), "{what}: {without:.2}");
        if with < 1.5 {
            missed.push(what);
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}

/// Lightness of lines of single wheels over that of the floor beside them, where `passes` people have walked.
fn lines_beside(trodden: &Trodden, look: &Look, place: [f64; 4], passes: std::ops::Range<f64>) -> f64 {
    let [x, y, width, height] = place.map(|metres| (metres * TEXELS_PER_M as f64) as usize);
    let resolver = FloorResolver::new(&trodden.sums, &trodden.walls, look, trodden.people).unwrap();
    let block = resolver.resolve(x as i64, y as i64, width, height);
    let layer = |name: &str| &block.layers.iter().find(|layer| layer.name == name).unwrap().values;
    let (wheels, presence) = (layer("wheels"), layer("presence"));
    let weight = look.total_passes as f64 / f64::from(trodden.people);
    let lightness = |k: usize| lab(block.base_color[k].map(|byte| f64::from(light(byte))))[0];
    const BESIDE: usize = 6;
    let mut darker = Vec::new();
    for j in BESIDE..height - BESIDE {
        for i in BESIDE..width - BESIDE {
            let k = j * width + i;
            if wheels[k] < 0.7 || !passes.contains(&(weight * f64::from(presence[k]))) {
                continue;
            }
            // To both sides of a line there is floor that no wheel touched.
            let pairs = [[k - BESIDE, k + BESIDE], [k - BESIDE * width, k + BESIDE * width]];
            if let Some(pair) = pairs.into_iter().find(|pair| pair.iter().all(|&k| wheels[k] == 0.0)) {
                darker.push(lightness(k) - 0.5 * (lightness(pair[0]) + lightness(pair[1])));
            }
        }
    }
    assert!(darker.len() > 300, "only {} texels", darker.len());
    mean(darker.into_iter())
}

#[test]
fn single_wheels_leave_lines_that_fade_into_busy_ways() {
    const FOYER: [f64; 4] = [10.0, 10.0, 30.0, 26.0];
    let mut without = STATION.look.clone();
    without.wheels.density = 0.0;
    let beside = |look: &Look, passes| lines_beside(&STATION, look, FOYER, passes);
    let quiet = beside(&STATION.look, 0.0..25.0);
    let (busy, none) = (beside(&STATION.look, 250.0..600.0), beside(&without, 0.0..25.0));
    println!("lines {quiet:.1} L* where few walk, {busy:.1} where many do; {none:.1} without wheels in the look");
    assert!((-8.0..-2.0).contains(&quiet), "{quiet:.1} L*");
    assert!(busy > 0.6 * quiet, "{busy:.1} L*");
    assert!(none.abs() < 0.4, "{none:.1} L*");
}

/// Opacity from which a mark is seen: 5 L* on vinyl.
const SEEN: u8 = 40;

/// Texels that lie together: their bounds and number.
struct Spot {
    low: [usize; 2],
    high: [usize; 2],
    texels: usize,
}

/// The spots of a mask.
fn spots(mut mask: Vec<bool>, columns: usize) -> Vec<Spot> {
    let rows = mask.len() / columns;
    let (mut found, mut next) = (Vec::new(), Vec::new());
    for first in 0..mask.len() {
        let mut spot = Spot { low: [usize::MAX; 2], high: [0; 2], texels: 0 };
        next.push(first);
        while let Some(texel) = next.pop() {
            if !std::mem::take(&mut mask[texel]) {
                continue;
            }
            let at = [texel % columns, texel / columns];
            (0..2).for_each(|axis| spot.low[axis] = spot.low[axis].min(at[axis]));
            (0..2).for_each(|axis| spot.high[axis] = spot.high[axis].max(at[axis]));
            spot.texels += 1;
            let beside = (-1..=1).flat_map(|dj| (-1..=1).map(move |di| (at[0] as i64 + di, at[1] as i64 + dj)));
            let inside = |&(i, j): &(i64, i64)| i >= 0 && j >= 0 && i < columns as i64 && j < rows as i64;
            next.extend(beside.filter(inside).map(|(i, j)| j as usize * columns + i as usize));
        }
        found.extend((spot.texels > 0).then_some(spot));
    }
    found
}

/// Marks of rubber that are seen, 2 cm long and more, per square metre of a piece of floor.
fn black_marks_per_m2(look: &Look, [x, y, width, height]: [f64; 4]) -> f64 {
    let resolver = FloorResolver::new(&STATION.sums, &STATION.walls, look, STATION.people).unwrap();
    let texels = |metres: f64| (metres * TEXELS_PER_M as f64) as usize;
    let (columns, rows) = (texels(width), texels(height));
    let block = resolver.resolve(texels(x) as i64, texels(y) as i64, columns, rows);
    let dark: Vec<bool> = block.relief.iter().map(|relief| relief[1] > SEEN).collect();
    let is_long = |spot: &&Spot| (0..2).any(|axis| spot.high[axis] - spot.low[axis] >= 2);
    let count = spots(dark, columns).iter().filter(is_long).count();
    count as f64 / (width * height)
}

/// Prints that can be read per square metre of a piece of floor: 40 cm2 and more that are 2 L* darker than the floor.
fn readable_prints_per_m2(place: [f64; 4]) -> f64 {
    let look = &STATION.look;
    let mut without = look.clone();
    without.prints.soil = 0.0;
    let [with, without] = [look, &without].map(|look| resolved(&STATION, look, place));
    let seen = without.lightness.iter().zip(&with.lightness).map(|(floor, print)| floor - print >= 2.0);
    let prints = spots(seen.collect(), with.width).iter().filter(|spot| spot.texels >= 40).count();
    prints as f64 / (place[2] * place[3])
}

/// The soil that shoes bring in from the street is gone after some steps.
#[test]
fn a_few_prints_can_be_read_most_of_them_at_entrances() {
    let entrances = [[14.2, 0.5, 5.6, 5.0], [0.5, 10.2, 5.0, 4.6]].map(readable_prints_per_m2);
    let inside = readable_prints_per_m2([22.0, 8.0, 12.0, 9.0]);
    println!("{entrances:.2?} per m2 at entrances, {inside:.2} inside");
    for entrance in entrances {
        assert!((0.35..3.5).contains(&entrance), "{entrance} per m2 at an entrance");
        assert!(entrance >= 5.0 * inside, "{entrance} per m2 at an entrance, {inside} inside");
    }
    assert!((0.01..0.5).contains(&inside), "{inside} per m2 inside");
}

/// In front of the ticket gates.
const BEFORE_GATES: [f64; 4] = [21.5, 17.0, 6.0, 2.5];

#[test]
fn black_marks_gather_at_gates_and_grow_with_the_root_of_the_history() {
    let aged = |total_passes: u64| Look { total_passes, ..STATION.look.clone() };
    let [young, old] = [5_000, 80_000].map(|passes| black_marks_per_m2(&aged(passes), BEFORE_GATES));
    let places = [[4.0, 8.0, 8.0, 4.0], [14.0, 8.0, 10.0, 6.0], BEFORE_GATES];
    let by_place = |look: &Look| places.map(|place| black_marks_per_m2(look, place));
    let [side, way, gates] = by_place(&STATION.look);
    let heavy = by_place(&Look::preset("heavy").unwrap());
    println!(
        "aside {side:.2}, on the way {way:.2}, at gates {gates:.2}, of 5000 {young:.2}, of 80 000 {old:.2}, heavy {heavy:.2?}"
    );
    assert!((0.2..0.6).contains(&way), "{way} per m2 on a way");
    assert!(gates > 5.0 * side && gates > 2.0 * way, "{gates} per m2 at gates, {side} aside, {way} on a way");
    // Sixteen times the people: four times the marks, some of which lie on each other.
    assert!((2.0..5.0).contains(&(old / young)), "{young} grew to {old}");
    // All places together: a dozen marks on one of them tell little.
    let of_all = |marks: [f64; 3]| -> f64 {
        marks.iter().zip(places).map(|(per_m2, [_, _, width, height])| per_m2 * width * height).sum()
    };
    let (more, usual) = (of_all(heavy), of_all([side, way, gates]));
    assert!(more > 1.15 * usual && heavy[2] < 5.0, "heavy has {more} marks, commuters {usual}");
}
