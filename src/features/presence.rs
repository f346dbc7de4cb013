use serde::Serialize;

use super::displacement::MOST_FEATURE_PLACES;
use super::error::FeaturesError;
use crate::motion::{Ensemble, Frame, Motion, MotionError, Resampler};
use crate::progress::{Progress, Stage};
use crate::recordings::Recording;

/// An interval of frames in which a person is present without a gap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Stay {
    id: u32,
    first: u64,
    last: u64,
}

/// The intervals in which people are present, in evenly spaced frames.
#[derive(Clone, Debug, PartialEq)]
struct Presence {
    fps: f64,
    stays: Vec<Stay>,
}

/// A time span with the number of people present.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PresenceSpan {
    /// Time of the first frame, seconds.
    pub from_s: f64,
    /// Time of the last frame, seconds.
    pub to_s: f64,
    /// Number of people present throughout.
    pub people: usize,
    /// Number of people present for a part of it only.
    pub left_out: usize,
    /// Number of frames.
    pub moments: usize,
}

impl Presence {
    /// Records who is present in a motion, at `fps` frames per second from `from_s` to `to_s`.
    ///
    /// Memory grows with the number of people, not with time.
    ///
    /// # Errors
    /// [`FeaturesError::Motion`].
    fn of(motion: &mut dyn Motion, fps: f64, [from_s, to_s]: [f64; 2]) -> Result<Presence, FeaturesError> {
        let mut resampler = Resampler::new(fps);
        let mut frame = Frame::default();
        let mut present: Vec<Stay> = Vec::new();
        let mut stays = Vec::new();
        while motion.next_frame(&mut frame)? {
            resampler.push(&frame);
            resampler.pass_over_absence();
            while let Some((number, walkers)) = resampler.next() {
                let time_s = number as f64 / fps;
                if time_s < from_s || time_s > to_s {
                    continue;
                }
                let before = std::mem::take(&mut present);
                let mut known = before.into_iter().peekable();
                for walker in &walkers {
                    while let Some(gone) = known.next_if(|stay| stay.id < walker.id) {
                        stays.push(gone);
                    }
                    let stay = known.next_if(|stay| stay.id == walker.id);
                    let first = stay.map_or(number, |stay| stay.first);
                    present.push(Stay { id: walker.id, first, last: number });
                }
                stays.extend(known);
            }
            if frame.time_s > to_s {
                break;
            }
        }
        stays.extend(present);
        stays.sort_by_key(|stay| (stay.first, stay.id));
        Ok(Presence { fps, stays })
    }

    /// The span from the first to the last frame with people; `None` without people.
    fn whole(&self) -> Option<PresenceSpan> {
        let first = self.stays.first()?.first;
        let last = self.stays.iter().map(|stay| stay.last).max()?;
        Some(self.span(first, last))
    }

    /// The span with the most positions (people present throughout times frames), the earliest if several are equal.
    ///
    /// It has at least 2 people and 2 frames. Time grows with the number of people times the number of people present at
    /// once.
    fn longest(&self) -> Option<PresenceSpan> {
        // The best span begins when a person appears, and ends when a person leaves.
        let mut best: Option<(u64, [u64; 2])> = None;
        let mut ends: Vec<u64> = Vec::new();
        let mut next = 0;
        while let Some(&Stay { first, .. }) = self.stays.get(next) {
            while let Some(stay) = self.stays.get(next).filter(|stay| stay.first == first) {
                let at = ends.partition_point(|&end| end > stay.last);
                ends.insert(at, stay.last);
                next += 1;
            }
            ends.truncate(ends.partition_point(|&end| end > first));
            let most = best.map_or(0, |(places, _)| places);
            let bound = ends.first().map_or(0, |&last| (last - first + 1) * ends.len() as u64);
            if bound <= most {
                continue;
            }
            for (people, &last) in (1..).zip(&ends).skip(1) {
                let places = people * (last - first + 1);
                if best.is_none_or(|(most, _)| places > most) {
                    best = Some((places, [first, last]));
                }
            }
        }
        best.map(|(_, [first, last])| self.span(first, last))
    }

    fn span(&self, first: u64, last: u64) -> PresenceSpan {
        let within = self.stays.iter().filter(|stay| stay.first <= last && stay.last >= first);
        let mut ids: Vec<u32> = within.clone().map(|stay| stay.id).collect();
        ids.sort_unstable();
        ids.dedup();
        let people = within.filter(|stay| stay.first <= first && stay.last >= last).count();
        PresenceSpan {
            from_s: first as f64 / self.fps,
            to_s: last as f64 / self.fps,
            people,
            left_out: ids.len() - people,
            moments: (last - first + 1) as usize,
        }
    }
}

