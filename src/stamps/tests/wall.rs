//! Tests of stains on walls against their patterns.

use proptest::prelude::*;

use super::*;
use crate::marks::Contact;
use crate::stamps::fixtures::{CLOUD, DRAG, SCUFF, touch, touches, wall_grid, wall_library};
use crate::stamps::wall_stamper::{PlacedStain, TexelRow};
use crate::sums::WallSums;

const DENSITIES: [f64; 3] = [50.0, 200.0, 1000.0];

fn stamped_on(grid: &WallGrid, options: &StampOptions, contacts: &[Contact]) -> WallSums {
    let mut sums = WallSums::new(grid.clone());
    sums.add(&WallStamper::new(&wall_library(), grid, options).unwrap(), contacts);
    sums
}

/// Densities of a face, summed over causes.
fn face(sums: &WallSums, face: usize) -> Vec<f64> {
    let (width, height) = (sums.grid().faces[face].width as usize, sums.grid().height as usize);
    let mut total = vec![0.0; width * height];
    let mut values = vec![0; width * height];
    for cause in Cause::WALL {
        sums.read(cause, face, 0, 0, width, height, &mut values);
        total.iter_mut().zip(&values).for_each(|(t, &v)| *t += f64::from(v) / f64::from(DENSITY_ONE));
    }
    total
}

/// Density times area on a face, square metres.
fn integral_of(sums: &WallSums, number: usize) -> f64 {
    let texel_m = sums.grid().texel_m();
    face(sums, number).iter().sum::<f64>() * texel_m * texel_m
}

/// Expected integral of a contact: strength times coverage of the stretched pattern, square metres.
fn amount_m2(contact: &Contact) -> f64 {
    let pattern = &wall_library().patterns[usize::from(contact.pattern)];
    let mean = pattern.coverage.iter().map(|&c| f64::from(c) / 255.0).sum::<f64>() / pattern.coverage.len() as f64;
    mean * f64::from(contact.length_m) * f64::from(contact.breadth_m) * f64::from(contact.strength)
}

fn samples() -> Vec<Contact> {
    let scuff = Contact { cause: Cause::Shoe, pattern: SCUFF, length_m: 0.08, breadth_m: 0.01, ..touch(1.0, 0.5) };
    vec![
        touch(1.01, 1.203),
        Contact { pattern: DRAG, length_m: 0.7, breadth_m: 0.09, direction_rad: -0.15, ..touch(1.0, 1.1) },
        Contact { length_m: 0.11, breadth_m: 0.21, direction_rad: 2.0, mirrored: true, ..touch(1.0, 1.1) },
        Contact { strength: 0.02, ..touch(1.0, 1.1) },
        Contact { strength: 1.7, direction_rad: 0.7, ..touch(1.0, 1.1) },
        scuff,
        Contact { direction_rad: 0.4, length_m: 0.15, breadth_m: 0.02, ..scuff },
    ]
}

#[test]
fn a_stain_amounts_to_strength_times_the_area_of_its_pattern() {
    for density in DENSITIES {
        let grid = wall_grid(density, &[(2.0, false)]);
        for contact in samples() {
            let (found, expected) = (integral_of(&stamped_on(&grid, &plain(), &[contact]), 0), amount_m2(&contact));
            assert!((found / expected - 1.0).abs() < 0.02, "{found} for {expected} at {density}: {contact:?}");
        }
    }
}

#[test]
fn blots_and_pressure_change_nothing_in_the_mean() {
    let grid = wall_grid(100.0, &[(2.0, false)]);
    for contact in samples() {
        let many: Vec<Contact> = (0..600).map(|variation| Contact { variation, ..contact }).collect();
        let found = integral_of(&stamped_on(&grid, &StampOptions::default(), &many), 0) / 600.0;
        let expected = amount_m2(&contact);
        assert!((found / expected - 1.0).abs() < 0.02, "{found} for {expected}: {contact:?}");
    }
}

/// Centroid and standard deviation of a stain along and across the strip, metres.
fn place_and_spread(sums: &WallSums) -> [[f64; 2]; 2] {
    let (texels, grid) = (face(sums, 0), sums.grid());
    let width = grid.faces[0].width as usize;
    let total: f64 = texels.iter().sum();
    let mean = |f: &dyn Fn(f64, f64) -> f64| {
        let place =
            |k: usize| (((k % width) as f64 + 0.5) * grid.texel_m(), ((k / width) as f64 + 0.5) * grid.texel_m());
        texels.iter().enumerate().map(|(k, v)| v * f(place(k).0, place(k).1)).sum::<f64>() / total
    };
    let (x, y) = (mean(&|x, _| x), mean(&|_, y| y));
    let spread = [mean(&|a, _| (a - x) * (a - x)), mean(&|_, b| (b - y) * (b - y))].map(f64::sqrt);
    [[x, y], spread]
}

