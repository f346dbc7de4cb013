use crate::export::Camera;
use crate::math::sin_cos;

/// A camera that makes rays.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lens {
    pub position: [f64; 3],
    pub forward: [f64; 3],
    /// To the next pixel on the right, at the distance 1.
    pub right: [f64; 3],
    /// To the next pixel below.
    pub down: [f64; 3],
    middle: [f64; 2],
    /// Side of a pixel at the distance 1.
    pub pixel: f64,
}

impl Lens {
    /// The camera as it takes a picture of `width` x `height` pixels.
    pub fn of(camera: &Camera, [width, height]: [u32; 2]) -> Lens {
        let radians = std::f64::consts::PI / 180.0;
        let (sin_h, cos_h) = sin_cos(camera.heading_deg * radians);
        let (sin_p, cos_p) = sin_cos(camera.pitch_deg * radians);
        let (sin_f, cos_f) = sin_cos(camera.fov_deg * 0.5 * radians);
        let pixel = 2.0 * (sin_f / cos_f) / f64::from(width);
        Lens {
            position: camera.position_m,
            forward: [cos_p * cos_h, cos_p * sin_h, sin_p],
            right: [sin_h * pixel, -cos_h * pixel, 0.0],
            down: [sin_p * cos_h * pixel, sin_p * sin_h * pixel, -cos_p * pixel],
            middle: [f64::from(width) * 0.5, f64::from(height) * 0.5],
            pixel,
        }
    }

    /// Unit vector from the camera through a place of the picture: pixels from its upper left corner.
    pub fn ray(&self, x: f64, y: f64) -> [f64; 3] {
        let (x, y) = (x - self.middle[0], y - self.middle[1]);
        let way: [f64; 3] = std::array::from_fn(|k| self.forward[k] + self.right[k] * x + self.down[k] * y);
        let length = (way[0] * way[0] + way[1] * way[1] + way[2] * way[2]).sqrt();
        way.map(|c| c / length)
    }

    /// Where the picture shows a point: pixels from its upper left corner; `None` behind the camera.
    #[cfg(test)]
    pub fn project(&self, point: [f64; 3]) -> Option<[f64; 2]> {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let from: [f64; 3] = std::array::from_fn(|k| point[k] - self.position[k]);
        let depth = dot(from, self.forward);
        let square = self.pixel * self.pixel;
        (depth > 0.0)
            .then(|| [self.right, self.down].map(|axis| dot(from, axis) / (depth * square)))
            .map(|[x, y]| [x + self.middle[0], y + self.middle[1]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Straight ahead is the middle; a point to the left of the heading is left of it, a point below is below.
    #[test]
    fn points_are_seen_where_a_pinhole_shows_them() {
        let camera: Camera = "2,3,1.7,90,0".parse().unwrap();
        let lens = Lens::of(&camera.with_fov(90.0), [400, 200]);
        let close = |point: [f64; 3], expected: [f64; 2]| {
            let [x, y] = lens.project(point).unwrap();
            assert!((x - expected[0]).abs() < 1e-9 && (y - expected[1]).abs() < 1e-9, "{point:?} at {x}, {y}");
        };
        close([2.0, 13.0, 1.7], [200.0, 100.0]);
        close([1.0, 13.0, 1.7], [180.0, 100.0]);
        close([2.0, 13.0, 0.7], [200.0, 120.0]);
        assert_eq!(lens.project([2.0, 1.0, 1.7]), None);
    }

    #[test]
    fn a_ray_through_a_pixel_leads_to_what_is_seen_there() {
        let camera: Camera = "2,3,1.7,37,-21".parse().unwrap();
        let lens = Lens::of(&camera, [320, 180]);
        for place in [[0.0, 0.0], [160.0, 90.0], [319.5, 3.25], [12.0, 180.0]] {
            let way = lens.ray(place[0], place[1]);
            let seen = lens.project(std::array::from_fn(|k| camera.position_m[k] + 7.0 * way[k])).unwrap();
            assert!((seen[0] - place[0]).abs() < 1e-8 && (seen[1] - place[1]).abs() < 1e-8, "{place:?}: {seen:?}");
        }
    }
}
