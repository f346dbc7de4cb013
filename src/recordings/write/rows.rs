//! Formats with one line per person and frame.

use super::super::RecordingFormat;
use super::place::RecordedPlace;
use super::text::{FrameClock, LineBuffer, LineFormat};
use crate::math::atan2;

/// A format with one line per person and frame.
pub(super) struct RowFormat {
    head: String,
    row: fn(&mut LineBuffer, FrameStamp, &RecordedPlace),
    clock: FrameClock,
}

/// Number and time of a frame.
#[derive(Clone, Copy)]
struct FrameStamp {
    number: u64,
    clock: FrameClock,
}

impl LineFormat for RowFormat {
    fn head(&self) -> String {
        self.head.clone()
    }

    fn frame(&mut self, number: u64, places: &[RecordedPlace], lines: &mut LineBuffer) {
        let moment = FrameStamp { number, clock: self.clock };
        for place in places {
            (self.row)(lines, moment, place);
            lines.text("\n");
        }
    }
}

impl RowFormat {
    /// Returns the layout of a format; `None` for formats without such rows.
    pub fn of(format: RecordingFormat, fps: f64) -> Option<RowFormat> {
        let (head, row): (String, fn(&mut LineBuffer, FrameStamp, &RecordedPlace)) = match format {
            RecordingFormat::Juelich => (juelich_head(fps), juelich),
            RecordingFormat::Csv => ("id,time_s,x_m,y_m,heading_deg,speed_m_s,height_m\n".to_owned(), csv),
            RecordingFormat::Crowdit => ("time,pedID,posX,posY\n".to_owned(), crowdit),
            RecordingFormat::Viswalk => (VISWALK.to_owned(), viswalk),
            RecordingFormat::Pathfinder => ("id,t,x,y\n,s,m,m\n".to_owned(), pathfinder),
            RecordingFormat::Obsmat => (obsmat_head(fps), obsmat),
            RecordingFormat::Jupedsim | RecordingFormat::Vadere => return None,
        };
        Some(RowFormat { head, row, clock: FrameClock::new(fps) })
    }
}

/// Writes names and units of columns in the form from which PedPy detects metres.
fn juelich_head(fps: f64) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let rate = rate(fps);
    format!(
        "# trodden {version}: middles of bodies; z is the person's height\n# framerate: {rate}\n# id frame x/m y/m z/m\n"
    )
}

/// Formats a frame rate with two decimals as usual, or with more where needed.
fn rate(fps: f64) -> String {
    let short = format!("{fps:.2}");
    if short.parse() == Ok(fps) { short } else { fps.to_string() }
}

fn juelich(line: &mut LineBuffer, moment: FrameStamp, place: &RecordedPlace) {
    line.whole(place.id).text(" ").whole(moment.number);
    for value in [place.at.x, place.at.y, place.height_m] {
        line.text(" ").metres(value);
    }
}

fn csv(line: &mut LineBuffer, moment: FrameStamp, place: &RecordedPlace) {
    line.whole(place.id).text(",").seconds(moment.clock, moment.number);
    line.text(",").metres(place.at.x).text(",").metres(place.at.y);
    line.text(",").degrees(atan2(place.facing.y, place.facing.x).to_degrees());
    line.text(",").metres(place.velocity_m_s.length()).text(",").metres(place.height_m);
}

fn crowdit(line: &mut LineBuffer, moment: FrameStamp, place: &RecordedPlace) {
    line.seconds(moment.clock, moment.number).text(",").whole(place.id);
    line.text(",").metres(place.at.x).text(",").metres(place.at.y);
}

/// As in all PTV files, `$` marks the table's name and columns.
const VISWALK: &str = "$VISION\n* Pedestrians\n$PEDESTRIAN:NO;SIMSEC;COORDCENTX;COORDCENTY\n";

fn viswalk(line: &mut LineBuffer, moment: FrameStamp, place: &RecordedPlace) {
    line.whole(place.id).text(";").seconds(moment.clock, moment.number);
    line.text(";").metres(place.at.x).text(";").metres(place.at.y);
}

fn pathfinder(line: &mut LineBuffer, moment: FrameStamp, place: &RecordedPlace) {
    line.whole(place.id).text(",").seconds(moment.clock, moment.number);
    line.text(",").metres(place.at.x).text(",").metres(place.at.y);
}

/// Readers of this format ignore comments and must be given the rate.
fn obsmat_head(fps: f64) -> String {
    format!("# framerate: {}\n# frame id x z y vx vz vy\n", rate(fps))
}

fn obsmat(line: &mut LineBuffer, moment: FrameStamp, place: &RecordedPlace) {
    line.whole(moment.number).text(" ").whole(place.id);
    let velocity = place.velocity_m_s;
    for value in [place.at.x, 0.0, place.at.y, velocity.x, 0.0, velocity.y] {
        line.text(" ").metres(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_have_two_decimals_or_as_many_as_they_need() {
        assert_eq!([10.0, 12.5, 1.0 / 0.03].map(rate), ["10.00", "12.50", "33.333333333333336"]);
    }
}
