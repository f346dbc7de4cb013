//! Draws what formation interpolation works on, for three people: their eigenvectors on the unit sphere as recorded and as a
//! rotation has them (`sphere.png`), the coefficients of the recording over time with the line between their ends
//! (`recorded.png`), and those that a new pair of key formations gets (`interpolated.png`). And ranks of nine that come from a
//! triangle, go into a ring, or both (`changes.png`).
//!
//! ```text
//! cargo run --example draw_formation -- FOLDER [RECORDING [FRAMES-PER-SECOND]]
//! ```
//!
//! Without a recording, three people walk who are made for it. In a recording, neighbours are looked for who keep one
//! pattern of adjacency for two seconds and more; how far rotation and recording differ in all of them, `trodden motion formation --check` prints.

use std::error::Error;
use std::path::{Path, PathBuf};

use trodden::Silent;
use trodden::formation::{Agreement, Basis, SphereTracks, default_sigma_m, sphere_tracks};
use trodden::math::{Vec2, sin_cos, vec2};
use trodden::motion::Ensemble;
use trodden::recordings::{Recording, RecordingOptions};

mod changes;
mod chart;

use chart::{BLUE, Chart, GREEN, GREY, LIGHT, ORANGE, RED};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().ok_or("name a folder for the pictures")?);
    std::fs::create_dir_all(&folder)?;
    let example = match arguments.next() {
        Some(recording) => {
            let fps = arguments.next().map(|fps| fps.parse()).transpose()?;
            let options = RecordingOptions { fps, ..RecordingOptions::default() };
            let agreement = Agreement::of(&Recording::open(Path::new(&recording), &options)?, &Silent)?;
            agreement.turned_farthest.ok_or("no three people keep one pattern of adjacency")?
        }
        None => made(),
    };
    let tracks = sphere_tracks(&example, None)?;
    let degrees = tracks.mean_angles_rad().map(f64::to_degrees);
    println!(
        "drawn: {:.1} s, on average e_1 {:.2}, e_2 {:.2} degrees apart",
        seconds(&example),
        degrees[0],
        degrees[1]
    );
    draw_sphere(&tracks).save(&folder.join("sphere.png"))?;
    draw_coefficients(&tracks.coefficients_m).save(&folder.join("recorded.png"))?;
    draw_coefficients(&interpolated(&example, &tracks)?).save(&folder.join("interpolated.png"))?;
    changes::draw()?.save(&folder.join("changes.png"))?;
    Ok(())
}

fn seconds(example: &Ensemble) -> f64 {
    (example.moments() - 1) as f64 / example.fps
}

/// Three who walk abreast with swaying steps; the one in the middle moves over to the one who falls behind.
fn made() -> Ensemble {
    let (fps, moments) = (25.0, 151);
    let mut places_m = Vec::new();
    for moment in 0..moments {
        let (time_s, share) = (f64::from(moment) / fps, f64::from(moment) / f64::from(moments - 1));
        let (sine, cosine) = sin_cos(0.6 * share);
        let formation = [vec2(0.0, 0.9 + 0.35 * share), vec2(0.0, 0.0), vec2(-sine, -cosine) * (1.25 - 0.35 * share)];
        for (k, place) in formation.into_iter().enumerate() {
            let wave = |per_s: f64| sin_cos(std::f64::consts::TAU * per_s * time_s + 2.0 * k as f64).0;
            places_m.push(place + vec2(1.2 * time_s + 0.02 * wave(1.8), 0.04 * wave(0.9 + 0.05 * k as f64)));
        }
    }
    Ensemble::new(fps, 0.0, vec![1, 2, 3], places_m)
}

