//! Walls of whole bakes: how dirty the plain wall is, where dirt gathers, at which heights, and in which colours.

use std::path::Path;

use trodden::Silent;
use trodden::bake::{OutputOptions, bake};
use trodden::export::{Manifest, read_sums, read_wall_sums};
use trodden::look::{Look, ResolvedBlock, WallResolver};
use trodden::math::{Vec2, srgb::light, vec2};
use trodden::scenario::{Overrides, Scenario};
use trodden::sums::{FloorSums, Quantity};
use trodden::walls::{Doorway, Walls};

/// Texels per metre of the measured walls.
const PER_METRE: f64 = 40.0;
/// Corners are walls up to here, plain walls begin there, metres.
const AT_CORNER_M: f64 = 0.10;
const PLAIN_FROM_M: f64 = 0.6;
/// Dirt below is of the mop and the skirting, metres.
const ABOVE_M: f64 = 0.15;
/// Distances from a wall at which people walk who can reach it, metres.
const IN_REACH_M: [f64; 4] = [0.35, 0.5, 0.65, 0.8];
/// Length of the stretches of plain wall in reach of which at most a tenth may be without touches, metres.
const STRETCH_M: f64 = 3.0;

/// The walls of a bake, resolved.
struct Baked {
    walls: Walls,
    /// By face: dirty and clean.
    faces: Vec<[ResolvedBlock; 2]>,
    rows: usize,
    doorways: Vec<Doorway>,
    floor: FloorSums,
}

fn baked(name: &str) -> Baked {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans").join(name).with_extension("toml");
    let overrides = Overrides { texels_per_metre: Some(8.0), ..Overrides::default() };
    let mut scenario = Scenario::open(&path, &overrides).unwrap();
    scenario.wall_texels_per_metre = PER_METRE;
    // Shoulders of adults.
    scenario.bodies.children = 0.0;
    // The stipple of the paint would count as dirt.
    scenario.look.wall.texture = 0.0;
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("out");
    bake(&scenario, &OutputOptions { folder: folder.clone(), force: false }, &Silent).unwrap();
    let manifest = Manifest::read(&folder).unwrap();
    let walls = manifest.walls().unwrap();
    let sums = read_wall_sums(&folder, &manifest).unwrap().unwrap();
    let floor = read_sums(&folder, &manifest).unwrap();
    let people = manifest.walls.as_ref().unwrap().people;
    let rows = sums.grid().height as usize;
    let clean = scenario.look.clean();
    let of = |look: &Look| -> Vec<ResolvedBlock> {
        let resolver = WallResolver::new(&sums, &walls, look, people).unwrap();
        let all = |face: usize| {
            let columns = resolver.columns(face).unwrap() as usize;
            let mut block = resolver.resolve(face, 0, 0, columns, rows);
            if block.empty {
                block.base_color = vec![resolver.background().base_color; columns * rows];
                block.layers.clear();
            }
            block
        };
        (0..walls.faces.len()).map(all).collect()
    };
    let faces = of(&scenario.look).into_iter().zip(of(&clean)).map(|(dirty, clean)| [dirty, clean]).collect();
    Baked { walls, faces, rows, doorways: manifest.doors.unwrap_or_default(), floor }
}

/// CIE L*a*b* of an sRGB colour (D65).
fn lab(colour: [u8; 3]) -> [f64; 3] {
    let [r, g, b] = colour.map(|byte| f64::from(light(byte)));
    let f = |t: f64| if t > 0.008_856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
    let x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.950_47);
    let y = f(0.2126 * r + 0.7152 * g + 0.0722 * b);
    let z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.088_83);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// A column of wall.
struct Column {
    /// Distance to the nearest outer corner, and to the nearest corner of any kind, metres.
    outer_m: f64,
    corner_m: f64,
    /// Share of the wall above [`ABOVE_M`] that is more than 3 L* darker than clean.
    visible: f64,
    /// Whether anybody left a trace, however faint.
    touched: bool,
    /// Whether people walked close enough to touch it.
    in_reach: bool,
}

/// Whether a column is in the middle of a plain wall.
fn is_plain(column: &Column) -> bool {
    column.corner_m > PLAIN_FROM_M
}

impl Baked {
    /// Whether people walked at a place.
    fn is_walked(&self, at: Vec2) -> bool {
        let grid = self.floor.grid_of(Quantity::Presence);
        let [i, j] = [at.x, at.y].map(|metres| metres * grid.texels_per_metre);
        let is_inside = i >= 0.0 && j >= 0.0 && i < f64::from(grid.width) && j < f64::from(grid.height);
        let mut sum = [0];
        if is_inside {
            self.floor.read(Quantity::Presence, i as u32, j as u32, 1, 1, &mut sum);
        }
        2 * sum[0] > Quantity::Presence.one()
    }

