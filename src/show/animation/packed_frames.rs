use std::io::{Read, Write};

use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;

/// Pictures in a row, packed: an hour of a crowd takes some megabytes.
#[derive(Clone, Debug, Default)]
pub(super) struct PackedFrames {
    pictures: Vec<Vec<u8>>,
}

impl PackedFrames {
    pub(super) fn len(&self) -> usize {
        self.pictures.len()
    }

    pub(super) fn push(&mut self, indices: &[u8]) {
        let mut packer = DeflateEncoder::new(Vec::new(), Compression::fast());
        packer.write_all(indices).expect("memory does not fail");
        self.pictures.push(packer.finish().expect("memory does not fail"));
    }

    /// Drops every other picture.
    pub(super) fn halve(&mut self) {
        let mut keep = false;
        self.pictures.retain(|_| {
            keep = !keep;
            keep
        });
    }

    /// All pictures, one after the other.
    pub(super) fn pictures(&self) -> impl Iterator<Item = Vec<u8>> {
        self.pictures.iter().map(|packed| {
            let mut indices = Vec::new();
            DeflateDecoder::new(&packed[..]).read_to_end(&mut indices).expect("it was packed here");
            indices
        })
    }
}
