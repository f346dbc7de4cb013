use super::paths::Path;
use crate::export::{CROP_M, Manifest};
use crate::math::{Rect, Vec2, atan2, sin_cos, vec2};
use crate::plan::Opening;
use crate::walls::Walls;

/// Side of the cells in which traffic is counted, metres.
const CELL_M: f64 = 0.5;
/// Widest place that counts as narrow, metres to one side.
const PROBE_M: f64 = 4.0;
/// Places with less than this share of the most traffic are no candidates.
const WORTH_SEEING: f64 = 0.08;

/// A piece of the floor worth looking at.
#[derive(Clone, Debug, PartialEq)]
pub struct Crop {
    /// `entrance`, `junction` or `narrow`.
    pub name: String,
    /// Lower-left corner, metres.
    pub min_m: Vec2,
    /// Upper-right corner, metres.
    pub max_m: Vec2,
}

impl Crop {
    /// The picture's file.
    pub fn file(&self) -> String {
        format!("preview/{}.png", self.name)
    }

    /// The crops that an earlier bake chose.
    pub(crate) fn of_manifest(manifest: &Manifest) -> Vec<Crop> {
        let name = |file: &str| Some(file.strip_prefix("preview/")?.strip_suffix(".png")?.to_string());
        let known = |name: &String| ["entrance", "junction", "narrow"].contains(&name.as_str());
        (manifest.preview.iter())
            .filter_map(|entry| {
                Some(Crop { name: name(&entry.file).filter(known)?, min_m: entry.min_m, max_m: entry.max_m })
            })
            .collect()
    }
}

/// Chooses crops: the busiest entrance, the busiest junction, the narrowest place with traffic.
///
/// Kinds of which no place is found are left out.
pub fn choose_crops(bounds_m: Rect, openings: &[Opening], walls: &Walls, paths: &[Path]) -> Vec<Crop> {
    let Some(traffic) = TrafficGrid::count(bounds_m, paths) else { return Vec::new() };
    let entrance = entrance(openings, &traffic);
    let junction = junction(&traffic, entrance);
    let narrow = narrow(&traffic, walls, [entrance, junction]);
    let crop = |name: &str, rect: Option<Rect>| {
        rect.map(|Rect { min, max }| Crop { name: name.to_string(), min_m: min, max_m: max })
    };
    [crop("entrance", entrance), crop("junction", junction), crop("narrow", narrow)].into_iter().flatten().collect()
}

/// Distance walked in a cell or in several.
#[derive(Clone, Copy, Debug, Default)]
struct Walked {
    /// Metres.
    length: f64,
    /// Metres times the cosine and sine of twice the heading: opposite ways count as one direction.
    along: Vec2,
}

impl Walked {
    fn plus(self, other: Walked) -> Walked {
        Walked { length: self.length + other.length, along: self.along + other.along }
    }

    fn minus(self, other: Walked) -> Walked {
        Walked { length: self.length - other.length, along: self.along - other.along }
    }

    /// Metres that are walked across the main direction: most where equal flows cross at right angles.
    fn crossing(self) -> f64 {
        self.length - self.along.length()
    }
}

/// Distance and direction of walking by cell.
struct TrafficGrid {
    bounds: Rect,
    columns: usize,
    rows: usize,
    cells: Vec<Walked>,
    /// Sums over all cells left of and below a corner.
    sums: Vec<Walked>,
}

impl TrafficGrid {
    fn count(bounds: Rect, paths: &[Path]) -> Option<TrafficGrid> {
        let cells_of = |metres: f64| ((metres / CELL_M).ceil() as usize).max(1);
        let (columns, rows) = (cells_of(bounds.width()), cells_of(bounds.height()));
        let mut cells = vec![Walked::default(); columns * rows];
        for pair in paths.iter().flat_map(|path| path.samples.windows(2)) {
            let (a, b) = (pair[0].position_m, pair[1].position_m);
            let Some(heading) = (b - a).normalized() else { continue };
            let twice = vec2(heading.x * heading.x - heading.y * heading.y, 2.0 * heading.x * heading.y);
            let steps = (a.distance(b) / (0.5 * CELL_M)).ceil().max(1.0);
            let length = a.distance(b) / steps;
            for step in 0..steps as usize {
                let p = a.lerp(b, (step as f64 + 0.5) / steps) - bounds.min;
                let (x, y) = (p.x / CELL_M, p.y / CELL_M);
                if x >= 0.0 && y >= 0.0 && x < columns as f64 && y < rows as f64 {
                    let cell = &mut cells[y as usize * columns + x as usize];
                    *cell = cell.plus(Walked { length, along: twice * length });
                }
            }
        }
        let mut sums = vec![Walked::default(); (columns + 1) * (rows + 1)];
        for y in 0..rows {
            let mut row = Walked::default();
            for x in 0..columns {
                row = row.plus(cells[y * columns + x]);
                sums[(y + 1) * (columns + 1) + x + 1] = sums[y * (columns + 1) + x + 1].plus(row);
            }
        }
        let walked = sums.last().is_some_and(|all| all.length > 0.0);
        walked.then_some(TrafficGrid { bounds, columns, rows, cells, sums })
    }

