use super::avoidance::{AvoidanceSettings, FormationBody, keep_clear};
use super::formed::FormedPerson;
use super::{AvoidRequest, FormationError};
use crate::motion::Ensemble;
use crate::progress::Progress;

impl AvoidRequest {
    /// Leads the people of any motion apart who come too near to each other, as a formation does; the others stay as they are.
    ///
    /// People step aside early and smoothly, and return. Without [`AvoidRequest::push`] nobody is pushed who is merely near.
    /// Where it is too crowded people are never moved more suddenly than they stagger: they overlap, and a warning says where and
    /// when.
    ///
    /// # Errors
    /// [`FormationError::Interrupted`].
    pub fn keep_apart(&self, motion: Ensemble, progress: &dyn Progress) -> Result<Ensemble, FormationError> {
        let people = motion.people();
        let body = |k: usize| {
            let places = (0..motion.moments()).map(|moment| motion.places_at(moment)[k]).collect();
            let who = FormedPerson { address: vec![k as u32], rides: false, stature_m: None };
            FormationBody::person(places, who, self)
        };
        let mut bodies: Vec<FormationBody> = (0..people).map(body).collect();
        let avoid = AvoidRequest { push: self.push.or(Some(0.0)), ..self.clone() };
        let settings = AvoidanceSettings {
            hint: "change the motion less, or keep people less far apart",
            ..AvoidanceSettings::new(&avoid, motion.fps, &[])
        };
        keep_clear(&settings, &mut bodies, progress)?;
        let mut apart = motion;
        for moment in 0..apart.moments() {
            apart.places_at_mut(moment).iter_mut().zip(&bodies).for_each(|(place, body)| *place = body.places[moment]);
        }
        Ok(apart)
    }
}
