//! Looks measured in photographs: what a photograph of a known look was rendered with comes back.

use std::path::PathBuf;

use image::{Rgb, RgbImage};
use trodden::look::{FloorResolver, Look, Material};
use trodden::math::{SplitMix64, srgb::light};
use trodden::plan::FloorPlan;
use trodden::stamps::TexelGrid;
use trodden::sums::{FloorSums, Quantity};
use trodden::walls::{Walls, WallsOptions};

use super::sandbox::Sandbox;

/// The photographed floor, metres, with a wall along its upper side, and floor beyond the others.
const SIZE_M: [f64; 2] = [6.0, 4.0];
const BEYOND_M: f64 = 1.0;
const DENSITY: f64 = 220.0;
/// Simulated people, and those whom they stand for where the lane is densest.
const WEIGHT: f64 = 20.0;
const LANE_PASSES: f64 = 1000.0;
/// The photograph, and where it shows the floor's corners.
const PHOTO_PX: [u32; 2] = [1800, 1300];
const CORNERS: [[f64; 2]; 4] = [[330.0, 150.0], [1490.0, 180.0], [1740.0, 1220.0], [60.0, 1180.0]];

/// A floor in linear light, the lowest row first.
struct Floor {
    width: usize,
    texels: Vec<[f32; 3]>,
    /// A part that was never dirty, metres from the upper left.
    clean: Option<[f64; 4]>,
    bare: Vec<[f32; 3]>,
}

/// People who have passed a distance from the upper side: a lane with broad, quiet margins.
fn passes(y: f64) -> f64 {
    let rise = |t: f64| {
        let t = t.clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    };
    LANE_PASSES * rise((y - 1.0) / 0.5) * rise((3.3 - y) / 0.5)
}

/// Walks over the floor, print by print, and resolves it with a look. Heels leave a mark in each square of `marks_m`.
fn trodden_floor(look: &Look, marks_m: Option<f64>) -> Floor {
    let texels = |metres: f64| (metres * DENSITY).round() as usize;
    let (beyond, width, height) = (texels(BEYOND_M), texels(SIZE_M[0]), texels(SIZE_M[1]));
    let (columns, rows) = (width + 2 * beyond, height + 2 * beyond);
    let is_floor = (0..columns * rows).map(|at| u8::from(at / columns >= beyond)).collect();
    let plan = FloorPlan::from_mask(columns as u32, rows as u32, 1.0 / DENSITY, is_floor);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    let grid = TexelGrid { texels_per_metre: DENSITY, width: columns as u32, height: rows as u32 };
    let mut sums = FloorSums::new(grid);
    // From the upper side, metres.
    let depth = |row: f64, per_m: f64| SIZE_M[1] + BEYOND_M - row / per_m;

    let cells = sums.presence_grid();
    let presence: Vec<u32> = (0..cells.height * cells.width)
        .map(|at| passes(depth(f64::from(at / cells.width) + 0.5, cells.texels_per_metre)) / WEIGHT)
        .map(|passes| (passes * f64::from(Quantity::Presence.one())) as u32)
        .collect();
    sums.add_block(Quantity::Presence, 0, 0, cells.width as usize, cells.height as usize, &presence);

    // Prints of 28 x 10 cm, as many as make the same passes in the mean.
    let (half_length, half_width) = (0.14 * DENSITY, 0.05 * DENSITY);
    let area = std::f64::consts::PI * half_length * half_width;
    let mut rng = SplitMix64::new(11);
    let mut counted = vec![0u32; columns * rows];
    let prints = (LANE_PASSES / WEIGHT * (columns * rows) as f64 / area) as usize;
    for _ in 0..prints {
        let (x, y) = (f64::from(rng.unit()) * columns as f64, f64::from(rng.unit()) * rows as f64);
        if f64::from(rng.unit()) * LANE_PASSES >= passes(depth(y, DENSITY)) {
            continue;
        }
        let range = |centre: f64, half: f64, count: usize| {
            (centre - half).max(0.0) as usize..((centre + half) as usize + 1).min(count)
        };
        for j in range(y, half_width, rows) {
            for i in range(x, half_length, columns) {
                let (u, v) = ((i as f64 - x) / half_length, (j as f64 - y) / half_width);
                if u * u + v * v < 1.0 {
                    counted[j * columns + i] += Quantity::Passes.one();
                }
            }
        }
    }
    sums.add_block(Quantity::Passes, 0, 0, columns, rows, &counted);

    if let Some(side) = marks_m {
        let mut scuff = vec![0u32; columns * rows];
        let squares = |count: usize| 0..(count as f64 / DENSITY / side) as usize;
        for (i, j) in squares(columns).flat_map(|i| squares(rows).map(move |j| (i, j))) {
            let [x, y] = [i, j].map(|k| (k as f64 + 0.3 + 0.4 * f64::from(rng.unit())) * side * DENSITY);
            let slope = f64::from(rng.unit()) - 0.5;
            // 8 cm long and 8 mm wide.
            let half = (0.04 * DENSITY) as i32;
            for (k, aside) in (-half..=half).flat_map(|k| [(k, 0.0), (k, 1.0)]) {
                let at = (y + aside + slope * f64::from(k)) as usize * columns + (x + f64::from(k)) as usize;
                scuff[at] = (0.5 * f64::from(Quantity::Scuff.one())) as u32;
            }
        }
        sums.add_block(Quantity::Scuff, 0, 0, columns, rows, &scuff);
    }

    let people = (look.total_passes as f64 / WEIGHT) as u32;
    let resolved = |look: &Look| -> Vec<[f32; 3]> {
        let resolver = FloorResolver::new(&sums, &walls, look, people).unwrap();
        let block = resolver.resolve(beyond as i64, beyond as i64, width, height);
        block.base_color.iter().map(|texel| texel.map(light)).collect()
    };
    Floor { width, texels: resolved(look), clean: None, bare: resolved(&look.clean()) }
}

