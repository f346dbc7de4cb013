//! Checks the numbers of a look against their ranges.

use super::error::{LookError, RangeError};
use super::octaves::Octave;
use super::settings::Look;

impl Look {
    /// Checks every number against its range.
    ///
    /// # Errors
    /// [`LookError::Range`] names the key, its value and the allowed range.
    pub fn check(&self) -> Result<(), LookError> {
        self.first_out_of_range().map_or(Ok(()), |range| Err(LookError::Range { range, place: None }))
    }

    pub(super) fn first_out_of_range(&self) -> Option<RangeError> {
        let floor = &self.floor;
        let own = |value: Option<f32>| f64::from(value.unwrap_or(0.5));
        let octave = |name: &'static str, octave: Octave| {
            let [size, sd] = match name {
                "fine" => ["noise.fine.size_m", "noise.fine.sd"],
                "middle" => ["noise.middle.size_m", "noise.middle.sd"],
                _ => ["noise.coarse.size_m", "noise.coarse.sd"],
            };
            [(size, octave.size_m, 0.002, 20.0), (sd, f64::from(octave.sd), 0.0, 1.0)]
        };
        let checks = [
            ("total_passes", self.total_passes as f64, 1.0, 1e9),
            ("darkest", f64::from(self.darkest), 0.0, 255.0),
            ("floor.texture", f64::from(floor.texture), 0.0, 3.0),
            ("floor.image_size_m", floor.image_size_m[0], 0.01, 1000.0),
            ("floor.image_size_m", floor.image_size_m[1], 0.01, 1000.0),
            ("floor.roughness", own(floor.roughness), 0.0, 1.0),
            ("floor.roughness_trodden", own(floor.roughness_trodden), 0.0, 1.0),
            ("floor.tile_m", floor.tile_m, 0.02, 5.0),
            ("floor.joint_m", floor.joint_m, 0.0, 0.05),
            ("film.density", f64::from(self.film.density), 0.0, 3.0),
            ("film.per_pass", f64::from(self.film.per_pass), 0.0, 1.0),
            ("film.spread_m", self.film.spread_m, 0.0, 0.5),
            ("ingrained.density", f64::from(self.ingrained.density), 0.0, 3.0),
            ("ingrained.per_pass", f64::from(self.ingrained.per_pass), 0.0, 1.0),
            ("prints.soil", f64::from(self.prints.soil), 0.0, 20.0),
            ("prints.every_pass", f64::from(self.prints.every_pass), 0.0, 3.0),
            ("scuffs.strength", f64::from(self.scuffs.strength), 0.0, 20.0),
            ("edge.density", f64::from(self.edge.density), 0.0, 3.0),
            ("edge.reach_m", f64::from(self.edge.reach_m), 0.005, 0.5),
            ("edge.unevenness", f64::from(self.edge.unevenness), 0.0, 1.5),
            ("edge.corner", f64::from(self.edge.corner), 1.0, 4.0),
            ("edge.corner_radius_m", f64::from(self.edge.corner_radius_m), 0.01, 0.5),
            ("dust.density", f64::from(self.dust.density), 0.0, 3.0),
            ("dust.reach_m", f64::from(self.dust.reach_m), 0.02, 3.0),
        ];
        let octaves =
            [("fine", self.noise.fine), ("middle", self.noise.middle), ("coarse", self.noise.coarse)].into_iter();
        checks
            .into_iter()
            .chain(octaves.flat_map(|(name, value)| octave(name, value)))
            .chain(self.wall.ranges())
            // In single precision, so that a limit written as 0.005 is in range; NaN must be out of range.
            .find(|&(_, value, low, high)| !(value as f32 >= low as f32 && value as f32 <= high as f32))
            .map(|(key, value, low, high)| RangeError { key, value, low, high })
    }
}
