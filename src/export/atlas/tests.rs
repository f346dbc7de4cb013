use proptest::prelude::*;

use super::*;
use crate::math::{SplitMix64, Vec2};
use crate::stamps::FaceSpan;

fn grid(texels_per_metre: f64, height_m: f64, lengths_m: &[f64]) -> WallGrid {
    let texels = |metres: f64| (metres * texels_per_metre - 1e-6).ceil().max(1.0) as u32;
    let span = |&length_m: &f64| FaceSpan { width: texels(length_m), length_m, closed: length_m > 8.0 };
    WallGrid { texels_per_metre, height_m, height: texels(height_m), faces: lengths_m.iter().map(span).collect() }
}

fn corner(face: usize, along_m: f64) -> Corner {
    Corner { face, along_m, point_m: Vec2::default(), turn_rad: 1.5 }
}

fn fourth(x: f64) -> f64 {
    x * x * x * x
}

/// Lengths and corners of faces as in real plans: longest first, a corner every few metres.
fn plan(seed: u64, count: usize, longest_m: f64) -> (Vec<f64>, Vec<Corner>) {
    let mut random = SplitMix64::new(seed);
    let mut unit = || f64::from(random.unit());
    // Many short ones, few long ones.
    let mut lengths: Vec<f64> = (0..count).map(|_| 0.1 + longest_m * fourth(unit())).collect();
    lengths.sort_by(|a, b| b.total_cmp(a));
    let mut corners = Vec::new();
    for (face, &length) in lengths.iter().enumerate() {
        let mut along = 5.0 * unit();
        while along < length {
            corners.push(corner(face, along));
            along += 0.1 + 10.0 * unit() * unit();
        }
    }
    (lengths, corners)
}

/// Checks the invariants of every atlas.
fn check(atlas: &Atlas, grid: &WallGrid, corners: &[Corner], side: u32) {
    let padding = atlas.padding_px;
    let mut by_face: Vec<Vec<&Strip>> = vec![Vec::new(); grid.faces.len()];
    for (index, sheet) in atlas.sheets.iter().enumerate() {
        let last = index + 1 == atlas.sheets.len();
        assert!(!sheet.strips.is_empty());
        if last {
            assert!(sheet.width <= side && sheet.height <= side);
            let fits = |extent: u32| extent.is_power_of_two() || extent == side;
            assert!(fits(sheet.width) && fits(sheet.height), "{} x {}", sheet.width, sheet.height);
        } else {
            assert_eq!((sheet.width, sheet.height), (side, side));
        }
        no_overlap(sheet, padding);
    }
    for (_, strip) in atlas.strips() {
        assert_eq!(strip.height, grid.height);
        by_face[strip.face].push(strip);
    }
    for (face, (mut strips, span)) in by_face.into_iter().zip(&grid.faces).enumerate() {
        strips.sort_by_key(|strip| strip.i0);
        assert_eq!((strips[0].i0, strips[0].from_m), (0, 0.0));
        let end = strips[strips.len() - 1];
        assert_eq!((end.i0 + end.width, end.to_m), (span.width, span.length_m));
        for pair in strips.windows(2) {
            assert_eq!(pair[0].i0 + pair[0].width, pair[1].i0, "columns exactly once");
            assert_eq!(pair[0].to_m, pair[1].from_m, "metres exactly once");
            let (cut, column) = (pair[0].to_m, f64::from(pair[1].i0));
            let at_corner = corners.iter().any(|c| c.face == face && c.along_m == cut);
            assert!(at_corner || (cut * grid.texels_per_metre - column).abs() < 1e-6);
            assert!((cut * grid.texels_per_metre - column).abs() <= 0.5 + 1e-9);
        }
    }
}

fn no_overlap(sheet: &Sheet, padding: u32) {
    // Sweep over the padded rectangles by their left sides.
    let padded = |s: &Strip| {
        let [width, height] = s.size();
        let (left, below) = (s.x.checked_sub(padding).unwrap(), s.y.checked_sub(padding).unwrap());
        [left, below, s.x + width + padding, s.y + height + padding]
    };
    let mut all: Vec<[u32; 4]> = sheet.strips.iter().map(padded).collect();
    all.sort_unstable_by_key(|r| (r[1], r[0]));
    for (k, a) in all.iter().enumerate() {
        assert!(a[2] <= sheet.width && a[3] <= sheet.height, "{a:?} in {} x {}", sheet.width, sheet.height);
        for b in all[k + 1..].iter().take_while(|b| b[1] < a[3]) {
            assert!(a[2] <= b[0] || b[2] <= a[0], "{a:?} and {b:?}");
        }
    }
}

