//! Makes a crowd of what a `[formation]` asks for: examples, key formations, small crowds in the places of individuals.

mod example;
mod generated;
mod heading;
mod keys;
mod level;
mod way;

use std::path::Path;

pub use level::{MOST_IN_ALL, MOST_KEY_PAIRS};

use level::Maker;

pub(super) use way::angles;

use super::request::{FormationRequest, RequestError};
use crate::formation::FormationError;
use crate::math::Vec2;
use crate::motion::Ensemble;
use crate::progress::{Progress, Stage};

/// Frames per second where nothing else is asked for: those of the crowd's own simulation.
pub(super) const USUAL_FPS: f64 = 10.0;
/// The most places of a formation, people times moments: several of its steps hold all of them at once.
pub const MOST_FORMED_PLACES: usize = 20_000_000;
/// How long a formation lasts where nothing says it, seconds.
const USUAL_S: f64 = 60.0;

/// A crowd as a `[formation]` asked for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Formed {
    /// Everybody's places. Ids count from 0 on, crowd by crowd: individuals in the order of the example's people, in the
    /// place of an individual who is a small crowd the people of that, its rider last.
    pub ensemble: Ensemble,
    /// Who everybody is, in the order of ids.
    pub people: Vec<Who>,
}

/// Who somebody is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Who {
    /// Which individual of the whole, which of the small crowd in its place, and so on; each counted from 0. A rider
    /// counts after the carriers.
    pub address: Vec<u32>,
    /// Whether they are carried and do not touch the floor.
    pub rides: bool,
}

impl Formed {
    /// The same without those who are carried: those who leave marks on the floor. They keep their ids.
    pub fn on_foot(&self) -> Ensemble {
        let walks: Vec<bool> = self.people.iter().map(|who| !who.rides).collect();
        let ids = self.ensemble.ids.iter().zip(&walks).filter(|(_, walks)| **walks).map(|(id, _)| *id).collect();
        let people = walks.len().max(1);
        let moments = 0..self.ensemble.moments();
        let places = moments.flat_map(|moment| self.ensemble.places_at(moment).iter().enumerate());
        let places = places.filter(|(k, _)| walks[k % people]).map(|(_, place)| *place).collect();
        Ensemble::new(self.ensemble.fps, self.ensemble.start_s, ids, places)
    }

    /// How many are carried.
    pub fn riders(&self) -> usize {
        self.people.iter().filter(|who| who.rides).count()
    }
}

/// Makes the crowd that a request describes; paths in it start from `folder`.
///
/// # Errors
/// Values out of range or that do not fit each other; files that cannot be read; formations with places for others than
/// there are; more people or frames than can be held; [`FormationError::Interrupted`].
pub fn form(request: &FormationRequest, folder: &Path, progress: &dyn Progress) -> Result<Formed, FormationError> {
    request.check().map_err(asked)?;
    let fps = request.fps.unwrap_or(USUAL_FPS);
    let mut maker = Maker::new(folder, fps, progress);
    let duration_s = match (request.duration_s, last_key_s(request)) {
        (Some(duration_s), _) => duration_s,
        (None, Some(last_s)) if last_s > 0.0 => last_s,
        (None, _) => maker.example_duration_s(request)?.unwrap_or(USUAL_S),
    };
    // Rounding down leaves no moment after the end; a duration of a whole number of frames keeps its last.
    maker.moments = ((duration_s * fps + 1e-6).floor() as usize).max(1) + 1;
    // Before anything is made for each moment.
    check_size(1, maker.moments)?;
    let bodies = maker.whole(request)?;
    progress.advance(Stage::Motion, 1.0);

    let people = bodies.iter().map(|body| body.people.len()).sum::<usize>();
    let mut places_m = vec![Vec2::ZERO; people * maker.moments];
    let mut all = Vec::with_capacity(people);
    for body in bodies {
        for person in body.people {
            let k = all.len();
            for moment in 0..maker.moments {
                let offset = person.offsets.get(moment).copied().unwrap_or_default();
                places_m[moment * people + k] = body.places[moment] + offset;
            }
            all.push(person.who);
        }
    }
    let ids = (0..people as u32).collect();
    Ok(Formed { ensemble: Ensemble::new(fps, 0.0, ids, places_m), people: all })
}

/// When the last key formation of all ends, seconds.
fn last_key_s(request: &FormationRequest) -> Option<f64> {
    fn of(section: super::request::Section<'_>) -> Option<f64> {
        let own = section.key.last().map(|key| key.time_s + key.hold_s);
        section.crowd.iter().filter_map(|crowd| of(crowd.section())).chain(own).reduce(f64::max)
    }
    of(request.section())
}

/// A request that cannot be met, as everybody's error.
fn asked(error: RequestError) -> FormationError {
    error.into()
}

/// Refuses more places than can be held.
fn check_size(people: usize, moments: usize) -> Result<(), FormationError> {
    match people.checked_mul(moments) {
        Some(places) if places <= MOST_FORMED_PLACES => Ok(()),
        _ => Err(asked(RequestError::TooLong { people, moments, most: MOST_FORMED_PLACES })),
    }
}

#[cfg(test)]
mod tests;
