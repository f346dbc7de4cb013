//! Keeps the shape of the source: a stage knows the stages before it and `math`, never a later one, and no file
//! grows beyond what a reader can hold.

// A test that cannot go on fails.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};

/// Every module in the order in which the data goes. A module may use those before it.
const ORDER: [&str; 18] = [
    "files", "math", "plan", "walls", "routes", "motion", "crowd", "patterns", "marks", "stamps", "sums", "look",
    "export", "scenario", "source", "bake", "walk", "cli",
];
/// What everybody may use: the error and the progress that a whole run shares.
const SHARED: [&str; 6] = ["Error", "Progress", "Silent", "Stage", "Stopwatch", "progress"];
/// Longest file, lines.
const LONGEST: usize = 600;

fn rust_files(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, out);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            out.push(path);
        }
    }
}

fn files_in(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    rust_files(&root.join(folder), &mut files);
    files.sort();
    files
}

/// The modules and items that follow `crate::` (in the binary `trodden::`) in code, comments left out.
fn uses(text: &str) -> Vec<String> {
    let code: String = text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n");
    let mut found = Vec::new();
    for prefix in ["crate::", "trodden::"] {
        for (at, _) in code.match_indices(prefix) {
            if code[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_') {
                continue;
            }
            let rest = &code[at + prefix.len()..];
            match rest.strip_prefix('{') {
                Some(list) => {
                    let mut depth = 0;
                    let mut name = String::new();
                    for c in list.chars() {
                        match c {
                            '}' if depth == 0 => break,
                            '{' => depth += 1,
                            '}' => depth -= 1,
                            ',' if depth == 0 => found.push(std::mem::take(&mut name)),
                            c if depth == 0 => name.push(c),
                            _ => {}
                        }
                    }
                    found.push(name);
                }
                None => found.push(rest.to_string()),
            }
        }
    }
    let first_name = |path: &String| path.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    found.iter().map(first_name).filter(|name: &String| !name.is_empty()).collect()
}

#[test]
fn a_stage_uses_earlier_stages_only() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut mistakes = Vec::new();
    for file in files_in("src") {
        let inside = file.strip_prefix(&src).unwrap();
        let module = inside.components().next().unwrap().as_os_str().to_str().unwrap().trim_end_matches(".rs");
        let Some(rank) = ORDER.iter().position(|known| *known == module) else {
            assert!(["lib", "main", "error", "progress"].contains(&module), "{module} has no place in ORDER");
            continue;
        };
        // Tests may go ahead: they look at what becomes of a stage's work.
        if inside.components().any(|part| part.as_os_str() == "tests" || part.as_os_str() == "tests.rs") {
            continue;
        }
        let text = fs::read_to_string(&file).unwrap();
        for used in uses(text.split("#[cfg(test)]\nmod ").next().unwrap_or("")) {
            match ORDER.iter().position(|known| *known == used) {
                Some(other) if other > rank => mistakes.push(format!("{}: uses {used}", inside.display())),
                None if !SHARED.contains(&used.as_str()) => {
                    mistakes.push(format!("{}: uses crate::{used}, which has no place in ORDER", inside.display()));
                }
                _ => {}
            }
        }
    }
    assert!(mistakes.is_empty(), "{}", mistakes.join("\n"));
}

#[test]
fn the_scan_sees_what_it_is_meant_to_see() {
    let text = "use crate::math::Vec2;\nuse crate::{plan, walls::{Face, Walls}, Error};\n// use crate::look::X;\n\
                fn f() { crate::sums::add(); my_crate::other(); }\nuse trodden::export::Report;";
    assert_eq!(uses(text), ["math", "plan", "walls", "Error", "sums", "export"]);
}

#[test]
fn no_file_is_too_long() {
    let mut long = Vec::new();
    for folder in ["src", "tests", "examples", "benches"] {
        if !Path::new(env!("CARGO_MANIFEST_DIR")).join(folder).exists() {
            continue;
        }
        for file in files_in(folder) {
            let lines = fs::read_to_string(&file).unwrap().lines().count();
            if lines > LONGEST {
                long.push(format!("{}: {lines} lines, at most {LONGEST}", file.display()));
            }
        }
    }
    assert!(long.is_empty(), "{}", long.join("\n"));
}
