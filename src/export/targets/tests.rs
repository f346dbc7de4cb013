use std::collections::BTreeSet;

use super::*;
use crate::export::{ExportError, Manifest, OutputFolder, SheetEntry, TextureOptions, TileEntry, WallsEntry};
use crate::math::{Rect, vec2};

fn names(target: Target) -> Vec<String> {
    let udim = Number::Udim(1012);
    let image = |image| target.image_name(Covered::Floor, image, udim);
    let mut names: Vec<String> = target.images(Covered::Floor, true).map(image).collect();
    names.push(target.layers_name(Covered::Wall, 1, udim));
    names.push(target.image_name(Covered::Wall, Image::Mask(Covered::Wall), Number::Uv(12, 3)));
    names.push(target.image_name(Covered::Wall, Image::LoneMask(Covered::Wall), udim));
    names
}

#[test]
fn names_are_those_that_each_program_is_used_to() {
    let expected = [
        (
            Target::Gltf,
            "floor_basecolor.1012.png floor_mask.1012.png floor_passes.1012.png floor_wear.1012.png floor_orm.1012.png floor_normal.1012.png floor_clean.1012.png floor_dirt.1012.png wall_layers.1012.exr wall_mask_u012_v003.png wall_splash.1012.png",
        ),
        (
            Target::Blender,
            "floor_basecolor.1012.png floor_mask.1012.png floor_passes.1012.png floor_wear.1012.png floor_orm.1012.png floor_normal.1012.png floor_clean.1012.png floor_dirt.1012.png wall_layers.1012.exr wall_mask_u012_v003.png wall_splash.1012.png",
        ),
        (
            Target::Unreal,
            "T_Floor_BaseColor.1012.png T_Floor_Mask.1012.png T_Floor_Passes.1012.png T_Floor_Wear.1012.png T_Floor_ORM.1012.png T_Floor_Normal.1012.png T_Floor_Clean.1012.png T_Floor_Dirt.1012.png T_Wall_Layers2.1012.exr T_Wall_Mask_u012_v003.png T_Wall_Splash.1012.png",
        ),
        (
            Target::Unity,
            "Floor_BaseMap_1012.png Floor_DirtMask_1012.png Floor_Passes_1012.png Floor_Wear_1012.png Floor_ORM_1012.png Floor_MaskMap_1012.png Floor_Normal_1012.png Floor_Clean_1012.png Floor_Dirt_1012.png Wall_Layers2_1012.exr Wall_DirtMask_u012_v003.png Wall_Splash_1012.png",
        ),
        (
            Target::Godot,
            "floor_albedo_1012.png floor_mask_1012.png floor_passes_1012.png floor_wear_1012.png floor_orm_1012.png floor_normal_1012.png floor_clean_1012.png floor_dirt_1012.png wall_layers2_1012.exr wall_mask_u012_v003.png wall_splash_1012.png",
        ),
    ];
    for (target, expected) in expected {
        assert_eq!(names(target).join(" "), expected, "{}", target.name());
    }
}

#[test]
fn targets_are_written_as_they_are_called() {
    for target in Target::ALL {
        assert_eq!(serde_json::to_value(target).unwrap(), target.name());
    }
}

#[test]
fn unreal_takes_8192_and_the_others_16384() {
    for target in Target::ALL {
        let check = |tile| TextureOptions { tile, target, ..TextureOptions::default() }.check();
        assert!(check(8192).is_ok());
        match check(8193) {
            Err(ExportError::TileTooLargeFor { max: 8192, .. }) => assert_eq!(target, Target::Unreal),
            other => assert!(other.is_ok() && target != Target::Unreal),
        }
        assert!(matches!(check(16_385), Err(ExportError::TileSize { .. })));
        assert_eq!(TargetEntry::of(target).largest_px, if target == Target::Unreal { 8192 } else { 16_384 });
    }
}

/// A tile of 10.24 x 5.12 m, in column 1 and row 2.
const TILE: Rect = Rect { min: vec2(10.24, 10.24), max: vec2(20.48, 15.36) };

