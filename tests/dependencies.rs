//! What the program is built from: licences, sources, duplicates, and dependencies that nobody uses.

// A test that cannot go on fails.
#![allow(clippy::unwrap_used)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Licences under which a program may be handed on without its source.
const LICENCES: [&str; 6] = ["MIT", "Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "Zlib", "Unicode-3.0"];
const SOURCE: &str = "registry+https://github.com/rust-lang/crates.io-index";
/// Crates that come in several versions, because dependencies have not agreed yet. A new one wants a look: can it be one?
const DUPLICATES: [&str; 5] = ["glam", "itertools", "miniz_oxide", "quick-error", "syn"];

struct Metadata(Value);

impl Metadata {
    fn of_this() -> Metadata {
        let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
        let mut command = Command::new(cargo);
        command.args(["metadata", "--format-version", "1", "--locked", "--manifest-path"]);
        let output = command.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml")).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        Metadata(serde_json::from_slice(&output.stdout).unwrap())
    }

    fn packages(&self) -> impl Iterator<Item = &Value> {
        self.0["packages"].as_array().unwrap().iter()
    }

    fn own(&self) -> &Value {
        self.packages().find(|package| package["name"] == env!("CARGO_PKG_NAME")).unwrap()
    }
}

/// Whether one of the licences between which a crate lets its users choose is allowed, of each of its parts.
fn is_allowed(licence: &str) -> bool {
    let plain = licence.replace(['(', ')'], "").replace('/', " OR ");
    plain.split(" AND ").all(|part| part.split(" OR ").any(|choice| LICENCES.contains(&choice.trim())))
}

#[test]
fn licences_can_be_chosen() {
    assert!(is_allowed("(MIT OR LGPL-2.1-or-later) AND Unicode-3.0") && is_allowed("Unlicense/MIT"));
    assert!(!is_allowed("GPL-3.0-only") && !is_allowed("MIT AND GPL-2.0-only"));
}

#[test]
fn every_crate_comes_from_the_registry_under_a_licence_that_is_allowed() {
    let metadata = Metadata::of_this();
    let wrong: Vec<String> = metadata
        .packages()
        .filter(|package| package["name"] != env!("CARGO_PKG_NAME"))
        .filter(|package| package["source"] != SOURCE || !is_allowed(package["license"].as_str().unwrap_or_default()))
        .map(|package| format!("{}: {}, {}", package["name"], package["source"], package["license"]))
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn no_crate_comes_in_one_more_version() {
    let metadata = Metadata::of_this();
    let mut versions: BTreeMap<&str, u32> = BTreeMap::new();
    metadata.packages().for_each(|package| *versions.entry(package["name"].as_str().unwrap()).or_default() += 1);
    let several: Vec<&str> = versions.into_iter().filter(|(_, count)| *count > 1).map(|(name, _)| name).collect();
    assert_eq!(several, DUPLICATES);
}

/// The compiler that `Cargo.toml` names is new enough for every dependency.
#[test]
fn the_stated_compiler_builds_the_dependencies() {
    let number = |version: &str| -> Vec<u32> { version.split('.').map(|part| part.parse().unwrap()).collect() };
    let metadata = Metadata::of_this();
    let stated = number(metadata.own()["rust_version"].as_str().unwrap());
    for package in metadata.packages() {
        let needed = package["rust_version"].as_str().map(number).unwrap_or_default();
        assert!(needed <= stated, "{} needs {needed:?}", package["name"]);
    }
}

/// All Rust text below some folders.
fn source(folders: &[&str]) -> String {
    fn collect(folder: &Path, text: &mut String) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                collect(&path, text);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                *text += &fs::read_to_string(&path).unwrap();
            }
        }
    }
    let mut text = String::new();
    folders.iter().for_each(|folder| collect(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder), &mut text));
    text
}

#[test]
fn every_dependency_is_used() {
    let (program, all) = (source(&["src"]), source(&["src", "tests", "benches", "examples"]));
    let metadata = Metadata::of_this();
    let unused: BTreeSet<&str> = metadata.own()["dependencies"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|dependency| {
            let path = format!("{}::", dependency["name"].as_str().unwrap().replace('-', "_"));
            let text = if dependency["kind"] == "dev" { &all } else { &program };
            let begins = |at: usize| !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':');
            !text.match_indices(&path).any(|(at, _)| begins(at))
        })
        .map(|dependency| dependency["name"].as_str().unwrap())
        .collect();
    assert!(unused.is_empty(), "{unused:?}");
}
