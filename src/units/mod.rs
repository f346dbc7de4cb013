//! Crowd units: short clips of a few people around a viewer, played at a spot that is looked at closely.
//!
//! After Matsumoto, Mori, Toyama: *Example-based Composition of Crowd Movement in VR*. A [`Unit`] is
//! `u = { p(t), a, T, c_j(t), g_k }`: the viewer's path, the area, the duration, the members' paths and their groups. A
//! [`UnitLibrary`] holds many units, which are ranked by how they fit the people present, [`cut`] cuts new ones out of any
//! motion.

mod areas;
mod assignment;
mod cut;
mod diversity;
mod error;
mod file;
mod library;
mod matching;
mod track;
mod unit;
mod write;

pub use areas::{AreaSide, Areas, SpotFrame};
pub use cut::{CutOptions, UnitCut, UnitCuts, cut};
pub(crate) use diversity::Diversity;
pub use diversity::DiversityReport;
pub use error::{UnitAt, UnitsError};
pub use library::UnitLibrary;
pub(crate) use matching::{Candidate, MatchOptions, Party, rank};
pub use track::{TrackSample, TrackState, UnitTrack};
pub(crate) use unit::{LEAST_APART_M, LONGEST_S};
pub use unit::{Member, Unit};
