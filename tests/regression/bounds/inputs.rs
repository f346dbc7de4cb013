//! Files that are no files of ours, or no files at all.

use std::fs;
use std::process::Command;

use image::GrayImage;

use super::super::sandbox::Sandbox;
use super::watched;

/// A scenario for the corridor with something behind it.
fn scenario(rest: &str) -> String {
    format!("[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n{rest}")
}

#[cfg(unix)]
#[test]
fn pipes_and_devices_are_refused_as_inputs() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    // Elsewhere: the sandbox looks into all its files.
    let pipes = tempfile::tempdir().unwrap();
    let pipe = pipes.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    for (name, ending) in [("plan", "png"), ("map", "yaml"), ("scenario", "toml")] {
        std::os::unix::fs::symlink(&pipe, pipes.path().join(name).with_extension(ending)).unwrap();
    }
    let at = |name: &str| pipes.path().join(name).display().to_string();
    sandbox.write(
        "timed.toml",
        scenario(&format!("[crowd]\narrivals = {{ kind = \"list\", file = {:?} }}\n", at("pipe"))),
    );
    sandbox.write("units.toml", scenario("[look]\nfile = \"/dev/zero\"\n"));
    let [plan, map, toml, pipe] = ["plan.png", "map.yaml", "scenario.toml", "pipe"].map(at);
    for arguments in [
        vec!["inspect", "/dev/zero"],
        vec!["inspect", &plan],
        vec!["inspect", &map],
        vec!["inspect", &toml],
        vec!["inspect", "timed.toml"],
        vec!["inspect", "units.toml"],
        vec!["motion", "info", "/dev/zero"],
        vec!["motion", "info", &pipe],
        vec!["resolve", "no", "--look", "/dev/zero"],
        vec!["patterns", "import", &pipe, "--cause", "hand", "--length-cm", "10"],
    ] {
        let ran = watched(&sandbox, &arguments, 10);
        let told = ran.err.contains("it is a pipe or a device, not a regular file");
        assert!(ran.code == Some(1) && told, "{arguments:?}: {:?} {}", ran.code, ran.err);
    }
}

#[test]
fn images_have_a_limit_of_pixels_and_of_bytes() {
    let sandbox = Sandbox::new();
    // What a header claims is enough.
    let header = |width: u32, height: u32, depth: u8, colour: u8| {
        let mut head = b"IHDR".to_vec();
        head.extend([width, height].iter().flat_map(|side| side.to_be_bytes()));
        head.extend([depth, colour, 0, 0, 0]);
        let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\x0d".to_vec();
        png.extend(&head);
        png.extend(crc32(&head).to_be_bytes());
        png.extend(b"\0\0\0\0IDAT\x35\xaf\x06\x1e\0\0\0\0IEND\xae\x42\x60\x82");
        png
    };
    sandbox.write("wide.png", header(30_000, 10, 8, 0));
    sandbox.write("large.png", header(20_000, 20_000, 1, 0));
    sandbox.write("deep.png", header(16_384, 16_384, 16, 6));
    for (name, part) in [
        ("wide.png", "at most 20000 a side"),
        ("large.png", "268435456 in all"),
        ("deep.png", "take 2147483648 bytes; at most 1073741824 are read"),
    ] {
        let ran = watched(&sandbox, &["inspect", name], 10);
        assert!(ran.code == Some(1) && ran.err.contains(part) && ran.err.contains("hint: "), "{name}: {}", ran.err);
        assert!(ran.peak_mib < 100.0, "{name}: {} MiB", ran.peak_mib);
    }
}

/// As PNG has it.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
    })
}