/// Maps the unit square to the corners in the photograph.
fn projection([a, b, c, d]: [[f64; 2]; 4]) -> [[f64; 3]; 3] {
    let sum = [0, 1].map(|k| a[k] - b[k] + c[k] - d[k]);
    let (p, q) = ([b[0] - c[0], b[1] - c[1]], [d[0] - c[0], d[1] - c[1]]);
    let turn = p[0] * q[1] - p[1] * q[0];
    let (g, h) = ((sum[0] * q[1] - sum[1] * q[0]) / turn, (p[0] * sum[1] - p[1] * sum[0]) / turn);
    let row = |k: usize| [b[k] - a[k] + g * b[k], d[k] - a[k] + h * d[k], a[k]];
    [row(0), row(1), [g, h, 1.0]]
}

/// Where the photograph's place lies on the floor, from the upper left, 0 to 1.
fn unprojected(m: [[f64; 3]; 3], x: f64, y: f64) -> [f64; 2] {
    let rows = [0, 1].map(|k| {
        let at = [x, y][k];
        [m[k][0] - at * m[2][0], m[k][1] - at * m[2][1], at - m[k][2]]
    });
    let det = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
    [
        (rows[0][2] * rows[1][1] - rows[0][1] * rows[1][2]) / det,
        (rows[0][0] * rows[1][2] - rows[0][2] * rows[1][0]) / det,
    ]
}

impl Floor {
    /// Light of a place, from the upper left, 0 to 1, between texels.
    fn light(&self, [u, v]: [f64; 2]) -> [f64; 3] {
        let height = self.texels.len() / self.width;
        let is_clean = self
            .clean
            .is_some_and(|[x0, y0, x1, y1]| (x0..x1).contains(&(u * SIZE_M[0])) && (y0..y1).contains(&(v * SIZE_M[1])));
        let texels = if is_clean { &self.bare } else { &self.texels };
        let place = |t: f64, count: usize| (t * count as f64 - 0.5).clamp(0.0, (count - 1) as f64);
        let (x, y) = (place(u, self.width), place(1.0 - v, height));
        let (i, j) = ((x as usize).min(self.width - 2), (y as usize).min(height - 2));
        let (s, t) = (x - i as f64, y - j as f64);
        let at = |i: usize, j: usize| texels[j * self.width + i].map(f64::from);
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
        [0, 1, 2].map(|k| (a[k] * (1.0 - s) + b[k] * s) * (1.0 - t) + (c[k] * (1.0 - s) + d[k] * s) * t)
    }

