//! Understands a drawing: walls, doors, windows, furniture, lettering, lines, and the paper around.
//!
//! Walls are the strokes that are thick, or hollow and filled, and that gaps of doors and windows join to a building.
//! All other strokes are told by where they lie and what they enclose.

mod border;
mod directions;
mod doubtful;
mod filled;
mod frame;
mod gaps;
mod glazing;
mod hollow;
mod leaves;
mod lettering;
mod lines;
mod net;
mod partitions;
mod pieces;
mod rooms;

use std::cell::Cell;

use self::gaps::Gap;
use self::glazing::Glazing;
use self::net::{CONNECTED, Hints, Net, Sought, WIDEST_DOOR_M, WIDEST_ENTRANCE_M};
use self::pieces::{Evidence, LARGEST_LETTER_M};
use self::rooms::Rooms;
use super::components::{Component, Components, Neighbours};
use super::drawing::{Drawing, is_on};
use super::symbols::{FEWEST_STROKES, groups};
use super::thick;
use super::{DoorKind, FloorPlan, FurniturePiece, PlanClass, PlanDoor, PlanWindow};

/// Largest drawing that is understood as it is, pixels; above, the cost in memory is felt.
const LARGEST_PX: usize = 20_000_000;
/// Coarsest scale to which a larger drawing is reduced, metres per pixel: the thinnest walls still have two pixels.
const COARSEST_M_PER_PX: f64 = 0.03;
/// Least number of pixels of strokes that make a drawing more than walls.
const FEWEST_STROKE_PX: usize = 40;
/// Lightness below which a pixel may be of a fine stroke.
const FAINT: u8 = 180;
/// How far a line goes on below one of another colour, pixels.
const CROSSED_PX: usize = 3;
/// Share of a building that walls without colours enclose at least, of what all strokes do.
const AS_CLOSED: f64 = 0.9;
/// How far from a ring in the fill of a wall dark pixels are at most, on both of its sides.
const RING_PX: usize = 2;
/// So many doors that lead outside may lead into a hall behind a wide entrance: then at least so many fewer lead outside, and
/// the inside is so many times as large.
const MANY_WAYS_OUT: usize = 4;
const FEWER_WAYS_OUT: usize = 2;
const HALL_SHARE: f64 = 1.15;
/// Greatest thickness of walls with doors, metres; of those of churches and castles.
const THICKEST_WALL_M: f64 = 0.9;
const MASSIVE_WALL_M: f64 = 2.5;
/// Greatest width of a door in them, metres: buttresses are further apart.
const WIDEST_PORTAL_M: f64 = 4.0;
/// Greatest thickness of a stroke of colour and of a pane that is filled, metres.
const STROKE_M: f64 = 0.1;
const PANE_M: f64 = 0.55;

/// A door's gap, how it is drawn, and its open leaf, pixels of the image.
struct FoundDoor(Gap, DoorKind, Option<[[f64; 2]; 2]>);

/// What a drawing shows.
pub(super) struct Understood {
    /// Class of each pixel that is not simply floor, wall or outside; those are [`PlanClass::Floor`] here.
    pub(super) classes: Vec<PlanClass>,
    /// 1 for the paper around the building.
    pub(super) outside: Vec<u8>,
    doors: Vec<FoundDoor>,
    windows: Vec<Gap>,
    furniture: Vec<Evidence>,
    /// How many pixels of the drawing along a side are one of the places of doors, windows and furniture.
    factor: usize,
}

