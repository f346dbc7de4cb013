//! The same tests for walls; cost of untouched walls.

use super::*;
use crate::marks::Contact;
use crate::patterns::Cause;
use crate::stamps::fixtures::{touch, touches, wall_grid, wall_library};
use crate::stamps::{WallGrid, WallStamper};

/// All sums of a face.
fn strip(sums: &WallSums, cause: Cause, face: usize) -> Vec<u32> {
    let (width, height) = (sums.grid().faces[face].width as usize, sums.grid().height as usize);
    let mut out = vec![0; width * height];
    sums.read(cause, face, 0, 0, width, height, &mut out);
    out
}

fn all_strips(sums: &WallSums) -> Vec<Vec<u32>> {
    let faces = 0..sums.grid().faces.len();
    faces.flat_map(|face| Cause::WALL.map(|cause| strip(sums, cause, face))).collect()
}

/// A long face, a room, and a pillar with a circumference shorter than a drag.
fn walls(texels_per_metre: f64) -> WallGrid {
    wall_grid(texels_per_metre, &[(3.113, false), (2.5, true), (0.3071, true)])
}

fn stamper(grid: &WallGrid) -> WallStamper {
    WallStamper::new(&wall_library(), grid, &StampOptions::default()).unwrap()
}

fn sums_of(grid: &WallGrid, contacts: &[Contact]) -> WallSums {
    let mut sums = WallSums::new(grid.clone());
    sums.add(&stamper(grid), contacts);
    sums
}

#[test]
fn order_split_and_threads_do_not_matter_on_walls() {
    for density in [50.0, 200.0, 1000.0] {
        let grid = walls(density);
        let stamper = stamper(&grid);
        let mut contacts = touches(if density > 500.0 { 60 } else { 400 }, &grid, 3);
        let expected = all_strips(&sums_of(&grid, &contacts));
        let rng = &mut SplitMix64::new(9);
        for k in (1..contacts.len()).rev() {
            contacts.swap(k, (rng.next_u64() % (k as u64 + 1)) as usize);
        }
        for threads in 1..=8 {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut sums = WallSums::new(grid.clone());
            pool.install(|| contacts.chunks(37 * threads).for_each(|part| sums.add(&stamper, part)));
            assert!(all_strips(&sums) == expected, "{threads} threads at {density} texels/m");
        }
    }
}

#[test]
fn every_cause_has_a_sum_of_its_own() {
    let grid = walls(200.0);
    let sums = sums_of(&grid, &touches(300, &grid, 4));
    for cause in Cause::WALL {
        let touched = (0..3).any(|face| strip(&sums, cause, face).iter().any(|&v| v > 0));
        assert_eq!(touched, [Cause::Hand, Cause::Shoe].contains(&cause), "{}", cause.name());
    }
    assert!(sums.blocks(Cause::Sole).is_empty());
}

#[test]
fn wall_sums_are_the_sum_of_single_stains() {
    let grid = walls(200.0);
    let contacts = touches(80, &grid, 5);
    let mut merged = WallSums::new(grid.clone());
    for contact in &contacts {
        merged.merge(&sums_of(&grid, std::slice::from_ref(contact))).unwrap();
    }
    assert!(all_strips(&merged) == all_strips(&sums_of(&grid, &contacts)));
}

#[test]
fn sums_of_other_walls_are_not_merged() {
    let message = |other: WallGrid| WallSums::new(walls(200.0)).merge(&WallSums::new(other)).unwrap_err().to_string();
    assert_eq!(
        message(walls(100.0)),
        "sums of 3 wall faces, 2.6 m high, at 100 texels/m cannot be added to 3 wall faces, 2.6 m high, at 200 texels/m"
    );
    let longer = wall_grid(200.0, &[(3.113, false), (2.6, true), (0.3071, true)]);
    assert!(message(longer).starts_with("wall face 1 is 2.6 m long in the sums to add, and 2.5 m"));
}

#[test]
fn a_stamper_of_other_walls_adds_nothing() {
    let mut sums = WallSums::new(walls(200.0));
    sums.add(&stamper(&walls(100.0)), &[touch(1.0, 1.0)]);
    assert_eq!(sums.bytes(), 0);
}
