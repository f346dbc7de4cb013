use image::RgbImage;
use serde_json::Value;

use super::*;
use crate::show::scene::file::{PlainMaterial, SceneFile, SurfaceImages};
use crate::show::scene::{Mesh, Scene, SceneSurface};

/// A file taken apart again.
struct Parsed {
    json: Value,
    binary: Vec<u8>,
}

fn written(scene: &Scene, options: &SceneFile) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_glb(&mut bytes, scene, options).unwrap();
    bytes
}

fn parsed(bytes: &[u8]) -> Parsed {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&bytes[..4], word(4), word(8)), (&b"glTF"[..], 2, bytes.len()));
    let length = word(12);
    assert_eq!((&bytes[16..20], length % 4), (&b"JSON"[..], 0));
    let json = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    let chunk = 20 + length;
    assert_eq!((&bytes[chunk + 4..chunk + 8], word(chunk) % 4), (&b"BIN\0"[..], 0));
    assert_eq!(chunk + 8 + word(chunk), bytes.len());
    Parsed { json, binary: bytes[chunk + 8..].to_vec() }
}

impl Parsed {
    fn view(&self, index: u64) -> &[u8] {
        let view = &self.json["bufferViews"][index as usize];
        let number = |key: &str| view[key].as_u64().unwrap() as usize;
        assert_eq!(number("byteOffset") % 4, 0);
        &self.binary[number("byteOffset")..number("byteOffset") + number("byteLength")]
    }

    /// The numbers of an accessor.
    fn numbers(&self, index: &Value) -> Vec<f64> {
        let accessor = &self.json["accessors"][index.as_u64().unwrap() as usize];
        let bytes = self.view(accessor["bufferView"].as_u64().unwrap());
        let numbers: Vec<f64> = match accessor["componentType"].as_u64().unwrap() {
            5126 => bytes.chunks(4).map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap()))).collect(),
            5125 => bytes.chunks(4).map(|b| f64::from(u32::from_le_bytes(b.try_into().unwrap()))).collect(),
            5123 => bytes.chunks(2).map(|b| f64::from(u16::from_le_bytes(b.try_into().unwrap()))).collect(),
            other => panic!("component type {other}"),
        };
        let each = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        assert_eq!(numbers.len() as u64, accessor["count"].as_u64().unwrap() * each);
        numbers
    }
}

fn triangle(surface: SceneSurface) -> Mesh {
    let textured = matches!(surface, SceneSurface::FloorTile(_) | SceneSurface::WallSheet(_));
    Mesh {
        surface,
        positions_m: vec![[1.0, 2.0, 0.0], [4.0, 2.0, 0.1], [4.0, 6.5, 0.3]],
        normals: vec![[0.0, 0.0, 1.0]; 3],
        uvs: if textured { vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.25]] } else { Vec::new() },
        indices: vec![0, 1, 2],
        faces: Vec::new(),
        light_uvs: Vec::new(),
    }
}

fn files<'a>(name: &str, base_color: &'a str, orm: &'a str) -> SurfaceImages<'a> {
    SurfaceImages { name: name.to_string(), base_color, orm, normal: None, embedded: None }
}

#[test]
fn a_part_is_found_again_with_y_up() {
    let scene = Scene { meshes: vec![triangle(SceneSurface::FloorTile(0)), triangle(SceneSurface::WallTop)] };
    let floor = vec![files("floor_1001", "floor/floor base.1001.png", "floor/floor_orm.1001.png")];
    let options = SceneFile { name: "Hall \"A\"".to_string(), seed: u64::MAX, floor, ..SceneFile::default() };
    let file = parsed(&written(&scene, &options));
    let json = &file.json;

    let primitive = &json["meshes"][0]["primitives"][0];
    let positions = file.numbers(&primitive["attributes"]["POSITION"]);
    let wanted = [1.0, 0.0, -2.0, 4.0, 0.1, -2.0, 4.0, 0.3, -6.5];
    assert!(positions.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-6), "{positions:?}");
    assert_eq!(file.numbers(&primitive["attributes"]["NORMAL"])[..3], [0.0, 1.0, 0.0]);
    assert_eq!(file.numbers(&primitive["attributes"]["TEXCOORD_0"]), [0.0, 1.0, 1.0, 1.0, 1.0, 0.25]);
    assert_eq!(file.numbers(&primitive["indices"]), [0.0, 1.0, 2.0]);
    let bounds = &json["accessors"][1];
    assert_eq!(bounds["min"], serde_json::json!([1.0, 0.0, -6.5]));
    assert_eq!(bounds["max"][1].as_f64().unwrap(), f64::from(0.3f32));

    let material = &json["materials"][primitive["material"].as_u64().unwrap() as usize];
    let [base, orm] = ["baseColorTexture", "metallicRoughnessTexture"].map(|k| &material["pbrMetallicRoughness"][k]);
    assert_eq!(&material["occlusionTexture"], orm);
    let uri = |texture: &Value| {
        let texture = &json["textures"][texture["index"].as_u64().unwrap() as usize];
        json["images"][texture["source"].as_u64().unwrap() as usize]["uri"].as_str().unwrap().to_string()
    };
    assert_eq!([uri(base), uri(orm)], ["floor/floor%20base.1001.png", "floor/floor_orm.1001.png"]);
    assert_eq!(json["samplers"][0]["wrapS"], 33071);

    let whole = &json["nodes"][json["scenes"][0]["nodes"][0].as_u64().unwrap() as usize];
    assert_eq!(whole["name"], "Hall \"A\"");
    assert_eq!((&whole["extras"]["seed"], &whole["extras"]["generator"]), (&u64::MAX.into(), &"trodden".into()));
    assert_eq!(whole["children"], serde_json::json!([0, 1]));
    assert_eq!(json["nodes"][1]["name"], "wall_tops");
    assert!(json["asset"]["generator"].as_str().unwrap().starts_with("trodden "));
}