    /// Whether people walked within reach of a place on a face.
    fn is_in_reach(&self, face: usize, along_m: f64) -> bool {
        let points = &self.walls.faces[face].points_m;
        let sides = (0..points.len()).map(|n| (points[n], points[(n + 1) % points.len()]));
        let mut left_m = along_m;
        let side = sides.into_iter().find(|(from, to)| {
            let is_here = left_m <= from.distance(*to);
            left_m -= if is_here { 0.0 } else { from.distance(*to) };
            is_here
        });
        let Some((from, to)) = side else { return false };
        let way = (to - from) * (1.0 / from.distance(to).max(1e-9));
        // The floor is on the right of a face.
        IN_REACH_M.iter().any(|&off_m| self.is_walked(from + way * left_m + vec2(way.y, -way.x) * off_m))
    }

    /// Shares of visible touches of the stretches of plain wall in reach; `None` without any touch.
    fn stretches(columns: &[Column]) -> Vec<Option<f64>> {
        let length = (STRETCH_M * PER_METRE) as usize;
        let plain = columns.split(|column| !is_plain(column)).flat_map(|wall| wall.chunks_exact(length));
        let in_reach = plain.filter(|wall| 2 * wall.iter().filter(|column| column.in_reach).count() > length);
        in_reach
            .map(|wall| wall.iter().any(|column| column.touched).then(|| mean(wall.iter().map(|c| c.visible))))
            .collect()
    }

    fn columns(&self) -> Vec<Column> {
        let corners = self.walls.corners();
        let mut columns = Vec::new();
        let low = (ABOVE_M * PER_METRE) as usize;
        for (face, [dirty, clean]) in self.faces.iter().enumerate() {
            if self.walls.faces[face].furniture_m.is_some() {
                continue;
            }
            let width = dirty.base_color.len() / self.rows;
            let length_m = self.walls.faces[face].length_m();
            let distance = |along_m: f64, turned: fn(f64) -> bool| {
                let of_face = corners.iter().filter(|corner| corner.face == face && turned(corner.turn_rad));
                let around = of_face.map(|corner| (corner.along_m - along_m).abs());
                let wrapped =
                    |apart: f64| if self.walls.faces[face].closed { apart.min(length_m - apart) } else { apart };
                around.map(wrapped).fold(f64::INFINITY, f64::min)
            };
            for i in 0..width {
                let along_m = (i as f64 + 0.5) / PER_METRE;
                let texels = (low..self.rows).map(|j| j * width + i);
                let darker =
                    texels.clone().filter(|&k| lab(dirty.base_color[k])[0] < lab(clean.base_color[k])[0] - 3.0);
                let touches = dirty.layers.iter().take(5);
                columns.push(Column {
                    touched: touches.flat_map(|layer| texels.clone().map(|k| layer.values[k])).any(|d| d > 0.02),
                    in_reach: self.is_in_reach(face, along_m),
                    outer_m: distance(along_m, |turn| turn < -0.6),
                    corner_m: distance(along_m, |_| true),
                    visible: darker.count() as f64 / (self.rows - low) as f64,
                });
            }
        }
        columns
    }

