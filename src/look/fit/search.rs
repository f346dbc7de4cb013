//! Changes a look until the measures of our floor are those of the photograph.

use rayon::prelude::*;

use super::measure::{GRAIN_TEXELS_PER_M, Measured, Parts, Uneven, colour, density, marks_per_m2};
use super::ours::OurFloor;
use super::photo::FloorPicture;
use crate::look::error::LookError;
use crate::look::settings::{AgeLook, Look};
use crate::math::srgb::{self, luminance};

/// Rounds of changing colours and densities: at first, and after each other change.
const ROUNDS: [usize; 2] = [7, 2];
/// Rounds of changing unevenness.
const UNEVEN_ROUNDS: usize = 2;
/// How far a colour of soil goes towards what the lane asks for: its density follows its colour.
const DAMPED: f64 = 0.6;
/// Floors of ours, of other seeds, over which measures are averaged.
const SEEDS: u64 = 4;
/// Least and greatest change of a density in a round.
const CHANGE: [f64; 2] = [0.3, 3.0];
/// Rounds of changing marks.
const MARK_ROUNDS: usize = 3;
/// Least share of the lane's unevenness that is the film's, so that it tells the film's noise.
const LEAST_FILM_SHARE: f64 = 0.3;
/// Fewer marks on the whole floor tell nothing.
const LEAST_MARKS: f64 = 10.0;
/// Least line at a wall that is measured, of 255.
const LEAST_LINE: f64 = 1.0;

pub(super) struct Search<'a> {
    pub look: Look,
    /// What the photograph shows.
    pub target: Measured,
    pub target_marks: f64,
    /// Whether the photograph tells them.
    pub tells_grain: bool,
    pub tells_blotches: bool,
    pub tells_marks: bool,
    /// Linear colour of the part without dirt.
    pub clean: Option<[f64; 3]>,
    ours: &'a OurFloor,
    parts: &'a Parts,
    /// Linear colours of the clean floor and of the film, which the look rounds.
    floor: [f64; 3],
    soil: [f64; 3],
    /// Luminance of the film's colour, which stays.
    soil_light: f64,
}

fn linear(colour: [u8; 3]) -> [f64; 3] {
    srgb::light_of(colour).map(f64::from)
}

fn rounded(linear: [f64; 3]) -> [u8; 3] {
    linear.map(|light| (255.0 * srgb::encode(light.clamp(0.0, 1.0))).round() as u8)
}

