//! Texels at all scales, in blocks that are made when they are needed.

use std::collections::BTreeSet;

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::texels::{SIDE, Texel, TexelBlock, TexelSource};
use crate::export::reduction::rounded_mean;

/// Coarsest level: 2^LEVELS texels a side are one.
const LEVELS: u32 = 12;
/// Most places at which a stretched footprint is looked up.
const MOST_PROBES: f32 = 12.0;

/// A block's place: level, layer, column, row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct TexelBlockKey {
    level: u8,
    layer: u32,
    x: i32,
    y: i32,
}

/// Blocks by their place. Their order is never looked at.
type Blocks = FxHashMap<TexelBlockKey, TexelBlock>;

/// A mipmap pyramid that holds only the blocks in view, each at the level at which it is seen.
///
/// Its own halving, beside [`export::reduction`](crate::export::reduction): blocks are made one by one on demand, and blocks of
/// one colour stay a single texel. The mean is the same.
pub(super) struct Pyramid<'a> {
    source: &'a dyn TexelSource,
    blocks: Blocks,
}

/// Footprint of a pixel on a texture: an ellipse, sampled as a row of discs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Footprint {
    pub layer: u32,
    /// Middle, metres.
    pub middle: [f32; 2],
    /// From the middle to the end of the longer axis, metres.
    pub axis: [f32; 2],
    /// Width across, metres.
    pub width: f32,
}

/// A footprint in texels.
struct Probes {
    level: u32,
    /// Share of the next coarser level.
    coarser: f32,
    count: u32,
    first: [f32; 2],
    step: [f32; 2],
    /// Texels are much larger than pixels.
    enlarged: bool,
}

