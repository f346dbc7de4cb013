//! Finds default cameras: from above and at eye level.

use rayon::prelude::*;

use super::footfalls::{CELL_M, FootfallGrid};
use super::lens::Lens;
use super::ray_grid::{QuadKind, RayGrid, WallQuad};
use super::trace::HitSurface;
use crate::export::{Camera, DEFAULT_FOV_DEG};
use crate::math::{Vec2, sin_cos, vec2};

/// Eye height of a standing person, metres.
const EYES_M: f64 = 1.7;
/// Least distance of a camera from walls, metres.
const CLEAR_M: f64 = 0.5;
/// Downward from level, degrees: floor fills most of the picture, its detail begins 2.8 m away.
const EYE_PITCH_DEG: f64 = -12.0;
/// The same on open ground, where only sky is above the horizon.
const OPEN_PITCH_DEG: f64 = -20.0;
/// Headings that are tried.
const HEADINGS: usize = 24;
/// Most places that are tried.
const MOST_PLACES: usize = 500;
/// How steeply one looks down on the whole plan, degrees, and through which lens.
const BIRD_PITCH_DEG: f64 = -50.0;
const BIRD_FOV_DEG: f64 = 30.0;

/// A look along the plan, as it is judged.
const GLANCES: usize = 17;
/// Rows of the picture in which the floor is looked at, between its lower side and the horizon.
const FLOOR_ROWS: usize = 10;
/// Slope downward of the picture's lower side at [`EYE_PITCH_DEG`], at sixteen to nine: rise over run.
const LOWEST_SLOPE: f64 = 0.610;
/// Slope of its upper side, upward.
const HIGHEST_SLOPE: f64 = 0.129;
/// So many views are looked at as pictures, of this size, with so many columns for depth.
const MOST_PICTURES: usize = 240;
const PICTURE_PX: [u32; 2] = [32, 18];
const COLUMNS: usize = 20;
/// Columns that end nearer than this are half blocked, metres.
const HALF_WAY_M: f64 = 4.2;
/// What is nearer than this stands in the way, metres, and doors and furniture that are farther make a picture richer.
const NEAR_M: f32 = 2.5;
/// How far before a wall people walk who touch it, metres.
const TOUCH_M: f64 = 0.4;
/// Share of the picture that door leaves may take: more hides the room.
const LEAF_SHARE: f64 = 0.02;
/// Share of the picture that should be floor, and way to the wall that should be ahead, metres.
const FLOOR_SHARE: f64 = 0.35;
const DEPTH_M: f64 = 8.0;
/// How far aside of a place its neighbour is looked at: a lane and its margin, metres.
const ASIDE_M: f64 = 0.8;
/// Doors count between these distances, metres.
const DOORS_M: [f64; 2] = [2.5, 10.0];
/// Cameras keep as far away from where the plan ends, metres: daylight would be all that is seen.
const INDOORS_M: f64 = 6.0;
/// Openings that are seen from nearer than this are too bright, metres.
const BRIGHT_M: f64 = 16.0;

impl RayGrid {
    /// The eye-level camera with the best view: trodden floor with margins, depth, walls on both sides.
    pub(crate) fn eye_level(&self, traffic: &FootfallGrid) -> Camera {
        let (places, doors) = (self.standing_places(traffic), self.doors());
        let judged: Vec<(f64, Vec2, f64)> = places
            .par_iter()
            .map(|&place| {
                let views = (0..HEADINGS).map(|k| {
                    let heading_deg = k as f64 * 360.0 / HEADINGS as f64;
                    (self.judge(place, heading_deg, traffic, &doors), place, heading_deg)
                });
                views.fold((f64::NEG_INFINITY, place, 0.0), |best, view| if view.0 > best.0 { view } else { best })
            })
            .collect();
        let height_m = if self.is_open() { EYES_M } else { EYES_M.min(self.height_m - 0.2) };
        let camera = |&(_, place, heading_deg): &(f64, Vec2, f64)| Camera {
            position_m: [place.x, place.y, height_m],
            heading_deg,
            pitch_deg: if self.is_open() { OPEN_PITCH_DEG } else { EYE_PITCH_DEG },
            fov_deg: DEFAULT_FOV_DEG,
        };
        let mut best = judged;
        best.sort_by(|a, b| b.0.total_cmp(&a.0));
        best.truncate(if self.is_open() { 1 } else { MOST_PICTURES });
        let cameras: Vec<Camera> = best.iter().map(camera).collect();
        let scores: Vec<f64> = cameras.par_iter().map(|camera| self.picture_score(camera, traffic)).collect();
        let best = cameras.into_iter().zip(scores).reduce(|best, other| if other.1 > best.1 { other } else { best });
        best.map_or_else(|| camera(&(0.0, self.block.centre(), 0.0)), |(camera, _)| camera)
    }

