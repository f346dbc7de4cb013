//! A second set of texture coordinates, for light maps: every place of a mesh has texels of its own.

use std::collections::HashMap;

use super::model::Mesh;
use crate::math::DisjointSets;

/// Free texels around each chart: charts lie twice as far apart.
const MARGIN_PX: f64 = 1.0;
/// Rounds of the search for the texel density.
const ROUNDS: u32 = 20;
/// Longest chart of a curved or long wall, as a multiple of the side of a square with the mesh's area.
const LONGEST: f64 = 1.2;
/// Steps in a metre by which places within a chart are told apart.
const STEPS_PER_M: f64 = 4096.0;

impl Mesh {
    /// The same triangles with [`light_uvs`](Mesh::light_uvs) for a square light map of `size_px` texels. Vertices at
    /// which charts meet are doubled. A mesh of more charts than the map has room for stays as it is.
    pub(crate) fn light_mapped(&self, size_px: u32) -> Mesh {
        let charts = Charts::of(self);
        let Some(packed) = charts.pack(f64::from(size_px)) else { return self.clone() };
        let (positions_m, normals, uvs) = (Vec::new(), Vec::new(), Vec::new());
        let mut mesh = Mesh { positions_m, normals, uvs, indices: Vec::new(), ..self.clone() };
        let mut known = HashMap::new();
        for (corners, (chart, flat)) in self.indices.chunks_exact(3).zip(&charts.triangles) {
            for (&old, place) in corners.iter().zip(flat) {
                let [x, y] = place.map(|value| (value * STEPS_PER_M).round() as i64);
                let index = *known.entry((old, *chart, x, y)).or_insert_with(|| {
                    let old = old as usize;
                    mesh.positions_m.push(self.positions_m[old]);
                    mesh.normals.push(self.normals[old]);
                    mesh.uvs.push(self.uvs[old]);
                    let place = charts.boxes[*chart].place(*place);
                    let corner = packed.corners_px[*chart];
                    mesh.light_uvs.push([0, 1].map(|k| {
                        ((corner[k] + MARGIN_PX + place[k] * packed.texels_per_metre) / f64::from(size_px)) as f32
                    }));
                    (mesh.positions_m.len() - 1) as u32
                });
                mesh.indices.push(index);
            }
        }
        mesh
    }
}

/// A mesh laid flat in pieces.
#[derive(Debug, Default)]
struct Charts {
    /// Of each triangle: its chart, and its corners on it, metres, the second upward.
    triangles: Vec<(usize, [[f64; 2]; 3])>,
    boxes: Vec<Bounds>,
}

/// The rectangle of a chart, metres.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    low: [f64; 2],
    high: [f64; 2],
}

impl Bounds {
    /// Width and height as it is packed: the longer side lies.
    fn size(&self) -> [f64; 2] {
        let [width, height] = [0, 1].map(|k| self.high[k] - self.low[k]);
        [width.max(height), width.min(height)]
    }

    /// A place from the upper left of the packed rectangle, rightward and downward.
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let is_upright = self.high[1] - self.low[1] > self.high[0] - self.low[0];
        if is_upright { [y - self.low[1], x - self.low[0]] } else { [x - self.low[0], self.high[1] - y] }
    }
}

/// Where charts lie on a light map.
struct Packed {
    corners_px: Vec<[f64; 2]>,
    texels_per_metre: f64,
}

impl Charts {
    fn of(mesh: &Mesh) -> Charts {
        let triangles: Vec<[u32; 3]> = mesh.indices.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
        let place = |index: u32| mesh.positions_m[index as usize].map(f64::from);
        let normals: Vec<[f64; 3]> = triangles.iter().map(|corners| area_vector(corners.map(place))).collect();
        let area_m2: f64 = normals.iter().map(|n| 0.5 * n.iter().map(|v| v * v).sum::<f64>().sqrt()).sum();
        let longest_m = LONGEST * area_m2.sqrt();
        let pieces = level_pieces(&triangles, &normals);
        let (mut charts, mut of_piece, mut wall) = (Charts::default(), HashMap::new(), None);
        for ((&corners, &normal), piece) in triangles.iter().zip(&normals).zip(pieces) {
            let (chart, flat) = if is_level(normal) {
                // Undersides are seen from below.
                let flat = corners.map(place).map(|[x, y, _]| [x * normal[2].signum(), y]);
                (*of_piece.entry(piece).or_insert_with(|| charts.open()), flat)
            } else {
                // To the right of a viewer who looks at it.
                let length = (normal[0] * normal[0] + normal[1] * normal[1]).sqrt();
                let flat = corners.map(place).map(|[x, y, z]| [(y * normal[0] - x * normal[1]) / length, z]);
                let known = wall.take().filter(|wall: &Wall| wall.goes_on(corners, longest_m));
                let mut wall_here = known.unwrap_or_else(|| Wall::new(charts.open(), flat));
                let flat = wall_here.add(corners, flat);
                let chart = wall_here.chart;
                wall = Some(wall_here);
                (chart, flat)
            };
            charts.add(chart, flat);
        }
        charts
    }

