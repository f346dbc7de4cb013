//! Tests of sums: any order, split, number of threads or rectangle; zero outside the floor.

use proptest::prelude::*;

use super::*;
use crate::marks::Mark;
use crate::math::{SplitMix64, vec2};
use crate::plan::FloorPlan;
use crate::stamps::fixtures::{crowd, footfall, grid, library, room};
use crate::stamps::{StampOptions, Stamper, TexelGrid};
use crate::walls::{Walls, WallsOptions};

mod wall;

fn all(sums: &FloorSums, quantity: Quantity) -> Vec<u32> {
    let grid = sums.grid_of(quantity);
    let mut out = vec![0; grid.width as usize * grid.height as usize];
    sums.read(quantity, 0, 0, grid.width as usize, grid.height as usize, &mut out);
    out
}

fn everything(sums: &FloorSums) -> Vec<Vec<u32>> {
    Quantity::ALL.iter().map(|&q| all(sums, q)).collect()
}

#[test]
fn order_split_and_threads_do_not_matter() {
    let (library, walls, grid) = (library(), room(3.8, 2.8), grid(100.0, 4.0, 3.0));
    let stamper = Stamper::new(&library, grid, &StampOptions::default()).unwrap();
    let mut marks = crowd(3000, 4.0, 3.0, 3);
    let mut at_once = FloorSums::new(grid);
    at_once.add(&stamper, &walls, &marks);
    let expected = everything(&at_once);
    assert!(expected.iter().all(|q| q.iter().any(|&v| v > 0)));
    // Fisher-Yates shuffle.
    let rng = &mut SplitMix64::new(9);
    for k in (1..marks.len()).rev() {
        marks.swap(k, (rng.next_u64() % (k as u64 + 1)) as usize);
    }
    for threads in [1, 2, 16] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut sums = FloorSums::new(grid);
        pool.install(|| marks.chunks(307 * threads).for_each(|part| sums.add(&stamper, &walls, part)));
        assert!(everything(&sums) == expected, "{threads} threads");
    }
}

#[test]
fn sums_are_the_sum_of_single_stamps() {
    let (library, walls, grid) = (library(), room(1.8, 1.8), grid(100.0, 2.0, 2.0));
    let stamper = Stamper::new(&library, grid, &StampOptions::default()).unwrap();
    let marks = crowd(60, 2.0, 2.0, 5);
    let mut together = FloorSums::new(grid);
    together.add(&stamper, &walls, &marks);
    let mut merged = FloorSums::new(grid);
    for mark in &marks {
        let mut single = FloorSums::new(grid);
        single.add(&stamper, &walls, std::slice::from_ref(mark));
        merged.merge(&single).unwrap();
    }
    assert!(everything(&together) == everything(&merged));
    assert!(merged.merge(&FloorSums::new(TexelGrid { width: 7, ..grid })).is_err());
}

/// A stamp cut by a block's border equals an uncut one: moving it by whole texels changes nothing.
#[test]
fn blocks_leave_no_seams() {
    let (library, walls) = (library(), room(7.8, 7.8));
    let grid = grid(100.0, 8.0, 8.0);
    let stamper = Stamper::new(&library, grid, &StampOptions::default()).unwrap();
    let print_at = |i: u32, j: u32| {
        let mut sums = FloorSums::new(grid);
        // Eighths of a texel, so that moving by whole texels causes no rounding.
        let place = vec2(f64::from(i) + 0.625, f64::from(j) + 0.375) / 100.0;
        let mark = Mark { soil: 0.3, twist_rad: 0.4, smear_m: 0.01, ..footfall(place, 0.9) };
        sums.add(&stamper, &walls, &[mark]);
        let mut out = vec![0; 60 * 60];
        let mut soil = out.clone();
        sums.read(Quantity::Passes, i - 30, j - 30, 60, 60, &mut out);
        sums.read(Quantity::Soil, i - 30, j - 30, 60, 60, &mut soil);
        (out, soil)
    };
    let whole = print_at(192, 192);
    assert!(whole.0.iter().sum::<u32>() > 10_000);
    // Noise repeats every 64 texels.
    for (i, j) in [(256, 192), (256, 256), (192, 256), (384, 128)] {
        let cut = print_at(i, j);
        let differing = whole.0.iter().zip(&cut.0).filter(|(a, b)| a.abs_diff(**b) > 1).count();
        assert_eq!(differing, 0, "passes at {i}, {j}");
        let differing = whole.1.iter().zip(&cut.1).filter(|(a, b)| a.abs_diff(**b) > 2).count();
        assert_eq!(differing, 0, "soil at {i}, {j}");
    }
}