    /// Score of a camera by a small picture of what it sees: trodden floor with margins, walls that people brush, depth,
    /// gates, doors and furniture; nothing near in the way, no large door leaf.
    fn picture_score(&self, camera: &Camera, traffic: &FootfallGrid) -> f64 {
        let lens = Lens::of(camera, PICTURE_PX);
        let [width, height] = PICTURE_PX.map(|px| px as usize);
        let all = (width * height) as f64;
        let (mut floor, mut trodden, mut squared) = (0.0, 0.0, 0.0);
        let (mut near, mut outside, mut things, mut leaves, mut touched) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for k in 0..width * height {
            let hit = self.trace_inside(lens.position, lens.ray((k % width) as f64 + 0.5, (k / width) as f64 + 0.5));
            let beyond = hit.beyond_m > 0.0;
            match hit.surface {
                _ if beyond => outside += if self.roofed { 1.0 } else { 0.0 },
                HitSurface::Floor => {
                    let here = f64::from(traffic.at(vec2(f64::from(hit.point[0]), f64::from(hit.point[1]))));
                    (floor, trodden, squared) = (floor + 1.0, trodden + here, squared + here * here);
                }
                HitSurface::Fitting(number, _) if self.fittings.all[number as usize].leaf.is_some() => leaves += 1.0,
                HitSurface::Fitting(..) | HitSurface::Lintel(_) | HitSurface::Soffit(_) if hit.way_m > NEAR_M => {
                    things += 1.0;
                }
                HitSurface::Wall(number) if hit.way_m > NEAR_M => {
                    let before = vec2(f64::from(hit.point[0]), f64::from(hit.point[1]))
                        + self.pieces[number as usize].normal() * TOUCH_M;
                    touched += f64::from(traffic.at(before));
                    things += if self.pieces[number as usize].height_m < EYES_M { 1.0 } else { 0.0 };
                }
                _ => {}
            }
            let is_near = !matches!(hit.surface, HitSurface::Floor | HitSurface::Ceiling) && hit.way_m < NEAR_M;
            near += if is_near { 1.0 } else { 0.0 };
        }
        // How far it is to what stands in the picture, by column.
        let level = |k: usize| {
            let [x, y, _] = lens.ray((k as f64 + 0.5) * PICTURE_PX[0] as f64 / COLUMNS as f64, 0.5 * height as f64);
            let toward = vec2(x, y).normalized().unwrap_or(vec2(1.0, 0.0));
            self.cast(camera.place_m(), toward, 45.0, |piece, _| {
                piece.bounds_room() || matches!(piece.what, QuadKind::Fitting(..)) && piece.height_m > EYES_M
            })
            .map_or(45.0, |met| met.way_m)
        };
        let mut ways: Vec<f64> = (0..COLUMNS).map(level).collect();
        let central_m = ways[COLUMNS * 2 / 5..COLUMNS * 3 / 5].iter().copied().fold(f64::INFINITY, f64::min);
        ways.sort_by(f64::total_cmp);
        let deep_m = ways[COLUMNS * 3 / 4];
        let blocked = ways.iter().filter(|way| **way < HALF_WAY_M).count() as f64 / COLUMNS as f64;
        let short = |value: f64, wanted: f64| (1.0 - value / wanted).max(0.0);
        let mean = trodden / f64::max(floor, 1.0);
        let contrast = (squared / f64::max(floor, 1.0) - mean * mean).max(0.0).sqrt();
        1.5 * trodden / all + 4.0 * contrast * floor / all + 1.2 * touched / all + (things / all / 0.10).min(1.0)
            - 6.0 * (leaves / all - LEAF_SHARE).max(0.0)
            - 4.0 * short(floor / all, FLOOR_SHARE)
            - 2.0 * short(deep_m, DEPTH_M)
            - 1.2 * short(central_m, 0.6 * DEPTH_M)
            - 2.0 * (blocked - 0.25).max(0.0)
            - 6.0 * (near / all - 0.03).max(0.0)
            - 8.0 * (outside / all - 0.02).max(0.0)
    }