impl<'a> Pyramid<'a> {
    pub fn new(source: &'a dyn TexelSource) -> Pyramid<'a> {
        Pyramid { source, blocks: Blocks::default() }
    }

    /// Texels per metre.
    pub fn density(&self) -> f64 {
        self.source.density()
    }

    /// Names the blocks that a footprint needs.
    pub fn needs(&self, footprint: &Footprint, bias: f32, needed: &mut NeededBlocks) {
        let probes = self.probes(footprint, bias);
        let last = probes.count.saturating_sub(1) as f32;
        for level in probes.level..=(probes.level + 1).min(LEVELS) {
            let scale = 1.0 / (1u32 << level) as f32;
            for at in [0.0, last] {
                let [x, y] = [0, 1].map(|k| (probes.first[k] + probes.step[k] * at) * scale);
                for [dx, dy] in [[-1.5, -1.5], [1.5, -1.5], [-1.5, 1.5], [1.5, 1.5]] {
                    needed.add(TexelBlockKey {
                        level: level as u8,
                        layer: footprint.layer,
                        x: block_of(x + dx),
                        y: block_of(y + dy),
                    });
                }
            }
        }
    }

    /// Makes the needed blocks and drops all others. Fine blocks first: coarser ones are made of them.
    pub fn hold(&mut self, needed: &BTreeSet<TexelBlockKey>) {
        let mut from = needed.iter().copied().peekable();
        let mut fresh = Blocks::default();
        while let Some(level) = from.peek().map(|key| key.level) {
            let mut wanted = Vec::new();
            while let Some(key) = from.next_if(|key| key.level == level) {
                wanted.push(key);
            }
            let made: Vec<(TexelBlockKey, TexelBlock)> = wanted
                .par_iter()
                .filter(|key| !self.blocks.contains_key(key))
                .map(|&key| (key, self.make(key, &fresh, &mut Blocks::default())))
                .collect();
            for key in &wanted {
                if let Some(block) = self.blocks.remove(key) {
                    fresh.insert(*key, block);
                }
            }
            fresh.extend(made);
        }
        self.blocks = fresh;
    }

    /// Makes a block. Of blocks beyond a layer's ends, which are all alike, `made` remembers those that it was made of:
    /// otherwise a coarse block of a short wall would be made of thousands.
    fn make(&self, key: TexelBlockKey, fresh: &Blocks, made: &mut Blocks) -> TexelBlock {
        if key.level == 0 {
            return self.source.read(
                key.layer as usize,
                i64::from(key.x) * SIDE as i64,
                i64::from(key.y) * SIDE as i64,
            );
        }
        let mut child = |dx: i32, dy: i32| {
            let key = TexelBlockKey { level: key.level - 1, x: key.x * 2 + dx, y: key.y * 2 + dy, ..key };
            if let Some(block) = fresh.get(&key).or_else(|| self.blocks.get(&key)) {
                return block.clone();
            }
            let Some(alike) = self.alike(key) else { return self.make(key, fresh, made) };
            if let Some(block) = made.get(&alike) {
                return block.clone();
            }
            let block = self.make(alike, fresh, made);
            made.insert(alike, block.clone());
            block
        };
        halved(&[child(0, 0), child(1, 0), child(0, 1), child(1, 1)])
    }

    /// The block nearest to a layer that shows the same as one beyond its ends (the block itself if it is not);
    /// `None` where each block may differ.
    fn alike(&self, key: TexelBlockKey) -> Option<TexelBlockKey> {
        let size = self.source.size(key.layer as usize)?;
        let side = (SIDE as i64) << key.level;
        let [x, y] = [0, 1].map(|axis| {
            let first_beyond = (size[axis].max(0) + side - 1) / side;
            i64::from([key.x, key.y][axis]).clamp(-2, first_beyond) as i32
        });
        Some(TexelBlockKey { x, y, ..key })
    }

    fn probes(&self, footprint: &Footprint, bias: f32) -> Probes {
        let density = self.density() as f32;
        let [ax, ay] = footprint.axis.map(|c| c * density);
        let half = (ax * ax + ay * ay).sqrt();
        // At least the width of a pixel across, and no longer than the probes reach.
        let width = (footprint.width * density * bias).max(2.0 * half / MOST_PROBES).max(1e-4);
        let count = (2.0 * half / width).ceil().clamp(1.0, MOST_PROBES);
        let (level, coarser) = level_of(width);
        let step = [2.0 * ax / count, 2.0 * ay / count];
        let [x, y] = footprint.middle.map(|c| c * density);
        let back = 0.5 * (count - 1.0);
        Probes {
            level,
            coarser,
            count: count as u32,
            first: [x - step[0] * back, y - step[1] * back],
            step,
            enlarged: width < 0.7,
        }
    }

    /// The mean over a footprint, each value 0 to 1.
    pub fn sample(&self, footprint: &Footprint, bias: f32) -> [f32; 4] {
        let probes = self.probes(footprint, bias);
        let mut sum = [0.0f32; 4];
        let mut reader = Reader { pyramid: self, layer: footprint.layer, last: None };
        for k in 0..probes.count {
            let at = [0, 1].map(|c| probes.first[c] + probes.step[c] * k as f32);
            let texel = if probes.enlarged {
                reader.cubic(at)
            } else if probes.coarser <= 0.0 {
                reader.linear(probes.level, at)
            } else {
                let (fine, coarse) = (reader.linear(probes.level, at), reader.linear(probes.level + 1, at));
                std::array::from_fn(|c| fine[c] + (coarse[c] - fine[c]) * probes.coarser)
            };
            (0..4).for_each(|c| sum[c] += texel[c]);
        }
        let scale = 1.0 / (probes.count as f32 * 65_535.0);
        sum.map(|c| c * scale)
    }
}

/// The level whose texels are at most as wide, and the share of the next one. The logarithm is taken as straight
/// between powers of two, which is even smoother.
fn level_of(width: f32) -> (u32, f32) {
    if width <= 1.0 {
        return (0, 0.0);
    }
    let level = (width.to_bits() >> 23) - 127;
    if level >= LEVELS {
        return (LEVELS, 0.0);
    }
    (level, width / (1u32 << level) as f32 - 1.0)
}

fn block_of(texel: f32) -> i32 {
    down(texel).div_euclid(SIDE as i32)
}

/// Rounded down; faster than by the machine's library.
#[inline]
fn down(value: f32) -> i32 {
    let whole = value as i32;
    whole - i32::from(value < whole as f32)
}

/// Four blocks as one of the next level.
fn halved(children: &[TexelBlock; 4]) -> TexelBlock {
    if let [TexelBlock::Flat(a), TexelBlock::Flat(b), TexelBlock::Flat(c), TexelBlock::Flat(d)] = children
        && a == b
        && b == c
        && c == d
    {
        return TexelBlock::Flat(*a);
    }
    const HALF: usize = SIDE / 2;
    let mean = |sum: u32| rounded_mean(sum, 4) as u16;
    let texel = |k: usize| -> Texel {
        let (x, y) = (k % SIDE, k / SIDE);
        match &children[y / HALF * 2 + x / HALF] {
            TexelBlock::Flat(texel) => *texel,
            TexelBlock::Full(texels) => {
                let at = (y % HALF * 2) * SIDE + x % HALF * 2;
                let mut sum = [0u32; 4];
                for texel in [&texels[at], &texels[at + 1], &texels[at + SIDE], &texels[at + SIDE + 1]] {
                    sum.iter_mut().zip(texel).for_each(|(sum, value)| *sum += u32::from(*value));
                }
                let [red, green, blue, rough] = sum;
                [mean(red), mean(green), mean(blue), mean(rough)]
            }
        }
    };
    TexelBlock::Full((0..SIDE * SIDE).map(texel).collect())
}

/// Reads texels; knows the block that it read last.
struct Reader<'a> {
    pyramid: &'a Pyramid<'a>,
    layer: u32,
    last: Option<(TexelBlockKey, &'a TexelBlock)>,
}

impl<'a> Reader<'a> {
    fn block(&mut self, level: u32, x: i32, y: i32) -> Option<&'a TexelBlock> {
        let key = TexelBlockKey { level: level as u8, layer: self.layer, x, y };
        if let Some((last, block)) = self.last
            && last == key
        {
            return Some(block);
        }
        let block = self.pyramid.blocks.get(&key)?;
        self.last = Some((key, block));
        Some(block)
    }

