use std::cell::RefCell;

use super::cladding::Cladding;
use super::paint::WallPainter;
use super::settings::StainLook;
use super::shade::KINDS;
use super::strip::{ColumnRun, FaceStrip};
use crate::look::block::{Background, ResolvedBlock};
use crate::look::error::LookError;
use crate::look::lattice::TexelWindow;
use crate::look::settings::Look;
use crate::sums::WallSums;
use crate::walls::{Doorway, Walls};

/// Names of a wall block's float layers: optical densities by cause, of splash, of dust, of chips in the paint.
pub const WALL_LAYERS: [&str; KINDS] = ["hand", "arm", "shoulder", "bag", "shoe", "splash", "dust", "chip"];

/// Resolves rectangles of wall faces' strips, also from several threads. A texel depends on its position only.
pub struct WallResolver<'a> {
    walls: WallPainter<'a>,
    /// By cladding, of those that there are.
    furniture: Vec<(Cladding, WallPainter<'a>)>,
    of_face: Vec<Option<Cladding>>,
}

impl<'a> WallResolver<'a> {
    /// Prepares to resolve `sums` of `simulated_people` people on the faces of `walls`.
    ///
    /// # Errors
    /// A setting is out of range; the wall image is unreadable; the sums lack people or belong to other walls.
    pub fn new(
        sums: &'a WallSums,
        walls: &Walls,
        look: &Look,
        simulated_people: u32,
    ) -> Result<WallResolver<'a>, LookError> {
        look.check()?;
        if simulated_people == 0 {
            return Err(LookError::NoPeople { total_passes: look.wall.total_passes });
        }
        let (faces, summed) = (walls.faces.len(), sums.grid().faces.len());
        if summed != faces {
            return Err(LookError::OtherWalls { faces, summed });
        }
        let of_face: Vec<Option<Cladding>> = walls.faces.iter().map(Cladding::of).collect();
        let painter = |look: &Look| WallPainter::new(sums, walls, look, simulated_people);
        let of_cladding = |cladding: Cladding| {
            let look = Look { wall: cladding.look(&look.wall), ..look.clone() };
            Ok((cladding, painter(&look)?))
        };
        let there = Cladding::ALL.into_iter().filter(|cladding| of_face.contains(&Some(*cladding)));
        let furniture = there.map(of_cladding).collect::<Result<_, LookError>>()?;
        Ok(WallResolver { walls: painter(look)?, furniture, of_face })
    }

    /// Shades a window of a strip into a block. Returns `false` if all of it has the background.
    fn paint(&self, strip: &FaceStrip, window: &TexelWindow, block: &mut ResolvedBlock) -> bool {
        let cladding = self.of_face[strip.face];
        match self.furniture.iter().find(|(of, _)| Some(*of) == cladding) {
            Some((_, painter)) => {
                painter.paint(strip, window, block);
                true
            }
            None => self.walls.paint(strip, window, block),
        }
    }

    /// Adds the frames of doors, as `look` has them.
    pub fn with_doors(self, walls: &Walls, doorways: &[Doorway], look: &Look) -> WallResolver<'a> {
        WallResolver { walls: self.walls.with_doors(walls, doorways, look), ..self }
    }

    /// Mean of the clean wall: the value of all texels of an empty block.
    pub fn background(&self) -> Background {
        self.walls.background
    }

    /// Texels along a face, if there is such a face.
    pub fn columns(&self, face: usize) -> Option<u32> {
        self.walls.sums.grid().faces.get(face).map(|span| span.width)
    }

    /// Stains of hands and of shoes, as this look has them.
    pub fn leaf_stains(&self) -> [StainLook; 2] {
        let [hand, .., shoe] = self.walls.stains;
        [hand, shoe]
    }

    /// Resolves the texels `i0..i0 + width`, `j0..j0 + height` of the unrolled strip of a face.
    ///
    /// i increases along the face; row 0 is the lowest, at the floor for `j0` = 0.
    ///
    /// Beyond the strip's ends, the floor and the ceiling, the edge texels are repeated, as padding of an atlas; a
    /// closed face continues at its other end. The block is empty (all background) where an even wall is clean, and for
    /// unknown faces.
    pub fn resolve(&self, face: usize, i0: i64, j0: i64, width: usize, height: usize) -> ResolvedBlock {
        let mut block = ResolvedBlock::default();
        self.resolve_into(face, i0, j0, width, height, &mut block);
        block
    }

    /// As [`WallResolver::resolve`], into a block whose memory is reused.
    pub fn resolve_into(&self, face: usize, i0: i64, j0: i64, width: usize, height: usize, block: &mut ResolvedBlock) {
        let Some(strip) = FaceStrip::of(self.walls.sums.grid(), face).filter(|_| width > 0 && height > 0) else {
            block.become_empty();
            return;
        };
        block.resize(width * height, &WALL_LAYERS);
        let rows = strip.rows(j0, height);
        let runs = strip.columns(i0, width);
        let whole = ColumnRun { columns: i0.max(0) as u32..i0.max(0) as u32 + width as u32, at: 0 };
        if i0 >= 0 && runs == [whole] && i64::from(rows.start) == j0 && rows.len() == height {
            if !self.paint(&strip, &strip.window(&runs[0].columns, &rows), block) {
                block.become_empty();
            }
            return;
        }
        let any = PAINTED.with_borrow_mut(|painted| {
            let mut any = false;
            for (n, run) in runs.iter().enumerate() {
                let window = strip.window(&run.columns, &rows);
                // A short closed face goes round several times: once is enough.
                if n == 0 || runs[n - 1].columns != run.columns {
                    painted.resize(window.texels(), &WALL_LAYERS);
                    any |= self.paint(&strip, &window, painted);
                }
                // On an open strip, the only run is extended to both sides.
                let end = runs.get(n + 1).map_or(width, |next| next.at);
                let left = if strip.closed { 0 } else { (window.i0 - i0).clamp(0, width as i64) as usize };
                for row in 0..height {
                    let source = (j0 + row as i64 - window.j0).clamp(0, window.height as i64 - 1) as usize;
                    let place = RowCopy { to: row * width, from: source * window.width };
                    place.copy(block, painted, run.at..end, left, window.width);
                }
            }
            any
        });
        if !any {
            block.become_empty();
        }
    }
}

thread_local! {
    /// Shaded texels of a strip before its edges are continued.
    static PAINTED: RefCell<ResolvedBlock> = RefCell::default();
}

/// First texels of a block's row and of the row copied to it.
struct RowCopy {
    to: usize,
    from: usize,
}

impl RowCopy {
    /// Copies `len` texels to the columns from `at.start + left` on. Repeats the first and last over the rest of the
    /// columns `at`.
    fn copy(
        &self,
        block: &mut ResolvedBlock,
        painted: &ResolvedBlock,
        at: std::ops::Range<usize>,
        left: usize,
        len: usize,
    ) {
        let start = (at.start + left).min(at.end);
        let inner = len.min(at.end - start);
        block.copy(self.to + start, painted, self.from, inner);
        for column in at.start..start {
            block.copy(self.to + column, painted, self.from, 1);
        }
        for column in start + inner..at.end {
            block.copy(self.to + column, painted, self.from + len - 1, 1);
        }
    }
}