/// Reads the people of a recording who are present throughout a time span, and the span.
///
/// If both ends are given, the span is theirs; else it is the one with the most positions within the given end, see
/// `Presence::longest`. Frames per second are the recording's own by default.
///
/// # Errors
/// The recording cannot be read any more; fewer than two people in two frames; more positions than
/// `MOST_FEATURE_PLACES`; [`FeaturesError::Interrupted`].
pub fn present_throughout(
    recording: &Recording,
    fps: Option<f64>,
    [from_s, to_s]: [Option<f64>; 2],
    progress: &dyn Progress,
) -> Result<(Ensemble, PresenceSpan), FeaturesError> {
    let fps = fps.unwrap_or(recording.survey().fps);
    // A frame at the end of the span belongs to it, despite rounding.
    let within = |margin_s: f64| [from_s.unwrap_or(0.0) - margin_s, to_s.unwrap_or(f64::INFINITY) + margin_s];
    let presence = Presence::of(&mut WatchedMotion { motion: recording.motion()?, progress }, fps, within(1e-6))?;
    let longest = presence.longest();
    let exact = from_s.is_some() && to_s.is_some();
    let span = if exact { presence.whole() } else { longest };
    let Some(span) = span.filter(|span| span.people >= 2 && span.moments >= 2) else {
        let [from_s, to_s] = within(0.0);
        let people = span.map_or(0, |span| span.people);
        let longest_s = longest.map(|span| [span.from_s, span.to_s]);
        return Err(FeaturesError::NotTogether { from_s, to_s, people, longest_s });
    };
    let PresenceSpan { people, moments, .. } = span;
    if people.saturating_mul(moments) > MOST_FEATURE_PLACES {
        return Err(FeaturesError::TooMany { people, moments, most: MOST_FEATURE_PLACES });
    }
    let margin_s = 0.25 / fps;
    let of = [span.from_s - margin_s, span.to_s + margin_s];
    let ensemble = Ensemble::of_motion(&mut WatchedMotion { motion: recording.motion()?, progress }, fps, of)?;
    Ok((ensemble.with_statures(recording.statures()), span))
}

/// A motion that reports progress and can be interrupted.
struct WatchedMotion<'a> {
    motion: Box<dyn Motion + Send + 'a>,
    progress: &'a dyn Progress,
}

impl Motion for WatchedMotion<'_> {
    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError> {
        self.progress.keep_on()?;
        self.progress.advance(Stage::Motion, self.share_done());
        self.motion.next_frame(frame)
    }

    fn share_done(&self) -> f64 {
        self.motion.share_done()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::math::Vec2;
    use crate::motion::Walker;

    /// People who come and go: id, first and last moment, at 10 moments a second.
    struct Comings {
        stays: Vec<(u32, u64, u64)>,
        now: u64,
    }

    impl Motion for Comings {
        fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError> {
            let now = self.now;
            self.now += 1;
            frame.time_s = now as f64 / 10.0;
            let walker = |id| Walker { id, position_m: Vec2::ZERO, velocity_m_s: Vec2::ZERO, heading: None };
            let there = self.stays.iter().filter(|stay| stay.1 <= now && now <= stay.2);
            frame.walkers = there.map(|stay| walker(stay.0)).collect();
            frame.walkers.sort_by_key(|walker| walker.id);
            Ok(now <= self.stays.iter().map(|stay| stay.2).max().unwrap_or(0))
        }

        fn share_done(&self) -> f64 {
            0.0
        }
    }

    fn presence(stays: &[(u32, u64, u64)]) -> Presence {
        Presence::of(&mut Comings { stays: stays.to_vec(), now: 0 }, 10.0, [0.0, f64::MAX]).unwrap()
    }

    #[test]
    fn everybody_throughout_is_the_whole() {
        let all = presence(&[(1, 0, 20), (2, 0, 20), (5, 0, 20)]);
        let span = PresenceSpan { from_s: 0.0, to_s: 2.0, people: 3, left_out: 0, moments: 21 };
        assert_eq!((all.longest(), all.whole()), (Some(span), Some(span)));
    }

    #[test]
    fn the_time_with_the_most_places_is_found() {
        // Three together for 6 moments are 18 places, two for 8 are 16, and one alone does not count.
        let some = presence(&[(1, 0, 9), (2, 2, 11), (3, 4, 60), (4, 70, 90), (4, 95, 99)]);
        let span = PresenceSpan { from_s: 0.4, to_s: 0.9, people: 3, left_out: 0, moments: 6 };
        assert_eq!(some.longest(), Some(span));
        let whole = PresenceSpan { from_s: 0.0, to_s: 9.9, people: 0, left_out: 4, moments: 100 };
        assert_eq!(some.whole(), Some(whole));
    }

    #[test]
    fn nobody_together_is_nothing() {
        assert_eq!(presence(&[]).whole(), None);
        assert_eq!(presence(&[(1, 0, 9), (2, 10, 19)]).longest(), None);
        assert_eq!(presence(&[(1, 0, 9), (2, 9, 19)]).longest(), None);
    }

    proptest! {
        #[test]
        fn no_time_has_more_places(
            stays in prop::collection::vec((0u64..30, 0u64..15), 0..12),
        ) {
            let stays: Vec<_> = (0..).zip(&stays).map(|(id, &(first, long))| (id, first, first + long)).collect();
            let together = |first: u64, last: u64| {
                let there = stays.iter().filter(|stay| stay.1 <= first && stay.2 >= last).count();
                if there >= 2 && last > first { there as u64 * (last - first + 1) } else { 0 }
            };
            let most = (0..50).flat_map(|a| (a..50).map(move |b| (a, b))).map(|(a, b)| together(a, b)).max();
            let found = presence(&stays).longest().map_or(0, |span| (span.people * span.moments) as u64);
            prop_assert_eq!(Some(found), most);
        }
    }
}
