//! Detects the layout of a text from its first lines.

use super::columns::{ColumnUnit, Role, TextColumn, assign, column_named, strange_unit, unit_named};
use super::error::LINES;
use super::guess;
use super::layout::{HIGHEST_RATE, Separator, TextLayout, TimeColumn, shown};
use super::number::number;
use super::refusal::Refusal;
use super::{LengthUnit, RecordingFormat, RecordingOptions};

/// Line number, from 1, and line.
type Numbered<'a> = (u64, &'a [u8]);

/// Properties stated in comments.
#[derive(Default)]
struct Comments<'a> {
    fps: Option<f64>,
    unit: Option<LengthUnit>,
    /// Column names.
    columns: Option<Vec<&'a str>>,
}

/// Detects the layout of a text from its beginning; `whole` if `head` is the entire file.
pub(super) fn detect(head: &[u8], whole: bool, options: &RecordingOptions) -> Result<TextLayout, Refusal> {
    if head.is_empty() {
        return Err(Refusal::Empty("the file has no content"));
    }
    refuse_what_is_no_text(head)?;
    let mut lines: Vec<Numbered> = (1..).zip(head.split(|&byte| byte == b'\n')).collect();
    if !whole && lines.len() > 1 {
        // The last line may be cut off.
        lines.pop();
    }
    let lines: Vec<Numbered> = lines.into_iter().map(|(n, line)| (n, line.trim_ascii())).collect();
    let comments = read_comments(&lines, options.fps)?;
    let data: Vec<Numbered> = lines.iter().copied().filter(|(_, line)| !line.is_empty() && line[0] != b'#').collect();
    let Some(&first) = data.first() else {
        return Err(Refusal::Empty("there is nothing but comments"));
    };
    let (header, data) = match viswalk_header(first, &data)? {
        Some(found) => found,
        None if is_header(first.1) => (Some((first, separator_of_header(first.1))), &data[1..]),
        None => (None, &data[..]),
    };
    let Some(&(first_number, first_line)) = data.first() else {
        if let (false, Some(((line, _), _))) = (whole, header) {
            let problem = "the line does not end".to_owned();
            return Err(Refusal::Line { line: line + 1, problem, hint: LINES.to_owned() });
        }
        return Err(Refusal::Empty("there is a header, but nothing behind it"));
    };

    let separator = header.map_or_else(|| separator_of_numbers(first_line), |(_, separator)| separator);
    let rows: Vec<&[u8]> = data.iter().map(|(_, line)| *line).collect();
    let names: Option<Vec<&str>> = header.map(|((_, line), separator)| names_of(line, separator));
    let mut warnings = Vec::new();
    let columns = columns_of(options, names.as_deref(), &comments, separator, &rows, &mut warnings)
        .map_err(|refusal| place(refusal, header.map_or((first_number, first_line), |(line, _)| line)))?;
    let by_columns = |format: RecordingFormat| options.format.unwrap_or(format);
    let mut layout = TextLayout {
        format: by_columns(format_of(names.as_deref(), separator, &columns)),
        separator,
        decimal_comma: separator != Separator::Byte(b','),
        clock: clock_of(&columns, options),
        columns,
        width: separator.split(first_line).len(),
        head_lines: first_number - 1,
        header: header.map(|((_, line), _)| line.to_vec()),
        fps: comments.fps,
        unit: None,
        heights: None,
        warnings,
    };
    let named = names.as_ref().or(comments.columns.as_ref()).filter(|_| options.columns.is_none());
    let strange = named.and_then(|names| names.iter().find_map(|name| strange_unit(name)));
    if let Some(unit) = strange.filter(|_| options.unit.is_none()) {
        layout.warnings.push(format!(
            "the unit {} is unknown: give it with the option `unit`: m, cm, mm or ft",
            shown(unit.as_bytes())
        ));
    }
    let units = layout.columns.iter().filter(|column| matches!(column.role, Role::X | Role::Y));
    layout.unit = units.filter_map(|column| length_unit(column.unit)).next().or(comments.unit);
    drop_second_clock(&mut layout);
    if header.is_some() {
        take_row_of_units(&mut layout, first_line);
    }
    guess::upright_axis(&mut layout, &rows, options.columns.is_some());
    if layout.column(Role::Id).is_none() {
        layout.warnings.push("no column says who: all places are taken for one person's".to_owned());
    }
    Ok(layout)
}

