//! From the shapes of a drawing to a floor plan, or to a picture where no layer is named after walls.

use image::{DynamicImage, RgbImage};

use super::area::{Area, Coverage, Grid};
use super::doors::{self, Opening, Solid};
use super::piece::{Piece, Stroke, VectorPlan, bounds_of};
use super::solid::{Curves, box_along, hull, shapes};
use super::unit::metres_per_unit;
use crate::math::{Rect, Vec2, vec2};
use crate::plan::{LARGEST_SIDE_M, LARGEST_SIDE_PX, PlanClass, PlanError, PlanScale, ScaleSource};

/// Side of a pixel, metres; coarser for large sites.
const FINEST_M: f64 = 0.02;
/// Most pixels of a plan.
const MOST_PIXELS: f64 = 24e6;
/// Most pixels of all shapes together, also of those that lie under others: a large plan 50 times.
const MOST_PAINTED_PIXELS: u64 = 50 * MOST_PIXELS as u64;
/// Longer side of a picture whose scale is not known, pixels.
const PICTURE_PX: f64 = 3000.0;
/// Paper around a building, metres: wider than any door, so that it is told from rooms.
const MARGIN_M: f64 = 2.5;
/// Tables up to this size are seats, metres.
const SEAT_M: f64 = 0.65;
/// Largest thing that is made of open lines, metres.
const LARGEST_THING_M: f64 = 5.0;
/// Lines of a thing are closer than this, metres.
const TOUCH_M: f64 = 0.03;

const NOWHERE: Rect = Rect { min: Vec2::ZERO, max: Vec2::ZERO };

/// What a drawing gives.
pub(super) enum Built {
    /// Walls, doors and furniture by the names of layers.
    Layers(Layers),
    /// A picture for the reader of pictures, and the metres of a pixel if they are known.
    Picture(DynamicImage, Option<(f64, PlanScale)>),
}

/// A plan by the names of its layers.
pub(in crate::plan) struct Layers {
    pub(in crate::plan) width: usize,
    pub(in crate::plan) height: usize,
    pub(in crate::plan) metres_per_pixel: f64,
    /// Where its size comes from.
    pub(in crate::plan) scale: PlanScale,
    /// Place of the plan's lower-left corner in the drawing's frame, metres.
    pub(in crate::plan) origin_m: Vec2,
    /// 0 where all is solid, 255 where nothing is.
    pub(in crate::plan) lightness: Vec<u8>,
    /// Class of each pixel; what is not drawn is floor.
    pub(in crate::plan) classes: Vec<PlanClass>,
    /// Jambs of doors, metres from the lower-left corner.
    pub(in crate::plan) doors: Vec<[Vec2; 2]>,
    pub(in crate::plan) lanes: Vec<[Vec2; 2]>,
}

/// Builds a plan from a drawing, with its warnings.
pub(super) fn build(
    mut plan: VectorPlan,
    given: Option<(f64, PlanScale)>,
    width_m: Option<f64>,
    warnings: &mut Vec<String>,
) -> Result<Built, PlanError> {
    let has_walls = plan.pieces.iter().any(|piece| piece.class == Some(PlanClass::Wall));
    let scale = match (given, width_m) {
        (Some(given), _) => Some(given),
        (None, Some(width_m)) if has_walls => of_width(&plan, width_m),
        // The reader of pictures finds the width of the building.
        (None, Some(_)) => None,
        (None, None) => {
            let (scale, warning) = metres_per_unit(&plan);
            warnings.extend(warning);
            scale
        }
    };
    if !has_walls {
        let layers = plan.unknown("; say what layers hold by `[plan] layers`: ");
        warnings.push(format!("no layer is named after walls: the drawing is read as a picture{layers}"));
        return picture(&plan, scale).map(|(image, scale)| Built::Picture(image, scale));
    }
    let Some((scale, told)) = scale else {
        warnings.push("no layer tells the scale: the drawing is read as a picture".to_owned());
        return picture(&plan, None).map(|(image, scale)| Built::Picture(image, scale));
    };
    let origin_m = to_metres(&mut plan, scale);
    let mut layers = layers(&plan, warnings)?;
    layers.origin_m += origin_m;
    // Of the drawing's units, as of the plan's pixels.
    layers.scale = told.scaled(layers.metres_per_pixel / scale);
    Ok(Built::Layers(layers))
}

/// The metres of a unit, from the width of the building.
fn of_width(plan: &VectorPlan, width_m: f64) -> Option<(f64, PlanScale)> {
    let is_of_building = |piece: &&Piece| matches!(piece.class, Some(PlanClass::Wall | PlanClass::Window));
    let bounds = bounds_of(plan.pieces.iter().filter(is_of_building).flat_map(Piece::points))?;
    let metres = width_m / bounds.width();
    metres.is_finite().then(|| (metres, PlanScale::known(ScaleSource::Width, metres)))
}

