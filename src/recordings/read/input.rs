//! Line reader for text files, plain or gzipped.

use std::fs::File;
use std::io::{self, Read};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use flate2::bufread::MultiGzDecoder;

use crate::files::open_input;

/// Bytes per read.
const CHUNK: usize = 1 << 18;
/// Longest allowed line, bytes.
pub(super) const LONGEST_LINE: usize = 1 << 20;
/// First bytes of a gzip file.
pub(super) const GZIP: [u8; 2] = [0x1f, 0x8b];
/// Byte order mark with which some programs begin UTF-8.
const BOM: [u8; 3] = [0xef, 0xbb, 0xbf];

/// Errors of the line reader.
#[derive(Debug)]
pub(super) enum Trouble {
    /// Error of the operating system.
    System(io::Error),
    /// The gzip file is truncated.
    BreaksOff,
    /// The gzip file is damaged.
    Damaged,
    /// The next line exceeds [`LONGEST_LINE`].
    LongLine,
}

impl From<io::Error> for Trouble {
    fn from(error: io::Error) -> Trouble {
        Trouble::System(error)
    }
}

/// A file that counts the bytes read.
struct Counted {
    file: File,
    bytes: Arc<AtomicU64>,
}

impl Read for Counted {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let bytes = self.file.read(into)?;
        self.bytes.fetch_add(bytes as u64, Ordering::Relaxed);
        Ok(bytes)
    }
}

/// Reads a text file line by line through a buffer that holds whole lines.
pub(super) struct LineReader {
    input: Box<dyn Read + Send>,
    packed: bool,
    buffer: Vec<u8>,
    /// Range of the buffer that was not yet returned.
    rest: Range<usize>,
    ended: bool,
    number: u64,
    read: Arc<AtomicU64>,
    length: u64,
}

impl LineReader {
    pub fn open(path: &Path) -> Result<LineReader, Trouble> {
        let mut magic = [0; 2];
        let packed = fill(&mut open_input(path)?, &mut magic)? == 2 && magic == GZIP;
        let file = open_input(path)?;
        let length = file.metadata()?.len();
        let read = Arc::new(AtomicU64::new(0));
        let counted = Counted { file, bytes: Arc::clone(&read) };
        let input: Box<dyn Read + Send> = if packed {
            Box::new(MultiGzDecoder::new(io::BufReader::with_capacity(CHUNK, counted)))
        } else {
            Box::new(counted)
        };
        let buffer = vec![0; 2 * CHUNK];
        let mut lines = LineReader { input, packed, buffer, rest: 0..0, ended: false, number: 0, read, length };
        lines.fill()?;
        if lines.buffer[lines.rest.clone()].starts_with(&BOM) {
            lines.rest.start += BOM.len();
        }
        Ok(lines)
    }

    /// The buffered text, after opening the file's beginning, and whether it is the entire file.
    pub fn head(&self) -> (&[u8], bool) {
        (&self.buffer[self.rest.clone()], self.ended)
    }

    /// Returns the next line without its end, as a range of [`LineReader::text`].
    pub fn next(&mut self) -> Result<Option<Range<usize>>, Trouble> {
        loop {
            let unread = &self.buffer[self.rest.clone()];
            if let Some(length) = memchr::memchr(b'\n', unread) {
                let line = self.rest.start..self.rest.start + length;
                self.rest.start += length + 1;
                self.number += 1;
                return Ok(Some(line));
            }
            if self.ended {
                if unread.is_empty() {
                    return Ok(None);
                }
                let line = self.rest.clone();
                self.rest.start = self.rest.end;
                self.number += 1;
                return Ok(Some(line));
            }
            if unread.len() > LONGEST_LINE {
                return Err(Trouble::LongLine);
            }
            self.fill()?;
        }
    }

    pub fn text(&self, line: Range<usize>) -> &[u8] {
        &self.buffer[line]
    }

