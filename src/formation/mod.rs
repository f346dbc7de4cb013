//! Interpolation of crowd formations: adjacency turns from one formation to the next, while people move as in an example.
//!
//! The method is that of Niikura, Takahashi and Shin, *Interpolating Crowd Formations using Adjacency Relations*. The input
//! of [`interpolate`] is an example (recorded or simulated people who walk in some formation) and key formations at given
//! times; its output is a crowd that takes up one key after the other, and sways, pulses and drifts in between as the
//! example does.
//!
//! More than 5000 lines, since three parts are one method: the interpolation in this folder, with the eigenvectors it needs
//! (`symmetric`), `avoidance` between the people that it leads, and crowds within crowds (`hierarchy`, `request`, `places`).
//!
//! # A formation as shapes, coarse to fine
//!
//! Let `X` and `Y` be the coordinates of n people relative to their centroid. The adjacency of each pair is
//! `w_kl = exp(-d_kl^2 / 2 sigma^2)`; with `A` the matrix of these and `B` the diagonal of its row sums,
//! `kirchhoff` is `K = B - A`. Its unit eigenvectors `e_0, e_1, ... e_(n-1)` by ascending eigenvalue are a [`Basis`]: `e_0`
//! is constant, `e_1` changes sign once along the longest way through the crowd, the last ones change from each person to the
//! next. The coefficients `c_i = X . e_i`, `d_i = Y . e_i` are the extent of the crowd in each shape, and the sum
//! `X = c_0 e_0 + c_1 e_1 + ...` builds the formation from coarse to fine.
//!
//! So a motion consists of a basis, which holds the adjacency, and coefficients, which hold the positions. The two are
//! interpolated separately.
//!
//! # The basis turns
//!
//! The bases `S` and `T` of two formations, vectors as columns, are orthogonal, and so is `R` with `T = R S`. If `R` is a
//! rotation, parts of it are rotations too: `R^t S` is a basis at every `t` from 0 to 1. The paper takes repeated square roots
//! of `R` and gets 2^N + 1 bases. Here the real Schur form `R = U D U^T` gives every part at once: `D` consists of
//! turns within planes, and `D^t` turns each by `t` times its angle. `R^t S c = U D^t (U^T S) c`, so that a frame costs two
//! products of a matrix and a vector and n/2 turns of a pair of numbers; `R^t` itself is never formed. See [`Rotation`].
//!
//! Eigenvectors are not unique, and a bad choice shows as people who fly through the crowd: signs are arbitrary, eigenvectors
//! of equal eigenvalues (every grid, ring and triangle has some) are arbitrary up to a rotation, and a wrong sign turns `R`
//! into a reflection.
//! [`match_basis`] chooses among them: within each cluster of nearly equal eigenvalues as near as possible to the bases of the
//! keys before and after, and to that of the example, and without mirroring.
//!
//! # Coefficients keep their fluctuation
//!
//! Over time, coefficients of real people are a line from end to end with waves on it: their steps, their sway. Between two keys, the new coefficients are the line between those of the keys, plus the
//! example's own coefficients minus the line between their ends. At the keys the deviation is 0, and the crowd is in the
//! key formation. The centroid of the crowd is interpolated in the same way.
//!
//! The example's coefficients need a basis in every frame, too, and here we go further than the paper. Taken from
//! eigenvectors frame by frame, they jump whenever two eigenvalues pass each other, by metres within a tenth of a second,
//! although the people of the example do not (see [`Follower`]). So by default the example's basis is found at the keys' times and
//! turns in between as the new one does. That is the paper's own finding, that recorded eigenvectors turn nearly evenly as
//! long as the pattern of adjacency is one ([`sphere_tracks`] tells how nearly), put to use: key formations that are the example's
//! own give back the example to the last digit, and the energy of the fluctuation stays, since all bases are orthonormal.
//! [`FormationOptions::decompositions`] asks for bases in between.
//!
//! # Options
//!
//! [`AdjacencyEdit`] sets the adjacency of people who stay together, [`Carry`] lets the fluctuation stay with each person
//! rather than with each shape, [`Ease`] brings the crowd to rest in a key formation.
//!
//! Results are the same for any number of threads. They are promised to be the same on one machine only: nalgebra's products
//! use the processor's instructions.

mod agreement;
mod apart;
mod assignment;
mod avoidance;
mod basis;
mod blend;
mod error;
mod example;
mod follow;
mod formed;
mod found;
mod hierarchy;
mod interpolate;
mod keys;
mod kirchhoff;
mod limits;
mod matching;
mod options;
mod picture;
mod places;
mod planes;
mod polar;
mod request;
mod rotation;
mod sphere;

pub use agreement::Agreement;
pub use basis::Basis;
pub use error::FormationError;
pub use example::{ExampleCoefficients, example_coefficients};
pub use follow::Follower;
pub use formed::{FormedCrowd, FormedPerson};
pub use hierarchy::form;
pub use interpolate::interpolate;
pub(crate) use kirchhoff::kirchhoff;
pub use kirchhoff::{AdjacencyEdit, default_sigma_m};
pub(crate) use limits::LEAST_PEOPLE;
pub use limits::MOST_PEOPLE;
pub use matching::match_basis;
pub use options::{Carry, Ease, FormationOptions, KeyFormation};
pub use picture::is_picture;
pub use request::{
    AdjacencyRequest, Assign, AvoidRequest, Choice, CrowdRequest, ExampleKind, ExampleRequest, FormationRequest,
    FormationShape, KeyRequest, Members, MembersWord, Pace, PathRequest, Repeat, RequestError, Stays,
};
pub use rotation::Rotation;
pub use sphere::{SphereTracks, sphere_tracks};
