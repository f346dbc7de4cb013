use std::cmp::Reverse;
use std::collections::BTreeMap;

use super::sheet::{Sheet, Strip};
use crate::export::{ExportError, TileLayout};
use crate::stamps::WallGrid;
use crate::walls::Corner;

/// Least share of a full sheet that strips and their padding have to cover.
const LEAST_FILLED: f64 = 0.85;
/// Where rows cover less than this share of a sheet, the rest holds turned strips.
const ROWS_ENOUGH: f64 = 0.90;
/// Least share of each bin to fill where [`LEAST_FILLED`] is out of reach.
const LEAST_OF_BEST: f64 = 0.96;
/// Length of the shortest piece that a cut may make, in multiples of the padding.
const LEAST_PIECE: u32 = 4;
/// Number of pieces, longest first, that are tried for a cut.
const CANDIDATES: usize = 64;

/// An end of a face, or a place where it may be cut.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cut {
    column: u32,
    along_m: f64,
}

/// A stretch of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    face: usize,
    from: Cut,
    to: Cut,
}

impl Piece {
    fn width(&self) -> u32 {
        self.to.column - self.from.column
    }

    /// Sort key: by length; of equal lengths the first face comes last.
    fn key(&self) -> Key {
        (self.width(), Reverse((self.face, self.from.column)))
    }

    fn split(&self, at: Cut) -> [Piece; 2] {
        [Piece { to: at, ..*self }, Piece { from: at, ..*self }]
    }
}

type Key = (u32, Reverse<(usize, u32)>);

/// Which faces may be cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Breaking {
    /// Faces longer than a row.
    Needed,
    /// All faces, at a corner.
    AtCorners,
    /// All faces, anywhere.
    Anywhere,
}

/// A row of a sheet, or a column of turned strips.
#[derive(Clone, Copy, Debug)]
struct Bin {
    /// Lower-left texel, padding included.
    x: u32,
    y: u32,
    length: u32,
    turned: bool,
}

/// The bins of a full sheet, and how far to fill them.
#[derive(Clone, Debug)]
struct Shape {
    side: u32,
    padding: u32,
    /// Height of a strip without padding, texels.
    strip: u32,
    bins: Vec<Bin>,
    /// Least share of each bin to fill.
    least: f64,
}

impl Shape {
    fn new(strip: u32, side: u32, padding: u32) -> Shape {
        let pitch = strip + 2 * padding;
        let count = side / pitch;
        let rest = side - count * pitch;
        let row = |k| Bin { x: 0, y: k * pitch, length: side, turned: false };
        let column = |k| Bin { x: k * pitch, y: count * pitch, length: rest, turned: true };
        let mut bins: Vec<Bin> = (0..count).map(row).collect();
        let rows_filled = f64::from(count * pitch) / f64::from(side);
        if rows_filled < ROWS_ENOUGH && rest > (2 + LEAST_PIECE) * padding {
            bins.extend((0..count).map(column));
        }
        let taken: f64 = bins.iter().map(|bin| f64::from(bin.length) * f64::from(pitch)).sum();
        let best = taken / (f64::from(side) * f64::from(side));
        Shape { side, padding, strip, bins, least: (LEAST_FILLED / best).min(LEAST_OF_BEST) }
    }

    /// Returns the length that a strip of this width takes in a bin, with its padding, texels.
    fn room(&self, width: u32) -> u32 {
        width + 2 * self.padding
    }

    /// Returns the length of the longest piece that fits in a row, texels.
    fn longest(&self) -> u32 {
        self.side - 2 * self.padding
    }

    fn least_piece(&self) -> u32 {
        (LEAST_PIECE * self.padding).max(1)
    }
}

