//! What is wrong with a file is said: where, what, and what to do about it.

use std::io::Write;
use std::path::Path;

use rusqlite::Connection;
use trodden::recordings::{Recording, RecordingError, RecordingFormat, RecordingOptions};

use super::{given, open_with, options};

/// The error of a file with this content; it names the file, and has a hint.
fn error(content: impl AsRef<[u8]>) -> String {
    error_with(content, &options())
}

fn error_with(content: impl AsRef<[u8]>, options: &RecordingOptions) -> String {
    let error = open_with(&content, options).unwrap_err();
    let shown = String::from_utf8_lossy(content.as_ref()).chars().take(100).collect::<String>();
    assert!(error.to_string().contains("recording"), "{shown}: {error} names the file");
    assert!(error.hint().is_some_and(|hint| hint.len() > 10), "{shown}: {error} has no hint");
    error.to_string()
}

#[test]
fn files_without_anybody_are_empty() {
    for (content, what) in [
        ("", "no content"),
        ("# framerate: 25\n# id frame x/m y/m\n", "nothing but comments"),
        ("id,frame,x,y\n", "nothing behind it"),
        ("id,frame,x,y", "nothing behind it"),
        ("\n\n\n", "nothing but comments"),
        ("id,time,x,y\n1,0,nan,nan\n", "nobody has a place"),
        ("pedestrianId simTime startX startY\n", "nothing behind it"),
        ("$VISION\n$PEDESTRIAN:NO;SIMSEC;COORDCENTX;COORDCENTY\n", "nothing behind it"),
    ] {
        let found = error(content);
        assert!(found.contains("is empty") && found.contains(what), "{content:?}: {found}");
    }
}

#[test]
fn other_kinds_of_file_are_told_by_name() {
    let utf16: Vec<u8> = "\u{feff}1 1 0 0\r\n1 2 0 0\r\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let mut without_mark: Vec<u8> = "id,frame,x,y\n1,1,0,0\n".encode_utf16().flat_map(u16::to_be_bytes).collect();
    for (content, found) in [
        (utf16.as_slice(), "UTF-16"),
        (without_mark.as_mut_slice(), "UTF-16"),
        (b"PK\x03\x04junk", "spreadsheet"),
        (b"\x89HDF\r\n", "HDF5"),
        (b"<?xml version=\"1.0\"?>\n<a/>", "XML"),
        (b"  [{\"id\": 1}]", "JSON"),
        (&[7; 500], "no text"),
        (b"\x00\x01\x02\x03\x04\x05\x06", "no text"),
    ] {
        assert!(error(content).contains(found), "{found}");
    }
}

#[test]
fn texts_that_are_no_recordings_are_told_by_line() {
    for (content, place, problem) in [
        ("#rho velocity\n1.79\t0.21\n", "line 2", "2 columns where who, when, x and y are needed"),
        ("hello\n", "line 1", "1 column"),
        ("the quick brown fox jumps\n", "line 1", "column 2 holds no number"),
        ("health,name\n5,x\n", "line 1", "2 columns where who"),
        ("id,frame,x\n1,2,3\n", "line 1", "no column for y"),
        ("id,x,y,z\n1,2,3,4\n", "line 1", "the time or frame"),
        ("$VISION\n* hm\n1;2\n", "line 1", "$PEDESTRIAN:"),
        ("id,time,x,y\nAda,noon,1,1\n", "line 2", "the time is `noon`, which is no number"),
    ] {
        let found = match open_with(content, &options()) {
            Err(error) => error.to_string(),
            Ok(recording) => panic!("{content}: {:?}", recording.survey()),
        };
        assert!(found.contains(place) && found.contains(problem), "{content:?}: {found}");
    }
}