/// Turns units into metres, from a place in the building on: coordinates of surveyors leave few digits. Returns that
/// place in the drawing's frame.
fn to_metres(plan: &mut VectorPlan, scale: f64) -> Vec2 {
    let building = plan.pieces.iter().filter(|piece| piece.class == Some(PlanClass::Wall)).flat_map(Piece::points);
    let origin = bounds_of(building).map_or(Vec2::ZERO, |bounds| bounds.min);
    let place = |p: Vec2| (p - origin) * scale;
    for piece in &mut plan.pieces {
        piece.loops.iter_mut().flatten().for_each(|p| *p = place(*p));
        if let Some(Stroke { width, .. }) = &mut piece.stroke {
            *width *= scale;
        }
    }
    plan.lanes.iter_mut().flatten().for_each(|p| *p = place(*p));
    plan.bounds = plan.bounds.map(|b| Rect { min: place(b.min), max: place(b.max) });
    origin * scale
}

fn grid(bounds: Rect) -> Result<Grid, PlanError> {
    let (width_m, height_m) = (bounds.width(), bounds.height());
    let finest =
        |m: f64| width_m * height_m / (m * m) <= MOST_PIXELS && width_m.max(height_m) / m < f64::from(LARGEST_SIDE_PX);
    let steps = [FINEST_M, 0.025, 0.04, 0.05, 0.1, 0.2, 0.5, 1.0];
    let metres_per_pixel = steps.into_iter().find(|m| finest(*m)).unwrap_or(1.0);
    if width_m.max(height_m) > LARGEST_SIDE_M {
        return Err(PlanError::TooLarge { metres_per_pixel, width_m, height_m });
    }
    let px = |metres: f64| ((metres / metres_per_pixel - 1e-6).ceil() as usize).max(2);
    Ok(Grid { bounds, width: px(width_m), height: px(height_m), metres_per_pixel })
}

fn layers(plan: &VectorPlan, warnings: &mut Vec<String>) -> Result<Layers, PlanError> {
    let of = |class: PlanClass| plan.pieces.iter().filter(|p| p.class == Some(class)).collect::<Vec<&Piece>>();
    let (walls, windows) = (of(PlanClass::Wall), of(PlanClass::Window));
    // Before areas are made, whose coordinates have limits.
    grid(bounds_of(walls.iter().chain(&windows).flat_map(|piece| piece.points())).unwrap_or(NOWHERE))?;
    let (wall_shapes, window_shapes) = (shapes(&walls, Curves::Solid), shapes(&windows, Curves::LeftOut));
    let corners = || wall_shapes.iter().chain(&window_shapes).flatten().flatten().copied();
    let around = plan.bounds.or_else(|| bounds_of(corners()).map(|bounds| bounds.grown(MARGIN_M)));
    let bounds = around.unwrap_or(NOWHERE);
    let grid = grid(bounds)?;
    let mut wall = Area::union(wall_shapes);
    let mut window = Area::union(window_shapes);
    let doors = {
        let share = paint(&grid, solid(&wall, &window).loops().collect());
        doors::find(&of(PlanClass::Door), &Solid { grid, share: &share })
    };
    let walled = doors.iter().filter(|door| door.is_walled).map(|door| vec![door.area.clone()]);
    let gaps = Area::union(walled);
    if !gaps.is_empty() {
        (wall, window) = (wall.minus(&gaps), window.minus(&gaps));
    }
    let outlines: Vec<Vec<Vec2>> = solid(&wall, &window).loops().collect();
    let mut lightness: Vec<u8> = paint(&grid, outlines.clone());
    lightness.iter_mut().for_each(|l| *l = 255 - *l);
    let mut classes = vec![PlanClass::Floor; lightness.len()];
    let mut painted = Painted::default();
    let mut mark = |class: PlanClass, loops: Vec<Vec<Vec2>>, least: f32, over: &dyn Fn(PlanClass, u8) -> bool| {
        let loops: Vec<Vec<Vec2>> = loops.iter().map(|l| l.iter().map(|p| grid.px(*p)).collect()).collect();
        let coverage = painted.coverage(&loops, grid.width, grid.height)?;
        coverage.for_each(grid.width, |at, share| {
            if share >= least && over(classes[at], lightness[at]) {
                classes[at] = class;
                if class.is_furniture() {
                    lightness[at] = lightness[at].min(255 - (share * 255.0 + 0.5) as u8);
                }
            }
        });
        Ok::<(), PlanError>(())
    };
    for stairs in things(&of(PlanClass::Stairs)) {
        mark(PlanClass::Stairs, stairs.1, 0.5, &|_, _| true)?;
    }
    for (class, loops) in furniture(plan) {
        mark(class, loops, 0.02, &|_, light| light >= 128)?;
    }
    mark(PlanClass::Wall, outlines.clone(), 0.5, &|_, _| true)?;
    mark(PlanClass::Window, window.loops().collect(), 0.4, &|_, light| light < 128)?;
    for Opening { area, .. } in &doors {
        mark(PlanClass::Door, vec![area.clone()], 0.5, &|class, light| light >= 128 && !class.is_furniture())?;
    }
    let nameless = plan.pieces.iter().filter(|piece| piece.class.is_none()).count();
    if nameless > 0 {
        let layers = plan.unknown("; say what layers hold by `[plan] layers`: ");
        let shapes = if nameless == 1 { "shape" } else { "shapes" };
        warnings.push(format!("left out of layers that are named after nothing known: {nameless} {shapes}{layers}"));
    }
    let drawn_doors = of(PlanClass::Door).len();
    if drawn_doors > 0 && doors.is_empty() {
        warnings.push("none of the drawing's doors stands between two walls".to_owned());
    }
    let here = |p: Vec2| p - bounds.min;
    Ok(Layers {
        width: grid.width,
        height: grid.height,
        metres_per_pixel: grid.metres_per_pixel,
        scale: PlanScale::default(),
        origin_m: bounds.min,
        lightness,
        classes,
        doors: doors.iter().map(|door| door.jambs.map(here)).collect(),
        lanes: plan.lanes.iter().map(|lane| lane.map(here)).collect(),
    })
}

