use serde::{Deserialize, Serialize};

/// Counts of the visits of a stop.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StopTally {
    /// The stop's name.
    pub name: String,
    /// Whether people wait in a queue there.
    pub in_line: bool,
    /// Number of visits that have ended.
    pub visits: u64,
    /// Waiting time of all visits together, or the time to walk up to a spot, seconds.
    pub waited_s: f64,
    /// Dwell time of all visits together, seconds.
    pub stayed_s: f64,
    /// Largest number of people who were there or in the queue at once.
    pub most: usize,
    /// Number of people for whom there is room; more stand around in a loose crowd.
    pub room: usize,
}

impl StopTally {
    /// Warns if more people came at once than there is room for.
    pub(in crate::crowd) fn warning(&self) -> Option<String> {
        let StopTally { name, in_line, most, room, .. } = self;
        (most > room).then(|| match in_line {
            true => format!("the line at \"{name}\" reached {most} people, there is room for {room}"),
            false => format!("{most} people were at \"{name}\" at once, there is room for {room}"),
        })
    }

    pub(super) fn crowd(&mut self, people: usize, room: usize) {
        if people > self.most {
            (self.most, self.room) = (people, room);
        }
    }

    pub(super) fn add(&mut self, visit: &Visit) {
        self.visits += 1;
        self.waited_s += visit.begun_s - visit.came_s;
        self.stayed_s += visit.left_s - visit.begun_s;
    }
}

/// A visit of a stop by one person.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Visit {
    /// Number of the person.
    pub id: u32,
    /// Index of the stop, in the order in which routes first name them.
    pub stop: usize,
    /// Time at which the person joined the queue or found a spot, seconds.
    pub came_s: f64,
    /// Time at which the stay or the service began, seconds.
    pub begun_s: f64,
    /// Time at which it ended, seconds.
    pub left_s: f64,
}
