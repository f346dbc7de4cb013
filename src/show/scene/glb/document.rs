//! The JSON and binary chunks of a glTF file.

use std::collections::BTreeMap;
use std::io::{self, Write};

use image::RgbImage;
use serde_json::{Value, json};

use super::picture::{self, TextureContent};
use super::views;
use crate::export::GENERATOR;
use crate::math::srgb;
use crate::show::scene::file::{Cover, PlainMaterial, SceneFile};
use crate::show::scene::model::{Mesh, Scene, bounds};

// Numbers that glTF 2.0 has for them.
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const LINEAR: u32 = 9729;
const LINEAR_MIPMAP_LINEAR: u32 = 9987;
const CLAMP_TO_EDGE: u32 = 33071;

/// The file's JSON and the source of its binary chunk, which is written part by part and never held whole.
pub(super) struct GltfDocument<'a> {
    parts: Vec<Part<'a>>,
    pictures: Vec<Vec<u8>>,
    root: Value,
    length: usize,
}

/// A mesh with its material.
struct Part<'a> {
    mesh: &'a Mesh,
    cover: Cover<'a>,
    /// The file of its normals, if the material has any.
    normal: Option<&'a str>,
    /// Of a hull: its number among those of its part, from 1. It has no material.
    hull: Option<usize>,
}

/// The lists of a document, as they grow.
#[derive(Default)]
struct Lists {
    accessors: Vec<Value>,
    buffer_views: Vec<Value>,
    cameras: Vec<Value>,
    images: Vec<Value>,
    lights: Vec<Value>,
    materials: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
    textures: Vec<Value>,
    pictures: Vec<Vec<u8>>,
    /// Bytes of the binary chunk so far; a multiple of 4.
    length: usize,
}

impl<'a> GltfDocument<'a> {
    pub fn new(scene: &'a Scene, file: &'a SceneFile) -> io::Result<GltfDocument<'a>> {
        let meshes = scene.meshes.iter().filter(|mesh| !mesh.indices.is_empty());
        let mut parts: Vec<Part> = meshes.map(|mesh| Part::of(mesh, file)).collect();
        let textured = parts.len();
        let mut numbers = BTreeMap::new();
        for mesh in &file.hulls {
            let number = numbers.entry(mesh.surface).or_insert(0usize);
            *number += 1;
            parts.push(Part { normal: None, hull: Some(*number), ..Part::of(mesh, file) });
        }
        let mut lists = Lists::default();
        for part in &parts {
            lists.add_part(part, file.node_suffix);
        }
        // Images follow the parts in the binary chunk.
        for (index, part) in parts.iter().take(textured).enumerate() {
            lists.add_material(index, part)?;
        }
        for (name, camera) in &file.cameras {
            let mut node = views::node(name, camera.position_m, [camera.heading_deg, camera.pitch_deg]);
            node["camera"] = lists.cameras.len().into();
            lists.nodes.push(node);
            lists.cameras.push(views::camera(camera, file.picture_px));
        }
        for (number, lamp) in file.lamps.iter().enumerate() {
            let light = views::light(lamp);
            let index = lists.lights.iter().position(|known| *known == light).unwrap_or(lists.lights.len());
            if index == lists.lights.len() {
                lists.lights.push(light);
            }
            let mut node = views::node(&format!("lamp_{number}"), lamp.place_m, [90.0, -90.0]);
            node["extensions"][views::LIGHTS] = json!({ "light": index });
            lists.nodes.push(node);
        }
        let extras = json!({ "generator": GENERATOR, "version": env!("CARGO_PKG_VERSION"), "seed": file.seed });
        let mut whole = json!({ "name": file.name, "extras": extras });
        if !lists.nodes.is_empty() {
            whole["children"] = (0..lists.nodes.len()).collect();
        }
        lists.nodes.push(whole);
        let root = json!({
            "asset": { "version": "2.0", "generator": concat!("trodden ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{ "name": file.name, "nodes": [lists.nodes.len() - 1] }],
        });
        let (length, pictures) = (lists.length, std::mem::take(&mut lists.pictures));
        Ok(GltfDocument { parts, pictures, root: lists.into_root(root), length })
    }

    /// The JSON chunk's bytes.
    pub fn json(&self) -> Vec<u8> {
        self.root.to_string().into_bytes()
    }

    pub fn binary_length(&self) -> usize {
        self.length
    }

    /// Writes what the lists describe, in the same order.
    pub fn write_binary(&self, out: &mut impl Write) -> io::Result<()> {
        for Part { mesh, normal, .. } in &self.parts {
            if has_short_indices(mesh) {
                let bytes: Vec<u8> = mesh.indices.iter().flat_map(|&i| (i as u16).to_le_bytes()).collect();
                write_padded(out, &bytes)?;
            } else {
                write_padded(out, &mesh.indices.iter().flat_map(|i| i.to_le_bytes()).collect::<Vec<u8>>())?;
            }
            write_floats(out, mesh.positions_m.iter().copied().map(y_up))?;
            write_floats(out, mesh.normals.iter().copied().map(y_up))?;
            write_floats(out, mesh.uvs.iter().copied())?;
            write_floats(out, mesh.light_uvs.iter().copied())?;
            if normal.is_some() {
                write_floats(out, tangents(mesh).into_iter())?;
            }
        }
        self.pictures.iter().try_for_each(|picture| write_padded(out, picture))
    }
}

impl<'a> Part<'a> {
    fn of(mesh: &'a Mesh, file: &'a SceneFile) -> Part<'a> {
        let cover = Cover::of(mesh.surface, file);
        // What is embedded is reduced, where the relief evens out.
        let normal = match &cover {
            Cover::Textured(images) if images.embedded.is_none() => images.normal,
            _ => None,
        };
        Part { mesh, cover, normal, hull: None }
    }
}

