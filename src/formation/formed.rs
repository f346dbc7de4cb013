use crate::motion::Ensemble;

/// The crowd that a [`FormationRequest`](super::FormationRequest) describes.
#[derive(Clone, Debug, PartialEq)]
pub struct FormedCrowd {
    /// Positions over time.
    ///
    /// Ids count from 0, crowd by crowd: individuals in the order of the example's people; an individual that is a small
    /// crowd is replaced by the people of that crowd, its rider last.
    pub ensemble: Ensemble,
    /// The people, in the order of ids.
    pub people: Vec<FormedPerson>,
}

/// A person of a formed crowd.
#[derive(Clone, Debug, PartialEq)]
pub struct FormedPerson {
    /// Index of the individual in the whole crowd, in the small crowd in its place, and so on, each from 0. A rider counts
    /// after the carriers.
    pub address: Vec<u32>,
    /// Whether the person is carried and does not touch the floor.
    pub rides: bool,
    /// Body height in metres, where the recording that the person moves as tells it.
    pub stature_m: Option<f64>,
}

impl FormedCrowd {
    /// The people who walk on the floor, with their ids; riders are left out.
    pub fn on_foot(&self) -> Ensemble {
        let walks: Vec<bool> = self.people.iter().map(|who| !who.rides).collect();
        let ids = self.ensemble.ids.iter().zip(&walks).filter(|(_, walks)| **walks).map(|(id, _)| *id).collect();
        let people = walks.len().max(1);
        let moments = 0..self.ensemble.moments();
        let places = moments.flat_map(|moment| self.ensemble.places_at(moment).iter().enumerate());
        let places = places.filter(|(k, _)| walks[k % people]).map(|(_, place)| *place).collect();
        let made = Ensemble::new(self.ensemble.fps, self.ensemble.start_s, ids, places);
        made.with_statures(self.ensemble.statures().clone())
    }

    /// Number of people who are carried.
    pub fn riders(&self) -> usize {
        self.people.iter().filter(|who| who.rides).count()
    }
}