#[test]
fn nothing_falls_outside_the_floor() {
    let (library, walls) = (library(), room(3.8, 2.8));
    for density in [25.0, 100.0] {
        let grid = grid(density, 4.0, 3.0);
        let mut sums = FloorSums::new(grid);
        sums.add(&Stamper::new(&library, grid, &StampOptions::default()).unwrap(), &walls, &crowd(4000, 4.0, 3.0, 7));
        for quantity in Quantity::ALL {
            let of = sums.grid_of(quantity);
            let (width, height) = (of.width as usize, of.height as usize);
            let mut coverage = vec![0.0; width * height];
            walls.coverage(of.texels_per_metre, 0, 0, width, height, &mut coverage);
            let values = all(&sums, quantity);
            let outside = values.iter().zip(&coverage).filter(|(v, c)| **v > 0 && **c == 0.0).count();
            assert_eq!(outside, 0, "{quantity:?}");
            if matches!(quantity, Quantity::Passes | Quantity::Presence) {
                let bare = values.iter().zip(&coverage).filter(|(v, c)| **v == 0 && **c > 0.0).count();
                assert!(bare < values.len() / 50, "{quantity:?}: {bare}");
            }
        }
    }
}

/// Two rooms of 2 x 2.8 m with a wall of 2 cm between them, 50 px/m.
fn two_rooms() -> Walls {
    let (width, height) = (202, 142);
    let floor = (0..width * height)
        .map(|k| {
            let (x, y) = (k % width, k / width);
            u8::from(x > 0 && x < width - 1 && y > 0 && y < height - 1 && x != 101)
        })
        .collect();
    let plan = FloorPlan::from_mask(width as u32, height as u32, 0.02, floor);
    Walls::trace(&plan, &WallsOptions::default())
}

#[test]
fn nothing_passes_a_thin_wall() {
    let (library, walls) = (library(), two_rooms());
    let grid = grid(100.0, 4.04, 2.84);
    let mut sums = FloorSums::new(grid);
    let marks: Vec<Mark> =
        crowd(3000, 2.0, 2.8, 8).into_iter().filter(|m| m.place_m.x < 2.02 && m.place_m.x > 0.02).collect();
    sums.add(&Stamper::new(&library, grid, &StampOptions::default()).unwrap(), &walls, &marks);
    for quantity in Quantity::ALL {
        let of = sums.grid_of(quantity);
        let values = all(&sums, quantity);
        // The wall is at 2.02 to 2.04 m; a cell of 4 cm may contain both its sides.
        let first = (2.04 * of.texels_per_metre).ceil() as usize;
        let beyond: u32 = values.chunks(of.width as usize).map(|row| row[first..].iter().sum::<u32>()).sum();
        assert_eq!(beyond, 0, "{quantity:?}");
        let last = (2.02 * of.texels_per_metre) as usize - 1;
        assert!(values.chunks(of.width as usize).any(|row| row[last] > 0), "{quantity:?} does not reach the wall");
    }
}

/// Means over floor of `passes` and `presence` between two distances from a corridor's walls.
fn means(sums: &FloorSums, walls: &Walls, rows_m: [f64; 2]) -> [f64; 2] {
    [Quantity::Passes, Quantity::Presence].map(|quantity| {
        let grid = sums.grid_of(quantity);
        let (width, height) = (grid.width as usize, grid.height as usize);
        let mut coverage = vec![0.0; width * height];
        walls.coverage(grid.texels_per_metre, 0, 0, width, height, &mut coverage);
        let [from, to] = rows_m.map(|m| (m * grid.texels_per_metre).round() as usize * width);
        let values = all(sums, quantity);
        let sum: f64 =
            values[from..to].iter().zip(&coverage[from..to]).map(|(&v, &c)| f64::from(v) * f64::from(c)).sum();
        let area: f64 = coverage[from..to].iter().map(|&c| f64::from(c)).sum();
        sum / area / f64::from(quantity.one())
    })
}