#[test]
fn a_large_plan_takes_few_bytes_a_pixel() {
    let sandbox = Sandbox::new();
    let (width, height) = (6000, 4000);
    let wall = |x: u32, y: u32| !(40..3960).contains(&y) || (2980..3020).contains(&x) && !(1900..2100).contains(&y);
    let plan = GrayImage::from_fn(width, height, |x, y| image::Luma([if wall(x, y) { 0 } else { 255 }]));
    plan.save(sandbox.path("large.png")).unwrap();
    GrayImage::from_fn(60, 40, |x, y| image::Luma([if wall(x * 100, y * 100) { 0 } else { 255 }]))
        .save(sandbox.path("small.png"))
        .unwrap();
    // The program itself takes some, the more the longer it is.
    let [small, large] = [("small.png", "1"), ("large.png", "0.01")].map(|(name, scale)| {
        let ran = watched(&sandbox, &["inspect", name, "--metres-per-pixel", scale, "--threads", "2"], 60);
        assert_eq!(ran.code, Some(0), "{}", ran.err);
        ran
    });
    let bytes = (large.peak_mib - small.peak_mib) * f64::from(1 << 20) / f64::from(width * height);
    assert!(bytes < 8.3, "{bytes:.2} bytes a pixel, {} MiB in {:.1} s", large.peak_mib, large.seconds);
}

#[test]
fn a_plan_with_a_palette_as_tiff_is_read() {
    let sandbox = Sandbox::new();
    let corridor = super::super::sandbox::corridor();
    corridor.save(sandbox.path("grey.png")).unwrap();
    let says = |name: &str| sandbox.run(&["inspect", name, "--metres-per-pixel", "0.1", "--json"]).succeeds().out;
    let expected = says("grey.png");
    for little_endian in [true, false] {
        // Index 3 is white, 7 is black, and all others are red.
        let indices: Vec<u8> = corridor.iter().map(|&grey| if grey == 255 { 3 } else { 7 }).collect();
        sandbox.write("palette.tif", palette_tiff(&indices, 80, 8, little_endian));
        assert_eq!(says("palette.tif"), expected);
    }
    sandbox.write("four.tif", palette_tiff(&[0; 3200], 80, 4, true));
    sandbox
        .run(&["inspect", "four.tif"])
        .fails(1, &["a TIFF with a palette of 4 bits is not supported", "save it as PNG"]);
}

fn palette_tiff(indices: &[u8], width: u16, bits: u16, little_endian: bool) -> Vec<u8> {
    let short = |value: u16| if little_endian { value.to_le_bytes() } else { value.to_be_bytes() };
    let long = |value: u32| if little_endian { value.to_le_bytes() } else { value.to_be_bytes() };
    let colours = 1usize << bits;
    let map_at = 8 + indices.len();
    let directory_at = map_at + 6 * colours;
    let mut tiff = if little_endian { b"II\x2a\0".to_vec() } else { b"MM\0\x2a".to_vec() };
    tiff.extend(long(directory_at as u32));
    tiff.extend(indices);
    for channel in 0..3 {
        for index in 0..colours {
            let value = [[65_535, 0, 0], [65_535; 3], [0; 3]][if index == 3 { 1 } else { 2 * usize::from(index == 7) }];
            tiff.extend(short(value[channel]));
        }
    }
    let height = indices.len() as u32 / u32::from(width);
    let entries: [(u16, u16, u32, u32); 10] = [
        (256, 3, 1, u32::from(width)),
        (257, 3, 1, height),
        (258, 3, 1, u32::from(bits)),
        (259, 3, 1, 1),
        (262, 3, 1, 3),
        (273, 4, 1, 8),
        (277, 3, 1, 1),
        (278, 3, 1, height),
        (279, 4, 1, indices.len() as u32),
        (320, 3, 3 * colours as u32, map_at as u32),
    ];
    tiff.extend(short(entries.len() as u16));
    for (tag, kind, count, value) in entries {
        tiff.extend(short(tag).into_iter().chain(short(kind)).chain(long(count)));
        // A short stands at the beginning of its four bytes.
        if kind == 3 && count == 1 {
            tiff.extend(short(value as u16).into_iter().chain([0, 0]));
        } else {
            tiff.extend(long(value));
        }
    }
    tiff.extend(long(0));
    tiff
}

