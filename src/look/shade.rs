//! Floor shader: computes densities, colours and roughness per texel from sums.
//!
//! Works on runs of texels, with a plane per quantity and a loop per step, for vectorisation.

use super::bytes::{Bytes, Rounding, ShadedPlanes};
use super::clean_floor::CleanFloorRow;
use super::material::Properties;
use super::noise::Noise;
use super::planes::{add2, each1, each2, each3};
use super::settings::Look;
use crate::math::{exp_f32, srgb};

/// Roughness of loose dirt.
const DIRT_ROUGHNESS: f32 = 0.8;

/// Film in joints, as a share of the look's film: off the lanes, and added on lanes.
const JOINT_FILM: f32 = 0.75;
const JOINT_FILM_TRODDEN: f32 = 0.40;

/// Values of a look that are the same for all texels.
#[derive(Clone, Debug)]
pub(super) struct FloorShader {
    /// Passes of the whole history per simulated pass.
    weight: f32,
    /// Factor on the deviation of single passes from their mean.
    residual: f32,
    per_pass: f32,
    film: f32,
    ingrained_per_pass: f32,
    ingrained: f32,
    joint_film: f32,
    every_pass: f32,
    dust: f32,
    /// Logarithm of the divisor that gives the lognormal noise a mean of 1.
    mean_log: f32,
    roughness: [f32; 2],
    colours: Colours,
}

/// Linear colours of dirt.
#[derive(Clone, Debug)]
struct Colours {
    film: [f32; 3],
    prints: [f32; 3],
    scuffs: [f32; 3],
    edge: [f32; 3],
    dust: [f32; 3],
    darkest: f32,
}

/// Inputs of the shader for a run of texels.
#[derive(Default)]
pub(super) struct ShadeInput {
    pub ground: CleanFloorRow,
    /// Simulated passes: expected, and counted.
    pub presence: Vec<f32>,
    pub passes: Vec<f32>,
    /// Sum of the noises.
    pub uneven: Vec<f32>,
    /// Optical densities, including factors of look and material.
    pub soil: Vec<f32>,
    pub scuff: Vec<f32>,
    pub edge: Vec<f32>,
    /// exp(-distance / reach) to the nearest wall.
    pub dust: Vec<f32>,
}

/// Results of the shader for a run of texels.
#[derive(Default)]
pub(super) struct ShadeOutput {
    /// Optical densities.
    pub film: Vec<f32>,
    pub soil: Vec<f32>,
    pub dust: Vec<f32>,
    /// Passes in the whole history, and exp(-per_pass n).
    history: Vec<f32>,
    clean: Vec<f32>,
    /// Noise, as a factor.
    uneven: Vec<f32>,
    /// Transmittance of film; of prints and scuffs; of edge and dust.
    through: [Vec<f32>; 3],
    hiding: Vec<f32>,
    roughness: Vec<f32>,
    rgb: [Vec<f32>; 3],
    /// Linear colour of the floor without dirt.
    pub bare: [Vec<f32>; 3],
    joint: [Vec<f32>; 3],
    rounding: Rounding,
}

impl ShadeInput {
    pub fn clear(&mut self, len: usize) {
        let ShadeInput { ground: _, presence, passes, uneven, soil, scuff, edge, dust } = self;
        for plane in [presence, passes, uneven, soil, scuff, edge, dust] {
            plane.clear();
            plane.resize(len, 0.0);
        }
    }
}

