//! Tests of prints against the naive reference and their patterns.

use super::fixtures::{footfall, grid, library, room};
use super::variation::HeelVariation;
use super::*;
use crate::marks::Mark;
use crate::math::{SplitMix64, Vec2, vec2};
use crate::patterns::{Cause, PatternLibrary};
use crate::sums::{FloorSums, Quantity};

mod wall;

/// Options without variation, so that prints differ only by pose.
fn plain() -> StampOptions {
    StampOptions { partial: 0.0, pressure: 0.0, blur_m: [0.0, 0.0], noise: 0.0, ..StampOptions::default() }
}

fn stamped(library: &PatternLibrary, grid: TexelGrid, options: &StampOptions, marks: &[Mark]) -> FloorSums {
    let mut sums = FloorSums::new(grid);
    sums.add(&Stamper::new(library, grid, options).unwrap(), &room(8.0, 8.0), marks);
    sums
}

fn all(sums: &FloorSums, quantity: Quantity) -> Vec<f64> {
    let grid = sums.grid_of(quantity);
    let mut out = vec![0; grid.width as usize * grid.height as usize];
    sums.read(quantity, 0, 0, grid.width as usize, grid.height as usize, &mut out);
    out.iter().map(|&v| f64::from(v) / f64::from(quantity.one())).collect()
}

fn integral(sums: &FloorSums, quantity: Quantity) -> f64 {
    let texel_m = sums.grid_of(quantity).texel_m();
    all(sums, quantity).iter().sum::<f64>() * texel_m * texel_m
}

/// Integral of a pattern's coverage, square metres, scaled to another length.
fn mass_m2(library: &PatternLibrary, mark: &Mark) -> f64 {
    let pattern = &library.patterns[usize::from(mark.pattern)];
    let scale = f64::from(mark.length_m) / (pattern.length_cm / 100.0);
    pattern.coverage.iter().map(|&c| f64::from(c) / 255.0).sum::<f64>() * 1e-6 * scale * scale
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (ma, mb) = (mean(a), mean(b));
    let product =
        |x: &[f64], mx: f64, y: &[f64], my: f64| x.iter().zip(y).map(|(p, q)| (p - mx) * (q - my)).sum::<f64>();
    product(a, ma, b, mb) / (product(a, ma, a, ma) * product(b, mb, b, mb)).sqrt()
}

/// Reference coverage over the whole grid.
fn reference(library: &PatternLibrary, mark: &Mark, grid: TexelGrid) -> Vec<f64> {
    let image = stamp_reference(&library.patterns[usize::from(mark.pattern)], mark, grid);
    let mut out = vec![0.0; grid.width as usize * grid.height as usize];
    for (k, &coverage) in image.coverage.iter().enumerate() {
        let (i, j) = (image.i0 + (k % image.width) as i64, image.j0 + (k / image.width) as i64);
        out[j as usize * grid.width as usize + i as usize] = coverage;
    }
    out
}

/// Footfalls at odd positions, angles and sizes, left and right.
fn odd_footfalls(count: usize) -> Vec<Mark> {
    let rng = &mut SplitMix64::new(11);
    let mut draw = |low: f32, high: f32| f64::from(rng.range(low, high));
    (0..count)
        .map(|k| {
            let mark = footfall(vec2(draw(0.6, 0.7), draw(0.6, 0.7)), draw(-3.2, 3.2));
            Mark { mirrored: k % 2 == 0, length_m: draw(0.2, 0.33) as f32, ..mark }
        })
        .collect()
}

#[test]
fn prints_lie_where_the_reference_puts_them() {
    let library = PatternLibrary::built_in();
    for (density, least) in [(100.0, 0.95), (400.0, 0.95), (1000.0, 0.97)] {
        let grid = grid(density, 1.3, 1.3);
        let stamper = Stamper::new(&library, grid, &plain()).unwrap();
        let count = if density > 500.0 { 2 } else { 10 };
        for (k, mark) in odd_footfalls(count).into_iter().enumerate() {
            let mark = Mark { pattern: k as u16, soil: 1.0, ..mark };
            let mut sums = FloorSums::new(grid);
            sums.add(&stamper, &room(8.0, 8.0), &[mark]);
            let agreement = correlation(&all(&sums, Quantity::Passes), &reference(&library, &mark, grid));
            assert!(agreement > least, "pattern {k} at {density}: {agreement}");
        }
    }
}