    fn texel(&mut self, level: u32, i: i32, j: i32) -> Texel {
        let (mut i, mut j) = (i, j);
        for level in level..=LEVELS {
            const S: i32 = SIDE as i32;
            match self.block(level, i.div_euclid(S), j.div_euclid(S)) {
                Some(TexelBlock::Flat(texel)) => return *texel,
                Some(TexelBlock::Full(texels)) => return texels[(j.rem_euclid(S) * S + i.rem_euclid(S)) as usize],
                // A few pixels at edges read blocks that no neighbour asked for: a coarser block will do.
                None => (i, j) = (i.div_euclid(2), j.div_euclid(2)),
            }
        }
        [32_768, 32_768, 32_768, 32_768]
    }

    /// Straight between the four texels around a place in texels of level 0.
    fn linear(&mut self, level: u32, at: [f32; 2]) -> [f32; 4] {
        let scale = 1.0 / (1u32 << level) as f32;
        let [x, y] = at.map(|c| c * scale - 0.5);
        let (i, j) = (down(x), down(y));
        let (u, v) = (x - i as f32, y - j as f32);
        let [[a, b], [c, d]] = self.square(level, i, j);
        let [of_a, of_b, of_c, of_d] = [(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v];
        let mut sum = [0.0; 4];
        for (n, sum) in sum.iter_mut().enumerate() {
            *sum = f32::from(a[n]) * of_a + f32::from(b[n]) * of_b + f32::from(c[n]) * of_c + f32::from(d[n]) * of_d;
        }
        sum
    }

    /// `N` x `N` texels from a lower left one up, row by row.
    fn square<const N: usize>(&mut self, level: u32, i: i32, j: i32) -> [[Texel; N]; N] {
        const S: i32 = SIDE as i32;
        let (within_i, within_j) = (i.rem_euclid(S), j.rem_euclid(S));
        if within_i <= S - N as i32 && within_j <= S - N as i32 {
            match self.block(level, i.div_euclid(S), j.div_euclid(S)) {
                Some(TexelBlock::Flat(texel)) => return [[*texel; N]; N],
                Some(TexelBlock::Full(texels)) => {
                    let first = (within_j * S + within_i) as usize;
                    return std::array::from_fn(|row| std::array::from_fn(|k| texels[first + row * SIDE + k]));
                }
                None => {}
            }
        }
        std::array::from_fn(|row| std::array::from_fn(|k| self.texel(level, i + k as i32, j + row as i32)))
    }

    /// Smooth between the sixteen texels around a place: Mitchell and Netravali's filter with B = C = 1/3 (Computer
    /// Graphics 22(4), 1988).
    fn cubic(&mut self, at: [f32; 2]) -> [f32; 4] {
        let [x, y] = at.map(|c| c - 0.5);
        let (i, j) = (down(x), down(y));
        let (across, up) = (cubic_weights(x - i as f32), cubic_weights(y - j as f32));
        let mut sum = [0.0f32; 4];
        for (row, weight_y) in self.square::<4>(0, i - 1, j - 1).into_iter().zip(up) {
            for (texel, weight_x) in row.into_iter().zip(across) {
                for (sum, texel) in sum.iter_mut().zip(texel) {
                    *sum += f32::from(texel) * weight_x * weight_y;
                }
            }
        }
        sum.map(|c| c.clamp(0.0, 65_535.0))
    }
}

fn cubic_weights(t: f32) -> [f32; 4] {
    let near = |t: f32| (7.0 * t * t * t - 12.0 * t * t + 16.0 / 3.0) / 6.0;
    let far = |t: f32| (-7.0 / 3.0 * t * t * t + 12.0 * t * t - 20.0 * t + 32.0 / 3.0) / 6.0;
    [far(1.0 + t), near(t), near(1.0 - t), far(2.0 - t)]
}

/// Blocks that were asked for.
#[derive(Debug, Default)]
pub(super) struct NeededBlocks {
    keys: BTreeSet<TexelBlockKey>,
    /// The last few, which most are again.
    last: [Option<TexelBlockKey>; 8],
    next: usize,
}

impl NeededBlocks {
    fn add(&mut self, key: TexelBlockKey) {
        if !self.last.contains(&Some(key)) {
            self.last[self.next % 8] = Some(key);
            self.next += 1;
            self.keys.insert(key);
        }
    }

