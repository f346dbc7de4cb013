use super::*;
use crate::export::{Atlas, BakePath, Manifest, SheetEntry, Target};
use crate::math::SplitMix64;
use crate::plan::FloorPlan;
use crate::progress::Silent;
use crate::walls::{Walls, WallsOptions};

/// A room of 6 x 4 m with a round pillar and a small one.
fn plan() -> (FloorPlan, Walls) {
    let floor = (0..60 * 40).map(|k| {
        let (x, y) = ((k % 60) as f64 - 20.0, (k / 60) as f64 - 20.0);
        let pillar = x * x + y * y < 40.0 || (x - 25.0).abs() < 2.0 && y.abs() < 2.0;
        let amid = (1..59).contains(&(k % 60)) && (1..39).contains(&(k / 60));
        u8::from(amid && !pillar)
    });
    let plan = FloorPlan::from_mask(60, 40, 0.1, floor.collect());
    let walls = Walls::trace(&plan, &WallsOptions::default());
    (plan, walls)
}

/// Sums with noise, zeros and the largest value, on all faces, up to their ends.
fn some_sums(grid: &WallGrid) -> WallSums {
    let mut sums = WallSums::new(grid.clone());
    for (face, span) in grid.faces.iter().enumerate() {
        for (number, cause) in Cause::WALL.into_iter().enumerate() {
            let mut random = SplitMix64::new((7 * face + number) as u64);
            let (width, height) = (span.width as usize, grid.height as usize / 2 + 7 * number);
            let values: Vec<u32> = (0..width * height)
                .map(|k| match (k % width / 40) % 4 {
                    0 => random.next_u64() as u32 >> 20,
                    1 => 0,
                    2 => u32::MAX - (k as u32 & 1),
                    _ => k as u32,
                })
                .collect();
            sums.add_block(cause, face, 0, 11 * number as u32, [width, height], &values);
        }
    }
    sums
}

fn everything(sums: &WallSums) -> Vec<Vec<u32>> {
    let strip = |face: usize, cause: Cause| {
        let (width, height) = (sums.grid().faces[face].width as usize, sums.grid().height as usize);
        let mut values = vec![0; width * height];
        sums.read(cause, face, 0, 0, width, height, &mut values);
        values
    };
    (0..sums.grid().faces.len()).flat_map(|face| Cause::WALL.map(|cause| strip(face, cause))).collect()
}

/// Writes sums as a bake does, without textures.
fn written(folder: &OutputFolder, sums: &WallSums, (plan, walls): &(FloorPlan, Walls), sheet_px: u32) -> Manifest {
    let atlas = Atlas::pack(sums.grid(), &walls.corners(), sheet_px, 4).unwrap();
    let entry = |(number, sheet): (usize, &Sheet)| SheetEntry {
        width_px: sheet.width,
        height_px: sheet.height,
        sums: BakePath::new(format!("sums/wall_sums.{number}.exr")).unwrap(),
        ..SheetEntry::default()
    };
    let textures = WallTextures {
        sheets: atlas.sheets.iter().enumerate().map(entry).collect(),
        atlas,
        target: Target::default(),
        bits: 8,
        dirt: false,
        layers: Vec::new(),
        reduced: Vec::new(),
        look_busy_s: 0.0,
        export_busy_s: 0.0,
    };
    write_wall_sums(folder, sums, &textures, &Silent).unwrap();
    Manifest { walls: Some(textures.entry(walls, 1000)), ..Manifest::of_plan(plan, walls, &[]) }
}

#[test]
fn sums_of_walls_come_back_to_the_bit_whatever_the_sheets() {
    let plan = plan();
    let grid = WallGrid::covering(&plan.1, 2.2, 100.0).unwrap();
    assert!(grid.faces.len() == 3);
    let sums = some_sums(&grid);
    let dir = tempfile::tempdir().unwrap();
    let mut turned = false;
    for sheet_px in [256, 700, 1000, 8192] {
        let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
        let manifest = written(&folder, &sums, &plan, sheet_px);
        turned |= manifest.walls.iter().flat_map(|w| &w.sheets).flat_map(|s| &s.strips).any(|strip| strip.turned);
        let back = read_wall_sums(folder.path(), &manifest).unwrap().unwrap();
        assert_eq!(back.grid(), &grid);
        assert!(everything(&back) == everything(&sums), "sheets of {sheet_px}");
    }
    assert!(turned, "strips that are turned are tried too");
}

