use super::find::{Room, Rooms};
use super::kind::RoomKind;
use super::request::{LifeOptions, RoomRequest, UnfitRoom};
use super::uses::Use;
use crate::plan::FloorPlan;
use crate::walls::Walls;

/// Most rooms in a row that people only cross, where each has two doors.
const MOST_CROSSED: usize = 4;

/// The rooms of a building and what it is for, by which people live in it.
#[derive(Clone, Debug)]
pub struct Life {
    /// Rooms and entrances.
    pub rooms: Rooms,
    /// What the building is for.
    pub r#use: Use,
    /// Whether that is a guess.
    pub guessed: bool,
}

impl Life {
    /// Finds the rooms of a plan, changes them as a scenario says, and guesses the use unless it is said.
    pub(crate) fn of(
        plan: &FloorPlan,
        walls: &Walls,
        options: &LifeOptions,
        requests: &[RoomRequest],
    ) -> Result<Life, UnfitRoom> {
        let mut rooms = Rooms::find(plan, walls);
        rooms.say(plan, requests)?;
        let r#use = options.r#use.unwrap_or_else(|| Use::guess(&rooms, &plan.furniture));
        Ok(Life { rooms, r#use, guessed: options.r#use.is_none() })
    }

    /// Whether there are rooms to live in: a single space without seats, unless it has one door and no other, and few
    /// that lie between entrances, are crossed.
    pub(crate) fn has_rooms(&self) -> bool {
        let Rooms { rooms, entrances, .. } = &self.rooms;
        let is_dead_end = |room: &Room| room.doors < 2;
        match rooms.len() {
            0 => false,
            1 => entrances.len() == 1 && rooms[0].kind != RoomKind::Corridor || self.rooms.has_seats(),
            count => entrances.len() < 2 || count > MOST_CROSSED || rooms.iter().any(is_dead_end),
        }
    }

    /// A line for users: what the building is taken for.
    pub fn describe(&self) -> String {
        let Life { rooms, r#use, guessed } = self;
        let (count, name) = (rooms.rooms.len(), r#use.name());
        let how = if *guessed { "looks like" } else { "is" };
        let an = if name.starts_with(['a', 'o']) { "an" } else { "a" };
        format!("the building of {count} rooms {how} {an} {name}")
    }
}