/// Packs all faces into sheets of at most `side` texels.
pub(super) fn sheets(grid: &WallGrid, corners: &[Corner], side: u32, padding: u32) -> Result<Vec<Sheet>, ExportError> {
    let (min, max) = (TileLayout::MIN_TILE, TileLayout::MAX_TILE);
    if !(min..=max).contains(&side) {
        return Err(ExportError::TileSize { tile: side, min, max });
    }
    let pitch = grid.height.saturating_add(padding.saturating_mul(2));
    if pitch > side {
        let texels_per_metre = grid.texels_per_metre;
        return Err(ExportError::WallTooHigh { height_m: grid.height_m, texels_per_metre, needed: pitch, sheet: side });
    }
    let shape = Shape::new(grid.height.max(1), side, padding);
    let mut packer = Packer::new(grid, corners);
    let mut sheets = Vec::new();
    while !packer.pool.is_empty() {
        sheets.push(packer.sheet(&shape));
    }
    if let Some(last) = sheets.last_mut() {
        cut(last, padding);
    }
    Ok(sheets)
}

/// Cuts a sheet's size down to powers of two.
fn cut(sheet: &mut Sheet, padding: u32) {
    let end = |axis: usize| {
        let ends = sheet.strips.iter().map(|strip| [strip.x, strip.y][axis] + strip.size()[axis] + padding);
        ends.max().unwrap_or(1).next_power_of_two()
    };
    let size = [end(0), end(1)];
    (sheet.width, sheet.height) = (sheet.width.min(size[0]), sheet.height.min(size[1]));
}

/// Packs sheet after sheet from a pool of pieces.
struct Packer {
    texels_per_metre: f64,
    pool: BTreeMap<Key, Piece>,
    /// By face, its corners, sorted by arc length.
    corners: Vec<Vec<Cut>>,
    /// Changes of the pool made for the current sheet, to undo them.
    log: Vec<Step>,
}

enum Step {
    Taken(Piece),
    Put(Piece),
}

impl Packer {
    fn new(grid: &WallGrid, corners: &[Corner]) -> Packer {
        let mut cuts = vec![Vec::new(); grid.faces.len()];
        for corner in corners {
            let Some(span) = grid.faces.get(corner.face) else { continue };
            let column = (corner.along_m * grid.texels_per_metre).round();
            if column >= 1.0 && column < f64::from(span.width) {
                cuts[corner.face].push(Cut { column: column as u32, along_m: corner.along_m });
            }
        }
        for cuts in &mut cuts {
            cuts.sort_by(|a, b| a.along_m.total_cmp(&b.along_m));
            cuts.dedup_by_key(|cut| cut.column);
        }
        let whole = |(face, span): (usize, &crate::stamps::FaceSpan)| {
            let to = Cut { column: span.width, along_m: span.length_m };
            Piece { face, from: Cut { column: 0, along_m: 0.0 }, to }
        };
        let pieces = grid.faces.iter().enumerate().filter(|(_, span)| span.width > 0).map(whole);
        let pool = pieces.map(|piece| (piece.key(), piece)).collect();
        Packer { texels_per_metre: grid.texels_per_metre, pool, corners: cuts, log: Vec::new() }
    }

    /// Fills a sheet, with as few cuts as it allows.
    fn sheet(&mut self, shape: &Shape) -> Sheet {
        let mut sheet = Sheet::default();
        for breaking in [Breaking::Needed, Breaking::AtCorners, Breaking::Anywhere] {
            self.undo();
            sheet = self.fill(shape, breaking);
            let target = LEAST_FILLED.min(shape.least * best(shape));
            if self.pool.is_empty() || sheet.filled(shape.padding) >= target {
                break;
            }
        }
        self.log.clear();
        sheet
    }

    fn undo(&mut self) {
        while let Some(step) = self.log.pop() {
            match step {
                Step::Taken(piece) => self.pool.insert(piece.key(), piece),
                Step::Put(piece) => self.pool.remove(&piece.key()),
            };
        }
    }

    fn fill(&mut self, shape: &Shape, breaking: Breaking) -> Sheet {
        let mut sheet = Sheet { width: shape.side, height: shape.side, strips: Vec::new() };
        for bin in &shape.bins {
            self.fill_bin(shape, bin, breaking, &mut sheet.strips);
        }
        sheet
    }

    fn fill_bin(&mut self, shape: &Shape, bin: &Bin, breaking: Breaking, strips: &mut Vec<Strip>) {
        let mut used = 0;
        while let Some(room) = (bin.length - used).checked_sub(2 * shape.padding).filter(|&room| room > 0) {
            let least = (f64::from(bin.length) * shape.least).ceil() as u32;
            // The padding of a further strip counts, but without that strip there is none.
            let wanted = if used < least { least.saturating_sub(used + 2 * shape.padding).max(1) } else { 0 };
            let Some(piece) = self.next(shape, room, wanted, used == 0 && !bin.turned, breaking) else { break };
            strips.push(placed(&piece, shape, bin, used));
            used += shape.room(piece.width());
        }
    }

