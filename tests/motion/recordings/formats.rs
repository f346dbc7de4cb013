//! What each format's files look like, and what comes out.

use std::io::Write;

use trodden::math::vec2;
use trodden::recordings::{LengthUnit, RecordingFormat, RecordingOptions};

use super::{frames, open_with, options, places};

/// Two people over three moments, half a second apart: 3 walks along x, 7 comes later.
const EXPECTED: [(f64, u32, f64, f64); 5] =
    [(0.0, 3, 1.0, 2.0), (0.5, 3, 1.5, 2.25), (0.5, 7, 4.0, -1.0), (1.0, 3, 2.0, 2.5), (1.0, 7, 4.0, -0.5)];

fn assert_read(content: &str, format: RecordingFormat) {
    assert_read_with(content, format, &options());
}

fn assert_read_with(content: &str, format: RecordingFormat, options: &RecordingOptions) {
    for content in [content.to_owned(), content.replace('\n', "\r\n"), format!("\u{feff}{content}")] {
        let (recording, frames) = frames(&content, options);
        assert_eq!(places(&frames), EXPECTED, "{content}");
        let survey = recording.survey();
        assert_eq!((survey.format, survey.people, survey.places, survey.frames), (format, 2, 5, 3), "{content}");
        assert_eq!((survey.fps, survey.span_s, survey.largest_id), (2.0, [0.0, 1.0], 7), "{content}");
        assert_eq!((survey.bounds_m.min, survey.bounds_m.max), (vec2(1.0, -1.0), vec2(4.0, 2.5)));
    }
}

#[test]
fn juelich_text_has_many_headers() {
    let by_person = "3 10 1 2 1.7\n3 11 1.5 2.25 1.7\n3 12 2 2.5 1.7\n7 11 4 -1 1.7\n7 12 4 -0.5 1.7\n";
    for header in [
        "# framerate: 2.00\n# id frame x/m y/m z/m\n",
        "#framerate: 2\n# ID\tframe\tX\tY\tZ\n",
        "# description: a test\n# framerate: 2 fps\n#geometry: geometry.xml\n\n# PersID\tFrame\tX\tY\tZ\n",
        "#framerate:2fps\n",
        "# Framerate = 2.0 fps\n",
        "#ID: the agent ID\n#FR: the current frame\n#framerate: 2\n#X,Y,Z: the agents coordinates (in metres)\n\n#ID FR X Y Z\n",
    ] {
        assert_read(&format!("{header}{by_person}"), RecordingFormat::Juelich);
        assert_read(&format!("{header}{}", by_person.replace(' ', "\t")), RecordingFormat::Juelich);
        assert_read(&format!("{header}{}", by_person.replace(" 1.7\n", " 1.7 9 0 extra\n")), RecordingFormat::Juelich);
    }
    let by_frame = "# framerate: 2\n3 10 1 2\n3 11 1.5 2.25\n7 11 4 -1\n3 12 2 2.5\n7 12 4 -.5\n";
    assert_read(by_frame, RecordingFormat::Juelich);
}

#[test]
fn centimetres_are_told_by_the_column_line_or_by_heights() {
    let rows = "3 10 100 200 170\n3 11 150 225 170\n3 12 200 250 170\n7 11 400 -100 165\n7 12 400 -50 165\n";
    assert_read(&format!("# framerate: 2\n# id frame x/cm y/cm z/cm\n{rows}"), RecordingFormat::Juelich);
    assert_read(&format!("# framerate: 2\n{rows}"), RecordingFormat::Juelich);
    let asked = RecordingOptions { fps: Some(2.0), unit: Some(LengthUnit::Centimetre), ..options() };
    assert_read_with(rows, RecordingFormat::Juelich, &asked);
    let survey = open_with(rows, &RecordingOptions { fps: Some(2.0), ..options() }).unwrap().survey().clone();
    assert_eq!(survey.unit, LengthUnit::Centimetre);
    assert!(
        survey.warnings.iter().any(|w| w.contains("heights") && w.contains("the option `unit`")),
        "{:?}",
        survey.warnings
    );
}

#[test]
fn comma_separated_text_with_names_is_read_with_its_velocities_and_rate() {
    let row = |id: u32, frame: u32, x: f64| format!("{id},{frame},{x},0.5,0.4,0.1\n");
    let mut text = "ID,Frame,x,y,v_x,v_y\n".to_owned();
    // 0.165 m per 10 frames at 25 frames a second are 0.4123 m/s.
    (0..20).for_each(|k| text += &row(21, 1010 + 10 * k, 0.2 + 0.165 * f64::from(k)));
    let (recording, frames) = frames(&text, &options());
    let survey = recording.survey();
    assert_eq!((survey.format, survey.fps, survey.span_s[1]), (RecordingFormat::Csv, 2.5, 7.6));
    assert!(survey.warnings[0].contains("25 frames per second fit"), "{:?}", survey.warnings);
    assert!(frames.iter().all(|frame| frame.walkers[0].velocity_m_s == vec2(0.4, 0.1)));
}

