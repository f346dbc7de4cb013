use nalgebra::{DMatrix, Dyn, Matrix, VecStorage};

use super::error::FeaturesError;
use super::method::Method;
use crate::math::{Vec2, vec2};
use crate::motion::{Ensemble, Statures};

/// Largest number of positions, people times frames, that are decomposed: about 100 bytes of memory each.
pub const MOST_FEATURE_PLACES: usize = 10_000_000;

/// Largest coordinate of a position, metres: beyond all map frames, and its square is still exact to 1 m.
const FARTHEST_M: f64 = 1e8;

/// A crowd's motion split into the centroid's path, mean positions and displacements from them.
#[derive(Clone, Debug)]
pub(super) struct Displacement {
    pub(super) fps: f64,
    pub(super) start_s: f64,
    pub(super) ids: Vec<u32>,
    pub(super) statures: Statures,
    /// Origin of all positions: a person's first one, so that no digits are lost on a map whose origin is far away.
    pub(super) origin_m: Vec2,
    /// The centroid of each frame, metres from `origin_m`.
    pub(super) centroids_m: Vec<Vec2>,
    /// Each person's mean position relative to the centroid, metres.
    pub(super) formation_m: Vec<Vec2>,
}

impl Displacement {
    /// Splits a motion.
    ///
    /// # Errors
    /// Fewer than 2 people or frames, too many positions, positions out of range.
    pub(super) fn of(ensemble: &Ensemble) -> Result<Displacement, FeaturesError> {
        let (people, moments) = (ensemble.people(), ensemble.moments());
        if people < 2 {
            return Err(FeaturesError::TooFew { people, least: 2 });
        }
        if moments < 2 {
            return Err(FeaturesError::SingleMoment);
        }
        if people.saturating_mul(moments) > MOST_FEATURE_PLACES {
            return Err(FeaturesError::TooMany { people, moments, most: MOST_FEATURE_PLACES });
        }
        check_places(ensemble)?;
        let origin_m = ensemble.places_at(0)[0];
        let mut centroids_m = Vec::with_capacity(moments);
        let mut formation_m = vec![Vec2::ZERO; people];
        for moment in 0..moments {
            let places = ensemble.places_at(moment);
            let sum = places.iter().fold(Vec2::ZERO, |sum, &place| sum + (place - origin_m));
            let centroid = sum / people as f64;
            centroids_m.push(centroid);
            formation_m.iter_mut().zip(places).for_each(|(sum, &place)| *sum += place - origin_m - centroid);
        }
        formation_m.iter_mut().for_each(|sum| *sum = *sum / moments as f64);
        let Ensemble { fps, start_s, ref ids, .. } = *ensemble;
        let (ids, statures) = (ids.clone(), ensemble.statures().clone());
        Ok(Displacement { fps, start_s, ids, statures, origin_m, centroids_m, formation_m })
    }

    pub(super) fn people(&self) -> usize {
        self.ids.len()
    }

    pub(super) fn moments(&self) -> usize {
        self.centroids_m.len()
    }

    /// Displacement of a person by rounding alone, metres.
    pub(super) fn rounding_m(&self) -> f64 {
        let largest = |places: &[Vec2]| places.iter().fold(0.0, |most: f64, p| most.max(p.x.abs()).max(p.y.abs()));
        8.0 * f64::EPSILON * (largest(&self.centroids_m) + largest(&self.formation_m))
    }

    /// The displacements from the mean positions, as a matrix for the method.
    ///
    /// For principal components a row per frame, with a column for each person's x and then for each person's y. For the
    /// Laplacian a row per frame with the x, and below them a row per frame with the y, and a column per person.
    pub(super) fn matrix(&self, ensemble: &Ensemble, method: Method) -> DMatrix<f64> {
        let (people, moments) = (self.people(), self.moments());
        let [rows, columns] = method.shape(people, moments);
        let mut matrix = DMatrix::zeros(rows, columns);
        for moment in 0..moments {
            let centroid = self.centroids_m[moment];
            for (person, &place) in ensemble.places_at(moment).iter().enumerate() {
                let by = place - self.origin_m - centroid - self.formation_m[person];
                for (axis, value) in [by.x, by.y].into_iter().enumerate() {
                    matrix[method.cell(axis, moment, person, people, moments)] = value;
                }
            }
        }
        matrix
    }

    /// Puts the motion together again from displacements.
    pub(super) fn ensemble(&self, displacements: &DMatrix<f64>, method: Method) -> Ensemble {
        let (people, moments) = (self.people(), self.moments());
        let mut places_m = Vec::with_capacity(people * moments);
        for (moment, &centroid) in self.centroids_m.iter().enumerate() {
            for (person, &mean) in self.formation_m.iter().enumerate() {
                let [x, y] = [0, 1].map(|axis| displacements[method.cell(axis, moment, person, people, moments)]);
                places_m.push(self.origin_m + (centroid + mean + vec2(x, y)));
            }
        }
        Ensemble::new(self.fps, self.start_s, self.ids.clone(), places_m).with_statures(self.statures.clone())
    }
}

impl Method {
    /// Rows and columns of a motion's matrix.
    pub(super) fn shape(self, people: usize, moments: usize) -> [usize; 2] {
        match self {
            Method::Pca => [moments, 2 * people],
            Method::Laplacian => [2 * moments, people],
        }
    }

    /// Row and column of a person's coordinate (axis 0 is x, 1 is y) in a frame.
    pub(super) fn cell(
        self,
        axis: usize,
        moment: usize,
        person: usize,
        people: usize,
        moments: usize,
    ) -> (usize, usize) {
        match self {
            Method::Pca => (moment, axis * people + person),
            Method::Laplacian => (axis * moments + moment, person),
        }
    }
}

/// Sums of squares of a matrix's columns.
pub(super) fn column_squares<S>(matrix: &Matrix<f64, Dyn, Dyn, S>) -> Vec<f64>
where
    S: nalgebra::Storage<f64, Dyn, Dyn>,
{
    matrix.column_iter().map(|column| column.iter().map(|v| v * v).sum()).collect()
}

/// Selects columns of a matrix, in the given order.
pub(super) fn columns_of(matrix: &DMatrix<f64>, order: &[usize]) -> DMatrix<f64> {
    let rows = matrix.nrows();
    let data: Vec<f64> =
        order.iter().flat_map(|&column| matrix.column(column).iter().copied().collect::<Vec<_>>()).collect();
    Matrix::from_data(VecStorage::new(Dyn(rows), Dyn(order.len()), data))
}

fn check_places(ensemble: &Ensemble) -> Result<(), FeaturesError> {
    for moment in 0..ensemble.moments() {
        // Written so that NaN is out of range.
        let is_beyond = |p: &Vec2| !(p.x.abs() <= FARTHEST_M && p.y.abs() <= FARTHEST_M);
        if let Some(person) = ensemble.places_at(moment).iter().position(is_beyond) {
            let Vec2 { x, y } = ensemble.places_at(moment)[person];
            let (id, time_s) = (ensemble.ids[person], ensemble.time_s(moment));
            return Err(FeaturesError::NoPlace { id, time_s, x, y, most_m: FARTHEST_M });
        }
    }
    Ok(())
}
