//! People who are missing for a while, rates that change, rows in disorder.

use trodden::math::vec2;

use super::{frames, options, places};

#[test]
fn a_short_gap_is_bridged_and_after_a_long_one_somebody_else_comes() {
    let mut text = "# framerate: 10\n# id frame x/m y/m\n".to_owned();
    for frame in 0..60 {
        text += &format!("8 {frame} 0 {}\n", 0.1 * f64::from(frame));
        // Missing for 0.9 s, and later for 1.2 s.
        if !(10..18).contains(&frame) && !(30..41).contains(&frame) {
            text += &format!("5 {frame} {} 0\n", 0.1 * f64::from(frame));
        }
    }
    for (text, in_order) in [(text.clone(), true), (by_person(&text), false)] {
        let (recording, frames) = frames(&text, &options());
        assert_eq!((recording.survey().people, recording.survey().returns), (2, 1));
        assert_eq!(recording.survey().in_order, in_order);
        assert_eq!(frames.len(), 60);
        for (k, frame) in frames.iter().enumerate() {
            let ids: Vec<u32> = frame.walkers.iter().map(|walker| walker.id).collect();
            let expected: &[u32] = match k {
                0..30 => &[5, 8],
                30..41 => &[8],
                _ => &[8, 9],
            };
            assert_eq!(ids, expected, "{k}");
            let walker = frame.walkers[if k < 30 { 0 } else { ids.len() - 1 }];
            if ids.len() == 2 {
                assert!(walker.position_m.distance(vec2(0.1 * k as f64, 0.0)) < 1e-12, "{k}");
                assert!((walker.velocity_m_s.x - 1.0).abs() < 1e-9, "{k}: {walker:?}");
            }
        }
    }
}

/// The same text by person.
fn by_person(text: &str) -> String {
    let (head, mut rows): (Vec<&str>, Vec<&str>) = text.lines().partition(|line| line.starts_with('#'));
    rows.sort_by_key(|row| row.split(' ').next().unwrap().parse::<u32>().unwrap());
    head.into_iter().chain(rows).map(|line| format!("{line}\n")).collect()
}

#[test]
fn somebody_seen_seldom_is_not_missing() {
    let text: String = (0..10).map(|k| format!("1,{},{},0\n", 3 * k, 3 * k)).collect();
    let (recording, frames) = frames(format!("id,time_s,x,y\n{text}"), &options());
    assert_eq!((recording.survey().returns, frames.len()), (0, 10));
    assert!(frames.iter().all(|frame| frame.walkers[0].id == 1));
}

#[test]
fn who_was_elsewhere_in_between_is_somebody_else() {
    let text = "#framerate: 10\n1 0 0 0\n2 0 9 9\n2 1 9 9\n2 2 9 9\n2 3 9 9\n2 4 9 9\n1 5 40 0\n2 5 9 9\n";
    let (_, frames) = frames(text, &options());
    assert_eq!(frames[5].walkers[1].id, 3);
    assert!(frames[1..5].iter().all(|frame| frame.walkers.len() == 1));
}

#[test]
fn nobody_is_there_for_a_while() {
    let text = "#framerate: 10\n1 0 0 0\n1 1 0.1 0\n1 900 5 0\n1 901 5.1 0\n";
    let (recording, frames) = frames(text, &options());
    assert_eq!(recording.survey().span_s, [0.0, 90.1]);
    assert_eq!(places(&frames).iter().map(|place| place.1).collect::<Vec<_>>(), [1, 1, 2, 2]);
    assert!(frames.iter().all(|frame| (frame.walkers[0].velocity_m_s.x - 1.0).abs() < 1e-9));
}

#[test]
fn rates_change_within_a_file() {
    let mut times: Vec<f64> = (0..25).map(|k| 0.4 * f64::from(k)).collect();
    times.extend((1..600).map(|k| 9.6 + f64::from(k) / 60.0));
    let text: String = times.iter().map(|t| format!("4,{t},{},1\n", 1.2 * t)).collect();
    let (recording, frames) = frames(format!("id,t,x,y\n{text}"), &options());
    assert_eq!((recording.survey().fps, frames.len(), recording.survey().returns), (60.0, times.len(), 0));
    assert!(frames.iter().all(|frame| (frame.walkers[0].velocity_m_s.x - 1.2).abs() < 1e-6));
}

#[test]
fn people_with_clocks_of_their_own_are_shown_at_common_moments() {
    // Ten players, ten times a second each, at times of their own.
    let mut rows: Vec<(u32, u32)> =
        (0..10).flat_map(|id| (0..50).map(move |k| (7 * id + 100 * k + (id * k) % 3, id))).collect();
    rows.sort_unstable();
    let text: String = rows.iter().map(|(ms, id)| format!("{ms},p{id},{},{id}\n", 0.0013 * f64::from(*ms))).collect();
    let (recording, frames) = frames(format!("time_ms,player,x,y\n{text}"), &options());
    assert_eq!((recording.survey().people, recording.survey().fps), (10, 10.0));
    assert!((49..=50).contains(&frames.len()), "{}", frames.len());
    for frame in &frames[1..49] {
        assert_eq!(frame.walkers.len(), 10, "{}", frame.time_s);
        assert!(frame.walkers.iter().all(|walker| (walker.position_m.x - 1.3 * frame.time_s).abs() < 1e-9));
    }
}

#[test]
fn repeated_rows_and_rows_in_disorder_do_no_harm() {
    let rows = ["1 0 0 0", "2 0 5 5", "1 1 0.1 0", "2 1 5 5.1", "1 2 0.2 0", "2 2 5 5.2"];
    let in_order = format!("#framerate: 10\n{}\n", rows.join("\n"));
    let expected = frames(&in_order, &options()).1;
    let mixed = format!("#framerate: 10\n{}\n{}\n# a comment\n\n{}\n", rows[4], rows.join("\n"), rows[1]);
    let (recording, found) = frames(mixed, &options());
    assert_eq!(found, expected);
    assert!(!recording.survey().in_order);
    assert!(recording.survey().warnings[0].contains("2 rows repeat others"));
}

#[test]
fn frames_may_begin_below_zero_and_files_may_be_joined() {
    let text = "id,frame,x,y\n1,-2,0,0\n1,-1,0.1,0\nid,frame,x,y\n1,0,0.2,0\n";
    let (_, frames) = frames(text, &trodden::recordings::RecordingOptions { fps: Some(10.0), ..options() });
    assert_eq!(places(&frames), [(0.0, 1, 0.0, 0.0), (0.1, 1, 0.1, 0.0), (0.2, 1, 0.2, 0.0)]);
}

#[test]
fn rows_without_a_place_are_gaps() {
    let text = "id,time,x,y\n1,0,0,0\n2,0,,\n1,0.1,nan,NaN\n2,0.1,3,3\n1,0.2,0.2,0\n2,0.2,3,\n";
    let (recording, frames) = frames(text, &options());
    let expected = [(0.0, 1, 0.0, 0.0), (0.1, 1, 0.1, 0.0), (0.1, 2, 3.0, 3.0), (0.2, 1, 0.2, 0.0)];
    assert_eq!(places(&frames), expected);
    let told = &recording.survey().warnings[0];
    assert!(told.contains("3 rows have no place, the first in line 3"), "{told}");
}

#[test]
fn a_file_that_breaks_off_is_read_up_to_there() {
    let (recording, frames) = frames("id,time,x,y\n1,0,0,0\n1,1,1,0\n1,2", &options());
    assert_eq!(frames.len(), 2);
    assert!(recording.survey().warnings[0].contains("breaks off in line 4"));
}
