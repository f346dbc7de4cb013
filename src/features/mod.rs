//! What a crowd moves like, as a few components, and new motion made of them.
//!
//! A motion is taken apart: the path of the crowd's middle, everybody's mean place around it (the *formation*), and
//! everybody's displacement from there. The displacements are written in a basis of *components*, whose *coefficients*
//! say how far the crowd is displaced along each at every moment. There are two such bases, see [`Method`]:
//!
//! * **Principal components**: the unit eigenvectors of the covariance `V = 1/m sum_j D_j D_j^T` of all coordinates `D_j`
//!   (2n numbers for n people), by descending eigenvalue. No other basis leaves a smaller error with as many components.
//! * **Laplacian**: the unit eigenvectors of the covariance of the Kirchhoff matrices `K_j = B_j - A_j` over time, with
//!   `A_j` the adjacency of people within a distance and `B_j` everybody's number of neighbours:
//!   `S = 1/m sum_j (K_j - Kbar)^T (K_j - Kbar)`, n x n, by descending eigenvalue. The mean and deviation of matrices that
//!   describe the crowd, as the mean and deviation of coordinates above: first come the patterns in which neighbourhoods
//!   change most. (Eigenvectors of the mean alone would begin with those in which neighbours differ most, which is noise
//!   rather than motion.) Every component has a coefficient for x and one for y.
//!
//! Principal components do not depend on who is near whom; the Laplacian says little of the motion where few are. Of a
//! crowd of 24 that moves towards its centre, four numbers a moment (4 principal components, 2 of the Laplacian) leave
//! 3 % of the motion with principal components; with the Laplacian they leave 100 % where people have 1 neighbour in the
//! mean, 98 % with 7, 55 % with 13 and 17 % with 20 (root of the mean square, as a share). With next to no neighbours,
//! components are ordered by motion alone, and it leaves little again.
//!
//! [`Features`] holds this, rebuilds the motion with the first components, and makes new motion by working on the
//! coefficients ([`Modulation`]). [`Mix`] gives one crowd the features of another besides its own.
//!
//! After an approach of example-based description of crowd motion by projection to an eigenspace and by approximation with
//! a Laplacian matrix, in which multiplying coefficients by 2 doubles velocities, a sine makes the motion periodic, and
//! the bases of two crowds, interleaved by eigenvalue, move one crowd with the features of both.
//!
//! The same input gives the same result on any number of threads; between machines the last digits may differ, for
//! matrix products and eigenvectors come from `nalgebra`.

mod component_range;
mod decomposition;
mod displacement;
mod eigen;
mod error;
mod expression;
mod laplacian;
mod matching;
mod method;
mod mix;
mod modulation;
mod neighbours;
mod progress_range;
mod principal;
mod presence;

pub use component_range::{ComponentRange, ComponentsError};
pub use decomposition::{FeatureComponent, Features};
pub use displacement::MOST_FEATURE_PLACES;
pub use eigen::MOST_ROWS;
pub use error::FeaturesError;
pub use expression::{Expression, ExpressionError, LONGEST_EXPRESSION, Mistake, Variables};
pub use method::{FeaturesOptions, Method, NEIGHBOUR_DISTANCES_M};
pub use mix::{CentroidPath, Mix, MixOptions, MixSource};
pub use modulation::{CoefficientChange, Modulation, Rule};
pub use presence::{Presence, PresenceSpan, present_throughout};

#[cfg(test)]
mod tests;