#[test]
fn the_content_of_a_foreign_file_is_never_repeated() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let secret = "root:hunter2:19000:0:99999:7:::\ndaemon:hunter2:19000:0:99999:7:::\n";
    for name in ["x.toml", "x.yaml", "x.txt", "x.csv", "x.png"] {
        sandbox.write(name, secret);
    }
    sandbox.write("token.toml", "password = \"hunter2\"\n");
    sandbox.write("words.txt", "hunter2 hunter2 hunter2 hunter2\n");
    sandbox.write("short.txt", "1 1 0 0\nhunter2\n");
    sandbox.write("timed.toml", scenario("[crowd.arrivals]\nkind = \"list\"\nfile = \"x.csv\"\n"));
    sandbox.write(
        "points.toml",
        "[formation]\nduration_s = 2\n[formation.example]\npeople = 2\n[[formation.key]]\ntime_s = 0\nfile = \"x.txt\"\n",
    );
    for arguments in [
        vec!["bake", "x.toml"],
        vec!["bake", "token.toml"],
        vec!["inspect", "x.yaml"],
        vec!["inspect", "x.png"],
        vec!["inspect", "timed.toml"],
        vec!["motion", "info", "x.txt"],
        vec!["motion", "info", "x.csv"],
        vec!["motion", "info", "words.txt"],
        vec!["motion", "info", "short.txt"],
        vec!["motion", "formation", "points.toml"],
        vec!["resolve", "out", "--look", "x.toml"],
        vec!["resolve", "out", "--look", "token.toml"],
    ] {
        let ran = sandbox.run(&arguments).fails(1, &[]);
        assert!(!ran.err.contains("hunter2"), "{arguments:?}: {}", ran.err);
    }
    // A mistake in a scenario is still shown.
    sandbox.write("own.toml", scenario("people = = 3\n"));
    sandbox.run(&["bake", "own.toml"]).fails(1, &["own.toml:4:", "people = = 3"]);
}

#[test]
fn a_timetable_that_is_another_file_is_told_by_its_first_line() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("arrivals.toml", scenario("[crowd.arrivals]\nkind = \"list\"\nfile = \"times.csv\"\n"));
    for (text, part) in [
        ("root:x:0:0:root:/root:/bin/bash\ndaemon:x:1\n", "times.csv, line 1: it is no time and number of people"),
        ("one\ntwo\nthree\n", "times.csv, line 2: it is no time and number of people"),
        ("1, 2, 3\n", "times.csv, line 1: it has more than two columns"),
        ("time, people\n", "times.csv has no line with a time"),
        ("", "times.csv is empty"),
    ] {
        sandbox.write("times.csv", text);
        sandbox.run(&["inspect", "arrivals.toml"]).fails(1, &[part, "hint: write a line as `60, 20`"]);
    }
    fs::write(sandbox.path("times.csv"), "time [s], people\n0, 2\n").unwrap();
    sandbox.run(&["inspect", "arrivals.toml"]).succeeds();
}

/// Where overflow is checked, a faint stroke that ends in a plan's upper right corner was looked at beside its last pixel.
#[test]
fn a_faint_stroke_in_the_upper_right_corner_is_read() {
    let sandbox = Sandbox::new();
    let is_wall = |x: u32, y: u32| {
        (20..180).contains(&x) && (20..130).contains(&y) && !((26..174).contains(&x) && (26..124).contains(&y))
    };
    let plan = image::GrayImage::from_fn(200, 150, |x, y| match (x, y) {
        (199, 0) => image::Luma([200]),
        (60..90, 20..26) => image::Luma([255]),
        _ if is_wall(x, y) => image::Luma([0]),
        _ => image::Luma([255]),
    });
    plan.save(sandbox.path("plan.png")).unwrap();
    let found = watched(&sandbox, &["inspect", "plan.png", "--metres-per-pixel", "0.03"], 60);
    assert_eq!(found.code, Some(0), "{}", found.err);
}
