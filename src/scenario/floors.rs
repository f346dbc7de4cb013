//! Which floor lies in which room, where a scenario leaves that open.

use super::model::Scenario;
use super::preset::Preset;
use crate::look::{FloorLook, Material, Srgb8};
use crate::rooms::{Life, RoomKind, Use};
use crate::walls::Walls;

/// Offices have lighter carpets than others: dirt shows on them.
const OFFICE_CARPET: Srgb8 = [150, 152, 154];

/// The floor that a room of a kind mostly has in such a building.
fn usual(building: Use, kind: RoomKind) -> FloorLook {
    let material = match (building, kind) {
        (_, RoomKind::Toilet) => Material::Tile,
        (Use::Home, _) | (Use::Museum, RoomKind::Room) => Material::Wood,
        (Use::Museum, _) => Material::Stone,
        (Use::Office, RoomKind::Room | RoomKind::Hall) => Material::Carpet,
        (Use::Station, RoomKind::Corridor | RoomKind::Hall) => Material::Terrazzo,
        (Use::School, RoomKind::Corridor | RoomKind::Hall) | (_, RoomKind::Stairs) => Material::Terrazzo,
        (Use::Shop, RoomKind::Room | RoomKind::Corridor) => Material::Concrete,
        _ => Material::Vinyl,
    };
    FloorLook { material, colour: (material == Material::Carpet).then_some(OFFICE_CARPET), ..FloorLook::default() }
}

impl Scenario {
    /// The scenario with the floors of the building's rooms: where people live in them, and neither the look nor the
    /// preset says what the floor is.
    pub(crate) fn with_floors(mut self, life: Option<&Life>, walls: &Walls) -> Scenario {
        let is_open = self.routes.life.floors && self.preset != Preset::Paper;
        let look = &mut self.look;
        if let Some(life) = life
            && is_open
            && look.area.is_empty()
            && look.floor == FloorLook::default()
        {
            let floor = |kind| usual(life.r#use, kind);
            let rooms = life.rooms.rooms.iter().map(|room| (room.inside_m, room.area_m2, floor(room.kind)));
            look.lay_floors(&rooms.collect::<Vec<_>>(), walls);
        }
        self
    }
}
