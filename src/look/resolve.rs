use std::cell::RefCell;

use super::block::{Background, ResolvedBlock};
use super::coarse::{CoarseFloor, CoarseShare};
use super::error::LookError;
use super::ground::Ground;
use super::lattice::Window;
use super::material::Properties;
use super::noise::{self, Channel, Noise};
use super::padding::{PADDING, sources};
use super::paint::paint;
use super::settings::{Look, NoiseLook, Octave};
use super::shade::Law;
use super::skirting::Skirting;
use super::tone;
use crate::sums::FloorSums;
use crate::walls::Walls;

/// Names of a block's float layers, in their order.
///
/// `passes` and `presence` count the simulated people's footfalls; the rest are optical densities.
pub const LAYERS: [&str; 7] = ["passes", "presence", "film", "soil", "scuff", "edge", "dust"];

/// Resolves any rectangle of a floor. Shared by threads; every texel's value depends on its place alone.
pub struct FloorResolver<'a> {
    pub(super) sums: &'a FloorSums,
    pub(super) walls: &'a Walls,
    pub(super) look: Look,
    pub(super) properties: Properties,
    pub(super) ground: Ground,
    pub(super) skirting: Skirting<'a>,
    /// Unevenness of film and dust.
    pub(super) noise: Vec<Noise>,
    pub(super) spread_m: f64,
    pub(super) law: Law,
    pub(super) dither: u32,
    background: Background,
    coarse: CoarseFloor,
}

impl<'a> FloorResolver<'a> {
    /// Prepares to resolve `sums` of `simulated_people`.
    ///
    /// # Errors
    /// Settings out of range, a floor image that cannot be read, sums of nobody.
    pub fn new(
        sums: &'a FloorSums,
        walls: &'a Walls,
        look: &Look,
        simulated_people: u32,
    ) -> Result<FloorResolver<'a>, LookError> {
        look.check()?;
        if simulated_people == 0 {
            return Err(LookError::Nobody { total_passes: look.total_passes });
        }
        let grid = sums.grid();
        let mut properties = look.floor.material.properties();
        let [clean, trodden] = &mut properties.roughness;
        *clean = look.floor.roughness.unwrap_or(*clean);
        *trodden = look.floor.roughness_trodden.unwrap_or(*trodden);
        let ground = Ground::new(&look.floor, look.seed, grid.texels_per_metre)?;
        let noise = film_noise(look);
        Ok(FloorResolver {
            sums,
            walls,
            law: Law::new(look, &properties, simulated_people, &noise, grid.texels_per_metre),
            noise,
            spread_m: look.film.spread_m.max(properties.least_spread_m),
            background: Background {
                base_color: ground.mean().map(|light| tone::srgb(light).round() as u8),
                mask: [0; 4],
                orm: [255, (255.0 * properties.roughness[0]).round() as u8, 0],
            },
            coarse: CoarseFloor::of(walls, grid.texels_per_metre, grid.width, grid.height),
            dither: noise::key(look.seed, Channel::Dither),
            skirting: Skirting::new(walls, look.edge.clone(), look.seed),
            look: look.clone(),
            properties,
            ground,
        })
    }

    /// What texels show that are neither floor nor padding, and all texels of an empty block.
    pub fn background(&self) -> Background {
        self.background
    }

    /// Resolves the texels `i0..i0 + width`, `j0..j0 + height`, which may reach beyond the floor's grid.
    pub fn resolve(&self, i0: i64, j0: i64, width: usize, height: usize) -> ResolvedBlock {
        let mut block = ResolvedBlock::default();
        self.resolve_into(i0, j0, width, height, &mut block);
        block
    }

    /// As [`FloorResolver::resolve`], into a block whose memory is used again: half the time is spent on fresh memory
    /// otherwise.
    pub fn resolve_into(&self, i0: i64, j0: i64, width: usize, height: usize, block: &mut ResolvedBlock) {
        let texels_per_metre = self.sums.grid().texels_per_metre;
        let rect = Window { texels_per_metre, i0, j0, width, height };
        match self.coarse.of_window(&rect) {
            CoarseShare::Nothing => block.become_empty(),
            CoarseShare::All => {
                block.resize(rect.texels(), &LAYERS);
                paint(self, rect, None, block);
            }
            CoarseShare::Some => self.with_padding(rect, block),
        }
    }

    /// A rectangle that holds floor's edge.
    fn with_padding(&self, rect: Window, block: &mut ResolvedBlock) {
        let around = rect.grown(PADDING);
        let mut share = vec![0.0; around.texels()];
        self.walls.coverage(around.texels_per_metre, around.i0, around.j0, around.width, around.height, &mut share);
        let floor: Vec<bool> = share.iter().map(|&share| share > 0.0).collect();
        // For every texel the column and row, counted from `around`, of the floor texel that it shows.
        let shown = sources(&floor, around.width);
        let Some(window) = bounds(&shown, &around) else {
            block.become_empty();
            return;
        };
        let place_of = |[column, row]: [u32; 2]| {
            let (left, low) = ((window.i0 - around.i0) as usize, (window.j0 - around.j0) as usize);
            (row as usize - low) * window.width + column as usize - left
        };
        let mut wanted = vec![false; window.texels()];
        for &place in shown.iter().flatten() {
            wanted[place_of(place)] = true;
        }
        PAINTED.with_borrow_mut(|painted| {
            painted.resize(window.texels(), &LAYERS);
            paint(self, window, Some(&wanted), painted);
            block.resize(rect.texels(), &LAYERS);
            let mut n = 0;
            while n < shown.len() {
                // Neighbours mostly show neighbours.
                let len = run_length(&shown[n..(n / rect.width + 1) * rect.width]);
                match shown[n] {
                    Some(place) => block.copy(n, painted, place_of(place), len),
                    None => block.clear(n..n + len, self.background),
                }
                n += len;
            }
        });
    }
}

