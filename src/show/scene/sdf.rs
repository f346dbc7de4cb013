//! A scene as a world of the Simulation Description Format (SDFormat) for Gazebo: it shows `scene.glb`, and robots run
//! into its walls.

use std::io::{self, Write};

use super::file::{Cover, SceneFile, identifier};
use super::hulls::Prism;
use super::model::{Scene, SceneSurface};
use crate::math::{Vec2, atan2};

/// How far the corners of a box may be off the square: half a millimetre for each metre.
const SQUARE: f64 = 5e-4;

/// Writes a world of SDFormat 1.9: metres, +Z up, plan (x, y) and height h at `(x, y, h)`.
///
/// It has physics at 1 kHz, a sun, and one static model: `scene.glb`, which lies beside it, an endless plane at the
/// floor's height, and `solids` as boxes or, with other outlines, as extruded polylines. Solids of floor tiles are left
/// out. The same input gives the same bytes.
///
/// Gazebo leaves the axes of glTF as they are, +Y up (gz-common, `AssimpLoader::Load`: meshes of `.glb` keep their root's
/// transform and get no other), so that the visual is turned by 90 degrees. Relative addresses start from the folder of
/// the file (gz-sim, `asFullPath`).
///
/// # Errors
/// The writer's error.
pub fn write_sdf(out: &mut impl Write, scene: &Scene, file: &SceneFile, solids: &[Prism]) -> io::Result<()> {
    let name = identifier(&file.name);
    // Names with underscores on both sides are reserved.
    let name = Some(name.trim_matches('_')).filter(|name| !name.is_empty()).unwrap_or("plan");
    write!(
        out,
        r#"<?xml version="1.0" encoding="UTF-8"?>
<!-- trodden {version}, seed {seed} -->
<sdf version="1.9">
  <world name="{name}">
    <gravity>0 0 -9.8</gravity>
    <physics name="1ms" type="ignored">
      <max_step_size>0.001</max_step_size>
      <real_time_factor>1</real_time_factor>
    </physics>
    <scene>
      <ambient>0.4 0.4 0.4 1</ambient>
      <background>0.7 0.7 0.7 1</background>
      <shadows>true</shadows>
    </scene>
    <light name="sun" type="directional">
      <cast_shadows>true</cast_shadows>
      <pose>0 0 10 0 0 0</pose>
      <diffuse>0.8 0.8 0.8 1</diffuse>
      <specular>0.2 0.2 0.2 1</specular>
      <direction>-0.3 0.2 -0.9</direction>
    </light>
    <model name="{name}">
      <static>true</static>
      <link name="link">
"#,
        version = env!("CARGO_PKG_VERSION"),
        seed = file.seed,
    )?;
    if file.hulls.is_empty() {
        write_visual(out, "scene", "")?;
    } else {
        // The hulls in `scene.glb` are not to be seen.
        for mesh in scene.meshes.iter().filter(|mesh| !mesh.indices.is_empty()) {
            let part = Cover::of(mesh.surface, file).name().to_string() + file.node_suffix;
            write_visual(out, &part, &format!("<submesh><name>{part}</name></submesh>"))?;
        }
    }
    let plane = "<plane><normal>0 0 1</normal><size>1 1</size></plane>";
    writeln!(out, "        <collision name=\"ground\"><geometry>{plane}</geometry></collision>")?;
    let solids = solids.iter().filter(|solid| !matches!(solid.surface, SceneSurface::FloorTile(_)));
    for (number, solid) in solids.enumerate() {
        write_collision(out, &format!("{}_{number}", Cover::of(solid.surface, file).name()), solid)?;
    }
    write!(out, "      </link>\n    </model>\n  </world>\n</sdf>\n")
}

/// The scene, or a part of it, turned from +Y to +Z up.
fn write_visual(out: &mut impl Write, name: &str, submesh: &str) -> io::Result<()> {
    write!(
        out,
        r#"        <visual name="{name}">
          <pose degrees="true">0 0 0 90 0 0</pose>
          <geometry><mesh><uri>scene.glb</uri>{submesh}</mesh></geometry>
        </visual>
"#
    )
}

fn write_collision(out: &mut impl Write, name: &str, solid: &Prism) -> io::Result<()> {
    let [low_m, high_m] = solid.span_m;
    let height = number(high_m - low_m);
    let (pose, shape) = match Rectangle::of(&solid.corners) {
        Some(Rectangle { centre, sides_m: [along, across], heading }) => {
            let [x, y, z, yaw] = [centre.x, centre.y, (low_m + high_m) * 0.5, heading].map(number);
            let [along, across] = [along, across].map(number);
            (format!("{x} {y} {z} 0 0 {yaw}"), format!("<box><size>{along} {across} {height}</size></box>"))
        }
        None => {
            let point = |p: &Vec2| format!("<point>{} {}</point>", number(p.x), number(p.y));
            let points: String = solid.corners.iter().map(point).collect();
            let shape = format!("<polyline>{points}<height>{height}</height></polyline>");
            (format!("0 0 {} 0 0 0", number(low_m)), shape)
        }
    };
    writeln!(out, "        <collision name=\"{name}\"><pose>{pose}</pose><geometry>{shape}</geometry></collision>")
}

/// A length or an angle, to a millionth.
fn number(value: f64) -> f64 {
    // Adding zero turns -0 into 0.
    (value * 1e6).round() / 1e6 + 0.0
}

/// A rectangle that stands at any angle.
struct Rectangle {
    centre: Vec2,
    /// Its length along the heading, and across.
    sides_m: [f64; 2],
    /// -45 to 45 degrees from +x, radians.
    heading: f64,
}

impl Rectangle {
    fn of(corners: &[Vec2]) -> Option<Rectangle> {
        let &[a, b, c, d] = corners else { return None };
        let [first, second] = [b - a, c - b];
        let [long, short] = [first.length(), second.length()];
        let square = first.dot(second).abs() <= SQUARE * long * short;
        // Opposite sides of a parallelogram are the same vector.
        let parallel = (first - (c - d)).length() <= SQUARE * long.min(short);
        if !square || !parallel {
            return None;
        }
        let centre = (a + b + c + d) * 0.25;
        let (along, sides_m) =
            if first.x.abs() >= first.y.abs() { (first, [long, short]) } else { (second, [short, long]) };
        let along = if along.x < 0.0 { -along } else { along };
        Some(Rectangle { centre, sides_m, heading: atan2(along.y, along.x) })
    }
}
