//! Opens a recording: detects its format, surveys its rows, finds its units.

use std::io::Read;
use std::path::Path;
use std::sync::Arc;

use super::census::{Census, Objection};
use super::columns::Role;
use super::content::{RecordingContent, RowSource};
use super::database::{self, DatabaseRows};
use super::detect;
use super::guess;
use super::input::LineReader;
use super::layout::{TextLayout, TimeColumn, shown};
use super::memory::Sorted;
use super::refusal::Refusal;
use super::row::{Numbering, Passed, ReadStop, TrajectoryRow, moment, who};
use super::rows::TrajectoryRows;
use super::scale::{Alignment, Scale, Stated, TimeScale, rotation};
use super::text_rows::unreadable;
use super::{LengthUnit, RecordingError, RecordingFormat, RecordingOptions, Survey};
use crate::files::open_input;
use crate::math::{Rect, Vec2};
use crate::motion::Statures;
use crate::{Progress, Stage};

pub(super) fn open(
    path: &Path,
    options: &RecordingOptions,
    progress: &dyn Progress,
) -> Result<RecordingContent, RecordingError> {
    check(options)?;
    let (source, stated, mut warnings) = if is_database(path, options)? {
        let database = DatabaseRows::open(path)?;
        let about = database.about();
        if let (Some(said), None) = (&about.bad_fps, options.fps) {
            let problem = format!("its metadata say {} frames per second", shown(said.as_bytes()));
            return Err(RecordingError::Database { path: path.to_path_buf(), problem });
        }
        let stated = Stated {
            format: RecordingFormat::Jupedsim,
            clock: TimeColumn::Frames,
            fps: about.fps,
            unit: Some(LengthUnit::Metre),
            unit_of_heights: None,
            bare: false,
            angles: false,
        };
        (RowSource::Database, stated, Vec::new())
    } else {
        let (layout, stated) = read_head(path, options)?;
        let warnings = layout.warnings.clone();
        (RowSource::Text(Arc::new(layout), Numbering::Own), stated, warnings)
    };
    let frames = stated.clock == TimeColumn::Frames;
    let way = CensusTask { path, frames, turn: rotation(options.rotation_deg), progress };
    let Counting { source, mut census, passed, statures, in_order } = count(source, way)?;
    let Some(bounds) = census.bounds else {
        let what = if passed.nowhere > 0 { "nobody has a place" } else { "there is a header, but nothing behind it" };
        return Err(RecordingError::Empty { path: path.to_path_buf(), what });
    };
    warn_of_rows(&census, passed, &mut warnings);
    let scale = Scale::find(&mut census, &stated, options, &mut warnings)
        .map_err(|_| RecordingError::UnknownRate { path: path.to_path_buf() })?;
    let alignment = Alignment::new(scale.unit, options);
    let survey = survey(&mut census, &stated, &scale, &alignment, bounds, in_order, warnings);
    let (path, first_time) = (path.to_path_buf(), census.first_time);
    Ok(RecordingContent { path, survey, statures, source, scale, alignment, first_time })
}

fn check(options: &RecordingOptions) -> Result<(), RecordingError> {
    let option = |option: &'static str, value: String, allowed: &str| {
        Err(RecordingError::Option { option, value, allowed: allowed.to_owned() })
    };
    if let Some(fps) = options.fps.filter(|fps| !(1e-3..=1e4).contains(fps)) {
        return option("fps", fps.to_string(), "allowed is 0.001 to 10000 frames per second");
    }
    for (name, [x, y]) in [("origin", options.origin), ("shift", options.shift)] {
        if ![x, y].iter().all(|metres| (-1e9..=1e9).contains(metres)) {
            return option(name, format!("[{x}, {y}]"), "allowed are metres up to 1e9");
        }
    }
    if !(-1e6..=1e6).contains(&options.rotation_deg) {
        return option("rotation", options.rotation_deg.to_string(), "allowed are degrees up to 1e6");
    }
    Ok(())
}

fn is_database(path: &Path, options: &RecordingOptions) -> Result<bool, RecordingError> {
    let mut magic = [0; 16];
    let opened = open_input(path).and_then(|mut file| file.read(&mut magic));
    let length = opened.map_err(|error| unreadable(path, error.into(), 0))?;
    let found = length == magic.len() && magic == *database::MAGIC;
    let asked = options.format.is_some_and(|format| format == RecordingFormat::Jupedsim);
    let unknown = |found: &str, hint: &str| {
        Err(RecordingError::Unknown { path: path.to_path_buf(), found: found.to_owned(), hint: hint.to_owned() })
    };
    match (found, options.format) {
        (false, _) if asked => {
            unknown("it is no SQLite database", "leave out the option `format`: the content tells the format")
        }
        (true, Some(_)) if !asked => {
            unknown("it is an SQLite database", "leave out the option `format`: the content tells the format")
        }
        (true, _) if options.columns.is_some() => {
            unknown("it is a database, whose columns have names", "leave out the option `columns`")
        }
        _ => Ok(found),
    }
}

