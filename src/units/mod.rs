//! Crowd units: short pieces of what a few people do around somebody who looks on, to be played at a spot that is looked
//! at closely (Matsumoto, Mori, Toyama: *Example-based Composition of Crowd Movement in VR*).
//!
//! A [`Unit`] is `u = { p(t), a, T, c_j(t), g_k }`: the way of the viewer, the area, how long it lasts, everybody's
//! motion, and who belongs together. A [`UnitLibrary`] holds many of them, [`rank`] finds those that fit the people who
//! happen to be there, [`cut`] takes new ones out of any motion.

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
pub use diversity::{Diversity, DiversityReport};
pub use error::{UnitAt, UnitsError};
pub use library::UnitLibrary;
pub use matching::{Candidate, MatchOptions, Party, Ranking, rank};
pub use track::{TrackSample, TrackState, UnitTrack};
pub use unit::{AREA_DEPTHS_M, AREA_WIDTHS_M, LEAST_APART_M, LONGEST_S, MOST_MEMBERS, Member, Unit};
