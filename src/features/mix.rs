use serde::{Deserialize, Serialize};

use super::displacement::Displacement;
use super::matching::nearest_pairs;
use super::modulation::{SelectedComponent, check_components};
use super::progress_range::ProgressRange;
use super::{FeatureComponent, Features, FeaturesError, FeaturesOptions, Modulation};
use crate::math::Vec2;
use crate::motion::Ensemble;
use crate::progress::Progress;

/// Largest number of people of a crowd that is matched: the time grows with its cube.
const MOST_MATCHED: usize = 1000;

/// The crowd that a component of a mix comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MixSource {
    /// The crowd that is changed.
    First,
    /// The crowd whose features are added.
    Other,
}

/// The path of a mixed crowd's centroid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CentroidPath {
    /// The first crowd's.
    #[default]
    First,
    /// The other crowd's, moved to where the first one's begins.
    Other,
    /// The sum of both crowds' paths, from where the first one's begins.
    Both,
}

impl CentroidPath {
    /// All choices.
    pub const ALL: [CentroidPath; 3] = [CentroidPath::First, CentroidPath::Other, CentroidPath::Both];

    /// The name in options and reports.
    pub const fn name(self) -> &'static str {
        match self {
            CentroidPath::First => "first",
            CentroidPath::Other => "other",
            CentroidPath::Both => "both",
        }
    }
}

/// Options of [`Mix::find`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MixOptions {
    /// The path of the centroid.
    pub centroid: CentroidPath,
}

/// A crowd that moves with the features of another crowd besides its own.
///
/// The components of both bases are interleaved by eigenvalue, each as a share of its own crowd's sum, so that a crowd
/// that moves twice as far does not come first with all of its components. Vectors keep their own coefficients: with all
/// components, each person moves as in the first crowd and, added to that, as the matched person of the other crowd.
/// (The vectors of both crowds are not orthogonal. Orthogonalising them would remove from the second crowd the features
/// that both share.)
///
/// A basis needs the same people and frames. People are matched so that the squared distances between their mean
/// positions relative to the centroid have the least sum; unmatched people of the larger crowd are left out. The other
/// crowd is resampled at the first crowd's frames, both from their start, until the shorter one ends. Formation, people
/// and position are the first crowd's.
#[derive(Clone, Debug)]
pub struct Mix {
    features: [Features; 2],
    order: Vec<(MixSource, usize)>,
    base: Displacement,
    left_out: [usize; 2],
}

impl Mix {
    /// Matches two crowds, finds the components of both, and interleaves them.
    ///
    /// # Errors
    /// The errors of [`Features::find`]; crowds with fewer than 2 people or frames in common; crowds too large to match; [`FeaturesError::Interrupted`].
    pub fn find(
        first: &Ensemble,
        other: &Ensemble,
        options: &FeaturesOptions,
        mix: MixOptions,
        progress: &dyn Progress,
    ) -> Result<Mix, FeaturesError> {
        let progress = ProgressRange::whole(progress);
        let (apart, other_apart) = (Displacement::of(first)?, Displacement::of(other)?);
        if apart.people().max(other_apart.people()) > MOST_MATCHED {
            return Err(FeaturesError::Mix { problem: "one has more than 1000 people" });
        }
        let moments = first.moments().min(moments_at(other, first.fps));
        if moments < 2 {
            return Err(FeaturesError::Mix { problem: "the other is shorter than two frames of the first" });
        }
        let pairs = nearest_pairs(&apart.formation_m, &other_apart.formation_m, &progress.range(0.0, 0.1))?;
        let left_out = [first, other].map(|ensemble| ensemble.people() - pairs.len());
        let ids: Vec<u32> = pairs.iter().map(|pair| first.ids[pair[0]]).collect();
        let taken = |ensemble: &Ensemble, which: usize| {
            let places = |moment: usize| {
                let at = moment as f64 / first.fps * ensemble.fps;
                pairs.iter().map(move |pair| place_between(ensemble, at, pair[which])).collect::<Vec<Vec2>>()
            };
            Ensemble::new(first.fps, first.start_s, ids.clone(), (0..moments).flat_map(places).collect())
        };
        let [first, other] = [taken(first, 0).with_statures(first.statures().clone()), taken(other, 1)];
        let features = [
            Features::find_part(&first, options, &progress.range(0.1, 0.5))?,
            Features::find_part(&other, options, &progress.range(0.5, 1.0))?,
        ];
        let base = base(&features, mix.centroid);
        let order = interleaved([features[0].components(), features[1].components()]);
        Ok(Mix { features, order, base, left_out })
    }