#[test]
fn a_print_at_400_texels_per_metre_shows_its_pattern() {
    let library = PatternLibrary::built_in();
    let soles: Vec<usize> = (0..library.patterns.len()).filter(|&k| library.patterns[k].cause == Cause::Sole).collect();
    let grid = grid(400.0, 1.3, 1.3);
    let stamper = Stamper::new(&library, grid, &plain()).unwrap();
    for &worn in &soles {
        let mark = Mark { pattern: worn as u16, soil: 0.5, ..footfall(vec2(0.6513, 0.6487), 0.7) };
        let mut sums = FloorSums::new(grid);
        sums.add(&stamper, &room(8.0, 8.0), &[mark]);
        let print = all(&sums, Quantity::Passes);
        let likeness: Vec<f64> = soles
            .iter()
            .map(|&k| correlation(&print, &reference(&library, &Mark { pattern: k as u16, ..mark }, grid)))
            .collect();
        let best = (0..soles.len()).max_by(|&a, &b| likeness[a].total_cmp(&likeness[b])).unwrap();
        assert_eq!(soles[best], worn, "{likeness:?}");
        assert!(likeness[best] > 0.9, "{}: {}", library.patterns[worn].name, likeness[best]);
    }
}

#[test]
fn passes_amount_to_the_same_at_any_density() {
    let library = library();
    for density in [25.0, 100.0, 400.0] {
        for mark in odd_footfalls(12) {
            for options in [plain(), StampOptions { noise: 0.0, ..StampOptions::default() }] {
                let sums = stamped(&library, grid(density, 1.3, 1.3), &options, &[mark]);
                let share = integral(&sums, Quantity::Passes) / mass_m2(&library, &mark);
                assert!((share - 1.0).abs() < 0.01, "{share} at {density}");
            }
        }
    }
}

#[test]
fn presence_amounts_to_what_passes_do() {
    let library = library();
    for density in [10.0, 25.0, 100.0, 400.0] {
        let mark = footfall(vec2(2.03, 2.01), 0.4);
        let sums = stamped(&library, grid(density, 4.0, 4.0), &plain(), &[mark]);
        let share = integral(&sums, Quantity::Presence) / mass_m2(&library, &mark);
        assert!((share - 1.0).abs() < 0.005, "{share} at {density}");
    }
}

#[test]
fn smear_draws_the_heel_forward_and_loses_nothing() {
    let library = library();
    let grid = grid(400.0, 1.3, 1.3);
    let mark = footfall(vec2(0.65, 0.65), 0.0);
    let slipped = Mark { smear_m: 0.03, ..mark };
    let [still, drawn] = [mark, slipped].map(|m| stamped(&library, grid, &plain(), &[m]));
    let share = integral(&drawn, Quantity::Passes) / integral(&still, Quantity::Passes);
    assert!((share - 1.0).abs() < 0.01, "{share}");
    let columns = |sums: &FloorSums, from_m: f64, to_m: f64| -> f64 {
        let texels = all(sums, Quantity::Passes);
        let column = |m: f64| ((0.65 + m) * 400.0) as usize;
        (0..grid.height as usize)
            .map(|j| texels[j * grid.width as usize..][column(from_m)..column(to_m)].iter().sum::<f64>())
            .sum()
    };
    // The heel's ellipse ends 6 cm behind the middle; the ball begins 4.5 cm behind it.
    assert!(columns(&drawn, -0.0575, -0.0475) > columns(&still, -0.0575, -0.0475) + 20.0);
    assert!(columns(&drawn, -0.16, -0.10) < columns(&still, -0.16, -0.10));
    assert!((columns(&drawn, 0.0, 0.2) / columns(&still, 0.0, 0.2) - 1.0).abs() < 1e-3);
}

#[test]
fn soil_prints_differ_and_leave_about_their_load() {
    let library = library();
    let grid = grid(100.0, 1.3, 1.3);
    let stamper = Stamper::new(&library, grid, &StampOptions::default()).unwrap();
    let mut kept: Vec<Vec<f64>> = Vec::new();
    let mut total = 0.0;
    for k in 0..60 {
        let mark = Mark { soil: 0.2, variation: k, ..footfall(vec2(0.65, 0.65), 0.3) };
        let mut sums = FloorSums::new(grid);
        sums.add(&stamper, &room(8.0, 8.0), &[mark]);
        total += integral(&sums, Quantity::Soil) / mass_m2(&library, &mark) / 0.2 / 60.0;
        kept.push(all(&sums, Quantity::Soil));
    }
    assert!(total > 0.5 && total < 1.0, "{total}");
    let alike: f64 = kept.windows(2).map(|w| correlation(&w[0], &w[1])).sum::<f64>() / 59.0;
    assert!(alike > 0.3 && alike < 0.9, "{alike}");
}

