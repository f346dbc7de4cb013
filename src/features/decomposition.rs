use nalgebra::DMatrix;
use serde::Serialize;

use super::displacement::{Displacement, column_squares, columns_of};
use super::modulation::{Modulation, SelectedComponent, check_components};
use super::neighbours::KirchhoffSums;
use super::progress_range::ProgressRange;
use super::{FeaturesError, FeaturesOptions, Method, laplacian, principal};
use crate::motion::Ensemble;
use crate::progress::Progress;

/// A crowd whose people keep this close to their places in the mean stands still, metres.
const STILL_M: f64 = 1e-9;

/// What a crowd moves like: its motion in a basis of components, see [the module](super).
#[derive(Clone, Debug)]
pub struct Features {
    options: FeaturesOptions,
    pub(super) displacement: Displacement,
    components: Vec<FeatureComponent>,
    /// A column per component: for principal components everybody's x and then everybody's y, for the Laplacian a number
    /// per person.
    vectors: DMatrix<f64>,
    /// A column per component: for principal components a number per moment, for the Laplacian one per moment for x, and
    /// then one per moment for y.
    coefficients: DMatrix<f64>,
    mean_neighbours: Option<f64>,
}

/// How much of a motion a component is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FeatureComponent {
    /// The eigenvalue by which components are ordered: of principal components the variance in square metres, of the
    /// Laplacian the variance of the neighbourhoods, in neighbours squared.
    pub eigenvalue: f64,
    /// Mean square of the component's coefficients: of all people's displacements together, square metres.
    pub variance_m2: f64,
    /// The share of the motion's whole variance.
    pub share: f64,
}

impl Features {
    /// Finds the components of a motion.
    ///
    /// Takes memory of a few copies of the places, and time with the cube of the smaller of moments and coordinates
    /// (principal components) or of people (Laplacian); 500 people at 2000 moments take about a second.
    ///
    /// # Errors
    /// Fewer than 2 people or 2 moments, more places than [`MOST_FEATURE_PLACES`](super::MOST_FEATURE_PLACES) or rows
    /// than [`MOST_ROWS`](super::MOST_ROWS), places that are none; a crowd in which nobody moves relative to the middle;
    /// a distance of neighbours out of range; [`FeaturesError::Interrupted`].
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
        part: &ProgressRange<'_>,
    ) -> Result<Features, FeaturesError> {
        options.check()?;
        part.advance(0.0);
        let displacement = Displacement::of(ensemble)?;
        let displacements = displacement.matrix(ensemble, options.method);
        let (people, moments) = (displacement.people() as f64, displacement.moments() as f64);
        let total_m2 = displacements.norm_squared() / moments;
        let still_m = STILL_M.max(displacement.rounding_m());
        if total_m2 <= people * still_m * still_m {
            return Err(FeaturesError::Still.into());
        }
        part.advance(0.1);
        let (values, vectors, mean_neighbours) = match options.method {
            Method::Pca => (
                None,
                {
                    let rounding_m = displacement.rounding_m();
                    principal::components(&displacements, rounding_m, &part.part(0.1, 0.9))?
                },
                None,
            ),
            Method::Laplacian => {
                let sums = KirchhoffSums::of(ensemble, options.neighbour_distance_m, &part.part(0.1, 0.5))?;
                let found = laplacian::components(&sums, &displacements, &part.part(0.5, 0.9))?;
                (Some(found.values), found.vectors, Some(sums.mean_neighbours()))
            }
        };
        part.keep_on()?;
        let coefficients = &displacements * &vectors;
        let variances: Vec<f64> = column_squares(&coefficients).iter().map(|sum| sum / moments).collect();
        let mut order: Vec<usize> = (0..variances.len()).collect();
        if options.method == Method::Pca {
            // The eigenvalue is the variance; measured along the vectors it is exact where it is small.
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
        part.advance(1.0);
        Ok(found)
    }

    /// How they were found.
    pub fn options(&self) -> &FeaturesOptions {
        &self.options
    }

    /// Number of people.
    pub fn people(&self) -> usize {
        self.displacement.people()
    }

    /// Number of moments.
    pub fn moments(&self) -> usize {
        self.displacement.moments()
    }

    /// The components in their order. Principal components along which nobody moves are left out; there are at most
    /// 2n - 2 for n people, for the middle is kept apart. The Laplacian has always n.
    pub fn components(&self) -> &[FeatureComponent] {
        &self.components
    }

    /// For the Laplacian, how many neighbours people have in the mean.
    pub fn mean_neighbours(&self) -> Option<f64> {
        self.mean_neighbours
    }

    /// A component's unit vector (from 0 on): for principal components everybody's x and then everybody's y, in the order
    /// of ids, for the Laplacian a number per person.
    pub fn vector(&self, component: usize) -> Vec<f64> {
        self.vectors.column(component).iter().copied().collect()
    }

    /// A component's coefficients in metres (from 0 on): for principal components one per moment, for the Laplacian one
    /// per moment for x, and then one per moment for y.
    pub fn coefficients(&self, component: usize) -> Vec<f64> {
        self.coefficients.column(component).iter().copied().collect()
    }

    /// The motion made of the first components, around the middle as it goes. With all of them it is the motion itself.
    ///
    /// # Errors
    /// No component, or more than there are.
    pub fn rebuild(&self, components: usize) -> Result<Ensemble, FeaturesError> {
        self.modulated(components, &Modulation::default())
    }

    /// The root of the mean square distance by which [`Features::rebuild`] misses somebody's place, metres. It falls with
    /// every component.
    pub fn rebuild_error_m(&self, components: usize) -> f64 {
        let missing: f64 = self.components.iter().skip(components).map(|component| component.variance_m2).sum();
        // The sum of nothing is a negative zero.
        ((missing + 0.0) / self.people() as f64).sqrt()
    }

    /// The motion made of the first components with changed coefficients.
    ///
    /// The formation and the path of the middle stay as they are: what changes is how people move around their mean
    /// places. Coefficients times 2 double all velocities relative to the middle.
    ///
    /// # Errors
    /// No component, or more than there are, also in a rule of the modulation; a coefficient that becomes NaN, infinite
    /// or larger than 1000 km.
    pub fn modulated(&self, components: usize, modulation: &Modulation) -> Result<Ensemble, FeaturesError> {
        check_components(components, self.components.len())?;
        modulation.check(components)?;
        let chosen: Vec<SelectedComponent> =
            (0..components).map(|own| SelectedComponent { number: own + 1, own }).collect();
        let moved = self.moved(&chosen, modulation)?;
        Ok(self.displacement.ensemble(&moved, self.options.method))
    }

    /// The displacements that some of the components make with changed coefficients.
    pub(super) fn moved(
        &self,
        chosen: &[SelectedComponent],
        modulation: &Modulation,
    ) -> Result<DMatrix<f64>, FeaturesError> {
        let own: Vec<usize> = chosen.iter().map(|chosen| chosen.own).collect();
        let mut coefficients = columns_of(&self.coefficients, &own);
        let (moments, fps) = (self.moments(), self.displacement.fps);
        for (mut column, chosen) in coefficients.column_iter_mut().zip(chosen) {
            // An axis after the other.
            for axis in column.as_mut_slice().chunks_mut(moments) {
                modulation.apply(chosen.number, axis, fps)?;
            }
        }
        Ok(coefficients * columns_of(&self.vectors, &own).transpose())
    }
}