/// Understands a drawing, and leaves only what stands in people's way in it.
///
/// `None` for drawings without strokes beside walls, and those whose walls enclose no building.
pub(super) fn understand(drawing: &mut Drawing, metres_per_pixel: f64) -> Option<Understood> {
    let factor = factor(drawing);
    if factor == 1 {
        let understood = understand_all(drawing, metres_per_pixel)?;
        redraw(drawing, &understood.classes);
        return Some(understood);
    }
    if metres_per_pixel * factor as f64 > COARSEST_M_PER_PX {
        return None;
    }
    let mut understood = understand_all(&reduced(drawing, factor), metres_per_pixel * factor as f64)?;
    let small = understood.classes;
    let across = drawing.width.div_ceil(factor);
    let outside = std::mem::take(&mut understood.outside);
    // Within walls all is wall; at their edges, what is dark.
    let within: Vec<u8> = small.iter().map(|class| u8::from(!class.is_solid())).collect();
    let rim = thick::grow(&within, across, 1);
    understood.classes = Vec::with_capacity(drawing.dark.len());
    for y in 0..drawing.height {
        for x in 0..drawing.width {
            let at = y / factor * across + x / factor;
            let is_light = rim[at] != 0 && drawing.dark[y * drawing.width + x] == 0;
            let is_wall = small[at] == PlanClass::Wall;
            understood.outside.push(outside[at]);
            understood.classes.push(if is_wall && is_light { PlanClass::Floor } else { small[at] });
        }
    }
    understood.factor = factor;
    redraw(drawing, &understood.classes);
    Some(understood)
}

/// By how much a drawing is reduced to be understood.
fn factor(drawing: &Drawing) -> usize {
    (1..).find(|factor| drawing.dark.len() / (factor * factor) <= LARGEST_PX).unwrap_or(1)
}

/// The drawing with `factor` pixels along a side made one, as dark as the darkest stroke that crosses it.
fn reduced(drawing: &Drawing, factor: usize) -> Drawing {
    let (width, height) = (drawing.width.div_ceil(factor), drawing.height.div_ceil(factor));
    let fold = |mask: &[u8], start: u8, pick: fn(u8, u8) -> u8| {
        let mut small = vec![start; if mask.is_empty() { 0 } else { width * height }];
        for (y, row) in mask.chunks_exact(drawing.width).enumerate() {
            let small = &mut small[y / factor * width..][..width];
            row.iter().enumerate().for_each(|(x, &value)| small[x / factor] = pick(small[x / factor], value));
        }
        small
    };
    Drawing {
        width,
        height,
        lightness: fold(&drawing.lightness, 255, u8::min),
        dark: fold(&drawing.dark, 0, u8::max),
        coloured: fold(&drawing.coloured, 0, u8::max),
        dark_colour: fold(&drawing.dark_colour, 0, u8::max),
        pane: fold(&drawing.pane, 0, u8::max),
        pieces: fold(&drawing.pieces, 0, u8::max),
        ..*drawing
    }
}