    /// A photograph: a lens that blurs over a pixel, light that falls off by 20 %, noise of 2 of 255.
    fn photographed(&self) -> RgbImage {
        let map = projection(CORNERS);
        let mut rng = SplitMix64::new(3);
        RgbImage::from_fn(PHOTO_PX[0], PHOTO_PX[1], |px, py| {
            let (mut sum, mut slope) = ([0.0; 3], 0.0);
            for n in 0..9 {
                let (x, y) = (f64::from(px) + f64::from(n % 3) / 2.0, f64::from(py) + f64::from(n / 3) / 2.0);
                let [u, v] = unprojected(map, x, y);
                slope = 1.0 + 0.2 * (0.7 * (u - 0.5) + 0.3 * (v - 0.5));
                let light = if [u, v].iter().all(|t| (0.0..=1.0).contains(t)) { self.light([u, v]) } else { [0.3; 3] };
                (0..3).for_each(|k| sum[k] += light[k] / 9.0);
            }
            Rgb(sum.map(|light| {
                let light = light * slope;
                let tone =
                    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * libm::pow(light, 1.0 / 2.4) - 0.055 };
                (255.0 * tone + 2.0 * f64::from(rng.normal())).round().clamp(0.0, 255.0) as u8
            }))
        })
    }
}

/// Where the photograph shows a place of the floor, metres from the upper left.
fn shown_at([x, y]: [f64; 2]) -> [f64; 2] {
    let m = projection(CORNERS);
    let [u, v] = [x / SIZE_M[0], y / SIZE_M[1]];
    let [px, py, w] = m.map(|[a, b, c]| a * u + b * v + c);
    [px / w, py / w]
}

struct Fitted {
    sandbox: Sandbox,
    look: Look,
    json: serde_json::Value,
}

impl Fitted {
    /// Photographs a floor, measures it, and reads the look that was written.
    fn of(name: &str, floor: &Floor, more: &[&str]) -> Fitted {
        let sandbox = Sandbox::new();
        floor.photographed().save(sandbox.path("floor.png")).unwrap();
        let corners = CORNERS.map(|[x, y]| format!("{x},{y}"));
        let corners = corners.each_ref().map(String::as_str);
        let given = ["look", "fit", "floor.png", "--metres", "6,4", "--json", "-o", "fit.toml", "--corners"];
        let ran = sandbox.run(&[&given[..], &corners, more].concat()).succeeds();
        if let Ok(out) = std::env::var("FIT_OUT") {
            for file in ["floor.png", "fit_fit.png", "fit.toml"] {
                std::fs::copy(sandbox.path(file), PathBuf::from(&out).join(format!("{name}-{file}"))).unwrap();
            }
        }
        let json = serde_json::from_str(&ran.out).unwrap();
        let look = Look::read(&sandbox.path("fit.toml")).unwrap();
        Fitted { sandbox, look, json }
    }

    /// Of the photograph, and of our floor.
    fn measure(&self, name: &str) -> [f64; 2] {
        let measures = self.json["measures"].as_array().unwrap();
        let found = measures.iter().find(|measure| measure["name"] == name).unwrap_or_else(|| panic!("no {name}"));
        ["photo", "ours"].map(|of| found[of].as_f64().unwrap())
    }

    /// Floor and film come back within 15 %, but for some: colours in linear light, density, grain and blotches.
    fn is_like(&self, name: &str, truth: &Look, but: &[&str]) {
        let colours = |look: &Look| {
            let floor = look.floor.colour.unwrap_or_default().map(light);
            (floor.map(f64::from), look.film.colour.map(light).map(f64::from))
        };
        let ((floor, film), (true_floor, true_film)) = (colours(&self.look), colours(truth));
        let mut pairs: Vec<(String, f64, f64)> = Vec::new();
        for k in 0..3 {
            pairs.push((format!("floor {k}"), floor[k], true_floor[k]));
            pairs.push((format!("film {k}"), film[k], true_film[k]));
        }
        let of = |key: &str, value: fn(&Look) -> f32| {
            (key.to_string(), f64::from(value(&self.look)), f64::from(value(truth)))
        };
        pairs.push(of("film density", |look| look.film.density));
        pairs.push(of("grain", |look| look.noise.fine.sd));
        pairs.push(of("blotches", |look| look.noise.middle.sd));
        pairs.push(of("mop", |look| look.mop.unevenness));
        let [photo, ours] = self.measure("lane contrast");
        pairs.push(("lane contrast".to_string(), ours, photo));
        let mut far = Vec::new();
        for (key, found, truth) in pairs.into_iter().filter(|(key, ..)| !but.contains(&key.as_str())) {
            println!("{name}: {key} {found:.4} of {truth:.4}: {:+.1} %", 100.0 * (found / truth - 1.0));
            if (found / truth - 1.0).abs() > 0.15 {
                far.push(format!("{key} is {found:.4}, not {truth:.4}"));
            }
        }
        assert!(far.is_empty(), "{name}: {far:?}");
    }
}