    fn centre(&self, index: usize) -> Vec2 {
        let [x, y] = [index % self.columns, index / self.columns].map(|k| (k as f64 + 0.5) * CELL_M);
        self.bounds.min + vec2(x, y)
    }

    /// A crop around a point, moved into the plan.
    fn window(&self, centre: Vec2) -> Rect {
        let size = vec2(CROP_M[0].min(self.bounds.width()), CROP_M[1].min(self.bounds.height()));
        let low = centre - size * 0.5;
        let room = self.bounds.max - size;
        // In a plan as small as a crop, rounding may leave less than no room.
        let min = vec2(low.x.min(room.x).max(self.bounds.min.x), low.y.min(room.y).max(self.bounds.min.y));
        Rect { min, max: min + size }
    }

    /// Distance walked in the cells of a rectangle.
    fn within(&self, area: Rect) -> Walked {
        let cell = |metres: f64, most: usize| ((metres / CELL_M).round().max(0.0) as usize).min(most);
        let [left, right] = [area.min.x, area.max.x].map(|x| cell(x - self.bounds.min.x, self.columns));
        let [below, above] = [area.min.y, area.max.y].map(|y| cell(y - self.bounds.min.y, self.rows));
        let at = |x: usize, y: usize| self.sums[y * (self.columns + 1) + x];
        at(right, above).minus(at(left, above)).minus(at(right, below)).plus(at(left, below))
    }
}

