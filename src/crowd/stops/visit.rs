use serde::Serialize;

/// What happened at a stop.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct StopTally {
    /// The stop's name.
    pub name: String,
    /// Whether people wait in line there.
    pub in_line: bool,
    /// How many visits have ended.
    pub visits: u64,
    /// How long all of them together waited in line, or walked up to their spots, seconds.
    pub waited_s: f64,
    /// How long all of them together stayed or were served, seconds.
    pub stayed_s: f64,
    /// The most people who were there or in line at once.
    pub most: usize,
    /// How many find room there; more stand around in a loose crowd.
    pub room: usize,
}

impl StopTally {
    /// Says that more people came than find room, if so.
    pub fn warning(&self) -> Option<String> {
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

/// One person's visit of a stop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Visit {
    /// Who.
    pub id: u32,
    /// Index of the stop, in the order in which routes first name them.
    pub stop: usize,
    /// When the person joined the line or found a spot, seconds.
    pub came_s: f64,
    /// When the stay or the service began, seconds.
    pub begun_s: f64,
    /// When it ended, seconds.
    pub left_s: f64,
}
