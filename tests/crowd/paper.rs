//! The experiment of Takenaka, Tanaka and Sagawa, *Expression of indoor grime by human walk*, on the sample plan of
//! its kind: 1000 people on three routes, and what its pictures are said to show, measured on the sum `passes`.

use std::path::Path;

use trodden::crowd::Simulation;
use trodden::look::FloorResolver;
use trodden::marks::{Footfalls, Mark, Origin};
use trodden::math::srgb::light;
use trodden::math::{Rect, Vec2, vec2};
use trodden::motion::{Frame, Motion};
use trodden::patterns::{Cause, PatternLibrary};
use trodden::plan;
use trodden::routes;
use trodden::scenario::{Overrides, Preset, Scenario};
use trodden::stamps::{Stamper, TexelGrid};
use trodden::sums::{FloorSums, Quantity};
use trodden::walls::Walls;

/// A stretch of corridor.
struct Part {
    name: &'static str,
    area: Rect,
    /// Unit vector along it.
    along: Vec2,
}

const RIGHT: Vec2 = vec2(1.0, 0.0);
const UP: Vec2 = vec2(0.0, 1.0);

fn part(name: &'static str, along: Vec2, min: [f64; 2], max: [f64; 2]) -> Part {
    Part { name, area: Rect { min: min.into(), max: max.into() }, along }
}

/// Straight stretches, clear of junctions. All corridors are 5 m wide.
fn straight_parts() -> Vec<Part> {
    vec![
        part("southern, west", RIGHT, [3.0, 19.5], [13.0, 24.5]),
        part("southern, before the split", RIGHT, [24.0, 19.5], [36.0, 24.5]),
        part("southern, after the split", RIGHT, [50.0, 19.5], [60.0, 24.5]),
        part("southern, east", RIGHT, [71.0, 19.5], [78.0, 24.5]),
        part("middle", UP, [41.5, 30.0], [46.5, 50.0]),
        part("northern, before the merging", RIGHT, [24.0, 55.5], [38.0, 60.5]),
        part("northern, after the merging", RIGHT, [50.0, 55.5], [60.0, 60.5]),
        part("northern, east", RIGHT, [71.0, 55.5], [78.0, 60.5]),
        part("eastern", UP, [63.5, 28.0], [68.5, 50.0]),
        part("western, north", UP, [15.5, 63.0], [20.5, 77.0]),
        part("eastern, south", UP, [63.5, 3.0], [68.5, 16.0]),
    ]
}

/// What was seen of an area.
#[derive(Clone, Default)]
struct Seen {
    people: std::collections::BTreeSet<u32>,
    path_m: f64,
    footfalls: u64,
    /// Distances of footfalls from the left side of the area, looking along it, metres.
    across_m: Vec<f64>,
}

struct Walked {
    sums: FloorSums,
    /// L* of each straight part, seen from above, and of one that is on nobody's way.
    lightness: Vec<f64>,
    untrodden: f64,
    /// How often each cause of [`Cause::WALL`] touched a wall.
    touches: Vec<usize>,
    parts: Vec<Seen>,
    junctions: Vec<Seen>,
    /// Least distance of a body's middle from a wall on straight parts, metres.
    least_wall_m: f64,
}

/// Where flows split and merge, and the straight part before each.
fn junctions() -> Vec<(Part, &'static str)> {
    vec![
        (part("split", RIGHT, [39.0, 19.5], [48.0, 27.0]), "southern, before the split"),
        (part("merging", RIGHT, [40.0, 53.0], [49.0, 60.5]), "middle"),
    ]
}

