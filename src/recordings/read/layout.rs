//! Layout of a text, and the parser of its lines.

use super::columns::{Role, TextColumn};
use super::number::{number, stamp};
use super::{LengthUnit, RecordingFormat};

/// Largest allowed position, frame or time: 1e15.
pub(super) const LARGEST: f64 = 1e15;
/// Largest frame rate that a file may state, 1/s.
pub(super) const HIGHEST_RATE: f64 = 10_000.0;
/// Length to which error messages shorten a value, characters.
const SHOWN: usize = 40;

/// Separator between columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Separator {
    /// Any number of blanks and tabs.
    Blanks,
    /// Exactly one such byte.
    Byte(u8),
}

/// Unit of the time column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TimeColumn {
    Frames,
    /// Times in units of this many seconds; `None` if unknown.
    Times(Option<f64>),
}

/// Layout of a text file.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TextLayout {
    pub format: RecordingFormat,
    pub separator: Separator,
    pub decimal_comma: bool,
    pub columns: Vec<TextColumn>,
    pub clock: TimeColumn,
    /// Number of columns of the first row, ignored ones included.
    pub width: usize,
    /// Number of lines before the first row.
    pub head_lines: u64,
    /// The header line, if it is not a comment.
    pub header: Option<Vec<u8>>,
    /// Stated frames per second.
    pub fps: Option<f64>,
    /// Stated length unit.
    pub unit: Option<LengthUnit>,
    /// Unit of the body heights, if a column holds them.
    pub heights: Option<LengthUnit>,
    /// Messages for the user.
    pub warnings: Vec<String>,
}

/// The values of a line, in the file's own numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TextLine<'a> {
    pub id: &'a [u8],
    pub time: f64,
    /// Values by [`slot`]; NaN where missing.
    pub values: [f64; SLOTS],
}

pub(super) const SLOTS: usize = 11;

/// Index of a role's value in [`TextLine::values`].
pub(super) const fn slot(role: Role) -> usize {
    match role {
        Role::X => 0,
        Role::Y => 1,
        Role::VelocityX => 2,
        Role::VelocityY => 3,
        Role::HeadingX => 4,
        Role::HeadingY => 5,
        Role::EndTime => 6,
        Role::EndX => 7,
        Role::EndY => 8,
        Role::HeadingAngle => 9,
        Role::Z | Role::Height | Role::Id | Role::Frame | Role::Time | Role::Unused => 10,
    }
}

/// Why a line cannot be parsed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LineProblem {
    pub text: String,
    pub hint: &'static str,
    /// Whether the line may have been cut off.
    pub short: bool,
}

impl TextLayout {
    /// Index of the column with this role.
    pub fn column(&self, role: Role) -> Option<usize> {
        self.columns.iter().position(|column| column.role == role)
    }

    /// Index of the column that may hold body heights.
    pub fn heights_column(&self) -> Option<usize> {
        self.column(Role::Height).or_else(|| self.column(Role::Z))
    }

    /// Whether all these roles have a column.
    pub fn has(&self, roles: &[Role]) -> bool {
        roles.iter().all(|&role| self.column(role).is_some())
    }

    /// Sets the unit of body heights and drops surplus columns; without a unit, heights too.
    pub fn with_heights_in(mut self, unit: Option<LengthUnit>) -> TextLayout {
        self.heights = unit;
        let kept = unit.and_then(|_| self.heights_column());
        let heights = self.columns.iter_mut().enumerate();
        let heights = heights.filter(|(at, column)| column.is_height() && Some(*at) != kept);
        heights.for_each(|(_, column)| *column = TextColumn::UNUSED);
        let useful = self.columns.iter().rposition(|column| column.role != Role::Unused).map_or(0, |last| last + 1);
        self.columns.truncate(useful);
        self
    }

