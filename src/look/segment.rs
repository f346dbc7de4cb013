//! Wall segments relative to the texels near them.

use super::noise;
use crate::math::{Vec2, smoothstep_f32, vec2};
use crate::walls::Segment;

/// Side of the squares of texels that share a list of near walls.
pub(super) const SQUARE: usize = 16;

/// One row of a square.
pub(super) type TexelRow = [f32; SQUARE];

/// A wall segment in metres from a square's lower left corner.
pub(super) struct LocalSegment {
    start: [f32; 2],
    along: [f32; 2],
    length: f32,
    /// Arc length of the start, metres, and a key of the face: the origin of its patterns.
    start_m: f64,
    salt: u32,
}

/// Positions of a row of texels relative to a wall segment.
pub(super) struct TexelPlaces {
    /// Along the face from its start, metres; may exceed its ends.
    along: TexelRow,
    /// In front of the face, metres; negative behind it.
    front: TexelRow,
    /// Distance to the nearest point of the face, metres.
    pub distance: TexelRow,
}

impl LocalSegment {
    pub fn seen_from(segment: &Segment, origin: Vec2) -> LocalSegment {
        let (start, way) = (segment.a - origin, segment.b - segment.a);
        let along = way.normalized().unwrap_or(vec2(1.0, 0.0));
        LocalSegment {
            start: [start.x as f32, start.y as f32],
            along: [along.x as f32, along.y as f32],
            length: way.length() as f32,
            start_m: segment.along_m,
            salt: segment.face.map_or(0, |face| noise::mix(face as u32 + 1)),
        }
    }

    /// Positions of the texels `x = texel_m * (k + 0.5)` at height `y`.
    pub fn places(&self, y: f32, texel_m: f32) -> TexelPlaces {
        let mut places = TexelPlaces { along: [0.0; SQUARE], front: [0.0; SQUARE], distance: [0.0; SQUARE] };
        let y = y - self.start[1];
        for k in 0..SQUARE {
            let x = (k as f32 + 0.5) * texel_m - self.start[0];
            let along = x * self.along[0] + y * self.along[1];
            let front = x * self.along[1] - y * self.along[0];
            let beyond = along - along.max(0.0).min(self.length);
            places.along[k] = along;
            places.front[k] = front;
            places.distance[k] = (front * front + beyond * beyond).sqrt();
        }
        places
    }

    /// Adds the angle of horizon that the face blocks, radians, weighted by distance: the integral of R^2 / (r^2 + R^2)
    /// over the angle. Faces seen from behind block nothing.
    pub fn add_blocked(&self, places: &TexelPlaces, radius: f32, texel_m: f32, blocked: &mut TexelRow) {
        for (k, blocked) in blocked.iter_mut().enumerate() {
            // A texel on the wall itself counts as in front.
            let front = places.front[k].max(1e-4);
            let far = (front * front + radius * radius).sqrt();
            let (before, after) = (places.along[k], self.length - places.along[k]);
            let near_part = arctan(before / front) + arctan(after / front);
            let far_part = arctan(before / far) + arctan(after / far);
            let angle = near_part - front / far * far_part;
            *blocked += if places.front[k] > -0.75 * texel_m { angle } else { 0.0 };
        }
    }
}

/// Noise along a face, laid out for one square.
pub(super) struct SegmentNoise {
    /// Length along the wall and width across, metres.
    size: [f32; 2],
    /// Arc length of the face's start within the table, in spots.
    start: f32,
    columns: usize,
    values: Vec<f32>,
}

impl SegmentNoise {
    /// Noise with spots of `size_m` on a face, for a square of side `side_m` with reach `reach_m`.
    pub fn over(face: &LocalSegment, size_m: [f64; 2], side_m: f32, reach_m: f32, key: u32) -> SegmentNoise {
        let corner = |x: f32, y: f32| (x - face.start[0]) * face.along[0] + (y - face.start[1]) * face.along[1];
        let corners = [corner(0.0, 0.0), corner(side_m, 0.0), corner(0.0, side_m), corner(side_m, side_m)];
        let clamped = |along: f32| f64::from(along.max(0.0).min(face.length));
        let from = clamped(corners.into_iter().fold(f32::INFINITY, f32::min));
        let to = clamped(corners.into_iter().fold(f32::NEG_INFINITY, f32::max));
        let start = face.start_m / size_m[0];
        let first = (start + from / size_m[0]).floor();
        let columns = ((start + to / size_m[0]).floor() - first) as usize + 2;
        let rows = (reach_m / size_m[1] as f32) as usize + 2;
        let key = key ^ face.salt;
        let values = (0..columns * rows)
            .map(|n| noise::signed(key, (first as i64 as i32).wrapping_add((n % columns) as i32), (n / columns) as i32))
            .collect();
        SegmentNoise { size: size_m.map(|size| size as f32), start: (start - first) as f32, columns, values }
    }

