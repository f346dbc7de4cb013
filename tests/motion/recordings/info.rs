//! `trodden motion info`, progress and interruption.

use std::path::Path;
use std::process::Command;
use std::sync::Mutex;

use trodden::recordings::{Recording, RecordingError};
use trodden::{Progress, Stage};

use super::{given, options};

/// Two people walk a circle in centimetres, ten times a second.
fn circles() -> String {
    let row = |id: u32, k: u32| {
        let (sin, cos) = trodden::math::sin_cos(0.05 * f64::from(k) + f64::from(id));
        format!("{id} {k} {:.2} {:.2} {}\n", 250.0 * cos, 250.0 * sin, 160 + id)
    };
    let rows: String = (0..200).flat_map(|k| [row(1, k), row(2, k)]).collect();
    format!("#framerate: 10\n{rows}")
}

/// Whether it succeeded, and what it printed, to standard output and error.
fn info(file: &Path, more: &[&str]) -> (bool, String, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_trodden")).args(["motion", "info"]).arg(file).args(more).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.success(), text(output.stdout), text(output.stderr))
}

#[test]
fn a_recording_is_summed_up_and_drawn() {
    let file = given(circles());
    let picture = file.path.with_extension("png");
    let (done, out, err) = info(&file.path, &["--paths", picture.to_str().unwrap()]);
    assert!(done, "{err}");
    let expected = [
        "format     Juelich text, in centimetres",
        "people     2, 400 places",
        "time       19.90 s, 200 moments, 10 frames per second",
        "present    19.90 s each in the mean, 39.8 s together",
        "speed      1.25 m/s in the mean",
        "extent     5.00 x 5.00 m, from (-2.50, -2.50) to (2.50, 2.50)",
    ];
    assert_eq!(out.lines().collect::<Vec<_>>(), expected);
    assert!(err.starts_with("warning: the file gives no unit of lengths: centimetres are assumed"), "{err}");
    let picture = image::open(&picture).unwrap().to_rgb8();
    assert!(picture.width() >= 300 && picture.pixels().any(|pixel| pixel.0[0].abs_diff(pixel.0[2]) > 40));
    let (done, out, _) = info(&file.path, &["--unit", "m", "--json", "-q"]);
    let json: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert!(done && json["people"] == 2 && json["format"] == "juelich" && json["unit"] == "m", "{out}");
    assert!(json["warnings"][0].as_str().unwrap().contains("faster than 124."), "{out}");
}

#[test]
fn what_is_converted_is_all_there() {
    let file = given(circles());
    let written = file.path.with_extension("txt");
    let mut convert = Command::new(env!("CARGO_BIN_EXE_trodden"));
    let output = convert.args(["motion", "convert", "-q"]).arg(&file.path).arg("-o").arg(&written).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let recordings = [&file.path, &written].map(|path| Recording::open(path, &options()).unwrap());
    let [own, again] = recordings.map(|recording| super::places(&super::frames_of(&recording)));
    assert_eq!((own.len(), again.len()), (400, 400));
    for (a, b) in own.iter().zip(&again) {
        let near = [a.0 - b.0, a.2 - b.2, a.3 - b.3].iter().all(|off| off.abs() < 1e-9);
        assert!(a.1 == b.1 && near, "{a:?} {b:?}");
    }
}

#[test]
fn what_is_wrong_is_said_with_a_hint() {
    let file = given("#framerate: 10\n1 0 0 0\n1 1 here 0\n1 2 0 0\n");
    let (done, out, err) = info(&file.path, &[]);
    assert!(!done && out.is_empty());
    assert!(
        err.contains("recording, line 3: x is `here`, which is no number\nhint: name the columns with --columns"),
        "{err}"
    );
}

/// Stops the work after so many looks.
struct Impatient(Mutex<u32>);

impl Progress for Impatient {
    fn advance(&self, stage: Stage, share: f64) {
        assert!(stage == Stage::Motion && (0.0..1.0).contains(&share));
    }

    fn warn(&self, _: &str) {}

    fn interrupted(&self) -> bool {
        let mut left = self.0.lock().unwrap();
        *left = left.saturating_sub(1);
        *left == 0
    }
}

#[test]
fn looking_through_a_large_file_can_be_interrupted() {
    let rows = |ids: [u32; 2]| ids.map(|id| (0..100_000).map(move |k| format!("{id},{k},0.{k},1\n")));
    let by_person: String = rows([1, 2]).into_iter().flatten().collect();
    let file = given(format!("id,frame,x,y\n{by_person}"));
    for looks in [1, 2, 4, 6] {
        let stopped = Recording::open_watched(&file.path, &options(), &Impatient(Mutex::new(looks)));
        assert!(matches!(stopped, Err(RecordingError::Interrupted { .. })), "{looks}");
    }
    Recording::open_watched(&file.path, &options(), &Impatient(Mutex::new(1000))).unwrap();
}
