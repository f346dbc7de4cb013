//! What a plan shows at a pixel, and how it is painted.

/// What a plan shows at a pixel.
///
/// The colours are those of the painted plan, which people edit in any paint program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
#[repr(u8)]
pub enum PlanClass {
    /// Around the building, or inside walls.
    Outside,
    /// Floor that people walk on.
    #[default]
    Floor,
    /// Wall or column up to the ceiling.
    Wall,
    /// Window: closed for people.
    Window,
    /// Door: floor between two jambs; its leaf and arc are drawn but are not there.
    Door,
    /// Stairs: floor.
    Stairs,
    /// Chair, sofa, bench, bed: 0.45 m high.
    Seat,
    /// Table or desk: 0.75 m high.
    Table,
    /// Counter, gate or low cupboard: 1.0 m high.
    Counter,
    /// Shelf or wardrobe up to the ceiling.
    Shelf,
    /// WC, basin, bath, cooker: 0.85 m high.
    Fixture,
    /// Letters and numbers; floor or paper lies below.
    Lettering,
    /// Dimension lines, axes, arrows, hatches of floors; floor or paper lies below.
    Dimension,
    /// Frame and title block of the sheet.
    Frame,
}

impl PlanClass {
    /// All classes, in the order of their numbers.
    pub const ALL: [PlanClass; 14] = [
        PlanClass::Outside,
        PlanClass::Floor,
        PlanClass::Wall,
        PlanClass::Window,
        PlanClass::Door,
        PlanClass::Stairs,
        PlanClass::Seat,
        PlanClass::Table,
        PlanClass::Counter,
        PlanClass::Shelf,
        PlanClass::Fixture,
        PlanClass::Lettering,
        PlanClass::Dimension,
        PlanClass::Frame,
    ];

    /// Height above the floor of what people walk round, metres; `None` up to the ceiling, and for what they walk on.
    ///
    /// Seats 0.45 m, tables 0.75 m, counters 1.0 m: usual heights of furniture.
    pub fn height_m(self) -> Option<f64> {
        match self {
            PlanClass::Seat => Some(0.45),
            PlanClass::Table => Some(0.75),
            PlanClass::Counter => Some(1.0),
            PlanClass::Fixture => Some(0.85),
            _ => None,
        }
    }

    /// Whether it stands in the way of people.
    pub fn is_solid(self) -> bool {
        use PlanClass::{Counter, Fixture, Seat, Shelf, Table, Wall, Window};
        matches!(self, Wall | Window | Seat | Table | Counter | Shelf | Fixture)
    }

    /// Whether it is furniture or a fixture, which stands on the floor of a room.
    pub fn is_furniture(self) -> bool {
        use PlanClass::{Counter, Fixture, Seat, Shelf, Table};
        matches!(self, Seat | Table | Counter | Shelf | Fixture)
    }

    /// Its colour in the painted plan, sRGB.
    pub fn colour(self) -> [u8; 3] {
        match self {
            PlanClass::Outside => [190, 190, 190],
            PlanClass::Floor => [255, 255, 255],
            PlanClass::Wall => [0, 0, 0],
            PlanClass::Window => [0, 160, 255],
            PlanClass::Door => [0, 200, 0],
            PlanClass::Stairs => [255, 230, 120],
            PlanClass::Seat => [255, 170, 120],
            PlanClass::Table => [220, 110, 30],
            PlanClass::Counter => [150, 70, 10],
            PlanClass::Shelf => [90, 40, 0],
            PlanClass::Fixture => [150, 110, 220],
            PlanClass::Lettering => [255, 0, 140],
            PlanClass::Dimension => [255, 140, 200],
            PlanClass::Frame => [130, 130, 80],
        }
    }
}