#[test]
fn rows_that_make_no_sense_are_told_by_line_and_value() {
    let head = "# framerate: 10\n# id frame x/m y/m\n1 0 0 0\n1 1 0.1 0\n";
    for (row, problem) in [
        ("1 2 inf 0", "x is `inf`; allowed is up to 1e15"),
        ("1 2 0 -infinity", "y is `-infinity`"),
        ("1 2 1e300 0", "x is `1e300`"),
        ("1 2.5 0 0", "the frame is `2.5`: frames are whole numbers"),
        ("1 nan 0 0", "the frame is `nan`, which is no number"),
        ("1 1e99 0 0", "the frame is `1e99`"),
        ("1 2 0", "3 columns instead of at least 4"),
        ("1 2 0,1 x", "y is `x`"),
        ("1 2 \u{1}\u{2} 0", "x is `\u{fffd}\u{fffd}`"),
        ("1 1 0.5 0", "person 1 is at (0.100, 0.000) and at (0.500, 0.000) at frame 1"),
    ] {
        let found = open_with(format!("{head}{row}\n1 3 0.3 0\n"), &options()).unwrap_err().to_string();
        assert!(found.contains("line 5") && found.contains(problem), "{row}: {found}");
    }
}

#[test]
fn an_id_twice_in_one_frame_is_told_in_files_by_person_too() {
    let text = "#framerate: 10\n1 0 0 0\n1 1 0.1 0\n2 0 5 5\n2 1 5 5.1\n1 1 0.7 0\n";
    let found = error(text);
    assert!(found.contains("line 6: person 1 is at (0.100, 0.000) and at (0.700, 0.000) at frame 1"), "{found}");
    let found = error("name,time,x,y\nAda,0,0,0\nBob,0,1,1\nAda,0,3,3\n");
    assert!(found.contains("line 4") && found.contains("number 1") && found.contains("time 0"), "{found}");
}

#[test]
fn frame_rates_that_are_none_are_told() {
    for (header, value) in [("#framerate: 0", "0"), ("# framerate: -25 fps", "-25"), ("#framerate: fast", "`fast`")] {
        let found = error(format!("{header}\n1 0 0 0\n1 1 0 0\n"));
        assert!(found.contains("line 1") && found.contains(&format!("the frame rate is {value}")), "{found}");
    }
}

#[test]
fn a_rate_that_nothing_tells_is_asked_for() {
    let error = open_with("1 0 5 5\n1 1 5 5\n2 1 3 3\n", &options()).unwrap_err();
    assert!(matches!(error, RecordingError::UnknownRate { .. }));
    assert!(error.hint().unwrap().contains("the option `fps`"));
}

#[test]
fn packed_files_that_break_off_or_are_damaged_are_told() {
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    for k in 0..200_000 {
        writeln!(packed, "1,{k},{},0", k % 977 * 31).unwrap();
    }
    let packed = packed.finish().unwrap();
    let shorter = error_of(&packed[..packed.len() - 1000]);
    assert!(shorter.contains("breaks off (after line "), "{shorter}");
    let mut damaged = packed.clone();
    let middle = damaged.len() / 2;
    damaged[middle..middle + 64].fill(0x55);
    open_with(&damaged, &options()).unwrap_err();
    assert!(error_of(&[0x1f, 0x8b]).contains("recording"));
}

fn error_of(content: &[u8]) -> String {
    let asked = RecordingOptions { columns: Some("id,time,x,y".into()), ..options() };
    open_with(content, &asked).unwrap_err().to_string()
}

#[test]
fn files_that_cannot_be_read_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let missing = Recording::open(&folder.path().join("missing.txt"), &options()).unwrap_err();
    assert!(matches!(missing, RecordingError::Unreadable { .. }) && missing.to_string().contains("missing.txt"));
    Recording::open(folder.path(), &options()).unwrap_err();
}

/// The error of a database that is made so.
fn database_error(make: impl FnOnce(&Connection)) -> String {
    let file = given("");
    {
        let database = Connection::open(&file.path).unwrap();
        make(&database);
    }
    let error = Recording::open(&file.path, &options()).unwrap_err();
    assert!(error.hint().is_some(), "{error}");
    error.to_string()
}

