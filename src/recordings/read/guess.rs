//! Guesses roles and units of columns from their numbers, for files without names.

use std::collections::{HashMap, HashSet};

use super::RecordingFormat;
use super::columns::{Role, TextColumn};
use super::layout::{Separator, TextLayout};
use super::number::{number, stamp};
use super::refusal::Refusal;

/// Largest number of rows that are examined.
const ROWS: usize = 20_000;

/// Whether a column only numbers the rows: all values differ and increase.
pub(super) fn numbers_rows(rows: &[&[u8]], separator: Separator, at: usize) -> bool {
    let values = || rows.iter().take(ROWS).filter_map(|row| separator.split(row).get(at).copied());
    let distinct: HashSet<&[u8]> = values().collect();
    rows.len() > 2 && distinct.len() == rows.len().min(ROWS)
}

/// Guesses the columns of a text without column names.
pub(super) fn columns(
    rows: &[&[u8]],
    separator: Separator,
    format: Option<RecordingFormat>,
    warnings: &mut Vec<String>,
) -> Result<Vec<TextColumn>, Refusal> {
    use Role::{Frame, Id, Time, Unused, VelocityX, VelocityY, X, Y, Z};
    let first = rows.first().copied().unwrap_or_default();
    let fields = separator.split(first);
    let width = fields.len();
    let hint = "name the columns in order with the option `columns = \"id,frame,x,y\"`, - for an unused one".to_owned();
    if width < 4 {
        let found = if width == 1 { "a line with 1 column".to_owned() } else { format!("a line with {width} columns") };
        let found = format!("{found} where who, when, x and y are needed");
        return Err(Refusal::Unknown { found, hint });
    }
    let is_number = |at: usize| number(fields[at]).is_some();
    let when = |at: usize| number(fields[at]).or_else(|| stamp(fields[at])).is_some();
    if !(when(1) && is_number(2) && is_number(3)) {
        let bad = (1..4).find(|&at| !is_number(at)).unwrap_or(1) + 1;
        let found = format!("no header names the columns, and column {bad} holds no number");
        return Err(Refusal::Unknown { found, hint });
    }
    let table: Vec<Vec<f64>> = rows.iter().take(ROWS).filter_map(|row| numbers(row, separator)).collect();
    let roles = match format {
        Some(RecordingFormat::Obsmat) if width >= 8 => vec![Frame, Id, X, Z, Y, VelocityX, Unused, VelocityY],
        Some(RecordingFormat::Obsmat) => vec![Frame, Id, X, Y],
        Some(RecordingFormat::Juelich) => vec![Id, Frame, X, Y, Z],
        Some(
            RecordingFormat::Vadere | RecordingFormat::Crowdit | RecordingFormat::Viswalk | RecordingFormat::Pathfinder,
        ) => vec![Id, Time, X, Y],
        _ => {
            let whole = |at: usize| table.iter().all(|row| row[at] == row[at].trunc());
            let still = |at: usize| table.iter().all(|row| row[at] == table[0][at]);
            let named = !is_number(0);
            match (named || whole(0), whole(1)) {
                (true, true) if named => vec![Id, Frame, X, Y, Z],
                (true, true) if width == 8 && still(3) && still(6) && frame_first(&table, [2, 4]) => {
                    vec![Frame, Id, X, Z, Y, VelocityX, Unused, VelocityY]
                }
                (true, true) if frame_first(&table, [2, 3]) => vec![Frame, Id, X, Y],
                (true, true) => vec![Id, Frame, X, Y, Z],
                (false, true) => vec![Time, Id, X, Y],
                _ => vec![Id, Time, X, Y, Z],
            }
        }
    };
    if separator != Separator::Blanks {
        let word = |role: &Role| match role {
            Id => "id",
            Frame => "frame",
            Time => "time",
            X => "x",
            Y => "y",
            _ => "-",
        };
        let words: Vec<&str> = roles.iter().take(width).map(word).collect();
        warnings.push(format!("no header names the columns: they are taken for {}", words.join(",")));
    }
    let mut columns: Vec<TextColumn> =
        roles.into_iter().map(|role| TextColumn { role, ..TextColumn::UNUSED }).collect();
    columns.truncate(width);
    Ok(columns)
}