#[test]
fn soil_fades_in_proportion_below_the_unit_of_the_sums() {
    let library = library();
    let grid = grid(100.0, 1.3, 1.3);
    let stamper = Stamper::new(&library, grid, &StampOptions::default()).unwrap();
    let leaves = |soil: f32| {
        let marks: Vec<Mark> =
            (0..200).map(|k| Mark { soil, variation: k, ..footfall(vec2(0.65, 0.65), f64::from(k as u32)) }).collect();
        let mut sums = FloorSums::new(grid);
        sums.add(&stamper, &room(8.0, 8.0), &marks);
        integral(&sums, Quantity::Soil)
    };
    let (strong, faint) = (leaves(0.02), leaves(0.02 / 200.0));
    assert!((strong / faint / 200.0 - 1.0).abs() < 0.02, "{}", strong / faint);
}

#[test]
fn heel_marks_thinner_than_a_texel_keep_their_density() {
    let library = library();
    let amounts = [25.0, 100.0, 400.0].map(|density| {
        let grid = grid(density, 1.3, 1.3);
        let stamper = Stamper::new(&library, grid, &plain()).unwrap();
        let mut total = 0.0;
        for k in 0..40 {
            let place = vec2(0.6 + 0.0013 * f64::from(k as u32), 0.65);
            let mark = Mark {
                cause: Cause::Heel,
                pattern: 1,
                length_m: 0.07,
                strength: 0.6,
                variation: k,
                ..footfall(place, f64::from(k as u32))
            };
            let mut sums = FloorSums::new(grid);
            sums.add(&stamper, &room(8.0, 8.0), &[mark]);
            total += integral(&sums, Quantity::Scuff) / 40.0;
        }
        total
    });
    // Each mark has the length it states and the width of its variation.
    let wide = (0..40).map(|k| f64::from(HeelVariation::new(k).width)).sum::<f64>() / 40.0;
    let drawn = mass_m2(&library, &Mark { pattern: 1, length_m: 0.06, ..footfall(Vec2::ZERO, 0.0) });
    let expected = 0.6 * drawn * 0.07 / 0.06 * wide;
    for amount in amounts {
        assert!((amount / amounts[2] - 1.0).abs() < 0.02, "{amounts:?}");
        assert!((amount / expected - 1.0).abs() < 0.1, "{amounts:?} against {expected}");
    }
}

#[test]
fn a_twist_turns_the_ball_and_leaves_the_heel() {
    let library = library();
    let grid = grid(400.0, 1.3, 1.3);
    let mark = Mark { soil: 0.5, ..footfall(vec2(0.65, 0.65), 0.0) };
    let twisted = Mark { twist_rad: 0.5, ..mark };
    let [still, turned] = [mark, twisted].map(|m| all(&stamped(&library, grid, &plain(), &[m]), Quantity::Soil));
    let half = grid.width as usize / 2;
    let part = |texels: &[f64], ball: bool| -> Vec<f64> {
        texels
            .chunks(grid.width as usize)
            .flat_map(|r| if ball { r[half + 10..].to_vec() } else { r[..half - 30].to_vec() })
            .collect()
    };
    assert!(correlation(&part(&still, false), &part(&turned, false)) > 0.999);
    let ball = correlation(&part(&still, true), &part(&turned, true));
    assert!(ball < 0.97 && ball > 0.7, "{ball}");
    let share = turned.iter().sum::<f64>() / still.iter().sum::<f64>();
    assert!((share - 1.0).abs() < 0.05, "{share}");
}

#[test]
fn marks_without_sense_leave_nothing() {
    let library = library();
    let good = footfall(vec2(0.65, 0.65), 0.0);
    let bad = [
        Mark { place_m: vec2(f64::NAN, 0.6), ..good },
        Mark { place_m: vec2(1e300, 0.6), ..good },
        Mark { heading: Vec2::ZERO, ..good },
        Mark { heading: vec2(f64::INFINITY, 0.0), ..good },
        Mark { length_m: f32::NAN, ..good },
        Mark { length_m: 0.0, ..good },
        Mark { length_m: 1e9, ..good },
        Mark { strength: f32::NAN, ..good },
        Mark { pattern: 77, ..good },
        Mark { pattern: 1, ..good },
        Mark { cause: Cause::Heel, ..good },
    ];
    let sums = stamped(&library, grid(100.0, 1.3, 1.3), &StampOptions::default(), &bad);
    assert!(Quantity::ALL.iter().all(|&q| all(&sums, q).iter().all(|&v| v == 0.0)));
    let odd = [
        Mark { smear_m: f32::NAN, twist_rad: f32::NAN, forefoot: f32::NAN, soil: f32::NAN, ..good },
        Mark { smear_m: 1e9, twist_rad: -1e9, forefoot: 1e9, soil: 1e9, strength: f32::INFINITY, ..good },
    ];
    let sums = stamped(&library, grid(100.0, 1.3, 1.3), &StampOptions::default(), &odd);
    assert!(all(&sums, Quantity::Passes).iter().any(|&v| v > 0.0));
}