const TABLES: &str =
    "CREATE TABLE trajectory_data (frame INTEGER, id INTEGER, pos_x REAL, pos_y REAL, ori_x REAL, ori_y REAL);
    CREATE TABLE metadata (key TEXT, value TEXT);";

#[test]
fn databases_that_are_no_recordings_are_told() {
    let make = |sql: &'static str| move |database: &Connection| database.execute_batch(sql).unwrap();
    assert!(database_error(make("CREATE TABLE a (b)")).contains("no table trajectory_data"));
    assert!(database_error(make("CREATE TABLE trajectory_data (frame, id, x, y)")).contains("no column pos_x"));
    let rows = |rows: &str| {
        let sql = format!("{TABLES} INSERT INTO metadata VALUES ('fps', '10'); {rows}");
        database_error(move |database| database.execute_batch(&sql).unwrap())
    };
    assert!(rows("").contains("is empty"));
    let insert =
        |values: &str| rows(&format!("INSERT INTO trajectory_data VALUES (0, 1, 0, 0, 1, 0), ({values}, 1, 0)"));
    for (values, problem) in [
        ("1, 1, 'here', 0", "pos_x is `here`"),
        ("1, 1, 9e999, 0", "pos_x is inf"),
        ("1, -1, 0, 0", "the id is -1"),
        ("1, 'Ada', 0, 0", "the id is `Ada`"),
        ("0.5, 1, 0, 0", "the frame is 0.5"),
        ("0, 1, 3, 0", "person 1 is at (0.000, 0.000) and at (3.000, 0.000) at frame 0"),
    ] {
        let found = insert(values);
        assert!(found.contains("line 2") && found.contains(problem), "{values}: {found}");
    }
    let sql = format!(
        "{TABLES} INSERT INTO metadata VALUES ('fps', 'fast'); INSERT INTO trajectory_data VALUES (0,0,0,0,0,0)"
    );
    assert!(database_error(move |database| database.execute_batch(&sql).unwrap()).contains("`fast` frames per second"));
    let sql = format!("{TABLES} INSERT INTO trajectory_data VALUES (0, 0, 0, 0, 0, 0)");
    let found = database_error(move |database| database.execute_batch(&sql).unwrap());
    assert!(found.contains("nothing tells how many frames"), "{found}");
}

#[test]
fn damaged_databases_are_told() {
    let file = given("");
    {
        let database = Connection::open(&file.path).unwrap();
        let rows = "WITH RECURSIVE n(k) AS (SELECT 0 UNION ALL SELECT k + 1 FROM n WHERE k < 20000)
            INSERT INTO trajectory_data SELECT k, 1, 0.1 * k, 0, 1, 0 FROM n";
        database.execute_batch(&format!("{TABLES} INSERT INTO metadata VALUES ('fps', '10'); {rows}")).unwrap();
    }
    let whole = std::fs::read(&file.path).unwrap();
    assert_eq!(open_with(&whole, &options()).unwrap().survey().frames, 20_001);
    for length in [16, 100, 5000, whole.len() / 2, whole.len() - 4096] {
        let found = open_with(&whole[..length], &options()).unwrap_err();
        assert!(matches!(found, RecordingError::Database { .. }), "{length}: {found}");
    }
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packed.write_all(&whole).unwrap();
    assert!(error(packed.finish().unwrap()).contains("compressed database"));
    let text = RecordingOptions { format: Some(RecordingFormat::Juelich), ..options() };
    assert!(error_with(&whole, &text).contains("it is an SQLite database"));
    let database = RecordingOptions { format: Some(RecordingFormat::Jupedsim), ..options() };
    assert!(error_with("1 1 0 0\n", &database).contains("it is no SQLite database"));
}

#[test]
fn a_file_that_vanishes_after_it_was_opened_is_told() {
    let file = given("#framerate: 10\n1 0 0 0\n1 1 0 0.1\n");
    let recording = Recording::open(&file.path, &options()).unwrap();
    std::fs::remove_file(&file.path).unwrap();
    assert!(recording.motion().err().unwrap().to_string().contains("recording"));
    assert!(!Path::new(&file.path).exists());
}