impl FloorShader {
    pub fn new(
        look: &Look,
        properties: &Properties,
        simulated_people: u32,
        noise: &[Noise],
        density: f64,
    ) -> FloorShader {
        let weight = (look.total_passes as f64 / f64::from(simulated_people)) as f32;
        // With fewer passes than simulated, there is nothing to smooth.
        let residual = if properties.shows_single_passes { weight.min(weight.sqrt()) } else { 0.0 };
        FloorShader {
            weight,
            residual,
            per_pass: look.film.per_pass,
            film: look.film.density * properties.film,
            ingrained_per_pass: look.ingrained.per_pass,
            ingrained: look.ingrained.density * properties.film,
            joint_film: look.film.density,
            every_pass: look.prints.every_pass,
            dust: look.dust.density * properties.dust,
            mean_log: noise.iter().map(|noise| noise.sd_of_texels(density)).map(|sd| 0.5 * sd * sd).sum(),
            roughness: properties.roughness,
            colours: Colours {
                film: srgb::light_of(look.film.colour),
                prints: srgb::light_of(look.prints.colour),
                scuffs: srgb::light_of(look.scuffs.colour),
                edge: srgb::light_of(look.edge.colour),
                dust: srgb::light_of(look.dust.colour),
                darkest: srgb::decode(f64::from(look.darkest) / 255.0) as f32,
            },
        }
    }

    /// Computes a run. Joints, if there are any, have the colour `joint`.
    pub fn shade(&self, known: &ShadeInput, joint: Option<[f32; 3]>, out: &mut ShadeOutput) {
        out.resize(known.presence.len());
        self.densities(known, out);
        self.roughness(out);
        let ShadeOutput { film, soil, dust, through, rgb, bare, hiding, .. } = out;
        for (bare, floor) in bare.iter_mut().zip(&known.ground.rgb) {
            bare.copy_from_slice(floor);
        }
        let dirt = DirtPlanes { film, soil, scuff: &known.scuff, edge: &known.edge, dust, through };
        self.colour(&dirt, &known.ground.rgb, hiding, rgb);
        if let Some(joint) = joint.filter(|_| known.ground.joint.iter().any(|&share| share > 0.0)) {
            self.fill_joints(known, joint, out);
        }
    }

    fn densities(&self, known: &ShadeInput, out: &mut ShadeOutput) {
        let ShadeOutput { history, clean, uneven, film, soil, dust, through, .. } = out;
        let [through_film, through_prints, through_edge] = through;
        each2(history, &known.presence, &known.passes, |expected, counted| {
            (self.weight * expected + self.residual * (counted - expected)).max(0.0)
        });
        each1(uneven, &known.uneven, |noise| exp_f32(noise - self.mean_log));
        each1(clean, history, |passes| exp_f32(-self.per_pass * passes));
        each3(film, history, clean, uneven, |passes, clean, uneven| {
            let ingrained = self.ingrained * (1.0 - exp_f32(-self.ingrained_per_pass * passes));
            (self.film * (1.0 - clean) + ingrained) * uneven
        });
        each2(soil, &known.soil, &known.passes, |fresh, passes| fresh + self.every_pass * passes);
        each3(dust, &known.dust, clean, uneven, |wall, clean, uneven| self.dust * wall.max(0.0) * clean * uneven);
        each1(through_film, film, |film| exp_f32(-film));
        each2(through_prints, soil, &known.scuff, |soil, scuff| exp_f32(-soil - scuff));
        each2(through_edge, &known.edge, dust, |edge, dust| exp_f32(-edge - dust));
    }

    fn roughness(&self, out: &mut ShadeOutput) {
        let ShadeOutput { roughness, clean, uneven, through: [_, prints, edge], hiding: loose, .. } = out;
        each2(loose, prints, edge, |prints, edge| 1.0 - prints * edge);
        let [smooth, worn] = self.roughness;
        each3(roughness, clean, uneven, loose, |clean, uneven, loose| {
            let floor = smooth + (worn - smooth) * (1.0 - clean) * (0.7 + 0.3 * uneven.min(2.0));
            floor + (DIRT_ROUGHNESS.max(floor) - floor) * loose
        });
    }