/// Walls and windows together.
fn solid(wall: &Area, window: &Area) -> Area {
    Area::union([wall.loops().collect::<Vec<_>>(), window.loops().collect()])
}

/// How much of each pixel loops cover, 0 to 255.
fn paint(grid: &Grid, loops: Vec<Vec<Vec2>>) -> Vec<u8> {
    let loops: Vec<Vec<Vec2>> = loops.into_iter().map(|l| l.into_iter().map(|p| grid.px(p)).collect()).collect();
    let mut painted = vec![0; grid.width * grid.height];
    Coverage::of(&loops, grid.width, grid.height)
        .for_each(grid.width, |at, share| painted[at] = (share * 255.0 + 0.5) as u8);
    painted
}

/// Furniture and fixtures: the class of each thing and its outline.
fn furniture(plan: &VectorPlan) -> Vec<(PlanClass, Vec<Vec<Vec2>>)> {
    let pieces: Vec<&Piece> = plan.pieces.iter().filter(|p| p.class.is_some_and(PlanClass::is_furniture)).collect();
    let things = things(&pieces).into_iter().map(|(class, loops)| {
        let size = bounds_of(loops.iter().flatten().copied()).map_or(0.0, |b| b.width().max(b.height()));
        let class = if class == PlanClass::Table && size <= SEAT_M { PlanClass::Seat } else { class };
        (class, loops)
    });
    things.collect()
}

/// Things that pieces show: closed shapes as they are; open lines that touch, or are of a block, by their hull.
fn things(pieces: &[&Piece]) -> Vec<(PlanClass, Vec<Vec<Vec2>>)> {
    let mut things = Vec::new();
    let mut open: Vec<&Piece> = Vec::new();
    for piece in pieces {
        match piece.class {
            Some(class) if piece.closed => {
                things.extend(Area::union([piece.loops.clone()]).loops().map(|l| (class, vec![l])));
            }
            Some(_) => open.push(piece),
            None => {}
        }
    }
    // Pieces whose boxes touch belong together; the first of each thing leads.
    let boxes: Vec<Rect> = open.iter().map(|piece| piece.bounds().grown(TOUCH_M * 0.5)).collect();
    let mut leader: Vec<usize> = (0..open.len()).collect();
    let mut order: Vec<usize> = (0..open.len()).collect();
    order.sort_by(|a, b| boxes[*a].min.x.total_cmp(&boxes[*b].min.x).then(a.cmp(b)));
    fn find(leader: &mut [usize], mut k: usize) -> usize {
        while leader[k] != k {
            leader[k] = leader[leader[k]];
            k = leader[k];
        }
        k
    }
    for (n, &a) in order.iter().enumerate() {
        let beside = order[n + 1..].iter().take_while(|b| boxes[**b].min.x <= boxes[a].max.x).take(2000);
        for &b in beside {
            let together = open[a].group != 0 && open[a].group == open[b].group;
            let small = boxes[a].width().max(boxes[a].height()) < LARGEST_THING_M;
            if (together || (small && boxes[a].overlaps(boxes[b]))) && open[a].class == open[b].class {
                let (a, b) = (find(&mut leader, a), find(&mut leader, b));
                leader[a.max(b)] = a.min(b);
            }
        }
    }
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); open.len()];
    for k in 0..open.len() {
        let first = find(&mut leader, k);
        members[first].push(k);
    }
    for members in members.into_iter().filter(|members| !members.is_empty()) {
        let around = hull(members.iter().flat_map(|&k| open[k].points()));
        let size = bounds_of(around.iter().copied()).map_or(0.0, |b| b.width().max(b.height()));
        if let Some(class) = open[members[0]].class
            && around.len() > 2
            && size <= LARGEST_THING_M
        {
            things.push((class, vec![around]));
        }
    }
    things
}