    /// Visible share around each jamb of a door that people went through.
    fn used_jambs(&self) -> impl Iterator<Item = f64> + '_ {
        let walked = |door: &&Doorway| {
            (1..10).any(|tenth| self.is_walked(door.jambs_m[0].lerp(door.jambs_m[1], 0.1 * f64::from(tenth))))
        };
        let used = self.doorways.iter().filter(walked);
        let columns = used.flat_map(|door| door.on_faces.map(|(face, along_m)| (door.depth_m, face, along_m)));
        columns.map(|(depth_m, face, along_m)| {
            let [dirty, clean] = &self.faces[face];
            let width = dirty.base_color.len() / self.rows;
            let half_m = 0.5 * depth_m + AT_CORNER_M;
            let at = |metres: f64| ((metres * PER_METRE).max(0.0) as usize).min(width - 1);
            let columns = at(along_m - half_m)..at(along_m + half_m) + 1;
            let low = (ABOVE_M * PER_METRE) as usize;
            let texels = columns.clone().flat_map(|i| (low..self.rows).map(move |j| j * width + i));
            let darker = |k: &usize| lab(dirty.base_color[*k])[0] < lab(clean.base_color[*k])[0] - 3.0;
            let count = columns.len() * (self.rows - low);
            texels.filter(darker).count() as f64 / count as f64
        })
    }

    /// Heights above and below which 5 % of the density of a layer lie, metres.
    fn heights_m(&self, layer: &str) -> [f64; 2] {
        let mut by_row = vec![0.0; self.rows];
        for [dirty, _] in &self.faces {
            let width = dirty.base_color.len() / self.rows;
            for layer in dirty.layers.iter().filter(|known| known.name == layer) {
                for (sum, row) in by_row.iter_mut().zip(layer.values.chunks(width)) {
                    *sum += row.iter().map(|&density| f64::from(density)).sum::<f64>();
                }
            }
        }
        let all: f64 = by_row.iter().sum();
        let at = |share: f64| {
            let mut below = 0.0;
            for (row, of_row) in by_row.iter().enumerate() {
                if below + of_row >= share * all {
                    return (row as f64 + (share * all - below) / of_row.max(1e-9)) / PER_METRE;
                }
                below += of_row;
            }
            0.0
        };
        [at(0.05), at(0.95)]
    }

    /// Change of a* and b* where one layer alone is about 9 L* dark.
    fn tint(&self, layer: &str) -> Option<[f64; 2]> {
        let mut changes = Vec::new();
        for [dirty, clean] in &self.faces {
            let Some(own) = dirty.layers.iter().position(|known| known.name == layer) else { continue };
            for (k, (&seen, &plain)) in dirty.base_color.iter().zip(&clean.base_color).enumerate() {
                let all: f32 = dirty.layers.iter().map(|layer| layer.values[k]).sum();
                if all > 0.0 && dirty.layers[own].values[k] > 0.95 * all {
                    let (seen, plain) = (lab(seen), lab(plain));
                    if (-10.5..-7.5).contains(&(seen[0] - plain[0])) {
                        changes.push([seen[1] - plain[1], seen[2] - plain[2]]);
                    }
                }
            }
        }
        let count = changes.len() as f64;
        (count > 20.0).then(|| [0, 1].map(|n| changes.iter().map(|change| change[n]).sum::<f64>() / count))
    }
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / f64::max(count, 1.0)
}

#[test]
fn plain_walls_are_touched_corners_are_dirty_and_dirt_has_colours() {
    for name in ["station", "museum", "corridors"] {
        let baked = baked(name);
        let columns = baked.columns();
        let plain = columns.iter().filter(|column| is_plain(column));
        let outer = columns.iter().filter(|column| column.outer_m < AT_CORNER_M);
        let plain_share = mean(plain.map(|column| column.visible));
        let corner_share = mean(outer.map(|column| column.visible));
        println!("{name}: plain {:.2} %, corners {:.1} times", 100.0 * plain_share, corner_share / plain_share);
        assert!((0.003..0.01).contains(&plain_share), "{name}: {plain_share} of the plain wall is visibly touched");
        assert!(corner_share > 10.0 * plain_share, "{name}: {corner_share} at corners, {plain_share} elsewhere");

        let jambs: Vec<f64> = baked.used_jambs().collect();
        println!("  jambs of used doors {jambs:.3?}");
        assert!(name != "station" || jambs.len() >= 4, "{name}: {} jambs of used doors", jambs.len());
        let least = jambs.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(least > 0.02 && least > 10.0 * plain_share, "{name}: a used jamb with {least}, plain {plain_share}");

        let mut stretches = Baked::stretches(&columns);
        stretches.sort_by(|a, b| a.unwrap_or(0.0).total_cmp(&b.unwrap_or(0.0)));
        let median = stretches[stretches.len() / 2].unwrap_or(0.0);
        println!("  of {} stretches in reach the median has {:.2} %", stretches.len(), 100.0 * median);
        let clean = stretches.iter().filter(|stretch| stretch.is_none()).count();
        assert!(stretches.len() >= 8 && 10 * clean <= stretches.len(), "{name}: {stretches:.4?}");
        assert!(median > 0.001, "{name}: the median stretch of plain wall in reach has {median}");

        let (shoulders, hands) = (baked.heights_m("shoulder"), baked.heights_m("hand"));
        println!("  shoulders {shoulders:.3?} m, hands {hands:.2?} m");
        // Corridors have no narrow place.
        assert!(name == "corridors" || shoulders[0] > 1.27 && shoulders[1] < 1.52, "{name}: {shoulders:?}");

        let tints = ["hand", "bag", "shoe"].map(|layer| baked.tint(layer));
        println!("  a*, b* of hands, bags, shoes {tints:.1?}");
        if let [Some(hand), _, Some(shoe)] = tints {
            assert!((4.5..8.5).contains(&hand[1]), "{name}: hands {hand:?}");
            assert!(shoe[1] < 0.0, "{name}: shoes {shoe:?}");
        }
    }
}