fn understand_all(drawing: &Drawing, metres_per_pixel: f64) -> Option<Understood> {
    let (width, pixels) = (drawing.width, drawing.dark.len());
    let (mut ink, net) = ink_and_net(drawing, metres_per_pixel)?;
    for (ink, &wall) in ink.iter_mut().zip(&net.wall) {
        *ink &= 1 - wall;
    }
    let pieces = without_mats(&drawing.pieces, &net, width, metres_per_pixel);
    if ink.iter().chain(&pieces).filter(|&&i| i != 0).count() < FEWEST_STROKE_PX {
        return None;
    }
    let mut classes = vec![PlanClass::Floor; pixels];
    let kinds: Vec<(DoorKind, Option<[[f64; 2]; 2]>)> = net
        .doors
        .iter()
        .map(|gap| {
            let leaf = leaves::open_leaf(gap, &ink, metres_per_pixel);
            let symbol = leaves::symbol(gap, &ink, metres_per_pixel);
            for &at in &symbol {
                ink[at] = 0;
                classes[at] = PlanClass::Door;
            }
            let kind = match () {
                () if !symbol.is_empty() => DoorKind::Leaf,
                () if gap.strokes > 0 || gap.slides || gap.turns => DoorKind::Line,
                () => DoorKind::Open,
            };
            (kind, leaf)
        })
        .collect();
    ink.iter_mut().zip(pieces).for_each(|(ink, piece)| *ink |= piece);
    let strokes = pieces::Strokes { ink: &ink, dark: &drawing.dark, dark_colour: &drawing.dark_colour };
    let furniture = pieces::furniture(&strokes, &net, width, metres_per_pixel, &mut classes);
    name_strokes(&ink, &net, width, metres_per_pixel, &mut classes);
    let Net { wall, doors, windows, inside, .. } = net;
    let with_kind = |(gap, (kind, leaf))| FoundDoor(gap, kind, leaf);
    let doors: Vec<FoundDoor> = doors.into_iter().zip(kinds).map(with_kind).collect();
    for at in doors.iter().flat_map(|FoundDoor(gap, ..)| gap.pixels()) {
        classes[at] = PlanClass::Door;
    }
    for at in windows.iter().flat_map(|gap| gap.pixels()) {
        classes[at] = PlanClass::Window;
    }
    for (class, &wall) in classes.iter_mut().zip(&wall) {
        if wall != 0 {
            *class = PlanClass::Wall;
        }
    }
    if !net::is_connected(&classes, &inside, width) {
        return None;
    }
    let is_outside = |at: usize| u8::from(inside[at] == 0 && !classes[at].is_solid() && classes[at] != PlanClass::Door);
    let outside = (0..pixels).map(is_outside).collect();
    Some(Understood { classes, outside, doors, windows, furniture, factor: 1 })
}

/// Outlines of furniture without those in front of doors: mats lie there.
fn without_mats(pieces: &[u8], net: &Net, width: usize, metres_per_pixel: f64) -> Vec<u8> {
    let mut kept = pieces.to_vec();
    if kept.is_empty() {
        return kept;
    }
    let all = Components::of(pieces, width, 1, Neighbours::Eight);
    for (leads_out, reach) in [(false, BEFORE_DOORS_M[0]), (true, BEFORE_DOORS_M[1])] {
        let doors = net.doors.iter().filter(|gap| gap.leads_out(&net.inside) == leads_out);
        let near = thick::grow(&gaps::mask(doors, kept.len()), width, (reach / metres_per_pixel) as usize);
        let mats = all.all.iter().filter(|piece| all.touches(piece, &near, width));
        mats.for_each(|piece| all.paint(piece, &mut kept, width, 0));
    }
    kept
}

/// What is drawn at all, faint or not, and the walls in it.
fn ink_and_net(drawing: &Drawing, metres_per_pixel: f64) -> Option<(Vec<u8>, Net)> {
    let pixels = drawing.dark.len();
    if drawing.scanned {
        return None;
    }
    let coloured = thick::strokes(&drawing.coloured, drawing.width, STROKE_M / metres_per_pixel);
    // Panes are as thick as walls, and may be a stronger blue beside a pale blue floor.
    let mut panes = thick::slim(&drawing.pane, drawing.width, PANE_M / metres_per_pixel);
    for ((pane, stroke), of_pane) in panes.iter_mut().zip(&coloured).zip(&drawing.pane) {
        *pane |= stroke & of_pane;
    }
    let bars = drawing.without_panes(&coloured);
    let is_ink = |at: usize| {
        let is_thin = is_on(&coloured, at) || is_on(&panes, at);
        u8::from(drawing.dark[at] != 0 || drawing.lightness[at] < FAINT || is_thin)
    };
    let mut ink: Vec<u8> = (0..pixels).map(is_ink).collect();
    let faint = thick::strokes(&drawing.faint_strokes(), drawing.width, STROKE_M / metres_per_pixel);
    let mut all_ink = ink.clone();
    all_ink.iter_mut().zip(faint).for_each(|(ink, faint)| *ink |= faint);
    lettering::drop_tags([&mut ink, &mut all_ink], drawing.width, metres_per_pixel);
    let net =
        find_net(drawing, [&ink, &all_ink], Hints { panes: &panes, bars: &bars, slanted: &[] }, metres_per_pixel)?;
    Some((all_ink, net))
}

