//! The sides of counters and gates, which are boards and sheet metal and no plaster.

use super::material::WallMaterial;
use super::settings::{SkirtingLook, WallLook};
use crate::math::srgb::Srgb8;
use crate::walls::Face;

/// Colour of the plinth, sRGB.
const PLINTH: Srgb8 = [66, 65, 63];
/// Factor on the history of gloss paint: furniture is wiped, but not washed as walls are.
const HISTORY: u64 = 3;

/// What the sides of furniture are made of that is drawn as a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cladding {
    /// Laminate of counters.
    Counter,
    /// Lacquered sheet metal of gates.
    Gate,
}

impl Cladding {
    pub const ALL: [Cladding; 2] = [Cladding::Counter, Cladding::Gate];

    /// That of a face; `None` for walls and lower furniture.
    pub fn of(face: &Face) -> Option<Cladding> {
        face.is_counter().then_some(if face.is_gate() { Cladding::Gate } else { Cladding::Counter })
    }

    /// The look of such sides in rooms with walls of a look.
    pub fn look(self, wall: &WallLook) -> WallLook {
        let (colour, roughness, chips) = match self {
            Cladding::Counter => (wall.counter_colour, 0.38, wall.chips),
            Cladding::Gate => (wall.gate_colour, 0.32, 0.0),
        };
        WallLook {
            material: WallMaterial::Gloss,
            colour: Some(colour),
            roughness: Some(roughness),
            image: None,
            chips,
            total_passes: wall.total_passes.saturating_mul(HISTORY),
            skirting: SkirtingLook { colour: PLINTH, ..wall.skirting },
            ..wall.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::WallResolver;
    use super::super::tests::{PEOPLE, scene};
    use crate::look::Look;

    #[test]
    fn counters_and_gates_are_no_plaster() {
        // A room with a gate of 0.3 x 1.6 m, a counter of 0.8 x 1.6 m and a pillar as slender as the gate.
        let stands = |column: usize, row: usize| {
            (4..20).contains(&row) && [8..11, 18..26, 32..35].iter().any(|columns| columns.contains(&column))
        };
        let mut scene = scene(44, 24, 100.0, |column, row| {
            (2..42).contains(&column) && (2..22).contains(&row) && !stands(column, row)
        });
        let at = |x_m: f64, faces: &[crate::walls::Face]| {
            let is_there = |p: &crate::math::Vec2| (p.x - x_m).abs() < 0.45;
            faces.iter().position(|face| face.points_m.iter().all(is_there)).unwrap()
        };
        let [gate, counter, pillar] = [0.95, 2.2, 3.35].map(|x_m| at(x_m, &scene.walls.faces));
        for face in [gate, counter] {
            scene.walls.faces[face].furniture_m = Some(1.0);
        }
        let look = Look::default();
        let resolver = WallResolver::new(&scene.sums, &scene.walls, &look, PEOPLE).unwrap();
        let is_like = |face: usize, rows: i64, colour: [u8; 3]| {
            let block = resolver.resolve(face, 0, rows, 100, 4);
            let sum = |k: usize| block.base_color.iter().map(|texel| u32::from(texel[k])).sum::<u32>() / 400;
            let found = [0, 1, 2].map(sum);
            let off = found.iter().zip(colour).map(|(&found, wanted)| found.abs_diff(u32::from(wanted))).max();
            assert!(off <= Some(8), "face {face}: {found:?}, not {colour:?}");
        };
        is_like(gate, 60, look.wall.gate_colour);
        is_like(counter, 60, look.wall.counter_colour);
        is_like(pillar, 60, [228, 227, 223]);
        is_like(gate, 1, super::PLINTH);
    }
}
