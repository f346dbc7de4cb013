use std::cell::RefCell;
use std::sync::Arc;

use super::areas::FloorArea;
use super::block::{Background, FLAT_FINELY, LAYERS, ResolvedBlock};
use super::coarse::{CoarseFloor, CoarseShare};
use super::error::LookError;
use super::lattice::TexelWindow;
use super::padding::{PADDING, sources};
use super::paint::FloorPainter;
use super::passes::coarse;
use super::settings::Look;
use crate::sums::{FloorSums, Quantity};
use crate::walls::Walls;

/// Resolves rectangles of a floor, also from several threads. A texel's value depends on its position only.
pub struct FloorResolver<'a> {
    painter: FloorPainter<'a>,
    areas: Vec<FloorArea<'a>>,
    coarse: CoarseFloor,
    finely: bool,
}

impl<'a> FloorResolver<'a> {
    /// Prepares to resolve `sums` of `simulated_people` people.
    ///
    /// # Errors
    /// Settings out of range, a floor image that cannot be read, an area's room that is not on the floor, sums without
    /// simulated people.
    ///
    /// # Example
    /// ```
    /// use trodden::look::{FloorResolver, Look};
    /// use trodden::{patterns::PatternLibrary, plan::FloorPlan, walls::Walls};
    /// use trodden::stamps::{Stamper, TexelGrid};
    /// use trodden::sums::FloorSums;
    ///
    /// // A floor of 2 x 2 m that nobody walked on: add marks, and they show.
    /// let plan = FloorPlan::from_mask(20, 20, 0.1, vec![1; 400]);
    /// let walls = Walls::trace(&plan, &Default::default());
    /// let grid = TexelGrid::covering(plan.width_m(), plan.height_m(), 50.0)?;
    /// let stamper = Stamper::new(&PatternLibrary::built_in(), grid, &Default::default())?;
    /// let mut sums = FloorSums::new(grid);
    /// sums.add(&stamper, &walls, &[]);
    /// let look = FloorResolver::new(&sums, &walls, &Look::default(), 1)?;
    /// assert_eq!(look.resolve(0, 0, 100, 100).base_color.len(), 10_000);
    /// # Ok::<(), trodden::Error>(())
    /// ```
    pub fn new(
        sums: &'a FloorSums,
        walls: &'a Walls,
        look: &Look,
        simulated_people: u32,
    ) -> Result<FloorResolver<'a>, LookError> {
        look.check()?;
        if simulated_people == 0 {
            return Err(LookError::NoPeople { total_passes: look.total_passes });
        }
        let grid = sums.grid();
        let rolled = Arc::new(coarse(sums, Quantity::Wheels, 1.0));
        Ok(FloorResolver {
            painter: FloorPainter::new((sums, &rolled), walls, look, simulated_people)?,
            areas: FloorArea::all((sums, &rolled), walls, look, simulated_people)?,
            coarse: CoarseFloor::of(walls, grid.texels_per_metre, grid.width, grid.height),
            finely: false,
        })
    }

    /// Resolves passes, wear and height with 16 bits too, see [`ResolvedBlock::fine`].
    pub fn finely(mut self, finely: bool) -> FloorResolver<'a> {
        self.finely = finely;
        self
    }

    fn begin(&self, block: &mut ResolvedBlock, texels: usize) {
        block.resize(texels, &LAYERS);
        block.fine.resize(if self.finely { texels } else { 0 }, FLAT_FINELY);
    }

    /// Texel values beyond floor and padding, and of all texels of an empty block.
    pub fn background(&self) -> Background {
        self.painter.background
    }

    /// Resolves the texels `i0..i0 + width`, `j0..j0 + height`, which may exceed the floor's grid.
    pub fn resolve(&self, i0: i64, j0: i64, width: usize, height: usize) -> ResolvedBlock {
        let mut block = ResolvedBlock::default();
        self.resolve_into(i0, j0, width, height, &mut block);
        block
    }

    /// As [`FloorResolver::resolve`], into a block whose memory is reused: about twice as fast.
    pub fn resolve_into(&self, i0: i64, j0: i64, width: usize, height: usize, block: &mut ResolvedBlock) {
        let texels_per_metre = self.painter.sums.grid().texels_per_metre;
        let rect = TexelWindow { texels_per_metre, i0, j0, width, height };
        match self.coarse.of_window(&rect) {
            CoarseShare::Nothing => block.become_empty(),
            CoarseShare::All => {
                self.begin(block, rect.texels());
                self.paint(rect, None, block);
            }
            CoarseShare::Some => self.with_padding(rect, block),
        }
    }

    fn paint(&self, window: TexelWindow, wanted: Option<&[bool]>, block: &mut ResolvedBlock) {
        self.painter.paint(window, wanted, block);
        self.areas.iter().for_each(|area| area.paint(window, wanted, block));
    }

    /// Resolves a rectangle that contains the floor's edge.
    fn with_padding(&self, rect: TexelWindow, block: &mut ResolvedBlock) {
        let around = rect.grown(PADDING);
        let mut share = vec![0.0; around.texels()];
        self.painter.walls.cleared_coverage(
            around.texels_per_metre,
            [around.i0, around.j0],
            [around.width, around.height],
            &mut share,
        );
        let floor: Vec<bool> = share.iter().map(|&share| share > 0.0).collect();
        // Column and row, relative to `around`, of the floor texel that each texel copies.
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
            self.begin(painted, window.texels());
            self.paint(window, Some(&wanted), painted);
            self.begin(block, rect.texels());
            let mut n = 0;
            while n < shown.len() {
                // Adjacent texels mostly copy adjacent texels.
                let len = run_length(&shown[n..(n / rect.width + 1) * rect.width]);
                match shown[n] {
                    Some(place) => block.copy(n, painted, place_of(place), len),
                    None => block.clear(n..n + len, self.painter.background),
                }
                n += len;
            }
        });
    }
}

thread_local! {
    /// Shaded texels of a block before padding.
    static PAINTED: RefCell<ResolvedBlock> = RefCell::default();
}

/// Number of texels from the first on that copy consecutive texels, or none.
fn run_length(shown: &[Option<[u32; 2]>]) -> usize {
    let next = |k: u32| shown[0].map(|[column, row]| [column + k, row]);
    shown.iter().zip(0..).take_while(|&(&place, k)| place == next(k)).count()
}

/// Returns the part of a window that contains all copied texels.
fn bounds(shown: &[Option<[u32; 2]>], around: &TexelWindow) -> Option<TexelWindow> {
    let mut low = [u32::MAX; 2];
    let mut high = [0; 2];
    for place in shown.iter().flatten() {
        for axis in 0..2 {
            low[axis] = low[axis].min(place[axis]);
            high[axis] = high[axis].max(place[axis] + 1);
        }
    }
    (low[0] < high[0]).then(|| TexelWindow {
        i0: around.i0 + i64::from(low[0]),
        j0: around.j0 + i64::from(low[1]),
        width: (high[0] - low[0]) as usize,
        height: (high[1] - low[1]) as usize,
        ..*around
    })
}
