//! Draws what a crowd's features are good for, with two made-up crowds: one moves sideways, one towards its centre.
//!
//! ```text
//! cargo run --release --example draw_features -- FOLDER
//! ```
//!
//! The folder (`features` by default) gets the two crowds as recordings that `trodden motion features` reads, and pictures
//! of trajectories, brighter as time goes on: the two crowds, the sideways crowd times a sine and the two crowds mixed,
//! each by principal components and by the Laplacian. It prints the commands that make the same motions.

use std::error::Error;
use std::path::{Path, PathBuf};

use trodden::Silent;
use trodden::features::{Features, FeaturesOptions, Method, Mix, MixOptions, Modulation, Rule};
use trodden::motion::Ensemble;

mod crowds;
mod picture;

/// People within this distance are neighbours, metres: with a smaller one few have any where the crowd is wide.
const NEIGHBOUR_DISTANCE_M: f64 = 5.0;
/// To and fro once in five seconds.
const SINE: &str = "all=sin(2*pi*t/5)";
/// How many components: of the Laplacian more are needed for as much of the motion.
const COMPONENTS: [usize; 2] = [4, 24];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("features"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    let (sideways, inwards) = (crowds::sideways(), crowds::to_the_centre());
    for (name, crowd) in [("sideways", &sideways), ("to-the-centre", &inwards)] {
        std::fs::write(folder.join(name).with_extension("txt"), crowds::text(crowd))?;
        draw(&folder, name, crowd, "")?;
    }
    for (method, components) in Method::ALL.into_iter().zip(COMPONENTS) {
        let options = FeaturesOptions { method, neighbour_distance_m: NEIGHBOUR_DISTANCE_M };
        let of = format!("--method {} --neighbour-distance {NEIGHBOUR_DISTANCE_M}", method.name());

        let sine = Modulation::of(Rule::scale(SINE)?);
        let to_and_fro = Features::find(&sideways, &options, &Silent)?.modulated(components, &sine)?;
        let command = format!("sideways.txt {of} --components {components} --scale '{SINE}'");
        draw(&folder, &format!("sine-{}", method.name()), &to_and_fro, &command)?;

        let mixed = Mix::find(&sideways, &inwards, &options, MixOptions::default(), &Silent)?;
        let both = mixed.rebuild(2 * components)?;
        let command = format!("sideways.txt {of} --mix to-the-centre.txt --components {}", 2 * components);
        draw(&folder, &format!("mix-{}", method.name()), &both, &command)?;
    }
    Ok(())
}

fn draw(folder: &Path, name: &str, crowd: &Ensemble, command: &str) -> Result<(), Box<dyn Error>> {
    let path = folder.join(name).with_extension("png");
    picture::trajectories(crowd).save(&path)?;
    println!("{}", path.display());
    if !command.is_empty() {
        println!("  trodden motion features {command} --paths {name}.png");
    }
    Ok(())
}