/// How far before doors within a building nothing stands, and before those that lead out, metres.
const BEFORE_DOORS_M: [f64; 2] = [0.3, 1.0];
/// How far from the floor of rooms walls of the building reach at most, metres.
const BESIDE_ROOMS_M: f64 = 0.1;

/// The walls in a drawing that may be too large to be understood as it is: its width, and how many of its pixels along a
/// side are one.
fn net_of_all(drawing: &Drawing, metres_per_pixel: f64) -> Option<(Net, usize, usize)> {
    let factor = factor(drawing);
    let reduced = (factor > 1).then(|| reduced(drawing, factor));
    let drawing = reduced.as_ref().unwrap_or(drawing);
    let (_, net) = ink_and_net(drawing, metres_per_pixel * factor as f64)?;
    Some((net, drawing.width, factor))
}

/// Finds the rooms of a drawing, if its walls enclose a building.
pub(super) fn rooms(drawing: &Drawing, metres_per_pixel: f64) -> Option<Rooms> {
    let (net, width, factor) = net_of_all(drawing, metres_per_pixel)?;
    Some(Rooms::of(&net.inside, width, factor))
}

/// Bounds of the building: least x and y, then one beyond the greatest, pixels.
pub(super) fn extent(drawing: &Drawing, metres_per_pixel: f64) -> Option<[[u32; 2]; 2]> {
    let (net, width, factor) = net_of_all(drawing, metres_per_pixel)?;
    let metres_per_pixel = metres_per_pixel * factor as f64;
    let pieces = Components::of(&net.wall, width, 1, Neighbours::Eight);
    // Lines of dimensions that were taken for walls lie beyond the building.
    let beside = ((BESIDE_ROOMS_M / metres_per_pixel) as usize).max(2);
    let is_inside = |x: usize, y: usize| net.inside.get(y * width + x).is_some_and(|&inside| inside != 0);
    let walls = pieces.all.iter().filter(|piece| {
        pieces.runs(piece).iter().any(|run| {
            let [from, to, y] = [run.from, run.to - 1, run.y].map(|px| px as usize);
            let ends = [(from.saturating_sub(beside), y), ((to + beside).min(width - 1), y)];
            let sides = [from, to].map(|x| [(x, y.saturating_sub(beside)), (x, y + beside)]);
            ends.into_iter().chain(sides.into_iter().flatten()).any(|(x, y)| is_inside(x, y))
        })
    });
    let of = |pick: fn(u32, u32) -> u32, corner: fn(&Component) -> [u32; 2]| {
        walls.clone().map(corner).reduce(|a, b| [pick(a[0], b[0]), pick(a[1], b[1])])
    };
    let corners = [of(u32::min, |p| p.min)?, of(u32::max, |p| p.end)?];
    Some(corners.map(|corner| corner.map(|px| px * factor as u32)))
}

/// Lengths of the leaves that hang in the gaps of walls, pixels, as read at a scale that is about right.
pub(super) fn leaf_lengths(drawing: &Drawing, metres_per_pixel: f64) -> Vec<f64> {
    let factor = factor(drawing);
    let reduced = (factor > 1).then(|| reduced(drawing, factor));
    let metres_per_pixel = metres_per_pixel * factor as f64;
    let Some((mut ink, net)) = ink_and_net(reduced.as_ref().unwrap_or(drawing), metres_per_pixel) else {
        return Vec::new();
    };
    ink.iter_mut().zip(&net.wall).for_each(|(ink, &wall)| *ink &= 1 - wall);
    let lengths = net.doors.iter().flat_map(|gap| leaves::hung(gap, &ink, metres_per_pixel));
    lengths.map(|length| length * factor as f64).collect()
}