    /// A new chart.
    fn open(&mut self) -> usize {
        self.boxes.push(Bounds { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] });
        self.boxes.len() - 1
    }

    fn add(&mut self, chart: usize, flat: [[f64; 2]; 3]) {
        let Bounds { low, high } = &mut self.boxes[chart];
        for corner in flat {
            for k in 0..2 {
                low[k] = low[k].min(corner[k]);
                high[k] = high[k].max(corner[k]);
            }
        }
        self.triangles.push((chart, flat));
    }

    /// The densest packing that is found; `None` if there are too many charts.
    fn pack(&self, size_px: f64) -> Option<Packed> {
        let sizes: Vec<[f64; 2]> = self.boxes.iter().map(Bounds::size).collect();
        let longest_m = sizes.iter().map(|size| size[0]).fold(0.0, f64::max);
        let mut order: Vec<usize> = (0..sizes.len()).collect();
        order.sort_by(|&a, &b| sizes[b][1].total_cmp(&sizes[a][1]).then(sizes[b][0].total_cmp(&sizes[a][0])));
        let (mut least, mut most, mut best) = (0.0, (size_px - 2.0 * MARGIN_PX) / longest_m, None);
        for round in 0..ROUNDS {
            // The very greatest density first: a single chart has it.
            let texels_per_metre = if round == 0 { most } else { 0.5 * (least + most) };
            match on_shelves(&sizes, &order, texels_per_metre, size_px) {
                Some(corners_px) => {
                    least = texels_per_metre;
                    best = Some(Packed { corners_px, texels_per_metre });
                }
                None => most = texels_per_metre,
            }
        }
        best
    }
}

/// Corners of rectangles side by side on shelves, in an order of falling heights; `None` if there is no room.
fn on_shelves(sizes: &[[f64; 2]], order: &[usize], texels_per_metre: f64, size_px: f64) -> Option<Vec<[f64; 2]>> {
    let mut corners_px = vec![[0.0; 2]; sizes.len()];
    let ([mut x, mut y], mut shelf) = ([0.0, 0.0], 0.0);
    for &index in order {
        let [width, height] = sizes[index].map(|metres| (metres * texels_per_metre).ceil() + 2.0 * MARGIN_PX);
        if x + width > size_px {
            (x, y) = (0.0, y + shelf);
            shelf = 0.0;
        }
        if x + width > size_px || y + height > size_px {
            return None;
        }
        corners_px[index] = [x, y];
        x += width;
        shelf = f64::max(shelf, height);
    }
    Some(corners_px)
}

/// An upright strip that is being unrolled.
struct Wall {
    chart: usize,
    start_m: f64,
    /// Corners of the last two triangles, which are a panel, with their places on the chart.
    panel: Vec<(u32, [f64; 2])>,
}

impl Wall {
    fn new(chart: usize, flat: [[f64; 2]; 3]) -> Wall {
        let start_m = flat.iter().map(|corner| corner[0]).fold(f64::INFINITY, f64::min);
        Wall { chart, start_m, panel: Vec::new() }
    }

    fn shared(&self, corners: [u32; 3]) -> impl Iterator<Item = (u32, [f64; 2])> {
        self.panel.iter().copied().filter(move |(index, _)| corners.contains(index))
    }

    /// Whether a triangle belongs to the last panel, or to the next one of a strip that is not too long.
    fn goes_on(&self, corners: [u32; 3], longest_m: f64) -> bool {
        let mut shared = self.shared(corners);
        shared.next().is_some_and(|(_, [at_m, _])| shared.next().is_some() || at_m - self.start_m < longest_m)
    }

    /// Moves a triangle to where the last panel ends.
    fn add(&mut self, corners: [u32; 3], flat: [[f64; 2]; 3]) -> [[f64; 2]; 3] {
        let met = self.shared(corners).next();
        let own =
            met.and_then(|(index, at)| corners.iter().zip(flat).find(|(own, _)| **own == index).map(|o| (o.1, at)));
        let shift_m = own.map_or(0.0, |(here, there)| there[0] - here[0]);
        let flat = flat.map(|[along_m, height_m]| [along_m + shift_m, height_m]);
        self.panel.drain(..self.panel.len().saturating_sub(3));
        self.panel.extend(corners.into_iter().zip(flat));
        flat
    }
}

/// Of each level triangle, the first triangle of its piece; pieces hang together by sides.
fn level_pieces(triangles: &[[u32; 3]], normals: &[[f64; 3]]) -> Vec<usize> {
    let mut joined = DisjointSets::new(triangles.len());
    let mut sides = HashMap::new();
    for (number, corners) in triangles.iter().enumerate().filter(|(number, _)| is_level(normals[*number])) {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            let other = *sides.entry((a.min(b), a.max(b))).or_insert(number);
            joined.join(number, other);
        }
    }
    (0..triangles.len()).map(|number| joined.least(number)).collect()
}

fn is_level(normal: [f64; 3]) -> bool {
    normal[2] * normal[2] > normal[0] * normal[0] + normal[1] * normal[1]
}

/// Twice a triangle's area along its normal.
fn area_vector([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let [u, v] = [b, c].map(|p| [0, 1, 2].map(|k| p[k] - a[k]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}
