use crate::formation::formed::FormedPerson;
use crate::formation::request::AvoidRequest;
use crate::math::Vec2;

/// Default least distance between the centres of two people, metres: body depth, since people turn.
const USUAL_DISTANCE_M: f64 = 0.36;

/// A body that keeps clear of others: a person, or people who move as one.
#[derive(Clone, Debug)]
pub(in super::super) struct FormationBody {
    /// Its centre in each frame, metres.
    pub places: Vec<Vec2>,
    /// The people of the body, in the order of ids.
    pub people: Vec<BodyMember>,
    reach: Reach,
}

/// A person of a body.
#[derive(Clone, Debug)]
pub(in super::super) struct BodyMember {
    /// Offset from the body's centre in each frame, metres; empty if always at the centre.
    pub offsets: Vec<Vec2>,
    pub who: FormedPerson,
}

/// The radius within which a body keeps others away.
#[derive(Clone, Debug)]
enum Reach {
    Always(f64),
    ByMoment(Vec<f64>),
}

impl FormationBody {
    /// Makes a body of one person.
    pub fn person(places: Vec<Vec2>, who: FormedPerson, avoid: &AvoidRequest) -> FormationBody {
        let reach_m = avoid.distance_m.unwrap_or(USUAL_DISTANCE_M) / 2.0;
        FormationBody { places, people: vec![BodyMember { offsets: Vec::new(), who }], reach: Reach::Always(reach_m) }
    }

    /// Makes one body of several, whose positions are relative to its centre; the centre moves along a track.
    pub fn of_all(bodies: Vec<FormationBody>, track: Vec<Vec2>) -> FormationBody {
        let moments = track.len();
        let reach = |moment: usize| {
            bodies.iter().map(|body| body.places[moment].length() + body.reach_m(moment)).fold(0.0, f64::max)
        };
        let reach = Reach::ByMoment((0..moments).map(reach).collect());
        let mut people = Vec::new();
        for body in bodies {
            for BodyMember { offsets, who } in body.people {
                let offsets = if offsets.is_empty() {
                    body.places.clone()
                } else {
                    offsets.into_iter().zip(&body.places).map(|(offset, &middle)| offset + middle).collect()
                };
                people.push(BodyMember { offsets, who });
            }
        }
        FormationBody { places: track, people, reach }
    }

    /// Radius within which the body keeps others away in a frame, metres.
    pub fn reach_m(&self, moment: usize) -> f64 {
        match &self.reach {
            Reach::Always(reach_m) => *reach_m,
            Reach::ByMoment(reaches_m) => reaches_m[moment],
        }
    }
}