#[test]
fn stains_are_stretched_turned_and_mirrored() {
    let grid = wall_grid(200.0, &[(2.0, false)]);
    let place_of = |contact: Contact| place_and_spread(&stamped_on(&grid, &plain(), &[contact]));
    let plain_touch = Contact { length_m: 0.2, breadth_m: 0.12, ..touch(1.0, 1.2) };
    let [_, [along, across]] = place_of(plain_touch);
    for (length, breadth) in [(2.0f32, 1.0f32), (1.0, 1.5), (0.6, 0.8)] {
        let stretched = Contact { length_m: 0.2 * length, breadth_m: 0.12 * breadth, ..plain_touch };
        let [_, [wide, high]] = place_of(stretched);
        assert!((wide / along / f64::from(length) - 1.0).abs() < 0.06, "{wide} {along} {length}");
        assert!((high / across / f64::from(breadth) - 1.0).abs() < 0.06, "{high} {across} {breadth}");
    }
    // The cloud is denser on its right: turned upright it is denser above.
    let [[x, y], spread] = place_of(Contact { direction_rad: std::f32::consts::FRAC_PI_2, ..plain_touch });
    let [[x0, y0], _] = place_of(plain_touch);
    assert!((y - 1.2 - (x0 - 1.0)).abs() < 0.002 && (x - 1.0).abs() < 0.004 && x0 - 1.0 > 0.008, "{x} {y} {x0} {y0}");
    assert!((spread[0] - across).abs() < 0.004 && (spread[1] - along).abs() < 0.004);
    // Row 0 of a pattern is above when it points right, and below when mirrored.
    let lopsided = |mirrored| {
        let mut library = wall_library();
        let cloud = &mut library.patterns[usize::from(CLOUD)];
        let half = cloud.coverage.len() / 2;
        cloud.coverage[half..].fill(0);
        let mut sums = WallSums::new(grid.clone());
        sums.add(&WallStamper::new(&library, &grid, &plain()).unwrap(), &[Contact { mirrored, ..plain_touch }]);
        place_and_spread(&sums)[0][1]
    };
    assert!(lopsided(false) > 1.215 && lopsided(true) < 1.185);
}

#[test]
fn drags_fade_along_their_way() {
    let grid = wall_grid(200.0, &[(2.0, false)]);
    let mut library = wall_library();
    library.patterns[usize::from(DRAG)].coverage.fill(255);
    let drag = Contact { pattern: DRAG, length_m: 0.6, breadth_m: 0.08, ..touch(1.0, 1.2) };
    let stamper = WallStamper::new(&library, &grid, &StampOptions::default()).unwrap();
    let (mut start, mut end) = (0.0, 0.0);
    for variation in 0..40 {
        let mut sums = WallSums::new(grid.clone());
        sums.add(&stamper, &[Contact { variation, ..drag }]);
        let texels = face(&sums, 0);
        let part = |from: f64, to: f64| -> f64 {
            let columns = (from * 200.0) as usize..(to * 200.0) as usize;
            texels.chunks(400).map(|row| row[columns.clone()].iter().sum::<f64>()).sum()
        };
        start += part(0.72, 0.85);
        end += part(1.15, 1.28);
    }
    assert!(end < 0.6 * start && end > 0.1 * start, "{start} {end}");
}

#[test]
fn no_two_stains_are_alike() {
    let grid = wall_grid(200.0, &[(1.0, false)]);
    let stain = |variation| {
        let contact = Contact { variation, ..touch(0.5, 1.2) };
        face(&stamped_on(&grid, &StampOptions::default(), &[contact]), 0)
    };
    for variation in 0..10 {
        let alike = correlation(&stain(variation), &stain(variation + 1));
        assert!(alike < 0.97, "{alike}");
    }
    assert_eq!(stain(3), stain(3));
}

