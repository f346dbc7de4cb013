use crate::export::Reduced;
use crate::look::{Background, Look};
use crate::math::Vec2;
use crate::math::srgb::{Srgb8, from_linear, light_of};
use crate::show::scene::Scene;
use crate::walls::Walls;

/// The content of a page.
#[derive(Clone, Debug)]
pub struct Page<'a> {
    /// The page's title: the plan's name.
    pub title: &'a str,
    /// The triangles.
    pub scene: &'a Scene,
    /// The walls: for the small map, for light and shade, and to stop the reader at walls.
    pub walls: &'a Walls,
    /// Height of the ceiling, metres.
    pub wall_height_m: f64,
    /// Textures of the floor tiles.
    pub floor: PageSurface<'a>,
    /// Textures of the wall sheets.
    pub wall: PageSurface<'a>,
    /// The viewpoint at the start.
    pub start: Viewpoint,
    /// Limits of the images.
    pub options: PageOptions,
}

/// A viewer's place and direction of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// Place of the feet in the plan frame, metres.
    pub at_m: Vec2,
    /// Direction of sight, radians counter-clockwise from +x.
    pub heading_rad: f64,
    /// Upward is positive, radians.
    pub pitch_rad: f64,
}

/// Limits of the images that a page carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PageOptions {
    /// Longest side of an image, pixels; at least 256. Graphics cards limit it.
    pub largest_px: u32,
    /// Most bytes of all images together: they are halved until they fit.
    pub image_bytes: usize,
}

impl Default for PageOptions {
    fn default() -> PageOptions {
        PageOptions { largest_px: 4096, image_bytes: 14 << 20 }
    }
}

/// The textures of floor tiles or wall sheets, clean and dirty.
#[derive(Clone, Debug)]
pub struct PageSurface<'a> {
    /// The images, by the number that [`SceneSurface`](crate::show::scene::SceneSurface) gives.
    pub images: &'a [Reduced],
    /// Mean colour without dirt, sRGB.
    pub clean: Srgb8,
    /// Roughness without dirt, 0 to 1.
    pub roughness: f32,
    /// The kinds of dirt on it, in the order of [`Layer::kind`](crate::look::Layer::kind).
    pub dirt: Vec<DirtKind>,
}

/// A kind of dirt that the page shows or leaves out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DirtKind {
    /// Label of its switch.
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
