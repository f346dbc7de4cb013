//! Paints: the colours in which a plan is put right, and what they say beside classes.

use super::PlanClass;
use crate::math::Vec2;

/// A paint: a class, or an order beyond the classes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paint {
    /// The plan shows this here.
    Class(PlanClass),
    /// Floor where people come and go.
    Entrance,
    /// Floor on which feet leave no dirt.
    KeepClean,
    /// What stands here is gone; below lies what lies around.
    Erase,
}

impl Paint {
    /// All paints: the classes in their order, then the others.
    pub fn all() -> impl Iterator<Item = Paint> {
        PlanClass::ALL.into_iter().map(Paint::Class).chain([Paint::Entrance, Paint::KeepClean, Paint::Erase])
    }

    /// Its colour, sRGB.
    pub fn colour(self) -> [u8; 3] {
        match self {
            Paint::Class(class) => class.colour(),
            Paint::Entrance => [255, 0, 0],
            Paint::KeepClean => [0, 255, 255],
            Paint::Erase => [255, 255, 0],
        }
    }

    /// Its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Paint::Class(class) => match class {
                PlanClass::Outside => "outside",
                PlanClass::Floor => "floor",
                PlanClass::Wall => "wall",
                PlanClass::Window => "window",
                PlanClass::Door => "door",
                PlanClass::Stairs => "stairs",
                PlanClass::Seat => "seat",
                PlanClass::Table => "table",
                PlanClass::Counter => "counter",
                PlanClass::Shelf => "shelf",
                PlanClass::Fixture => "fixture",
                PlanClass::Lettering => "lettering",
                PlanClass::Dimension => "dimension",
                PlanClass::Frame => "frame",
            },
            Paint::Entrance => "entrance",
            Paint::KeepClean => "keep clean",
            Paint::Erase => "erase",
        }
    }

    /// What it does, in a few words.
    pub fn meaning(self) -> &'static str {
        match self {
            Paint::Class(class) => match class {
                PlanClass::Outside => "around the building, or inside walls: nobody walks there",
                PlanClass::Floor => "people walk on it",
                PlanClass::Wall => "wall or column, up to the ceiling",
                PlanClass::Window => "closed for people, and no entrance",
                PlanClass::Door => "floor between two jambs",
                PlanClass::Stairs => "stairs: floor",
                PlanClass::Seat => "chair, sofa, bench, bed: 0.45 m high",
                PlanClass::Table => "table or desk: 0.75 m high",
                PlanClass::Counter => "counter, gate, low cupboard: 1.0 m high",
                PlanClass::Shelf => "shelf or wardrobe, up to the ceiling",
                PlanClass::Fixture => "WC, basin, bath, cooker: 0.85 m high",
                PlanClass::Lettering => "letters and numbers: floor or paper lies below",
                PlanClass::Dimension => "dimension lines, axes, arrows: floor or paper lies below",
                PlanClass::Frame => "frame and title block of the sheet",
            },
            Paint::Entrance => "people come and go here",
            Paint::KeepClean => "people walk here, but their feet leave no dirt",
            Paint::Erase => "what stands here is gone: floor or outside, as around it",
        }
    }
}

/// What paint adds to a plan beside classes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Painted {
    /// Places where people come and go, in the order of their first pixels.
    pub entrances: Vec<PaintedEntrance>,
    /// A byte per pixel in image order: 1 in entrances, 2 where feet leave no dirt, else 0; empty if 0 everywhere.
    pub marks: Vec<u8>,
}

/// Values of [`Painted::marks`].
pub(super) const IN_ENTRANCE: u8 = 1;
pub(super) const KEPT_CLEAN: u8 = 2;

/// A place in the plan where people come and go.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct PaintedEntrance {
    /// `entrance`, or `entrance 1`, `entrance 2`, ... where there are several.
    pub name: String,
    /// The rectangle around it, `[min, max]`, metres.
    pub area_m: [Vec2; 2],
}