    /// Parses a line; only columns behind the last needed one may be missing.
    pub fn read<'a>(&self, line: &'a [u8]) -> Result<TextLine<'a>, LineProblem> {
        let mut read = TextLine { id: b"1", time: f64::NAN, values: [f64::NAN; SLOTS] };
        let mut rest = line;
        for (at, column) in self.columns.iter().enumerate() {
            let field = self.separator.next(&mut rest).or_else(|| self.empty_last(line, at));
            let field = match field {
                Some(field) => field,
                // Body heights are optional.
                None if self.columns[at..].iter().all(|column| !column.is_needed()) => break,
                None => return Err(self.too_short(at)),
            };
            match column.role {
                Role::Unused => {}
                Role::Z | Role::Height => read.values[slot(column.role)] = self.number(field).unwrap_or(f64::NAN),
                Role::Id => read.id = field,
                Role::Frame | Role::Time => read.time = self.moment(field)?,
                role => {
                    let value = self.number(field).ok_or_else(|| not_a_number(role, field))?;
                    if value.abs() > LARGEST {
                        return Err(too_large(role, field));
                    }
                    read.values[slot(role)] = if column.flipped { -value } else { value };
                }
            }
        }
        if read.id.is_empty() {
            return Err(LineProblem { text: "nobody's id".into(), hint: "", short: true });
        }
        Ok(read)
    }

    /// Returns the empty field behind a separator at the end of a line.
    #[cold]
    fn empty_last<'a>(&self, line: &'a [u8], at: usize) -> Option<&'a [u8]> {
        let Separator::Byte(byte) = self.separator else { return None };
        let line = line.trim_ascii();
        (line.last() == Some(&byte) && self.separator.split(line).len() == at).then_some(&[])
    }

    fn number(&self, field: &[u8]) -> Option<f64> {
        if !self.decimal_comma || !field.contains(&b',') {
            return number(field);
        }
        let with_point: Vec<u8> = field.iter().map(|&byte| if byte == b',' { b'.' } else { byte }).collect();
        number(&with_point)
    }

    fn moment(&self, field: &[u8]) -> Result<f64, LineProblem> {
        let frames = self.clock == TimeColumn::Frames;
        let role = if frames { Role::Frame } else { Role::Time };
        let value = self.number(field).or_else(|| stamp(field).filter(|_| !frames));
        let value = value.ok_or_else(|| not_a_number(role, field))?;
        if value.is_nan() {
            return Err(not_a_number(role, field));
        }
        if value.abs() > if frames { LARGEST } else { 1e4 * LARGEST } {
            return Err(too_large(role, field));
        }
        if frames && value != value.trunc() {
            let text = format!("the frame is {}: frames are whole numbers", shown(field));
            let hint = "if the column holds seconds, call it time, as in the option `columns = \"id,time,x,y\"`";
            return Err(LineProblem { text, hint, short: false });
        }
        Ok(value)
    }

    fn too_short(&self, found: usize) -> LineProblem {
        let needed = self.columns.iter().rposition(TextColumn::is_needed).map_or(0, |last| last + 1);
        let text = format!("{found} columns instead of at least {needed}");
        LineProblem { text, hint: "name the columns with the option `columns`", short: true }
    }
}

impl Separator {
    /// Takes the next field, without surrounding blanks and quotes; `None` at the end of the line.
    #[inline]
    pub fn next<'a>(self, rest: &mut &'a [u8]) -> Option<&'a [u8]> {
        match self {
            Separator::Blanks => {
                let from = rest.iter().position(|&byte| !is_blank(byte))?;
                let field = &rest[from..];
                let length = field.iter().position(|&byte| is_blank(byte)).unwrap_or(field.len());
                *rest = &field[length..];
                Some(unquoted(&field[..length]))
            }
            Separator::Byte(byte) => {
                if rest.is_empty() {
                    return None;
                }
                let quoted = rest.iter().position(|&b| !is_blank(b)).filter(|&at| rest[at] == b'"');
                let closed = quoted.and_then(|at| rest[at + 1..].iter().position(|&b| b == b'"').map(|n| at + n + 2));
                let from = closed.unwrap_or(0);
                let end = rest[from..].iter().position(|&b| b == byte).map(|n| from + n);
                let (field, after) = match end {
                    Some(end) => (&rest[..end], &rest[end + 1..]),
                    None => (*rest, &rest[rest.len()..]),
                };
                *rest = after;
                Some(unquoted(field.trim_ascii()))
            }
        }
    }

    /// Splits a line into all its fields.
    pub fn split(self, line: &[u8]) -> Vec<&[u8]> {
        let mut rest = line;
        std::iter::from_fn(|| self.next(&mut rest)).collect()
    }
}

