use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::{Colour, FloorPlan, PlanClass};
use crate::math::{Vec2, vec2};
use crate::options::{Field, Kind, Leaf, OptionError, Options, Table, Value, names, options};

/// A point as a scenario writes it: `[x, y]` in metres, or `{ px = [x, y] }` in pixels from the image's top left.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum PlanPoint {
    /// Plan frame: metres from the lower-left corner, y up.
    Metres([f64; 2]),
    /// Pixels from the top left, y down.
    Pixels {
        /// `[x, y]`.
        px: [f64; 2],
    },
}

impl PlanPoint {
    /// The point in the plan frame.
    pub fn to_m(&self, plan: &FloorPlan) -> Vec2 {
        match *self {
            PlanPoint::Metres([x, y]) => vec2(x, y),
            PlanPoint::Pixels { px } => plan.px_to_m(px),
        }
    }
}

impl PlanPoint {
    const PIXELS: Table = Table { name: "Pixels", parts: &[&[Field::plain("px", <[f64; 2]>::kind, true)]] };
}

impl Leaf for PlanPoint {
    fn takes() -> Kind {
        let words = "[x, y] in metres or { px = [x, y] } in pixels";
        Kind::AnyOf(words, vec![<[f64; 2]>::kind(), Kind::Table(PlanPoint::PIXELS)])
    }
}

/// Where a door is, as a scenario writes it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "a point [x, y], or two of them: [[x0, y0], [x1, y1]]")]
pub enum DoorAt {
    /// Its middle.
    Point(PlanPoint),
    /// Its two jambs.
    Line([PlanPoint; 2]),
}

impl DoorAt {
    /// Its points as written: the middle, or the jambs.
    pub fn points(&self) -> &[PlanPoint] {
        match self {
            DoorAt::Point(point) => std::slice::from_ref(point),
            DoorAt::Line(ends) => ends,
        }
    }
}

impl Leaf for DoorAt {
    fn takes() -> Kind {
        let line = Kind::List(Box::new(PlanPoint::kind()), Some(2));
        Kind::AnyOf("a point [x, y], or two of them: [[x0, y0], [x1, y1]]", vec![PlanPoint::kind(), line])
    }
}

/// A door that is opened where the plan draws it closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoorToOpen {
    /// Where it is.
    pub at: DoorAt,
    /// Clear width of a door given by its middle, metres.
    pub width_m: f64,
}

impl Leaf for Colour {
    fn takes() -> Kind {
        Kind::AnyOf("a colour as \"#c03030\"", vec![Kind::Text])
    }
}

names!(TransparentPolicy, UnknownPolicy);

options! {
    /// A known distance in the image, from which the scale follows.
    #[derive(Copy)]
    pub struct TwoPoints {
        /// One end; in pixels, because metres are not known yet.
        from: PixelPoint = PixelPoint::default(), eg "{ px = [120, 40] }", required true;
        /// The other end.
        to: PixelPoint = PixelPoint::default(), eg "{ px = [480, 40] }", required true;
        /// Distance between them.
        metres: f64 = 0.0, unit "m", required true;
    }
}

options! {
    /// A place in the image: `{ px = [x, y] }`, pixels from the top left, y down.
    #[derive(Copy)]
    pub struct PixelPoint {
        /// `[x, y]`.
        px: [f64; 2] = [0.0; 2], required true;
    }
}

options! {
    /// Names of a drawing's layers, classes or blocks, by what is drawn there: in any case, `*` at the end for all that
    /// begin so.
    pub struct PlanLayers {
        /// Walls and columns.
        wall: Vec<String> = Vec::new();
        /// Windows.
        window: Vec<String> = Vec::new();
        /// Doors, with leaf and swing.
        door: Vec<String> = Vec::new();
        /// Stairs.
        stairs: Vec<String> = Vec::new();
        /// Chairs, sofas, benches, beds.
        seat: Vec<String> = Vec::new();
        /// Tables and desks.
        table: Vec<String> = Vec::new();
        /// Counters, gates and low cupboards.
        counter: Vec<String> = Vec::new();
        /// Shelves and wardrobes up to the ceiling.
        shelf: Vec<String> = Vec::new();
        /// WCs, basins, baths, cookers.
        fixture: Vec<String> = Vec::new();
        /// What is left out of the plan.
        leave_out: Vec<String> = Vec::new();
    }
}

