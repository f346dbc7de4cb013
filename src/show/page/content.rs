use crate::export::Reduced;
use crate::look::{Background, Look};
use crate::math::Vec2;
use crate::math::srgb::{Srgb8, from_linear, light_of};
use crate::show::scene::Scene;
use crate::walls::Walls;

/// What a page shows.
#[derive(Clone, Debug)]
pub struct Page<'a> {
    /// What the plan is called: the page's title.
    pub title: &'a str,
    /// The triangles.
    pub scene: &'a Scene,
    /// The plan: for the small map, for light and shade, and so that nobody walks through walls.
    pub walls: &'a Walls,
    /// Height of the ceiling, metres.
    pub wall_height_m: f64,
    /// What floor tiles show.
    pub floor: PageSurface<'a>,
    /// What wall sheets show.
    pub wall: PageSurface<'a>,
    /// Where a reader stands at first.
    pub start: Viewpoint,
    /// How much the page may carry.
    pub options: PageOptions,
}

/// Where somebody stands and looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// Feet, in the plan frame.
    pub at_m: Vec2,
    /// Direction of sight, radians counter-clockwise from +x.
    pub heading_rad: f64,
    /// Upward is positive, radians.
    pub pitch_rad: f64,
}

/// How much a page may carry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PageOptions {
    /// Longest side of an image, pixels: what graphics cards take. At least 256.
    pub largest_px: u32,
    /// Images are halved until all together take at most so many bytes before they are written as text.
    pub image_bytes: usize,
}

impl Default for PageOptions {
    fn default() -> PageOptions {
        PageOptions { largest_px: 4096, image_bytes: 14 << 20 }
    }
}

/// How tiles or sheets look, clean and dirty.
#[derive(Clone, Debug)]
pub struct PageSurface<'a> {
    /// The images, by the number that [`SceneSurface`](super::scene::SceneSurface) gives.
    pub images: &'a [Reduced],
    /// Colour without dirt, on average.
    pub clean: Srgb8,
    /// Roughness without dirt, 0 to 1.
    pub roughness: f32,
    /// The kinds of dirt on it, in the order of [`Layer::kind`](crate::look::Layer::kind).
    pub dirt: Vec<DirtKind>,
}

/// A kind of dirt that the page can show or leave out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DirtKind {
    /// What its switch says.
    pub name: &'static str,
    /// Colour, sRGB.
    pub colour: Srgb8,
}

impl<'a> PageSurface<'a> {
    /// A floor in the colours of `look`. `background` is the clean floor as its resolver gives it.
    pub fn floor(images: &'a [Reduced], look: &Look, background: Background) -> PageSurface<'a> {
        // Edge and dust are one kind and nearly of one colour.
        let edge = mixed(look.edge.colour, look.dust.colour, 0.4);
        PageSurface {
            images,
            clean: background.base_color,
            roughness: f32::from(background.orm[1]) / 255.0,
            dirt: vec![
                DirtKind { name: "Trodden film", colour: look.film.colour },
                DirtKind { name: "Shoe prints", colour: look.prints.colour },
                DirtKind { name: "Heel marks", colour: look.scuffs.colour },
                DirtKind { name: "Edges and dust", colour: edge },
            ],
        }
    }

    /// Walls in the colours of `look`. `background` is the clean wall as its resolver gives it.
    pub fn wall(images: &'a [Reduced], look: &Look, background: Background) -> PageSurface<'a> {
        let wall = &look.wall;
        PageSurface {
            images,
            clean: background.base_color,
            roughness: f32::from(background.orm[1]) / 255.0,
            dirt: vec![
                DirtKind { name: "Hands", colour: wall.skin.colour },
                DirtKind { name: "Clothes and bags", colour: mixed(wall.cloth.colour, wall.bag.colour, 0.5) },
                DirtKind { name: "Shoe scuffs", colour: wall.rubber.colour },
                DirtKind { name: "Splashes and dust", colour: wall.splash.colour },
            ],
        }
    }
}

/// The light of two colours mixed, `share` of the second.
fn mixed(a: Srgb8, b: Srgb8, share: f32) -> Srgb8 {
    let (a, b) = (light_of(a), light_of(b));
    std::array::from_fn(|n| from_linear((65_535.0 * (a[n] + share * (b[n] - a[n]))).round() as u16))
}