fn walk(sample: &str, seed: u64, people: u32) -> Walked {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans").join(sample);
    let overrides =
        Overrides { preset: Some(Preset::Paper), people: Some(people), seed: Some(seed), ..Overrides::default() };
    let scenario = Scenario::open(&path, &overrides).unwrap();
    let plan = plan::read(&scenario.plan_path().unwrap(), &scenario.plan_options()).unwrap();
    let walls = Walls::trace(&plan, &scenario.walls);
    let routes = routes::find(&plan, &walls, &scenario.routes).unwrap();
    let library = PatternLibrary::built_in();
    let persons = scenario.people_of_day(0);
    let mut crowd = Simulation::new(&plan, &walls, &routes, &persons, &scenario.crowd).unwrap();
    let origins = Origin::of_arrivals(crowd.arrivals().iter().map(|a| a.from_outside), 0);
    let mut footfalls = Footfalls::new(&persons, &walls, &library, &scenario.marks, origins).unwrap();
    let grid = TexelGrid::covering(plan.width_m(), plan.height_m(), 50.0).unwrap();
    let stamper = Stamper::new(&library, grid, &scenario.stamps).unwrap();

    let parts = straight_parts();
    let junctions: Vec<Part> = junctions().into_iter().map(|(junction, _)| junction).collect();
    let mut walked = Walked {
        sums: FloorSums::new(grid),
        lightness: Vec::new(),
        untrodden: 0.0,
        touches: Vec::new(),
        parts: vec![Seen::default(); parts.len()],
        junctions: vec![Seen::default(); junctions.len()],
        least_wall_m: f64::INFINITY,
    };
    let (mut frame, mut marks, mut contacts) = (Frame::default(), Vec::new(), Vec::new());
    let mut before_s = 0.0;
    while crowd.next_frame(&mut frame).unwrap() {
        let step_s = frame.time_s - before_s;
        before_s = frame.time_s;
        for walker in &frame.walkers {
            let places = parts.iter().zip(&mut walked.parts).chain(junctions.iter().zip(&mut walked.junctions));
            for (_, seen) in places.filter(|(part, _)| part.area.contains(walker.position_m)) {
                seen.people.insert(walker.id);
                seen.path_m += walker.velocity_m_s.length() * step_s;
            }
            let straight = parts.iter().any(|part| part.area.contains(walker.position_m));
            if let Some(nearest) = walls.nearest(walker.position_m, 1.0).filter(|_| straight) {
                walked.least_wall_m = walked.least_wall_m.min(nearest.distance_m);
            }
        }
        footfalls.push(&frame, &mut marks);
    }
    footfalls.finish(&mut marks);
    footfalls.take_contacts(&mut contacts);
    walked.touches = Cause::WALL.iter().map(|&cause| contacts.iter().filter(|c| c.cause == cause).count()).collect();
    assert_eq!(crowd.tally().arrived, u64::from(people));
    walked.sums.add(&stamper, &walls, &marks);
    let floor = FloorResolver::new(&walked.sums, &walls, &scenario.look, people).unwrap();
    walked.lightness = parts.iter().map(|part| lightness(&floor, grid, part.area)).collect();
    walked.untrodden = lightness(&floor, grid, part("western, south", UP, [15.5, 3.0], [20.5, 16.0]).area);
    for mark in marks.iter().filter(|mark: &&Mark| mark.cause == Cause::Sole) {
        let places = parts.iter().zip(&mut walked.parts).chain(junctions.iter().zip(&mut walked.junctions));
        for (part, seen) in places.filter(|(part, _)| part.area.contains(mark.place_m)) {
            seen.footfalls += 1;
            seen.across_m.push((mark.place_m - part.area.min).dot(vec2(part.along.y, part.along.x)));
        }
    }
    walked
}

/// Mean of `passes` over an area.
fn passes_per_m2(sums: &FloorSums, area: Rect) -> f64 {
    let grid = sums.grid();
    let texel = |metres: f64| (metres * grid.texels_per_metre).round() as u32;
    let (width, height) = (texel(area.width()) as usize, texel(area.height()) as usize);
    let mut values = vec![0; width * height];
    sums.read(Quantity::Passes, texel(area.min.x), texel(area.min.y), width, height, &mut values);
    let total: u64 = values.iter().map(|&v| u64::from(v)).sum();
    total as f64 / f64::from(Quantity::Passes.one()) / values.len() as f64
}

