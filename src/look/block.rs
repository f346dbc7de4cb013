use std::ops::Range;

use crate::math::srgb::to_linear;

/// Names of a floor block's float layers, in order.
///
/// `passes` and `presence` count the simulated people's footfalls, `dwell` the seconds that they stood, `grind` the passes
/// of wear that turns and stops add, `wheels` their wheels; the rest are optical densities. `film` has the lines of wheels.
pub const LAYERS: [&str; 10] =
    ["passes", "presence", "dwell", "grind", "wheels", "film", "soil", "scuff", "edge", "dust"];

/// Relief of a flat, unworn surface.
pub(crate) const FLAT: [u8; 6] = [0, 0, 128, 128, 128, 255];

/// Passes, wear and height of such a surface with 16 bits.
pub(crate) const FLAT_FINELY: [u16; 3] = [0, 0, 1 << 15];

/// Texel values of a clean surface: those beyond a floor's padding, or the mean of a clean wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Background {
    /// Mean colour of the clean surface, sRGB.
    pub base_color: [u8; 3],
    /// Packed masks: all 0.
    pub mask: [u8; 4],
    /// Occlusion 1, roughness of the clean surface, metallic 0.
    pub orm: [u8; 3],
}

/// A resolved rectangle of texels, row-major; row 0 is the southernmost, on a wall the lowest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResolvedBlock {
    /// True without surface and padding: all texels are [`Background`], and all vectors are empty.
    pub empty: bool,
    /// Base colour, 8-bit sRGB, dithered.
    pub base_color: Vec<[u8; 3]>,
    /// Colour of the surface without dirt, linear, 0 to 65 535. Empty if the source does not have it.
    pub clean: Vec<[u16; 3]>,
    /// Opacity of dirt 1 - exp(-D), linear, dithered. Floor: film, passes (a logarithm, full at 10 000), fresh prints,
    /// edge and dust. Wall: skin, rub (cloth and bags), scuffs, splash and dust.
    pub mask: Vec<[u8; 4]>,
    /// Occlusion, roughness, metallic; linear, roughness dithered.
    pub orm: Vec<[u8; 3]>,
    /// Wear, opacity of heel marks 1 - exp(-D), height (128 is the mean surface, 25 a millimetre), all of floors only; and
    /// the surface's normal, 0 to 255 for -1 to 1, along the texture's right, its upper side, and outward.
    pub relief: Vec<[u8; 6]>,
    /// Passes, wear and height of floors as in `mask` and `relief`, 0 to 65 535 and without dither; empty unless
    /// [`FloorResolver::finely`](super::FloorResolver::finely) asks for them.
    pub fine: Vec<[u16; 3]>,
    /// Linear float layers, named in [`super::LAYERS`] or `super::WALL_LAYERS`.
    pub layers: Vec<Layer>,
}

/// One float channel of a block.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Name: one of [`super::LAYERS`] or `super::WALL_LAYERS`.
    pub name: &'static str,
    /// One value per texel.
    pub values: Vec<f32>,
}

impl Layer {
    /// Number of kinds of dirt, see [`Layer::kind`].
    pub const KINDS: usize = 4;

    /// Kind of dirt whose optical density the layer holds; `None` for counts of passes.
    ///
    /// Floors: film, prints, scuffs, edge and dust. Walls: hands, cloth and bags, shoes, splash and dust.
    pub fn kind(&self) -> Option<usize> {
        match self.name {
            "film" | "hand" => Some(0),
            "soil" | "arm" | "shoulder" | "bag" => Some(1),
            "scuff" | "shoe" => Some(2),
            "edge" | "splash" | "dust" | "chip" => Some(3),
            _ => None,
        }
    }
}

impl ResolvedBlock {
    /// Resizes to a number of texels, with these layers.
    pub(super) fn resize(&mut self, texels: usize, layers: &[&'static str]) {
        self.empty = false;
        self.base_color.resize(texels, [0; 3]);
        self.clean.resize(texels, [0; 3]);
        self.mask.resize(texels, [0; 4]);
        self.orm.resize(texels, [0; 3]);
        self.relief.resize(texels, FLAT);
        self.fine.clear();
        if !self.layers.iter().map(|layer| layer.name).eq(layers.iter().copied()) {
            self.layers = layers.iter().map(|&name| Layer { name, values: Vec::new() }).collect();
        }
        for layer in &mut self.layers {
            layer.values.resize(texels, 0.0);
        }
    }

    /// Empties the block; its memory is reused for the next one.
    pub(super) fn become_empty(&mut self) {
        self.empty = true;
        self.base_color.clear();
        self.clean.clear();
        self.mask.clear();
        self.orm.clear();
        self.relief.clear();
        self.fine.clear();
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
        self.relief[to..to + len].copy_from_slice(&other.relief[from..from + len]);
        if !self.fine.is_empty() && !other.fine.is_empty() {
            self.fine[to..to + len].copy_from_slice(&other.fine[from..from + len]);
        }
        for (layer, other) in self.layers.iter_mut().zip(&other.layers) {
            layer.values[to..to + len].copy_from_slice(&other.values[from..from + len]);
        }
    }

    /// Sets the colour without dirt of texels from `start` on. `rgb` is linear, 0 to 1, a plane per channel.
    pub(super) fn set_clean(&mut self, start: usize, rgb: &[Vec<f32>; 3]) {
        let [red, green, blue] = rgb;
        let level = |light: f32| (65_535.0 * light.clamp(0.0, 1.0) + 0.5) as u16;
        for (((clean, &r), &g), &b) in self.clean[start..].iter_mut().zip(red).zip(green).zip(blue) {
            *clean = [level(r), level(g), level(b)];
        }
    }

    /// Sets the normal of texel `k` from its slope along the texture's right and its upper side.
    #[inline]
    pub(super) fn set_normal(&mut self, k: usize, [x, y]: [f32; 2]) {
        let length = (x * x + y * y + 1.0).sqrt();
        // Rounds: all of it is positive.
        let byte = |part: f32| (127.5 + 127.5 * part / length + 0.5) as u8;
        let [_, _, _, right, up, out] = &mut self.relief[k];
        (*right, *up, *out) = (byte(-x), byte(-y), byte(1.0));
    }

    /// Sets texels to the background.
    pub(super) fn clear(&mut self, texels: Range<usize>, background: Background) {
        self.base_color[texels.clone()].fill(background.base_color);
        self.clean[texels.clone()].fill(background.base_color.map(to_linear));
        self.mask[texels.clone()].fill(background.mask);
        self.orm[texels.clone()].fill(background.orm);
        self.relief[texels.clone()].fill(FLAT);
        if !self.fine.is_empty() {
            self.fine[texels.clone()].fill(FLAT_FINELY);
        }
        for layer in &mut self.layers {
            layer.values[texels.clone()].fill(0.0);
        }
    }
}