    /// Adds the noise, with deviation 1, times `weights` to a row.
    pub fn add(&self, face: &LocalSegment, places: &TexelPlaces, weights: &TexelRow, out: &mut TexelRow) {
        let rows = self.values.len() / self.columns;
        for (k, out) in out.iter_mut().enumerate() {
            let u = (self.start + places.along[k].max(0.0).min(face.length) / self.size[0]).max(0.0);
            let v = places.distance[k] / self.size[1];
            let (i, j) = ((u as usize).min(self.columns - 2), (v as usize).min(rows - 2));
            let (f, g) = (smoothstep_f32(u - i as f32), smoothstep_f32(v - j as f32));
            let at = j * self.columns + i;
            let (low, high) = (&self.values[at..at + 2], &self.values[at + self.columns..at + self.columns + 2]);
            let below = low[0] + f * (low[1] - low[0]);
            let above = high[0] + f * (high[1] - high[0]);
            // Mean square of the interpolation's weights is 0.743 per axis, of a uniform value 1/3.
            *out += weights[k] * (below + g * (above - below)) * (1.732 / 0.743);
        }
    }
}

/// Arc tangent with error below 2e-4 (Abramowitz & Stegun 4.4.47), identical on every machine.
fn arctan(x: f32) -> f32 {
    let inverse = x.abs() > 1.0;
    let t = if inverse { 1.0 / x } else { x };
    let s = t * t;
    let angle = t * (0.999_866 + s * (-0.330_299_5 + s * (0.180_141 + s * (-0.085_133 + s * 0.020_835_1))));
    let quarter = std::f32::consts::FRAC_PI_2.copysign(x);
    if inverse { quarter - angle } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall(a: Vec2, b: Vec2) -> Segment {
        Segment { a, b, face: Some(0), along_m: 3.0 }
    }

    fn blocked(segments: &[Segment], x: f64, y: f64) -> f32 {
        let mut row = [0.0; SQUARE];
        for segment in segments {
            let face = LocalSegment::seen_from(segment, vec2(x, y));
            face.add_blocked(&face.places(0.0, 1e-4), 0.1, 1e-4, &mut row);
        }
        row[0]
    }

    #[test]
    fn arctan_is_close_to_libm() {
        for step in -4000..4000 {
            let x = step as f32 / 37.0;
            assert!((f64::from(arctan(x)) - libm::atan(f64::from(x))).abs() < 2e-4, "{x}");
        }
    }

    #[test]
    fn walls_block_half_the_horizon_and_corners_three_quarters_or_one() {
        let pi = std::f32::consts::PI;
        // The floor is to the right of the walls: above the x axis, and right of the y axis.
        let south = wall(vec2(9.0, 0.0), vec2(-9.0, 0.0));
        assert!((blocked(&[south], 0.0, 0.001) - pi).abs() < 0.06);
        let [inner_south, west] = [wall(vec2(9.0, 0.0), vec2(0.0, 0.0)), wall(vec2(0.0, 0.0), vec2(0.0, 9.0))];
        assert!((blocked(&[inner_south, west], 0.001, 0.001) / pi - 1.5).abs() < 0.05);
        // Beside an outer corner, only the wall below is visible.
        let east = wall(vec2(0.0, 0.0), vec2(0.0, -9.0));
        assert!((blocked(&[wall(vec2(-9.0, 0.0), vec2(0.0, 0.0)), east], 0.001, 0.001) / pi) < 0.6);
    }

    #[test]
    fn a_split_wall_is_as_a_whole_one() {
        let whole = [wall(vec2(5.0, 0.0), vec2(-5.0, 0.0))];
        let split = [wall(vec2(5.0, 0.0), vec2(0.3, 0.0)), wall(vec2(0.3, 0.0), vec2(-5.0, 0.0))];
        for (x, y) in [(0.3, 0.01), (0.1, 0.05), (2.0, 0.2)] {
            assert!((blocked(&whole, x, y) - blocked(&split, x, y)).abs() < 2e-3);
        }
    }
}
