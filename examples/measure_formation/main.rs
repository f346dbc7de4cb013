//! How long formation interpolation takes, and how much of the example's fluctuation it keeps, by how often the example is
//! decomposed and how slowly its basis follows.
//!
//! ```text
//! cargo run --release --example measure_formation -- [PEOPLE [MOMENTS]]
//! ```
//!
//! Two crowds are led from a grid over a ring to a triangle: people who walk on a grid, and people who wander about. Each row
//! of the table is one setting: wall-clock seconds, seconds of all processors, the energy of the fluctuation over that
//! of the example, and the same of what is quicker than formations change (steps). 1 is what is wanted of both. Figures of
//! 500 people in 1000 moments take a while: `-- 500 1000`.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use trodden::Silent;
use trodden::formation::{
    AvoidRequest, ExampleKind, ExampleRequest, FormationOptions, FormationRequest, form, interpolate,
};
use trodden::motion::Ensemble;

mod energy;
mod shapes;

/// Moments per second.
const FPS: f64 = 10.0;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let people: usize = arguments.next().map_or(Ok(25), |people| people.parse())?;
    let moments: usize = arguments.next().map_or(Ok(301), |moments| moments.parse())?;
    let only: Option<String> = arguments.next();
    let settings: Vec<(String, Option<usize>, f64)> = [("at the keys", None), ("10", Some(10)), ("100", Some(100))]
        .into_iter()
        .chain([("all", Some(usize::MAX))])
        .flat_map(|(name, decompositions)| {
            let following: &[f64] = if decompositions.is_none() { &[10.0] } else { &[0.0, 2.0, 10.0, 30.0] };
            following.iter().map(move |&following_s| (name.to_string(), decompositions, following_s))
        })
        .collect();
    for (crowd, example) in
        [("a walk on a grid", shapes::walk(people, moments)), ("wandering", wander(people, moments)?)]
    {
        println!("{people} people, {moments} moments, {crowd}\n");
        println!("| decomposed | following [s] | wall [s] | processors [s] | energy | steps |");
        println!("|---|---|---|---|---|---|");
        let keys = shapes::keys(people, (example.moments() - 1) as f64 / FPS);
        for (name, decompositions, following_s) in &settings {
            if only.as_ref().is_some_and(|only| format!("{name}/{following_s}") != *only) {
                continue;
            }
            let options = FormationOptions {
                decompositions: *decompositions,
                following_s: *following_s,
                ..FormationOptions::default()
            };
            let (watch, before_s) = (Instant::now(), processor_s());
            let full = interpolate(&example, &keys, &options, &Silent)?;
            let (wall_s, all_s) = (watch.elapsed().as_secs_f64(), processor_s() - before_s);
            let bare = interpolate(&example, &keys, &FormationOptions { fluctuation: 0.0, ..options }, &Silent)?;
            let [energy, steps] = energy::kept(&example, &keys, &full, &bare);
            let shown = if decompositions.is_none() { "-".to_string() } else { following_s.to_string() };
            println!("| {name} | {shown} | {wall_s:.2} | {all_s:.2} | {energy:.3} | {steps:.3} |");
        }
        println!();
    }
    Ok(())
}

/// People who wander about, as `[formation]` makes them.
fn wander(people: usize, moments: usize) -> Result<Ensemble, Box<dyn Error>> {
    let request = FormationRequest {
        duration_s: Some((moments - 1) as f64 / FPS),
        fps: Some(FPS),
        example: ExampleRequest {
            kind: Some(ExampleKind::Wander),
            people: Some(u32::try_from(people)?),
            ..ExampleRequest::default()
        },
        avoid: AvoidRequest { on: Some(false), ..AvoidRequest::default() },
        ..FormationRequest::default()
    };
    Ok(form(&request, Path::new(""), &Silent)?.ensemble)
}

/// Seconds that all processors have worked for this program so far, where the system tells; 100 ticks are a second.
fn processor_s() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = text.rsplit(") ").next().unwrap_or("").split(' ').collect();
    let ticks = |field: usize| fields.get(field).and_then(|ticks| ticks.parse::<f64>().ok()).unwrap_or(0.0);
    (ticks(11) + ticks(12)) / 100.0
}