/// The noises that add up to the look's three octaves. Clouds and blotches have detail of their own: a third of their
/// variance is in spots 0.4 times as large.
fn film_noise(look: &Look) -> Vec<Noise> {
    let noise = |channel, octave: Octave, size: f64, variance: f32| {
        Noise::new(look.seed, channel, [size * octave.size_m; 2], variance.sqrt() * octave.sd)
    };
    let NoiseLook { fine, middle, coarse } = look.noise;
    let all = [
        noise(Channel::Fine, fine, 1.0, 1.0),
        noise(Channel::Middle, middle, 1.0, 2.0 / 3.0),
        noise(Channel::MiddleDetail, middle, 0.4, 1.0 / 3.0),
        noise(Channel::Coarse, coarse, 1.0, 2.0 / 3.0),
        noise(Channel::CoarseDetail, coarse, 0.4, 1.0 / 3.0),
    ];
    all.into_iter().filter(|noise| !noise.is_flat()).collect()
}

thread_local! {
    /// What texels of a block show, before padding is made from them.
    static PAINTED: RefCell<ResolvedBlock> = RefCell::default();
}

/// How many texels from the first on show one texel after the other, or all nothing.
fn run_length(shown: &[Option<[u32; 2]>]) -> usize {
    let next = |k: u32| shown[0].map(|[column, row]| [column + k, row]);
    shown.iter().zip(0..).take_while(|&(&place, k)| place == next(k)).count()
}

/// The part of a window that holds all places that are shown.
fn bounds(shown: &[Option<[u32; 2]>], around: &Window) -> Option<Window> {
    let mut low = [u32::MAX; 2];
    let mut high = [0; 2];
    for place in shown.iter().flatten() {
        for axis in 0..2 {
            low[axis] = low[axis].min(place[axis]);
            high[axis] = high[axis].max(place[axis] + 1);
        }
    }
    (low[0] < high[0]).then(|| Window {
        i0: around.i0 + i64::from(low[0]),
        j0: around.j0 + i64::from(low[1]),
        width: (high[0] - low[0]) as usize,
        height: (high[1] - low[1]) as usize,
        ..*around
    })
}
