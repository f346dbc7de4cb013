//! How textures are stored: masks of 16 bits, finer than those of 8, of the same values; small files. Kept by `resolve`.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use image::{DynamicImage, GrayImage, Luma};
use trodden::Silent;
use trodden::bake::{OutputOptions, ResolveOptions, bake, resolve};
use trodden::export::Manifest;
use trodden::scenario::{Overrides, Scenario};

/// A hall of 8 x 6 m with a door at either end.
const SCENARIO: &str = r#"
[plan]
image = "plan.png"
metres_per_pixel = 0.1

[crowd]
people = 120

[texture]
floor_texels_per_metre = 50
wall_texels_per_metre = 50
layers = false
"#;

fn baked(folder: &Path) {
    let plan = GrayImage::from_fn(100, 80, |x, y| {
        let hall = (10..90).contains(&x) && (10..70).contains(&y);
        Luma([if hall || (34..46).contains(&y) { 255 } else { 0 }])
    });
    plan.save(folder.join("plan.png")).unwrap();
    fs::write(folder.join("hall.toml"), SCENARIO).unwrap();
    let scenario = Scenario::open(&folder.join("hall.toml"), &Overrides::default()).unwrap();
    bake(&scenario, &OutputOptions { folder: folder.join("8"), force: false }, &Silent).unwrap();
}

const IMAGES: [&str; 6] = [
    "floor/floor_mask.1001.png",
    "floor/floor_passes.1001.png",
    "floor/floor_wear.1001.png",
    "walls/wall_mask.1001.png",
    "walls/wall_splash.1001.png",
    "walls/wall_rub.1001.png",
];

#[test]
fn masks_of_16_bits_are_finer_and_the_same() {
    let folder = tempfile::tempdir().unwrap();
    baked(folder.path());
    let [coarse, fine, again, back] = ["8", "16", "again", "back"].map(|name| folder.path().join(name));
    let into = |to: &Path, bits| ResolveOptions { folder: Some(to.to_path_buf()), bits, ..ResolveOptions::default() };
    resolve(&coarse, &into(&fine, Some(16)), &Silent).unwrap();
    resolve(&fine, &into(&again, None), &Silent).unwrap();
    resolve(&again, &into(&back, Some(8)), &Silent).unwrap();
    for image in IMAGES {
        let [a, b] = [&coarse, &fine].map(|bake| image::open(bake.join(image)).unwrap());
        let is_fine = matches!(b, DynamicImage::ImageLuma16(_) | DynamicImage::ImageRgb16(_));
        assert!(is_fine, "{image} is {:?}", b.color());
        let (a, b) = (a.to_rgb16(), b.to_rgb16());
        // Half a step of 1/255 for rounding, and as much for dither.
        let most = a.as_raw().iter().zip(b.as_raw()).map(|(&a, &b)| a.abs_diff(b)).max().unwrap();
        assert!(most <= 258, "{image} differs by {most} of 65535");
        for (bake, as_in) in [(&again, &fine), (&back, &coarse)] {
            let [bytes, earlier] = [bake, as_in].map(|bake| fs::read(bake.join(image)).unwrap());
            assert!(bytes == earlier, "{image} of {} is not that of {}", bake.display(), as_in.display());
        }
    }
    // The lane from door to door: 4 m by 40 cm.
    let film = |bake: &Path| {
        let mask = image::open(bake.join(IMAGES[0])).unwrap().to_rgb16();
        let texels = (150..350).flat_map(|x| (190..210).map(move |y| (x, y)));
        texels.map(|(x, y)| mask.get_pixel(x, mask.height() - 1 - y).0[0]).collect::<BTreeSet<u16>>().len()
    };
    let [few, many] = [&coarse, &fine].map(|bake| film(bake));
    assert!(few < 200 && many > 300, "{few} and {many} values of film on a lane");
    let bits = |bake: &Path, image: &str| {
        let floor = Manifest::read(bake).unwrap().floor;
        floor.channels.iter().filter(|c| c.image == image).map(|c| c.bits).collect::<Vec<_>>()
    };
    assert_eq!([bits(&fine, "mask"), bits(&fine, "wear"), bits(&fine, "passes")], [vec![16; 3], vec![16; 3], vec![16]]);
    assert_eq!([bits(&fine, "orm"), bits(&coarse, "mask")], [vec![8; 3], vec![8; 3]]);
}

/// PNG files compressed harder: fewer bytes, the same pixels, the same bytes on any number of threads, kept by `resolve`.
#[test]
fn small_pngs_are_smaller_and_show_the_same() {
    let folder = tempfile::tempdir().unwrap();
    baked(folder.path());
    let fast = folder.path().join("8");
    let resolved = |name: &str, from: &Path, small_png, threads| {
        let options = ResolveOptions { folder: Some(folder.path().join(name)), small_png, ..ResolveOptions::default() };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| resolve(from, &options, &Silent)).unwrap();
        folder.path().join(name)
    };
    let [one, two] = [1, 2].map(|threads| resolved(&format!("small {threads}"), &fast, Some(true), threads));
    let back = resolved("fast", &one, Some(false), 2);
    let (mut fast_bytes, mut small_bytes) = (0, 0);
    for image in ["floor/floor_basecolor.1001.png", "walls/wall_basecolor.1001.png", "walls/wall_orm.1001.png"]
        .iter()
        .chain(&IMAGES)
    {
        let [large, small, other] = [&fast, &one, &two].map(|bake| fs::read(bake.join(image)).unwrap());
        assert!(small == other, "{image} on one thread is not that on two");
        assert!(large == fs::read(back.join(image)).unwrap(), "{image} is small where it is to be fast");
        let [a, b] = [&large, &small].map(|bytes| image::load_from_memory(bytes).unwrap());
        assert!(a == b, "{image} has other pixels");
        (fast_bytes, small_bytes) = (fast_bytes + large.len(), small_bytes + small.len());
    }
    // The ways to compress were chosen on a plaza, where they took off 36 %.
    assert!(small_bytes * 100 < 80 * fast_bytes, "{small_bytes} bytes instead of {fast_bytes}");
}
