//! Floor shader: computes densities, colours and roughness per texel from sums.
//!
//! Works on runs of texels, with a plane per quantity and a loop per step, for vectorisation.

use super::bytes::{Bytes, Rounding, ShadedPlanes};
use super::dirt::{Beneath, Dirt};
use super::material::Properties;
use super::noise::Noise;
use super::planes::{add1, add2, each1, each2, each3};
use super::settings::Look;
use crate::math::{exp_f32, ln_f32, srgb};

/// Roughness of loose dirt.
const DIRT_ROUGHNESS: f32 = 0.8;
/// Roughness between a clean stripe and all that a mop may leave.
const MOP_ROUGHNESS: f32 = 0.12;
/// Roughness of standing water.
const WATER_ROUGHNESS: f32 = 0.06;
/// Passes after which the film has the density that the look names.
const FULL_PASSES: f32 = 1000.0;
/// Seconds after which the film of standing has the density that the look names.
const FULL_SECONDS: f32 = 1000.0;
/// Share of the lines of all wheels that soles and mops have not worn off.
const LINES_LEFT: f32 = 0.4;
/// Limit on the factor on single wheels: the mop takes old lines, so that those of a long history are no darker.
const MOST_SINGLE_WHEELS: f32 = 5.5;
/// Limit on the factor by which the film's noise, to the third power, breaks a line.
const MOST_UNEVEN_LINES: f32 = 2.0;
/// The mask of passes is full at 10 000: ln(1 + 300) / ln(1 + 30) e-folds with the film's usual rate.
const MASK_PER_TRODDEN: f32 = 0.6;

/// Values of a look that are the same for all texels.
#[derive(Clone, Debug)]
pub(super) struct FloorShader {
    /// Passes of the whole history per simulated pass.
    pub weight: f32,
    /// Factor on the deviation of single passes from their mean.
    residual: f32,
    /// `per_pass` of the film, and 1 / ln(1 + 1000 per_pass).
    per_pass: f32,
    per_ln: f32,
    /// `per_pass` of the film that cleaning leaves.
    left_per_pass: f32,
    film: f32,
    low_film: f32,
    /// Film per e-fold of standing time, and its rate per second of the simulated people.
    dwell: f32,
    per_second: f32,
    /// Factor on the deviation of single wheels from their mean.
    single_wheels: f32,
    /// Film of many wheels, and the share that each adds.
    wheels: f32,
    per_wheel: f32,
    age: f32,
    joint_film: [f32; 2],
    every_pass: f32,
    dust: f32,
    /// 1 / passes that wear the floor, and the factor on wear.
    wear_per_pass: f32,
    wear: f32,
    /// Weight of the effort of turns and stops.
    turns: f32,
    worn: [f32; 3],
    /// Logarithm of the divisor that gives the lognormal noise a mean of 1.
    mean_log: f32,
    roughness: [f32; 2],
    /// Kinds of dirt: film, prints, scuffs, edge, dust, wheels.
    kinds: [Dirt; 6],
    beneath: Beneath,
}

/// The clean floor along a run of texels, as in [`SurfacePlanes`](super::surface::SurfacePlanes).
#[derive(Default)]
pub(super) struct SurfaceRow {
    pub rgb: [Vec<f32>; 3],
    pub joint: Vec<f32>,
    pub height: Vec<f32>,
    pub rough: Vec<f32>,
}

/// Inputs of the shader for a run of texels.
#[derive(Default)]
pub(super) struct ShadeInput {
    pub ground: SurfaceRow,
    /// Share of the film that the mop left.
    pub left: Vec<f32>,
    /// Simulated passes: expected, and counted.
    pub presence: Vec<f32>,
    pub passes: Vec<f32>,
    /// Seconds that they stood, and passes of wear that turns and stops add.
    pub dwell: Vec<f32>,
    pub grind: Vec<f32>,
    /// Wheels that rolled over: expected, and counted.
    pub rolled: Vec<f32>,
    pub wheels: Vec<f32>,
    /// Sum of the noises.
    pub uneven: Vec<f32>,
    /// Optical densities, including factors of look and material.
    pub soil: Vec<f32>,
    pub scuff: Vec<f32>,
    pub edge: Vec<f32>,
    /// exp(-distance / reach) to the nearest wall.
    pub dust: Vec<f32>,
    /// Share of the texel that water covers.
    pub water: Vec<f32>,
}