    /// Computes the colour of dirt over a floor. `hiding` is a buffer.
    fn colour(&self, dirt: &DirtPlanes<'_>, floor: &[Vec<f32>; 3], hiding: &mut [f32], rgb: &mut [Vec<f32>; 3]) {
        let [a, b, c] = dirt.through;
        // Opacity per optical density: (1 - T) / sum(D).
        each3(hiding, dirt.film, dirt.soil, dirt.scuff, |film, soil, scuff| film + soil + scuff);
        add2(hiding, dirt.edge, dirt.dust, |edge, dust| edge + dust);
        for (((hiding, a), b), c) in hiding.iter_mut().zip(a).zip(b).zip(c) {
            *hiding = (1.0 - a * b * c) / hiding.max(1e-6);
        }
        let colours = &self.colours;
        for (n, (plane, floor)) in rgb.iter_mut().zip(floor).enumerate() {
            let [film, soil, scuff] = [colours.film[n], colours.prints[n], colours.scuffs[n]];
            let [edge, dust] = [colours.edge[n], colours.dust[n]];
            each3(plane, dirt.film, dirt.soil, dirt.scuff, |f, p, s| f * film + p * soil + s * scuff);
            add2(plane, dirt.edge, dirt.dust, |e, d| e * edge + d * dust);
            for (((((plane, hiding), floor), a), b), c) in
                plane.iter_mut().zip(&*hiding).zip(floor).zip(a).zip(b).zip(c)
            {
                // Dirt darkens no texel below the darkest value, and does not lighten a darker floor to it.
                *plane = (floor * (a * b * c) + *plane * hiding).max(colours.darkest.min(*floor));
            }
        }
    }

    /// Blends joints, with their film, into the share of each texel that they cover.
    fn fill_joints(&self, known: &ShadeInput, joint: [f32; 3], out: &mut ShadeOutput) {
        let mut film = vec![0.0; known.presence.len()];
        each2(&mut film, &out.clean, &out.uneven, |clean, uneven| {
            self.joint_film * (JOINT_FILM + JOINT_FILM_TRODDEN * (1.0 - clean)) * uneven
        });
        let mut through = out.through.clone();
        each1(&mut through[0], &film, |film| exp_f32(-film));
        let floor = joint.map(|light| vec![light; film.len()]);
        let dirt = DirtPlanes {
            film: &film,
            soil: &out.soil,
            scuff: &known.scuff,
            edge: &known.edge,
            dust: &out.dust,
            through: &through,
        };
        self.colour(&dirt, &floor, &mut out.hiding, &mut out.joint);
        let [a, b, c] = &out.through;
        for ((plane, joint), bare) in out.rgb.iter_mut().zip(&out.joint).zip(&mut out.bare) {
            for (k, value) in plane.iter_mut().enumerate() {
                let change = known.ground.joint[k] * (joint[k] - *value);
                *value += change;
                // A joint's film counts as part of the floor, so that dirt over the bare floor gives the shown colour.
                bare[k] = (bare[k] + change / (a[k] * b[k] * c[k]).max(0.02)).max(0.0);
            }
        }
    }
}

/// Planes of optical densities, and the transmittance.
struct DirtPlanes<'a> {
    film: &'a [f32],
    soil: &'a [f32],
    scuff: &'a [f32],
    edge: &'a [f32],
    dust: &'a [f32],
    through: &'a [Vec<f32>; 3],
}

impl ShadeOutput {
    fn resize(&mut self, len: usize) {
        let ShadeOutput {
            film,
            soil,
            dust,
            history,
            clean,
            uneven,
            through,
            hiding,
            roughness,
            rgb,
            bare,
            joint,
            rounding: _,
        } = self;
        let single = [film, soil, dust, history, clean, uneven, hiding, roughness];
        for plane in single.into_iter().chain(through).chain(rgb).chain(bare).chain(joint) {
            plane.resize(len, 0.0);
        }
    }

    /// Rounds a run that starts at texel (i, j) to 8 bits.
    pub fn write(&mut self, dither: u32, i: i64, j: i64, out: &mut Bytes<'_>) {
        let [film, prints, edge] = &self.through;
        let shown =
            ShadedPlanes { rgb: &self.rgb, through: [film, &self.clean, prints, edge], roughness: &self.roughness };
        self.rounding.write(dither, i, j, &shown, out);
    }
}