/// Adds a line number to a refusal that has none. The line is not quoted: it may be binary.
fn place(refusal: Refusal, (line, _): Numbered) -> Refusal {
    match refusal {
        Refusal::Unknown { found, hint } => Refusal::Line { line, problem: found, hint },
        refusal => refusal,
    }
}

fn refuse_what_is_no_text(head: &[u8]) -> Result<(), Refusal> {
    let found = |found: &str, hint: &str| Err(Refusal::Unknown { found: found.to_owned(), hint: hint.to_owned() });
    let start = head.trim_ascii_start();
    let sample = &head[..head.len().min(4096)];
    let nulls = sample.iter().filter(|&&byte| byte == 0).count();
    let utf16 = head.starts_with(&[0xff, 0xfe]) || head.starts_with(&[0xfe, 0xff]);
    // In UTF-16, every other byte of ASCII text is null.
    if utf16 || (nulls * 5 > sample.len() * 2 && sample.len() >= 16) {
        return found("its text is UTF-16", "save it as UTF-8, or: iconv -f UTF-16 -t UTF-8 FILE");
    }
    if head.starts_with(b"PK\x03\x04") {
        return found("it is a ZIP archive or a spreadsheet", "unpack it, or save the sheet as CSV");
    }
    if head.starts_with(b"\x89HDF") {
        return found("it is HDF5", "write its table as CSV with columns id, frame, x, y");
    }
    let control = |byte: &&u8| **byte < 32 && !b"\t\n\r\x0c".contains(byte);
    if sample.iter().filter(control).count() * 20 > sample.len() {
        return found("it is no text", "read are texts, gzip'd texts and JuPedSim's databases");
    }
    match start.first() {
        Some(b'<') => found("it is XML", "trajectories as XML are not read; write them as text: id frame x y"),
        Some(b'{' | b'[') => found("it is JSON", "write it as CSV with columns id, time, x, y"),
        _ => Ok(()),
    }
}

/// Reads rate, unit and column names from comments. A bad rate is ignored if `asked` replaces it.
fn read_comments<'a>(lines: &[Numbered<'a>], asked: Option<f64>) -> Result<Comments<'a>, Refusal> {
    let mut comments = Comments::default();
    for &(number, line) in lines.iter().filter(|(_, line)| line.first() == Some(&b'#')) {
        let Ok(text) = std::str::from_utf8(&line[1..]) else { continue };
        let lower = text.to_ascii_lowercase();
        if let Some(rate) = stated_rate(&lower) {
            match rate {
                Ok(fps) if fps > 0.0 && fps <= HIGHEST_RATE => comments.fps = Some(fps),
                _ if asked.is_some() => {}
                Ok(fps) => return Err(bad_rate(number, &fps.to_string())),
                Err("") => {}
                Err(value) => return Err(bad_rate(number, &shown(value.as_bytes()))),
            }
        }
        for (words, unit) in [
            (["in metres", "in meters", "in meter"], LengthUnit::Metre),
            (["in cm", "in centimetres", "in centimeters"], LengthUnit::Centimetre),
        ] {
            if words.iter().any(|word| lower.trim_end_matches([')', ' ', '.']).ends_with(word)) {
                comments.unit = Some(unit);
            }
        }
        let names: Vec<&str> = text.split([' ', '\t', ',', ';']).filter(|name| !name.is_empty()).collect();
        if is_column_line(&names) {
            comments.columns = Some(names);
        }
    }
    Ok(comments)
}

fn bad_rate(line: u64, rate: &str) -> Refusal {
    let problem = format!("the frame rate is {rate}; allowed is above 0, up to {HIGHEST_RATE}");
    let hint = "give the recording's frames per second with the option `fps`".to_owned();
    Refusal::Line { line, problem, hint }
}

/// Returns the number behind `framerate`, as in `#framerate: 16` or `framerate = 25 fps`; `Err` holds other text.
fn stated_rate(comment: &str) -> Option<Result<f64, &str>> {
    let comment = comment.trim();
    let keys = ["framerate", "frame rate", "frame_rate", "frame-rate", "fps"];
    let value = keys.iter().find_map(|key| comment.strip_prefix(key))?;
    let value = value.trim_start_matches([' ', '\t', ':', '=']).trim();
    let end = value.find(|c: char| !(c.is_ascii_digit() || "+-.,e".contains(c))).unwrap_or(value.len());
    let digits = value[..end].trim_end_matches([',', '.', 'e']).replace(',', ".");
    Some(number(digits.as_bytes()).filter(|fps| fps.is_finite()).ok_or(value))
}

