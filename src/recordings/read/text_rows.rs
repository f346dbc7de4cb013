use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::columns::{ColumnUnit, Role};
use super::error::{LINES, RecordingError};
use super::input::{LONGEST_LINE, LineReader, Trouble};
use super::layout::{TextLayout, TextLine, slot};
use super::number::number;
use super::row::{ID_LIMIT, Numbering, Passed, ReadStop, TrajectoryRow};
use crate::math::{Vec2, sin_cos, vec2};
use crate::motion::Statures;

/// The rows of a text.
pub(super) struct TextRows {
    path: PathBuf,
    lines: LineReader,
    layout: Arc<TextLayout>,
    numbering: Numbering,
    numbers: HashMap<Box<[u8]>, u32>,
    passed: Passed,
    extras: Extras,
    /// Metres per unit of body heights, if they are recorded.
    heights_in_m: Option<f64>,
    statures: Statures,
}

/// The optional columns that exist.
struct Extras {
    velocity: bool,
    heading: bool,
    /// Radians per unit of the angle.
    angle: Option<f64>,
    until: bool,
}

impl TextRows {
    pub fn open(path: &Path, layout: &Arc<TextLayout>, numbering: Numbering) -> Result<TextRows, RecordingError> {
        let lines = LineReader::open(path).map_err(|trouble| unreadable(path, trouble, 0))?;
        let extras = Extras {
            velocity: layout.has(&[Role::VelocityX, Role::VelocityY]),
            heading: layout.has(&[Role::HeadingX, Role::HeadingY]),
            angle: layout.column(Role::HeadingAngle).and_then(|at| match layout.columns[at].unit {
                Some(ColumnUnit::Angle(radians)) => Some(radians),
                _ => None,
            }),
            until: layout.has(&[Role::EndTime, Role::EndX, Role::EndY]),
        };
        let mut rows = TextRows {
            path: path.to_path_buf(),
            lines,
            layout: Arc::clone(layout),
            numbering,
            numbers: HashMap::new(),
            passed: Passed::default(),
            extras,
            heights_in_m: None,
            statures: Statures::default(),
        };
        for _ in 0..layout.head_lines {
            rows.lines.next().map_err(|trouble| unreadable(path, trouble, rows.lines.number()))?;
        }
        Ok(rows)
    }

    /// Starts to record body heights while rows are read.
    pub fn note_statures(&mut self) {
        self.heights_in_m = self.layout.heights.map(|unit| unit.metres());
    }

    /// The recorded body heights.
    pub fn statures(&self) -> Statures {
        self.statures.clone()
    }

    pub fn passed(&self) -> Passed {
        self.passed
    }

    pub fn share_done(&self) -> f64 {
        self.lines.share_read()
    }

    pub fn next(&mut self) -> Result<Option<TrajectoryRow>, ReadStop> {
        loop {
            let range = self.lines.next().map_err(|trouble| unreadable(&self.path, trouble, self.lines.number()))?;
            let Some(range) = range else { return Ok(None) };
            let text = self.lines.text(range.clone()).trim_ascii_end();
            let line = match self.layout.read(text) {
                Ok(_) if self.lines.breaks_off() && self.is_cut_off(text) => {
                    self.passed.broken = Some(self.lines.number());
                    return Ok(None);
                }
                Ok(line) => line,
                Err(problem) => {
                    if self.may_be_skipped(text) {
                        continue;
                    }
                    if text.first() == Some(&b'$') {
                        // The next table of a Viswalk file begins here.
                        return Ok(None);
                    }
                    let number = self.lines.number();
                    if problem.short && self.lines.breaks_off() {
                        self.passed.broken = Some(number);
                        return Ok(None);
                    }
                    let error = RecordingError::Line {
                        path: self.path.clone(),
                        line: number,
                        problem: problem.text,
                        hint: problem.hint.to_owned(),
                    };
                    return Err(error.into());
                }
            };
            let [x, y] = [Role::X, Role::Y].map(|role| line.values[slot(role)]);
            if x.is_nan() || y.is_nan() {
                self.passed.nowhere += 1;
                if self.passed.nowhere == 1 {
                    self.passed.first_nowhere = self.lines.number();
                }
                continue;
            }
            let id = match self.numbering {
                Numbering::Own => whole(line.id).ok_or(ReadStop::Name)?,
                Numbering::Appearance => {
                    let next = self.numbers.len() as u32 + 1;
                    match self.numbers.get(line.id) {
                        Some(&id) => id,
                        None => *self.numbers.entry(line.id.into()).or_insert(next),
                    }
                }
            };
            if let Some(metres) = self.heights_in_m {
                self.statures.note(id, line.values[slot(Role::Height)] * metres);
            }
            return Ok(Some(self.row(id, &line)));
        }
    }

