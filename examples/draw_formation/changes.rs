//! Ranks that become other formations, as in the paper's first figure.

use std::error::Error;

use trodden::Silent;
use trodden::formation::{FormationOptions, KeyFormation, interpolate};
use trodden::math::{Vec2, sin_cos, vec2};
use trodden::motion::Ensemble;

use super::chart::{BLUE, Chart, GREEN, LIGHT, RED};

/// Moments that are shown.
const SHOWN: usize = 5;
/// From one shown moment to the next, and from one crowd to the next, metres.
const APART_M: [f64; 2] = [5.0, 4.6];
/// Pixels per metre.
const SCALE: f64 = 34.0;

/// Four crowds one below the other, each at five moments from left to right: three by three people as they walk; the same from a
/// triangle; the same into a ring; from a triangle into a ring. A colour for each rank of the example.
pub fn draw() -> Result<Chart, Box<dyn Error>> {
    let example = ranks();
    let last = example.moments() - 1;
    let ends = [None, Some(triangle()), Some(ring())];
    let rows = [[0, 0], [1, 0], [0, 2], [1, 2]];
    let size = [SHOWN as f64 * APART_M[0], rows.len() as f64 * APART_M[1]];
    let pixels = size.map(|metres| (metres * SCALE) as u32);
    let mut chart = Chart::new([-APART_M[0] / 2.0, size[0] - APART_M[0] / 2.0], [-size[1], 0.0], pixels);
    for (row, ends_of_row) in rows.into_iter().enumerate() {
        let key = |which: usize, moment: usize| KeyFormation {
            time_s: example.time_s(moment),
            places_m: ends[which].clone().unwrap_or_else(|| relative(&example, moment)),
        };
        let keys = [key(ends_of_row[0], 0), key(ends_of_row[1], last)];
        let crowd = interpolate(&example, &keys, &FormationOptions::default(), &Silent)?;
        let floor = -APART_M[1] * (row as f64 + 1.0);
        chart.line([[-APART_M[0] / 2.0, floor], [size[0], floor]], 1.0, LIGHT);
        for shown in 0..SHOWN {
            let moment = shown * last / (SHOWN - 1);
            let middle = vec2(APART_M[0] * shown as f64, floor + APART_M[1] / 2.0);
            draw_moment(&mut chart, &crowd, moment, middle);
        }
    }
    Ok(chart)
}

fn draw_moment(chart: &mut Chart, crowd: &Ensemble, moment: usize, middle: Vec2) {
    for person in 0..crowd.people() {
        let place = middle + relative(crowd, moment)[person];
        chart.dot([place.x, place.y], 0.22 * SCALE, [BLUE, GREEN, RED][person / 3]);
    }
}

/// Places relative to the crowd's middle.
fn relative(crowd: &Ensemble, moment: usize) -> Vec<Vec2> {
    let middle = crowd.centroid_m(moment);
    crowd.places_at(moment).iter().map(|&place| place - middle).collect()
}

/// Three by three who walk for eight seconds, each with a sway and a pace of their own.
fn ranks() -> Ensemble {
    let fps = 12.5;
    let places_m = (0..=100).flat_map(|moment| {
        let time_s = f64::from(moment) / fps;
        (0..9).map(move |person| {
            let (column, rank, own) = (f64::from(person % 3), f64::from(person / 3), f64::from(person));
            let wave = |period_s: f64| sin_cos(std::f64::consts::TAU * time_s / period_s + 2.4 * own).0;
            vec2(1.1 * column + 0.10 * wave(1.1 + 0.05 * own), 1.1 * rank + 1.2 * time_s + 0.14 * wave(3.0 + 0.2 * own))
        })
    });
    Ensemble::new(fps, 0.0, (1..=9).collect(), places_m.collect())
}

/// The last rank is a side of five, the ones before it are three and one.
fn triangle() -> Vec<Vec2> {
    let at = |column: f64, rank: f64| vec2(column * 0.85, rank * 1.1);
    let back = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|column| at(column, -1.0));
    [
        vec![back[0], back[2], back[4], back[1], at(0.0, 0.0), back[3]],
        [-1.0, 1.0].map(|c| at(c, 0.0)).to_vec(),
        vec![at(0.0, 1.0)],
    ]
    .concat()
}

fn ring() -> Vec<Vec2> {
    // From the lower left, round the outside of the ranks; the one in the middle comes to stand between two of them.
    let order = [0, 1, 2, 7, 8, 3, 6, 5, 4];
    let around = |k: i32| {
        let (sine, cosine) = sin_cos(std::f64::consts::TAU * (f64::from(k) / 9.0 - 0.36));
        vec2(cosine, sine) * 1.7
    };
    order.map(around).to_vec()
}