#[test]
fn stains_are_cut_off_at_floor_and_ceiling_and_at_the_ends_of_open_faces() {
    let grid = wall_grid(200.0, &[(2.0, false), (2.0, false)]);
    let amount = |contact| integral_of(&stamped_on(&grid, &plain(), &[contact]), 0);
    let whole = amount(touch(1.0, 1.0));
    for (along_m, height_m) in [(1.0, 0.0), (1.0, 2.6), (0.0, 1.0), (2.0, 1.0)] {
        let share = amount(touch(along_m, height_m)) / whole;
        assert!((0.3..0.7).contains(&share), "{share} at {along_m}, {height_m}");
    }
    let together = amount(touch(0.0, 1.0)) + amount(touch(2.0, 1.0));
    assert!((together / whole - 1.0).abs() < 0.02, "what one end cuts off is what the other leaves");
    for gone in [touch(1.0, -0.3), touch(1.0, 2.9), touch(-0.3, 1.0), touch(2.3, 1.0)] {
        assert_eq!(amount(gone), 0.0);
    }
    assert_eq!(integral_of(&stamped_on(&grid, &plain(), &[touch(0.0, 1.0)]), 1), 0.0, "the next face is another wall");
}

/// A strip continues around corners: 2 m of wall are 2 m of strip.
#[test]
fn a_stain_runs_on_round_a_corner() {
    let floor = |k: usize| u8::from((1..29).contains(&(k % 30)) && (1..19).contains(&(k / 30)));
    let plan = crate::plan::FloorPlan::from_mask(30, 20, 0.1, (0..600).map(floor).collect());
    let walls = crate::walls::Walls::trace(&plan, &crate::walls::WallsOptions::default());
    let grid = WallGrid::covering(&walls, 2.6, 200.0).unwrap();
    assert!(walls.faces[0].closed && walls.faces[0].points_m.len() == 4);
    let side_m = walls.faces[0].points_m[0].distance(walls.faces[0].points_m[1]);
    let at_corner = stamped_on(&grid, &plain(), &[touch(side_m, 1.2)]);
    let texels = face(&at_corner, 0);
    let corner = (side_m * 200.0).round() as usize;
    let [before, after] = [corner - 20..corner, corner..corner + 20].map(|columns| -> f64 {
        texels.chunks(grid.faces[0].width as usize).map(|row| row[columns.clone()].iter().sum::<f64>()).sum()
    });
    assert!(before > 0.2 * after && after > before, "fuller on its right: {before} {after}");
    let expected = amount_m2(&touch(side_m, 1.2));
    assert!((integral_of(&at_corner, 0) / expected - 1.0).abs() < 0.02);
}

#[test]
fn on_a_closed_face_a_stain_goes_on_across_the_seam() {
    let grid = wall_grid(200.0, &[(2.0, true)]);
    let amid = face(&stamped_on(&grid, &plain(), &[touch(1.0, 1.2)]), 0);
    for along_m in [0.0, 2.0, -2.0, 40.0] {
        let across = face(&stamped_on(&grid, &plain(), &[touch(along_m, 1.2)]), 0);
        for (row, (a, b)) in across.chunks(400).zip(amid.chunks(400)).enumerate() {
            for k in 0..400 {
                let (a, b) = (a[(k + 200) % 400], b[k]);
                // Rounding may differ; the stain may not.
                assert!((a - b).abs() <= 1.01 / f64::from(DENSITY_ONE), "{a} {b} at {k}, {row}");
            }
        }
    }
    // A drag longer than the circumference of a pillar.
    let pillar = wall_grid(200.0, &[(0.25, true)]);
    let drag = Contact { pattern: DRAG, length_m: 0.6, breadth_m: 0.08, ..touch(0.1, 1.2) };
    let found = integral_of(&stamped_on(&pillar, &plain(), &[drag]), 0);
    assert!((found / amount_m2(&drag) - 1.0).abs() < 0.02);
}

/// Adds rows over the strip in pieces that differ from blocks.
fn in_other_pieces(stamper: &WallStamper, stain: &PlacedStain, width: usize, height: usize) -> Vec<u32> {
    let mut texels = vec![0u32; width * height];
    let mut buffers = TexelRow::new();
    for (j, row) in texels.chunks_mut(width).enumerate() {
        for (k, piece) in row.chunks_mut(97).enumerate() {
            stamper.add_row(stain, [97 * k as i64, j as i64], &mut buffers, piece);
        }
    }
    texels
}