    fn row(&self, id: u32, line: &TextLine<'_>) -> TrajectoryRow {
        let pair = |x: Role, y: Role| {
            let pair = vec2(line.values[slot(x)], line.values[slot(y)]);
            pair.is_finite().then_some(pair)
        };
        let Extras { velocity, heading, angle, until } = self.extras;
        let end_time = line.values[slot(Role::EndTime)];
        TrajectoryRow {
            id,
            line: self.lines.number(),
            time: line.time,
            at: vec2(line.values[slot(Role::X)], line.values[slot(Role::Y)]),
            velocity: if velocity { pair(Role::VelocityX, Role::VelocityY) } else { None },
            heading: match (heading, angle) {
                (true, _) => pair(Role::HeadingX, Role::HeadingY).and_then(Vec2::normalized),
                (false, Some(radians)) => direction(radians * line.values[slot(Role::HeadingAngle)]),
                (false, None) => None,
            },
            until: if until && end_time > line.time {
                pair(Role::EndX, Role::EndY).map(|end| (end_time, end))
            } else {
                None
            },
        }
    }

    /// Whether a line is a comment, empty, or a repeated header, as in joined files.
    #[cold]
    fn may_be_skipped(&self, text: &[u8]) -> bool {
        let text = text.trim_ascii_start();
        text.is_empty() || matches!(text[0], b'#' | b'*') || self.layout.header.as_deref() == Some(text)
    }

    /// Whether the last line was cut off: it has fewer columns than the others.
    #[cold]
    fn is_cut_off(&self, text: &[u8]) -> bool {
        self.layout.separator.split(text).len() < self.layout.width
    }
}

/// The unit vector at an angle.
fn direction(angle_rad: f64) -> Option<Vec2> {
    let (sin, cos) = sin_cos(angle_rad);
    Some(vec2(cos, sin)).filter(|direction| direction.is_finite())
}

/// Describes why a file cannot be read, after `lines` lines.
pub(super) fn unreadable(path: &Path, trouble: Trouble, lines: u64) -> RecordingError {
    let after = if lines > 0 { format!(" (after line {lines})") } else { String::new() };
    let (problem, hint) = match trouble {
        Trouble::System(error) => (format!("{error}{after}"), hint_of(&error)),
        Trouble::BreaksOff => (
            format!("the compressed file breaks off{after}"),
            "get it again, or unpack what there is: gzip -dc FILE > part.txt",
        ),
        Trouble::Damaged => (format!("the compressed file is damaged{after}"), "get it again"),
        Trouble::LongLine => {
            let problem = format!("the line is longer than {LONGEST_LINE} bytes");
            return RecordingError::Line { path: path.to_path_buf(), line: lines + 1, problem, hint: LINES.to_owned() };
        }
    };
    RecordingError::Unreadable { path: path.to_path_buf(), problem, hint }
}

fn hint_of(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::NotFound => "paths start from the folder that you are in",
        io::ErrorKind::IsADirectory => "it is a folder: name a file in it",
        io::ErrorKind::PermissionDenied => "you may not read it: ask whoever owns it, or copy it",
        _ => "try again, or copy the file to another disk",
    }
}

/// Returns an id that is a whole number below [`ID_LIMIT`].
#[inline]
fn whole(id: &[u8]) -> Option<u32> {
    let value = number(id)?;
    ((0.0..ID_LIMIT).contains(&value) && value == value.trunc()).then_some(value as u32)
}