#[test]
fn a_bake_without_walls_has_no_sums_of_them() {
    assert!(read_wall_sums(Path::new("/nowhere"), &Manifest::default()).unwrap().is_none());
}

#[test]
fn untouched_walls_take_no_room_on_disk() {
    let plan = plan();
    let grid = WallGrid::covering(&plan.1, 2.6, 1000.0).unwrap();
    let dir = tempfile::tempdir().unwrap();
    let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
    let manifest = written(&folder, &WallSums::new(grid), &plan, 8192);
    for sheet in manifest.walls.iter().flat_map(|walls| &walls.sheets) {
        let bytes = std::fs::metadata(folder.path().join(&sheet.sums)).unwrap().len();
        let texels = u64::from(sheet.width_px) * u64::from(sheet.height_px);
        assert!(bytes * 40 < texels, "{bytes} for {texels}");
    }
    assert_eq!(read_wall_sums(folder.path(), &manifest).unwrap().unwrap().bytes(), 0);
}

#[test]
fn a_damaged_file_of_walls_is_an_error_that_names_it() {
    let plan = plan();
    let sums = some_sums(&WallGrid::covering(&plan.1, 2.2, 50.0).unwrap());
    let dir = tempfile::tempdir().unwrap();
    let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
    let manifest = written(&folder, &sums, &plan, 512);
    let path = folder.path().join("sums/wall_sums.0.exr");
    super::super::file::assert_damage_is_named(&path, || read_wall_sums(folder.path(), &manifest).map(|_| ()));
}

/// An edit that makes a manifest invalid.
type Change<'a> = &'a dyn Fn(&mut WallsEntry);

#[test]
fn a_manifest_that_does_not_fit_its_walls_is_named() {
    let plan = plan();
    let sums = some_sums(&WallGrid::covering(&plan.1, 2.2, 50.0).unwrap());
    let dir = tempfile::tempdir().unwrap();
    let folder = OutputFolder::begin(&dir.path().join("out"), false).unwrap();
    let good = written(&folder, &sums, &plan, 512);
    let message = |change: Change| {
        let mut manifest = good.clone();
        manifest.walls.iter_mut().for_each(change);
        read_wall_sums(folder.path(), &manifest).map(|_| ()).unwrap_err().to_string()
    };
    let cases: [(Change, &str); 11] = [
        (&|walls| walls.sums_one = 256, "`walls.sums_one` is 256"),
        (&|walls| walls.texels_per_metre = f64::NAN, "NaN texels/m"),
        (&|walls| walls.height_m = 1e9, "1000000000 m high"),
        (&|walls| walls.texels_per_metre = 60.0, "`walls.sheets[0].strips[0]` does not fit"),
        (&|walls| walls.sheets[0].strips[0].face = 99, "`walls.sheets[0].strips[0]` does not fit"),
        (&|walls| walls.sheets[0].strips[0].rect_px[0] = u32::MAX, "`walls.sheets[0].strips[0]` does not fit"),
        (&|walls| walls.sheets[0].strips[0].rect_px[1] += 5000, "`walls.sheets[0].strips[0]` does not fit"),
        (&|walls| walls.sheets[0].strips[0].first_column += 1, "do not hold all of it once"),
        (&|walls| drop(walls.sheets[0].strips.pop()), "do not hold all of it once"),
        (&|walls| walls.sheets[0].width_px = 0, "`walls.sheets[0]` has no texels"),
        (&|walls| walls.sheets[0].strips[0].rect_px[0] += 3, "it holds something beside its strips"),
    ];
    for (change, expected) in cases {
        let message = message(change);
        assert!(message.contains(expected), "{message}, not {expected}");
    }
}