/// A row that lacked less than a strip's padding counted as full: 0.848 of a sheet was covered.
#[test]
fn rows_that_lack_less_than_a_padding_are_filled() {
    let (lengths, corners) = plan(10_152_642_895_237_265_349, 136, 127.195_036_246_753_62);
    let grid = grid(921.046_449_747_223_8, 2.922_582_811_393_547, &lengths);
    let atlas = Atlas::pack(&grid, &corners, 8192, 16).unwrap();
    check(&atlas, &grid, &corners, 8192);
    assert!(atlas.sheets.iter().rev().skip(1).all(|sheet| sheet.filled(16) >= 0.85));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 256, ..ProptestConfig::default() })]

    #[test]
    fn any_walls_are_laid_once_without_overlap_and_fill_full_sheets(
        seed in any::<u64>(),
        count in 1usize..300,
        longest_m in 1.0..150.0,
        height_m in 2.1..3.5,
        texels_per_metre in 50.0..1000.0,
    ) {
        let (lengths, corners) = plan(seed, count, longest_m);
        let grid = grid(texels_per_metre, height_m, &lengths);
        let atlas = Atlas::pack(&grid, &corners, 8192, 16).unwrap();
        check(&atlas, &grid, &corners, 8192);
        for sheet in atlas.sheets.iter().rev().skip(1) {
            prop_assert!(sheet.filled(16) >= 0.85, "{} filled", sheet.filled(16));
        }
    }

    #[test]
    fn any_size_of_sheet_and_padding_works_or_says_why(
        seed in any::<u64>(),
        side in prop_oneof![64u32..16_385, Just(1024), Just(4096)],
        padding in 0u32..64,
        texels_per_metre in 1.0..1000.0,
    ) {
        let (lengths, corners) = plan(seed, 40, 60.0);
        let grid = grid(texels_per_metre, 2.6, &lengths);
        match Atlas::pack(&grid, &corners, side, padding) {
            Ok(atlas) => check(&atlas, &grid, &corners, side),
            Err(error) => {
                prop_assert!(grid.height + 2 * padding > side);
                prop_assert!(error.hint().unwrap().contains("texture.tile"));
            }
        }
    }
}

#[test]
fn walls_that_fit_in_a_row_stay_whole_and_longer_ones_end_at_corners() {
    // 200 texels/m: a row holds 40.8 m.
    let lengths = [95.0, 39.0, 20.0, 12.0, 3.0, 1.0];
    let corners = [corner(0, 10.0), corner(0, 39.123), corner(0, 78.5), corner(1, 20.0)];
    let grid = grid(200.0, 2.6, &lengths);
    let atlas = Atlas::pack(&grid, &corners, 8192, 16).unwrap();
    check(&atlas, &grid, &corners, 8192);
    let ends: Vec<(usize, f64)> = atlas.strips().map(|(_, strip)| (strip.face, strip.to_m)).collect();
    assert_eq!(ends.iter().filter(|(face, _)| *face == 0).count(), 3);
    assert!(ends.contains(&(0, 39.123)) && ends.contains(&(0, 78.5)));
    assert_eq!(ends.iter().filter(|(face, _)| *face == 1).count(), 1);
    assert!(atlas.strips().all(|(_, strip)| !strip.turned));
    assert_eq!((atlas.sheets[0].width, atlas.sheets[0].height), (8192, 4096));
}

#[test]
fn a_wall_without_a_corner_in_reach_ends_where_the_row_does() {
    let grid = grid(200.0, 2.6, &[60.0]);
    let corners = [corner(0, 10.0)];
    let atlas = Atlas::pack(&grid, &corners, 8192, 16).unwrap();
    check(&atlas, &grid, &corners, 8192);
    let strips: Vec<_> = atlas.strips().map(|(_, strip)| (strip.i0, strip.width, strip.y)).collect();
    assert_eq!(strips, [(0, 8160, 16), (8160, 3840, 16 + 552)]);
    assert_eq!(atlas.strips().next().unwrap().1.to_m, 40.8);
}

