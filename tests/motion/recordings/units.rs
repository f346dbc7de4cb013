//! What is assumed where files do not say, and what is told of it.

use trodden::recordings::{LengthUnit, RecordingOptions, Survey};

use super::{frames, open_with, options};

/// People who walk at 1.3 m/s in these units, `fps` rows a second.
fn walk(fps: f64, per_metre: f64, step: u32) -> String {
    let row = |id: u32, k: u32| {
        let along = 1.3 * per_metre * f64::from(k) / fps;
        format!("{id} {} {along:.4} {}\n", 100 + step * k, per_metre * f64::from(id))
    };
    (0..5).flat_map(|id| (0..80).map(move |k| row(id, k))).collect()
}

fn survey(text: &str, options: &RecordingOptions) -> Survey {
    open_with(text, options).unwrap().survey().clone()
}

#[test]
fn an_unknown_rate_is_assumed_by_how_fast_people_walk() {
    let found = survey(&walk(16.0, 100.0, 1), &options());
    assert_eq!((found.fps, found.unit), (16.0, LengthUnit::Centimetre));
    assert_eq!(found.warnings.len(), 2, "{:?}", found.warnings);
    assert!(found.warnings.iter().all(|w| w.starts_with("the file gives no")), "{:?}", found.warnings);
    assert!((found.mean_speed_m_s - 1.3).abs() < 0.01);
    let named = format!("# id frame x/m y/m\n{}", walk(30.0, 1.0, 1));
    let found = survey(&named, &options());
    assert!((25.0..=30.0).contains(&found.fps) && found.warnings[0].contains("plausibly"), "{found:?}");
    let found = survey(&named, &RecordingOptions { fps: Some(30.0), ..options() });
    assert!(found.warnings.is_empty() && found.fps == 30.0, "{found:?}");
}

#[test]
fn what_the_file_says_is_believed_but_absurd_speeds_are_told() {
    // The header says metres, the numbers are centimetres.
    let lies = format!("# framerate: 25\n# id frame x/m y/m\n{}", walk(25.0, 100.0, 1));
    let found = survey(&lies, &options());
    assert_eq!(found.unit, LengthUnit::Metre);
    assert!(
        found.warnings[0].contains("faster than 130.000 m/s") && found.warnings[0].contains("the option `unit`"),
        "{found:?}"
    );
    // The header says 25 frames per second, and so many were counted, but every tenth was kept: 2.5 Hz is right.
    let sparse = format!("# framerate: 25\n# id frame x/m y/m\n{}", walk(2.5, 1.0, 10));
    let found = survey(&sparse, &options());
    assert!(found.warnings.is_empty() && found.fps == 2.5, "{found:?}");
    // Frames were numbered anew, so 25 is a lie; 13 m/s is noticed.
    let found = survey(&sparse.replace("framerate: 25", "framerate: 250"), &options());
    assert!(
        found.warnings[0].contains("faster than 13.000 m/s") && found.warnings[0].contains("the option `fps`"),
        "{found:?}"
    );
    let slow = "time_s,id,x,y\n0,1,0,0\n100,1,1,0\n200,1,2,0\n";
    assert!(survey(slow, &options()).warnings[0].contains("slower than 0.010 m/s"));
}

#[test]
fn milliseconds_are_told_by_speeds() {
    let row = |k: u32| format!("{},1,{:.3},0\n", 50 * k, 1.3 * 0.05 * f64::from(k));
    let text: String = std::iter::once("time,id,x,y\n".to_owned()).chain((0..40).map(row)).collect();
    let (recording, frames) = frames(text, &options());
    assert!((frames[20].time_s - 1.0).abs() < 1e-9);
    assert_eq!(recording.survey().fps, 20.0);
    assert!(recording.survey().warnings[0].contains("milliseconds"));
}

#[test]
fn options_out_of_range_are_refused() {
    let text = walk(16.0, 1.0, 1);
    let with = |change: fn(&mut RecordingOptions)| {
        let mut asked = options();
        change(&mut asked);
        open_with(&text, &asked).unwrap_err().to_string()
    };
    assert!(with(|o| o.fps = Some(0.0)).contains("fps = 0"));
    assert!(with(|o| o.fps = Some(f64::NAN)).contains("fps = NaN"));
    assert!(with(|o| o.shift = [f64::INFINITY, 0.0]).contains("shift"));
    assert!(with(|o| o.origin = [0.0, f64::NAN]).contains("origin"));
    assert!(with(|o| o.rotation_deg = f64::NAN).contains("rotation"));
    for (columns, problem) in [
        ("id,frame,x", "no column for y"),
        ("id,x,y", "no column for the time or frame"),
        ("id,frame,x,y,x", "`x` comes twice"),
        ("id,frame,x,y,hat", "`hat` is none of"),
        ("", "is none of"),
    ] {
        let asked = RecordingOptions { columns: Some(columns.to_owned()), ..options() };
        let error = open_with(&text, &asked).unwrap_err();
        assert!(error.to_string().contains(problem), "{columns}: {error}");
        assert!(error.hint().unwrap().contains("the option `columns = \"id,frame,x,y\"`"));
    }
}