    /// Candidate places a metre apart, on walked floor if there is some.
    fn standing_places(&self, traffic: &FootfallGrid) -> Vec<Vec2> {
        let [columns, rows] = traffic.size();
        let step = (1.0 / CELL_M) as usize;
        let middle = |x: usize, y: usize| vec2(x as f64 + 0.5, y as f64 + 0.5) * CELL_M;
        let all: Vec<Vec2> =
            (0..rows).step_by(step).flat_map(|y| (0..columns).step_by(step).map(move |x| middle(x, y))).collect();
        let clear: Vec<Vec2> =
            all.into_par_iter().filter(|&p| self.is_floor(p) && self.clearance(p, CLEAR_M) >= CLEAR_M).collect();
        let openings: Vec<&WallQuad> = self.pieces.iter().filter(|piece| piece.what == QuadKind::Opening).collect();
        let indoors = |p: Vec2| openings.iter().all(|opening| opening.distance_m(p) >= INDOORS_M);
        let walked = |p: Vec2| traffic.at(p) > 0.05;
        let chosen = |good: &dyn Fn(Vec2) -> bool| clear.iter().copied().filter(|&p| good(p)).collect::<Vec<Vec2>>();
        // The strictest wish that any place meets: all of a small plan is near its openings, an empty one has no dirt.
        let tries: [&dyn Fn(Vec2) -> bool; 4] = [&|p| walked(p) && indoors(p), &walked, &indoors, &|_| true];
        let walked = tries.into_iter().map(chosen).find(|places| !places.is_empty()).unwrap_or_default();
        let stride = walked.len().div_ceil(MOST_PLACES).max(1);
        walked.into_iter().step_by(stride).collect()
    }

    /// Distance to the nearest wall by sixteen directions, at most `reach_m`.
    fn clearance(&self, p: Vec2, reach_m: f64) -> f64 {
        let ways = (0..16).map(|k| self.wall_way(p, direction(k as f64 * 22.5 + 3.0), reach_m * 1.02));
        let least = ways.fold(f64::INFINITY, f64::min);
        if least >= reach_m { reach_m } else { least }
    }

    fn wall_way(&self, from: Vec2, toward: Vec2, reach_m: f64) -> f64 {
        self.cast(from, toward, reach_m, |piece, _| piece.bounds_room()).map_or(reach_m, |met| met.way_m)
    }