/// Detects the layout of a text file.
fn read_head(path: &Path, options: &RecordingOptions) -> Result<(TextLayout, Stated), RecordingError> {
    let lines = LineReader::open(path).map_err(|trouble| unreadable(path, trouble, 0))?;
    let (head, whole) = lines.head();
    if head.starts_with(database::MAGIC) {
        let (found, hint) = ("it is a compressed database".to_owned(), "unpack it first: gunzip FILE".to_owned());
        return Err(RecordingError::Unknown { path: path.to_path_buf(), found, hint });
    }
    let layout = detect::detect(head, whole, options).map_err(|refusal| refused(path, options, refusal))?;
    let rows: Vec<&[u8]> = head.split(|&byte| byte == b'\n').skip(layout.head_lines as usize).collect();
    let unit_of_heights = guess::unit_of_heights(&layout, &rows);
    let stated = Stated {
        format: layout.format,
        clock: layout.clock,
        fps: layout.fps,
        unit: layout.unit,
        unit_of_heights,
        bare: layout.head_lines == 0,
        angles: layout.column(Role::HeadingAngle).is_some(),
    };
    Ok((layout.with_heights_in(unit_of_heights), stated))
}

fn refused(path: &Path, options: &RecordingOptions, refusal: Refusal) -> RecordingError {
    let path = path.to_path_buf();
    match refusal {
        Refusal::Empty(what) => RecordingError::Empty { path, what },
        Refusal::Unknown { found, hint } => RecordingError::Unknown { path, found, hint },
        Refusal::Line { line, problem, hint } => RecordingError::Line { path, line, problem, hint },
        Refusal::Columns(allowed) => {
            let asked = options.columns.clone().unwrap_or_default();
            RecordingError::Option { option: "columns", value: shown(asked.as_bytes()), allowed }
        }
    }
}

/// Rows between two checks for interruption.
const OFTEN: u64 = 1 << 16;

/// Parameters of a pass over the rows.
#[derive(Clone, Copy)]
struct CensusTask<'a> {
    path: &'a Path,
    /// Whether times are frame numbers.
    frames: bool,
    /// Rotation of positions before their bounding box is taken, (cos, sin).
    turn: Option<Vec2>,
    progress: &'a dyn Progress,
}

impl CensusTask<'_> {
    /// Reports progress; returns an error if the caller interrupted.
    fn check(&self, rows: &TrajectoryRows) -> Result<(), RecordingError> {
        self.progress.keep_on()?;
        // The motion itself will fill the bar again.
        self.progress.advance(Stage::Motion, rows.share_done().min(0.999));
        Ok(())
    }
}

/// Result of counting all rows.
struct Counting {
    source: RowSource,
    census: Census,
    passed: Passed,
    statures: Statures,
    in_order: bool,
}

/// Counts all rows. Rows that are not in time order are sorted in memory; if an id is not a whole number, persons are
/// renumbered.
fn count(mut source: RowSource, way: CensusTask<'_>) -> Result<Counting, RecordingError> {
    let path = way.path;
    loop {
        let mut rows = source.rows(path)?;
        rows.note_statures();
        let again = match census_of(&mut rows, &source, way) {
            Ok(census) => {
                let (passed, statures) = (rows.passed(), rows.statures());
                return Ok(Counting { passed, statures, source, census, in_order: true });
            }
            Err(Obstacle::Error(error)) => return Err(error),
            Err(Obstacle::Name) => None,
            Err(Obstacle::Disorder) => Some(()),
        };
        if again.is_none() {
            source = numbered(source);
            continue;
        }
        let mut rows = source.rows(path)?;
        rows.note_statures();
        match sorted(&mut rows, way) {
            Ok(sorted) => {
                let (passed, statures) = (rows.passed(), rows.statures());
                let sorted = RowSource::Memory(Arc::new(sorted));
                let mut rows = sorted.rows(path)?;
                return match census_of(&mut rows, &source, way) {
                    Ok(census) => Ok(Counting { passed, statures, source: sorted, census, in_order: false }),
                    Err(Obstacle::Error(error)) => Err(error),
                    Err(Obstacle::Name | Obstacle::Disorder) => {
                        Err(RecordingError::Empty { path: path.to_path_buf(), what: "its times have no order" })
                    }
                };
            }
            Err(ReadStop::Error(error)) => return Err(error),
            Err(ReadStop::Name) => source = numbered(source),
        }
    }
}

