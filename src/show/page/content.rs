use crate::export::{Camera, Reduced};
use crate::look::{Background, Layer, Look};
use crate::math::srgb::{Srgb8, from_linear, light_of};
use crate::show::Rooms;
use crate::show::scene::Scene;
use crate::walls::Walls;

/// The content of a page.
#[derive(Clone, Debug)]
pub struct Page<'a> {
    /// The page's title: the plan's name.
    pub title: &'a str,
    /// The triangles.
    pub scene: &'a Scene,
    /// The walls: for the small map, for reflections, and to stop the reader at walls.
    pub walls: &'a Walls,
    /// The rooms between them, with their lamps and light.
    pub rooms: &'a Rooms,
    /// Height of the ceiling, metres.
    pub wall_height_m: f64,
    /// Textures of the floor tiles.
    pub floor: PageSurface<'a>,
    /// Textures of the wall sheets.
    pub wall: PageSurface<'a>,
    /// The first view of who walks; its height is that of the eyes.
    pub start: Camera,
    /// The first view from above.
    pub above: Camera,
    /// Limits of the images.
    pub options: PageOptions,
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
        let dirt = [
            ("Trodden film", look.film.colour),
            ("Shoe prints", look.prints.colour),
            ("Heel marks", look.scuffs.colour),
            ("Edges and dust", edge),
        ];
        PageSurface::of(images, background, dirt)
    }

    /// Walls in the colours of `look`. `background` is the clean wall as its resolver gives it.
    pub fn wall(images: &'a [Reduced], look: &Look, background: Background) -> PageSurface<'a> {
        let wall = &look.wall;
        let dirt = [
            ("Hands", wall.skin.colour),
            ("Clothes and bags", mixed(wall.cloth.colour, wall.bag.colour, 0.5)),
            ("Shoe scuffs", wall.rubber.colour),
            ("Splashes and dust", wall.splash.colour),
        ];
        PageSurface::of(images, background, dirt)
    }

    fn of(images: &'a [Reduced], clean: Background, dirt: [(&'static str, Srgb8); Layer::KINDS]) -> PageSurface<'a> {
        PageSurface {
            images,
            clean: clean.base_color,
            roughness: f32::from(clean.orm[1]) / 255.0,
            dirt: dirt.map(|(name, colour)| DirtKind { name, colour }).to_vec(),
        }
    }
}

/// The light of two colours mixed, `share` of the second.
fn mixed(a: Srgb8, b: Srgb8, share: f32) -> Srgb8 {
    let (a, b) = (light_of(a), light_of(b));
    std::array::from_fn(|n| from_linear((65_535.0 * (a[n] + share * (b[n] - a[n]))).round() as u16))
}