    /// All of both.
    pub fn and(mut self, mut other: NeededBlocks) -> NeededBlocks {
        self.keys.append(&mut other.keys);
        self
    }

    pub fn keys(&self) -> &BTreeSet<TexelBlockKey> {
        &self.keys
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A board of squares of one texel, black and white; noise on the right half.
    struct Board;

    impl TexelSource for Board {
        fn density(&self) -> f64 {
            100.0
        }

        fn read(&self, _: usize, i0: i64, j0: i64) -> TexelBlock {
            let value = |k: usize| if (i0 + j0 + (k % SIDE + k / SIDE) as i64) % 2 == 0 { 65_535 } else { 0 };
            TexelBlock::Full((0..SIDE * SIDE).map(|k| [value(k); 4]).collect())
        }
    }

    fn sampled(footprint: &Footprint) -> [f32; 4] {
        let mut pyramid = Pyramid::new(&Board);
        let mut needed = NeededBlocks::default();
        pyramid.needs(footprint, 1.0, &mut needed);
        pyramid.hold(needed.keys());
        pyramid.sample(footprint, 1.0)
    }

    #[test]
    fn a_wide_footprint_sees_the_mean_wherever_it_lies() {
        for k in 0..40 {
            let at = k as f32 * 0.1855;
            for width in [0.02, 0.05, 0.31] {
                let footprint = Footprint { layer: 0, middle: [at, 3.0 * at], axis: [0.0, width], width };
                let [value, ..] = sampled(&footprint);
                assert!((value - 0.5).abs() < 0.003, "{value} at {at}, {width} wide");
            }
        }
    }

    #[test]
    fn a_narrow_footprint_sees_single_texels() {
        let at = |i: f32, j: f32| {
            let footprint = Footprint { layer: 0, middle: [i / 100.0, j / 100.0], axis: [0.0; 2], width: 0.01 };
            sampled(&footprint)[0]
        };
        assert!(at(4.5, 6.5) > 0.999 && at(5.5, 6.5) < 0.001);
        assert!((at(5.0, 6.5) - 0.5).abs() < 1e-3);
    }

    #[test]
    fn cubic_weights_sum_to_one() {
        for k in 0..=20 {
            let weights = cubic_weights(k as f32 / 20.0);
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-5, "{weights:?}");
        }
    }

