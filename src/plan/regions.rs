//! Decides which white regions are floor.

use super::clearance::{dilate, erode};
use super::components::{Components, Neighbours};
use super::spaces::{Spaces, split};
use super::understand::Understood;
use super::{FloorPlan, NARROWEST_OPENING_M, PlanClass, PlanError, Region, RegionRole, depths};
use crate::math::Vec2;

/// Share of its area that other spaces need for a space with an image corner to be outside.
const BUILDING_SHARE: f64 = 0.3;
/// Greatest widths of doors between the building and the paper around it, metres: those of most buildings, then those
/// of halls, if without them no building is told from the paper. With each goes the least share of the image's sides that
/// the paper covers: behind wide gaps lies a building only if the paper is all around it.
const WIDEST_DOORS_M: [(f64, f64); 3] = [(2.0, 0.5), (3.5, 0.95), (5.0, 0.95)];
/// The least share where the paper has to be thought on beyond the image.
const CROPPED_SHARE: f64 = 0.95;
/// Most of a building's outline that may be doors there: a place between pillars is open nearly all around.
const OPEN_SHARE: f64 = 0.25;
/// Least area of a building beside the largest, with doors of its own, square metres.
const LEAST_BUILDING_M2: f64 = 4.0;
/// Least number of the image's corners that the paper covers.
const PAPER_CORNERS: usize = 3;
/// Least area of white too narrow for a person to be listed, square metres.
const LEAST_LISTED_M2: f64 = 0.1;

/// Fills in `floor` and `regions` of a plan whose `floor` holds all white.
///
/// Spaces are found for a person of `narrowest_m`. Floor are the spaces with a point of `seeds`. Without seeds, floor
/// are the spaces that are not outside and have at least two openings, or if there are none, the largest; and others
/// with a door to the paper around, or with stairs, as upper floors on the same sheet have them.
///
/// Where the drawing is understood, the paper around the building is known already.
pub(super) fn choose(
    plan: &mut FloorPlan,
    narrowest_m: f64,
    seeds: &[Vec2],
    understood: Option<&Understood>,
) -> Result<(), PlanError> {
    let width = plan.width_px as usize;
    let in_px = |metres: f64| metres / plan.metres_per_pixel;
    let (person_px, opening_px) = (in_px(narrowest_m), in_px(NARROWEST_OPENING_M));
    let mut white = std::mem::take(&mut plan.floor);
    let mut spaces = split(&white, width, person_px, opening_px);
    if spaces.all.is_empty() {
        return Err(PlanError::NoRoom {
            narrowest_m,
            metres_per_pixel: plan.metres_per_pixel,
            width_m: plan.width_m(),
            height_m: plan.height_m(),
        });
    }
    let mut paper = None;
    // With the width of the widest door, where that has told the paper.
    let cut: Option<(Vec<u8>, f64)> = match understood {
        Some(Understood { outside, .. }) => Some((outside.iter().zip(&white).map(|(&o, &w)| o & w).collect(), 0.0)),
        None => {
            let find = |door_m: f64, share: f64, goes_on: bool| {
                let door_px = in_px(door_m);
                paper_around(&white, &spaces, width, door_px, share, goes_on).map(|paper| (paper, door_px))
            };
            let within = || WIDEST_DOORS_M.into_iter().find_map(|(door_m, share)| find(door_m, share, false));
            // A picture that is cropped near the walls has no place for a disc as wide as a door.
            let is_cropped = || !plan.scanned && seeds.is_empty() && white_sides(&white, width) >= CROPPED_SHARE;
            let beyond = || WIDEST_DOORS_M.into_iter().find_map(|(door_m, _)| find(door_m, CROPPED_SHARE, true));
            within().or_else(|| is_cropped().then(beyond).flatten())
        }
    };
    let mut is_entered = Vec::new();
    if let Some((cut, door_px)) = cut {
        let seed_outside = seeds.iter().any(|&p| pixel_of(plan, p).is_some_and(|at| cut[at] != 0));
        if !seed_outside {
            for (white, &outside) in white.iter_mut().zip(&cut) {
                *white &= 1 - outside;
            }
            spaces = split(&white, width, person_px, opening_px);
            if !plan.scanned && seeds.is_empty() {
                let least_px = LEAST_BUILDING_M2 / (plan.metres_per_pixel * plan.metres_per_pixel);
                is_entered = entered(&white, &spaces, &cut, width, door_px);
                let classes = understood.map_or(&[][..], |understood| &understood.classes);
                for (&number, _) in spaces.label.iter().zip(classes).filter(|(_, class)| **class == PlanClass::Stairs) {
                    if number > 0 {
                        is_entered[usize::from(number) - 1] = true;
                    }
                }
                is_entered.iter_mut().zip(&spaces.all).for_each(|(is, space)| *is &= space.area as f64 >= least_px);
            }
            paper = Some(cut);
        }
    }
    let mut roles = if seeds.is_empty() { roles_by_shape(&spaces) } else { roles_by_seeds(plan, &spaces, seeds)? };
    for (role, _) in roles.iter_mut().zip(is_entered).filter(|(role, is)| *is && **role == RegionRole::Unreached) {
        *role = RegionRole::Floor;
    }
    plan.regions = list(plan, &spaces, &roles, &mut white, paper.as_deref());
    let is_floor = |n: u16| n > 0 && roles[usize::from(n) - 1] == RegionRole::Floor;
    white.iter_mut().zip(&spaces.label).for_each(|(pixel, &n)| *pixel = u8::from(is_floor(n)));
    plan.floor = white;
    Ok(())
}