/// Finds the walls, and glass fronts where a building is open without them.
///
/// The second of `inks` has fainter strokes too, as partitions between thick walls may be.
fn find_net(drawing: &Drawing, inks: [&[u8]; 2], hints: Hints, metres_per_pixel: f64) -> Option<Net> {
    let width = drawing.width;
    let glazing = Glazing::of(inks[0], width, metres_per_pixel);
    let hints = Hints { slanted: &glazing.slanted(), ..hints };
    let closed = |net: &Option<Net>| net.as_ref().map_or(0.0, |net| net.enclosed * net.joined(width));
    let plain = find_walls(drawing, inks, hints, metres_per_pixel);
    if closed(&plain) >= filled::WELL_CLOSED {
        return plain;
    }
    let fronts = glazing.fronts();
    if fronts.is_empty() {
        return plain;
    }
    // They reach into the walls at their ends, or into each other.
    let mut glazed = drawing.clone();
    let [mut ink, mut all_ink] = inks.map(<[u8]>::to_vec);
    for at in fronts.iter().flat_map(|front| front.widened(front.thickness() as usize).pixels()) {
        glazed.lightness[at] = 0;
        [&mut glazed.dark, &mut ink, &mut all_ink].into_iter().for_each(|mask| mask[at] = 1);
    }
    let mut found = find_walls(&glazed, [&ink, &all_ink], hints, metres_per_pixel);
    if closed(&found) <= closed(&plain) + filled::BETTER {
        return plain;
    }
    if let Some(net) = &mut found {
        let is_of_building = |front: &Gap| front.pixels().iter().any(|&at| net.wall[at] != 0);
        let fronts: Vec<Gap> = fronts.into_iter().filter(is_of_building).collect();
        fronts.iter().flat_map(Gap::pixels).for_each(|at| net.wall[at] = 0);
        net.windows.extend(fronts);
    }
    found
}

/// Finds the walls: a building whose rooms nothing joins only if there is no other.
fn find_walls(drawing: &Drawing, inks: [&[u8]; 2], hints: Hints, metres_per_pixel: f64) -> Option<Net> {
    let was_sealed = Cell::new(false);
    let is_open = |net: &Net| {
        let is_sealed = net.doors.is_empty() && net.joined(drawing.width) < CONNECTED;
        was_sealed.set(was_sealed.get() || is_sealed);
        !is_sealed
    };
    let sought = |is_it: &dyn Fn(&Net) -> bool| net_of_walls(drawing, inks, hints, metres_per_pixel, is_it);
    sought(&is_open).or_else(|| was_sealed.get().then(|| sought(&|_| true)).flatten())
}

