use super::{AdjacencyEdit, FormationError};
use crate::math::Vec2;

/// A formation that the crowd takes up at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyFormation {
    /// When, seconds on the example's clock; it is moved to the nearest moment of the example.
    pub time_s: f64,
    /// Places in metres, one for each person, in the order of the example's people.
    pub places_m: Vec<Vec2>,
}

/// How the crowd goes from one key formation to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ease {
    /// Evenly, as in the paper; at a key formation, the direction and the speed change at once.
    #[default]
    Even,
    /// Slowly out of one and slowly into the next (`3 u^2 - 2 u^3`): at a key formation everybody moves as in the example only.
    Rest,
}

impl Ease {
    /// The share of the way for a share of the time.
    pub fn share(self, time: f64) -> f64 {
        match self {
            Ease::Even => time,
            Ease::Rest => time * time * (3.0 - 2.0 * time),
        }
    }
}

/// What becomes of the example's fluctuation, each person's own motion beside that of the formation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Carry {
    /// It stays with the basis vectors, as in the paper: swinging of the example's coarse shape becomes swinging of the new
    /// coarse shape. Its energy stays; who has it may change where formations differ much.
    #[default]
    Shapes,
    /// It stays with the people: everybody deviates from the way between the key formations as from the way between their
    /// own places in the example.
    People,
}

/// How formations are interpolated.
#[derive(Clone, Debug, PartialEq)]
pub struct FormationOptions {
    /// How far adjacency reaches, metres, 1e-3 to 1e6; `None`: for each formation its own
    /// [`default_sigma_m`](super::default_sigma_m).
    pub sigma_m: Option<f64>,
    /// Who is adjacent, whatever the distance.
    pub adjacency: Vec<AdjacencyEdit>,
    /// At how many moments, evenly spaced, the example is decomposed; at least 2. `None`: where the keys are, and
    /// between them its basis turns as evenly as that of the new crowd. Then key formations that are the example's own give the
    /// example back, and its quick motion keeps its energy best. More moments take changes of the example's formation between keys
    /// out of what is carried over, as far as a [`Follower`](super::Follower) sees them. As many as there are moments
    /// (`usize::MAX` will do) and `following_s` 0 is the paper to the letter.
    pub decompositions: Option<usize>,
    /// Factor on the example's fluctuation, 0 to 100; 1 leaves it as it is.
    pub fluctuation: f64,
    /// What the fluctuation stays with.
    pub carry: Carry,
    /// How the crowd goes from key to key.
    pub ease: Ease,
    /// Eigenvalues that differ by less than this share of their mean count as nearly equal, 1e-9 to 1; see
    /// [`match_basis`](super::match_basis).
    pub nearness: f64,
    /// How slowly the example's basis follows its eigenvectors if it is decomposed between keys, seconds, 0 to 1e6; 0 is
    /// at once. See [`Follower`](super::Follower).
    ///
    /// The default, 30 s, is the quickest at which the energy of the fluctuation stays within 5 % of the example's, for people
    /// who walk on a grid and for people who wander about; at once, swapping eigenvectors make it up to 14 times as much.
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