#[test]
fn three_places_of_the_plan_are_found_in_each_world_and_on_the_tile() {
    // Point of the plan, metres, its uv, and its place in each target's world at a height of 2 m.
    type Worlds = [(Target, [f64; 3]); 5];
    let places: [([f64; 2], [f64; 2], Worlds); 3] = [
        // The tile's lower-left corner: image column 0, lowest row.
        (
            [10.24, 10.24],
            [0.0, 1.0],
            [
                (Target::Gltf, [10.24, 2.0, -10.24]),
                (Target::Godot, [10.24, 2.0, -10.24]),
                (Target::Blender, [10.24, 10.24, 2.0]),
                (Target::Unreal, [1024.0, -1024.0, 200.0]),
                (Target::Unity, [-10.24, 2.0, -10.24]),
            ],
        ),
        // Its upper right.
        (
            [20.48, 15.36],
            [1.0, 0.0],
            [
                (Target::Gltf, [20.48, 2.0, -15.36]),
                (Target::Godot, [20.48, 2.0, -15.36]),
                (Target::Blender, [20.48, 15.36, 2.0]),
                (Target::Unreal, [2048.0, -1536.0, 200.0]),
                (Target::Unity, [-20.48, 2.0, -15.36]),
            ],
        ),
        // A quarter along, three quarters up.
        (
            [12.8, 14.08],
            [0.25, 0.25],
            [
                (Target::Gltf, [12.8, 2.0, -14.08]),
                (Target::Godot, [12.8, 2.0, -14.08]),
                (Target::Blender, [12.8, 14.08, 2.0]),
                (Target::Unreal, [1280.0, -1408.0, 200.0]),
                (Target::Unity, [-12.8, 2.0, -14.08]),
            ],
        ),
    ];
    for ([x, y], [right, down], worlds) in places {
        for (target, expected) in worlds {
            let entry = TargetEntry::of(target);
            let world = entry.world(vec2(x, y), 2.0);
            let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
            assert!(world.into_iter().zip(expected).all(|(a, b)| near(a, b)), "{}: {world:?}", target.name());
            let along = |axis: &String| world[["X", "Y", "Z"].iter().position(|name| name == axis).unwrap()];
            let [u, v] = WorldEntry::of(target, TILE).uv(entry.uv_axes.each_ref().map(along));
            let from_top = if entry.v_zero == "top" { v } else { 1.0 - v };
            assert!(near(u, right) && near(from_top, down), "{}: {u}, {v}", target.name());
        }
    }
}

#[test]
fn worlds_have_the_hand_that_they_say() {
    for target in Target::ALL {
        let entry = TargetEntry::of(target);
        let [a, b, c] = entry.world_from_plan;
        // The plan frame is right-handed.
        let determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        assert_eq!(determinant > 0.0, entry.handed == "right", "{}", target.name());
        let unit = entry.units_per_metre;
        assert!((determinant.abs() - unit * unit * unit).abs() < 1e-6);
        let up = ["X", "Y", "Z"].iter().position(|name| *name == entry.up).unwrap();
        assert_eq!(entry.world_from_plan[up][2], entry.units_per_metre, "{}", target.name());
        assert!(entry.normals.starts_with("green points "));
    }
}

fn manifest(target: Target) -> Manifest {
    let layers = vec!["floor/l1.exr".to_string(), "floor/l2.exr".to_string()];
    let tile = TileEntry {
        basecolor: "floor/b.png".to_string(),
        mask: "floor/m.png".to_string(),
        passes: "floor/p.png".to_string(),
        orm: "floor/o.png".to_string(),
        layers,
        world: Some(WorldEntry::of(target, TILE)),
        ..TileEntry::default()
    };
    let sheet = SheetEntry {
        basecolor: "walls/b.png".to_string(),
        mask: "walls/m.png".to_string(),
        splash: "walls/s.png".to_string(),
        orm: "walls/o.png".to_string(),
        ..SheetEntry::default()
    };
    let mut manifest = Manifest { target: TargetEntry::of(target), ..Manifest::default() };
    manifest.floor.tiles = vec![tile];
    manifest.walls = Some(WallsEntry { sheets: vec![sheet], ..WallsEntry::default() });
    manifest
}