impl PlanLayers {
    /// What a scenario says of a layer, if it says anything.
    pub(super) fn class_of(&self, name: &str) -> Option<PlanClass> {
        use PlanClass::{Counter, Dimension, Door, Fixture, Seat, Shelf, Stairs, Table, Wall, Window};
        let name = name.trim().to_lowercase();
        let is_meant = |said: &String| match said.trim().to_lowercase().strip_suffix('*') {
            Some(start) => name.starts_with(start),
            None => name == said.trim().to_lowercase(),
        };
        let all = [
            (&self.wall, Wall),
            (&self.window, Window),
            (&self.door, Door),
            (&self.stairs, Stairs),
            (&self.seat, Seat),
            (&self.table, Table),
            (&self.counter, Counter),
            (&self.shelf, Shelf),
            (&self.fixture, Fixture),
            (&self.leave_out, Dimension),
        ];
        all.into_iter().find(|(names, _)| names.iter().any(is_meant)).map(|(_, class)| class)
    }
}

/// Meaning of transparent pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TransparentPolicy {
    /// White paper below an image; unknown in a ROS map, as its format defines.
    #[default]
    Auto,
    /// The image is laid on white paper.
    Paper,
    /// Pixels that are not opaque are wall.
    Wall,
    /// Pixels that are not opaque are floor.
    Floor,
}

/// Meaning of a ROS map's unknown pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum UnknownPolicy {
    /// Unknown is wall: the robot has not been there.
    #[default]
    Wall,
    /// Unknown is floor.
    Floor,
}

options! {
    /// Options of reading a plan.
    pub struct PlanOptions {
        /// Side of a pixel.
        metres_per_pixel: Option<f64> = None, in 0.0005..=10.0, unit "m", eg "0.05";
        /// Or two points and how far apart they are.
        scale: Option<TwoPoints> = None, eg "{ from = { px = [120, 40] }, to = { px = [480, 40] }, metres = 36.0 }";
        /// Or how wide the building is, from its westernmost to its easternmost wall as drawn.
        ///
        /// The sheet's margin, frame and dimension lines do not count.
        width_m: Option<f64> = None, in 0.5..=4000.0, unit "m", eg "30.0";
        /// Lightness at which wall ends and floor begins; without it, found.
        threshold: Option<u8> = None, in 1.0..=255.0, eg "128";
        /// Whether walls are light on a dark ground; without it, found.
        invert: Option<bool> = None, eg "true";
        /// Saturated colours that are wall, as "#c03030"; all others are notes on the floor.
        ///
        /// Colours (`"#c03030"`) that are wall although saturated colour is annotation otherwise.
        wall_colours: Vec<Colour> = Vec::new();
        /// A ROS map's unknown pixels: "wall" or "floor".
        unknown: UnknownPolicy = UnknownPolicy::default();
        /// Transparent pixels: "auto", "paper", "wall" or "floor".
        transparent: TransparentPolicy = TransparentPolicy::default();
        /// Smaller specks are dropped as noise.
        speck_m: f64 = 0.15, in 0.0..=10.0, unit "m";
        /// Whether lettering, dashed lines and the outlines of coloured dots are dropped.
        drop_annotation: bool = true;
        /// Points in the floor, [x, y] in metres or { px = [x, y] }; empty: found.
        floor: Vec<PlanPoint> = Vec::new();
        /// Width of the narrowest person: nobody goes where they cannot pass.
        narrowest_m: f64 = 0.4, in 0.1..=2.0, unit "m";
        /// Two corners, [x, y] in metres or { px = [x, y] }: the image is cut before it is read; all other points count from the cut image.
        crop: Option<[PlanPoint; 2]> = None, eg "[{ px = [40, 30] }, { px = [900, 640] }]";
        /// The plan in class colours, painted over; transparent pixels stay as read; relative to this file.
        paint: Option<PathBuf> = None, eg "\"over.png\"";
        /// Page of a PDF, level of an Open-RMF building, storey of a building model; left out: the first.
        page: Option<u32> = None, in 1.0..=10000.0, eg "2";
        /// What the layers of a drawing hold whose names say nothing known.
        layers: Option<PlanLayers> = None, eg "{ wall = [\"X-12\"], door = [\"L7*\"] }";
    }
    with {
        /// Doors that are opened where the plan draws them closed.
        doors: Vec<DoorToOpen> = Vec::new();
        /// Whether a plan without floor or walls is no error: it is read to be put right.
        unfinished: bool = false;
    }
}

impl PlanOptions {
    /// Checks all ranges.
    pub(super) fn check(&self) -> Result<(), OptionError> {
        self.check_ranges().map_err(|error| error.within("plan"))
    }
}
