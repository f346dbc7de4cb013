use image::{ImageBuffer, Rgb, Rgba};

use super::*;
use crate::export::{OutputFolder, TileEntry};
use crate::math::vec2;

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap())
    }

    /// Saves an 8-bit image of 10 x 5 pixels of `value`, with blue `one` at pixel (7, 2).
    fn image(&self, name: &str, value: u8, one: u8) -> PathBuf {
        let mut image = ImageBuffer::from_pixel(10, 5, Rgb([value; 3]));
        image.get_pixel_mut(7, 2).0[2] = one;
        let path = self.0.path().join(name);
        image.save(&path).unwrap();
        path
    }
}

#[test]
fn the_same_image_does_not_differ() {
    let folder = Folder::new();
    let comparison = diff(&folder.image("a.png", 9, 9), &folder.image("b.png", 9, 9), &DiffOptions::default()).unwrap();
    assert!(!comparison.failed());
    assert_eq!((comparison.largest(), comparison.images[0].mean), (0.0, 0.0));
    assert!(comparison.heat_map.picture().pixels().all(|p| p.0 == [0; 3]));
}

#[test]
fn one_texel_is_found_and_measured() {
    let folder = Folder::new();
    let (a, b) = (folder.image("a.png", 100, 100), folder.image("b.png", 100, 151));
    let diff_at = |fail: f64, fail_share: f64, hard_fail: f64| {
        diff(&a, &b, &DiffOptions { fail, fail_share, hard_fail }).unwrap()
    };
    let comparison = diff_at(0.1, 0.0, f64::INFINITY);
    let image = &comparison.images[0];
    assert!((image.largest - 0.2).abs() < 1e-12);
    assert_eq!((image.largest_channel.as_str(), image.largest_px), ("B", [7, 2]));
    assert!((image.mean - 0.2 / 150.0).abs() < 1e-12);
    assert_eq!(image.share_over, 0.02);
    let picture = comparison.heat_map.picture();
    assert!(picture.enumerate_pixels().all(|(x, y, p)| (p.0 != [0; 3]) == ((x, y) == (7, 2))));
    // The three thresholds.
    assert!(comparison.failed());
    assert!(!diff_at(0.21, 0.0, f64::INFINITY).failed());
    assert!(!diff_at(0.1, 0.03, f64::INFINITY).failed());
    assert!(diff_at(0.1, 0.03, 0.15).failed());
}

#[test]
fn sixteen_bits_are_compared_as_such() {
    let folder = Folder::new();
    let save = |name: &str, value: u16| {
        let path = folder.0.path().join(name);
        ImageBuffer::from_pixel(3, 3, Rgba([value, 0, 0, 65_535])).save(&path).unwrap();
        path
    };
    let comparison = diff(&save("a.png", 1000), &save("b.png", 1001), &DiffOptions::default()).unwrap();
    assert!((comparison.largest() * 65_535.0 - 1.0).abs() < 1e-9);
    assert_eq!(comparison.images[0].share_over, 1.0);
}

#[test]
fn exr_values_are_compared_as_they_are() {
    use exr::prelude::*;
    let folder = Folder::new();
    let save = |name: &str, one: u32, compression: Compression, blocks: Blocks| {
        let path = folder.0.path().join(name);
        let mut values = vec![4_000_000_000u32; 300 * 70];
        values[65 * 300 + 270] = one;
        let channel = AnyChannel::new("passes", FlatSamples::U32(values));
        let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
        let layer = Layer::new(
            (300, 70),
            LayerAttributes::default(),
            encoding,
            AnyChannels::sort([channel].into_iter().collect()),
        );
        Image::from_layer(layer).write().to_file(&path).unwrap();
        path
    };
    // Tiles against rows.
    let a = save("a.exr", 4_000_000_001, Compression::ZIP16, Blocks::Tiles(Vec2(64, 64)));
    let b = save("b.exr", 4_000_000_000, Compression::RLE, Blocks::ScanLines);
    let comparison = diff(&a, &b, &DiffOptions::default()).unwrap();
    let image = &comparison.images[0];
    assert_eq!((image.largest, image.largest_px, image.largest_channel.as_str()), (1.0, [270, 65], "passes"));
}