/// A look of a material, whose film, grain and blotches are not those of the preset.
fn look(material: Material, colour: [u8; 3], density: f32, film: [u8; 3], grain: f32) -> Look {
    let mut look = Look { seed: 7, ..Look::default() };
    look.floor.material = material;
    look.floor.colour = Some(colour);
    look.film.density = density;
    look.film.colour = film;
    look.noise.fine.sd = grain;
    (look.noise.middle.sd, look.mop.unevenness) = (0.12, 1.0);
    look
}

#[test]
fn a_light_floor_comes_back() {
    let mut truth = look(Material::Vinyl, [205, 196, 180], 0.6, [92, 91, 84], 0.14);
    truth.noise.middle.sd *= 1.3;
    truth.mop.unevenness *= 1.3;
    (truth.age.rubs_per_m2, truth.age.grit_per_m2, truth.age.gum_per_m2) = (0.0, 0.0, 0.0);
    let fit = Fitted::of("vinyl", &trodden_floor(&truth, None), &["--wall", "upper"]);
    fit.is_like("vinyl", &truth, &[]);
    // There are no black marks, and none are seen.
    let ([marks, _], rubs) = (fit.measure("black marks"), fit.look.age.rubs_per_m2);
    assert!(marks < 0.2 && rubs <= Look::default().age.rubs_per_m2, "{marks} marks per m2, {rubs} rubs");
    let [photo, ours] = fit.measure("line at the wall, 0 to 4 cm");
    assert!((ours / photo - 1.0).abs() < 0.15 && photo > 5.0, "{ours} not {photo}");

    // Programs that read looks read this one.
    let sandbox = &fit.sandbox;
    sandbox.plan();
    let bake =
        ["bake", "plan.png", "--metres-per-pixel", "0.1", "--people", "5", "--texels-per-metre", "16", "-o", "out"];
    sandbox.run(&bake).succeeds();
    sandbox.run(&["resolve", "out", "--look", "fit.toml", "-o", "graded"]).succeeds();
    let picture = image::open(sandbox.path("fit_fit.png")).unwrap();
    assert!(picture.width() > 2 * picture.height(), "{} x {}", picture.width(), picture.height());
}

#[test]
fn a_dark_floor_comes_back() {
    let truth = look(Material::Dark, [54, 58, 62], 0.9, [100, 89, 70], 0.13);
    let fit = Fitted::of("dark", &trodden_floor(&truth, None), &["--material", "dark"]);
    // Its flecks outweigh the grain of the film, and the look says so.
    fit.is_like("dark", &truth, &["grain"]);
    assert_eq!(fit.look.noise.fine, Look::default().noise.fine);
    let kept = fit.json["kept"].as_array().unwrap();
    assert!(kept.iter().any(|kept| kept["key"] == "noise.fine"), "{kept:?}");
    assert!(fit.measure("lane contrast")[0] > 3.0);
}

#[test]
fn a_wooden_floor_comes_back() {
    let truth = look(Material::Wood, [180, 140, 100], 0.85, [96, 90, 77], 0.13);
    let fit = Fitted::of("wood", &trodden_floor(&truth, None), &["--material", "wood"]);
    fit.is_like("wood", &truth, &[]);
}

#[test]
fn age_comes_back_beside_a_clean_part() {
    let mut truth = look(Material::Vinyl, [190, 190, 188], 0.8, [100, 89, 70], 0.1);
    truth.age.density = 0.14;
    let clean = [2.0, 3.5, 2.8, 3.9];
    let floor = Floor { clean: Some(clean), ..trodden_floor(&truth, None) };
    // A box in the photograph, within the part.
    let [x0, y0] = shown_at([clean[0] + 0.08, clean[1] + 0.05]);
    let [x1, y1] = shown_at([clean[2] - 0.08, clean[3] - 0.05]);
    let part = format!("{x0:.0},{y0:.0},{x1:.0},{y1:.0}");
    let fit = Fitted::of("clean", &floor, &["--clean", &part]);
    fit.is_like("clean", &truth, &[]);
    let age = fit.look.age.density;
    assert!((age / 0.14 - 1.0).abs() < 0.15, "{age}");
}

