use std::ops::Range;

/// What texels show that nothing lies on: beyond a floor and its padding, or the clean wall's mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Background {
    /// The clean surface's mean colour, sRGB.
    pub base_color: [u8; 3],
    /// Nothing.
    pub mask: [u8; 4],
    /// Unoccluded, as rough as the clean surface, no metal.
    pub orm: [u8; 3],
}

/// A resolved rectangle of a floor or a wall, row-major; row 0 is the southernmost, on a wall the lowest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResolvedBlock {
    /// Whether there is neither surface nor padding: all [`Background`], and all vectors are empty.
    pub empty: bool,
    /// 8-bit sRGB, dithered.
    pub base_color: Vec<[u8; 3]>,
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

impl ResolvedBlock {
    /// Makes room for so many texels with these layers.
    pub(super) fn resize(&mut self, texels: usize, layers: &[&'static str]) {
        self.empty = false;
        self.base_color.resize(texels, [0; 3]);
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
        self.mask.clear();
        self.orm.clear();
        for layer in &mut self.layers {
            layer.values.clear();
        }
    }

    /// Copies texels `from..from + len` of another block with the same layers.
    pub(super) fn copy(&mut self, to: usize, other: &ResolvedBlock, from: usize, len: usize) {
        self.base_color[to..to + len].copy_from_slice(&other.base_color[from..from + len]);
        self.mask[to..to + len].copy_from_slice(&other.mask[from..from + len]);
        self.orm[to..to + len].copy_from_slice(&other.orm[from..from + len]);
        for (layer, other) in self.layers.iter_mut().zip(&other.layers) {
            layer.values[to..to + len].copy_from_slice(&other.values[from..from + len]);
        }
    }

    /// Shows the background at some texels.
    pub(super) fn clear(&mut self, texels: Range<usize>, background: Background) {
        self.base_color[texels.clone()].fill(background.base_color);
        self.mask[texels.clone()].fill(background.mask);
        self.orm[texels.clone()].fill(background.orm);
        for layer in &mut self.layers {
            layer.values[texels.clone()].fill(0.0);
        }
    }
}