    #[test]
    fn a_coarse_block_is_the_same_whether_finer_ones_are_held_or_not() {
        let key = |level, x, y| TexelBlockKey { level, layer: 0, x, y };
        let (mut with, mut without) = (Pyramid::new(&Board), Pyramid::new(&Board));
        with.hold(&[key(0, 0, 0), key(0, 1, 1), key(1, 0, 0), key(2, 0, 0)].into());
        without.hold(&[key(2, 0, 0)].into());
        let texels = |pyramid: &Pyramid| match &pyramid.blocks[&key(2, 0, 0)] {
            TexelBlock::Full(texels) => texels.to_vec(),
            TexelBlock::Flat(texel) => vec![*texel],
        };
        assert_eq!(texels(&with), texels(&without));
        assert_eq!(with.blocks.len(), 4);
    }

    /// A wall of some texels that goes on as it ends, with nothing far below it, and counts how often it is read.
    struct Short(std::sync::atomic::AtomicUsize, bool);

    impl TexelSource for Short {
        fn density(&self) -> f64 {
            100.0
        }

        fn read(&self, _: usize, i0: i64, j0: i64) -> TexelBlock {
            self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            if j0 < -(SIDE as i64) {
                return TexelBlock::Flat([5; 4]);
            }
            let value = |i: i64, j: i64| (i.clamp(0, 299) * 97 + j.clamp(0, 39) * 31) as u16;
            TexelBlock::Full(
                (0..SIDE * SIDE).map(|k| [value(i0 + (k % SIDE) as i64, j0 + (k / SIDE) as i64); 4]).collect(),
            )
        }

        fn size(&self, _: usize) -> Option<[i64; 2]> {
            self.1.then_some([300, 40])
        }
    }

    #[test]
    fn a_short_wall_seen_from_afar_is_read_a_few_times_and_looks_the_same() {
        let keys: BTreeSet<TexelBlockKey> = [[-1, -1], [0, -1], [-1, 0], [0, 0], [3, 2]]
            .into_iter()
            .flat_map(|[x, y]| [4, 5].map(|level| TexelBlockKey { level, layer: 0, x, y }))
            .collect();
        let [quick, plain] = [true, false].map(|knows_size| Short(Default::default(), knows_size));
        let [(quick_blocks, quick_reads), (plain_blocks, plain_reads)] = [&quick, &plain].map(|wall| {
            let mut pyramid = Pyramid::new(wall);
            pyramid.hold(&keys);
            let texels = |block: &TexelBlock| match block {
                TexelBlock::Full(texels) => texels.to_vec(),
                TexelBlock::Flat(texel) => vec![*texel; SIDE * SIDE],
            };
            let blocks: Vec<Vec<Texel>> = keys.iter().map(|key| texels(&pyramid.blocks[key])).collect();
            (blocks, wall.0.load(std::sync::atomic::Ordering::Relaxed))
        });
        assert!(quick_blocks == plain_blocks);
        assert!(quick_reads < 100 && plain_reads > 1000, "{quick_reads} of {plain_reads} reads");
    }
}