#[test]
fn black_marks_are_counted() {
    let mut truth = look(Material::Vinyl, [205, 196, 180], 0.6, [100, 89, 70], 0.1);
    (truth.age.rubs_per_m2, truth.age.grit_per_m2, truth.age.gum_per_m2) = (0.0, 0.0, 0.0);
    let side = 0.45;
    let wanted = 1.0 / (side * side);
    let fit = Fitted::of("marks", &trodden_floor(&truth, Some(side)), &["--wall", "upper"]);
    let [photo, ours] = fit.measure("black marks");
    println!("{photo:.2} marks per m2 of {wanted:.2}, ours {ours:.2}");
    assert!((photo / wanted - 1.0).abs() < 0.15, "{photo} marks per m2 of {wanted}");
    let (rubs, preset) = (fit.look.age.rubs_per_m2, Look::default().age.rubs_per_m2);
    assert!(rubs > 1.5 * preset && ours > 0.5 * photo, "{rubs} rubs, {ours} marks of ours");
}

#[test]
fn what_is_no_floor_is_refused() {
    let sandbox = Sandbox::new();
    let grey = |size: [u32; 2], tone: u8| RgbImage::from_pixel(size[0], size[1], Rgb([tone; 3]));
    grey([400, 300], 150).save(sandbox.path("even.png")).unwrap();
    grey([400, 300], 0).save(sandbox.path("black.png")).unwrap();
    grey([3, 3], 150).save(sandbox.path("tiny.png")).unwrap();
    sandbox.write("text.png", "no picture");
    let line = ["--corners", "10,10", "100,10", "200,10", "300,10"];
    let crossed = ["--corners", "10,10", "300,200", "300,10", "10,200"];
    let outside = ["--corners", "10,10", "500,10", "300,200", "10,200"];
    for (photo, metres, more, parts) in [
        ("none.png", "4,3", &[][..], &["none.png: cannot read the photograph", "No such file"][..]),
        ("text.png", "4,3", &[], &["text.png: cannot read the photograph", "hint: PNG"]),
        ("tiny.png", "4,3", &[], &["3 x 3 px", "hint: photograph the floor"]),
        ("even.png", "0,3", &[], &["the floor is 0 x 3 m, allowed are 0.3 to 50", "hint: give width and height"]),
        ("even.png", "4,3", &line, &["not those of a rectangle", "no three on one line"]),
        ("even.png", "4,3", &crossed, &["not those of a rectangle"]),
        ("even.png", "4,3", &outside, &["500,10 is outside the photograph of 400 x 300 px", "hint: "]),
        ("even.png", "40,30", &[], &["10.0 px per metre", "hint: photograph the floor closer"]),
        ("even.png", "4,3", &["--clean", "900,900,950,950"], &["shows too little of the floor", "hint: "]),
        ("black.png", "4,3", &[], &["it is black", "hint: "]),
        ("even.png", "4,3", &[], &["there is no lane", "hint: choose a rectangle"]),
    ] {
        let given = ["look", "fit", photo, "-o", "fit.toml", "--metres", metres];
        sandbox.run(&[&given[..], more].concat()).fails(1, parts);
    }
    let metres = sandbox.run(&["look", "fit", "even.png", "--metres", "4", "-o", "fit.toml"]).fails(2, &["2 numbers"]);
    assert!(!metres.err.contains("panicked"));
    for (output, parts) in [("even.png", "even.png"), ("one.png", "one file")] {
        let given = ["look", "fit", "even.png", "--metres", "4,3", "--force", "--picture", "one.png", "-o", output];
        sandbox.run(&given).fails(1, &[parts, if output == "one.png" { "hint: name the look" } else { "error: " }]);
    }
}

/// Most rubs are too faint to be counted, so that the rate is rougher than the rest.
#[test]
#[ignore = "takes most of a minute"]
fn rubs_come_back_roughly() {
    let rates = [0.5, 2.0].map(|by| {
        let mut truth = look(Material::Vinyl, [205, 196, 180], 0.6, [100, 89, 70], 0.1);
        truth.age.rubs_per_m2 *= by;
        truth.age.grit_per_m2 *= by;
        truth.age.gum_per_m2 *= by;
        let fit = Fitted::of("rubs", &trodden_floor(&truth, None), &["--wall", "upper"]);
        let (rubs, wanted) = (fit.look.age.rubs_per_m2, truth.age.rubs_per_m2);
        println!("{rubs} rubs of {wanted}");
        assert!((rubs / wanted - 1.0).abs() < 0.4, "{rubs} rubs, not {wanted}");
        rubs
    });
    assert!(rates[1] > 2.5 * rates[0], "{rates:?}");
}
