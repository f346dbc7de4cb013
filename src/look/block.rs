use std::ops::Range;

use crate::math::srgb::to_linear;

/// Texel values of a clean surface: beyond a floor and its padding, or the mean of the clean wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Background {
    /// The clean surface's mean colour, sRGB.
    pub base_color: [u8; 3],
    /// Packed masks: all 0.
    pub mask: [u8; 4],
    /// Unoccluded, as rough as the clean surface, no metal.
    pub orm: [u8; 3],
}

/// A resolved rectangle of texels, row-major; row 0 is the southernmost, on a wall the lowest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResolvedBlock {
    /// True without surface and padding: all [`Background`], and all vectors are empty.
    pub empty: bool,
    /// 8-bit sRGB, dithered.
    pub base_color: Vec<[u8; 3]>,
    /// Colour of the surface under the dirt: linear light, 0 to 65 535. Empty where a source does not know it.
    pub clean: Vec<[u16; 3]>,
    /// 1 - exp(-D), linear, dithered. Floor: film, passes (D = per_pass n), fresh prints and scuffs, edge and dust. Wall:
    /// skin, rub (cloth and bags), scuffs, splash and dust.
    pub mask: Vec<[u8; 4]>,
    /// Occlusion, roughness, metallic; linear, roughness dithered.
    pub orm: Vec<[u8; 3]>,
    /// Linear float layers: those of [`super::LAYERS`] or [`super::WALL_LAYERS`].
    pub layers: Vec<Layer>,
}

/// One float channel of a block.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// One of [`super::LAYERS`] or [`super::WALL_LAYERS`].
    pub name: &'static str,
    /// A value per texel.
    pub values: Vec<f32>,
}

impl Layer {
    /// Kinds of dirt that [`Layer::kind`] tells apart.
    pub const KINDS: usize = 4;

    /// The kind of dirt whose optical density a layer holds; `None` for counts of passes.
    ///
    /// On floors film, prints, scuffs, edge and dust; on walls hands, cloth and bags, shoes, splash and dust.
    pub fn kind(&self) -> Option<usize> {
        match self.name {
            "film" | "hand" => Some(0),
            "soil" | "arm" | "shoulder" | "bag" => Some(1),
            "scuff" | "shoe" => Some(2),
            "edge" | "splash" | "dust" => Some(3),
            _ => None,
        }
    }
}

impl ResolvedBlock {
    /// Makes room for so many texels with these layers.
    pub(super) fn resize(&mut self, texels: usize, layers: &[&'static str]) {
        self.empty = false;
        self.base_color.resize(texels, [0; 3]);
        self.clean.resize(texels, [0; 3]);
        self.mask.resize(texels, [0; 4]);
        self.orm.resize(texels, [0; 3]);
        if !self.layers.iter().map(|layer| layer.name).eq(layers.iter().copied()) {
            self.layers = layers.iter().map(|&name| Layer { name, values: Vec::new() }).collect();
        }
        for layer in &mut self.layers {
            layer.values.resize(texels, 0.0);
        }
    }

    /// Keeps the memory for the next block.
    pub(super) fn become_empty(&mut self) {
        self.empty = true;
        self.base_color.clear();
        self.clean.clear();
        self.mask.clear();
        self.orm.clear();
        for layer in &mut self.layers {
            layer.values.clear();
        }
    }

    /// Copies texels `from..from + len` of another block with the same layers.
    pub(super) fn copy(&mut self, to: usize, other: &ResolvedBlock, from: usize, len: usize) {
        self.base_color[to..to + len].copy_from_slice(&other.base_color[from..from + len]);
        self.clean[to..to + len].copy_from_slice(&other.clean[from..from + len]);
        self.mask[to..to + len].copy_from_slice(&other.mask[from..from + len]);
        self.orm[to..to + len].copy_from_slice(&other.orm[from..from + len]);
        for (layer, other) in self.layers.iter_mut().zip(&other.layers) {
            layer.values[to..to + len].copy_from_slice(&other.values[from..from + len]);
        }
    }

    /// Sets the colour under the dirt of texels from `start` on; `rgb` is linear light from 0 to 1, a plane per channel.
    pub(super) fn set_clean(&mut self, start: usize, rgb: &[Vec<f32>; 3]) {
        let [red, green, blue] = rgb;
        let level = |light: f32| (65_535.0 * light.clamp(0.0, 1.0) + 0.5) as u16;
        for (((clean, &r), &g), &b) in self.clean[start..].iter_mut().zip(red).zip(green).zip(blue) {
            *clean = [level(r), level(g), level(b)];
        }
    }

    /// Shows the background at some texels.
    pub(super) fn clear(&mut self, texels: Range<usize>, background: Background) {
        self.base_color[texels.clone()].fill(background.base_color);
        self.clean[texels.clone()].fill(background.base_color.map(to_linear));
        self.mask[texels.clone()].fill(background.mask);
        self.orm[texels.clone()].fill(background.orm);
        for layer in &mut self.layers {
            layer.values[texels.clone()].fill(0.0);
        }
    }
}