#[test]
fn presence_has_the_local_mean_of_passes_also_along_walls() {
    // 12 x 3 m, closed, inner faces of the walls at 0.1 and 3.1 m.
    let (library, walls, grid) = (library(), room(12.0, 3.0), grid(100.0, 12.2, 3.2));
    let stamper = Stamper::new(&library, grid, &StampOptions::default()).unwrap();
    for turned in [0.0, 1.3] {
        let mut marks = crowd(60_000, 12.2, 3.2, 21);
        marks.retain(|m| walls.is_inside(m.place_m));
        for mark in &mut marks {
            let (sin, cos) = crate::math::sin_cos(turned + 0.1 * mark.heading.x);
            mark.heading = vec2(cos, sin);
        }
        let mut sums = FloorSums::new(grid);
        sums.add(&stamper, &walls, &marks);
        for (rows_m, within) in [([0.0, 3.2], 0.01), ([0.8, 2.4], 0.01), ([0.0, 0.8], 0.01), ([2.4, 3.2], 0.01)] {
            let [passes, presence] = means(&sums, &walls, rows_m);
            assert!(passes > 1.0);

            assert!((presence / passes - 1.0).abs() < within, "{presence} / {passes} at {rows_m:?}, turned {turned}");
        }
    }
}

#[test]
fn memory_grows_with_touched_floor_not_with_area() {
    let library = library();
    let walls = room(300.0, 2.0);
    let grid = TexelGrid { texels_per_metre: 1000.0, width: 300_200, height: 300_000 };
    let mut sums = FloorSums::new(grid);
    sums.add(
        &Stamper::new(&library, grid, &StampOptions::default()).unwrap(),
        &walls,
        &[footfall(vec2(150.0, 1.0), 0.0)],
    );
    assert!(sums.bytes() < 2 << 20, "{} bytes", sums.bytes());
    assert!(sums.touched(Quantity::Passes, 150_000, 1000, 1, 1));
    assert!(!sums.touched(Quantity::Passes, 100_000, 1000, 1000, 1000));
}

#[test]
fn sums_stay_at_their_largest_instead_of_overflowing() {
    let grid = grid(100.0, 2.0, 2.0);
    let mut sums = FloorSums::new(grid);
    for value in [60_000, 60_000, u32::MAX - 60_000, 5] {
        sums.add_block(Quantity::Passes, 3, 4, 2, 1, &[value, 1]);
    }
    let mut out = [0; 2];
    sums.read(Quantity::Passes, 3, 4, 2, 1, &mut out);
    assert_eq!(out, [u32::MAX, 4]);
}

#[test]
fn many_passes_outgrow_narrow_blocks_unnoticed() {
    let (library, walls, grid) = (library(), room(1.8, 1.8), grid(100.0, 2.0, 2.0));
    let stamper = Stamper::new(&library, grid, &StampOptions::default()).unwrap();
    let mark = footfall(vec2(1.0, 1.0), 0.3);
    let mut once = FloorSums::new(grid);
    once.add(&stamper, &walls, &[mark]);
    let mut often = FloorSums::new(grid);
    often.add(&stamper, &walls, &[mark; 700]);
    let expected: Vec<u32> = all(&once, Quantity::Passes).iter().map(|v| v * 700).collect();
    assert!(all(&often, Quantity::Passes) == expected);
    assert!(expected.iter().any(|&v| v > 65_535));
}

proptest! {
    #[test]
    fn any_rectangle_reads_the_same(i0 in 0u32..420, j0 in 0u32..320, width in 0usize..300, height in 0usize..300) {
        let grid = grid(100.0, 4.0, 3.0);
        let mut sums = FloorSums::new(grid);
        let values: Vec<u32> = (0..400 * 300).map(|k: u32| k.wrapping_mul(2_654_435_761) >> 12).collect();
        sums.add_block(Quantity::Soil, 0, 0, 400, 300, &values);
        let mut out = vec![7; width * height];
        sums.read(Quantity::Soil, i0, j0, width, height, &mut out);
        for (k, &value) in out.iter().enumerate() {
            let (i, j) = (i0 as usize + k % width, j0 as usize + k / width);
            let expected = if i < 400 && j < 300 { values[j * 400 + i] } else { 0 };
            prop_assert_eq!(value, expected);
        }
    }
}

#[test]
fn blocks_carry_all_there_is() {
    let (library, walls, grid) = (library(), room(3.8, 2.8), grid(100.0, 4.0, 3.0));
    let mut sums = FloorSums::new(grid);
    sums.add(&Stamper::new(&library, grid, &StampOptions::default()).unwrap(), &walls, &crowd(500, 4.0, 3.0, 3));
    let mut copy = FloorSums::new(grid);
    copy.merge(&sums).unwrap();
    assert!(everything(&copy) == everything(&sums));
    assert!(sums.blocks(Quantity::Passes).is_sorted_by_key(|&[i, j]| (j, i)));
}