fn is_column_line(names: &[&str]) -> bool {
    let roles: Vec<Role> = names.iter().filter_map(|n| column_named(n)).map(|(column, _)| column.role).collect();
    let has = |role| roles.contains(&role);
    has(Role::X) && has(Role::Y) && (has(Role::Frame) || has(Role::Time))
}

/// Whether a line names columns: at least two known names, and no field is a number.
fn is_header(line: &[u8]) -> bool {
    let names = names_of(line, separator_of_header(line));
    let known = names.iter().filter_map(|name| column_named(name)).filter(|(column, _)| column.role != Role::Unused);
    known.count() >= 2 && !names.iter().any(|name| number(name.as_bytes()).is_some_and(f64::is_finite))
}

fn names_of(line: &[u8], separator: Separator) -> Vec<&str> {
    separator.split(line).into_iter().map(|name| std::str::from_utf8(name).unwrap_or("\u{fffd}")).collect()
}

fn separator_of_header(line: &[u8]) -> Separator {
    [b';', b',', b'\t'].into_iter().find(|byte| line.contains(byte)).map_or(Separator::Blanks, Separator::Byte)
}

/// Finds the separator of a line of numbers; a comma may also be the decimal mark.
fn separator_of_numbers(line: &[u8]) -> Separator {
    let byte = [b';', b','].into_iter().find(|byte| {
        let fields = Separator::Byte(*byte).split(line);
        line.contains(byte) && fields.iter().all(|field| !field.contains(&b' ') && !field.contains(&b'\t'))
    });
    byte.map_or(Separator::Blanks, Separator::Byte)
}

type Header<'a> = Option<(Numbered<'a>, Separator)>;

/// Finds the header of a Viswalk file: the line `$PEDESTRIAN:` followed by column names.
fn viswalk_header<'a, 'b>(
    first: Numbered<'a>,
    data: &'b [Numbered<'a>],
) -> Result<Option<(Header<'a>, &'b [Numbered<'a>])>, Refusal> {
    if !matches!(first.1[0], b'$' | b'*') {
        return Ok(None);
    }
    for (at, &(number, line)) in data.iter().enumerate() {
        let Some(colon) = line.iter().position(|&byte| byte == b':').filter(|_| line[0] == b'$') else { continue };
        let names = &line[colon + 1..];
        if is_column_line(&names_of(names, Separator::Byte(b';'))) {
            return Ok(Some((Some(((number, names), Separator::Byte(b';'))), &data[at + 1..])));
        }
    }
    let hint = "write NO, SIMSEC, COORDCENTX and COORDCENTY of pedestrians";
    Err(Refusal::Line {
        line: first.0,
        problem: "no line `$PEDESTRIAN:` with columns for who, when and where".to_owned(),
        hint: hint.to_owned(),
    })
}

fn columns_of(
    options: &RecordingOptions,
    names: Option<&[&str]>,
    comments: &Comments<'_>,
    separator: Separator,
    rows: &[&[u8]],
    warnings: &mut Vec<String>,
) -> Result<Vec<TextColumn>, Refusal> {
    if let Some(asked) = &options.columns {
        return asked_columns(asked);
    }
    let numbers_rows = |at: usize| guess::numbers_rows(rows, separator, at);
    let named = names.map(|names| assign(names, numbers_rows));
    let commented = || comments.columns.as_ref().map(|names| assign(names, numbers_rows));
    let complete = |columns: &Vec<TextColumn>| missing(columns).is_none();
    if let Some(columns) = named {
        return match missing(&columns) {
            None => Ok(columns),
            Some(what) => Err(Refusal::Unknown {
                found: format!("the header names no column for {what}"),
                hint: "name the columns in order with the option `columns = \"id,time,x,y\"`, - for an unused one"
                    .to_owned(),
            }),
        };
    }
    // A comment that names more columns than the rows have may describe something else.
    let width = rows.first().map_or(0, |row| separator.split(row).len());
    if let Some(columns) = commented().filter(complete).filter(|columns| columns.len() <= width) {
        return Ok(columns);
    }
    guess::columns(rows, separator, options.format, warnings)
}

/// Parses the value of `--columns`.
fn asked_columns(asked: &str) -> Result<Vec<TextColumn>, Refusal> {
    let mut columns: Vec<TextColumn> = Vec::new();
    for word in asked.split(',').map(str::trim) {
        let Some((column, _)) = column_named(word) else {
            return Err(Refusal::Columns(format!("`{word}` is none of id, frame, time, x, y, z, vx, vy, -")));
        };
        if column.role != Role::Unused && columns.iter().any(|other| other.role == column.role) {
            return Err(Refusal::Columns(format!("`{word}` comes twice")));
        }
        columns.push(column);
    }
    match missing(&columns) {
        Some(what) => Err(Refusal::Columns(format!("no column for {what}"))),
        None => Ok(columns),
    }
}

/// Returns which of x, y and time has no column.
fn missing(columns: &[TextColumn]) -> Option<&'static str> {
    let has = |role| columns.iter().any(|column| column.role == role);
    if !has(Role::X) {
        Some("x")
    } else if !has(Role::Y) {
        Some("y")
    } else if !has(Role::Time) && !has(Role::Frame) {
        Some("the time or frame")
    } else {
        None
    }
}

