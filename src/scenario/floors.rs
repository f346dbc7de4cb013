//! Which floor lies in which room, where a scenario leaves that open.

use super::model::Scenario;
use super::preset::Preset;
use crate::look::{FloorLook, Material, RoomFloor, Srgb8};
use crate::rooms::{Life, Room, RoomKind, Use};
use crate::walls::Walls;

/// Offices have lighter carpets than others: dirt shows on them.
const OFFICE_CARPET: Srgb8 = [150, 152, 154];

/// Largest room of a home that is a bath, if it has one door: square metres.
const BATH_M2: f64 = 8.5;

/// The floor that such a room mostly has.
fn usual(building: Use, room: &Room) -> FloorLook {
    let material = match (building, room.kind) {
        (_, RoomKind::Toilet) => Material::Tile,
        (Use::Home, RoomKind::Room) if room.area_m2 <= BATH_M2 && room.doors == 1 => Material::Tile,
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
    /// The scenario with the floors that are usual in the rooms of such a building, where neither the look nor the preset
    /// says what the floor is. Areas that the look has lie over them.
    pub fn with_floors(mut self, life: Option<&Life>, walls: &Walls) -> Scenario {
        let is_open =
            self.routes.life.floors && self.preset != Preset::Paper && self.look.floor == FloorLook::default();
        let Some(life) = life.filter(|_| is_open) else { return self };
        let floor =
            |room: &Room| RoomFloor { inside_m: room.inside_m, area_m2: room.area_m2, floor: usual(life.r#use, room) };
        self.look.lay_floors(&life.rooms.rooms.iter().map(floor).collect::<Vec<_>>(), walls);
        self
    }
}