/// Coefficients on the way from the recording's first formation to one half as wide again and turned: the line between
/// those of the two, and on it the fluctuation of the recording.
fn interpolated(example: &Ensemble, tracks: &SphereTracks) -> Result<Vec<[f64; 4]>, Box<dyn Error>> {
    let (recorded, last) = (&tracks.coefficients_m, tracks.coefficients_m.len() - 1);
    let (sine, cosine) = sin_cos(0.6);
    let key: Vec<Vec2> = example.places_at(last).iter().map(|place| place.rotated(vec2(cosine, sine)) * 1.5).collect();
    let basis = Basis::of(&key, default_sigma_m(&key), &[])?;
    let signs = [0, 1].map(|v| {
        if basis.vectors.column(v + 1).iter().zip(&tracks.turned[last][v]).map(|(a, b)| a * b).sum::<f64>() < 0.0 {
            -1.0
        } else {
            1.0
        }
    });
    let to = basis.coefficients(&key);
    let to = [to[1].x * signs[0], to[1].y * signs[0], to[2].x * signs[1], to[2].y * signs[1]];
    let line = |from: f64, to: f64, share: f64| from * (1.0 - share) + to * share;
    let at = |(moment, now): (usize, &[f64; 4])| {
        let share = moment as f64 / last as f64;
        [0, 1, 2, 3]
            .map(|k| line(recorded[0][k], to[k], share) + now[k] - line(recorded[0][k], recorded[last][k], share))
    };
    Ok(recorded.iter().enumerate().map(at).collect())
}

/// The sphere, seen from a little above the great circle on which the vectors lie.
fn draw_sphere(tracks: &SphereTracks) -> Chart {
    let mut chart = Chart::new([-1.1, 1.1], [-1.1, 1.1], [720, 720]);
    // Across the constant vector (1, 1, 1), and along it.
    let (across, up) = ([0.5f64.sqrt(), -(0.5f64.sqrt()), 0.0], [1.0, 1.0, 1.0].map(|x| x / 3f64.sqrt()));
    let depth = [1.0, 1.0, -2.0].map(|x| x / 6f64.sqrt());
    let (tilt_sine, tilt_cosine) = sin_cos(0.5);
    let seen = |p: &[f64; 3]| {
        let along = |axis: &[f64; 3]| axis.iter().zip(p).map(|(a, b)| a * b).sum::<f64>();
        let (height, away) = (along(&up), along(&depth));
        ([along(&across), height * tilt_cosine + away * tilt_sine], height * tilt_sine - away * tilt_cosine < 0.0)
    };
    let circle = |k: u32| sin_cos(std::f64::consts::TAU * f64::from(k) / 180.0);
    chart.line((0..=180).map(|k| [circle(k).1, circle(k).0]), 1.5, GREY);
    for k in 0..180 {
        let point = |k: u32| [0, 1, 2].map(|axis| across[axis] * circle(k).1 + depth[axis] * circle(k).0);
        let ((a, behind), (b, _)) = (seen(&point(k)), seen(&point(k + 1)));
        if !behind || k % 4 < 2 {
            chart.line([a, b], 1.0, GREY);
        }
    }
    chart.line([[0.0, 0.0], seen(&up).0], 1.0, GREY);
    chart.dot(seen(&up).0, 5.0, GREY);
    for (vector, recorded, turned) in [(0, BLUE, ORANGE), (1, GREEN, RED)] {
        chart.line(tracks.turned.iter().map(|points| seen(&points[vector]).0), 9.0, turned);
        chart.line(tracks.recorded.iter().map(|points| seen(&points[vector]).0), 3.0, recorded);
        chart.dot(seen(&tracks.recorded[0][vector]).0, 6.0, recorded);
        chart.line([[0.0, 0.0], seen(&tracks.recorded[0][vector]).0], 1.0, recorded);
    }
    chart
}

/// `c_1` blue, `d_1` green, `c_2` orange, `d_2` red over time, each with the line between its ends; a light line per half metre.
fn draw_coefficients(coefficients: &[[f64; 4]]) -> Chart {
    let all = || coefficients.iter().flatten().copied();
    let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max));
    let last = coefficients.len() as f64 - 1.0;
    let mut chart = Chart::new([-0.03 * last, 1.03 * last], [low - 0.1, high + 0.1], [960, 540]);
    for half_metre in (2.0 * low).floor() as i32..=(2.0 * high).ceil() as i32 {
        let colour = if half_metre == 0 { GREY } else { LIGHT };
        chart.line([[0.0, f64::from(half_metre) / 2.0], [last, f64::from(half_metre) / 2.0]], 1.0, colour);
    }
    for (k, colour) in [BLUE, GREEN, ORANGE, RED].into_iter().enumerate() {
        chart.line([[0.0, coefficients[0][k]], [last, coefficients[coefficients.len() - 1][k]]], 1.0, colour);
        chart.line(coefficients.iter().enumerate().map(|(m, now)| [m as f64, now[k]]), 2.5, colour);
    }
    chart
}