    /// Score of a view from a place in a direction.
    fn judge(&self, place: Vec2, heading_deg: f64, traffic: &FootfallGrid, doors: &[Vec2]) -> f64 {
        let (mut count, mut trodden, mut contrast) = (0.0, 0.0, 0.0);
        let (mut near_walls, mut blocked, mut glare, mut ahead) = (0.0, 0.0, 0.0, 0.0);
        for k in 0..GLANCES {
            let aside = (k as f64 / (GLANCES - 1) as f64 - 0.5) * DEFAULT_FOV_DEG * 0.94;
            let toward = direction(heading_deg + aside);
            let met = self.cast(place, toward, 45.0, |piece, _| piece.bounds_room());
            let way = met.map_or(45.0, |met| met.way_m);
            let outward = met.is_some_and(|met| self.pieces[met.piece].what == QuadKind::Opening);
            glare += if self.roofed && outward && way < BRIGHT_M { 1.0 - way / BRIGHT_M } else { 0.0 };
            // The first piece of furniture hides the floor behind it, up to where one looks over it.
            let low = self.cast(place, toward, way, |piece, _| piece.height_m < EYES_M);
            let hidden = low.map_or([f64::INFINITY; 2], |met| {
                [met.way_m, met.way_m * EYES_M / (EYES_M - self.pieces[met.piece].height_m)]
            });
            // Rows are evenly spaced in the picture: what is near counts as much as it takes of it.
            for row in 0..FLOOR_ROWS {
                let slope = LOWEST_SLOPE * (1.0 - (row as f64 + 0.5) / FLOOR_ROWS as f64);
                let distance = EYES_M / slope;
                if distance >= way {
                    break;
                }
                if distance > hidden[0] && distance < hidden[1] {
                    continue;
                }
                let p = place + toward * distance;
                let here = f64::from(traffic.at(p));
                let beside = [toward.left(), -toward.left()].map(|side| f64::from(traffic.at(p + side * ASIDE_M)));
                (count, trodden) = (count + 1.0, trodden + here);
                contrast += beside.iter().map(|other| (here - other).abs()).sum::<f64>() * 0.5;
            }
            let central = k.abs_diff(GLANCES / 2) <= GLANCES / 8;
            ahead = if central { f64::max(ahead, way) } else { ahead };
            near_walls += if way > 2.0 && way < 9.0 { 1.0 } else { 0.0 };
            // A wall right before the camera hides everything.
            blocked += if way < 2.0 { 1.0 } else { 0.0 };
        }
        let glances = GLANCES as f64;
        let all = glances * FLOOR_ROWS as f64;
        let walls = near_walls / glances;
        let share = count / all * (LOWEST_SLOPE / (LOWEST_SLOPE + HIGHEST_SLOPE));
        let short = |value: f64, wanted: f64| (1.0 - value / wanted).max(0.0);
        // Dirt by how much of the picture shows it.
        1.2 * trodden / all + 6.0 * contrast / all + 1.2 * walls * (1.0 - walls)
            - 3.0 * short(share, FLOOR_SHARE)
            - 2.0 * short(ahead, DEPTH_M)
            - 2.5 * blocked / glances
            - 3.0 * glare / glances
            + 0.25 * self.doors_in_view(doors, place, heading_deg).min(2.0)
    }

    /// How many of these doors are seen well from a place.
    fn doors_in_view(&self, doors: &[Vec2], place: Vec2, heading_deg: f64) -> f64 {
        let ahead = direction(heading_deg);
        let seen = doors.iter().filter(|&&door| {
            let way = door - place;
            let distance = way.length();
            let [near, far] = DOORS_M;
            let in_view = distance >= near && distance <= far && way.dot(ahead) > 0.9 * distance;
            in_view && self.wall_way(place, way / distance, distance) > distance - 0.3
        });
        // Both faces of a lintel are pieces, of which one is seen.
        seen.count() as f64
    }

    /// Middles of lintels.
    fn doors(&self) -> Vec<Vec2> {
        let doors = self.pieces.iter().filter(|piece| matches!(piece.what, QuadKind::Lintel(_)));
        doors.map(|piece| piece.a + piece.along * (piece.length * 0.5)).collect()
    }

    /// From above, all of the plan in the picture, from the side where walls hide least of the floor.
    pub(crate) fn birds_eye(&self, size: [u32; 2]) -> Camera {
        let mut best: Option<(f64, Camera)> = None;
        // Obliquely first: a plan seen straight along its walls looks flat.
        for heading_deg in [60.0, 120.0, 240.0, 300.0, 30.0, 150.0, 210.0, 330.0] {
            let camera = self.framed(heading_deg, size);
            let seen = self.floor_share(&camera, size);
            if best.is_none_or(|(most, _)| seen > most * 1.02) {
                best = Some((seen, camera));
            }
        }
        best.map_or_else(|| self.framed(60.0, size), |(_, camera)| camera)
    }