fn write_padded(out: &mut impl Write, bytes: &[u8]) -> io::Result<()> {
    out.write_all(bytes)?;
    out.write_all(&[0; 3][..bytes.len().next_multiple_of(4) - bytes.len()])
}

fn write_floats<const N: usize>(out: &mut impl Write, values: impl Iterator<Item = [f32; N]>) -> io::Result<()> {
    let bytes: Vec<u8> = values.flatten().flat_map(f32::to_le_bytes).collect();
    out.write_all(&bytes)
}

impl Lists {
    /// A view of the next bytes of the binary chunk.
    fn view(&mut self, bytes: usize, target: Option<u32>) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.length, "byteLength": bytes });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.buffer_views.push(view);
        self.length += bytes.next_multiple_of(4);
        self.buffer_views.len() - 1
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn floats<const N: usize>(&mut self, count: usize, bounds: Option<[[f32; N]; 2]>) -> usize {
        let view = self.view(count * N * 4, Some(ARRAY_BUFFER));
        let kind = format!("VEC{N}");
        let mut accessor = json!({ "bufferView": view, "componentType": FLOAT, "count": count, "type": kind });
        if let Some([least, greatest]) = bounds {
            accessor["min"] = least.to_vec().into();
            accessor["max"] = greatest.to_vec().into();
        }
        self.accessor(accessor)
    }

    /// Node and mesh of a part; its material has the part's number.
    fn add_part(&mut self, Part { mesh, cover, normal, hull }: &Part, node_suffix: &str) {
        let short = has_short_indices(mesh);
        let (kind, size) = if short { (UNSIGNED_SHORT, 2) } else { (UNSIGNED_INT, 4) };
        let view = self.view(mesh.indices.len() * size, Some(ELEMENT_ARRAY_BUFFER));
        let indices = self.accessor(
            json!({ "bufferView": view, "componentType": kind, "count": mesh.indices.len(), "type": "SCALAR" }),
        );
        let count = mesh.positions_m.len();
        let position = self.floats(count, bounds(mesh.positions_m.iter().copied().map(y_up)));
        let normals = self.floats::<3>(count, None);
        let mut attributes = json!({ "POSITION": position, "NORMAL": normals });
        if !mesh.uvs.is_empty() {
            attributes["TEXCOORD_0"] = self.floats::<2>(count, None).into();
        }
        if !mesh.light_uvs.is_empty() {
            attributes["TEXCOORD_1"] = self.floats::<2>(count, None).into();
        }
        if normal.is_some() {
            attributes["TANGENT"] = self.floats::<4>(count, None).into();
        }
        let mut primitive = json!({ "attributes": attributes, "indices": indices });
        // Unreal takes a mesh named `UCX_<render mesh>_NN` as a convex collision shape of the render mesh, which it finds
        // between the first and the last underscore (Interchange, "Import Collisions According To Mesh Name").
        let name = hull.map_or(cover.name().to_string(), |number| format!("UCX_{}_{number:02}", cover.name()));
        if hull.is_none() {
            primitive["material"] = self.meshes.len().into();
        }
        let mut node = json!({ "name": format!("{name}{node_suffix}"), "mesh": self.meshes.len() });
        if !mesh.faces.is_empty() {
            // Two lists of numbers: what Blender, Unreal and Unity keep of extras.
            let column = |k: usize| mesh.faces.iter().map(|face| face[k]).collect::<Vec<u32>>();
            node["extras"] = json!({ "wall_faces": column(0), "first_triangles": column(1) });
        }
        self.nodes.push(node);
        self.meshes.push(json!({ "name": name, "primitives": [primitive] }));
    }

    fn add_material(&mut self, index: usize, Part { cover, normal, .. }: &Part) -> io::Result<()> {
        debug_assert_eq!(index, self.materials.len());
        let material = match cover {
            Cover::Textured(images) => {
                let [colour, data] = images.embedded.map_or([None; 2], |embedded| embedded.map(Some));
                let base_color = (images.base_color, colour);
                let base_color = self.texture(&images.name, "basecolor", TextureContent::Colour, base_color)?;
                let orm = self.texture(&images.name, "orm", TextureContent::Data, (images.orm, data))?;
                let mut material = json!({
                    "name": images.name,
                    "pbrMetallicRoughness": {
                        "baseColorTexture": { "index": base_color },
                        "metallicRoughnessTexture": { "index": orm },
                        "metallicFactor": 1.0,
                        "roughnessFactor": 1.0,
                    },
                    "occlusionTexture": { "index": orm },
                });
                if let Some(file) = normal {
                    let normal = self.texture(&images.name, "normal", TextureContent::Data, (file, None))?;
                    material["normalTexture"] = json!({ "index": normal });
                }
                material
            }
            Cover::Plain(name, plain) => plain_material(name, *plain),
        };
        self.materials.push(material);
        Ok(())
    }

    fn texture(
        &mut self,
        name: &str,
        kind: &str,
        picture: TextureContent,
        (path, embedded): (&str, Option<&RgbImage>),
    ) -> io::Result<usize> {
        let image = match embedded {
            None => json!({ "name": format!("{name}_{kind}"), "uri": picture::uri(path) }),
            Some(image) => {
                let (mime, bytes) = picture.encode(image)?;
                let view = self.view(bytes.len(), None);
                self.pictures.push(bytes);
                json!({ "name": format!("{name}_{kind}"), "bufferView": view, "mimeType": mime })
            }
        };
        self.images.push(image);
        self.textures.push(json!({ "sampler": 0, "source": self.images.len() - 1 }));
        Ok(self.textures.len() - 1)
    }

    /// Adds the lists to the root; glTF allows no empty ones.
    fn into_root(self, mut root: Value) -> Value {
        if self.length > 0 {
            root["buffers"] = json!([{ "byteLength": self.length }]);
        }
        if !self.lights.is_empty() {
            root["extensionsUsed"] = json!([views::LIGHTS]);
            root["extensions"][views::LIGHTS] = json!({ "lights": self.lights });
        }
        if !self.textures.is_empty() {
            root["samplers"] = json!([{
                "magFilter": LINEAR,
                "minFilter": LINEAR_MIPMAP_LINEAR,
                "wrapS": CLAMP_TO_EDGE,
                "wrapT": CLAMP_TO_EDGE,
            }]);
        }
        let lists = [
            ("accessors", self.accessors),
            ("bufferViews", self.buffer_views),
            ("cameras", self.cameras),
            ("images", self.images),
            ("materials", self.materials),
            ("meshes", self.meshes),
            ("nodes", self.nodes),
            ("textures", self.textures),
        ];
        for (name, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
            root[name] = list.into();
        }
        root
    }
}

