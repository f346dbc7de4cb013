//! The ceiling of `scene.glb`: as large as the floor, seen from below, above the lamps; only where it is asked for.

use std::fs;
use std::path::Path;

use serde_json::Value;
use trodden::Silent;
use trodden::bake::{OutputOptions, ResolveOptions, bake, resolve};
use trodden::scenario::{Overrides, Scenario};

/// A model as programs read it: JSON and its buffer.
struct Glb {
    root: Value,
    buffer: Vec<u8>,
}

impl Glb {
    fn open(file: &Path) -> Glb {
        let bytes = fs::read(file).unwrap();
        let length = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        let json = 20..20 + length(12);
        let root = serde_json::from_slice(&bytes[json.clone()]).unwrap();
        Glb { root, buffer: bytes[json.end + 8..].to_vec() }
    }

    /// The bytes of an accessor, which is packed, and how many elements they are.
    fn bytes(&self, accessor: &Value) -> &[u8] {
        let view = &self.root["accessors"][accessor.as_u64().unwrap() as usize]["bufferView"];
        let view = &self.root["bufferViews"][view.as_u64().unwrap() as usize];
        let at = view["byteOffset"].as_u64().unwrap() as usize;
        &self.buffer[at..at + view["byteLength"].as_u64().unwrap() as usize]
    }

    fn triangles(&self, name: &str) -> Vec<[[f64; 3]; 3]> {
        let meshes = self.root["meshes"].as_array().unwrap().iter();
        let named = meshes.filter(|mesh| mesh["name"].as_str().unwrap().starts_with(name));
        named.flat_map(|mesh| self.triangles_of(&mesh["primitives"][0])).collect()
    }

    fn triangles_of(&self, primitive: &Value) -> Vec<[[f64; 3]; 3]> {
        let places = self.bytes(&primitive["attributes"]["POSITION"]).as_chunks::<4>().0;
        let places: Vec<f64> = places.iter().map(|&bytes| f32::from_le_bytes(bytes).into()).collect();
        let accessor = &self.root["accessors"][primitive["indices"].as_u64().unwrap() as usize];
        let size = if accessor["componentType"] == 5123 { 2 } else { 4 };
        let indices = self.bytes(&primitive["indices"]).chunks_exact(size);
        let number = |bytes: &[u8]| bytes.iter().rev().fold(0, |number, &byte| number << 8 | usize::from(byte));
        let corners: Vec<[f64; 3]> =
            indices.map(number).map(|n| [places[3 * n], places[3 * n + 1], places[3 * n + 2]]).collect();
        corners.as_chunks().0.to_vec()
    }

    /// Heights of the lamps, metres.
    fn lamps_m(&self) -> Vec<f64> {
        let nodes = self.root["nodes"].as_array().unwrap().iter();
        let lamps = nodes.filter(|node| node["extensions"]["KHR_lights_punctual"].is_object());
        lamps.map(|node| node["translation"][1].as_f64().unwrap()).collect()
    }
}

/// Area seen from above, +Y, square metres; what is seen from below counts as less than nothing.
fn from_above_m2(triangles: &[[[f64; 3]; 3]]) -> f64 {
    let area = |[a, b, c]: &[[f64; 3]; 3]| 0.5 * ((b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]));
    triangles.iter().map(area).sum()
}

#[test]
fn a_ceiling_covers_the_floor_above_the_lamps() {
    let plans = Path::new(env!("CARGO_MANIFEST_DIR")).join("floorplans");
    let overrides = Overrides { texels_per_metre: Some(8.0), ..Overrides::default() };
    let mut scenario = Scenario::open(&plans.join("school.toml"), &overrides).unwrap();
    scenario.wall_texels_per_metre = 20.0;
    scenario.crowd.people = 4;
    let dir = tempfile::tempdir().unwrap();
    let [plain, closed] = ["plain", "closed"].map(|name| dir.path().join(name));
    bake(&scenario, &OutputOptions { folder: plain.clone(), force: false }, &Silent).unwrap();
    let asked = Some(true);
    let options = ResolveOptions {
        folder: Some(closed.clone()),
        ceiling: asked,
        lamps: asked,
        usd: asked,
        ..ResolveOptions::default()
    };
    resolve(&plain, &options, &Silent).unwrap();

    let [open, glb] = [&plain, &closed].map(|bake| Glb::open(&bake.join("scene.glb")));
    assert!(open.triangles("ceiling").is_empty());
    let [floor, ceiling] = ["floor_", "ceiling"].map(|name| glb.triangles(name));
    let [floor_m2, ceiling_m2] = [from_above_m2(&floor), -from_above_m2(&ceiling)];
    println!("floor {floor_m2}, ceiling {ceiling_m2}");
    assert!(floor_m2 > 100.0 && (ceiling_m2 / floor_m2 - 1.0).abs() < 0.01, "{ceiling_m2} over {floor_m2}");
    let height_m = ceiling[0][0][1];
    let wall_m = glb.triangles("walls_").iter().flatten().map(|corner| corner[1]).fold(0.0, f64::max);
    assert!(ceiling.iter().flatten().all(|corner| corner[1] == height_m) && height_m == wall_m);
    // Each faces down; none is folded back.
    assert!(ceiling.iter().all(|triangle| from_above_m2(&[*triangle]) < 0.0));
    let lamps_m = glb.lamps_m();
    assert!(!lamps_m.is_empty() && lamps_m.iter().all(|&lamp_m| height_m - 0.1 < lamp_m && lamp_m < height_m));
    assert!(fs::read_to_string(closed.join("scene.usda")).unwrap().contains("def Mesh \"ceiling\""));
    // The page looks in from above: it is the same with a ceiling.
    let [a, b] = [&plain, &closed].map(|bake| fs::read(bake.join("index.html")).unwrap());
    assert!(a == b);
}