#[test]
fn own_velocities_that_do_not_fit_are_not_used() {
    let row = |k: u32| format!("1,{k},{},0,4.0,0\n", 0.1 * f64::from(k));
    let text: String = std::iter::once("id,frame,x,y,vx,vy\n".to_owned()).chain((0..20).map(row)).collect();
    let (recording, frames) = frames(text, &RecordingOptions { fps: Some(10.0), ..options() });
    assert!(recording.survey().warnings[0].contains("40 would fit"), "{:?}", recording.survey().warnings);
    assert!((frames[5].walkers[0].velocity_m_s.x - 1.0).abs() < 1e-9);
}

#[test]
fn vadere_tells_where_steps_begin() {
    let text = "pedestrianId simTime startX-PID1 startY-PID1 targetId-PID2\n\
        3 0.0 1 2 5\n3 0.5 1.5 2.25 5\n7 0.5 4 -1 5\n3 1.0 2 2.5 5\n7 1.0 4 -0.5 5\n";
    assert_read(text, RecordingFormat::Vadere);
}

#[test]
fn steps_that_begin_when_they_like_are_shown_at_common_moments() {
    // 1 steps every 0.4 s by 0.5 m, stands for 3 s, and goes on; 2 begins in between.
    let mut text =
        "pedestrianId simTime endTime-PID1 startX-PID1 startY-PID1 endX-PID1 endY-PID1 targetId-PID2\n".to_owned();
    for k in 0..10 {
        let (from_s, x) = (0.4 * f64::from(k) + if k < 5 { 0.0 } else { 3.0 }, 0.5 * f64::from(k));
        text += &format!("1 {from_s} {} {x} 0 {} 0 9\n", from_s + 0.4, x + 0.5);
        let (from_s, y) = (0.13 + 0.37 * f64::from(k), 0.4 * f64::from(k));
        text += &format!("2 {from_s} {} 0 {y} 0 {} 9\n", from_s + 0.37, y + 0.4);
    }
    let (recording, frames) = frames(text, &options());
    let survey = recording.survey();
    assert_eq!((survey.format, survey.people, survey.fps), (RecordingFormat::Vadere, 2, 10.0));
    for frame in &frames {
        let t = frame.time_s;
        assert!((t * 10.0 - (t * 10.0).round()).abs() < 1e-9, "{t}");
        let x = if t < 2.0 { t / 0.4 * 0.5 } else { ((t - 3.0).max(2.0) / 0.4 * 0.5).min(5.0) };
        let first = frame.walkers.iter().find(|walker| walker.id == 1);
        assert_eq!(first.is_some(), t <= 7.0 + 1e-9, "{t}");
        assert!(first.is_none_or(|walker| (walker.position_m.x - x).abs() < 1e-9), "{t}");
        let second = frame.walkers.iter().find(|walker| walker.id == 2);
        assert_eq!(second.is_some(), (0.13..3.83).contains(&t), "{t}");
        assert!(second.is_none_or(|walker| (walker.position_m.y - (t - 0.13) / 0.37 * 0.4).abs() < 1e-9), "{t}");
        if let Some(walker) = first.filter(|_| (2.2..4.8).contains(&t)) {
            assert_eq!(walker.velocity_m_s.x, 0.0, "{t}");
        }
    }
    assert_eq!(frames.last().unwrap().time_s, 7.0);
}

#[test]
fn crowdit_viswalk_and_pathfinder_write_csv() {
    let crowdit = "time,pedID,posX,posY\n0.00,3,1,2\n0.50,3,1.5,2.25\n0.50,7,4,-1\n1.00,3,2,2.5\n1.00,7,4,-0.5\n";
    assert_read(crowdit, RecordingFormat::Crowdit);
    let viswalk = "$VISION\n* File: a.inpx\n* Comment: ; 1\n$PEDESTRIAN:NO;SIMSEC;COORDCENTX;COORDCENTY;SPEED\n\
        3;0,0;1,0;2;1\n3;0,5;1,5;2,25;1\n7;0,5;4;-1;1\n3;1,0;2;2,5;1\n7;1,0;4;-0,5;1\n";
    assert_read(viswalk, RecordingFormat::Viswalk);
    assert_read(&viswalk.replace(',', "."), RecordingFormat::Viswalk);
    assert_read(&viswalk.replace("$PEDESTRIAN:", "$VEHICLE:"), RecordingFormat::Viswalk);
    let pathfinder = "t,id,name,x,y,z,v\ns,,,m,m,m,m/s\n0,3,\"A, b\",1,2,0,1\n0.5,3,\"A, b\",1.5,2.25,0,1\n\
        0.5,7,c,4,-1,0,1\n1,3,\"A, b\",2,2.5,0,1\n1,7,c,4,-0.5,0,1\n";
    assert_read(pathfinder, RecordingFormat::Pathfinder);
}