    /// Number of the last line, from 1.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Whether the line read last is the file's last and has no line end.
    pub fn breaks_off(&self) -> bool {
        self.ended && self.rest.is_empty() && self.rest.end > 0 && self.buffer[self.rest.end - 1] != b'\n'
    }

    /// Share of the file read so far, 0..=1.
    pub fn share_read(&self) -> f64 {
        let unread = if self.length == 0 { 0 } else { self.rest.len() as u64 };
        let read = self.read.load(Ordering::Relaxed).saturating_sub(unread.min(self.length));
        (read as f64 / self.length.max(1) as f64).min(1.0)
    }

    /// Moves the unread part to the front and reads on.
    fn fill(&mut self) -> Result<(), Trouble> {
        self.buffer.copy_within(self.rest.clone(), 0);
        self.rest = 0..self.rest.len();
        if self.buffer.len() < self.rest.end + CHUNK {
            self.buffer.resize(self.rest.end + CHUNK, 0);
        }
        let packed = self.packed;
        let bytes = fill(&mut self.input, &mut self.buffer[self.rest.end..]).map_err(|error| match error.kind() {
            io::ErrorKind::UnexpectedEof if packed => Trouble::BreaksOff,
            io::ErrorKind::InvalidInput | io::ErrorKind::InvalidData if packed => Trouble::Damaged,
            _ => Trouble::System(error),
        })?;
        self.ended = bytes < self.buffer.len() - self.rest.end;
        self.rest.end += bytes;
        Ok(())
    }
}

/// Reads until the buffer is full or the input ends.
fn fill(input: &mut impl Read, buffer: &mut [u8]) -> io::Result<usize> {
    let mut filled = 0;
    while filled < buffer.len() {
        match input.read(&mut buffer[filled..]) {
            Ok(0) => break,
            Ok(bytes) => filled += bytes,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(filled)
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    fn lines_of(bytes: &[u8]) -> Result<Vec<Vec<u8>>, Trouble> {
        let mut file = tempfile::NamedTempFile::new().unwrap();
        file.write_all(bytes).unwrap();
        let mut lines = LineReader::open(file.path())?;
        let mut found = Vec::new();
        while let Some(line) = lines.next()? {
            found.push(lines.text(line).to_vec());
        }
        assert_eq!(lines.number(), found.len() as u64);
        assert!(lines.share_read() == 1.0 || bytes.is_empty());
        Ok(found)
    }

    #[test]
    fn lines_come_whole_over_the_ends_of_chunks() {
        let text: Vec<String> = (0..90_000).map(|k| "z".repeat(k % 37)).collect();
        assert!(text.iter().map(String::len).sum::<usize>() > 4 * CHUNK);
        let found = lines_of(text.join("\n").as_bytes()).unwrap();
        assert_eq!(found.len(), text.len());
        assert!(found.iter().zip(&text).all(|(a, b)| a == b.as_bytes()));
        assert_eq!(lines_of(b"\xef\xbb\xbfa\n\nb").unwrap(), [b"a".to_vec(), b"".to_vec(), b"b".to_vec()]);
        assert!(lines_of(b"").unwrap().is_empty());
    }

    #[test]
    fn packed_files_are_unpacked_and_what_breaks_off_is_an_error() {
        let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        packed.write_all(b"one\ntwo\n").unwrap();
        let packed = packed.finish().unwrap();
        assert_eq!(lines_of(&packed).unwrap(), [b"one", b"two"]);
        for cut in [1, 9, packed.len() - 11] {
            assert!(matches!(lines_of(&packed[..packed.len() - cut]), Err(Trouble::BreaksOff)), "{cut}");
        }
        let mut damaged = packed.clone();
        damaged[10] = 0xff;
        assert!(matches!(lines_of(&damaged), Err(Trouble::Damaged)));
    }

    #[test]
    fn a_line_without_end_is_an_error() {
        assert!(matches!(lines_of(&vec![b'1'; 3 << 20]), Err(Trouble::LongLine)));
    }
}