    /// The features of one crowd, for the people and frames that both have in common.
    pub fn features(&self, whose: MixSource) -> &Features {
        &self.features[whose as usize]
    }

    /// The interleaved components, each with the crowd it comes from.
    pub fn components(&self) -> impl ExactSizeIterator<Item = (MixSource, FeatureComponent)> {
        self.order.iter().map(|&(whose, own)| (whose, self.features(whose).components()[own]))
    }

    /// Number of unmatched people of the first and of the other crowd.
    pub fn left_out(&self) -> [usize; 2] {
        self.left_out
    }

    /// Rebuilds the motion from the first `components` interleaved components.
    ///
    /// # Errors
    /// [`FeaturesError::Components`].
    pub fn rebuild(&self, components: usize) -> Result<Ensemble, FeaturesError> {
        self.modulated(components, &Modulation::default())
    }

    /// Rebuilds the motion with changed coefficients; rules count the interleaved components.
    ///
    /// # Errors
    /// As [`Features::modulated`].
    pub fn modulated(&self, components: usize, modulation: &Modulation) -> Result<Ensemble, FeaturesError> {
        check_components(components, self.order.len())?;
        modulation.check(components)?;
        let chosen = |whose: MixSource| -> Vec<SelectedComponent> {
            let numbered = (1..).zip(&self.order[..components]);
            numbered
                .filter(|(_, of)| of.0 == whose)
                .map(|(number, &(_, own))| SelectedComponent { number, own })
                .collect()
        };
        let [first, other] = [MixSource::First, MixSource::Other].map(|whose| (self.features(whose), chosen(whose)));
        let moved = first.0.moved(&first.1, modulation)? + other.0.moved(&other.1, modulation)?;
        Ok(self.base.ensemble(&moved, first.0.options().method))
    }
}

/// The first crowd's formation around the chosen centroid.
fn base(features: &[Features; 2], path: CentroidPath) -> Displacement {
    let [first, other] = [0, 1].map(|which| &features[which].displacement);
    let begin = |displacement: &Displacement| displacement.centroids_m.first().copied().unwrap_or(Vec2::ZERO);
    let (from, from_other) = (begin(first), begin(other));
    let both = first.centroids_m.iter().zip(&other.centroids_m);
    let centroids_m = match path {
        CentroidPath::First => first.centroids_m.clone(),
        CentroidPath::Other => both.map(|(_, &other)| from + (other - from_other)).collect(),
        CentroidPath::Both => both.map(|(&first, &other)| first + (other - from_other)).collect(),
    };
    Displacement { centroids_m, ..first.clone() }
}

/// Merges two lists of components by each eigenvalue's share of its list's sum; the first crowd's come first if equal.
fn interleaved(components: [&[FeatureComponent]; 2]) -> Vec<(MixSource, usize)> {
    let [first, other] = components.map(|components| {
        let sum: f64 = components.iter().map(|component| component.eigenvalue).sum();
        let share = move |component: &FeatureComponent| if sum > 0.0 { component.eigenvalue / sum } else { 0.0 };
        components.iter().map(share).collect::<Vec<f64>>()
    });
    let mut order = Vec::with_capacity(first.len() + other.len());
    let (mut a, mut b) = (0, 0);
    while a < first.len() || b < other.len() {
        // Equal eigenvalues, as the many zeros of a Laplacian, alternate.
        let takes_first = match (first.get(a), other.get(b)) {
            (Some(x), Some(y)) if x == y => a <= b,
            (Some(x), Some(y)) => x > y,
            (one, _) => one.is_some(),
        };
        if takes_first {
            order.push((MixSource::First, a));
            a += 1;
        } else {
            order.push((MixSource::Other, b));
            b += 1;
        }
    }
    order
}

/// Number of frames of a motion at another frame rate.
fn moments_at(ensemble: &Ensemble, fps: f64) -> usize {
    let duration_s = ensemble.moments().saturating_sub(1) as f64 / ensemble.fps;
    // A last frame lost to rounding is added back.
    ((duration_s * fps + 1e-6) as usize).saturating_add(1)
}

/// A person's position at a fractional frame number, interpolated.
fn place_between(ensemble: &Ensemble, moment: f64, person: usize) -> Vec2 {
    let last = ensemble.moments() - 1;
    let before = (moment as usize).min(last);
    let after = (before + 1).min(last);
    let share = (moment - before as f64).clamp(0.0, 1.0);
    ensemble.places_at(before)[person].lerp(ensemble.places_at(after)[person], share)
}