fn format_of(names: Option<&[&str]>, separator: Separator, columns: &[TextColumn]) -> RecordingFormat {
    let Some(names) = names else {
        let first = columns.iter().find(|column| matches!(column.role, Role::Id | Role::Frame | Role::Time));
        return match separator {
            Separator::Blanks if first.is_some_and(|column| column.role == Role::Frame) => RecordingFormat::Obsmat,
            Separator::Blanks => RecordingFormat::Juelich,
            Separator::Byte(_) => RecordingFormat::Csv,
        };
    };
    let lower: Vec<String> = names.iter().map(|name| name.to_ascii_lowercase()).collect();
    let has = |all: &[&str]| all.iter().all(|name| lower.iter().any(|other| other == name));
    if has(&["pedestrianid", "simtime"]) || has(&["pedestrianid", "timestep"]) {
        RecordingFormat::Vadere
    } else if has(&["no", "simsec"]) {
        RecordingFormat::Viswalk
    } else if has(&["pedid", "time", "posx", "posy"]) {
        RecordingFormat::Crowdit
    } else if has(&["id", "t", "x", "y"]) && separator == Separator::Byte(b',') {
        RecordingFormat::Pathfinder
    } else if separator == Separator::Blanks {
        RecordingFormat::Juelich
    } else {
        RecordingFormat::Csv
    }
}

/// Chooses the clock: times rather than frames, unless `fps` is given.
fn clock_of(columns: &[TextColumn], options: &RecordingOptions) -> TimeColumn {
    let of = |role| columns.iter().find(|column| column.role == role);
    match (of(Role::Time), of(Role::Frame)) {
        (Some(_), Some(_)) if options.fps.is_some() => TimeColumn::Frames,
        (Some(time), _) => TimeColumn::Times(match time.unit {
            Some(ColumnUnit::Time(seconds)) => Some(seconds),
            _ => None,
        }),
        _ => TimeColumn::Frames,
    }
}

/// Ignores the time or frame column that is not the clock.
fn drop_second_clock(layout: &mut TextLayout) {
    let other = if layout.clock == TimeColumn::Frames { Role::Time } else { Role::Frame };
    if let Some(at) = layout.column(other) {
        layout.columns[at] = TextColumn::UNUSED;
    }
}

/// Reads the row of units that Pathfinder writes below the names.
fn take_row_of_units(layout: &mut TextLayout, line: &[u8]) {
    let fields = layout.separator.split(line);
    let unit = |role: Role| {
        let field = layout.column(role).and_then(|at| fields.get(at))?;
        unit_named(std::str::from_utf8(field).ok()?)
    };
    let (x, time) = (unit(Role::X), unit(Role::Time));
    if x.is_none() && time.is_none() {
        return;
    }
    layout.unit = length_unit(x).or(layout.unit);
    if let (Some(ColumnUnit::Time(seconds)), TimeColumn::Times(_)) = (time, layout.clock) {
        layout.clock = TimeColumn::Times(Some(seconds));
    }
    layout.head_lines += 1;
}

fn length_unit(unit: Option<ColumnUnit>) -> Option<LengthUnit> {
    match unit {
        Some(ColumnUnit::Length(unit)) => Some(unit),
        _ => None,
    }
}
