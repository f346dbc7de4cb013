use std::io::{self, Write};

use serde::{Deserialize, Serialize};

use super::crowd_view::CrowdView;
use super::encode::{self, EncoderInput, LabelPatch};
use super::error::AnimationError;
use super::options::{AnimationFormat, AnimationOptions};
use super::packed_frames::PackedFrames;
use super::palette::Palette;
use super::trails::Trails;
use crate::crowd::{Arrival, Stuck};
use crate::math::Vec2;
use crate::motion::{Frame, Resampler};
use crate::plan::FloorPlan;
use crate::walls::Walls;

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
/// Room left because walks often last longer than expected, seconds.
const ROOM_S: f64 = 3.0;

/// The least round speed at which so many seconds are shown in time.
pub(super) fn round_speed(expected_s: f64) -> f64 {
    let most_s = MOST_PICTURES as f64 / RATE - ROOM_S;
    let mut speeds = [1.0, 10.0, 100.0].into_iter().flat_map(|tens| SPEEDS.map(|speed| tens * speed));
    let [_, fastest] = AnimationOptions::SPEEDS;
    speeds.find(|speed| expected_s / speed <= most_s).unwrap_or(fastest)
}

/// Facts of a finished animation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AnimationReport {
    /// Playback speed as a factor on real time.
    pub speed: f64,
    /// Duration, seconds.
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
    pub(super) view: CrowdView<'a>,
    palette: Palette,
    resampler: Resampler,
    pub(super) frames: PackedFrames,
    pub(super) speed: f64,
    most_frames: usize,
    trails: Trails,
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
        options.check()?;
        let speed = options.speed.unwrap_or_else(|| round_speed(expected_s));
        let view = CrowdView::new(plan, walls, arrivals, options);
        Ok(Animation {
            palette: Palette::new(),
            resampler: Resampler::new(RATE * MOMENTS as f64 / speed),
            frames: PackedFrames::default(),
            most_frames: if options.speed.is_some() { MOST_AT_FIXED_SPEED } else { MOST_PICTURES },
            speed,
            trails: Trails::default(),
            stuck: Vec::new(),
            options: *options,
            view,
        })
    }

    /// Takes the motion's next frame, and all people who have got stuck so far.
    pub fn push(&mut self, frame: &Frame, stuck: &[Stuck]) {
        self.resampler.push(frame);
        while let Some((moment, walkers)) = self.resampler.next() {
            self.trails.push(&walkers, self.speed / (RATE * MOMENTS as f64));
            if moment % MOMENTS != 0 {
                continue;
            }
            if self.frames.len() >= self.most_frames {
                // An even number of pictures: the one that comes now is not among those that are dropped.
                self.frames.halve();
                self.resampler.halve();
                self.speed *= 2.0;
            }
            let time_s = self.time_of(self.frames.len());
            let picture = self.view.picture(time_s, &walkers, &self.trails, &self.stuck);
            self.frames.push(&self.palette.indices(&picture));
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
        let (at, label) = self.view.speed_label(self.speed);
        let patch = LabelPatch { at, width: label.width() as usize, indices: self.palette.indices(&label) };
        let film =
            EncoderInput { frames: &self.frames, palette: self.palette.colours(), size_px: self.view.size_px(), patch };
        match format {
            AnimationFormat::Gif => encode::gif(&film, out)?,
            AnimationFormat::Png => encode::png(&film, out)?,
        }
        let seconds = self.frames.len() as f64 / RATE;
        Ok(AnimationReport { speed: self.speed, seconds, pictures: self.frames.len(), size_px: self.view.size_px() })
    }
}
