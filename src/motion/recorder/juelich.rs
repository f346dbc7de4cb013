use std::io::{self, Write};

use super::{PER_UNIT, Place, Sheet};

/// Juelich trajectory text: a line for everybody in every frame.
pub(super) struct JuelichText<W: Write> {
    out: W,
    line: Vec<u8>,
    bytes: u64,
}

impl<W: Write> JuelichText<W> {
    pub(super) fn begin(out: W, fps: f64) -> io::Result<JuelichText<W>> {
        let mut text = JuelichText { out, line: Vec::new(), bytes: 0 };
        // The names and units of the columns, in a form by which PedPy knows that places are in metres.
        let head = format!(
            "# trodden {}: middles of bodies; z is the person's height\n# framerate: {}\n# id frame x/m y/m z/m\n",
            env!("CARGO_PKG_VERSION"),
            rate(fps)
        );
        text.write(head.as_bytes())?;
        Ok(text)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.bytes += bytes.len() as u64;
        self.out.write_all(bytes)
    }
}

/// A frame rate with two decimals as is the custom, with more where it needs them.
fn rate(fps: f64) -> String {
    let short = format!("{fps:.2}");
    if short.parse() == Ok(fps) { short } else { fps.to_string() }
}

impl<W: Write + Send> Sheet for JuelichText<W> {
    fn frame(&mut self, number: u64, places: &[Place]) -> io::Result<()> {
        let mut line = std::mem::take(&mut self.line);
        for place in places {
            line.clear();
            write!(line, "{} {number}", place.id)?;
            for value in [place.at.x, place.at.y, place.height_m] {
                decimal(value, &mut line)?;
            }
            line.push(b'\n');
            self.write(&line)?;
        }
        self.line = line;
        Ok(())
    }

    fn close(mut self: Box<Self>) -> io::Result<u64> {
        self.out.flush()?;
        Ok(self.bytes)
    }
}

/// Appends a blank and a number with four decimals.
fn decimal(value: f64, out: &mut Vec<u8>) -> io::Result<()> {
    let parts = (value * PER_UNIT).round() as i64;
    let sign = if parts < 0 { "-" } else { "" };
    let parts = parts.unsigned_abs();
    write!(out, " {sign}{}.{:04}", parts / PER_UNIT as u64, parts % PER_UNIT as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_four_decimals_and_zero_no_sign() {
        let written = |value: f64| {
            let mut out = Vec::new();
            decimal(value, &mut out).unwrap();
            String::from_utf8(out).unwrap()
        };
        assert_eq!([12.34567, -0.00004, -0.5, 3.0].map(written), [" 12.3457", " 0.0000", " -0.5000", " 3.0000"]);
    }

    #[test]
    fn rates_have_two_decimals_or_as_many_as_they_need() {
        assert_eq!([10.0, 12.5, 1.0 / 0.03].map(rate), ["10.00", "12.50", "33.333333333333336"]);
    }
}
