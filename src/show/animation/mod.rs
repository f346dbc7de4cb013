//! The crowd from above, moving: an animated GIF or PNG.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::crowd::{Arrival, Stuck};
use crate::math::Vec2;
use crate::motion::{Frame, Resampler};
use crate::plan::FloorPlan;
use crate::walls::Walls;

mod encode;
mod palette;
mod reel;
mod scene;
mod tails;

use encode::{Film, Patch};
use palette::Palette;
use reel::Reel;
use scene::Scene;
use tails::Tails;

/// Pictures in a second.
const RATE: f64 = 12.5;
/// Without a speed that was asked for, the most pictures: 20 s.
const MOST_PICTURES: usize = 250;
/// The most pictures at all: 10 min.
const MOST_AT_FIXED_SPEED: usize = 7500;
/// Moments looked at for each picture: people leave a tail of the places where they were in between.
const MOMENTS: u64 = 4;
/// Speeds to choose from; ten and a hundred times these follow.
const SPEEDS: [f64; 9] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];
/// What is expected to last is often exceeded: some room is left, seconds.
const ROOM_S: f64 = 3.0;

/// Least and largest value of [`AnimationOptions::size_px`].
pub const ANIMATION_SIZES_PX: [u32; 2] = [200, 2000];
/// Least and largest value of [`AnimationOptions::speed`].
pub const ANIMATION_SPEEDS: [f64; 2] = [0.1, 1000.0];

/// How an animation looks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AnimationOptions {
    /// How many times as fast as in life people walk. Left out: a round number at which the animation lasts 20 s at
    /// most.
    pub speed: Option<f64>,
    /// Longer side of the picture, pixels; 200 to 2000.
    pub size_px: u32,
    /// What people's colours say.
    pub colour: AnimationColour,
}

impl Default for AnimationOptions {
    fn default() -> AnimationOptions {
        AnimationOptions { speed: None, size_px: 960, colour: AnimationColour::Speed }
    }
}

/// What people's colours in an animation say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AnimationColour {
    /// How fast they walk.
    #[default]
    Speed,
    /// Which route they take.
    Route,
}

/// The file that an animation is written to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum AnimationFormat {
    /// Animated GIF.
    Gif,
    /// Animated PNG.
    Png,
}

impl AnimationFormat {
    /// The endings of file names, with the format that each stands for.
    pub const ENDINGS: [(&str, AnimationFormat); 3] =
        [("gif", AnimationFormat::Gif), ("png", AnimationFormat::Png), ("apng", AnimationFormat::Png)];

    /// The format that a file's name asks for.
    ///
    /// # Errors
    /// A name with another ending, or none.
    pub fn of(path: &Path) -> Result<AnimationFormat, AnimationError> {
        let found = path.extension().and_then(|ending| {
            let known = |&&(name, _): &&(&str, AnimationFormat)| ending.eq_ignore_ascii_case(name);
            AnimationFormat::ENDINGS.iter().find(known).map(|&(_, format)| format)
        });
        found.ok_or_else(|| AnimationError::UnknownEnding { path: path.to_path_buf() })
    }
}

/// Why there can be no animation as asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AnimationError {
    /// The file's name says nothing of its format.
    #[error("{}: an animation is written to a file whose name ends in .gif, .png or .apng", path.display())]
    UnknownEnding {
        /// The file.
        path: PathBuf,
    },
    /// A number out of its range.
    #[error("the animation's {name} is {value}; allowed is {low} to {high}")]
    Number {
        /// What it is.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Least value allowed.
        low: f64,
        /// Largest value allowed.
        high: f64,
    },
}

impl AnimationError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        match self {
            AnimationError::UnknownEnding { .. } => Some("walk.gif is understood everywhere".to_string()),
            AnimationError::Number { .. } => None,
        }
    }
}

fn check(name: &'static str, value: f64, [low, high]: [f64; 2]) -> Result<(), AnimationError> {
    // Written so that NaN is out of range.
    let allowed = value >= low && value <= high;
    if allowed { Ok(()) } else { Err(AnimationError::Number { name, value, low, high }) }
}

/// The least round speed at which so many seconds are shown in time.
fn round_speed(expected_s: f64) -> f64 {
    let most_s = MOST_PICTURES as f64 / RATE - ROOM_S;
    let mut speeds = [1.0, 10.0, 100.0].into_iter().flat_map(|tens| SPEEDS.map(|speed| tens * speed));
    let [_, fastest] = ANIMATION_SPEEDS;
    speeds.find(|speed| expected_s / speed <= most_s).unwrap_or(fastest)
}

