use super::atlas::{Sheet, Strip};
use crate::look::{
    Background, FLAT, FloorResolver, LAYERS, Layer, ResolvedBlock, StainLook, WALL_LAYERS, WallResolver,
};
use crate::math::srgb::to_linear;

/// The texels of a floor or a sheet.
///
/// Implementations are pure functions: any thread may resolve any rectangle, in any order.
pub trait TextureSource: Sync {
    /// Names of the layers of each block, in order.
    fn layers(&self) -> &[&'static str];

    /// Values of all texels of an empty block.
    fn background(&self) -> Background;

    /// Resolves a rectangle of `width` x `height` texels with the lower-left texel (i0, j0).
    ///
    /// The rectangle may reach beyond the edges of the floor or the sheet.
    fn resolve(&self, i0: i64, j0: i64, width: usize, height: usize) -> ResolvedBlock;
}

/// The texels of walls, face by face. Implementations are pure functions, as for [`TextureSource`].
pub trait WallSource: Sync {
    /// Names of the layers of each block, in order.
    fn layers(&self) -> &[&'static str];

    /// Values of all texels of an empty block.
    fn background(&self) -> Background;

    /// Texels along a face; `None` where nobody knows.
    fn columns(&self, _face: usize) -> Option<u32> {
        None
    }

    /// Stains of hands and of shoes on door leaves beside the walls, if there are any.
    fn leaf_stains(&self) -> Option<[StainLook; 2]> {
        None
    }

    /// Resolves a rectangle of `width` x `height` texels of a face with the lower-left texel (i0, j0) into `block`,
    /// row 0 lowest, columns along the face. Beyond the face's ends, below and above the wall, the edge's texels go on;
    /// on a closed face columns wrap.
    fn resolve_into(&self, face: usize, i0: i64, j0: i64, width: usize, height: usize, block: &mut ResolvedBlock);
}

impl TextureSource for FloorResolver<'_> {
    fn layers(&self) -> &[&'static str] {
        &LAYERS
    }

    fn background(&self) -> Background {
        FloorResolver::background(self)
    }

    fn resolve(&self, i0: i64, j0: i64, width: usize, height: usize) -> ResolvedBlock {
        FloorResolver::resolve(self, i0, j0, width, height)
    }
}

impl WallSource for WallResolver<'_> {
    fn layers(&self) -> &[&'static str] {
        &WALL_LAYERS
    }

    fn background(&self) -> Background {
        WallResolver::background(self)
    }

    fn columns(&self, face: usize) -> Option<u32> {
        WallResolver::columns(self, face)
    }

    fn leaf_stains(&self) -> Option<[StainLook; 2]> {
        Some(WallResolver::leaf_stains(self))
    }

    fn resolve_into(&self, face: usize, i0: i64, j0: i64, width: usize, height: usize, block: &mut ResolvedBlock) {
        WallResolver::resolve_into(self, face, i0, j0, width, height, block);
    }
}

/// A sheet of walls, composed of its strips. Padding repeats the texels of a strip's edges.
#[derive(Debug)]
pub struct SheetSource<'a, S> {
    walls: &'a S,
    sheet: &'a Sheet,
    padding_px: u32,
}

impl<'a, S: WallSource> SheetSource<'a, S> {
    /// Creates the source of one sheet with `padding_px` texels of padding around each strip.
    pub fn new(walls: &'a S, sheet: &'a Sheet, padding_px: u32) -> SheetSource<'a, S> {
        SheetSource { walls, sheet, padding_px }
    }
}