/// Results of the shader for a run of texels.
#[derive(Default)]
pub(super) struct ShadeOutput {
    /// Optical densities. In the end the film has that of wheels.
    pub film: Vec<f32>,
    wheels: Vec<f32>,
    pub soil: Vec<f32>,
    pub dust: Vec<f32>,
    /// Passes in the whole history, and the logarithmic share of the film's density that they leave.
    history: Vec<f32>,
    trodden: Vec<f32>,
    /// Film of passes and standing, before noise and mop.
    laid: Vec<f32>,
    /// Passes of the whole history that wear the floor.
    wearing: Vec<f32>,
    /// Wear, 0 to 1.
    worn: Vec<f32>,
    /// Opacity of passes in the mask, as a transmittance.
    busy: Vec<f32>,
    /// Noise, as a factor.
    uneven: Vec<f32>,
    /// Transmittance of film; of prints; of edge and dust; of scuffs.
    through: [Vec<f32>; 4],
    /// Sum of densities of each channel: buffers.
    totals: [Vec<f32>; 3],
    roughness: Vec<f32>,
    rgb: [Vec<f32>; 3],
    /// Linear colour of the floor without dirt.
    pub bare: [Vec<f32>; 3],
    joint: [Vec<f32>; 3],
    rounding: Rounding,
}

impl ShadeInput {
    pub fn clear(&mut self, len: usize) {
        let ShadeInput {
            left,
            presence,
            passes,
            dwell,
            grind,
            rolled,
            wheels,
            uneven,
            soil,
            scuff,
            edge,
            dust,
            water,
            ..
        } = self;
        for plane in [left, presence, passes, dwell, grind, rolled, wheels, uneven, soil, scuff, edge, dust, water] {
            plane.clear();
            plane.resize(len, 0.0);
        }
    }
}

impl FloorShader {
    pub fn new(
        look: &Look,
        properties: &Properties,
        clean: [f32; 3],
        simulated_people: u32,
        noise: &[Noise],
        density: f64,
    ) -> FloorShader {
        let weight = (look.total_passes as f64 / f64::from(simulated_people)) as f32;
        // With fewer passes than simulated, there is nothing to smooth.
        let residual = if properties.shows_single_passes { weight.min(weight.sqrt()) } else { 0.0 };
        let colours = [
            look.film.colour,
            look.prints.colour,
            look.scuffs.colour,
            look.edge.colour,
            look.dust.colour,
            look.wheels.colour,
        ];
        FloorShader {
            weight,
            residual,
            per_pass: look.film.per_pass,
            per_ln: 1.0 / ln_f32(1.0 + FULL_PASSES * look.film.per_pass).max(1e-6),
            left_per_pass: look.film.per_pass * look.mop.passes_left(look.total_passes),
            film: look.film.density * properties.film,
            low_film: properties.low_film,
            dwell: look.dwell.density * properties.film / ln_f32(1.0 + FULL_SECONDS * look.dwell.per_second).max(1e-6),
            per_second: weight * look.dwell.per_second,
            single_wheels: residual.min(MOST_SINGLE_WHEELS),
            wheels: look.wheels.density * properties.film,
            per_wheel: look.wheels.per_wheel,
            age: look.age.density * properties.film.max(0.5),
            joint_film: properties.joint_film.map(|share| share * look.film.density),
            every_pass: look.prints.every_pass,
            dust: look.dust.density * properties.dust,
            wear_per_pass: 1.0 / properties.wear_passes,
            wear: look.wear.strength,
            turns: weight * look.wear.turns,
            worn: properties.worn,
            mean_log: noise.iter().map(|noise| noise.sd_of_texels(density)).map(|sd| 0.5 * sd * sd).sum(),
            roughness: properties.roughness,
            kinds: colours.map(|colour| Dirt::of(srgb::light_of(colour))),
            beneath: Beneath::of(look, clean),
        }
    }

    /// Computes a run. Joints, if there are any, have the colour `joint`.
    pub fn shade(&self, known: &mut ShadeInput, joint: Option<[f32; 3]>, out: &mut ShadeOutput) {
        out.resize(known.presence.len());
        self.densities(known, out);
        self.roughness(known, out);
        for (channel, plane) in known.ground.rgb.iter_mut().enumerate() {
            let change = self.worn[channel] - 1.0;
            if change != 0.0 {
                plane.iter_mut().zip(&out.worn).for_each(|(light, worn)| *light *= 1.0 + change * worn);
            }
        }
        let ShadeOutput { film, soil, dust, wheels, rgb, bare, totals, .. } = out;
        for (bare, floor) in bare.iter_mut().zip(&known.ground.rgb) {
            bare.copy_from_slice(floor);
        }
        let dirt = [&*film, &*soil, &known.scuff, &known.edge, &*dust, &*wheels];
        self.colour(dirt, &known.ground.rgb, totals, rgb);
        if let Some(joint) = joint.filter(|_| known.ground.joint.iter().any(|&share| share > 0.0)) {
            self.fill_joints(known, joint, out);
        }
        add1(&mut out.film, &out.wheels, |wheels| wheels);
    }