/// Lists the 4-connected regions of a floor mask, largest first, all of them floor.
pub(super) fn of_mask(plan: &FloorPlan) -> Vec<Region> {
    let mut white = plan.floor.clone();
    let spaces = split(&white, plan.width_px as usize, 1.0, 1.0);
    let roles = vec![RegionRole::Floor; spaces.all.len()];
    list(plan, &spaces, &roles, &mut white, None)
}

/// Finds the paper around a building, if doors connect the building to it.
///
/// The paper is the white that a disc as wide as a wide door reaches from the image's corners. It must cover three
/// corners and at least a share of the image's sides, and leave a building of at least 0.3 of its area. Where the paper
/// `goes_on`, the disc may come from beyond the image.
fn paper_around(
    white: &[u8],
    spaces: &Spaces,
    width: usize,
    door_px: f64,
    share: f64,
    goes_on: bool,
) -> Option<Vec<u8>> {
    let height = white.len() / width;
    if !spaces.all.iter().any(|s| s.corners > 0) {
        return None;
    }
    let radius = (door_px * 0.5).max(1.0);
    let paper = if goes_on {
        let margin = radius.ceil() as usize + 1;
        let wider = width + 2 * margin;
        let mut large = vec![1u8; wider * (height + 2 * margin)];
        let start = |y: usize| (y + margin) * wider + margin;
        white.chunks_exact(width).enumerate().for_each(|(y, row)| large[start(y)..][..width].copy_from_slice(row));
        let paper = from_corners(&large, wider, radius);
        (0..height).flat_map(|y| paper[start(y)..][..width].iter().copied()).collect()
    } else {
        from_corners(white, width, radius)
    };
    let area = paper.iter().filter(|&&p| p != 0).count();
    let corners = [0, width - 1, (height - 1) * width, height * width - 1];
    let on_sides = (0..paper.len()).filter(|&at| {
        let (x, y) = (at % width, at / width);
        paper[at] != 0 && (x == 0 || x == width - 1 || y == 0 || y == height - 1)
    });
    if corners.iter().filter(|&&at| paper[at] != 0).count() < PAPER_CORNERS
        || (on_sides.count() as f64) < share * (2 * (width + height)) as f64
    {
        return None;
    }
    // The building: the largest remaining piece of the white connected to the paper, and all separate spaces.
    let mut touched = vec![false; spaces.all.len()];
    for (at, &number) in spaces.label.iter().enumerate() {
        if number > 0 && paper[at] != 0 {
            touched[number as usize - 1] = true;
        }
    }
    let is_left = |at: usize| paper[at] == 0 && spaces.label[at] > 0 && touched[spaces.label[at] as usize - 1];
    let left: Vec<u8> = (0..white.len()).map(|at| u8::from(is_left(at))).collect();
    if goes_on && open_share(white, &paper, &left, width) > OPEN_SHARE {
        return None;
    }
    let largest = Components::of(&left, width, 1, Neighbours::Four).all.iter().map(|p| p.area).max().unwrap_or(0);
    let apart: usize =
        spaces.all.iter().zip(&touched).filter(|(s, t)| s.corners == 0 && !**t).map(|(s, _)| s.area).sum();
    (largest > 0 && (largest + apart) as f64 >= BUILDING_SHARE * area as f64).then_some(paper)
}