    /// Takes the longest piece that fits in `room` texels. If none fits and `wanted` is not 0, cuts off a part of one.
    fn next(&mut self, shape: &Shape, room: u32, wanted: u32, new_row: bool, breaking: Breaking) -> Option<Piece> {
        let longest = *self.pool.last_key_value()?.1;
        if new_row && longest.width() > room {
            return Some(self.take_head(&longest, self.cut_of(&longest, shape, room, wanted)));
        }
        let fitting = self.pool.range(..=(room, Reverse((0, 0)))).next_back().map(|(_, &piece)| piece);
        if let Some(piece) = fitting {
            self.take(&piece);
            return Some(piece);
        }
        if wanted == 0 || room < shape.least_piece() {
            return None;
        }
        let candidates = self.pool.values().rev().take(CANDIDATES);
        let may_break = |piece: &&Piece| breaking != Breaking::Needed || piece.width() > shape.longest();
        let at_corner = |piece: &Piece| Some((*piece, self.corner(piece, shape, room, wanted)?));
        let found = candidates.filter(may_break).find_map(at_corner);
        let found = match breaking {
            Breaking::AtCorners if longest.width() <= shape.longest() => found,
            Breaking::Needed if longest.width() <= shape.longest() => None,
            _ => found.or_else(|| Some((longest, self.cut_of(&longest, shape, room, wanted)))),
        };
        found.map(|(piece, cut)| self.take_head(&piece, cut))
    }

    /// Returns where to cut a piece that is longer than `room`.
    fn cut_of(&self, piece: &Piece, shape: &Shape, room: u32, wanted: u32) -> Cut {
        self.corner(piece, shape, room, wanted).unwrap_or_else(|| {
            // The rest should be at least as long as the shortest piece.
            let whole_rest = piece.width().saturating_sub(shape.least_piece());
            let width = if whole_rest >= wanted.max(1) { room.min(whole_rest) } else { room };
            let column = piece.from.column + width;
            Cut { column, along_m: f64::from(column) / self.texels_per_metre }
        })
    }

    /// Returns the last corner at which a piece fills at least `wanted` of `room` texels.
    fn corner(&self, piece: &Piece, shape: &Shape, room: u32, wanted: u32) -> Option<Cut> {
        let cuts = &self.corners[piece.face];
        let low = piece.from.column + wanted.max(shape.least_piece());
        let rest = piece.to.column.saturating_sub(shape.least_piece());
        let high = (piece.from.column + room).min(rest);
        let before = cuts.partition_point(|cut| cut.column <= high);
        cuts[..before].last().filter(|cut| cut.column >= low).copied()
    }

    fn take(&mut self, piece: &Piece) {
        self.pool.remove(&piece.key());
        self.log.push(Step::Taken(*piece));
    }

    fn take_head(&mut self, piece: &Piece, at: Cut) -> Piece {
        let [head, tail] = piece.split(at);
        self.take(piece);
        self.pool.insert(tail.key(), tail);
        self.log.push(Step::Put(tail));
        head
    }
}

/// Returns the share of a sheet that its bins cover.
fn best(shape: &Shape) -> f64 {
    let taken: f64 = shape.bins.iter().map(|bin| f64::from(bin.length) * f64::from(shape.room(shape.strip))).sum();
    taken / (f64::from(shape.side) * f64::from(shape.side))
}

fn placed(piece: &Piece, shape: &Shape, bin: &Bin, used: u32) -> Strip {
    let (x, y) = if bin.turned { (bin.x, bin.y + used) } else { (bin.x + used, bin.y) };
    Strip {
        face: piece.face,
        from_m: piece.from.along_m,
        to_m: piece.to.along_m,
        i0: piece.from.column,
        width: piece.width(),
        height: shape.strip,
        x: x + shape.padding,
        y: y + shape.padding,
        turned: bin.turned,
    }
}