/// Writes the files that a target adds to a bake.
fn written(target: Target) -> (tempfile::TempDir, OutputFolder, BTreeSet<String>) {
    let dir = tempfile::tempdir().unwrap();
    let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
    write_target_files(&folder, &manifest(target)).unwrap();
    let mut found = BTreeSet::new();
    let mut open = vec![folder.path().to_path_buf()];
    while let Some(at) = open.pop() {
        for entry in std::fs::read_dir(at).unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => open.push(path),
                false => drop(found.insert(path.strip_prefix(folder.path()).unwrap().display().to_string())),
            }
        }
    }
    found.remove(".unfinished");
    (dir, folder, found)
}

#[test]
fn each_target_gets_its_shader_and_what_sets_the_flags() {
    let files = |target| written(target).2.into_iter().collect::<Vec<_>>().join(" ");
    assert_eq!(files(Target::Gltf), "shaders/trodden_masks.glsl");
    assert_eq!(files(Target::Blender), "shaders/trodden_blender.py");
    assert_eq!(
        files(Target::Unreal),
        "shaders/trodden_dirt.hlsl shaders/trodden_mix.hlsl shaders/trodden_unreal.py shaders/trodden_wall.hlsl"
    );
    assert_eq!(files(Target::Unity), "shaders/Editor/TroddenImporter.cs shaders/TroddenDirt.hlsl");
    let godot = "floor/b.png.import floor/l1.exr.import floor/l2.exr.import floor/m.png.import floor/o.png.import \
                 floor/p.png.import preview/.gdignore shaders/trodden_floor.gdshader shaders/trodden_setup.gd shaders/trodden_wall.gdshader \
                 sums/.gdignore walls/b.png.import walls/m.png.import walls/o.png.import walls/s.png.import";
    assert_eq!(files(Target::Godot), godot);
}

#[test]
fn import_settings_of_godot_leave_size_and_alpha_as_they_are() {
    let (_dir, folder, _) = written(Target::Godot);
    let text = std::fs::read_to_string(folder.path().join("floor/m.png.import")).unwrap();
    for line in ["process/size_limit=0", "process/fix_alpha_border=false", "mipmaps/generate=true", "compress/mode=2"] {
        assert!(text.lines().any(|l| l == line), "{line}");
    }
    let layers = std::fs::read_to_string(folder.path().join("floor/l1.exr.import")).unwrap();
    assert!(layers.contains("compress/mode=3"));
}

/// Unity's script finds textures by their names.
#[test]
fn the_names_that_unitys_importer_looks_for_are_those_that_are_written() {
    let (_dir, folder, _) = written(Target::Unity);
    let text = std::fs::read_to_string(folder.path().join("shaders/Editor/TroddenImporter.cs")).unwrap();
    let kinds = text.split("(BaseMap|").nth(1).unwrap().split(')').next().unwrap();
    let kinds: Vec<&str> = std::iter::once("BaseMap").chain(kinds.split('|')).collect();
    for name in names(Target::Unity) {
        let kind = name.split('_').nth(1).unwrap().trim_end_matches(|c: char| c.is_ascii_digit());
        assert!(kinds.iter().any(|known| known.trim_end_matches(r"\d+") == kind), "{kind} of {kinds:?}");
    }
}

#[test]
fn python_scripts_compile() {
    for (target, script) in [(Target::Blender, "trodden_blender.py"), (Target::Unreal, "trodden_unreal.py")] {
        let (_dir, folder, _) = written(target);
        let mut python = std::process::Command::new("python3");
        let check = "import ast, sys; ast.parse(open(sys.argv[1], encoding='utf-8').read())";
        let output = match python.args(["-c", check]).arg(folder.path().join("shaders").join(script)).output() {
            Ok(output) => output,
            Err(_) => return eprintln!("skipped: there is no python3 here"),
        };
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}