impl<'a> Search<'a> {
    pub fn new(
        look: Look,
        (target, target_marks): (Measured, f64),
        clean: Option<[f64; 3]>,
        ours: &'a OurFloor,
        parts: &'a Parts,
    ) -> Search<'a> {
        let soil = linear(look.film.colour);
        let floor = clean.unwrap_or(target.margin);
        Search {
            look,
            target,
            target_marks,
            tells_grain: false,
            tells_blotches: false,
            tells_marks: false,
            clean,
            ours,
            parts,
            floor,
            soil,
            soil_light: luminance(soil),
        }
    }

    pub fn run(&mut self) -> Result<(), LookError> {
        self.colours(ROUNDS[0])?;
        for _ in 0..UNEVEN_ROUNDS {
            self.unevenness()?;
            self.colours(ROUNDS[1])?;
        }
        self.marks()?;
        self.colours(ROUNDS[1])
    }

    /// Our floor with the look.
    pub fn shown(&self) -> Result<FloorPicture, LookError> {
        Ok(self.ours.resolved(&self.look, false)?.0)
    }

    /// Colours and the line at the wall of our floor in the mean over seeds, and, where the photograph shows a part without
    /// dirt, the margin's linear colour without dirt.
    fn measured_colours(&self, seeds: u64) -> Result<(Measured, Option<[f64; 3]>), LookError> {
        let of = |shown: &FloorPicture, bare: Option<&FloorPicture>| {
            (Measured::of_colours(shown, self.parts), bare.map(|bare| colour(bare, &self.parts.margin)))
        };
        let (measured, bare): (Vec<_>, Vec<_>) = self.over_seeds(&self.look, seeds, of)?.into_iter().unzip();
        let bare: Option<Vec<[f64; 3]>> = bare.into_iter().collect();
        let mean =
            |bare: Vec<[f64; 3]>| [0, 1, 2].map(|k| bare.iter().map(|bare| bare[k]).sum::<f64>() / bare.len() as f64);
        Ok((Measured::mean(&measured), bare.map(mean)))
    }

    /// Measures of our floor in the mean over seeds.
    fn measured(&self, look: &Look) -> Result<Measured, LookError> {
        Ok(Measured::mean(&self.over_seeds(look, SEEDS, |shown, _| Measured::of(shown, self.parts))?))
    }

    /// Marks of our floor in the mean over seeds.
    fn marks_of(&self, look: &Look) -> Result<f64, LookError> {
        let all = self.over_seeds(look, SEEDS, |shown, _| marks_per_m2(shown, self.parts))?;
        Ok(all.iter().sum::<f64>() / SEEDS as f64)
    }

    /// Measures of our floor and its marks, in the mean over seeds.
    pub fn measured_with_marks(&self) -> Result<(Measured, f64), LookError> {
        let of = |shown: &FloorPicture, _: Option<&FloorPicture>| {
            (Measured::of(shown, self.parts), marks_per_m2(shown, self.parts))
        };
        let (measured, marks): (Vec<_>, Vec<_>) = self.over_seeds(&self.look, SEEDS, of)?.into_iter().unzip();
        Ok((Measured::mean(&measured), marks.iter().sum::<f64>() / SEEDS as f64))
    }

    /// What `measure` finds on our floor, and on the same place without dirt if that is needed, with each of so many seeds.
    fn over_seeds<T: Send>(
        &self,
        look: &Look,
        seeds: u64,
        measure: impl Fn(&FloorPicture, Option<&FloorPicture>) -> T + Sync,
    ) -> Result<Vec<T>, LookError> {
        let of = |seed: u64| {
            let (shown, bare) = self.ours.resolved(&Look { seed, ..look.clone() }, self.clean.is_some())?;
            Ok(measure(&shown, bare.as_ref()))
        };
        (1..=seeds).into_par_iter().map(of).collect()
    }

    pub fn has_walls(&self) -> bool {
        self.parts.has_walls
    }

    /// Changes the colours of floor and film, and the densities of film, age and edge.
    fn colours(&mut self, rounds: usize) -> Result<(), LookError> {
        for round in 0..rounds {
            self.look.floor.colour = Some(rounded(self.floor));
            self.look.film.colour = rounded(self.soil);
            // The way there needs no mean.
            let seeds = if round + ROUNDS[1] < rounds { 1 } else { SEEDS };
            let (ours, bare) = self.measured_colours(seeds)?;
            let target = self.target;
            let soil = self.soil_light;
            // The part without dirt is the floor's own colour; otherwise the margin has the age that the look has.
            let (wanted, has) = self.clean.zip(bare).unwrap_or((target.margin, ours.margin));
            for ((floor, wanted), has) in self.floor.iter_mut().zip(wanted).zip(has) {
                *floor = (*floor * wanted / has.max(1e-4)).clamp(0.001, 0.98);
            }
            if let Some((clean, bare)) = self.clean.zip(bare) {
                let lies = |clean: [f64; 3], margin: [f64; 3]| density(soil, luminance(clean), luminance(margin));
                let more = lies(clean, target.margin) - lies(bare, ours.margin);
                self.look.age.density = (f64::from(self.look.age.density) + more).clamp(0.0, 3.0) as f32;
            }
            let on_lane = |m: &Measured| density(soil, luminance(m.margin), luminance(m.lane));
            let by = on_lane(&target) / on_lane(&ours).max(1e-3);
            let film = &mut self.look.film.density;
            *film = (f64::from(*film) * by.clamp(CHANGE[0], CHANGE[1])).clamp(0.0, 3.0) as f32;
            let covered = 1.0 - crate::math::exp(-on_lane(&target));
            for k in 0..3 {
                // Both are compared over the same margin, whose colour may not be reached yet.
                let lane = ours.lane[k] * target.margin[k] / ours.margin[k].max(1e-4);
                self.soil[k] = (self.soil[k] + DAMPED * (target.lane[k] - lane) / covered.max(0.1)).clamp(0.004, 0.9);
            }
            let light = luminance(self.soil);
            self.soil = self.soil.map(|part| part * self.soil_light / light);
            self.edge(&ours);
        }
        Ok(())
    }

    fn edge(&mut self, ours: &Measured) {
        if !self.parts.has_walls {
            return;
        }
        let ([line, beside], [our_line, our_beside]) = (self.target.edge, ours.edge);
        // Over a dark floor the line is lighter.
        let by = if line.abs() < LEAST_LINE { CHANGE[0] } else { line / our_line };
        let edge = &mut self.look.edge;
        if by.is_finite() && by > 0.0 {
            edge.density = (f64::from(edge.density) * by.clamp(CHANGE[0], CHANGE[1])).clamp(0.0, 3.0) as f32;
        }
        let wider = (beside / line) / (our_beside / our_line);
        if wider.is_finite() && wider > 0.0 && line.abs() >= LEAST_LINE {
            edge.reach_m = (f64::from(edge.reach_m) * wider.sqrt().clamp(0.7, 1.4)).clamp(0.005, 0.5) as f32;
        }
    }

    /// Changes grain and blotches: variances of noise add to those of texture and prints.
    fn unevenness(&mut self) -> Result<(), LookError> {
        let mut flat = self.look.clone();
        flat.noise.fine.sd = 0.0;
        flat.noise.middle.sd = 0.0;
        flat.mop.unevenness = 0.0;
        let (without, with) = (self.measured(&flat)?, self.measured(&self.look)?);
        let factor = |target: Uneven, without: Uneven, with: Uneven| {
            let [wanted, has] = [target, with].map(|uneven| uneven.beyond - without.beyond);
            let is_told = has > 0.0 && wanted > LEAST_FILM_SHARE * target.lane;
            is_told.then(|| (wanted / has).clamp(0.04, 25.0).sqrt())
        };
        let grain = factor(self.target.grain, without.grain, with.grain);
        // Flecks smaller than a pixel are weaker in the photograph than in ours: grain has to outweigh them.
        let outweighs = self.target.grain.beyond > LEAST_FILM_SHARE * self.target.grain.lane;
        let grain = grain.filter(|_| outweighs && self.ours.texels_per_metre() >= GRAIN_TEXELS_PER_M);
        let blotches = factor(self.target.blotches, without.blotches, with.blotches);
        self.tells_grain = grain.is_some();
        self.tells_blotches = blotches.is_some();
        let scaled = |sd: &mut f32, by: Option<f64>, most: f64| {
            *sd = (f64::from(*sd) * by.unwrap_or(1.0)).min(most) as f32;
        };
        let Look { noise, mop, .. } = &mut self.look;
        scaled(&mut noise.fine.sd, grain, 1.0);
        scaled(&mut noise.middle.sd, blotches, 1.0);
        scaled(&mut mop.unevenness, blotches, 3.0);
        Ok(())
    }

    /// Changes how many rubs, grains of grit and pieces of gum there are.
    fn marks(&mut self) -> Result<(), LookError> {
        let area_m2 = self.parts.area_m2(self.ours.texels_per_metre());
        for _ in 0..MARK_ROUNDS {
            let with_marks = |by: f32| Look { age: self.age_with_marks(by), ..self.look.clone() };
            let (without, with) = (self.marks_of(&with_marks(0.0))?, self.marks_of(&with_marks(1.0))?);
            let few = (self.target_marks.max(with) - without) * area_m2 < LEAST_MARKS;
            if few || with - without <= 0.1 * without {
                return Ok(());
            }
            let by = (self.target_marks - without) / (with - without);
            self.look.age = self.age_with_marks(by.clamp(0.0, 5.0) as f32);
            self.tells_marks = true;
        }
        Ok(())
    }

    fn age_with_marks(&self, by: f32) -> AgeLook {
        let age = &self.look.age;
        AgeLook {
            rubs_per_m2: (by * age.rubs_per_m2).min(90.0),
            grit_per_m2: (by * age.grit_per_m2).min(60.0),
            gum_per_m2: (by * age.gum_per_m2).min(20.0),
            ..age.clone()
        }
    }
}