#[test]
fn other_sizes_channels_and_kinds_are_errors() {
    let folder = Folder::new();
    let a = folder.image("a.png", 1, 1);
    let other = folder.0.path().join("other.png");
    ImageBuffer::from_pixel(10, 6, Rgb([0u8; 3])).save(&other).unwrap();
    assert!(matches!(diff(&a, &other, &DiffOptions::default()), Err(ExportError::SizesDiffer { .. })));
    ImageBuffer::from_pixel(10, 5, Rgba([0u8; 4])).save(&other).unwrap();
    assert!(matches!(diff(&a, &other, &DiffOptions::default()), Err(ExportError::ChannelsDiffer { .. })));
    assert!(matches!(diff(folder.0.path(), &a, &DiffOptions::default()), Err(ExportError::NotAlike { .. })));
    assert!(diff(folder.0.path(), folder.0.path(), &DiffOptions::default()).is_err(), "no bakes");
    assert!(diff(&a, Path::new("missing.png"), &DiffOptions::default()).is_err());
}

#[test]
fn damaged_images_are_errors() {
    let folder = Folder::new();
    let a = folder.image("a.png", 1, 200);
    let bytes = std::fs::read(&a).unwrap();
    let half = folder.0.path().join("half.png");
    for bytes in [&bytes[..bytes.len() / 2], &bytes[..8], &[]] {
        std::fs::write(&half, bytes).unwrap();
        let error = diff(&a, &half, &DiffOptions::default()).unwrap_err();
        assert!(error.to_string().contains("half.png"), "{error}");
    }
}

#[test]
fn bakes_are_compared_file_by_file() {
    let folder = Folder::new();
    let bake = |name: &str, one: u8, extra: bool| {
        let out = folder.0.path().join(name);
        let image = std::fs::read(folder.image("image.png", 100, one)).unwrap();
        let written = OutputFolder::begin(&out, false).unwrap();
        let file = |v: u32| format!("floor/floor_mask.{}.png", 1001 + 10 * v);
        for v in 0..2 {
            written.write(&file(v), &image).unwrap();
        }
        written.write("scene.glb", b"a scene").unwrap();
        if extra {
            written.write("floor/extra.png", &image).unwrap();
        }
        // Two tiles of 64 x 64 texels, one above the other.
        let tile = |v: u32| TileEntry {
            v,
            udim: Some(1001 + 10 * v),
            min_m: vec2(0.0, 64.0 * f64::from(v)),
            max_m: vec2(64.0, 64.0 * f64::from(v + 1)),
            mask: file(v),
            ..TileEntry::default()
        };
        let mut manifest = Manifest::blank([64.0, 100.0]);
        manifest.floor.tiles = vec![tile(0), tile(1)];
        written.publish(&manifest).unwrap();
        out
    };
    let (a, b, c) = (bake("a", 100, false), bake("b", 255, false), bake("c", 100, true));
    assert!(!diff(&a, &a, &DiffOptions::default()).unwrap().failed());
    let comparison = diff(&a, &b, &DiffOptions::default()).unwrap();
    assert!(comparison.failed());
    assert_eq!(comparison.images.len(), 2);
    // The upper tile lies above the lower one.
    let heat = comparison.heat_map.picture();
    assert_eq!(heat.dimensions(), (64, 128));
    let hot: Vec<(u32, u32)> =
        heat.enumerate_pixels().filter(|(.., p)| p.0 != [0; 3]).map(|(x, y, _)| (x, y)).collect();
    assert!(hot.iter().all(|(x, y)| (x * 10 / 64, y % 64 * 5 / 64) == (7, 2)), "{hot:?}");
    assert!(hot.iter().any(|(_, y)| *y < 64) && hot.iter().any(|(_, y)| *y >= 64), "{hot:?}");
    let comparison = diff(&a, &c, &DiffOptions::default()).unwrap();
    assert!(comparison.failed());
    assert_eq!(
        (comparison.only_in_a.len(), comparison.only_in_b.as_slice()),
        (0, &["floor/extra.png".to_string()][..])
    );
}