    /// Share of a picture that is floor.
    fn floor_share(&self, camera: &Camera, [width, height]: [u32; 2]) -> f64 {
        const ACROSS: usize = 72;
        let lens = Lens::of(camera, [width, height]);
        let up = (ACROSS * height as usize / width.max(1) as usize).clamp(4, 4 * ACROSS);
        let place = |k: usize, count: usize, size: u32| (k as f64 + 0.5) / count as f64 * f64::from(size);
        let is_floor = |k: &usize| {
            let ray = lens.ray(place(k % ACROSS, ACROSS, width), place(k / ACROSS, up, height));
            self.trace_above(lens.position, ray).surface == HitSurface::Floor
        };
        (0..ACROSS * up).filter(is_floor).count() as f64 / (ACROSS * up) as f64
    }

    /// The camera that looks in a direction and has all of the block in its picture.
    fn framed(&self, heading_deg: f64, size: [u32; 2]) -> Camera {
        const MARGIN: f64 = 0.05;
        let mut camera = Camera { position_m: [0.0; 3], heading_deg, pitch_deg: BIRD_PITCH_DEG, fov_deg: BIRD_FOV_DEG };
        let lens = Lens::of(&camera, size);
        let corners = self.block_corners();
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let length = |a: [f64; 3]| dot(a, a).sqrt();
        let unit = |a: [f64; 3]| a.map(|c| c / length(a));
        let (right, down) = (unit(lens.right), unit(lens.down));
        let reach = |axis: usize| {
            let half = lens.pixel * f64::from(size[axis]) * 0.5;
            half * (1.0 - 2.0 * MARGIN)
        };
        // Along each axis a camera sees |x - x0| <= (d - d0) reach: the corners that bind on either side say where it
        // has to stand aside, and how far back.
        let bound = |axis: [f64; 3], reach: f64| {
            let side = |sign: f64| {
                corners
                    .iter()
                    .map(|&p| sign * dot(p, axis) - reach * dot(p, lens.forward))
                    .fold(f64::NEG_INFINITY, f64::max)
            };
            let (plus, minus) = (side(1.0), side(-1.0));
            // x <= x0 + reach (d - d0) and -x <= -x0 + reach (d - d0) for all corners.
            (0.5 * (plus - minus), -0.5 * (plus + minus) / reach)
        };
        let (x0, dx) = bound(right, reach(0));
        let (y0, dy) = bound(down, reach(1));
        let back = dx.min(dy);
        camera.position_m = std::array::from_fn(|k| right[k] * x0 + down[k] * y0 + lens.forward[k] * back);
        camera
    }

    fn block_corners(&self) -> [[f64; 3]; 8] {
        std::array::from_fn(|k| {
            let pick = |bit: usize, low: f64, high: f64| if k >> bit & 1 == 0 { low } else { high };
            let Self { block, height_m, .. } = self;
            [pick(0, block.min.x, block.max.x), pick(1, block.min.y, block.max.y), pick(2, 0.0, *height_m)]
        })
    }

    /// The nearest place on the floor with some room around it.
    pub(crate) fn nearest_floor(&self, p: Vec2) -> Vec2 {
        let near = |clear_m: f64| {
            let mut best: Option<(f64, Vec2)> = None;
            for place in self.floor_places() {
                let distance = place.distance(p);
                let nearer = best.is_none_or(|(least, _)| distance < least);
                if nearer && self.clearance(place, clear_m) >= clear_m {
                    best = Some((distance, place));
                }
            }
            best.map(|(_, place)| place)
        };
        near(0.3).or_else(|| near(0.0)).unwrap_or(self.block.centre())
    }
}

fn direction(degrees: f64) -> Vec2 {
    let (sine, cosine) = sin_cos(degrees * std::f64::consts::PI / 180.0);
    vec2(cosine, sine)
}