/// The white that a disc reaches from the image's corners.
fn from_corners(white: &[u8], width: usize, radius: f64) -> Vec<u8> {
    let height = white.len() / width;
    let wide = erode(white, width, radius);
    let pieces = Components::of(&wide, width, 1, Neighbours::Four);
    drop(wide);
    let mut core = vec![0u8; white.len()];
    let corner = |x: u32, y: u32| (x == 0 || x == width as u32 - 1) && (y == 0 || y == height as u32 - 1);
    for piece in &pieces.all {
        let holds_corner = pieces.runs(piece).iter().any(|r| corner(r.from, r.y) || corner(r.to - 1, r.y));
        if holds_corner {
            pieces.paint(piece, &mut core, width, 1);
        }
    }
    let mut reached = dilate(&core, width, radius);
    for (reached, &white) in reached.iter_mut().zip(white) {
        *reached &= white;
    }
    reached
}

/// Share of the paper's inner edge behind which the white goes on into the building.
fn open_share(white: &[u8], paper: &[u8], building: &[u8], width: usize) -> f64 {
    let (mut open, mut closed) = (0usize, 0usize);
    let mut beside = |a: usize, b: usize| {
        if (paper[a] != 0) != (paper[b] != 0) {
            let other = if paper[a] != 0 { b } else { a };
            open += usize::from(building[other] != 0);
            closed += usize::from(white[other] == 0);
        }
    };
    for at in 0..white.len() {
        if at % width + 1 < width {
            beside(at, at + 1);
        }
        if at + width < white.len() {
            beside(at, at + width);
        }
    }
    open as f64 / (open + closed).max(1) as f64
}

/// Share of the image's sides that is white.
fn white_sides(white: &[u8], width: usize) -> f64 {
    let height = white.len() / width;
    let level = [0, height - 1].into_iter().flat_map(|y| (0..width).map(move |x| y * width + x));
    let upright = [0, width - 1].into_iter().flat_map(|x| (0..height).map(move |y| y * width + x));
    level.chain(upright).filter(|&at| white[at] != 0).count() as f64 / (2 * (width + height)) as f64
}

/// Which spaces have a door to the paper, and room for a disc as wide as a door: the disc has not come in from the paper.
/// What is only too narrow for it lies between buildings.
fn entered(white: &[u8], spaces: &Spaces, paper: &[u8], width: usize, door_px: f64) -> Vec<bool> {
    let roomy = erode(white, width, (door_px * 0.5).max(1.0));
    let [mut has_door, mut is_roomy] = [(); 2].map(|()| vec![false; spaces.all.len()]);
    for (at, &number) in spaces.label.iter().enumerate().filter(|(_, number)| **number > 0) {
        let space = usize::from(number) - 1;
        is_roomy[space] |= roomy[at] != 0;
        let x = at % width;
        let beside = [(x > 0).then(|| at - 1), (x + 1 < width).then_some(at + 1)];
        let across = [at.checked_sub(width), Some(at + width).filter(|at| *at < paper.len())];
        has_door[space] |= beside.into_iter().chain(across).flatten().any(|at| paper[at] != 0);
    }
    has_door.into_iter().zip(is_roomy).map(|(door, roomy)| door && roomy).collect()
}

