use image::AnimationDecoder;

use std::path::Path;

use super::crowd_view::{CrowdView, clock};
use super::recorder::round_speed;
use super::trails::Trails;
use super::*;
use crate::crowd::Stuck;
use crate::math::vec2;
use crate::motion::{Frame, Walker};
use crate::plan::FloorPlan;
use crate::walls::{Walls, WallsOptions};

/// A corridor of 12 x 3 m between walls of a metre.
fn plan() -> (FloorPlan, Walls) {
    let mask = (0..24 * 10).map(|k| u8::from((48..192).contains(&k))).collect();
    let plan = FloorPlan::from_mask(24, 10, 0.5, mask);
    let walls = Walls::trace(&plan, &WallsOptions::default());
    (plan, walls)
}

/// Somebody who walks through the corridor again and again.
fn frame(time_s: f64) -> Frame {
    let walker = Walker { id: 0, position_m: vec2(time_s % 12.0, 2.5), velocity_m_s: vec2(1.0, 0.0), heading: None };
    Frame { time_s, walkers: vec![walker] }
}

fn filmed(seconds: u32, options: &AnimationOptions, stuck: &[Stuck]) -> (Vec<u8>, Vec<u8>, AnimationReport) {
    let (plan, walls) = plan();
    let mut animation = Animation::new(&plan, &walls, &[], f64::from(seconds), options).unwrap();
    for step in 1..=seconds * 10 {
        animation.push(&frame(f64::from(step) * 0.1), stuck);
    }
    let (mut gif, mut png) = (Vec::new(), Vec::new());
    let report = animation.write(&mut gif, AnimationFormat::Gif).unwrap();
    assert_eq!(animation.write(&mut png, AnimationFormat::Png).unwrap(), report);
    (gif, png, report)
}

fn small() -> AnimationOptions {
    AnimationOptions { size_px: 260, ..AnimationOptions::default() }
}

/// The pictures as a viewer shows them.
fn frames<'a>(decoder: impl AnimationDecoder<'a>) -> Vec<image::Frame> {
    decoder.into_frames().collect_frames().unwrap()
}

#[test]
fn gif_and_png_show_the_same_pictures() {
    let (gif, png, report) = filmed(4, &small(), &[]);
    let gif = frames(image::codecs::gif::GifDecoder::new(std::io::Cursor::new(gif)).unwrap());
    let png = image::codecs::png::PngDecoder::new(std::io::Cursor::new(png)).unwrap();
    assert!(png.is_apng().unwrap());
    let png = frames(png.apng().unwrap());
    assert_eq!((gif.len(), png.len(), report.pictures, report.speed), (51, 51, 51, 1.0));
    for (n, (a, b)) in gif.iter().zip(&png).enumerate() {
        assert!(a.buffer() == b.buffer(), "picture {n}");
    }
    let delays: Vec<_> = gif.iter().map(|frame| frame.delay().numer_denom_ms().0 / 10).collect();
    assert_eq!((delays[0], delays[50]), (8, 150));
    // Nobody is left behind where they were.
    let (plan, walls) = plan();
    let empty = CrowdView::new(&plan, &walls, &[], &small()).picture(0.0, &[], &Trails::default(), &[]);
    let dark = |picture: &image::RgbaImage| picture.pixels().filter(|pixel| pixel.0[0] < 60).count();
    let few = dark(gif[10].buffer());
    assert!(few > 0 && dark(gif[50].buffer()).abs_diff(few) < 60, "{few} {}", dark(gif[50].buffer()));
    assert_eq!(gif[0].buffer().dimensions(), empty.dimensions());
}

#[test]
fn long_walks_are_shown_faster_and_short_ones_as_they_are() {
    for (seconds, speed, most) in [(10, 1.0, 10.1), (21, 1.5, 14.1), (100, 6.0, 16.8)] {
        let (_, _, report) = filmed(seconds, &small(), &[]);
        assert_eq!(report.speed, speed, "{seconds} s");
        assert!(report.seconds >= 9.9 && report.seconds <= most, "{seconds} s take {}", report.seconds);
    }
    let options = AnimationOptions { speed: Some(4.0), ..small() };
    let (_, _, report) = filmed(100, &options, &[]);
    assert_eq!((report.speed, report.pictures), (4.0, 313));
    assert_eq!([f64::INFINITY, f64::NAN, 1e9, 0.0].map(round_speed), [1000.0, 1000.0, 1000.0, 1.0]);
}

#[test]
fn walks_that_last_longer_than_expected_are_shown_faster_from_the_start() {
    let (plan, walls) = plan();
    let mut animation = Animation::new(&plan, &walls, &[], 10.0, &small()).unwrap();
    // At the moments of all the pictures that are left, somebody stands at x = 3 m, and nowhere else.
    for step in 1..=700 {
        let mut frame = frame(f64::from(step) * 0.1);
        frame.walkers[0].position_m.x = 3.0;
        animation.push(&frame, &[]);
    }
    assert_eq!((animation.speed, animation.frames.len()), (4.0, 219));
    let pictures: Vec<Vec<u8>> = animation.frames.pictures().collect();
    // All but the first, in which nobody is there yet, differ by the clock alone.
    let [width, height] = animation.view.size_px().map(|side| side as usize);
    let plan_rows = ..width * (height - 70);
    assert!(pictures[2..].iter().all(|picture| picture[plan_rows] == pictures[1][plan_rows]));
    let clock_of = |n: usize| &pictures[n][width * (height - 60)..];
    // Picture n shows the moment 0.32 n seconds.
    assert!(clock_of(10) == clock_of(12) && clock_of(12) != clock_of(13) && clock_of(13) == clock_of(15));
    assert!(clock_of(201) == clock_of(203) && clock_of(203) != clock_of(204));
}

#[test]
fn stuck_people_are_crossed_out() {
    let red = |gif: Vec<u8>| {
        let frames = frames(image::codecs::gif::GifDecoder::new(std::io::Cursor::new(gif)).unwrap());
        frames.last().unwrap().buffer().pixels().filter(|p| p.0[0] > 200 && p.0[1] < 60).count()
    };
    let stuck = [Stuck { id: 3, place_m: vec2(6.0, 2.0), route: 0, stop: None }];
    assert_eq!(red(filmed(1, &small(), &[]).0), 0);
    assert!(red(filmed(1, &small(), &stuck).0) > 20);
}

#[test]
fn absurd_options_are_refused() {
    let (plan, walls) = plan();
    let is_refused = |options| Animation::new(&plan, &walls, &[], 60.0, &options).is_err();
    for speed in [0.0, -1.0, 1e9, f64::NAN, f64::INFINITY] {
        assert!(is_refused(AnimationOptions { speed: Some(speed), ..small() }), "{speed}");
    }
    assert!(is_refused(AnimationOptions { size_px: 0, ..small() }));
    assert!(is_refused(AnimationOptions { size_px: 100_000, ..small() }));
    for name in ["a", "a.jpg", ".gif"] {
        assert!(AnimationFormat::of(Path::new(name)).is_err(), "{name}");
    }
    assert_eq!(AnimationFormat::of(Path::new("a.APNG")), Ok(AnimationFormat::Png));
}

#[test]
fn clocks_have_hours_when_they_need_them() {
    assert_eq!([0.0, 59.96, 61.0, 3600.0, 7384.9].map(clock), ["0:00", "0:59", "1:01", "1:00:00", "2:03:04"]);
}
