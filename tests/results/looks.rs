//! Looks over a finished bake: an artist's own images, a floor at several ages, floors by what rooms are.

use std::fs;
use std::path::Path;

use image::{GrayImage, Luma, Rgb, RgbImage};
use trodden::Silent;
use trodden::bake::{OutputOptions, ResolveOptions, bake, resolve, resolve_series};
use trodden::math::srgb::light;
use trodden::scenario::{Overrides, Scenario};

/// A hall of 12 x 8 m with a door at either end, and stripes of an artist's images, 0.5 m each, on half of its floor.
const SCENARIO: &str = r#"
[plan]
image = "plan.png"
metres_per_pixel = 0.1

[crowd]
people = 150

[texture]
floor_texels_per_metre = 32
walls = false

[[look.area]]
outline = [[0.0, 0.0], [6.0, 10.0]]
[look.area.floor]
image = "stripes"
image_size_m = [1.0, 1.0]
"#;

fn written(folder: &Path) -> Scenario {
    let plan = GrayImage::from_fn(140, 100, |x, y| {
        let hall = (10..130).contains(&x) && (10..90).contains(&y);
        let door = (44..56).contains(&y);
        Luma([if hall || door { 255 } else { 0 }])
    });
    plan.save(folder.join("plan.png")).unwrap();
    let images = folder.join("stripes");
    fs::create_dir(&images).unwrap();
    let left = |x: u32| x < 32;
    let colour = |x, _| Rgb(if left(x) { [200, 190, 180] } else { [120, 60, 40] });
    RgbImage::from_fn(64, 64, colour).save(images.join("Stripes01_Color.png")).unwrap();
    let rough = |x, _| Luma([if left(x) { 60 } else { 180 }]);
    GrayImage::from_fn(64, 64, rough).save(images.join("Stripes01_Roughness.png")).unwrap();
    // Leaning to the right on the left stripe, and down the image on the right one: green points down.
    let normal = |x, _| Rgb(if left(x) { [190, 128, 238] } else { [128, 190, 238] });
    RgbImage::from_fn(64, 64, normal).save(images.join("Stripes01_NormalDX.png")).unwrap();
    fs::write(folder.join("hall.toml"), SCENARIO).unwrap();
    Scenario::open(&folder.join("hall.toml"), &Overrides::default()).unwrap()
}

/// Mean of each channel, 0 to 255, over metres from the plan's lower left corner.
fn mean(bake: &Path, kind: &str, [x0, y0, x1, y1]: [f64; 4]) -> [f64; 3] {
    let picture = image::open(bake.join(format!("floor/floor_{kind}.1001.png"))).unwrap().to_rgb8();
    let px = |metres: f64| (metres * 32.0) as u32;
    let texels = (px(y0)..px(y1)).flat_map(|j| (px(x0)..px(x1)).map(move |i| (i, j)));
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for (i, j) in texels {
        let texel = picture.get_pixel(i, picture.height() - 1 - j).0;
        (0..3).for_each(|c| sum[c] += f64::from(texel[c]));
        count += 1.0;
    }
    sum.map(|sum| sum / count)
}

/// L* of a mean colour.
fn lightness(bake: &Path, area: [f64; 4]) -> f64 {
    let [r, g, b] = mean(bake, "basecolor", area).map(|value| f64::from(light(value.round() as u8)));
    116.0 * libm::cbrt(0.2126 * r + 0.7152 * g + 0.0722 * b) - 16.0
}

#[test]
fn an_artists_images_and_ages_over_one_bake() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = written(folder.path());
    let out = folder.path().join("out");
    bake(&scenario, &OutputOptions { folder: out.clone(), force: false }, &Silent).unwrap();

    // Corners that nobody walks: a stripe of each kind, and the vinyl beside the area.
    let [left, right, vinyl] = [[3.05, 8.2, 3.45, 8.8], [3.55, 8.2, 3.95, 8.8], [8.0, 8.2, 9.0, 8.8]];
    let [light, dark, plain] = [left, right, vinyl].map(|area| mean(&out, "basecolor", area));
    assert!((light[0] - 200.0).abs() < 12.0 && (dark[0] - 120.0).abs() < 12.0, "{light:?} {dark:?}");
    assert!((plain[0] - 197.0).abs() < 12.0 && plain[2] > 165.0, "{plain:?}");
    let [smooth, rough] = [left, right].map(|area| mean(&out, "orm", area)[1]);
    assert!((rough - smooth - 120.0).abs() < 20.0, "{smooth} and {rough}");
    let [east, south, even] = [left, right, vinyl].map(|area| mean(&out, "normal", area));
    // 62 of 127 to the side and 110 up lean by 0.56: 0.49 of a unit vector.
    assert!(east[0] > 180.0 && (east[1] - 128.0).abs() < 6.0, "{east:?}");
    assert!(south[1] < 75.0 && (south[0] - 128.0).abs() < 6.0, "{south:?}");
    assert!(even.iter().zip([128.0, 128.0, 255.0]).all(|(found, flat)| (found - flat).abs() < 8.0), "{even:?}");

    // The bake holds the images: without the artist's folder it is resolved to the same texels.
    fs::remove_dir_all(folder.path().join("stripes")).unwrap();
    let again = folder.path().join("again");
    let elsewhere = ResolveOptions { folder: Some(again.clone()), ..ResolveOptions::default() };
    resolve(&out, &elsewhere, &Silent).unwrap();
    for kind in ["basecolor", "orm", "normal"] {
        let bytes = |bake: &Path| fs::read(bake.join(format!("floor/floor_{kind}.1001.png"))).unwrap();
        assert!(bytes(&out) == bytes(&again), "{kind} differs");
    }

    // The lane from door to door darkens with age, by an amount that is seen; a corner stays.
    let ages = folder.path().join("ages");
    let passes = [1_000, 50_000, 1_000_000];
    resolve_series(&out, &ResolveOptions::default(), &passes, &ages, &Silent).unwrap();
    let bakes = passes.map(|passes| ages.join(format!("passes_{passes}")));
    let lane = bakes.each_ref().map(|bake| lightness(bake, [7.5, 4.7, 11.0, 5.3]));
    assert!(lane[0] - lane[1] > 4.0 && lane[1] - lane[2] > 4.0, "{lane:?}");
    let corner = bakes.each_ref().map(|bake| lightness(bake, vinyl));
    assert!(corner[0] - corner[2] < 3.0, "{corner:?}");
    let book = fs::read(ages.join("floor.png")).unwrap();
    let reader = png::Decoder::new(std::io::Cursor::new(book)).read_info().unwrap();
    assert_eq!(reader.info().animation_control().unwrap().num_frames, 3);
}

