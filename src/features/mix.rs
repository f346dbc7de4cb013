use serde::{Deserialize, Serialize};

use super::displacement::Displacement;
use super::matching::nearest_pairs;
use super::modulation::{SelectedComponent, check_components};
use super::progress_range::ProgressRange;
use super::{FeatureComponent, Features, FeaturesError, FeaturesOptions, Modulation};
use crate::math::Vec2;
use crate::motion::Ensemble;
use crate::progress::Progress;

/// The most people whose crowds are matched: the time grows with the cube of their number.
const MOST_MATCHED: usize = 1000;

/// One of two crowds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MixSource {
    /// The one that is changed.
    First,
    /// The one whose features it gets.
    Other,
}

/// Where the middle of a mixed crowd goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CentroidPath {
    /// As that of the first crowd.
    #[default]
    First,
    /// As that of the other crowd, from where the first begins.
    Other,
    /// As both together: from where the first begins, it goes the way of either.
    Both,
}

impl CentroidPath {
    /// All of them.
    pub const ALL: [CentroidPath; 3] = [CentroidPath::First, CentroidPath::Other, CentroidPath::Both];

    /// Its name, as users write it.
    pub const fn name(self) -> &'static str {
        match self {
            CentroidPath::First => "first",
            CentroidPath::Other => "other",
            CentroidPath::Both => "both",
        }
    }
}

/// How two crowds are mixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MixOptions {
    /// Where the middle goes.
    pub middle: CentroidPath,
}

/// One crowd with the features of another besides its own.
///
/// The two bases are interleaved by eigenvalue, each as a share of its own crowd's sum, so that a crowd that moves twice
/// as far does not come first with all of its components. Either's vectors keep their own coefficients: with all
/// components everybody moves as in the first crowd and, on top of it, as the one in the other crowd whom they are matched
/// with. (The vectors of both together are not at right angles. Making them so would take from the second what it has in
/// common with the first, and so the feature that both share.)
///
/// A basis needs the same people and moments: people are matched so that the distances between their mean places around
/// the middle add up to the least, and who is left over in the larger crowd is left out. The other crowd is looked at in
/// the moments of the first, both from their beginnings, until the shorter ends. Formation, people and place are the
/// first crowd's.
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
    /// What [`Features::find`] says of either; crowds that overlap in fewer than 2 people or moments, or that are too
    /// large to be matched; [`FeaturesError::Interrupted`].
    pub fn find(
        first: &Ensemble,
        other: &Ensemble,
        options: &FeaturesOptions,
        mix: MixOptions,
        progress: &dyn Progress,
    ) -> Result<Mix, FeaturesError> {
        let part = ProgressRange::whole(progress);
        let (apart, other_apart) = (Displacement::of(first)?, Displacement::of(other)?);
        if apart.people().max(other_apart.people()) > MOST_MATCHED {
            return Err(FeaturesError::Mix("one has more than 1000 people").into());
        }
        let moments = first.moments().min(moments_at(other, first.fps));
        if moments < 2 {
            return Err(FeaturesError::Mix("the other is shorter than two moments of the first").into());
        }
        let pairs = nearest_pairs(&apart.formation_m, &other_apart.formation_m, &part.part(0.0, 0.1))?;
        let left_out = [first, other].map(|ensemble| ensemble.people() - pairs.len());
        let ids: Vec<u32> = pairs.iter().map(|pair| first.ids[pair[0]]).collect();
        let taken = |ensemble: &Ensemble, which: usize| {
            let places = |moment: usize| {
                let at = moment as f64 / first.fps * ensemble.fps;
                pairs.iter().map(move |pair| place_between(ensemble, at, pair[which])).collect::<Vec<Vec2>>()
            };
            Ensemble::new(first.fps, first.start_s, ids.clone(), (0..moments).flat_map(places).collect())
        };
        let [first, other] = [taken(first, 0), taken(other, 1)];
        let features = [
            Features::find_part(&first, options, &part.part(0.1, 0.5))?,
            Features::find_part(&other, options, &part.part(0.5, 1.0))?,
        ];
        let base = base(&features, mix.middle);
        let order = interleaved([features[0].components(), features[1].components()]);
        Ok(Mix { features, order, base, left_out })
    }

    /// The features of the two crowds, of the people and moments that they have in common.
    pub fn features(&self, whose: MixSource) -> &Features {
        &self.features[whose as usize]
    }

    /// The interleaved components: whose, and which of them.
    pub fn components(&self) -> impl ExactSizeIterator<Item = (MixSource, FeatureComponent)> {
        self.order.iter().map(|&(whose, own)| (whose, self.features(whose).components()[own]))
    }

    /// How many people of the first and of the other crowd have nobody to be matched with.
    pub fn left_out(&self) -> [usize; 2] {
        self.left_out
    }

    /// The motion made of the first of the interleaved components.
    ///
    /// # Errors
    /// No component, or more than there are.
    pub fn rebuild(&self, components: usize) -> Result<Ensemble, FeaturesError> {
        self.modulated(components, &Modulation::default())
    }

    /// The same with changed coefficients; the rules' numbers are those of the interleaved components.
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

/// The first crowd's formation around the middle that is asked for.
fn base(features: &[Features; 2], middle: CentroidPath) -> Displacement {
    let [first, other] = [0, 1].map(|which| &features[which].displacement);
    let begin = |displacement: &Displacement| displacement.centroids_m.first().copied().unwrap_or(Vec2::ZERO);
    let (from, from_other) = (begin(first), begin(other));
    let both = first.centroids_m.iter().zip(&other.centroids_m);
    let centroids_m = match middle {
        CentroidPath::First => first.centroids_m.clone(),
        CentroidPath::Other => both.map(|(_, &other)| from + (other - from_other)).collect(),
        CentroidPath::Both => both.map(|(&first, &other)| first + (other - from_other)).collect(),
    };
    Displacement { centroids_m, ..first.clone() }
}

/// Two lists of components as one, by the share that each eigenvalue has of its list's sum; of equals, the first's first.
fn interleaved(components: [&[FeatureComponent]; 2]) -> Vec<(MixSource, usize)> {
    let [first, other] = components.map(|components| {
        let sum: f64 = components.iter().map(|component| component.eigenvalue).sum();
        let share = move |component: &FeatureComponent| if sum > 0.0 { component.eigenvalue / sum } else { 0.0 };
        components.iter().map(share).collect::<Vec<f64>>()
    });
    let mut order = Vec::with_capacity(first.len() + other.len());
    let (mut a, mut b) = (0, 0);
    while a < first.len() || b < other.len() {
        // Where eigenvalues are equal, as the many zeros of a Laplacian are, neither waits for all of the other's.
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

/// How many moments a crowd has at another rate.
fn moments_at(ensemble: &Ensemble, fps: f64) -> usize {
    let duration_s = ensemble.moments().saturating_sub(1) as f64 / ensemble.fps;
    // What rounding takes from a last moment it gets back.
    ((duration_s * fps + 1e-6) as usize).saturating_add(1)
}

/// Somebody's place at a moment, of which there are parts too.
fn place_between(ensemble: &Ensemble, moment: f64, person: usize) -> Vec2 {
    let last = ensemble.moments() - 1;
    let before = (moment as usize).min(last);
    let after = (before + 1).min(last);
    let share = (moment - before as f64).clamp(0.0, 1.0);
    ensemble.places_at(before)[person].lerp(ensemble.places_at(after)[person], share)
}