    fn densities(&self, known: &ShadeInput, out: &mut ShadeOutput) {
        let ShadeOutput {
            history, trodden, laid, wearing, worn, busy, uneven, film, wheels, soil, dust, through, ..
        } = out;
        let [through_film, through_prints, through_edge, through_scuffs] = through;
        each2(history, &known.presence, &known.passes, |expected, counted| {
            (self.weight * expected + self.residual * (counted - expected)).max(0.0)
        });
        each1(uneven, &known.uneven, |noise| exp_f32(noise - self.mean_log));
        each1(trodden, history, |passes| self.per_ln * ln_f32(1.0 + self.left_per_pass * passes));
        each2(wearing, history, &known.grind, |passes, effort| passes + self.turns * effort.max(0.0));
        each2(worn, wearing, uneven, |passes, uneven| {
            self.wear * (1.0 - exp_f32(-self.wear_per_pass * passes * uneven * uneven))
        });
        if self.left_per_pass == self.per_pass {
            each1(busy, trodden, |trodden| 1.0 - (trodden * MASK_PER_TRODDEN).min(1.0));
        } else {
            let per_ln = MASK_PER_TRODDEN * self.per_ln;
            each1(busy, history, |passes| 1.0 - (per_ln * ln_f32(1.0 + self.per_pass * passes)).min(1.0));
        }
        each1(laid, trodden, |trodden| self.film * trodden);
        if self.dwell > 0.0 && known.dwell.iter().any(|&seconds| seconds > 0.0) {
            for ((laid, seconds), uneven) in laid.iter_mut().zip(&known.dwell).zip(&*uneven) {
                // Feet shuffle: evened out alone, the places where people stood are clouds.
                let shuffled = uneven * uneven * uneven * uneven;
                *laid += self.dwell * ln_f32(1.0 + self.per_second * shuffled * seconds.max(0.0));
            }
        }
        each3(film, laid, uneven, &known.left, |laid, uneven, left| {
            (laid * uneven + self.age * (2.0 * uneven - 1.0).max(0.2)) * left
        });
        if self.low_film > 0.0 {
            for (film, height) in film.iter_mut().zip(&known.ground.height) {
                *film *= 1.0 + (-self.low_film * height).clamp(-0.5, 1.0);
            }
        }
        self.lines(known, uneven, wheels);
        each2(soil, &known.soil, &known.passes, |fresh, passes| fresh + self.every_pass * passes);
        each3(dust, &known.dust, trodden, uneven, |wall, trodden, uneven| {
            self.dust * wall.max(0.0) * exp_f32(-6.0 * trodden) * uneven
        });
        each2(through_film, film, wheels, |film, wheels| exp_f32(-film - wheels));
        each1(through_prints, soil, |soil| exp_f32(-soil));
        each1(through_scuffs, &known.scuff, |scuff| exp_f32(-scuff));
        each2(through_edge, &known.edge, dust, |edge, dust| exp_f32(-edge - dust));
    }

    /// Density of the lines of wheels: of the whole history, the simulated ones stand out as single passes do.
    fn lines(&self, known: &ShadeInput, uneven: &[f32], wheels: &mut [f32]) {
        wheels.fill(0.0);
        if self.wheels <= 0.0 || known.rolled.iter().all(|&wheels| wheels <= 0.0) {
            return;
        }
        each2(wheels, &known.rolled, &known.wheels, |expected, counted| {
            let rolled = LINES_LEFT * self.weight * expected + self.single_wheels * (counted - expected);
            self.wheels * (1.0 - exp_f32(-self.per_wheel * rolled.max(0.0)))
        });
        wheels
            .iter_mut()
            .zip(uneven)
            .zip(&known.left)
            .for_each(|((wheels, uneven), left)| *wheels *= (uneven * uneven * uneven).min(MOST_UNEVEN_LINES) * left);
    }

