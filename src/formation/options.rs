use super::{AdjacencyEdit, FormationError};
use crate::math::{Vec2, smoothstep};

/// A key formation: the positions of all people at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyFormation {
    /// Time on the example's clock, seconds; rounded to the nearest frame of the example.
    pub time_s: f64,
    /// Position of each person in the order of the example's people, metres.
    pub places_m: Vec<Vec2>,
}

/// Easing of the transition from one key formation to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ease {
    /// Linear, as in the paper: direction and speed change abruptly at a key formation.
    #[default]
    Even,
    /// Smoothstep (`3 u^2 - 2 u^3`): at a key formation people move as in the example only.
    Rest,
}

impl Ease {
    /// Share of the transition for a share of its time, both 0 to 1.
    pub fn share(self, time: f64) -> f64 {
        match self {
            Ease::Even => time,
            Ease::Rest => smoothstep(time),
        }
    }
}

/// How the example's fluctuation, the motion besides that of the formation, is carried over.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Carry {
    /// With the basis vectors, as in the paper: the swinging of the example's coarse shape becomes that of the new one.
    ///
    /// Its energy is kept, but may move to other people if formations differ much.
    #[default]
    Shapes,
    /// With the people: each deviates from the line between the key formations as from the line between their own
    /// positions in the example.
    People,
}

/// Options of [`interpolate`](super::interpolate).
#[derive(Clone, Debug, PartialEq)]
pub struct FormationOptions {
    /// Range of adjacency (standard deviation of the Gaussian), metres, 1e-3 to 1e6; `None`: for each formation its own
    /// [`default_sigma_m`](super::default_sigma_m).
    pub sigma_m: Option<f64>,
    /// Weights of adjacency that replace those of the distance.
    pub adjacency: Vec<AdjacencyEdit>,
    /// Number of evenly spaced frames in which the example is decomposed, at least 2.
    ///
    /// `None`: at the keys only, and in between its basis turns as evenly as that of the new crowd. Then key formations that
    /// are the example's own reproduce the example, and its quick motion keeps its energy best. More frames remove changes of
    /// the example's formation between keys from the fluctuation, as far as a [`Follower`](super::Follower) follows them. All
    /// frames (`usize::MAX`) with `following_s` 0 is the method of the paper.
    pub decompositions: Option<usize>,
    /// Factor on the example's fluctuation, 0 to 100; 1 keeps it.
    pub fluctuation: f64,
    /// How the fluctuation is carried over.
    pub carry: Carry,
    /// Easing from key to key.
    pub ease: Ease,
    /// Eigenvalues that differ by less than this share of their mean count as nearly equal, 1e-9 to 1; see
    /// [`match_basis`](super::match_basis).
    pub nearness: f64,
    /// Time constant with which the example's basis follows its eigenvectors between keys, seconds, 0 to 1e6.
    ///
    /// 0 follows at once. See [`Follower`](super::Follower). The default, 30 s, is the shortest for which the energy of the
    /// fluctuation stays within 5 % of the example's, for people who walk on a grid and for people who wander about; at 0,
    /// swapping eigenvectors make it up to 14 times as large.
    /// `cargo run --release --example measure_formation -- 25 601` measures it; `docs/motion.md` has the table.
    pub following_s: f64,
}

impl Default for FormationOptions {
    fn default() -> FormationOptions {
        FormationOptions {
            sigma_m: None,
            adjacency: Vec::new(),
            decompositions: None,
            fluctuation: 1.0,
            carry: Carry::default(),
            ease: Ease::default(),
            nearness: 0.1,
            following_s: 30.0,
        }
    }
}

impl FormationOptions {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`FormationError::Option`].
    pub(super) fn check(&self) -> Result<(), FormationError> {
        let ranges = [
            ("sigma", self.sigma_m.unwrap_or(1.0), 1e-3, 1e6),
            ("the number of decompositions", self.decompositions.unwrap_or(2) as f64, 2.0, f64::INFINITY),
            ("the factor on the fluctuation", self.fluctuation, 0.0, 100.0),
            ("nearness", self.nearness, 1e-9, 1.0),
            ("the time of following", self.following_s, 0.0, 1e6),
        ];
        for (option, value, low, high) in ranges {
            if !(low..=high).contains(&value) {
                return Err(FormationError::Option { option, value, low, high });
            }
        }
        Ok(())
    }
}
