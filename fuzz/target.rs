//! A reader of the program under libFuzzer: the one that the binary is named after.
#![no_main]
// The tests use more of their helpers.
#![allow(dead_code)]

use std::path::Path;
use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;

#[path = "../tests/formats/building.rs"]
mod building;
#[path = "../tests/formats/readers.rs"]
mod readers;
#[path = "../tests/formats/write.rs"]
mod write;

use readers::{Bench, READERS, Reader};

const NAME: &str = env!("CARGO_BIN_NAME");

static BENCH: LazyLock<Bench> = LazyLock::new(Bench::new);
static READER: LazyLock<&Reader> =
    LazyLock::new(|| READERS.iter().find(|reader| reader.name == NAME).expect("a binary is named after a reader"));

/// Puts the whole inputs beside what earlier runs found.
fn keep_seeds() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(NAME);
    std::fs::create_dir_all(&corpus).expect("the corpus is writable");
    for (number, seed) in (READER.seeds)(&BENCH).iter().enumerate() {
        std::fs::write(corpus.join(format!("seed{number}")), seed).expect("the corpus is writable");
    }
}

fuzz_target!(init: keep_seeds(), |bytes: &[u8]| {
    (READER.read)(&BENCH, bytes);
});