#[test]
fn a_stain_that_blocks_cut_is_the_same_as_one_that_they_do_not() {
    for density in DENSITIES {
        let grid = wall_grid(density, &[(1.7, false), (1.3, true)]);
        let stamper = WallStamper::new(&wall_library(), &grid, &StampOptions::default()).unwrap();
        for contact in touches(if density > 500.0 { 6 } else { 40 }, &grid, 8) {
            let span = grid.faces[contact.face as usize];
            let (width, height) = (span.width as usize, grid.height as usize);
            let mut sums = WallSums::new(grid.clone());
            sums.add(&stamper, &[contact]);
            let (mut cut, mut whole) = (vec![0; width * height], vec![0; width * height]);
            sums.read(contact.cause, contact.face as usize, 0, 0, width, height, &mut cut);
            for stain in stamper.place(&contact) {
                let texels = in_other_pieces(&stamper, &stain, width, height);
                whole.iter_mut().zip(texels).for_each(|(sum, v)| *sum += v);
                assert!(whole.iter().all(|&v| v <= 2 * u32::from(stain.peak)));
            }
            assert!(cut == whole, "{contact:?} at {density}");
        }
    }
}

#[test]
fn a_stamper_of_floors_makes_nothing_of_wall_patterns() {
    let stamper = Stamper::new(&wall_library(), super::grid(100.0, 1.0, 1.0), &StampOptions::default()).unwrap();
    assert_eq!(stamper.printers.iter().map(Option::is_some).collect::<Vec<_>>(), [false, false, false, true]);
}

#[test]
fn contacts_without_sense_leave_nothing() {
    let grid = wall_grid(200.0, &[(2.0, false), (1.0, true)]);
    let good = touch(1.0, 1.2);
    let bad = [
        Contact { cause: Cause::Sole, ..good },
        Contact { cause: Cause::Shoe, ..good },
        Contact { cause: Cause::Sole, pattern: 3, ..good },
        Contact { pattern: 3, ..good },
        Contact { pattern: u16::MAX, ..good },
        Contact { face: 2, ..good },
        Contact { face: u32::MAX, ..good },
        Contact { along_m: f64::NAN, ..good },
        Contact { along_m: 1e300, ..good },
        Contact { face: 1, along_m: f64::INFINITY, ..good },
        Contact { height_m: f64::NEG_INFINITY, ..good },
        Contact { direction_rad: f32::NAN, ..good },
        Contact { length_m: f32::NAN, ..good },
        Contact { length_m: 0.0, ..good },
        Contact { breadth_m: -0.1, ..good },
        Contact { breadth_m: 1e9, ..good },
        Contact { strength: f32::NAN, ..good },
        Contact { strength: -1.0, ..good },
    ];
    assert_eq!(stamped_on(&grid, &StampOptions::default(), &bad).bytes(), 0);
    let odd = Contact { strength: f32::INFINITY, direction_rad: 1e30, ..good };
    let most = face(&stamped_on(&grid, &StampOptions::default(), &[odd]), 0).into_iter().fold(0.0, f64::max);
    assert!(most > 1.0 && most < 10.0, "{most}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Contacts of any values cause no panic and stay within bounds.
    #[test]
    fn no_contact_does_harm(
        numbers in prop::array::uniform2(any::<f64>()),
        extents in prop::array::uniform3(any::<f32>()),
        strength in any::<f32>(),
        sensible in prop::array::uniform3(any::<bool>()),
        (cause, pattern, face, variation) in (0usize..7, 0u16..6, 0u32..5, any::<u64>()),
        density in prop::sample::select(vec![1.0, 7.3, 40.0]),
    ) {
        let grid = wall_grid(density, &[(3.0, false), (0.9, true), (0.002, true)]);
        let kind = Contact { cause: Cause::ALL[cause], pattern, face, variation, ..touch(0.4, 1.0) };
        let [place, size, force] = sensible;
        let [along_m, height_m] = if place { [0.4, 1.0] } else { numbers };
        let [direction_rad, length_m, breadth_m] = if size { [0.3, 0.5, 0.1] } else { extents };
        let strength = if force { 0.5 } else { strength };
        let contact = Contact { along_m, height_m, direction_rad, length_m, breadth_m, strength, ..kind };
        let sums = stamped_on(&grid, &StampOptions::default(), &[contact]);
        for number in 0..3 {
            // A drag around a pillar overlaps itself many times.
            prop_assert!(face_most(&sums, number) < 16.0 * 130.0);
        }
    }
}

fn face_most(sums: &WallSums, number: usize) -> f64 {
    face(sums, number).into_iter().fold(0.0, f64::max)
}