/// Finds the walls, as `is_it` says: thick ones, else outlines, else hatched ones, else both, else massive ones, else single
/// lines.
fn net_of_walls(
    drawing: &Drawing,
    [ink, all_ink]: [&[u8]; 2],
    hints: Hints,
    metres_per_pixel: f64,
    is_it: &dyn Fn(&Net) -> bool,
) -> Option<Net> {
    let (dark, width) = (&drawing.dark, drawing.width);
    let mut strokes = lettering::without(ink, width, metres_per_pixel);
    // The two lines of a frame are no hollow wall.
    border::drop(&mut strokes, ink, width, metres_per_pixel);
    border::drop_fine(&mut strokes, ink, width, metres_per_pixel);
    let is_dark = |at: usize| is_on(dark, at);
    // Fills of grey walls ring beside black outlines, and are a little lighter than the threshold there. Treads and rails of
    // stairs that are as light have dark on one side at most.
    let is_ring = |at: usize| lies_between(dark, width, at, RING_PX);
    let surely =
        |at: usize| strokes[at] & u8::from(drawing.lightness[at] < drawing.surely_dark && (is_dark(at) || is_ring(at)));
    let core: Vec<u8> = (0..dark.len()).map(surely).collect();
    let usual = |thickest: usize| Sought {
        thickest,
        widest_m: WIDEST_DOOR_M,
        is_massive: false,
        stroke_px: 0,
        is_framed: true,
        hints,
    };
    let net_in = |ink: &[u8], core: &[u8], filled: &[u8], sought: &Sought| {
        let net = Net::find(core, filled, dark, ink, width, metres_per_pixel, sought)?;
        (net.is_building() && is_it(&net)).then_some(net)
    };
    let net_of = |core: &[u8], filled: &[u8], thickest: usize| net_in(ink, core, filled, &usual(thickest));
    let px = |metres: f64| ((metres / metres_per_pixel).round() as usize).max(4);
    let thickest = px(THICKEST_WALL_M);
    let wide = |core: &[u8], filled: &[u8], sought: &Sought| {
        net_in(ink, core, filled, &Sought { widest_m: WIDEST_ENTRANCE_M, ..*sought })
    };
    // Rooms that nothing joins lie along a corridor that is open at its ends.
    let find = |core: &[u8], filled: &[u8], stroke_px: usize| {
        let sought = Sought { stroke_px, ..usual(thickest) };
        let found = net_in(ink, core, filled, &sought)?;
        let joined = found.joined(width);
        let wide = if joined < CONNECTED { wide(core, filled, &sought) } else { None };
        Some(wide.filter(|wide| wide.joined(width) > joined).unwrap_or(found))
    };
    // Where many doors lead into a place that only a wide entrance leaves open, it is a hall.
    let with_hall = |found: Net| {
        let ways_out = found.ways_out();
        let wide = if ways_out >= MANY_WAYS_OUT { wide(&core, dark, &usual(thickest)) } else { None };
        let has_hall = |wide: &Net| {
            wide.ways_out() + FEWER_WAYS_OUT <= ways_out && wide.inside_px() >= HALL_SHARE * found.inside_px()
        };
        wide.filter(has_hall).unwrap_or(found)
    };
    let without = |coloured: &[u8]| -> Vec<u8> {
        let coloured: Vec<u8> = strokes.iter().zip(coloured).map(|(stroke, coloured)| stroke & coloured).collect();
        let soft = thick::grow(&coloured, width, 1);
        let is_plain = |at: usize| coloured[at] == 0 && (soft[at] == 0 || core[at] != 0);
        let plain: Vec<u8> = (0..strokes.len()).map(|at| strokes[at] & u8::from(is_plain(at))).collect();
        // Lines go on where one of another colour crosses them.
        let is_crossed = |at: usize| strokes[at] != 0 && lies_between(&plain, width, at, CROSSED_PX);
        (0..strokes.len()).map(|at| plain[at] | u8::from(is_crossed(at))).collect()
    };
    let closed = |net: &Net| net.inside_px() * net.joined(width);
    let filled = || {
        let of = |strokes: &[u8]| filled::net([strokes, &core], width, metres_per_pixel, drawing.clean, find);
        let of_all = of(&strokes)?;
        if !hints.bars.contains(&1) {
            return Some(of_all);
        }
        // Furniture and doors of another colour than walls are no walls, however they are outlined.
        let of_plain = of(&without(hints.bars)).filter(|net| closed(net) >= AS_CLOSED * closed(&of_all));
        Some(of_plain.unwrap_or(of_all))
    };
    if let Some(net) = find(&core, dark, 0).map(with_hall) {
        // Of hollow walls beside massive ones, the outlines alone were found.
        let of_filled = if net.joined(width) < CONNECTED {
            filled().filter(|filled| filled.joined(width) >= CONNECTED)
        } else if hollow::are_outlines(&net.wall, &strokes, width, metres_per_pixel) {
            filled().filter(|filled| closed(filled) >= closed(&net))
        } else {
            None
        };
        let net = of_filled.unwrap_or(net);
        let search =
            |core: &[u8], thickest: usize| net_in(all_ink, core, core, &Sought { is_framed: false, ..usual(thickest) });
        let strokes = if all_ink == ink { strokes } else { lettering::without(all_ink, width, metres_per_pixel) };
        return Some(partitions::added(net, &strokes, all_ink, width, metres_per_pixel, search));
    }
    if let Some(net) = filled() {
        return Some(net);
    }
    if let Some(net) = wide(&core, dark, &usual(thickest)) {
        return Some(net);
    }
    let massive = Sought { widest_m: WIDEST_PORTAL_M, is_massive: true, ..usual(px(MASSIVE_WALL_M)) };
    if let Some(net) = net_in(ink, &core, dark, &massive) {
        return Some(net);
    }
    // Doors and windows may be strokes of another colour over the walls' lines, with soft edges that look like lines.
    let is_coloured = |at: usize| is_on(&drawing.coloured, at) || is_on(&drawing.pane, at);
    let coloured: Vec<u8> = (0..strokes.len()).map(|at| u8::from(is_coloured(at))).collect();
    let of_lines = |strokes: &[u8], drawn: &[u8]| {
        let (lines, reach) = lines::thickened(strokes, ink, &[], width, metres_per_pixel);
        // Of lines a gap is as deep as they grew; a stub of wall across its end is no deeper end.
        let mut net = net_of(&lines, &lines, 3 * (2 * reach + 1))?;
        // The lines themselves are the walls.
        let near = thick::grow(&net.inside, width, reach);
        for at in 0..ink.len() {
            net.wall[at] &= drawn[at];
            net.inside[at] = near[at] & (1 - net.wall[at]);
        }
        for at in net.doors.iter().chain(&net.windows).flat_map(Gap::pixels) {
            net.inside[at] = 0;
        }
        Some(net)
    };
    if coloured.contains(&1) {
        let plain = without(&coloured);
        if let Some(net) = of_lines(&plain, &plain).filter(|net| net.joined(width) >= CONNECTED) {
            return Some(net);
        }
    }
    of_lines(&strokes, ink)
}