fn roles_by_shape(spaces: &Spaces) -> Vec<RegionRole> {
    let all = &spaces.all;
    let inner_area: usize = all.iter().filter(|s| s.corners == 0).map(|s| s.area).sum();
    let passage = all.iter().any(|s| s.corners == 0 && s.openings >= 2);
    let is_outside = |k: usize| {
        all[k].corners > 0 && inner_area > 0 && (passage || inner_area as f64 >= BUILDING_SHARE * all[k].area as f64)
    };
    let inside: Vec<usize> = (0..all.len()).filter(|&k| !is_outside(k)).collect();
    let passages: Vec<usize> = inside.iter().copied().filter(|&k| all[k].openings_and_corners >= 2).collect();
    let largest = inside.iter().copied().max_by_key(|&k| (all[k].area, std::cmp::Reverse(k)));
    let mut roles: Vec<RegionRole> =
        (0..all.len()).map(|k| if is_outside(k) { RegionRole::Outside } else { RegionRole::Unreached }).collect();
    for k in if passages.is_empty() { largest.into_iter().collect() } else { passages } {
        roles[k] = RegionRole::Floor;
    }
    roles
}

fn roles_by_seeds(plan: &FloorPlan, spaces: &Spaces, seeds: &[Vec2]) -> Result<Vec<RegionRole>, PlanError> {
    let mut roles = vec![RegionRole::Unreached; spaces.all.len()];
    for &point_m in seeds {
        let at = pixel_of(plan, point_m);
        match at.map(|at| spaces.label[at]) {
            Some(number) if number > 0 => roles[number as usize - 1] = RegionRole::Floor,
            other => {
                let where_ = match other {
                    None => "lies beyond the image".to_owned(),
                    Some(_) => "lies in a wall, or where nobody can stand".to_owned(),
                };
                return Err(PlanError::SeedNotFloor {
                    point_m,
                    where_,
                    nearest_m: nearest_space(plan, spaces, point_m),
                });
            }
        }
    }
    Ok(roles)
}

pub(super) fn pixel_of(plan: &FloorPlan, p: Vec2) -> Option<usize> {
    let [x, y] = plan.m_to_px(p);
    let within = x >= 0.0 && y >= 0.0 && x < f64::from(plan.width_px) && y < f64::from(plan.height_px);
    within.then(|| y as usize * plan.width_px as usize + x as usize)
}

/// Returns the centre of the pixel nearest to a point that belongs to a space.
fn nearest_space(plan: &FloorPlan, spaces: &Spaces, p: Vec2) -> Option<Vec2> {
    let width = plan.width_px as usize;
    let middle = |at: usize| plan.px_to_m([(at % width) as f64 + 0.5, (at / width) as f64 + 0.5]);
    (0..spaces.label.len())
        .filter(|&at| spaces.label[at] > 0)
        .map(middle)
        .min_by(|a, b| (*a - p).length_squared().total_cmp(&(*b - p).length_squared()))
}

/// All regions, largest first. Leaves of `white` what belongs to no space.
pub(super) fn list(
    plan: &FloorPlan,
    spaces: &Spaces,
    roles: &[RegionRole],
    white: &mut [u8],
    paper: Option<&[u8]>,
) -> Vec<Region> {
    let width = plan.width_px as usize;
    let pixel_m2 = plan.metres_per_pixel * plan.metres_per_pixel;
    let region = |area: usize, inside: usize, role: RegionRole| Region {
        area_m2: area as f64 * pixel_m2,
        inside_m: plan.px_to_m([(inside % width) as f64 + 0.5, (inside / width) as f64 + 0.5]),
        role,
    };
    let deepest = depths::deepest(white, width, &spaces.label, spaces.all.len());
    let mut regions: Vec<Region> = (0..roles.len()).map(|k| region(spaces.all[k].area, deepest[k], roles[k])).collect();
    // White in which nobody can stand, and the paper.
    white.iter_mut().zip(&spaces.label).for_each(|(white, &n)| *white = u8::from(n == 0 && *white != 0));
    for (mask, role) in [(Some(&*white), RegionRole::Unreached), (paper, RegionRole::Outside)] {
        let Some(mask) = mask else { continue };
        let pieces = Components::of(mask, width, 1, Neighbours::Four);
        for piece in pieces.all.iter().filter(|p| p.area as f64 * pixel_m2 >= LEAST_LISTED_M2) {
            let run = pieces.runs(piece)[pieces.runs(piece).len() / 2];
            regions.push(region(piece.area, run.y as usize * width + (run.from + run.to) as usize / 2, role));
        }
    }
    regions.sort_by(|a, b| b.area_m2.total_cmp(&a.area_m2));
    regions
}
