//! Formations that change into each other: who is near whom turns from one to the next, while everybody keeps moving as in
//! an example.
//!
//! The method is that of Niikura, Takahashi and Shin, *Interpolating Crowd Formations using Adjacency Relations*. An example
//! (recorded or simulated people who walk in some formation) and key formations at some times go into [`interpolate`]; out
//! comes the crowd that takes up one key after the other, and sways, pulses and drifts on the way as the example does.
//!
//! # A formation as shapes, coarse to fine
//!
//! Let `X` and `Y` be the coordinates of n people relative to their middle. Who is near whom is the adjacency
//! `w_kl = exp(-d_kl^2 / 2 sigma^2)` of each pair; with `A` the matrix of these and `B` the diagonal of its row sums,
//! [`kirchhoff`] is `K = B - A`. Its unit eigenvectors `e_0, e_1, ... e_(n-1)` by ascending eigenvalue are a [`Basis`]: `e_0`
//! is constant, `e_1` changes sign once along the longest way through the crowd, the last ones change from each person to the
//! next. The coefficients `c_i = X . e_i`, `d_i = Y . e_i` say how far the crowd reaches in each shape, and the sum
//! `X = c_0 e_0 + c_1 e_1 + ...`, taken from the left, tells the formation from coarse to fine.
//!
//! So a motion is two things: a basis that says who is next to whom, and coefficients that say where that is. They are
//! interpolated apart from each other.
//!
//! # The basis turns
//!
//! The bases `S` and `T` of two formations, vectors as columns, are orthogonal, and so is `R` with `T = R S`. If `R` is a
//! rotation, parts of it are rotations too: `R^t S` is a basis at every `t` from 0 to 1. The paper takes square roots of `R`
//! again and again, and has 2^N + 1 bases. Here the real Schur form `R = U D U^T` gives every part at once: `D` consists of
//! turns within planes, and `D^t` turns each by `t` times its angle. `R^t S c = U D^t (U^T S) c`, so that a moment costs two
//! products of a matrix and a vector and n/2 turns of a pair of numbers; `R^t` itself is never formed. See [`Rotation`].
//!
//! Eigenvectors are not unique, and carelessness here shows as people who fly through the crowd: signs are arbitrary, those of
//! equal eigenvalues (every grid, ring and triangle has some) arbitrary altogether, and one sign too many makes `R` mirror.
//! [`match_basis`] chooses among them: within each cluster of nearly equal eigenvalues as near as possible to the bases of the
//! keys before and after, and to that of the example, and without mirroring.
//!
//! # Coefficients keep their fluctuation
//!
//! Over time, coefficients of real people are a line from end to end with waves on it: their steps, their sway. The waves
//! are what people do by themselves. Between two keys, the new coefficients are the line between those of the keys, plus the
//! example's own coefficients minus the line between their ends. At the keys this is 0, and the crowd stands where it should.
//! The middle of the crowd goes the same way.
//!
//! The example's coefficients need a basis at every moment, too, and here we go further than the paper. Taken from
//! eigenvectors moment by moment, they lurch whenever two eigenvalues pass each other, by metres within a tenth of a second,
//! although nobody in the example does (see [`Follower`]). So by default the example's basis is found at the keys' times and
//! turns in between as the new one does. That is the paper's own finding, that recorded eigenvectors turn nearly evenly as
//! long as the pattern of adjacency is one ([`sphere_tracks`] tells how nearly), put to use: key formations that are the example's
//! own give back the example to the last digit, and the energy of the fluctuation stays, since all bases are orthonormal.
//! [`FormationOptions::decompositions`] asks for bases in between.
//!
//! # What else there is
//!
//! [`AdjacencyEdit`] makes people adjacent who then stay together, [`Carry`] lets the fluctuation stay with each person rather
//! than with each shape, [`Ease`] lets the crowd come to rest in a key formation.
//!
//! Results are the same for any number of threads. They are promised to be the same on one machine only: nalgebra's products
//! use what the processor offers.

mod assignment;
mod avoidance;
mod basis;
mod blend;
mod error;
mod example;
mod follow;
mod hierarchy;
mod interpolate;
mod keys;
mod kirchhoff;
mod matching;
mod options;
mod picture;
mod places;
mod planes;
mod request;
mod rotation;
mod sphere;
mod symmetric;

pub use avoidance::USUAL_DISTANCE_M;
pub use basis::Basis;
pub use error::FormationError;
pub use example::{ExampleCoefficients, example_coefficients};
pub use follow::Follower;
pub use hierarchy::{Formed, MOST_FORMED_PLACES, MOST_IN_ALL, MOST_KEY_PAIRS, Who, form};
pub use interpolate::interpolate;
pub use kirchhoff::{AdjacencyEdit, default_sigma_m, kirchhoff};
pub use matching::match_basis;
pub use options::{Carry, Ease, FormationOptions, KeyFormation};
pub use picture::is_picture;
pub use request::{
    AdjacencyRequest, Assign, AvoidRequest, Choice, CrowdRequest, ExampleKind, ExampleRequest, FormationRequest,
    KeyRequest, Members, MembersWord, Pace, Repeat, RequestError, Shape, Stays, WayRequest,
};
pub use rotation::Rotation;
pub use sphere::{SphereTracks, one_pattern, sphere_tracks};

/// The fewest people that are a formation.
pub const LEAST_PEOPLE: usize = 2;
/// The most people that one formation is made of: its matrices hold a number for each pair.
pub const MOST_PEOPLE: usize = 2000;
/// Largest coordinate or time that is taken for one, metres or seconds.
const MOST_NUMBER: f64 = 1e7;
