//! Text formats: the output file, frame times, numbers.

use std::io::{self, Write};

use flate2::Compression;
use flate2::write::GzEncoder;

use super::place::{PER_UNIT, RecordedPlace};
use super::sheet::MotionSink;

/// Layout of a text format.
pub(super) trait LineFormat: Send {
    /// Text before the first row.
    fn head(&self) -> String;

    /// Appends the lines that are complete with this frame. Every frame must be given, in order.
    fn frame(&mut self, number: u64, places: &[RecordedPlace], lines: &mut LineBuffer);

    /// Appends the lines that are left after the last frame.
    fn rest(&mut self, _lines: &mut LineBuffer) {}
}

/// A text file that is being written.
pub(super) struct Text<W: Write> {
    out: Out<W>,
    layout: Box<dyn LineFormat>,
    lines: LineBuffer,
    bytes: u64,
}

impl<W: Write> Text<W> {
    pub fn begin(out: Out<W>, layout: Box<dyn LineFormat>) -> io::Result<Text<W>> {
        let mut text = Text { out, layout, lines: LineBuffer::default(), bytes: 0 };
        text.lines.0.extend_from_slice(text.layout.head().as_bytes());
        text.write()?;
        Ok(text)
    }

    fn write(&mut self) -> io::Result<()> {
        self.bytes += self.lines.0.len() as u64;
        self.out.write_all(&self.lines.0)?;
        self.lines.0.clear();
        Ok(())
    }
}

impl<W: Write + Send> MotionSink for Text<W> {
    fn frame(&mut self, number: u64, places: &[RecordedPlace]) -> io::Result<()> {
        self.layout.frame(number, places, &mut self.lines);
        self.write()
    }

    fn close(mut self: Box<Self>) -> io::Result<u64> {
        self.layout.rest(&mut self.lines);
        self.write()?;
        self.out.close()?;
        Ok(self.bytes)
    }
}

/// Output of a text, plain or gzipped.
pub(super) enum Out<W: Write> {
    Plain(W),
    Packed(Box<GzEncoder<W>>),
}

impl<W: Write> Out<W> {
    /// Gzips the output. The gzip header has no name or time, so the same text gives the same bytes.
    pub fn packed(out: W) -> Out<W> {
        Out::Packed(Box::new(GzEncoder::new(out, Compression::default())))
    }

    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        match self {
            Out::Plain(out) => out.write_all(bytes),
            Out::Packed(out) => out.write_all(bytes),
        }
    }

    fn close(self) -> io::Result<()> {
        match self {
            Out::Plain(mut out) => out.flush(),
            Out::Packed(out) => out.finish()?.flush(),
        }
    }
}

/// Times of frames by number.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrameClock {
    fps: f64,
    /// Decimals of a written second.
    decimals: usize,
}

/// Largest number of decimals of a second.
const MICROSECONDS: usize = 6;

impl FrameClock {
    /// Uses as many decimals as exact times need, from two up to microseconds.
    pub fn new(fps: f64) -> FrameClock {
        let exact = |decimals: &usize| {
            let parts = TENS[*decimals] / fps;
            (parts - parts.round()).abs() < 1e-9
        };
        FrameClock { fps, decimals: (2..MICROSECONDS).find(exact).unwrap_or(MICROSECONDS) }
    }

    fn seconds(self, number: u64) -> f64 {
        number as f64 / self.fps
    }
}

/// Powers of ten.
const TENS: [f64; 7] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6];
/// Values below this, in units of the last decimal, are formatted with integers.
const EXACT: f64 = 9e15;

/// A buffer for lines of text.
#[derive(Debug, Default)]
pub(super) struct LineBuffer(Vec<u8>);

impl LineBuffer {
    pub fn text(&mut self, text: &str) -> &mut LineBuffer {
        self.0.extend_from_slice(text.as_bytes());
        self
    }

    pub fn whole(&mut self, value: impl Into<u64>) -> &mut LineBuffer {
        // Writing to memory cannot fail.
        let _ = write!(self.0, "{}", value.into());
        self
    }

    /// A length, speed or share with four decimals.
    pub fn metres(&mut self, value: f64) -> &mut LineBuffer {
        self.decimal(value, PER_UNIT, 4)
    }

    /// The time of a frame in seconds.
    pub fn seconds(&mut self, clock: FrameClock, number: u64) -> &mut LineBuffer {
        self.decimal(clock.seconds(number), TENS[clock.decimals], clock.decimals)
    }

    /// An angle in degrees with two decimals.
    pub fn degrees(&mut self, value: f64) -> &mut LineBuffer {
        self.decimal(value, TENS[2], 2)
    }

    /// Appends a number with fixed decimals. Zero has no sign.
    fn decimal(&mut self, value: f64, per_unit: f64, decimals: usize) -> &mut LineBuffer {
        let parts = (value * per_unit).round();
        let _ = if parts.abs() < EXACT {
            let (parts, per_unit) = (parts as i64, per_unit as u64);
            let sign = if parts < 0 { "-" } else { "" };
            let parts = parts.unsigned_abs();
            write!(self.0, "{sign}{}.{:0decimals$}", parts / per_unit, parts % per_unit)
        } else {
            write!(self.0, "{value:.decimals$}")
        };
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(write: impl Fn(&mut LineBuffer) -> &mut LineBuffer) -> String {
        let mut line = LineBuffer::default();
        write(&mut line);
        String::from_utf8(line.0).unwrap()
    }

    #[test]
    fn numbers_have_four_decimals_and_zero_no_sign() {
        let metres = |value: f64| written(|line| line.metres(value));
        assert_eq!([12.34567, -0.00004, -0.5, 3.0].map(metres), ["12.3457", "0.0000", "-0.5000", "3.0000"]);
        assert_eq!([1e15, -1e15].map(metres), ["1000000000000000.0000", "-1000000000000000.0000"]);
        assert_eq!(written(|line| line.degrees(-90.0)), "-90.00");
    }

    #[test]
    fn times_have_the_decimals_that_they_need() {
        let third = |fps: f64| written(|line| line.seconds(FrameClock::new(fps), 3));
        assert_eq!(
            [10.0, 25.0, 16.0, 8.0, 30.0, 29.97, 1000.0, 0.1].map(third),
            ["0.30", "0.12", "0.1875", "0.375", "0.100000", "0.100100", "0.003", "30.00"]
        );
        let late = written(|line| line.seconds(FrameClock::new(30.0), 10_000_000_001));
        assert_eq!(late, "333333333.366667");
    }
}
