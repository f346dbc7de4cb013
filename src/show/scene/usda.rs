//! A scene as Universal Scene Description, in text: meshes with UsdPreviewSurface materials and collision shapes.

use std::fmt::Display;
use std::io::{self, Write};

use super::file::{Cover, PlainMaterial, SceneFile, SurfaceImages, identifier};
use super::model::{Mesh, Scene, bounds};
use crate::export::GENERATOR;
use crate::math::srgb;

/// Writes a scene as a text file of Universal Scene Description: metres, +Z up, plan (x, y) and height h at `(x, y, h)`.
///
/// The plan's prim, which is the default one, holds a mesh for each part, and their materials. Meshes are colliders of
/// their own triangles. Textures are files beside the scene. The same input gives the same bytes.
///
/// # Errors
/// The writer's error.
pub fn write_usda(out: &mut impl Write, scene: &Scene, file: &SceneFile) -> io::Result<()> {
    let root = identifier(&file.name);
    write!(
        out,
        r#"#usda 1.0
(
    customLayerData = {{
        string generator = "{GENERATOR}"
        uint64 seed = {seed}
        string version = "{version}"
    }}
    defaultPrim = "{root}"
    metersPerUnit = 1
    upAxis = "Z"
)

def Xform "{root}" (
    displayName = "{name}"
    kind = "component"
)
{{
"#,
        seed = file.seed,
        version = env!("CARGO_PKG_VERSION"),
        name = escaped(&file.name),
    )?;
    let parts = || scene.meshes.iter().filter(|mesh| !mesh.indices.is_empty());
    for mesh in parts() {
        write_mesh(out, mesh, &root, &identifier(Cover::of(mesh.surface, file).name()))?;
    }
    writeln!(out, "    def Scope \"materials\"\n    {{")?;
    for mesh in parts() {
        let cover = Cover::of(mesh.surface, file);
        let name = identifier(cover.name());
        writeln!(out, "        def Material \"{name}\"\n        {{")?;
        let material = MaterialWriter { path: format!("/{root}/materials/{name}") };
        match cover {
            Cover::Textured(images) => material.write_textured(out, images)?,
            Cover::Plain(_, plain) => material.write_plain(out, plain)?,
        }
        writeln!(out, "        }}\n")?;
    }
    writeln!(out, "    }}\n}}")
}

fn write_mesh(out: &mut impl Write, mesh: &Mesh, root: &str, name: &str) -> io::Result<()> {
    let schemas = r#"["MaterialBindingAPI", "PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"]"#;
    writeln!(out, "    def Mesh \"{name}\" (\n        prepend apiSchemas = {schemas}\n    )\n    {{")?;
    if let Some(extent) = bounds(mesh.positions_m.iter().copied()) {
        write_list(out, "float3[] extent", extent.iter().map(tuple), "")?;
    }
    write_list(out, "int[] faceVertexCounts", mesh.indices.chunks_exact(3).map(|_| 3), "")?;
    write_list(out, "int[] faceVertexIndices", &mesh.indices, "")?;
    writeln!(out, "        rel material:binding = </{root}/materials/{name}>")?;
    let by_vertex = " (\n            interpolation = \"vertex\"\n        )";
    write_list(out, "normal3f[] normals", mesh.normals.iter().map(tuple), by_vertex)?;
    writeln!(out, "        uniform token physics:approximation = \"none\"")?;
    write_list(out, "point3f[] points", mesh.positions_m.iter().map(tuple), "")?;
    if !mesh.uvs.is_empty() {
        // Images have their origin at the lower left.
        let st = mesh.uvs.iter().map(|[u, v]| tuple(&[*u, 1.0 - v]));
        write_list(out, "texCoord2f[] primvars:st", st, by_vertex)?;
    }
    writeln!(out, "        uniform token subdivisionScheme = \"none\"\n    }}\n")
}

fn write_list<T: Display>(
    out: &mut impl Write,
    attribute: &str,
    values: impl IntoIterator<Item = T>,
    metadata: &str,
) -> io::Result<()> {
    write!(out, "        {attribute} = [")?;
    for (n, value) in values.into_iter().enumerate() {
        write!(out, "{}{value}", if n == 0 { "" } else { ", " })?;
    }
    writeln!(out, "]{metadata}")
}

fn tuple<const N: usize>(values: &[f32; N]) -> String {
    format!("({})", values.map(|value| value.to_string()).join(", "))
}

/// Writes the shaders of a material at a path.
struct MaterialWriter {
    path: String,
}

impl MaterialWriter {
    fn write_plain(&self, out: &mut impl Write, plain: PlainMaterial) -> io::Result<()> {
        let colour = format!("color3f inputs:diffuseColor = {}", tuple(&srgb::light_of(plain.colour)));
        self.write_surface(out, &[colour, format!("float inputs:roughness = {}", plain.sound_roughness())])
    }

    fn write_textured(&self, out: &mut impl Write, images: &SurfaceImages) -> io::Result<()> {
        let from = |input: &str, output: &str| format!("{input}.connect = <{}/{output}>", self.path);
        let mut inputs = vec![
            from("color3f inputs:diffuseColor", "base_color.outputs:rgb"),
            from("float inputs:metallic", "orm.outputs:b"),
            from("float inputs:occlusion", "orm.outputs:r"),
            from("float inputs:roughness", "orm.outputs:g"),
        ];
        inputs.extend(images.normal.map(|_| from("normal3f inputs:normal", "normal.outputs:rgb")));
        self.write_surface(out, &inputs)?;
        let varname = "string inputs:varname = \"st\"".to_string();
        write_shader(out, "st", "UsdPrimvarReader_float2", &[varname], &["float2 outputs:result"])?;
        self.write_texture(out, "base_color", (images.base_color, "sRGB"), &[], &["float3 outputs:rgb"])?;
        let channels = ["float outputs:r", "float outputs:g", "float outputs:b"];
        self.write_texture(out, "orm", (images.orm, "raw"), &[], &channels)?;
        if let Some(file) = images.normal {
            let range = ["float4 inputs:bias = (-1, -1, -1, 0)", "float4 inputs:scale = (2, 2, 2, 1)"];
            self.write_texture(out, "normal", (file, "raw"), &range, &["float3 outputs:rgb"])?;
        }
        Ok(())
    }

    fn write_surface(&self, out: &mut impl Write, inputs: &[String]) -> io::Result<()> {
        writeln!(out, "            token outputs:surface.connect = <{}/surface.outputs:surface>\n", self.path)?;
        write_shader(out, "surface", "UsdPreviewSurface", inputs, &["token outputs:surface"])
    }

    fn write_texture(
        &self,
        out: &mut impl Write,
        name: &str,
        (path, colour_space): (&str, &str),
        more: &[&str],
        outputs: &[&str],
    ) -> io::Result<()> {
        let inputs = [
            format!("asset inputs:file = @./{path}@"),
            format!("token inputs:sourceColorSpace = \"{colour_space}\""),
            format!("float2 inputs:st.connect = <{}/st.outputs:result>", self.path),
        ];
        let clamped = ["token inputs:wrapS = \"clamp\"", "token inputs:wrapT = \"clamp\""];
        write_shader(out, name, "UsdUVTexture", &inputs, &[&clamped, more, outputs].concat())
    }
}

fn write_shader(out: &mut impl Write, name: &str, id: &str, inputs: &[String], more: &[&str]) -> io::Result<()> {
    writeln!(out, "            def Shader \"{name}\"\n            {{")?;
    writeln!(out, "                uniform token info:id = \"{id}\"")?;
    for line in inputs.iter().map(String::as_str).chain(more.iter().copied()) {
        writeln!(out, "                {line}")?;
    }
    writeln!(out, "            }}\n")
}

/// The content of a quoted text.
fn escaped(text: &str) -> String {
    let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    text.replace('\\', "\\\\").replace('"', "\\\"")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::show::scene::SceneSurface;

    /// What other readers make of a whole bake is tests/usd/run's to say.
    #[test]
    fn names_and_directions_of_a_hard_case_are_sound() {
        let mesh = Mesh {
            surface: SceneSurface::FloorTile(0),
            positions_m: vec![[1.0, 2.0, 0.0], [4.0, 2.0, 0.0], [4.0, 6.5, 0.25]],
            normals: vec![[0.0, 0.0, 1.0]; 3],
            uvs: vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.25]],
            indices: vec![0, 1, 2],
            faces: Vec::new(),
            light_uvs: Vec::new(),
        };
        let floor = SurfaceImages {
            name: "floor_0_0".to_string(),
            base_color: "floor/b.png",
            orm: "floor/o.png",
            normal: Some("floor/n.png"),
            embedded: None,
        };
        let name = "2. Obergeschoß \"A\\B\"".to_string();
        let file = SceneFile { name, seed: u64::MAX, floor: vec![floor], ..SceneFile::default() };
        let mut bytes = Vec::new();
        write_usda(&mut bytes, &Scene { meshes: vec![mesh] }, &file).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        for wanted in [
            "uint64 seed = 18446744073709551615",
            "defaultPrim = \"_2__Obergescho___A_B_\"",
            "displayName = \"2. Obergeschoß \\\"A\\\\B\\\"\"",
            "float3[] extent = [(1, 2, 0), (4, 6.5, 0.25)]",
            "texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 0.75)]",
            "asset inputs:file = @./floor/n.png@",
        ] {
            assert!(text.contains(wanted), "{wanted} is missing in\n{text}");
        }
    }
}