/// What an animation became.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AnimationReport {
    /// How many times as fast as in life people walk.
    pub speed: f64,
    /// How long it lasts, seconds.
    pub seconds: f64,
    /// Number of pictures.
    pub pictures: usize,
    /// Width and height, pixels.
    pub size_px: [u32; 2],
}

/// Draws a motion over its plan, picture by picture.
///
/// Holds packed pictures, at most 250 unless a speed was asked for and 7500 then: where there would be more, every other
/// one is dropped and the speed doubled.
pub struct Animation<'a> {
    scene: Scene<'a>,
    palette: Palette,
    resampler: Resampler,
    reel: Reel,
    speed: f64,
    most: usize,
    tails: Tails,
    stuck: Vec<Vec2>,
    options: AnimationOptions,
}

impl<'a> Animation<'a> {
    /// An animation of a crowd that has not walked yet, and that is expected to walk for so many seconds.
    ///
    /// # Errors
    /// Options out of range.
    pub fn new(
        plan: &FloorPlan,
        walls: &Walls,
        arrivals: &'a [Arrival],
        expected_s: f64,
        options: &AnimationOptions,
    ) -> Result<Animation<'a>, AnimationError> {
        let [least_px, largest_px] = ANIMATION_SIZES_PX.map(f64::from);
        check("size", f64::from(options.size_px), [least_px, largest_px])?;
        options.speed.map_or(Ok(()), |speed| check("speed", speed, ANIMATION_SPEEDS))?;
        let speed = options.speed.unwrap_or_else(|| round_speed(expected_s));
        let scene = Scene::new(plan, walls, arrivals, options);
        Ok(Animation {
            palette: Palette::new(),
            resampler: Resampler::new(RATE * MOMENTS as f64 / speed),
            reel: Reel::default(),
            most: if options.speed.is_some() { MOST_AT_FIXED_SPEED } else { MOST_PICTURES },
            speed,
            tails: Tails::default(),
            stuck: Vec::new(),
            options: *options,
            scene,
        })
    }

    /// Takes the motion's next frame, and everybody who has got stuck so far.
    pub fn push(&mut self, frame: &Frame, stuck: &[Stuck]) {
        self.resampler.push(frame);
        while let Some((moment, walkers)) = self.resampler.next() {
            self.tails.push(&walkers, self.speed / (RATE * MOMENTS as f64));
            if moment % MOMENTS != 0 {
                continue;
            }
            if self.reel.len() >= self.most {
                // An even number of pictures: the one that comes now is not among those that are dropped.
                self.reel.halve();
                self.resampler.halve();
                self.speed *= 2.0;
            }
            let time_s = self.time_of(self.reel.len());
            let picture = self.scene.picture(time_s, &walkers, &self.tails, &self.stuck);
            self.reel.push(&self.palette.indices(&picture));
        }
        self.stuck.clear();
        self.stuck.extend(stuck.iter().map(|person| person.place_m));
    }

    fn time_of(&self, picture: usize) -> f64 {
        picture as f64 * self.speed / RATE
    }

    /// The speed that was asked for, if the animation would be too long at it.
    pub fn speed_refused(&self) -> Option<f64> {
        self.options.speed.filter(|&speed| speed != self.speed)
    }

    /// Writes the file. The same motion gives the same bytes.
    ///
    /// # Errors
    /// `out` cannot be written to.
    pub fn write(&self, out: impl Write, format: AnimationFormat) -> io::Result<AnimationReport> {
        // The speed is known only now.
        let (at, label) = self.scene.speed_label(self.speed);
        let patch = Patch { at, width: label.width() as usize, indices: self.palette.indices(&label) };
        let film = Film { reel: &self.reel, palette: self.palette.colours(), size_px: self.scene.size_px(), patch };
        match format {
            AnimationFormat::Gif => encode::gif(&film, out)?,
            AnimationFormat::Png => encode::png(&film, out)?,
        }
        let seconds = self.reel.len() as f64 / RATE;
        Ok(AnimationReport { speed: self.speed, seconds, pictures: self.reel.len(), size_px: self.scene.size_px() })
    }
}

#[cfg(test)]
mod tests;
