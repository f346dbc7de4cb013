use std::path::Path;

use super::builder::{CrowdBuilder, check_size};
use crate::formation::FormationError;
use crate::formation::formed::FormedCrowd;
use crate::formation::request::{CrowdSection, FormationRequest, RequestError};
use crate::math::Vec2;
use crate::motion::Ensemble;
use crate::progress::{Progress, Stage};

/// Default frame rate, frames per second: that of the crowd simulation.
const USUAL_FPS: f64 = 10.0;
/// Default duration of a formation, seconds.
const USUAL_S: f64 = 60.0;

/// Builds the crowd that a request describes; file paths are relative to `folder`.
///
/// # Errors
/// [`FormationError::Request`] for values out of range or in conflict, unreadable files, and formations whose number of
/// positions is not the number of people; recordings that cannot be read; more people or frames than can be held; [`FormationError::Interrupted`].
pub fn form(request: &FormationRequest, folder: &Path, progress: &dyn Progress) -> Result<FormedCrowd, FormationError> {
    request.check().map_err(RequestError::Option)?;
    let fps = request.fps.unwrap_or(USUAL_FPS);
    let mut builder = CrowdBuilder::new(folder, fps, progress);
    let duration_s = match (request.duration_s, last_key_s(request)) {
        (Some(duration_s), _) => duration_s,
        (None, Some(last_s)) if last_s > 0.0 => last_s,
        (None, _) => builder.example_duration_s(request)?.unwrap_or(USUAL_S),
    };
    // Rounded down, so that no frame lies after the end; a duration of whole frames keeps its last one.
    builder.moments = ((duration_s * fps + 1e-6).floor() as usize).max(1) + 1;
    // Before anything is made for each frame.
    check_size(1, builder.moments)?;
    let bodies = builder.whole(request)?;
    progress.advance(Stage::Motion, 1.0);

    let people = bodies.iter().map(|body| body.people.len()).sum::<usize>();
    let mut places_m = vec![Vec2::ZERO; people * builder.moments];
    let mut all = Vec::with_capacity(people);
    for body in bodies {
        for person in body.people {
            let k = all.len();
            for moment in 0..builder.moments {
                let offset = person.offsets.get(moment).copied().unwrap_or_default();
                places_m[moment * people + k] = body.places[moment] + offset;
            }
            all.push(person.who);
        }
    }
    let ids = 0..people as u32;
    let statures = ids.clone().zip(&all).filter_map(|(id, who)| Some((id, who.stature_m?))).collect();
    let ensemble = Ensemble::new(fps, 0.0, ids.collect(), places_m).with_statures(statures);
    Ok(FormedCrowd { ensemble, people: all })
}

/// End of the last key formation of all crowds, seconds.
fn last_key_s(request: &FormationRequest) -> Option<f64> {
    fn of(section: CrowdSection<'_>) -> Option<f64> {
        let own = section.key.last().map(|key| key.time_s + key.hold_s);
        section.crowd.iter().filter_map(|crowd| of(crowd.section())).chain(own).reduce(f64::max)
    }
    of(request.section())
}
