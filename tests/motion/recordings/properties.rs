//! Whatever is in a file, nothing panics; whatever motion is written, it comes back.

use std::collections::BTreeMap;

use proptest::prelude::*;
use trodden::math::vec2;
use trodden::motion::Frame;
use trodden::recordings::{Recording, RecordingOptions};

use super::{frames, given, options, places};

/// Reads a file as far as it goes, without looking at what comes.
fn read(bytes: &[u8], options: &RecordingOptions) {
    let file = given(bytes);
    let Ok(recording) = Recording::open(&file.path, options) else { return };
    let mut motion = recording.motion().unwrap();
    let mut frame = Frame::default();
    let mut last_s = f64::NEG_INFINITY;
    for _ in 0..10_000 {
        match motion.next_frame(&mut frame) {
            Ok(true) => assert!(frame.time_s > last_s, "{} after {last_s}", frame.time_s),
            _ => break,
        }
        last_s = frame.time_s;
        assert!(frame.walkers.windows(2).all(|pair| pair[0].id < pair[1].id));
    }
}

fn columns() -> impl Strategy<Value = Option<String>> {
    prop_oneof![Just(None), Just(Some("id,time,x,y".to_owned())), Just(Some("frame,id,x,-y,z".to_owned()))]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_bytes_are_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        read(&bytes, &options());
    }

    #[test]
    fn anything_like_a_table_is_read_or_refused(
        header in "(#framerate: [0-9.]{1,3}\n)?(#? ?(id|time|t|frame|x|y|z|v_x|end_time|endx)([ ,;](id|time|frame|x|y|z|vx|vy)){2,5}\n)?",
        rows in "([0-9]{1,3}([ ,;\t][-0-9.]{0,4}(nan|inf|e9|\")?){2,5}\n?){0,12}",
        columns in columns(),
    ) {
        read(format!("{header}{rows}").as_bytes(), &RecordingOptions { columns, ..options() });
    }

    #[test]
    fn numbers_of_any_size_are_read_or_refused(rows in proptest::collection::vec((0u32..3, any::<f64>(), any::<f64>(), any::<f64>()), 1..12)) {
        let text: String = rows.iter().map(|(id, t, x, y)| format!("{id},{t},{x},{y}\n")).collect();
        read(format!("id,time_s,x,y\n{text}").as_bytes(), &options());
        let whole: String = rows.iter().map(|(id, t, x, y)| format!("{id} {:.0} {x} {y}\n", t % 1e18)).collect();
        read(format!("#framerate: 25\n{whole}").as_bytes(), &options());
    }

    #[test]
    fn damaged_recordings_are_read_or_refused(at in 0usize..400, byte in any::<u8>(), cut in 0usize..400) {
        let mut text: Vec<u8> = b"# framerate: 25 fps\n# id frame x/m y/m z/m\n".to_vec();
        (0..20).for_each(|k| text.extend(format!("{}\t{k}\t{}.5\t-{k}.25\t1.7\n", k % 2, k % 3).bytes()));
        let length = text.len();
        text[at % length] = byte;
        text.truncate(length - cut % length);
        read(&text, &options());
    }
}

/// Places by person and frame, in 0.1 mm: everybody comes once and stays for a while, nobody faster than 10 m/s.
fn motions() -> impl Strategy<Value = BTreeMap<(u32, u32), (i32, i32)>> {
    let person = (0u32..1_000_000, 0u32..30, (-100_000i32..100_000, -100_000i32..100_000));
    let steps = proptest::collection::vec((-4000i32..4000, -4000i32..4000), 2..40);
    proptest::collection::vec((person, steps), 1..6).prop_map(|people| {
        let mut places = BTreeMap::new();
        let ids: std::collections::BTreeSet<u32> = people.iter().map(|((id, ..), _)| *id).collect();
        for (id, ((_, start, at), steps)) in ids.into_iter().zip(people) {
            let mut at = at;
            for (k, step) in (0..).zip(steps) {
                places.insert((start + k, id), at);
                at = (at.0 + step.0, at.1 + step.1);
            }
        }
        places
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn a_motion_written_in_any_format_comes_back(places_by in motions(), seed in any::<u64>()) {
        let first = places_by.keys().next().unwrap().0;
        let expected: Vec<(f64, u32, f64, f64)> = (places_by.iter())
            .map(|(&(frame, id), &(x, y))| (f64::from(frame - first) / 25.0, id, f64::from(x) / 1e4, f64::from(y) / 1e4))
            .collect();
        let rows: Vec<(u32, u32, f64, f64)> =
            places_by.iter().map(|(&(frame, id), &(x, y))| (frame, id, f64::from(x) / 1e4, f64::from(y) / 1e4)).collect();
        let mut by_person = rows.clone();
        by_person.sort_by_key(|row| (row.1, row.0));
        let mut mixed = rows.clone();
        mixed.sort_by_key(|row| (u64::from(row.0 * 31 + row.1) ^ seed).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let write = |rows: &[(u32, u32, f64, f64)], header: &str, row: fn(f64, u32, u32, f64, f64) -> String| {
            rows.iter().fold(header.to_owned(), |text, &(frame, id, x, y)| text + &row(f64::from(frame) / 25.0, frame, id, x, y))
        };
        for rows in [&rows, &by_person, &mixed] {
            for (header, row) in [
                ("#framerate: 25\n#id frame x/m y/m\n", (|_, f, id, x, y| format!("{id} {f} {x} {y}\n")) as fn(f64, u32, u32, f64, f64) -> String),
                ("#framerate: 25\n#id frame x/cm y/cm\n", |_, f, id, x, y| format!("{id}\t{f}\t{:.2}\t{:.2}\n", 100.0 * x, 100.0 * y)),
                ("pedestrianId simTime startX-PID1 startY-PID1\n", |t, _, id, x, y| format!("{id} {t} {x} {y}\n")),
                ("time,pedID,posX,posY\n", |t, _, id, x, y| format!("{t:.2},{id},{x},{y}\n")),
                ("$VISION\n$PEDESTRIAN:NO;SIMSEC;COORDCENTX;COORDCENTY\n", |t, _, id, x, y| format!("{id};{t};{x};{y}\n").replace('.', ",")),
                ("id,t,x,y\n,s,m,m\n", |t, _, id, x, y| format!("{id},{t},{x},{y}\n")),
                ("time_ms,player,x_m,y_m\n", |t, _, id, x, y| format!("{},{id},{x},{y}\n", (1000.0 * t).round())),
            ] {
                let text = write(rows, header, row);
                let (recording, found) = frames(&text, &options());
                // A place that is there once only, or seldom, may take part in an own clock.
                prop_assert_eq!(recording.survey().places, expected.len());
                let found = places(&found);
                prop_assert_eq!(found.len(), expected.len(), "{}", text);
                for (a, b) in found.iter().zip(&expected) {
                    prop_assert_eq!(a.1, b.1);
                    prop_assert!((a.0 - b.0).abs() < 1e-9 && vec2(a.2, a.3).distance(vec2(b.2, b.3)) < 1e-9, "{:?} {:?}", a, b);
                }
            }
        }
    }
}
