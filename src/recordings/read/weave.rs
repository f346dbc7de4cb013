//! Makes frames of rows that come in the order of time.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap;

use super::RecordingError;
use super::row::{ReadStop, TrajectoryRow};
use super::rows::TrajectoryRows;
use super::scale::{Alignment, Scale};
use crate::math::Vec2;
use crate::motion::{Frame, Motion, MotionError, Walker};

/// Who would have had to move faster than this while missing has left and come again, metres per second.
const FASTEST_M_S: f64 = 12.0;
/// Nobody moves faster than this between two frames: they were put elsewhere, metres per second.
const PUT_ELSEWHERE_M_S: f64 = 20.0;
/// Who stands between two steps is where they were to within this, metres.
const STANDS_M: f64 = 0.05;
/// Differences of times below this are none, seconds.
const SAME_S: f64 = 1e-6;

/// A recording as a motion. Frames are given out when whoever is missing from them can have come back: about a second
/// after they were read; more is not held, however long the recording is.
pub(super) struct Weaver {
    rows: TrajectoryRows,
    scale: Scale,
    align: Alignment,
    first_time: f64,
    /// Whether all rows were read.
    read: bool,
    /// Where everybody was last.
    tracks: FxHashMap<u32, LastPlace>,
    /// Tracks are looked through when there are so many.
    most_tracks: usize,
    /// The moments that were not given out yet, by number; without a common clock, the newest stands apart.
    pending: BTreeMap<u64, PendingFrame>,
    latest: PendingFrame,
    /// The newest moment's number and time.
    newest: u64,
    newest_s: f64,
    newest_raw: f64,
    /// Ids that were given.
    known: IdSet,
    next_id: u32,
    /// The moment that was given out last.
    before: PendingFrame,
    /// Room for people that is free again.
    spare: Vec<(Walker, bool)>,
}

#[derive(Clone, Copy, Debug)]
struct LastPlace {
    /// The id in the motion.
    id: u32,
    number: u64,
    time_s: f64,
    at: Vec2,
    heading: Option<Vec2>,
    /// Whether it is the end of a step.
    ahead: bool,
}

#[derive(Clone, Debug, Default)]
struct PendingFrame {
    time_s: f64,
    people: Vec<(Walker, bool)>,
}

impl PendingFrame {
    fn add(&mut self, id: u32, position_m: Vec2, velocity: Option<Vec2>, heading: Option<Vec2>) {
        let velocity_m_s = velocity.unwrap_or(Vec2::ZERO);
        self.people.push((Walker { id, position_m, velocity_m_s, heading }, velocity.is_some()));
    }

    fn sort(&mut self) {
        if !self.people.is_sorted_by_key(|(walker, _)| walker.id) {
            self.people.sort_by_key(|(walker, _)| walker.id);
        }
    }
}

/// The ids that were given, a bit for each.
#[derive(Default)]
struct IdSet(Vec<u64>);

impl IdSet {
    /// Notes an id; says whether it is a new one.
    fn insert(&mut self, id: u32) -> bool {
        let (word, bit) = (id as usize / 64, 1 << (id % 64));
        if word >= self.0.len() {
            self.0.resize((word + 1).next_power_of_two(), 0);
        }
        let new = self.0[word] & bit == 0;
        self.0[word] |= bit;
        new
    }
}

impl Weaver {
    pub fn new(rows: TrajectoryRows, scale: Scale, align: Alignment, first_time: f64, largest_id: u32) -> Weaver {
        Weaver {
            rows,
            scale,
            align,
            first_time,
            read: false,
            tracks: FxHashMap::default(),
            most_tracks: 1024,
            pending: BTreeMap::new(),
            latest: PendingFrame::default(),
            newest: 0,
            newest_s: f64::NEG_INFINITY,
            newest_raw: f64::NAN,
            known: IdSet::default(),
            next_id: largest_id.saturating_add(1),
            before: PendingFrame::default(),
            spare: Vec::new(),
        }
    }

    /// How much later than a moment rows must have come before it is given out, seconds.
    fn look_ahead_s(&self) -> f64 {
        let tick_s = if self.scale.own_clock { 1.0 / self.scale.fps } else { 0.0 };
        self.scale.stand_s.unwrap_or(self.scale.gap_s) + tick_s + 2.0 * SAME_S
    }