#[inline]
fn is_blank(byte: u8) -> bool {
    byte == b' ' || byte == b'\t' || byte == b'\r'
}

#[inline]
fn unquoted(field: &[u8]) -> &[u8] {
    match field {
        [b'"', inner @ .., b'"'] => inner,
        _ => field,
    }
}

fn not_a_number(role: Role, field: &[u8]) -> LineProblem {
    let text = format!("{} is {}, which is no number", named(role), shown(field));
    LineProblem { text, hint: "name the columns with the option `columns`", short: true }
}

fn too_large(role: Role, field: &[u8]) -> LineProblem {
    let text = format!("{} is {}; allowed is up to {LARGEST:e}", named(role), shown(field));
    let hint = match role {
        Role::Time | Role::Frame => "name the columns with the option `columns`",
        _ => "a row without a place, where somebody is missing, has `nan` or an empty field",
    };
    LineProblem { text, hint, short: false }
}

fn named(role: Role) -> &'static str {
    match role {
        Role::Id => "the id",
        Role::Frame => "the frame",
        Role::Time => "the time",
        Role::X => "x",
        Role::Y => "y",
        Role::Z => "z",
        Role::Height => "the height",
        Role::VelocityX | Role::VelocityY => "the velocity",
        Role::HeadingX | Role::HeadingY | Role::HeadingAngle => "the heading",
        Role::EndTime => "the end time",
        Role::EndX | Role::EndY => "the end",
        Role::Unused => "the column",
    }
}

/// Formats a value for an error message: quoted, shortened, without control characters.
pub(super) fn shown(field: &[u8]) -> String {
    let text = String::from_utf8_lossy(&field[..field.len().min(4 * SHOWN)]);
    let text = text.trim();
    let short: String =
        text.chars().take(SHOWN).map(|c| if c.is_control() && c != '\t' { '\u{fffd}' } else { c }).collect();
    if short.len() < text.len() { format!("`{short}...`") } else { format!("`{short}`") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fields(separator: Separator, line: &str) -> Vec<String> {
        separator.split(line.as_bytes()).iter().map(|f| String::from_utf8_lossy(f).into_owned()).collect()
    }

    #[test]
    fn lines_are_split_at_blanks_or_at_a_byte() {
        assert_eq!(fields(Separator::Blanks, "  1\t 2 3.5\r"), ["1", "2", "3.5"]);
        assert_eq!(fields(Separator::Byte(b','), "1, 2,,x\r"), ["1", "2", "", "x"]);
        assert_eq!(fields(Separator::Byte(b','), "\"One, Two\", 3"), ["One, Two", "3"]);
        assert_eq!(fields(Separator::Byte(b';'), "\"open;2"), ["\"open", "2"]);
        assert!(fields(Separator::Blanks, " \r").is_empty() && fields(Separator::Byte(b','), "").is_empty());
    }

    #[test]
    fn values_in_errors_are_short_and_clean() {
        assert_eq!(shown(b" abc\x00d "), "`abc\u{fffd}d`");
        assert_eq!(shown("ä".repeat(100).as_bytes()), format!("`{}...`", "ä".repeat(40)));
    }
}