#[test]
fn walls_that_would_waste_sheets_are_broken() {
    // Each fills 61 % of a row.
    let grid = grid(200.0, 2.6, &[25.0; 100]);
    for corners in [Vec::new(), (0..100).map(|face| corner(face, 15.5)).collect()] {
        let atlas = Atlas::pack(&grid, &corners, 8192, 16).unwrap();
        check(&atlas, &grid, &corners, 8192);
        assert!(atlas.sheets[..atlas.sheets.len() - 1].iter().all(|sheet| sheet.filled(16) >= 0.85));
        let pieces = atlas.strips().count();
        assert!((101..160).contains(&pieces), "{pieces} pieces");
        if !corners.is_empty() {
            assert!(atlas.strips().all(|(_, strip)| [15.5, 25.0].contains(&strip.to_m)));
        }
    }
}

#[test]
fn texture_coordinates_lead_to_the_texels_whether_turned_or_not() {
    // 2832 rows a strip: two rows and two columns of turned strips.
    let (lengths, corners) = plan(5, 200, 30.0);
    let grid = grid(1000.0, 2.8, &lengths);
    let atlas = Atlas::pack(&grid, &corners, 8192, 16).unwrap();
    check(&atlas, &grid, &corners, 8192);
    let mut turned = 0;
    for (index, strip) in atlas.strips() {
        let sheet = &atlas.sheets[index];
        for (i, j) in [(0, 0), (strip.width - 1, 0), (strip.width / 2, 700), (strip.width - 1, strip.height - 1)] {
            let along_m = (f64::from(strip.i0 + i) + 0.5) / 1000.0;
            let [u, v] = atlas.uv(index, strip, along_m, (f64::from(j) + 0.5) / 1000.0);
            let [x, y] = strip.texel(i, j);
            assert!((u * f64::from(sheet.width) - f64::from(x) - 0.5).abs() < 1e-6);
            assert!(((1.0 - v) * f64::from(sheet.height) - f64::from(y) - 0.5).abs() < 1e-6);
        }
        turned += usize::from(strip.turned);
    }
    assert!(turned > 10, "{turned} turned");
}

#[test]
fn a_hundred_thousand_tiny_walls_are_laid() {
    let mut random = SplitMix64::new(1);
    let mut lengths: Vec<f64> = (0..100_000).map(|_| 0.01 + 0.4 * f64::from(random.unit())).collect();
    lengths.sort_by(|a, b| b.total_cmp(a));
    let grid = grid(200.0, 2.6, &lengths);
    let atlas = Atlas::pack(&grid, &[], 8192, 16).unwrap();
    check(&atlas, &grid, &[], 8192);
    assert_eq!(atlas.strips().count(), 100_000);
}

#[test]
fn corners_that_make_no_sense_and_no_walls_at_all_do_no_harm() {
    let grid = grid(200.0, 2.6, &[100.0, 1.0]);
    let odd = [f64::NAN, f64::INFINITY, -5.0, 0.0, 100.0, 1e300].map(|along_m| corner(0, along_m));
    let corners = [&odd[..], &[corner(7, 1.0)]].concat();
    check(&Atlas::pack(&grid, &corners, 8192, 16).unwrap(), &grid, &corners, 8192);
    let none = WallGrid { faces: Vec::new(), ..grid };
    assert!(Atlas::pack(&none, &[], 8192, 16).unwrap().sheets.is_empty());
}

#[test]
fn a_sheet_too_small_for_a_strip_is_an_error_that_says_what_would_do() {
    let grid = grid(200.0, 2.6, &[4.0]);
    let error = Atlas::pack(&grid, &[], 64, 16).unwrap_err();
    assert!(error.to_string().contains("552 px"), "{error}");
    assert!(error.hint().unwrap().contains("1024"));
    assert!(matches!(Atlas::pack(&grid, &[], 63, 16), Err(ExportError::TileSize { .. })));
    assert!(Atlas::pack(&grid, &[], 552, 16).is_ok());
    assert!(Atlas::pack(&grid, &[], 16_384, u32::MAX).is_err());
}