    fn seconds(&self, raw: f64) -> f64 {
        self.scale.time.seconds(raw - self.first_time)
    }

    fn take(&mut self, row: &TrajectoryRow) {
        if row.time != self.newest_raw {
            let time_s = self.seconds(row.time);
            self.newest_raw = row.time;
            if self.newest_s + SAME_S <= time_s {
                self.newest_s = time_s;
                if !self.scale.own_clock {
                    self.settle_latest();
                    self.newest += 1;
                    self.latest.time_s = time_s;
                }
                self.forget();
            }
        }
        let velocity = row.velocity.filter(|_| self.scale.velocities).map(|v| self.align.velocity(v));
        let heading = row.heading.filter(|_| self.scale.headings).map(|heading| self.align.direction(heading));
        self.place(row.id, self.newest_s, row.at, velocity, heading, false);
        if let Some((time, at)) = row.until {
            self.place(row.id, self.seconds(time), at, None, heading, true);
        }
    }

    /// Puts the newest moment with those before it.
    fn settle_latest(&mut self) {
        if self.newest > 0 && !self.latest.people.is_empty() {
            let spare = PendingFrame { time_s: 0.0, people: std::mem::take(&mut self.spare) };
            let latest = std::mem::replace(&mut self.latest, spare);
            self.pending.insert(self.newest, latest);
        }
    }

    /// Takes somebody's next place.
    fn place(
        &mut self,
        own_id: u32,
        time_s: f64,
        raw: Vec2,
        velocity: Option<Vec2>,
        heading: Option<Vec2>,
        ahead: bool,
    ) {
        let at = self.align.place(raw);
        let mut now = LastPlace { id: own_id, number: self.newest, time_s, at, heading, ahead };
        let Some(track) = self.tracks.get_mut(&own_id) else {
            self.begin(now, velocity);
            return;
        };
        let last = *track;
        if time_s < last.time_s + SAME_S {
            // A repeated row, or a step that begins before the last one ended.
            return;
        }
        let missing_s = time_s - last.time_s;
        let stood = (self.scale.stand_s)
            .is_some_and(|most_s| last.ahead && missing_s <= most_s + SAME_S && at.distance(last.at) <= STANDS_M);
        let next_to = !self.scale.own_clock && last.number + 1 == self.newest;
        // Neighbouring moments far apart are those of a time at which nobody was there.
        let bridged = (stood || missing_s <= self.scale.gap_s + SAME_S)
            && (next_to || at.distance(last.at) <= 1.0 + FASTEST_M_S * missing_s);
        if !bridged {
            self.tracks.remove(&own_id);
            self.begin(now, velocity);
            return;
        }
        now.id = last.id;
        *track = now;
        if self.scale.own_clock {
            self.show_between(&last, &now);
        } else {
            for number in last.number + 1..self.newest {
                if let Some(moment) = self.pending.get_mut(&number) {
                    let share = (moment.time_s - last.time_s) / missing_s;
                    moment.add(now.id, last.at.lerp(at, share), None, between(last.heading, heading, share));
                }
            }
            self.show(now.id, at, velocity, heading);
        }
    }

    /// Somebody comes, or comes back as somebody else.
    fn begin(&mut self, mut now: LastPlace, velocity: Option<Vec2>) {
        let own_id = now.id;
        if !self.known.insert(own_id) {
            now.id = self.next_id;
            self.next_id = self.next_id.saturating_add(1);
        }
        if self.scale.own_clock {
            let tick = (now.time_s * self.scale.fps).round();
            if (tick / self.scale.fps - now.time_s).abs() < SAME_S {
                self.moment_at(tick as u64).add(now.id, now.at, velocity, now.heading);
            }
        } else {
            self.show(now.id, now.at, velocity, now.heading);
        }
        self.tracks.insert(own_id, now);
    }

    fn show(&mut self, id: u32, at: Vec2, velocity: Option<Vec2>, heading: Option<Vec2>) {
        self.latest.add(id, at, velocity, heading);
    }

    fn moment_at(&mut self, tick: u64) -> &mut PendingFrame {
        let time_s = tick as f64 / self.scale.fps;
        self.pending.entry(tick).or_insert_with(|| PendingFrame { time_s, people: Vec::new() })
    }

