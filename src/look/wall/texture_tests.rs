//! Tests of what walls are made of: masonry, and chips in paint.

use super::tests::{PEOPLE, SummedWalls, look, resolve, resolved, scene, touch};
use super::{WallMaterial, WallResolver};
use crate::look::tests::{mean, sd};
use crate::math::SplitMix64;
use crate::patterns::Cause;

#[test]
fn masonry_repeats_no_piece() {
    let scene = scene(320, 24, 100.0, |_, row| (2..22).contains(&row));
    for material in [WallMaterial::Brick, WallMaterial::Tile] {
        let wall = resolved(&scene, &look(material).clean(), [0.5, 31.5], [0.2, 1.4]);
        let tone = |i: usize| mean((0..120).map(|j| f64::from(wall.clean.base_color[j * wall.width + i][0])));
        let tones: Vec<f64> = (0..wall.width).map(tone).collect();
        let (middle, spread) = (mean(tones.iter().copied()), sd(&tones));
        // Columns a number of whole pieces apart differ beyond their joints: the wall is not a repeated image.
        for apart in [200, 500, 1000, 2000] {
            let pairs = tones.iter().zip(&tones[apart..]);
            let alike = mean(pairs.map(|(a, b)| (a - middle) * (b - middle))) / (spread * spread);
            println!("{material:?}: {:.1} m apart {alike:.2}", apart as f64 / 100.0);
            assert!(alike < 0.97, "{material:?}: {alike}");
        }
    }
}

#[test]
fn joints_lie_back_and_paint_is_stippled() {
    let scene = scene(320, 24, 200.0, |_, row| (2..22).contains(&row));
    let slopes = |material: WallMaterial, texture: f32, least: u8| {
        let mut look = look(material).clean();
        look.wall.texture = texture;
        let resolver = WallResolver::new(&scene.sums, &scene.walls, &look, PEOPLE).unwrap();
        let block = resolver.resolve(0, 40, 60, 400, 160);
        let steep = |relief: &[u8; 6]| relief[3..5].iter().any(|part| part.abs_diff(128) > least);
        let lean: Vec<f64> = block.relief.iter().map(|relief| f64::from(relief[3]) - 128.0).collect();
        let steep = block.relief.iter().filter(|relief| steep(relief)).count();
        (steep as f64 / block.relief.len().max(1) as f64, if lean.is_empty() { 0.0 } else { sd(&lean) / 127.5 })
    };
    // Joints cover a sixth of a brick wall, and both of their edges lean.
    for (material, least, share) in [(WallMaterial::Brick, 25, 0.1..0.5), (WallMaterial::Tile, 3, 0.05..0.25)] {
        let (steep, _) = slopes(material, 1.0, least);
        println!("{material:?}: {:.1} % steep", 100.0 * steep);
        assert!(share.contains(&steep), "{material:?}: {steep}");
    }
    let (steep, lean) = slopes(WallMaterial::Matt, 1.0, 25);
    println!("matt: normals lean by {lean:.3}");
    assert!(steep < 0.01 && (0.008..0.05).contains(&lean), "{steep}, {lean}");
    assert_eq!(slopes(WallMaterial::Matt, 0.0, 0), (0.0, 0.0));
}

#[test]
fn bags_chip_the_paint_of_outer_corners() {
    let mut scene = scene(44, 44, 200.0, |x, y| !(18..26).contains(&x) || !(18..26).contains(&y));
    let corner = scene.walls.corners().into_iter().find(|corner| corner.turn_rad < -0.6).unwrap();
    let chips = |scene: &SummedWalls, amount: f32| {
        let mut look = look(WallMaterial::Matt);
        look.wall.chips = amount;
        let resolver = WallResolver::new(&scene.sums, &scene.walls, &look, PEOPLE).unwrap();
        let first = (corner.along_m * 200.0) as i64 - 40;
        let block = resolve(&resolver, [first, 20], [80, 240]);
        assert_eq!(corner.face, 0);
        let chips = block.layers.iter().find(|layer| layer.name == "chip").unwrap();
        chips.values.iter().filter(|&&density| density > 1.0).count()
    };
    assert_eq!(chips(&scene, 1.0), 0, "nobody came by");
    let mut rng = SplitMix64::new(5);
    for _ in 0..200 {
        let middle_m = [corner.along_m + 0.04 * f64::from(rng.normal()), f64::from(rng.range(0.2, 0.6))];
        touch(&mut scene.sums, Cause::Bag, middle_m, [0.1, 0.06], 0.06);
    }
    let found = chips(&scene, 1.0);
    println!("{found} texels of chips");
    assert!((60..2500).contains(&found) && chips(&scene, 0.0) == 0, "{found}");
}