/// Whether a mask is on within `reach` pixels on both sides of a place, along its row or its column.
fn lies_between(mask: &[u8], width: usize, at: usize, reach: usize) -> bool {
    let is_near =
        |beside: fn(usize, usize) -> usize, step: usize| (1..=reach).any(|k| is_on(mask, beside(at, k * step)));
    [1, width].into_iter().any(|step| is_near(usize::wrapping_sub, step) && is_near(usize::wrapping_add, step))
}

/// Names strokes that are neither wall nor furniture: door symbols, lettering, frames, lines.
fn name_strokes(ink: &[u8], net: &Net, width: usize, metres_per_pixel: f64, classes: &mut [PlanClass]) {
    let mut rest: Vec<u8> =
        ink.iter().zip(classes.iter()).map(|(&i, &c)| u8::from(i != 0 && c == PlanClass::Floor)).collect();
    // The soft or rough edge of a wall joins no strokes.
    for ((rest, class), by_wall) in rest.iter_mut().zip(classes.iter_mut()).zip(thick::grow(&net.wall, width, 1)) {
        if by_wall != 0 && std::mem::take(rest) != 0 {
            *class = PlanClass::Dimension;
        }
    }
    let strokes = Components::of(&rest, width, 1, Neighbours::Eight);
    let beside_door = thick::grow(&gaps::mask(&net.doors, ink.len()), width, 2);
    let metres = |px: u32| f64::from(px) * metres_per_pixel;
    let image = [width as u32, (ink.len() / width) as u32];
    let mut letters = Vec::new();
    for stroke in &strokes.all {
        let [w, h] = stroke.size();
        let class = if w * 10 >= image[0] * 6 && h * 10 >= image[1] * 6 {
            PlanClass::Frame
        } else if metres(w.max(h)) <= 2.0 && strokes.touches(stroke, &beside_door, width) {
            PlanClass::Door
        } else {
            if metres(w.max(h)) <= LARGEST_LETTER_M {
                letters.push(stroke);
            }
            PlanClass::Dimension
        };
        strokes.paint(stroke, classes, width, class);
    }
    letters.retain(|stroke| !strokes.touches(stroke, &beside_door, width));
    for group in groups(&letters).into_iter().filter(|group| group.len() >= FEWEST_STROKES) {
        for stroke in group {
            strokes.paint(stroke, classes, width, PlanClass::Lettering);
        }
    }
}

