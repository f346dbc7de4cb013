use crate::motion::People;
use crate::plan::FloorPlan;
use crate::walls::Walls;

/// The world of a recording. Positions are written in the frame of the ROS map, or else in the plan frame.
#[derive(Clone, Copy, Debug)]
pub struct RecordedWorld<'a> {
    /// Floor plan, with its pose on the map.
    pub plan: &'a FloorPlan,
    /// Walls around the walkable floor, aprons included.
    pub walls: &'a Walls,
    /// People, for their body heights.
    pub people: &'a People,
}
