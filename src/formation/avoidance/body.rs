use crate::formation::formed::FormedPerson;
use crate::formation::request::AvoidRequest;
use crate::math::Vec2;

/// Bodies' middles never come nearer to each other, where nothing else is said, metres: body depth, people turn.
const USUAL_DISTANCE_M: f64 = 0.36;

/// What keeps clear of others as one: a person, or people who keep together.
#[derive(Clone, Debug)]
pub(in super::super) struct FormationBody {
    /// Its middle, moment by moment, metres.
    pub places: Vec<Vec2>,
    /// Everybody who belongs to it, in the order of ids.
    pub people: Vec<BodyMember>,
    reach: Reach,
}

/// Somebody who belongs to a body.
#[derive(Clone, Debug)]
pub(in super::super) struct BodyMember {
    /// Where they are from its middle, moment by moment; empty for in its middle.
    pub offsets: Vec<Vec2>,
    pub who: FormedPerson,
}

/// How far from its middle a body keeps others.
#[derive(Clone, Debug)]
enum Reach {
    Always(f64),
    ByMoment(Vec<f64>),
}

impl FormationBody {
    /// A body of one person.
    pub fn person(places: Vec<Vec2>, who: FormedPerson, avoid: &AvoidRequest) -> FormationBody {
        let reach_m = avoid.distance_m.unwrap_or(USUAL_DISTANCE_M) / 2.0;
        FormationBody { places, people: vec![BodyMember { offsets: Vec::new(), who }], reach: Reach::Always(reach_m) }
    }

    /// A body of several, whose places are from its middle; it goes along a track.
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

    /// How far from its middle it keeps others at a moment, metres.
    pub fn reach_m(&self, moment: usize) -> f64 {
        match &self.reach {
            Reach::Always(reach_m) => *reach_m,
            Reach::ByMoment(reaches_m) => reaches_m[moment],
        }
    }
}