/// Leaves in a drawing what stands in people's way, and the edges of walls as they were.
fn redraw(drawing: &mut Drawing, classes: &[PlanClass]) {
    let width = drawing.width;
    let solid: Vec<u8> = classes.iter().map(|class| u8::from(class.is_solid())).collect();
    let rim = thick::grow(&solid, width, 1);
    let beside = |at: usize| [at.wrapping_sub(1), at + 1, at.wrapping_sub(width), at + width];
    let at_edge = |at: usize| beside(at).iter().any(|&b| solid.get(b).is_some_and(|&s| s == 0));
    for (at, &class) in classes.iter().enumerate() {
        drawing.lightness[at] = match () {
            () if class == PlanClass::Wall && (drawing.dark[at] != 0 && at_edge(at)) => drawing.lightness[at],
            () if class.is_solid() => 0,
            () if rim[at] != 0 && class == PlanClass::Floor && drawing.dark[at] == 0 => drawing.lightness[at],
            () => 255,
        };
    }
    drawing.dark = solid;
    drawing.coloured = Vec::new();
}

impl Understood {
    /// Hands over to the plan what was found: doors, windows, furniture, and the classes of its floor and walls.
    pub(super) fn complete(self, plan: &mut FloorPlan) {
        let factor = self.factor as f64;
        let to_m = |plan: &FloorPlan, px: [f64; 2]| plan.px_to_m(px.map(|place| place * factor));
        let gap = |gap: &Gap, plan: &FloorPlan| gap.jambs().map(|jamb| to_m(plan, jamb));
        plan.doors = self
            .doors
            .iter()
            .map(|FoundDoor(door, kind, leaf)| {
                let [from_m, to] = gap(door, plan);
                let leaf_m = leaf.map(|ends| ends.map(|end| to_m(plan, end)));
                PlanDoor { from_m, to_m: to, kind: *kind, leaf_m }
            })
            .collect();
        plan.windows = self
            .windows
            .iter()
            .map(|window| {
                let [from_m, to_m] = gap(window, plan);
                PlanWindow { from_m, to_m }
            })
            .collect();
        plan.furniture = self.furniture.iter().map(|piece| furniture_piece(piece, self.factor, plan)).collect();
        let plain = plan.plain_classes();
        let class = |((plain, of_drawing), floor): ((PlanClass, PlanClass), u8)| match of_drawing {
            PlanClass::Floor => plain,
            PlanClass::Door | PlanClass::Stairs if floor == 0 => PlanClass::Outside,
            class => class,
        };
        let both = plain.into_iter().zip(self.classes).zip(plan.floor.iter().copied());
        plan.classes = both.map(class).collect();
    }
}

fn furniture_piece(piece: &Evidence, factor: usize, plan: &FloorPlan) -> FurniturePiece {
    let [x0, y0, x1, y1] = piece.around.map(|side| f64::from(side) * factor as f64);
    let (low, high) = (plan.px_to_m([x0, y1]), plan.px_to_m([x1, y0]));
    FurniturePiece {
        class: piece.class,
        min_m: low,
        max_m: high,
        area_m2: (piece.area * factor * factor) as f64 * plan.metres_per_pixel * plan.metres_per_pixel,
        height_m: piece.class.height_m(),
        at_wall: piece.at_wall,
    }
}