/// Parses the first eight fields of a row, NaN if invalid; `None` without fields 3 and 4.
fn numbers(row: &[u8], separator: Separator) -> Option<Vec<f64>> {
    let mut numbers: Vec<f64> =
        separator.split(row).into_iter().take(8).map(|field| number(field).unwrap_or(f64::NAN)).collect();
    let placed = numbers.len() >= 4 && numbers[2..4].iter().all(|value| value.is_finite());
    numbers.resize(8, f64::NAN);
    placed.then_some(numbers)
}

/// Whether the first column is the frame and the second the id, rather than the reverse: with the right order, persons
/// move less per unit of time.
fn frame_first(table: &[Vec<f64>], place: [usize; 2]) -> bool {
    match (median_step(table, 1, 0, place), median_step(table, 0, 1, place)) {
        (Some(frame_first), Some(id_first)) => frame_first < 0.5 * id_first,
        (frame_first, None) => frame_first.is_some(),
        (None, _) => false,
    }
}

/// Median displacement of a person per unit of time, for a given choice of columns.
fn median_step(table: &[Vec<f64>], who: usize, when: usize, [x, y]: [usize; 2]) -> Option<f64> {
    let mut last: HashMap<u64, &Vec<f64>> = HashMap::new();
    let mut steps = Vec::new();
    for row in table {
        let Some(before) = last.insert(row[who].to_bits(), row) else { continue };
        let (dx, dy, dt) = (row[x] - before[x], row[y] - before[y], row[when] - before[when]);
        if dt != 0.0 {
            steps.push((dx * dx + dy * dy).sqrt() / dt.abs());
        }
    }
    let middle = steps.len() / 2;
    (!steps.is_empty()).then(|| *steps.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// Swaps y and z if y hardly changes and z does, as in exports of game engines with y up.
pub(super) fn upright_axis(layout: &mut TextLayout, rows: &[&[u8]], asked: bool) {
    let game = matches!(layout.format, RecordingFormat::Csv | RecordingFormat::Pathfinder);
    let (Some(x), Some(y), Some(z)) = (layout.column(Role::X), layout.column(Role::Y), layout.column(Role::Z)) else {
        return;
    };
    if asked || !game {
        return;
    }
    let value = |row: &[u8], at: usize| layout.separator.split(row).get(at).and_then(|field| number(field));
    let extent = |at: usize| {
        let values = || rows.iter().take(ROWS).filter_map(|row| value(row, at)).filter(|v| v.is_finite());
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    let (wide, tall, deep) = (extent(x), extent(y), extent(z));
    if tall.is_finite() && tall < 0.1 * deep && tall < 0.1 * wide {
        layout.columns[z].role = Role::Y;
        layout.columns[y].role = Role::Z;
        let told = "y hardly changes and is taken for the height, z for the floor's second axis; the option `columns` \
                    overrides it, with -y for z where z points towards the viewer";
        layout.warnings.push(told.to_owned());
    }
}

/// Guesses the unit of body heights: people are 1 to 2.3 m tall.
pub(super) fn unit_of_heights(layout: &TextLayout, rows: &[&[u8]]) -> Option<super::LengthUnit> {
    use super::LengthUnit::{Centimetre, Metre, Millimetre};
    let at = layout.heights_column()?;
    let value = |row: &&[u8]| number(layout.separator.split(row).get(at)?).filter(|z| z.is_finite());
    let mut heights: Vec<f64> = rows.iter().take(ROWS).filter_map(value).collect();
    let middle = heights.len() / 2;
    if heights.is_empty() {
        return None;
    }
    let height = *heights.select_nth_unstable_by(middle, f64::total_cmp).1;
    let units = [(Metre, 1.0), (Centimetre, 100.0), (Millimetre, 1000.0)];
    units.into_iter().find(|(_, per_metre)| (1.0..2.3).contains(&(height / per_metre))).map(|(unit, _)| unit)
}