    /// Shows somebody at the ticks of the clock after one place and up to the next.
    fn show_between(&mut self, last: &LastPlace, now: &LastPlace) {
        let fps = self.scale.fps;
        let mut tick = ((last.time_s + SAME_S) * fps).floor() as u64 + 1;
        loop {
            let time_s = tick as f64 / fps;
            if time_s >= now.time_s + SAME_S {
                return;
            }
            let share = ((time_s - last.time_s) / (now.time_s - last.time_s)).clamp(0.0, 1.0);
            let heading = between(last.heading, now.heading, share);
            self.moment_at(tick).add(now.id, last.at.lerp(now.at, share), None, heading);
            tick += 1;
        }
    }

    /// Forgets those who will not be connected with anything any more.
    fn forget(&mut self) {
        if self.tracks.len() < self.most_tracks {
            return;
        }
        let since_s = self.newest_s - self.look_ahead_s();
        self.tracks.retain(|_, track| track.time_s >= since_s);
        self.most_tracks = 1024.max(2 * self.tracks.len());
    }

    /// Reads until the oldest pending moment cannot change any more.
    fn read_ahead(&mut self) -> Result<(), RecordingError> {
        let look_ahead_s = self.look_ahead_s();
        while !self.read {
            let oldest = self.pending.first_key_value();
            let ready_s = oldest.map_or(f64::INFINITY, |(_, oldest)| oldest.time_s + look_ahead_s);
            if self.newest_s > ready_s {
                return Ok(());
            }
            match self.rows.next() {
                Ok(Some(row)) => self.take(&row),
                Err(ReadStop::Error(error)) => return Err(error),
                // The survey saw no id that is a name: if one comes, the file was changed since, and ends here.
                Ok(None) | Err(ReadStop::Name) => {
                    self.settle_latest();
                    self.read = true;
                }
            }
        }
        Ok(())
    }
}

impl Motion for Weaver {
    fn next_frame(&mut self, frame: &mut Frame) -> Result<bool, MotionError> {
        self.read_ahead().map_err(MotionError::of_source)?;
        let Some((_, mut now)) = self.pending.pop_first() else { return Ok(false) };
        now.sort();
        if let Some(mut next) = self.pending.first_entry() {
            next.get_mut().sort();
        }
        let empty = PendingFrame::default();
        let next = self.pending.first_key_value().map_or(&empty, |(_, next)| next);
        frame.time_s = now.time_s;
        frame.walkers.clear();
        let (mut earlier, mut later) = (self.before.people.iter().peekable(), next.people.iter().peekable());
        for (walker, has_velocity) in &mut now.people {
            let same_in = |others: &mut std::iter::Peekable<std::slice::Iter<'_, (Walker, bool)>>| {
                while others.next_if(|(other, _)| other.id < walker.id).is_some() {}
                others.next_if(|(other, _)| other.id == walker.id).map(|(other, _)| other.position_m)
            };
            let (was, will_be) = (same_in(&mut earlier), same_in(&mut later));
            if !*has_velocity {
                let here = (now.time_s, walker.position_m);
                let was = was.map_or(here, |at| reachable(here, (self.before.time_s, at)));
                let will_be = will_be.map_or(here, |at| reachable(here, (next.time_s, at)));
                let lasted_s = will_be.0 - was.0;
                walker.velocity_m_s = if lasted_s > 0.0 { (will_be.1 - was.1) / lasted_s } else { Vec2::ZERO };
            }
            frame.walkers.push(*walker);
        }
        self.spare = std::mem::replace(&mut self.before, now).people;
        self.spare.clear();
        Ok(true)
    }

    fn share_done(&self) -> f64 {
        self.rows.share_done()
    }
}

/// Another place of somebody, or the present one if they were put there.
fn reachable(here: (f64, Vec2), other: (f64, Vec2)) -> (f64, Vec2) {
    let far = here.1.distance(other.1) > PUT_ELSEWHERE_M_S * (here.0 - other.0).abs() + 0.1;
    if far { here } else { other }
}

fn between(a: Option<Vec2>, b: Option<Vec2>, share: f64) -> Option<Vec2> {
    match (a, b) {
        // Half a turn has no direction in between.
        (Some(a), Some(b)) => a.lerp(b, share).normalized().or(Some(b)),
        (a, b) => b.or(a),
    }
}