#[test]
fn obsmat_is_annotated_at_2_5_per_second() {
    let number = |value: f64| {
        let (mut mantissa, mut exponent) = (value, 0);
        while mantissa.abs() >= 10.0 {
            (mantissa, exponent) = (mantissa / 10.0, exponent + 1);
        }
        format!("  {mantissa:.7}e{exponent:+03}")
    };
    let mut text = String::new();
    for k in 0..30 {
        for id in [4, 9] {
            let x = f64::from(id) + 0.5 * f64::from(k);
            let row = [780.0 + 6.0 * f64::from(k), f64::from(id), x, 0.0, 0.25 * f64::from(id), 1.25, 0.0, 0.0];
            text += &(row.map(number).concat() + "\n");
        }
    }
    let (recording, frames) = frames(&text, &options());
    let survey = recording.survey();
    assert_eq!((survey.format, survey.fps, survey.people, frames.len()), (RecordingFormat::Obsmat, 2.5, 2, 30));
    assert_eq!(frames[0].walkers[1].position_m, vec2(9.0, 2.25));
    assert!((frames[3].time_s - 1.2).abs() < 1e-12);
    assert_eq!(frames[3].walkers[0].velocity_m_s, vec2(1.25, 0.0));
    // Without velocities the rate is a custom.
    let narrow: String = text
        .lines()
        .map(|line| {
            let fields: Vec<&str> = line.split_whitespace().collect();
            format!("{}\t{}\t{}\t{}\n", fields[0], fields[1], fields[2], fields[4])
        })
        .collect();
    let (recording, again) = super::frames(&narrow, &options());
    assert_eq!((recording.survey().format, recording.survey().fps), (RecordingFormat::Obsmat, 2.5));
    assert!(recording.survey().warnings[0].contains("2.5 annotations per second"), "{:?}", recording.survey().warnings);
    assert_eq!(places(&again).len(), places(&frames).len());
}

#[test]
fn telemetry_names_its_columns_in_many_ways() {
    for text in [
        "player_id,time,x,y\n3,0,1,2\n3,0.5,1.5,2.25\n7,0.5,4,-1\n3,1,2,2.5\n7,1,4,-0.5\n",
        "Timestamp_ms;PlayerID;PosX;PosY\n1000;3;1;2\n1500;3;1,5;2,25\n1500;7;4;-1\n2000;3;2;2,5\n2000;7;4;-0,5\n",
        "t\tuser\tx [cm]\ty [cm]\n0\t3\t100\t200\n0.5\t3\t150\t225\n0.5\t7\t400\t-100\n1\t3\t200\t250\n1\t7\t400\t-50\n",
        "datetime,id,health,x,y\n2024-05-01T23:59:59.5Z,3,9,1,2\n2024-05-02T00:00:00Z,3,9,1.5,2.25\n\
         2024-05-02T00:00:00Z,7,9,4,-1\n2024-05-02T00:00:00.5Z,3,9,2,2.5\n2024-05-02T00:00:00.5Z,7,,4,-0.5\n",
        "time,agent,position.x,position.y\n1714600000.0,3,1,2\n1714600000.5,3,1.5,2.25\n1714600000.5,7,4,-1\n\
         1714600001.0,3,2,2.5\n1714600001.0,7,4,-0.5\n",
        "timestamp,id,x,y\n1714600000000,3,1,2\n1714600000500,3,1.5,2.25\n1714600000500,7,4,-1\n\
         1714600001000,3,2,2.5\n1714600001000,7,4,-0.5\n",
        "row,no,time_s,x,-y\n0,3,0,1,-2\n1,3,.5,1.5,-2.25\n2,7,.5,4,1\n3,3,1,2,-2.5\n4,7,1,4,.5\n",
    ] {
        assert_read(text, RecordingFormat::Csv);
    }
}

