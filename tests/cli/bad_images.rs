//! Plans that are no plans.

use std::io::Cursor;

use image::{DynamicImage, GrayImage, ImageFormat, Luma, RgbImage};

use super::sandbox::{Sandbox, corridor};

/// A good plan in every format that is read: name, bytes, length of the header that says what it is.
fn every_format() -> Vec<(&'static str, Vec<u8>, usize)> {
    let encoded = |format: ImageFormat| {
        let mut bytes = Cursor::new(Vec::new());
        let image = DynamicImage::ImageLuma8(corridor());
        // GIF has palettes of colours only.
        let image = if format == ImageFormat::Gif { DynamicImage::ImageRgba8(image.to_rgba8()) } else { image };
        image.write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    };
    let plan = corridor();
    let mut p5 = format!("P5\n{} {}\n255\n", plan.width(), plan.height()).into_bytes();
    p5.extend_from_slice(plan.as_raw());
    let numbers: Vec<String> = plan.as_raw().iter().map(u8::to_string).collect();
    let p2 = format!("P2\n{} {}\n255\n{}\n", plan.width(), plan.height(), numbers.join(" ")).into_bytes();
    vec![
        ("plan.png", encoded(ImageFormat::Png), 26),
        ("plan.jpg", encoded(ImageFormat::Jpeg), 24),
        ("plan.bmp", encoded(ImageFormat::Bmp), 30),
        ("plan.tif", encoded(ImageFormat::Tiff), 8),
        ("plan.gif", encoded(ImageFormat::Gif), 13),
        ("p5.pgm", p5, 10),
        ("p2.pgm", p2, 10),
    ]
}

#[test]
fn every_format_is_read() {
    for (name, bytes, _) in every_format() {
        let sandbox = Sandbox::new();
        sandbox.write(name, bytes);
        let ran = sandbox.run(&["inspect", name, "--metres-per-pixel", "0.1"]).succeeds();
        assert!(ran.out.contains("8.00 x 4.00 m"), "{name}: {}", ran.out);
    }
}

#[test]
fn truncated_images_are_refused() {
    for (name, bytes, _) in every_format() {
        for length in [1, 4, 12, bytes.len() / 4, bytes.len() / 2, bytes.len() * 3 / 4] {
            let sandbox = Sandbox::new();
            sandbox.write(name, &bytes[..length]);
            sandbox.run(&["bake", name]).fails(1, &[name]);
        }
    }
}

#[test]
fn images_with_a_damaged_header_are_refused() {
    for (name, bytes, header) in every_format() {
        for fill in [0x00, 0x5a, 0xff] {
            let sandbox = Sandbox::new();
            let mut damaged = bytes.clone();
            damaged[..header].fill(fill);
            sandbox.write(name, damaged);
            sandbox.run(&["bake", name]).fails(1, &[name]);
        }
    }
}

/// Damage further on may go unnoticed where a format has no checksum; it must never end in a panic.
#[test]
fn images_damaged_anywhere_never_panic() {
    for (name, bytes, _) in every_format() {
        let sandbox = Sandbox::new();
        for at in [bytes.len() / 5, bytes.len() / 2, bytes.len() * 4 / 5] {
            let mut damaged = bytes.clone();
            for byte in damaged.iter_mut().skip(at).take(9) {
                *byte = !*byte;
            }
            sandbox.write(name, damaged);
            let ran = sandbox.run(&["inspect", name, "--metres-per-pixel", "0.1"]);
            assert!(matches!(ran.code, Some(0 | 1)) && !ran.err.contains("panicked"), "{name} at {at}: {ran:?}");
            if ran.code == Some(1) {
                ran.fails(1, &[]);
            }
        }
    }
}

#[test]
fn an_empty_file_is_refused() {
    for name in
        ["plan.png", "plan.jpg", "plan.bmp", "plan.tif", "plan.gif", "plan.pgm", "plan", "plan.yaml", "plan.toml"]
    {
        let sandbox = Sandbox::new();
        sandbox.write(name, "");
        sandbox.run(&["bake", name]).fails(1, &[name]);
    }
}

