//! Social forces with groups: people push each other by their mere presence, and friends walk side by side.
//!
//! The interaction of strangers is that of Moussaid, Helbing, Garnier, Johansson, Combe, Theraulaz 2009 (doi
//! 10.1098/rspb.2009.0405), see [`SocialForceOptions`]; what keeps groups of two to four together is that of Moussaid,
//! Perozo, Garnier, Helbing, Theraulaz 2010 (doi 10.1371/journal.pone.0010047), see [`GroupOptions`].

mod forces;
mod model;
mod options;

pub(super) use model::SocialForce;
pub use options::{GroupOptions, SocialForceOptions};