/// The candidate with the highest score above zero; the first of equal ones.
fn best<T>(candidates: impl Iterator<Item = (f64, T)>) -> Option<T> {
    let mut best: Option<(f64, T)> = None;
    for (score, candidate) in candidates {
        if score > best.as_ref().map_or(0.0, |(score, _)| *score) {
            best = Some((score, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

fn entrance(openings: &[Opening], traffic: &TrafficGrid) -> Option<Rect> {
    best(openings.iter().map(|opening| {
        let window = traffic.window(opening.centre_m());
        (traffic.within(window).length, window)
    }))
}

fn junction(traffic: &TrafficGrid, entrance: Option<Rect>) -> Option<Rect> {
    let windows = (0..traffic.cells.len()).map(|index| traffic.window(traffic.centre(index)));
    best(windows.filter(|window| !entrance.is_some_and(|taken| taken.overlaps(*window))).map(|window| {
        // Crossings near the middle count more than once.
        let around = |reach_m: f64| Rect::around(window.centre(), window.centre()).grown(reach_m);
        ([0.5, 1.0, 1.5, 2.0].into_iter().map(|reach_m| traffic.within(around(reach_m)).crossing()).sum(), window)
    }))
}

fn narrow(traffic: &TrafficGrid, walls: &Walls, taken: [Option<Rect>; 2]) -> Option<Rect> {
    let most = traffic.cells.iter().map(|cell| cell.length).fold(0.0, f64::max);
    let candidates = (0..traffic.cells.len()).filter_map(|index| {
        let (cell, centre) = (traffic.cells[index], traffic.centre(index));
        let free = !taken.iter().flatten().any(|window| window.contains(centre));
        if !free || cell.length < WORTH_SEEING * most || !walls.is_inside(centre) {
            return None;
        }
        let (sin, cos) = sin_cos(0.5 * atan2(cell.along.y, cell.along.x));
        let across = vec2(-sin, cos);
        let width = clear_way(walls, centre, across) + clear_way(walls, centre, -across);
        // To the decimetre, so that among equally narrow places traffic decides.
        let decimetres = (width * 10.0).round();
        Some((1e6 - decimetres * 1e3 + (cell.length / most) * 999.0, traffic.window(centre)))
    });
    best(candidates)
}

/// How far it is to a wall from a point in a direction, at most [`PROBE_M`].
fn clear_way(walls: &Walls, from: Vec2, direction: Vec2) -> f64 {
    let mut way = 0.0;
    while way < PROBE_M {
        match walls.nearest(from + direction * way, PROBE_M) {
            // No wall is nearer than this, so the probe may go this far at once.
            Some(nearest) if nearest.distance_m > 0.02 => way += nearest.distance_m,
            Some(_) => return way,
            None => return PROBE_M,
        }
    }
    PROBE_M
}

#[cfg(test)]
mod tests {
    use super::super::paths::PathSample;
    use super::*;
    use crate::plan::FloorPlan;
    use crate::walls::WallsOptions;

    /// 40 x 30 m: a corridor from west to east, one from north to south that crosses it at (20, 15), and a bottleneck of
    /// 1 m at x = 31.
    fn plan() -> FloorPlan {
        let floor = |x: u32, y: u32| {
            let across = if (305..315).contains(&x) { 145..155 } else { 130..170 };
            across.contains(&y) || (180..220).contains(&x)
        };
        let mask = (0..300u32).flat_map(|y| (0..400u32).map(move |x| u8::from(floor(x, y)))).collect();
        FloorPlan::from_mask(400, 300, 0.1, mask)
    }

    fn straight(a: Vec2, b: Vec2) -> Path {
        let samples = (0..=40).map(|k| PathSample { position_m: a.lerp(b, f64::from(k) / 40.0), speed_m_s: 1.0 });
        Path { id: 0, samples: samples.collect() }
    }

    fn crops(paths: &[Path]) -> Vec<Crop> {
        let plan = plan();
        let walls = Walls::trace(&plan, &WallsOptions::default());
        choose_crops(walls.bounds_m(), &plan.openings, &walls, paths)
    }

    #[test]
    fn an_entrance_a_junction_and_a_narrow_place_are_found() {
        let east = straight(vec2(-2.0, 15.0), vec2(42.0, 15.0));
        let north = straight(vec2(20.0, -2.0), vec2(20.0, 32.0));
        let found = crops(&[east.clone(), east, north]);
        let names: Vec<&str> = found.iter().map(|crop| crop.name.as_str()).collect();
        assert_eq!(names, ["entrance", "junction", "narrow"]);
        // Two of three people use the west, which comes before the east.
        assert_eq!((found[0].min_m, found[0].max_m), (vec2(0.0, 13.0), vec2(6.0, 17.0)));
        for (crop, place) in [(&found[1], vec2(20.0, 15.0)), (&found[2], vec2(31.0, 15.0))] {
            let middle = (crop.min_m + crop.max_m) * 0.5;
            assert!(middle.distance(place) < 1.2, "{} at {middle:?}", crop.name);
            assert_eq!(crop.max_m - crop.min_m, vec2(6.0, 4.0));
        }
    }

    #[test]
    fn where_nobody_walked_nothing_is_worth_seeing() {
        assert_eq!(crops(&[]), []);
        assert_eq!(crops(&[straight(vec2(-9.0, 900.0), vec2(-5.0, 900.0))]), []);
    }

    #[test]
    fn opposite_ways_make_no_junction_and_crossing_ones_do() {
        let walked = |heading: Vec2| {
            let twice = vec2(heading.x * heading.x - heading.y * heading.y, 2.0 * heading.x * heading.y);
            Walked { length: 1.0, along: twice }
        };
        let east = walked(vec2(1.0, 0.0));
        assert_eq!(east.plus(walked(vec2(-1.0, 0.0))).crossing(), 0.0);
        assert_eq!(east.plus(walked(vec2(0.0, 1.0))).crossing(), 2.0);
    }

    #[test]
    fn crops_are_found_again_in_a_manifest() {
        let entry = |file: &str| crate::export::PreviewEntry {
            file: file.to_string(),
            min_m: vec2(1.0, 2.0),
            max_m: vec2(7.0, 6.0),
        };
        let preview = vec![entry("preview/floor.png"), entry("preview/narrow.png"), entry("preview/paths.png")];
        let manifest = Manifest { preview, ..Manifest::default() };
        let found = Crop::of_manifest(&manifest);
        assert_eq!(found, [Crop { name: "narrow".to_string(), min_m: vec2(1.0, 2.0), max_m: vec2(7.0, 6.0) }]);
        assert_eq!(found[0].file(), "preview/narrow.png");
    }
}
