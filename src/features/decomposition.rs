use nalgebra::DMatrix;
use serde::Serialize;

use super::displacement::{Displacement, column_squares, columns_of};
use super::modulation::{Modulation, SelectedComponent, check_components};
use super::neighbours::KirchhoffSums;
use super::progress_range::ProgressRange;
use super::{FeaturesError, FeaturesOptions, Method, laplacian, principal};
use crate::motion::Ensemble;
use crate::progress::Progress;

/// Mean displacement up to which a crowd stands still, metres.
const STILL_M: f64 = 1e-9;

/// A crowd's motion in a basis of components, see [the module](super).
#[derive(Clone, Debug)]
pub struct Features {
    options: FeaturesOptions,
    pub(super) displacement: Displacement,
    components: Vec<FeatureComponent>,
    /// A column per component: for principal components the x of all people and then their y, for the Laplacian a number
    /// per person.
    vectors: DMatrix<f64>,
    /// A column per component: for principal components a number per frame, for the Laplacian one per frame for x, then
    /// one per frame for y.
    coefficients: DMatrix<f64>,
    mean_neighbours: Option<f64>,
}

/// The weight of a component in a motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FeatureComponent {
    /// Eigenvalue by which components are ordered.
    ///
    /// For principal components the variance in square metres, for the Laplacian the variance of the neighbourhoods, in
    /// neighbours squared.
    pub eigenvalue: f64,
    /// Mean square of the component's coefficients over time, square metres, summed over people.
    pub variance_m2: f64,
    /// Share of the motion's total variance, 0 to 1.
    pub share: f64,
}

impl Features {
    /// Finds the components of a motion.
    ///
    /// Memory: a few copies of the positions. Time: the cube of the number of frames or coordinates, whichever is smaller
    /// (principal components), or of people (Laplacian); 500 people in 2000 frames take about a second.
    ///
    /// # Errors
    /// Fewer than 2 people or 2 frames; more positions than `MOST_FEATURE_PLACES` or rows
    /// than [`MOST_ROWS`](super::MOST_ROWS); positions out of range; people who do not move relative to their centroid; a
    /// neighbour distance out of range; [`FeaturesError::Interrupted`].
    ///
    /// # Example
    /// ```
    /// use trodden::features::{Features, FeaturesOptions};
    /// use trodden::math::{sin_cos, vec2};
    /// use trodden::motion::Ensemble;
    ///
    /// // Two people sway towards each other and apart: one component says it all.
    /// let place = |k: u32| [-1.0, 1.0].map(|side| vec2(side * (1.0 + 0.2 * sin_cos(0.3 * f64::from(k)).0), 0.0));
    /// let crowd = Ensemble::new(10.0, 0.0, vec![0, 1], (0..50).flat_map(place).collect());
    /// let features = Features::find(&crowd, &FeaturesOptions::default(), &trodden::Silent)?;
    /// assert!(features.components()[0].share > 0.999);
    /// # Ok::<(), trodden::Error>(())
    /// ```
    pub fn find(
        ensemble: &Ensemble,
        options: &FeaturesOptions,
        progress: &dyn Progress,
    ) -> Result<Features, FeaturesError> {
        Features::find_part(ensemble, options, &ProgressRange::whole(progress))
    }

    pub(super) fn find_part(
        ensemble: &Ensemble,
        options: &FeaturesOptions,
        progress: &ProgressRange<'_>,
    ) -> Result<Features, FeaturesError> {
        options.check()?;
        progress.advance(0.0);
        let displacement = Displacement::of(ensemble)?;
        let displacements = displacement.matrix(ensemble, options.method);
        let (people, moments) = (displacement.people() as f64, displacement.moments() as f64);
        let total_m2 = displacements.norm_squared() / moments;
        let still_m = STILL_M.max(displacement.rounding_m());
        if total_m2 <= people * still_m * still_m {
            return Err(FeaturesError::Still);
        }
        progress.advance(0.1);
        let (values, vectors, mean_neighbours) = match options.method {
            Method::Pca => {
                let rounding_m = displacement.rounding_m();
                (None, principal::components(&displacements, rounding_m, &progress.range(0.1, 0.9))?, None)
            }
            Method::Laplacian => {
                let sums = KirchhoffSums::of(ensemble, options.neighbour_distance_m, &progress.range(0.1, 0.5))?;
                let found = laplacian::components(&sums, &displacements, &progress.range(0.5, 0.9))?;
                (Some(found.values), found.vectors, Some(sums.mean_neighbours()))
            }
        };
        progress.keep_on()?;
        let coefficients = &displacements * &vectors;
        let variances: Vec<f64> = column_squares(&coefficients).iter().map(|sum| sum / moments).collect();
        let mut order: Vec<usize> = (0..variances.len()).collect();
        if options.method == Method::Pca {
            // The eigenvalue is the variance; measured along the vectors, small ones are exact.
            order.sort_by(|&a, &b| variances[b].total_cmp(&variances[a]));
        }
        let component = |&at: &usize| FeatureComponent {
            eigenvalue: values.as_ref().map_or(variances[at], |values| values[at]),
            variance_m2: variances[at],
            share: variances[at] / total_m2,
        };
        let found = Features {
            options: *options,
            displacement,
            components: order.iter().map(component).collect(),
            vectors: columns_of(&vectors, &order),
            coefficients: columns_of(&coefficients, &order),
            mean_neighbours,
        };
        progress.advance(1.0);
        Ok(found)
    }

