//! Which floor lies in which room, where a scenario leaves that open.

use super::model::Scenario;
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
    /// Gives rooms the floors that are usual in such a building, where the look does not name the floor. Areas that the
    /// look has lie over them.
    pub(super) fn lay_usual_floors(&mut self, life: &Life, walls: &Walls) {
        if !self.routes.life.floors || self.look.floor != FloorLook::default() {
            return;
        }
        let floor = |kind| usual(life.r#use, kind);
        let rooms: Vec<_> =
            life.rooms.rooms.iter().map(|room| (room.inside_m, room.area_m2, floor(room.kind))).collect();
        self.look.lay_floors(&rooms, walls);
    }
}
