use super::super::areas::SpotFrame;
use super::super::track::TrackState;
use crate::math::{Vec2, vec2};
use crate::motion::{Frame, MOST_PLACES, Motion, MotionError, Resampler};
use crate::progress::{Progress, Stage};
use crate::units::UnitsError;

/// Frames per second at which a motion is sampled.
pub(super) const FPS: f64 = 10.0;
/// Distance from the spot up to which people are kept, metres.
const NEAR_M: f64 = 15.0;
/// Half width of the triangular filter of positions, frames: heads sway once in two steps, about a second.
const SMOOTH_FRAMES: usize = 4;
/// Speed below which people keep their last heading, metres per second.
const FACING_M_S: f64 = 0.25;

/// The path of a person near the spot, in the viewer's frame.
#[derive(Clone, Debug)]
pub(super) struct SpotTrack {
    pub(super) id: u32,
    /// The first frame.
    pub(super) first: u64,
    places: Vec<Vec2>,
    headings: Vec<Option<Vec2>>,
    moments: Vec<TrackState>,
}

impl SpotTrack {
    /// The last frame.
    pub(super) fn last(&self) -> u64 {
        self.first + self.moments.len() as u64 - 1
    }

    pub(super) fn at(&self, frame: u64) -> Option<&TrackState> {
        self.moments.get(usize::try_from(frame.checked_sub(self.first)?).ok()?)
    }

    /// Smooths positions and computes velocities and headings.
    fn finish(&mut self) {
        let smooth: Vec<Vec2> = (0..self.places.len()).map(|k| smoothed(&self.places, k)).collect();
        let last = smooth.len() - 1;
        let velocity = |k: usize| {
            let (a, b) = (k.saturating_sub(1), (k + 1).min(last));
            if a == b { Vec2::ZERO } else { (smooth[b] - smooth[a]) * (FPS / (b - a) as f64) }
        };
        let velocities: Vec<Vec2> = (0..=last).map(velocity).collect();
        let told = |k: usize| {
            let fast = Some(velocities[k]).filter(|v| v.length() > FACING_M_S).and_then(Vec2::normalized);
            self.headings[k].or(fast)
        };
        let mut facing = (0..=last).find_map(told).unwrap_or(vec2(0.0, 1.0));
        self.moments = (0..=last)
            .map(|k| {
                facing = told(k).unwrap_or(facing);
                TrackState { place_m: smooth[k], velocity_m_s: velocities[k], heading: facing }
            })
            .collect();
        (self.places, self.headings) = (Vec::new(), Vec::new());
    }
}

/// Triangular mean around a frame, narrower at the ends.
fn smoothed(places: &[Vec2], k: usize) -> Vec2 {
    let half = SMOOTH_FRAMES.min(k).min(places.len() - 1 - k);
    let mut sum = places[k] * (half + 1) as f64;
    for away in 1..=half {
        sum += (places[k - away] + places[k + away]) * (half + 1 - away) as f64;
    }
    sum / ((half + 1) * (half + 1)) as f64
}

/// All tracks near the spot, by first frame and id.
#[derive(Clone, Debug, Default)]
pub(super) struct SpotTracks {
    pub(super) all: Vec<SpotTrack>,
}

impl SpotTracks {
    pub(super) fn read(
        motion: &mut dyn Motion,
        spot: &SpotFrame,
        progress: &dyn Progress,
    ) -> Result<SpotTracks, UnitsError> {
        let mut resampler = Resampler::new(FPS);
        let mut frame = Frame::default();
        let mut open: Vec<SpotTrack> = Vec::new();
        let (mut done, mut kept) = (Vec::new(), 0);
        while motion.next_frame(&mut frame)? {
            progress.keep_on()?;
            progress.advance(Stage::Motion, motion.share_done());
            resampler.push(&frame);
            resampler.pass_over_absence();
            while let Some((number, walkers)) = resampler.next() {
                for walker in walkers {
                    let place_m = spot.of_plan(walker.position_m);
                    if !place_m.is_finite() || place_m.length() > NEAR_M {
                        continue;
                    }
                    kept += 1;
                    let heading = walker.heading.map(|heading| spot.turn_of_plan(heading));
                    let at = open.binary_search_by_key(&walker.id, |walk| walk.id).unwrap_or_else(|at| {
                        let (places, headings, moments) = (Vec::new(), Vec::new(), Vec::new());
                        open.insert(at, SpotTrack { id: walker.id, first: number, places, headings, moments });
                        at
                    });
                    open[at].places.push(place_m);
                    open[at].headings.push(heading);
                }
                // A person missing from a frame has left.
                let ended = open.extract_if(.., |walk| walk.first + walk.places.len() as u64 <= number);
                done.extend(ended);
            }
            if kept > MOST_PLACES {
                return Err(MotionError::TooLong { most: MOST_PLACES }.into());
            }
        }
        done.extend(open);
        done.sort_by_key(|walk| (walk.first, walk.id));
        done.iter_mut().for_each(SpotTrack::finish);
        Ok(SpotTracks { all: done })
    }

    /// The first and the last frame with people.
    pub(super) fn span(&self) -> Option<[u64; 2]> {
        Some([self.all.first()?.first, self.all.iter().map(SpotTrack::last).max()?])
    }

    /// The people present in a frame, with their index in [`SpotTracks::all`].
    pub(super) fn present(&self, frame: u64) -> impl Iterator<Item = (usize, &TrackState)> {
        let begun = self.all.partition_point(|walk| walk.first <= frame);
        self.all[..begun].iter().enumerate().filter_map(move |(index, walk)| Some((index, walk.at(frame)?)))
    }
}