/// Reads all rows into memory, sorted by time.
fn sorted(rows: &mut TrajectoryRows, way: CensusTask<'_>) -> Result<Sorted, ReadStop> {
    let mut sorted = Sorted::default();
    for count in 0u64.. {
        let Some(row) = rows.next()? else { break };
        if count % OFTEN == 0 {
            way.check(rows)?;
        }
        sorted.push(row, way.path)?;
    }
    sorted.sort();
    Ok(sorted)
}

fn numbered(source: RowSource) -> RowSource {
    match source {
        RowSource::Text(layout, _) => RowSource::Text(layout, Numbering::Appearance),
        source => source,
    }
}

/// Why a count stopped.
enum Obstacle {
    Name,
    Disorder,
    Error(RecordingError),
}

fn census_of(rows: &mut TrajectoryRows, source: &RowSource, way: CensusTask<'_>) -> Result<Census, Obstacle> {
    let numbering = match source {
        RowSource::Text(_, numbering) => *numbering,
        RowSource::Database | RowSource::Memory(_) => Numbering::Own,
    };
    let mut census = Census::new(way.turn);
    for count in 0u64.. {
        if count % OFTEN == 0 {
            way.check(rows).map_err(Obstacle::Error)?;
        }
        let row = match rows.next() {
            Ok(Some(row)) => row,
            Ok(None) => break,
            Err(ReadStop::Name) => return Err(Obstacle::Name),
            Err(ReadStop::Error(error)) => return Err(Obstacle::Error(error)),
        };
        match census.add(&row) {
            Ok(()) => {}
            Err(Objection::Disorder) => return Err(Obstacle::Disorder),
            Err(Objection::Twice(other)) => {
                return Err(Obstacle::Error(twice(way.path, &row, other, numbering, way.frames)));
            }
        }
    }
    census.finish();
    Ok(census)
}

fn twice(path: &Path, row: &TrajectoryRow, other: Vec2, numbering: Numbering, frames: bool) -> RecordingError {
    RecordingError::Twice {
        path: path.to_path_buf(),
        line: row.line,
        who: who(row.id, numbering),
        moment: moment(row.time, frames),
        places: [[other.x, other.y], [row.at.x, row.at.y]],
    }
}

fn warn_of_rows(census: &Census, passed: Passed, warnings: &mut Vec<String>) {
    if passed.nowhere > 0 {
        let line = passed.first_nowhere;
        warnings.push(match passed.nowhere {
            1 => format!("the row in line {line} has no place: that person is taken for missing there"),
            many => {
                format!("{many} rows have no place, the first in line {line}: those people are taken for missing there")
            }
        });
    }
    if census.repeated > 0 {
        warnings.push(match census.repeated {
            1 => "1 row repeats another and is passed over".to_owned(),
            many => format!("{many} rows repeat others and are passed over"),
        });
    }
    if let Some(line) = passed.broken {
        warnings.push(format!("the file breaks off in line {line}, which is left out"));
    }
}

fn survey(
    census: &mut Census,
    stated: &Stated,
    scale: &Scale,
    alignment: &Alignment,
    bounds: Rect,
    in_order: bool,
    warnings: Vec<String>,
) -> Survey {
    let second = match scale.time {
        TimeScale::Frames(fps) => fps,
        TimeScale::Times(seconds) => 1.0 / seconds,
    };
    let speed = if census.time > 0.0 { census.way / census.time * second * scale.unit.metres() } else { 0.0 };
    let longest_gap = scale.stand_s.unwrap_or(scale.gap_s) * second;
    Survey {
        format: stated.format,
        unit: scale.unit,
        fps: scale.fps,
        people: census.people(),
        largest_id: census.largest_id,
        returns: census.intervals.count_above(longest_gap * (1.0 + 1e-9)),
        frames: census.moments,
        places: census.places,
        span_s: [0.0, scale.time.seconds(census.end_time - census.first_time)],
        person_seconds: scale.time.seconds(census.present(longest_gap)),
        mean_speed_m_s: speed,
        bounds_m: alignment.bounds(bounds),
        in_order,
        warnings,
    }
}