fn plain_material(name: &str, plain: PlainMaterial) -> Value {
    let [red, green, blue] = srgb::light_of(plain.colour);
    json!({
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [red, green, blue, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": plain.sound_roughness(),
        },
    })
}

/// Plan frame to glTF's.
fn y_up([x, y, height]: [f32; 3]) -> [f32; 3] {
    // Adding zero turns -0 into 0.
    [x, height, -y + 0.0]
}

/// Which way u grows on a part's surface, by vertex, in glTF's frame; last, the side on which v shrinks (1: as
/// normal x tangent). A vertex serves one flat piece, so that any of its triangles tells.
fn tangents(part: &Mesh) -> Vec<[f32; 4]> {
    let mut tangents = vec![[1.0, 0.0, 0.0, 1.0]; part.positions_m.len()];
    for corners in part.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|n| corners[n] as usize);
        let place = |n: usize| y_up(part.positions_m[n]);
        let [p, q] = [b, c].map(|n| [0, 1, 2].map(|k| place(n)[k] - place(a)[k]));
        let [s, t] = [b, c].map(|n| [0, 1].map(|k| part.uvs[n][k] - part.uvs[a][k]));
        let turn = s[0] * t[1] - s[1] * t[0];
        let along = [0, 1, 2].map(|k| (p[k] * t[1] - q[k] * s[1]) * turn.signum());
        let length = along.iter().map(|value| value * value).sum::<f32>().sqrt();
        if turn == 0.0 || length == 0.0 {
            continue;
        }
        let [x, y, z] = along.map(|value| value / length);
        // Triangles are counter-clockwise from their front; v grows downward.
        let side = if turn < 0.0 { 1.0 } else { -1.0 };
        for n in [a, b, c] {
            tangents[n] = [x, y, z, side];
        }
    }
    tangents
}

/// Whether 16 bits are enough for a part's indices; 65535 has a meaning of its own.
fn has_short_indices(part: &Mesh) -> bool {
    part.positions_m.len() <= usize::from(u16::MAX)
}