    fn roughness(&self, known: &ShadeInput, out: &mut ShadeOutput) {
        let ShadeOutput { roughness, wearing, uneven, through: [_, prints, edge, scuffs], totals: [loose, ..], .. } =
            out;
        each3(loose, prints, edge, scuffs, |prints, edge, scuffs| 1.0 - prints * edge * scuffs);
        let [smooth, worn] = self.roughness;
        each3(roughness, wearing, uneven, loose, |passes, uneven, loose| {
            let dull = 1.0 - exp_f32(-self.per_pass * passes);
            let floor = smooth + (worn - smooth) * dull * (0.7 + 0.3 * uneven.min(2.0));
            floor + (DIRT_ROUGHNESS.max(floor) - floor) * loose
        });
        // Where the mop left more, the gloss is dull: swirls show against the light.
        add2(roughness, &known.left, &known.ground.rough, |left, rough| MOP_ROUGHNESS * (left - 1.0).min(0.6) + rough);
        for (roughness, water) in roughness.iter_mut().zip(&known.water) {
            let dry = roughness.clamp(0.04, 1.0);
            *roughness = dry + (WATER_ROUGHNESS.min(dry) - dry) * water;
        }
    }

    /// Computes the colour of dirt over a floor. `totals` is a buffer.
    fn colour(&self, dirt: [&Vec<f32>; 6], floor: &[Vec<f32>; 3], totals: &mut [Vec<f32>; 3], rgb: &mut [Vec<f32>; 3]) {
        // Most runs lack some kinds.
        let lies = dirt.map(|density| density.iter().any(|&density| density != 0.0));
        for (n, (plane, total)) in rgb.iter_mut().zip(&mut *totals).enumerate() {
            total.fill(0.0);
            plane.fill(0.0);
            for ((density, kind), _) in dirt.into_iter().zip(&self.kinds).zip(lies).filter(|(_, lies)| *lies) {
                kind.add_to(n, density, total, plane);
            }
        }
        self.beneath.cover(floor, totals, rgb);
    }

    /// Blends joints, with their film, into the share of each texel that they cover.
    fn fill_joints(&self, known: &ShadeInput, joint: [f32; 3], out: &mut ShadeOutput) {
        let mut film = vec![0.0; known.presence.len()];
        let [everywhere, trodden_too] = self.joint_film;
        each2(&mut film, &out.trodden, &out.uneven, |trodden, uneven| {
            (everywhere + trodden_too * trodden) * (0.5 + 0.5 * uneven)
        });
        let floor = joint.map(|light| vec![light; film.len()]);
        let dirt = [&film, &out.soil, &known.scuff, &known.edge, &out.dust, &out.wheels];
        self.colour(dirt, &floor, &mut out.totals, &mut out.joint);
        let [a, b, c, d] = &out.through;
        for ((plane, joint), bare) in out.rgb.iter_mut().zip(&out.joint).zip(&mut out.bare) {
            for (k, value) in plane.iter_mut().enumerate() {
                let change = known.ground.joint[k] * (joint[k] - *value);
                *value += change;
                // A joint's film counts as part of the floor, so that dirt over the bare floor gives the shown colour.
                bare[k] = (bare[k] + change / (a[k] * b[k] * c[k] * d[k]).max(0.02)).max(0.0);
            }
        }
    }
}

impl ShadeOutput {
    fn resize(&mut self, len: usize) {
        let ShadeOutput {
            film,
            wheels,
            soil,
            dust,
            history,
            trodden,
            laid,
            wearing,
            worn,
            busy,
            uneven,
            through,
            totals,
            roughness,
            rgb,
            bare,
            joint,
            rounding: _,
        } = self;
        let single = [film, wheels, soil, dust, history, trodden, laid, wearing, worn, busy, uneven, roughness];
        for plane in single.into_iter().chain(through).chain(totals).chain(rgb).chain(bare).chain(joint) {
            plane.resize(len, 0.0);
        }
    }

    /// Wear and opacity of heel marks of texel `k`, 0 to 255.
    pub fn worn(&self, k: usize) -> [u8; 2] {
        [self.worn[k].min(1.0), 1.0 - self.through[3][k]].map(|share| (255.0 * share + 0.5) as u8)
    }

    /// Opacity of passes in the mask, and wear, of texel `k`.
    pub fn passes_and_wear(&self, k: usize) -> [f32; 2] {
        [1.0 - self.busy[k], self.worn[k]]
    }

    /// Rounds a run that starts at texel (i, j) to 8 bits.
    pub fn write(&mut self, dither: u32, i: i64, j: i64, out: &mut Bytes<'_>) {
        let [film, prints, edge, _] = &self.through;
        let shown =
            ShadedPlanes { rgb: &self.rgb, through: [film, &self.busy, prints, edge], roughness: &self.roughness };
        self.rounding.write(dither, i, j, &shown, out);
    }
}