    /// The options with which the components were found.
    pub fn options(&self) -> &FeaturesOptions {
        &self.options
    }

    /// Number of people.
    pub fn people(&self) -> usize {
        self.displacement.people()
    }

    /// Number of frames.
    pub fn moments(&self) -> usize {
        self.displacement.moments()
    }

    /// The components, by descending eigenvalue.
    ///
    /// Principal components without motion are left out; there are at most 2n - 2 for n people, because the centroid is
    /// kept apart. The Laplacian always has n.
    pub fn components(&self) -> &[FeatureComponent] {
        &self.components
    }

    /// Mean number of neighbours of a person; `None` for principal components.
    pub fn mean_neighbours(&self) -> Option<f64> {
        self.mean_neighbours
    }

    /// The unit vector of a component, numbered from 0.
    ///
    /// For principal components the x of all people and then their y, in the order of ids; for the Laplacian a number per
    /// person.
    pub fn vector(&self, component: usize) -> Vec<f64> {
        self.vectors.column(component).iter().copied().collect()
    }

    /// The coefficients of a component, numbered from 0, metres.
    ///
    /// For principal components one per frame; for the Laplacian one per frame for x, then one per frame for y.
    pub fn coefficients(&self, component: usize) -> Vec<f64> {
        self.coefficients.column(component).iter().copied().collect()
    }

    /// Rebuilds the motion from the first `components` components; all of them give the motion itself.
    ///
    /// # Errors
    /// [`FeaturesError::Components`].
    pub fn rebuild(&self, components: usize) -> Result<Ensemble, FeaturesError> {
        self.modulated(components, &Modulation::default())
    }

    /// Root mean square error of the positions of [`Features::rebuild`], metres; it falls with every component.
    pub fn rebuild_error_m(&self, components: usize) -> f64 {
        let missing: f64 = self.components.iter().skip(components).map(|component| component.variance_m2).sum();
        // The sum of nothing is a negative zero.
        ((missing + 0.0) / self.people() as f64).sqrt()
    }

    /// Rebuilds the motion from the first components with changed coefficients.
    ///
    /// The formation and the path of the centroid are kept; only the displacements from the mean positions change.
    /// Coefficients times 2 double all velocities relative to the centroid.
    ///
    /// # Errors
    /// [`FeaturesError::Components`], also for the rules of the modulation; [`FeaturesError::Coefficient`] for a
    /// coefficient that becomes NaN, infinite or larger than 1000 km.
    pub fn modulated(&self, components: usize, modulation: &Modulation) -> Result<Ensemble, FeaturesError> {
        check_components(components, self.components.len())?;
        modulation.check(components)?;
        let chosen: Vec<SelectedComponent> =
            (0..components).map(|own| SelectedComponent { number: own + 1, own }).collect();
        let moved = self.moved(&chosen, modulation)?;
        Ok(self.displacement.ensemble(&moved, self.options.method))
    }

    /// Computes the displacements of some components with changed coefficients.
    pub(super) fn moved(
        &self,
        chosen: &[SelectedComponent],
        modulation: &Modulation,
    ) -> Result<DMatrix<f64>, FeaturesError> {
        let own: Vec<usize> = chosen.iter().map(|chosen| chosen.own).collect();
        let mut coefficients = columns_of(&self.coefficients, &own);
        let (moments, fps) = (self.moments(), self.displacement.fps);
        for (mut column, chosen) in coefficients.column_iter_mut().zip(chosen) {
            // One axis after the other.
            for axis in column.as_mut_slice().chunks_mut(moments) {
                modulation.apply(chosen.number, axis, fps)?;
            }
        }
        Ok(coefficients * columns_of(&self.vectors, &own).transpose())
    }
}