impl<S: WallSource> TextureSource for SheetSource<'_, S> {
    fn layers(&self) -> &[&'static str] {
        self.walls.layers()
    }

    fn background(&self) -> Background {
        self.walls.background()
    }

    fn resolve(&self, i0: i64, j0: i64, width: usize, height: usize) -> ResolvedBlock {
        let whole = Rect { i0, j0, width, height };
        let mut block = ResolvedBlock { empty: true, ..ResolvedBlock::default() };
        let mut part = ResolvedBlock::default();
        for strip in &self.sheet.strips {
            let Some(seen) = padded(strip, self.padding_px).common(&whole) else { continue };
            let of_face = on_face(strip, &seen);
            self.walls.resolve_into(strip.face, of_face.i0, of_face.j0, of_face.width, of_face.height, &mut part);
            if part.empty {
                continue;
            }
            if strip.turned {
                turn(&mut part, of_face.width);
            }
            if seen == whole {
                return part;
            }
            if block.empty {
                block = blank(width * height, self.walls.background(), self.walls.layers());
            }
            paste(&part, &seen, &mut block, &whole);
        }
        block
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Rect {
    i0: i64,
    j0: i64,
    width: usize,
    height: usize,
}

impl Rect {
    fn common(&self, other: &Rect) -> Option<Rect> {
        let (i0, j0) = (self.i0.max(other.i0), self.j0.max(other.j0));
        let i1 = (self.i0 + self.width as i64).min(other.i0 + other.width as i64);
        let j1 = (self.j0 + self.height as i64).min(other.j0 + other.height as i64);
        (i0 < i1 && j0 < j1).then(|| Rect { i0, j0, width: (i1 - i0) as usize, height: (j1 - j0) as usize })
    }
}

/// Returns a strip's rectangle in the sheet, with its padding.
fn padded(strip: &Strip, padding_px: u32) -> Rect {
    let padding = i64::from(padding_px);
    let [width, height] = strip.size().map(|side| (side + 2 * padding_px) as usize);
    Rect { i0: i64::from(strip.x) - padding, j0: i64::from(strip.y) - padding, width, height }
}

/// Maps a rectangle of the sheet to columns and rows of the face.
fn on_face(strip: &Strip, seen: &Rect) -> Rect {
    let (right, up) = (seen.i0 - i64::from(strip.x), seen.j0 - i64::from(strip.y));
    let first = i64::from(strip.i0);
    if strip.turned {
        // Height grows to the left.
        let low = i64::from(strip.height) - right - seen.width as i64;
        Rect { i0: first + up, j0: low, width: seen.height, height: seen.width }
    } else {
        Rect { i0: first + right, j0: up, width: seen.width, height: seen.height }
    }
}

/// Turns a block of `width` columns by a quarter counter-clockwise.
fn turn(block: &mut ResolvedBlock, width: usize) {
    fn turned<T: Copy>(texels: &mut Vec<T>, width: usize) {
        let height = texels.len() / width;
        // Each new row is an old column, from its top.
        *texels = (0..width).flat_map(|i| (0..height).rev().map(move |j| j * width + i)).map(|k| texels[k]).collect();
    }
    turned(&mut block.base_color, width);
    turned(&mut block.clean, width);
    turned(&mut block.mask, width);
    turned(&mut block.orm, width);
    turned(&mut block.relief, width);
    // What pointed right points up, and what pointed up points left.
    for [_, _, _, x, y, _] in &mut block.relief {
        (*x, *y) = ((256 - u16::from(*y)).min(255) as u8, *x);
    }
    for layer in &mut block.layers {
        turned(&mut layer.values, width);
    }
}

fn blank(texels: usize, background: Background, layers: &[&'static str]) -> ResolvedBlock {
    ResolvedBlock {
        empty: false,
        base_color: vec![background.base_color; texels],
        clean: vec![background.base_color.map(to_linear); texels],
        mask: vec![background.mask; texels],
        orm: vec![background.orm; texels],
        relief: vec![FLAT; texels],
        fine: Vec::new(),
        layers: layers.iter().map(|&name| Layer { name, values: vec![0.0; texels] }).collect(),
    }
}

/// Copies `part`, the rectangle `seen`, into `block`, the rectangle `whole`.
fn paste(part: &ResolvedBlock, seen: &Rect, block: &mut ResolvedBlock, whole: &Rect) {
    let (left, low) = ((seen.i0 - whole.i0) as usize, (seen.j0 - whole.j0) as usize);
    for row in 0..seen.height {
        let from = row * seen.width..(row + 1) * seen.width;
        let at = (low + row) * whole.width + left;
        let to = at..at + seen.width;
        block.base_color[to.clone()].copy_from_slice(&part.base_color[from.clone()]);
        if !part.clean.is_empty() {
            block.clean[to.clone()].copy_from_slice(&part.clean[from.clone()]);
        }
        block.mask[to.clone()].copy_from_slice(&part.mask[from.clone()]);
        block.orm[to.clone()].copy_from_slice(&part.orm[from.clone()]);
        if !part.relief.is_empty() {
            block.relief[to.clone()].copy_from_slice(&part.relief[from.clone()]);
        }
        for (layer, part) in block.layers.iter_mut().zip(&part.layers) {
            layer.values[to.clone()].copy_from_slice(&part.values[from.clone()]);
        }
    }
}
