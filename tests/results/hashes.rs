//! Check sums of whole bakes: a redesign keeps every byte, and machines can be compared.
//!
//! `BLESS=1 cargo test --test results hashes` rewrites `hashes.txt`. Do that only if the pictures are meant to change.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use trodden::Silent;
use trodden::bake::{OutputOptions, bake};
use trodden::scenario::{Overrides, Scenario};

/// CRC-32 of sums and textures of a sample scenario with fewer people and texels, one line per file.
fn hashes(name: &str, people: u32) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let overrides = Overrides { people: Some(people), texels_per_metre: Some(20.0), ..Overrides::default() };
    let mut scenario = Scenario::open(&root.join("floorplans").join(name).with_extension("toml"), &overrides).unwrap();
    scenario.wall_texels_per_metre = 50.0;
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    bake(&scenario, &OutputOptions { folder: out.clone(), force: false }, &Silent).unwrap();
    let mut lines = String::new();
    for folder in ["floor", "sums", "walls"] {
        let entries = fs::read_dir(out.join(folder)).unwrap().map(|entry| entry.unwrap().path());
        let mut files: Vec<_> =
            entries.filter(|path| path.extension().is_some_and(|e| e == "png" || e == "exr")).collect();
        files.sort();
        for file in files {
            let relative = file.strip_prefix(&out).unwrap().display().to_string();
            writeln!(lines, "{name} {relative} {:08x}", crc32fast::hash(&fs::read(&file).unwrap())).unwrap();
        }
    }
    lines
}

#[test]
fn sums_and_textures_are_those_that_stand_in_the_repository() {
    let found = [hashes("corridors", 60), hashes("museum", 60)].concat();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/results/hashes.txt");
    if std::env::var_os("BLESS").is_some() {
        fs::write(&path, &found).unwrap();
    }
    let expected = fs::read_to_string(&path).unwrap_or_default();
    let differing: Vec<&str> = found.lines().filter(|line| !expected.lines().any(|known| known == *line)).collect();
    assert!(found == expected, "these files changed:\n{}", differing.join("\n"));
}
