//! Rows of a recording, one by one, from wherever they are.

use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::RecordingError;
use super::columns::{Role, Unit};
use super::database::DatabaseRows;
use super::input::{LONGEST_LINE, Lines, Trouble};
use super::layout::{Layout, Line, shown, slot};
use super::memory::MemoryRows;
use super::number::number;
use crate::math::{Vec2, sin_cos, vec2};

/// Ids of files are kept where they are whole numbers below this.
pub(super) const ID_LIMIT: f64 = 1e7;

/// Somebody's place as the file tells it, in its own numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    pub id: u32,
    /// Line, from 1; in a database the row's number.
    pub line: u64,
    pub time: f64,
    pub at: Vec2,
    pub velocity: Option<Vec2>,
    pub heading: Option<Vec2>,
    /// When and where a step ends that begins here.
    pub until: Option<(f64, Vec2)>,
}

/// How people are numbered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Numbering {
    /// As in the file.
    Own,
    /// From 1, as they first appear.
    Appearance,
}

/// What was passed over.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Passed {
    /// Rows without a place, and the line of the first.
    pub nowhere: u64,
    pub first_nowhere: u64,
    /// The last line if it breaks off.
    pub broken: Option<u64>,
}

/// What stops rows from coming.
#[derive(Debug)]
pub(super) enum Stop {
    /// An id that is no whole number below [`ID_LIMIT`]: people have to be numbered.
    Name,
    Error(RecordingError),
}

impl From<RecordingError> for Stop {
    fn from(error: RecordingError) -> Stop {
        Stop::Error(error)
    }
}

/// Where rows come from.
pub(super) enum Rows {
    Text(Box<TextRows>),
    Database(Box<DatabaseRows>),
    Memory(MemoryRows),
}

impl Rows {
    #[inline]
    pub fn next(&mut self) -> Result<Option<Row>, Stop> {
        match self {
            Rows::Text(rows) => rows.next(),
            Rows::Database(rows) => Ok(rows.next()?),
            Rows::Memory(rows) => Ok(rows.next()),
        }
    }

    pub fn share_done(&self) -> f64 {
        match self {
            Rows::Text(rows) => rows.lines.share_read(),
            Rows::Database(rows) => rows.share_done(),
            Rows::Memory(rows) => rows.share_done(),
        }
    }

    pub fn passed(&self) -> Passed {
        match self {
            Rows::Text(rows) => rows.passed,
            Rows::Database(rows) => rows.passed(),
            Rows::Memory(_) => Passed::default(),
        }
    }
}

/// The rows of a text.
pub(super) struct TextRows {
    path: PathBuf,
    lines: Lines,
    layout: Arc<Layout>,
    numbering: Numbering,
    numbers: HashMap<Box<[u8]>, u32>,
    passed: Passed,
    extras: Extras,
}

/// Which columns there are beyond the necessary.
struct Extras {
    velocity: bool,
    heading: bool,
    /// Radians in the unit of an angle.
    angle: Option<f64>,
    until: bool,
}

impl TextRows {
    pub fn open(path: &Path, layout: &Arc<Layout>, numbering: Numbering) -> Result<TextRows, RecordingError> {
        let lines = Lines::open(path).map_err(|trouble| unreadable(path, trouble, 0))?;
        let extras = Extras {
            velocity: layout.has(&[Role::VelocityX, Role::VelocityY]),
            heading: layout.has(&[Role::HeadingX, Role::HeadingY]),
            angle: layout.column(Role::HeadingAngle).and_then(|at| match layout.columns[at].unit {
                Some(Unit::Angle(radians)) => Some(radians),
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
        };
        for _ in 0..layout.head_lines {
            rows.lines.next().map_err(|trouble| unreadable(path, trouble, rows.lines.number()))?;
        }
        Ok(rows)
    }

    fn next(&mut self) -> Result<Option<Row>, Stop> {
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
                        // The next table of a Viswalk file.
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
                Numbering::Own => whole(line.id).ok_or(Stop::Name)?,
                Numbering::Appearance => {
                    let next = self.numbers.len() as u32 + 1;
                    match self.numbers.get(line.id) {
                        Some(&id) => id,
                        None => *self.numbers.entry(line.id.into()).or_insert(next),
                    }
                }
            };
            return Ok(Some(self.row(id, &line)));
        }
    }

    fn row(&self, id: u32, line: &Line<'_>) -> Row {
        let pair = |x: Role, y: Role| {
            let pair = vec2(line.values[slot(x)], line.values[slot(y)]);
            pair.is_finite().then_some(pair)
        };
        let Extras { velocity, heading, angle, until } = self.extras;
        let end_time = line.values[slot(Role::EndTime)];
        Row {
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

    /// Comments, empty lines, and the header where files were joined.
    #[cold]
    fn may_be_skipped(&self, text: &[u8]) -> bool {
        let text = text.trim_ascii_start();
        text.is_empty() || matches!(text[0], b'#' | b'*') || self.layout.header.as_deref() == Some(text)
    }

    /// Whether this is the last line, and has fewer columns than others: then it was cut off.
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

/// What is wrong with a file, of which so many lines were read.
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

/// What recordings look like.
pub(super) const LINES: &str = "a recording has a line for everybody in every frame: who, when, x, y";

fn hint_of(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::NotFound => "paths start from the folder that you are in",
        io::ErrorKind::IsADirectory => "it is a folder: name a file in it",
        io::ErrorKind::PermissionDenied => "you may not read it: ask whoever owns it, or copy it",
        _ => "try again, or copy the file to another disk",
    }
}

/// An id that is a whole number in the range that is kept.
#[inline]
fn whole(id: &[u8]) -> Option<u32> {
    let value = number(id)?;
    ((0.0..ID_LIMIT).contains(&value) && value == value.trunc()).then_some(value as u32)
}

/// Who a row is about, for messages.
pub(super) fn who(id: u32, numbering: Numbering) -> String {
    match numbering {
        Numbering::Own => format!("person {id}"),
        Numbering::Appearance => format!("the person who appears as number {id}"),
    }
}

/// A value of the file for messages.
pub(super) fn moment(time: f64, frames: bool) -> String {
    if frames {
        format!("frame {time}")
    } else {
        format!("time {}", shown(time.to_string().as_bytes()).trim_matches('`'))
    }
}

/// A map from person ids.
pub(super) type ById<T> = FxHashMap<u32, T>;
