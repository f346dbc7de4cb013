//! Texel sources of surfaces.

use image::{GrayImage, RgbImage};

use crate::export::{Strip, TextureSource, WallSource, WallTextures};
use crate::look::{Background, ResolvedBlock};
use crate::math::srgb::to_linear;

/// Red, green, blue as linear light and roughness, each 0 to 65 535.
pub(super) type Texel = [u16; 4];

/// Side of a block, texels.
pub(super) const SIDE: usize = 128;

/// A square of texels.
#[derive(Clone, Debug)]
pub(super) enum TexelBlock {
    /// All the same.
    Flat(Texel),
    /// Row by row, row 0 lowest.
    Full(Box<[Texel]>),
}

/// A surface's texels, as squares of [`SIDE`]: pure, so that any thread may ask for any of them in any order.
pub(super) trait TexelSource: Sync {
    /// Texels per metre.
    fn density(&self) -> f64;

    /// The block whose lower-left texel is `(i0, j0)`. `layer` is a wall's face, 0 for the floor.
    fn read(&self, layer: usize, i0: i64, j0: i64) -> TexelBlock;

    /// Columns and rows of a layer: of the blocks beyond them, and of those more than a block below column and row 0, one
    /// may stand for all. `None` where each block may differ.
    fn size(&self, _layer: usize) -> Option<[i64; 2]> {
        None
    }
}

/// A floor at its own texel density.
pub(super) struct FloorTexels<'a, S> {
    pub source: &'a S,
    pub texels_per_metre: f64,
}

impl<S: TextureSource> TexelSource for FloorTexels<'_, S> {
    fn density(&self) -> f64 {
        self.texels_per_metre
    }

    fn read(&self, _: usize, i0: i64, j0: i64) -> TexelBlock {
        let block = self.source.resolve(i0, j0, SIDE, SIDE);
        if block.empty {
            let background = self.source.background();
            return TexelBlock::Flat(texel(background.base_color, background.orm));
        }
        of_resolved(&block)
    }
}

fn of_resolved(block: &ResolvedBlock) -> TexelBlock {
    TexelBlock::Full(block.base_color.iter().zip(&block.orm).map(|(&colour, &orm)| texel(colour, orm)).collect())
}

fn texel(colour: [u8; 3], orm: [u8; 3]) -> Texel {
    let [red, green, blue] = colour;
    [to_linear(red), to_linear(green), to_linear(blue), u16::from(orm[1]) * 257]
}

/// A floor that was made small: row 0 of the picture is the upper one.
pub(super) struct SmallFloor {
    pub picture: RgbImage,
    /// Its roughness, pixel by pixel.
    pub roughness: GrayImage,
    pub pixels_per_metre: f64,
}

impl TexelSource for SmallFloor {
    fn density(&self) -> f64 {
        self.pixels_per_metre
    }

    fn read(&self, _: usize, i0: i64, j0: i64) -> TexelBlock {
        let (width, height) = (i64::from(self.picture.width()), i64::from(self.picture.height()));
        let pixel = |k: usize| {
            let x = (i0 + (k % SIDE) as i64).clamp(0, width - 1);
            let y = height - 1 - (j0 + (k / SIDE) as i64).clamp(0, height - 1);
            let [rough] = self.roughness.get_pixel(x as u32, y as u32).0;
            texel(self.picture.get_pixel(x as u32, y as u32).0, [255, rough, 0])
        };
        TexelBlock::Full((0..SIDE * SIDE).map(pixel).collect())
    }
}

/// Walls at their own texel density; layers are faces.
pub(super) struct WallTexels<'a> {
    pub source: &'a dyn WallSource,
    pub texels_per_metre: f64,
    pub height_m: f64,
}

impl TexelSource for WallTexels<'_> {
    fn density(&self) -> f64 {
        self.texels_per_metre
    }

    fn read(&self, layer: usize, i0: i64, j0: i64) -> TexelBlock {
        let background = self.source.background();
        // Texels above the ceiling and below the floor are never seen.
        let rows = (self.rows() - j0).clamp(0, SIDE as i64) as usize;
        if rows == 0 || j0 + (SIDE as i64) < -2 {
            return TexelBlock::Flat(texel(background.base_color, background.orm));
        }
        let mut block = ResolvedBlock::default();
        self.source.resolve_into(layer, i0, j0, SIDE, rows, &mut block);
        if block.empty {
            return TexelBlock::Flat(texel(background.base_color, background.orm));
        }
        // Above the ceiling the last row goes on.
        let last = (rows - 1) * SIDE;
        (rows..SIDE).for_each(|_| {
            block.base_color.extend_from_within(last..last + SIDE);
            block.orm.extend_from_within(last..last + SIDE);
        });
        of_resolved(&block)
    }

    /// A closed face goes round, but beyond its end nothing is seen itself.
    fn size(&self, layer: usize) -> Option<[i64; 2]> {
        Some([i64::from(self.source.columns(layer)?), self.rows()])
    }
}