/// L* of the mean light of an area.
fn lightness(floor: &FloorResolver<'_>, grid: TexelGrid, area: Rect) -> f64 {
    let texel = |metres: f64| (metres * grid.texels_per_metre).round() as usize;
    let (width, height) = (texel(area.width()), texel(area.height()));
    let block = floor.resolve(texel(area.min.x) as i64, texel(area.min.y) as i64, width, height);
    let luminance = |rgb: &[u8; 3]| {
        let [r, g, b] = rgb.map(|byte| f64::from(light(byte)));
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    let mean = block.base_color.iter().map(luminance).sum::<f64>() / block.base_color.len() as f64;
    116.0 * libm::cbrt(mean) - 16.0
}

fn correlation(pairs: &[(f64, f64)]) -> f64 {
    let n = pairs.len() as f64;
    let (mx, my) = (pairs.iter().map(|p| p.0).sum::<f64>() / n, pairs.iter().map(|p| p.1).sum::<f64>() / n);
    let sum = |f: fn(f64, f64) -> f64| pairs.iter().map(|p| f(p.0 - mx, p.1 - my)).sum::<f64>();
    sum(|x, y| x * y) / (sum(|x, _| x * x) * sum(|_, y| y * y)).sqrt()
}

#[test]
fn grime_is_what_the_paper_found() {
    let walked = walk("corridors.toml", 1, 1000);
    let parts = straight_parts();

    // On straight parts grime is proportional to the number that passed.
    let pairs: Vec<(f64, f64)> = (parts.iter().zip(&walked.parts))
        .map(|(part, seen)| (seen.people.len() as f64, passes_per_m2(&walked.sums, part.area)))
        .collect();
    for ((part, seen), (people, passes)) in parts.iter().zip(&walked.parts).zip(&pairs) {
        let per_m = seen.footfalls as f64 / seen.path_m;
        println!("{:<28} {people:>5} people {passes:.3} passes, {per_m:.3} prints per metre", part.name);
    }
    let r = correlation(&pairs);
    println!("correlation {r:.4}");
    assert!(r >= 0.98, "passes per area against people: correlation {r:.3}");

    // Where flows split and merge, people are slower, take shorter steps and leave more prints.
    for ((junction, before), seen) in junctions().into_iter().zip(&walked.junctions) {
        let straight = &walked.parts[parts.iter().position(|part| part.name == before).unwrap()];
        let per_m = |seen: &Seen| seen.footfalls as f64 / seen.path_m;
        println!("{}: {:.3} against {:.3} prints per metre", junction.name, per_m(seen), per_m(straight));
        let more = per_m(seen) / per_m(straight) - 1.0;
        assert!(more > 0.02, "{}: {:.1} % more prints per metre than before it", junction.name, 100.0 * more);
    }

    // People fill the width that the distance from walls leaves them, and keep that distance.
    assert!(walked.least_wall_m >= 0.5 - 0.01, "a body's middle came within {:.3} m of a wall", walked.least_wall_m);
    for (part, seen) in parts.iter().zip(&walked.parts) {
        let mut across = seen.across_m.clone();
        across.sort_by(f64::total_cmp);
        let width_m = if part.along == RIGHT { part.area.height() } else { part.area.width() };
        let spread_m = across[across.len() - 1 - across.len() / 200] - across[across.len() / 200];
        println!("{:<28} prints over {:.0} % of the width", part.name, 100.0 * spread_m / (width_m - 1.0));
        assert!(spread_m >= 0.8 * (width_m - 1.0), "{}: prints over {spread_m:.2} m of {width_m} m", part.name);
    }
}

/// The paper's figure 7, at the strength that the preset paints with.
#[test]
fn from_above_the_sample_is_as_dark_as_many_have_passed() {
    for seed in 1..=3 {
        let walked = walk("paper.toml", seed, 1000);
        let mut pairs: Vec<(f64, f64)> =
            walked.parts.iter().zip(&walked.lightness).map(|(seen, &l)| (seen.people.len() as f64, l)).collect();
        let trodden = -correlation(&pairs);
        pairs.push((0.0, walked.untrodden));
        println!("seed {seed}: people and L* {pairs:.1?}, touches {:?}", walked.touches);
        let r = -correlation(&pairs);
        let darkest = walked.lightness.iter().copied().fold(f64::INFINITY, f64::min);
        println!(
            "seed {seed}: correlation {r:.3}, {trodden:.3} where people walk, {:.1} L*",
            walked.untrodden - darkest
        );
        assert!(r.min(trodden) > 0.95, "seed {seed}: passers and luminance correlate by {r:.3} and {trodden:.3}");
        assert!(walked.untrodden - darkest > 15.0, "seed {seed}: L* from {darkest:.1} to {:.1}", walked.untrodden);
        // Each route is taken by a third: 3 standard deviations are 45.
        let routes = ["southern, after the split", "middle", "eastern"];
        for (part, seen) in straight_parts().iter().zip(&walked.parts).filter(|(part, _)| routes.contains(&part.name)) {
            assert!(seen.people.len().abs_diff(333) < 45, "seed {seed}: {} on {}", seen.people.len(), part.name);
        }
        assert!(walked.touches.iter().all(|&count| count > 0), "seed {seed}: touches {:?}", walked.touches);
    }
}