#[test]
fn names_are_numbered_as_they_appear() {
    let text = "name,time,x,y\nZoe,0,0,0\nAda,0,1,1\nZoe,1,0.5,0\nAda,1,1,1.5\n7,1,3,3\n";
    for text in [text.to_owned(), text.replace("name", "id").replace("Zoe", "12345678901").replace("Ada", "1.5")] {
        let (recording, frames) = frames(&text, &options());
        let expected =
            [(0.0, 1, 0.0, 0.0), (0.0, 2, 1.0, 1.0), (1.0, 1, 0.5, 0.0), (1.0, 2, 1.0, 1.5), (1.0, 3, 3.0, 3.0)];
        assert_eq!(places(&frames), expected, "{text}");
        assert_eq!(recording.survey().largest_id, 3);
    }
}

#[test]
fn a_row_number_is_nobody() {
    let text = "id,player,time,x,y\n1,5,0,0,0\n2,6,0,1,1\n3,5,1,1,0\n4,6,1,2,1\n";
    let (recording, _) = frames(text, &options());
    assert_eq!((recording.survey().people, recording.survey().largest_id), (2, 6));
}

#[test]
fn one_persons_telemetry_needs_no_id() {
    let (recording, frames) = frames("time,x,y\n0,0,0\n1,1,0\n2,2,0\n", &options());
    assert_eq!((recording.survey().people, frames.len()), (1, 3));
    assert!(recording.survey().warnings[0].contains("one person"));
}

#[test]
fn games_that_count_y_upward_walk_on_x_and_z() {
    let row = |k: u32| format!("1,{},{},1.8{},{}\n", k, 1.5 * f64::from(k), k % 3, 2.0 * f64::from(k));
    let text: String = std::iter::once("id,time,x,y,z\n".to_owned()).chain((0..20).map(row)).collect();
    let (recording, frames) = frames(text, &options());
    assert_eq!(frames[4].walkers[0].position_m, vec2(6.0, 8.0));
    assert!(recording.survey().warnings[0].contains("height"), "{:?}", recording.survey().warnings);
}

#[test]
fn packed_files_are_read() {
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packed.write_all(b"time,pedID,posX,posY\n0.00,0,40.64,35.44\n0.50,0,41.2,35.4\n").unwrap();
    let (recording, frames) = frames(packed.finish().unwrap(), &options());
    assert_eq!((recording.survey().format, frames.len()), (RecordingFormat::Crowdit, 2));
}

#[test]
fn columns_can_be_named_by_the_user() {
    let text = "0.0 9 1.0 3 2.0\n0.5 9 1.5 3 2.25\n0.5 9 4 7 -1\n1.0 9 2 3 2.5\n1.0 9 4 7 -0.5\n";
    let asked = RecordingOptions { columns: Some("time,-,x,id,y".to_owned()), ..options() };
    assert_read_with(text, RecordingFormat::Juelich, &asked);
    let with_header = format!("a b c d e\n{text}");
    assert!(open_with(with_header, &asked).unwrap_err().to_string().contains("line 1"));
}

#[test]
fn the_format_can_be_asked_for() {
    let text = "3;0;1;2\n3;0,5;1,5;2,25\n7;0,5;4;-1\n3;1;2;2,5\n7;1;4;-0,5\n";
    let asked = RecordingOptions { format: Some(RecordingFormat::Viswalk), ..options() };
    assert_read_with(text, RecordingFormat::Viswalk, &asked);
}

#[test]
fn a_recording_is_turned_and_moved() {
    let text = "#framerate: 1\n# id frame x/m y/m\n1 0 2 1\n1 1 3 1\n1 2 4 1\n";
    let asked = RecordingOptions { origin: [1.0, 1.0], shift: [10.0, 20.0], rotation_deg: 90.0, ..options() };
    let (recording, turned) = frames(text, &asked);
    assert_eq!(places(&turned), [(0.0, 1, 11.0, 22.0), (1.0, 1, 11.0, 23.0), (2.0, 1, 11.0, 24.0)]);
    assert_eq!(turned[1].walkers[0].velocity_m_s, vec2(0.0, 1.0));
    assert_eq!(recording.survey().bounds_m.max, vec2(11.0, 24.0));
    // The rectangle is that of the turned places, not of their turned rectangle.
    let asked = RecordingOptions { rotation_deg: 45.0, ..options() };
    let (recording, turned) = frames("#framerate: 1\n1 0 0 0\n1 1 1 1\n1 2 2 2\n1 3 3 3\n", &asked);
    assert!(recording.survey().bounds_m.width() < 1e-12);
    assert!((turned[3].walkers[0].position_m.y - 18f64.sqrt()).abs() < 1e-12);
}