impl WallTexels<'_> {
    /// Rows from which on nothing is seen any more.
    fn rows(&self) -> i64 {
        (self.height_m * self.texels_per_metre).ceil() as i64 + 2
    }
}

/// Walls that were made small on their sheets.
pub(super) struct SmallWalls<'a> {
    textures: &'a WallTextures,
    /// By face: sheet and strip, in the order along the face.
    strips: Vec<Vec<(usize, &'a Strip)>>,
    factor: f64,
    background: Texel,
}

impl<'a> SmallWalls<'a> {
    /// `None` without reduced images.
    pub fn of(textures: &'a WallTextures, background: Background) -> Option<SmallWalls<'a>> {
        let factor = textures.reduced.iter().map(|reduced| reduced.factor).max()?;
        let faces = textures.atlas.strips().map(|(_, strip)| strip.face + 1).max().unwrap_or(0);
        let mut strips = vec![Vec::new(); faces];
        for (sheet, strip) in textures.atlas.strips() {
            strips[strip.face].push((sheet, strip));
        }
        strips.iter_mut().for_each(|strips| strips.sort_by(|a, b| a.1.from_m.total_cmp(&b.1.from_m)));
        let background = texel(background.base_color, background.orm);
        Some(SmallWalls { textures, strips, factor: f64::from(factor), background })
    }

    /// The column of a wall at a place along it: its sheet, and the texture coordinates of its foot and of its top.
    fn column(&self, layer: usize, along_m: f64) -> Option<(usize, [[f64; 2]; 2])> {
        let strips = self.strips.get(layer)?;
        let next = strips.partition_point(|(_, strip)| strip.from_m <= along_m);
        let &(sheet, strip) = strips.get(next.saturating_sub(1))?;
        let atlas = &self.textures.atlas;
        let along_m = along_m.clamp(strip.from_m, strip.to_m);
        Some((sheet, [0.0, atlas.height_m].map(|height_m| atlas.uv(sheet, strip, along_m, height_m))))
    }

    /// Number of rows, with two spare ones for filters.
    fn rows(&self) -> i64 {
        (self.textures.atlas.height_m * self.density()).ceil() as i64 + 2
    }

    fn pixel(&self, sheet: usize, [u, v]: [f64; 2]) -> Texel {
        let Some(small) = self.textures.reduced.get(sheet) else { return self.background };
        let pixel = |share: f64, size: u32| ((share * f64::from(size)).max(0.0) as u32).min(size - 1);
        let (x, y) = (pixel(u, small.base_color.width()), pixel(v, small.base_color.height()));
        texel(small.base_color.get_pixel(x, y).0, small.orm.get_pixel(x, y).0)
    }
}

impl TexelSource for SmallWalls<'_> {
    fn density(&self) -> f64 {
        self.textures.atlas.texels_per_metre / self.factor
    }

    fn read(&self, layer: usize, i0: i64, j0: i64) -> TexelBlock {
        let metre = |texel: i64| (texel as f64 + 0.5) / self.density();
        if j0 >= self.rows() {
            return TexelBlock::Flat(self.background);
        }
        // Along a column texture coordinates are linear; beyond its ends it goes on as it ends.
        let shares: [f64; SIDE] =
            std::array::from_fn(|j| (metre(j0 + j as i64) / self.textures.atlas.height_m).clamp(0.0, 1.0));
        let mut texels = vec![self.background; SIDE * SIDE];
        let mut last = None;
        for i in 0..SIDE {
            let column = self.column(layer, metre(i0 + i as i64));
            let Some((sheet, [foot, top])) = column else { continue };
            if i > 0 && column == last {
                (0..SIDE).for_each(|j| texels[j * SIDE + i] = texels[j * SIDE + i - 1]);
                continue;
            }
            last = column;
            for j in 0..SIDE {
                let along = |k: usize| foot[k] + (top[k] - foot[k]) * shares[j];
                texels[j * SIDE + i] = match j.checked_sub(1) {
                    Some(below) if shares[below] == shares[j] => texels[below * SIDE + i],
                    _ => self.pixel(sheet, [along(0), along(1)]),
                };
            }
        }
        TexelBlock::Full(texels.into_boxed_slice())
    }

    fn size(&self, layer: usize) -> Option<[i64; 2]> {
        let to_m = self.strips.get(layer)?.last()?.1.to_m;
        Some([(to_m * self.density()).ceil() as i64 + 1, self.rows()])
    }
}

/// Walls of one colour.
pub(super) struct PlainWalls {
    pub density: f64,
    pub texel: Texel,
}

impl PlainWalls {
    /// Walls in the colour of the background.
    pub fn of(background: Background, density: f64) -> PlainWalls {
        PlainWalls { density, texel: texel(background.base_color, background.orm) }
    }
}

impl TexelSource for PlainWalls {
    fn density(&self) -> f64 {
        self.density
    }

    fn read(&self, _: usize, _: i64, _: i64) -> TexelBlock {
        TexelBlock::Flat(self.texel)
    }
}