/// Bump maps look the same in every program only with tangents in the file.
#[test]
fn surfaces_with_normals_have_tangents() {
    // A wall in the plane x = 3 that is seen from the west; its strip is turned: u grows upward, v toward the north.
    let wall = Mesh {
        surface: SceneSurface::WallSheet(0),
        positions_m: vec![[3.0, 4.0, 0.0], [3.0, 2.0, 0.0], [3.0, 2.0, 2.5]],
        normals: vec![[-1.0, 0.0, 0.0]; 3],
        uvs: vec![[0.0, 0.8], [0.0, 0.0], [1.0, 0.0]],
        indices: vec![0, 1, 2],
        faces: Vec::new(),
        light_uvs: Vec::new(),
    };
    let scene = Scene { meshes: vec![triangle(SceneSurface::FloorTile(0)), wall] };
    let bumpy = |name| SurfaceImages { normal: Some("n.png"), ..files(name, "b.png", "o.png") };
    let (floor, walls) = (vec![bumpy("floor_1001")], vec![bumpy("wall_1001")]);
    let file = parsed(&written(&scene, &SceneFile { floor, walls, ..SceneFile::default() }));
    let tangent =
        |mesh: usize| file.numbers(&file.json["meshes"][mesh]["primitives"][0]["attributes"]["TANGENT"])[..4].to_vec();
    let [along, side] = [tangent(0)[0], tangent(0)[3]];
    assert!(along > 0.99 && side == 1.0, "{:?}", tangent(0));
    assert_eq!(tangent(1), [0.0, 1.0, 0.0, -1.0]);
    assert_eq!(file.json["materials"][1]["normalTexture"]["index"], 5);
}

#[test]
fn embedded_images_are_whole_files() {
    let scene = Scene { meshes: vec![triangle(SceneSurface::WallSheet(0))] };
    let colour = RgbImage::from_fn(64, 32, |x, y| image::Rgb([x as u8 * 3, y as u8 * 7, 90]));
    let orm = RgbImage::from_fn(31, 17, |x, y| image::Rgb([255, (x * y) as u8, 0]));
    let images = SurfaceImages {
        normal: Some("n.png"),
        embedded: Some([&colour, &orm]),
        ..files("wall_1001", "b.png", "o.png")
    };
    let options = SceneFile { walls: vec![images], ..SceneFile::default() };
    let bytes = written(&scene, &options);
    assert_eq!(bytes, written(&scene, &options));
    let file = parsed(&bytes);
    let image = |k: usize| {
        let entry = &file.json["images"][k];
        assert_eq!(entry.get("uri"), None);
        let decoded = image::load_from_memory(file.view(entry["bufferView"].as_u64().unwrap())).unwrap();
        (entry["mimeType"].as_str().unwrap(), decoded.to_rgb8())
    };
    assert_eq!(image(1), ("image/png", orm.clone()));
    let (mime, decoded) = image(0);
    assert_eq!((mime, decoded.dimensions()), ("image/jpeg", (64, 32)));
    let off = decoded.iter().zip(colour.iter()).map(|(a, b)| u32::from(a.abs_diff(*b))).sum::<u32>();
    assert!(off < 3 * decoded.len() as u32, "{off}");
}

#[test]
fn indices_have_16_bits_where_that_is_enough() {
    let mut part = triangle(SceneSurface::Lintel);
    let kind = |part: &Mesh| {
        let file = parsed(&written(&Scene { meshes: vec![part.clone()] }, &SceneFile::default()));
        let primitive = &file.json["meshes"][0]["primitives"][0];
        assert_eq!(file.numbers(&primitive["indices"]), part.indices.iter().map(|&i| f64::from(i)).collect::<Vec<_>>());
        file.json["accessors"][0]["componentType"].as_u64().unwrap()
    };
    part.positions_m.resize(65_535, [0.0, 1.0, 2.0]);
    part.normals.resize(65_535, [0.0, 0.0, 1.0]);
    part.indices = vec![0, 1, 2, 65_534, 0, 2];
    assert_eq!(kind(&part), 5123);
    part.positions_m.push([0.0; 3]);
    part.normals.push([1.0, 0.0, 0.0]);
    part.indices = vec![0, 1, 2, 65_535, 0, 2];
    assert_eq!(kind(&part), 5125);
}

#[test]
fn surfaces_without_images_are_plain() {
    let parts =
        vec![triangle(SceneSurface::FloorTile(3)), triangle(SceneSurface::WallTop), triangle(SceneSurface::Lintel)];
    let wall_top = PlainMaterial { colour: [0, 255, 188], roughness: f32::NAN };
    let options = SceneFile { wall_top, ..SceneFile::default() };
    let json = parsed(&written(&Scene { meshes: parts }, &options)).json;
    assert_eq!((json.get("images"), json.get("samplers")), (None, None));
    let top = &json["materials"][1]["pbrMetallicRoughness"];
    let colour: Vec<f64> = top["baseColorFactor"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    assert!(colour[0] == 0.0 && colour[1] == 1.0 && (colour[2] - 0.5).abs() < 0.005 && colour[3] == 1.0, "{colour:?}");
    assert_eq!(top["roughnessFactor"], 1.0);
    assert_eq!(json["materials"][2]["name"], "clean_wall");
}

#[test]
fn an_empty_scene_is_a_file_too() {
    let file = parsed(&written(&Scene::default(), &SceneFile::default()));
    assert!(file.binary.is_empty());
    assert_eq!((file.json.get("meshes"), file.json.get("buffers")), (None, None));
    assert_eq!(file.json["nodes"].as_array().unwrap().len(), 1);
}
