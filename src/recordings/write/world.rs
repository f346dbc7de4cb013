use crate::motion::People;
use crate::plan::FloorPlan;
use crate::walls::Walls;

/// What a recording says of the world that people walk in. Places are written in the map frame: that of the ROS map
/// where the plan is one, and the plan frame elsewhere.
#[derive(Clone, Copy, Debug)]
pub struct RecordedWorld<'a> {
    /// Where the plan lies on the map.
    pub plan: &'a FloorPlan,
    /// The floor that people can walk on, aprons included.
    pub walls: &'a Walls,
    /// How tall people are.
    pub people: &'a People,
}