/// Draws all shapes in their colours on white paper. Returns the metres of a pixel if those of a unit are known.
fn picture(
    plan: &VectorPlan,
    scale: Option<(f64, PlanScale)>,
) -> Result<(DynamicImage, Option<(f64, PlanScale)>), PlanError> {
    let points = plan.pieces.iter().flat_map(|piece| piece.points());
    let drawn = plan.bounds.or_else(|| bounds_of(points)).unwrap_or(Rect::around(Vec2::ZERO, vec2(1.0, 1.0)));
    let side = drawn.width().max(drawn.height()).max(1e-9);
    let bounds = drawn.grown(0.02 * side);
    let area = bounds.width() * bounds.height();
    let usual = scale.as_ref().map_or(side / PICTURE_PX, |(scale, _)| FINEST_M / scale);
    // Neither beyond the limits nor a picture of a few pixels.
    let units_per_px =
        usual.max((area / MOST_PIXELS).sqrt()).max(side / f64::from(LARGEST_SIDE_PX) * 1.1).min(side / 300.0);
    let size = |length: f64| (length / units_per_px).ceil().max(2.0) as usize;
    let grid =
        Grid { bounds, width: size(bounds.width()), height: size(bounds.height()), metres_per_pixel: units_per_px };
    let mut image = RgbImage::from_pixel(grid.width as u32, grid.height as u32, image::Rgb([255; 3]));
    let px =
        |loops: &[Vec<Vec2>]| loops.iter().map(|l| l.iter().map(|p| grid.px(*p)).collect()).collect::<Vec<Vec<Vec2>>>();
    let mut painted = Painted::default();
    for piece in &plan.pieces {
        if let Some(colour) = piece.fill {
            let area: Vec<Vec<Vec2>> = Area::union([px(&piece.loops)]).loops().collect();
            blend(&mut image, &area, colour, &mut painted)?;
        }
        if let Some(Stroke { width, colour }) = piece.stroke {
            // Thinner lines than a pixel and a half fade.
            let half = 0.5 * width.max(1.5 * units_per_px);
            for [a, b] in piece.segments() {
                let out = (b - a).normalized().unwrap_or(vec2(1.0, 0.0)) * (half * 0.5);
                blend(&mut image, &px(&[box_along(a - out, b + out, half)]), colour, &mut painted)?;
            }
        }
    }
    Ok((DynamicImage::ImageRgb8(image), scale.map(|(scale, told)| (scale * units_per_px, told.scaled(units_per_px)))))
}

/// Lays a colour over what loops in pixels cover.
fn blend(image: &mut RgbImage, loops: &[Vec<Vec2>], colour: [u8; 3], painted: &mut Painted) -> Result<(), PlanError> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let bytes: &mut [u8] = image;
    painted.coverage(loops, width, height)?.for_each(width, |at, share| {
        for (channel, new) in bytes[3 * at..][..3].iter_mut().zip(colour) {
            let old = f32::from(*channel);
            *channel = (old + (f32::from(new) - old) * share + 0.5) as u8;
        }
    });
    Ok(())
}

/// Counts the pixels of all shapes that are painted, one over the other.
#[derive(Default)]
struct Painted {
    pixels: u64,
}

impl Painted {
    fn coverage(&mut self, loops: &[Vec<Vec2>], width: usize, height: usize) -> Result<Coverage, PlanError> {
        let coverage = Coverage::of(loops, width, height);
        self.pixels += coverage.pixels() as u64;
        let times = self.pixels / (width * height).max(1) as u64;
        if self.pixels > MOST_PAINTED_PIXELS { Err(PlanError::PaintedOver { times }) } else { Ok(coverage) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_that_lie_over_each_other_without_end_are_refused() {
        let square = [vec![vec2(0.0, 0.0), vec2(10.0, 0.0), vec2(10.0, 10.0), vec2(0.0, 10.0)]];
        let mut painted = Painted { pixels: MOST_PAINTED_PIXELS - 150 };
        assert!(painted.coverage(&square, 20, 20).is_ok());
        let error = painted.coverage(&square, 20, 20).map(|_| ()).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the shapes of the drawing lie over each other: they cover it more than 3000000 times"
        );
        assert!(error.hint().unwrap().contains("as a picture"));
    }
}