#[test]
fn what_is_no_image_is_refused() {
    let sandbox = Sandbox::new();
    sandbox.write("plan.png", "This is not an image, but some text that somebody gave a wrong name.\n");
    sandbox.run(&["bake", "plan.png"]).fails(1, &["plan.png"]);
    std::fs::create_dir(sandbox.path("folder.png")).unwrap();
    sandbox.run(&["bake", "folder.png"]).fails(1, &["folder.png"]);
    sandbox.run(&["bake", "nowhere.png"]).fails(1, &["nowhere.png"]);
    sandbox.run(&["bake", "nowhere.toml"]).fails(1, &["nowhere.toml", "hint: "]);
    sandbox.run(&["bake", "nowhere.yaml"]).fails(1, &["nowhere.yaml"]);
}

#[test]
fn plans_without_a_floor_to_walk_on_are_refused() {
    for (name, image) in [
        ("one black pixel", GrayImage::from_pixel(1, 1, Luma([0]))),
        ("one white pixel", GrayImage::from_pixel(1, 1, Luma([255]))),
        ("black", GrayImage::from_pixel(100, 80, Luma([0]))),
        ("white", GrayImage::from_pixel(100, 80, Luma([255]))),
    ] {
        let sandbox = Sandbox::new();
        let path = sandbox.path("plan.png");
        image.save(&path).unwrap();
        let ran = sandbox.run(&["bake", "plan.png", "--metres-per-pixel", "0.1"]);
        println!("{name}: {}", ran.err);
        ran.fails(1, &["plan"]);
    }
}

#[test]
fn an_image_that_claims_to_be_huge_is_refused_before_it_is_read() {
    let mut png = Vec::new();
    image::codecs::png::PngEncoder::new(&mut png);
    let mut png = Cursor::new(Vec::new());
    RgbImage::new(2, 2).write_to(&mut png, ImageFormat::Png).unwrap();
    let mut png = png.into_inner();
    for at in [16, 20] {
        png[at..at + 4].copy_from_slice(&60_000u32.to_be_bytes());
    }
    let checksum = crc32(&png[12..29]);
    png[29..33].copy_from_slice(&checksum.to_be_bytes());

    let mut bmp = Cursor::new(Vec::new());
    RgbImage::new(2, 2).write_to(&mut bmp, ImageFormat::Bmp).unwrap();
    let mut bmp = bmp.into_inner();
    for at in [18, 22] {
        bmp[at..at + 4].copy_from_slice(&60_000u32.to_le_bytes());
    }
    for (name, bytes) in [("plan.png", png), ("plan.bmp", bmp), ("plan.pgm", b"P5\n60000 60000\n255\n".to_vec())] {
        let sandbox = Sandbox::new();
        sandbox.write(name, bytes);
        sandbox.run(&["bake", name]).fails(1, &[name, "60000"]);
    }
}

/// CRC-32 as PNG has it (ISO 3309), bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| if crc & 1 == 1 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 })
    })
}

#[test]
fn a_map_that_names_no_image_is_refused() {
    let sandbox = Sandbox::new();
    let yaml = |image: &str| {
        format!(
            "image: {image}\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n"
        )
    };
    sandbox.write("map.yaml", yaml("missing.pgm"));
    sandbox.run(&["bake", "map.yaml"]).fails(1, &["missing.pgm"]);
    sandbox.write("map.yaml", yaml("\"\""));
    sandbox.run(&["bake", "map.yaml"]).fails(1, &["map.yaml"]);
    sandbox.plan();
    for resolution in [".nan", "-0.05", "0", "1e300"] {
        let map = yaml("plan.png").replace("resolution: 0.05", &format!("resolution: {resolution}"));
        sandbox.write("map.yaml", map);
        sandbox.run(&["bake", "map.yaml"]).fails(1, &["resolution"]);
    }
    sandbox.write("map.yaml", yaml("plan.png").replace("resolution", "reslution"));
    sandbox.run(&["bake", "map.yaml"]).fails(1, &["map.yaml"]);
    sandbox.write("map.yaml", "image: [unclosed\n");
    sandbox.run(&["bake", "map.yaml"]).fails(1, &["map.yaml"]);
    sandbox.write("map.yaml", yaml("plan.png"));
    sandbox.run(&["inspect", "map.yaml"]).succeeds();
}