/// A home of four rooms and a WC of 1.8 x 2.2 m at a corridor, with a front door: 0.05 m per pixel, outer walls of 0.3 m.
fn home(folder: &Path) {
    let mut plan = GrayImage::from_pixel(300, 240, Luma([255]));
    let mut fill = |[x0, y0, x1, y1]: [u32; 4], tone| {
        (y0..y1).for_each(|y| (x0..x1).for_each(|x| plan.put_pixel(x, y, Luma([tone]))));
    };
    fill([20, 20, 280, 220], 0);
    // Rooms above and below the corridor, the WC at the lower right.
    for space in [
        [26, 26, 130, 100],
        [134, 26, 274, 100],
        [26, 104, 274, 132],
        [26, 136, 110, 214],
        [114, 136, 226, 214],
        [230, 136, 274, 180],
        [230, 184, 274, 214],
    ] {
        fill(space, 255);
    }
    for door in
        [[70, 100, 88, 104], [190, 100, 208, 104], [60, 132, 78, 136], [160, 132, 178, 136], [244, 132, 262, 136]]
    {
        fill(door, 255);
    }
    fill([20, 108, 26, 127], 255);
    plan.save(folder.join("home.png")).unwrap();
}

/// b* of a mean colour: how yellow it is.
fn yellow(bake: &Path, area: [f64; 4]) -> f64 {
    let [r, g, b] = mean(bake, "basecolor", area).map(|value| f64::from(light(value.round() as u8)));
    let (y, z) = (0.2126 * r + 0.7152 * g + 0.0722 * b, (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.0888);
    200.0 * (libm::cbrt(y) - libm::cbrt(z))
}

#[test]
fn a_home_has_wooden_rooms_and_a_tiled_wc_unless_the_scenario_says_otherwise() {
    let folder = tempfile::tempdir().unwrap();
    home(folder.path());
    // Corners of two rooms, the corridor's end, the WC.
    let places = [[1.6, 10.2, 2.4, 10.6], [6.1, 1.6, 6.9, 2.0], [12.9, 5.6, 13.6, 6.0], [11.7, 3.2, 12.4, 3.6]];
    let baked = |name: &str, more: &str| {
        let scenario = format!(
            "[plan]\nimage = \"home.png\"\nmetres_per_pixel = 0.05\n[crowd]\npeople = 40\n\
             [texture]\nfloor_texels_per_metre = 32\nwalls = false\n{more}"
        );
        let path = folder.path().join(name).with_extension("toml");
        fs::write(&path, scenario).unwrap();
        let scenario = Scenario::open(&path, &Overrides::default()).unwrap();
        let out = folder.path().join(name);
        bake(&scenario, &OutputOptions { folder: out.clone(), force: false }, &Silent).unwrap();
        places.map(|place| yellow(&out, place))
    };
    let [rooms @ .., wc] = baked("plain", "");
    assert!(rooms.iter().all(|room| room - wc > 12.0), "b* of rooms {rooms:.1?}, of the WC {wc:.1}");
    for (name, more) in [("one", "[life]\nfloors = false\n"), ("own", "[look.floor]\nmaterial = \"concrete\"\n")] {
        let [rooms @ .., wc] = baked(name, more);
        assert!(rooms.iter().all(|room| (room - wc).abs() < 6.0), "{name}: b* of rooms {rooms:.1?}, of the WC {wc:.1}");
    }
    // `resolve` keeps the floors.
    let (out, again) = (folder.path().join("plain"), folder.path().join("again"));
    let elsewhere = ResolveOptions { folder: Some(again.clone()), ..ResolveOptions::default() };
    resolve(&out, &elsewhere, &Silent).unwrap();
    let bytes = |bake: &Path| fs::read(bake.join("floor/floor_basecolor.1001.png")).unwrap();
    assert!(bytes(&out) == bytes(&again));
}
