//! Deflate and zlib streams (RFC 1950, 1951), compressed in parts by several threads.

use flate2::{Compress, Compression, FlushCompress, Status};

/// Position of a compressed part in its stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// More parts follow. It ends on a byte, so that parts compressed separately can be concatenated.
    Middle,
    /// The part that ends the stream.
    Last,
}

/// Deflate level, the fastest.
///
/// PNG's filter and EXR's predictor leave noise around zero with few repeated strings: a longer search gains nothing.
const LEVEL: u32 = 1;

/// Header of a zlib stream: deflate, window of 32 KiB, fastest.
pub(super) const ZLIB_HEADER: [u8; 2] = [0x78, 0x01];

/// Appends a whole zlib stream.
pub(super) fn zlib(input: &[u8], out: &mut Vec<u8>) {
    out.extend_from_slice(&ZLIB_HEADER);
    deflate(input, Part::Last, out);
    out.extend_from_slice(&adler32(input).to_be_bytes());
}

/// Returns a zlib stream of `count` zeros, as small as possible: it is written many times.
pub(super) fn zlib_zeros(count: usize) -> Vec<u8> {
    let (zeros, mut out) = (vec![0; count], ZLIB_HEADER.to_vec());
    deflate_at(Compression::best(), &zeros, Part::Last, &mut out);
    out.extend_from_slice(&adler32(&zeros).to_be_bytes());
    out
}

/// Appends `input` as complete deflate blocks.
pub(super) fn deflate(input: &[u8], part: Part, out: &mut Vec<u8>) {
    deflate_at(Compression::new(LEVEL), input, part, out);
}

fn deflate_at(level: Compression, input: &[u8], part: Part, out: &mut Vec<u8>) {
    let mut compress = Compress::new(level, false);
    let flush = if part == Part::Last { FlushCompress::Finish } else { FlushCompress::Sync };
    loop {
        // Incompressible input becomes stored blocks: 64 KiB each with a header of five bytes.
        out.reserve(input.len() / 2 + 1024);
        let read = compress.total_in() as usize;
        let status = compress.compress_vec(&input[read..], out, flush).expect("no state of a fresh stream is wrong");
        let done = compress.total_in() as usize == input.len() && out.len() < out.capacity();
        if status == Status::StreamEnd || (part == Part::Middle && done) {
            return;
        }
    }
}

/// Adler-32 of some bytes.
pub(super) fn adler32(data: &[u8]) -> u32 {
    simd_adler32::adler32(&data)
}

/// Combines the checksums of two adjacent pieces, the second of `length` bytes.
pub(super) fn adler32_joined(first: u32, second: u32, length: u64) -> u32 {
    let modulus = 65_521;
    let (a1, b1) = (u64::from(first & 0xffff), u64::from(first >> 16));
    let (a2, b2) = (u64::from(second & 0xffff), u64::from(second >> 16));
    let a = (a1 + a2 + modulus - 1) % modulus;
    let b = (b1 + b2 + (length % modulus) * (a1 + modulus - 1)) % modulus;
    (b << 16 | a) as u32
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Decompresses a zlib stream with the `png` crate, as the pixels of a grey image of one row.
    fn inflated(stream: &[u8], length: usize) -> Vec<u8> {
        use super::super::png::{Signature, chunk};
        let mut file = Signature::BYTES.to_vec();
        let header = [&(length as u32).to_be_bytes()[..], &1u32.to_be_bytes(), &[8, 0, 0, 0, 0]].concat();
        chunk(b"IHDR", &header, &mut file);
        chunk(b"IDAT", stream, &mut file);
        chunk(b"IEND", &[], &mut file);
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut pixels = vec![0; length];
        reader.next_frame(&mut pixels).unwrap();
        pixels
    }

    fn assert_survives(bytes: &[u8]) {
        let mut input = vec![0]; // the row's filter: none
        input.extend_from_slice(bytes);
        let mut stream = Vec::new();
        zlib(&input, &mut stream);
        assert_eq!(inflated(&stream, bytes.len()), bytes);
        // The same input in two separately compressed parts.
        let mut parts = ZLIB_HEADER.to_vec();
        let (head, tail) = input.split_at(input.len() / 2);
        deflate(head, Part::Middle, &mut parts);
        deflate(tail, Part::Last, &mut parts);
        let sum = adler32_joined(adler32(head), adler32(tail), tail.len() as u64);
        assert_eq!(sum, adler32(&input));
        parts.extend_from_slice(&sum.to_be_bytes());
        assert_eq!(inflated(&parts, bytes.len()), bytes);
    }

    #[test]
    fn runs_of_every_length_survive() {
        for run in (1..600).chain([65_535, 65_536, 65_537, 200_000]) {
            let mut bytes = vec![7; run];
            bytes.extend_from_slice(&[1, 2, 3, 4, 5]);
            assert_survives(&bytes);
        }
    }

    #[test]
    fn noise_hardly_grows() {
        let mut random = crate::math::SplitMix64::new(1);
        let noise: Vec<u8> = (0..200_000).map(|_| random.next_u64() as u8).collect();
        assert_survives(&noise);
        let mut stream = Vec::new();
        zlib(&noise, &mut stream);
        assert!(stream.len() < noise.len() + noise.len() / 16, "{} bytes", stream.len());
    }

    #[test]
    fn zeros_all_but_vanish() {
        let mut stream = Vec::new();
        zlib(&[0; 1 << 20], &mut stream);
        assert!(stream.len() < (1 << 20) / 64, "{} bytes", stream.len());
    }

    #[test]
    fn the_check_sum_is_that_of_the_standard() {
        assert_eq!(adler32(b"Wikipedia"), 0x11e6_0398);
        assert_eq!(adler32(b""), 1);
        let bytes: Vec<u8> = (0..10_001u32).map(|k| (k * k) as u8).collect();
        let naive = bytes.iter().fold((1, 0), |(a, b), &byte| {
            let a = (a + u32::from(byte)) % 65_521;
            (a, (b + a) % 65_521)
        });
        assert_eq!(adler32(&bytes), naive.1 << 16 | naive.0);
        assert_eq!(adler32(&[255; 100_000]), adler32_joined(adler32(&[255; 33_333]), adler32(&[255; 66_667]), 66_667));
    }

    proptest! {
        #[test]
        fn everything_survives(groups in proptest::collection::vec((any::<u8>(), 1usize..400, 0u8..4), 1..300)) {
            // Runs, and residuals around zero.
            let mut bytes = Vec::new();
            for (value, count, kind) in groups {
                match kind {
                    0 => bytes.extend(std::iter::repeat_n(value, count)),
                    1 => bytes.extend((0..count).map(|k| (k % 3) as u8)),
                    _ => bytes.push(value),
                }
            }
            assert_survives(&bytes);
        }
    }
}
