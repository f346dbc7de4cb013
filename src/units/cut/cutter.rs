use super::groups::groups;
use super::options::CutOptions;
use super::stretch::{UnitInterval, stretch_from};
use super::walks::{FPS, SpotTracks};
use crate::math::Vec2;
use crate::motion::Motion;
use crate::progress::Progress;
use crate::units::{Diversity, DiversityReport, SpotFrame, Unit, UnitsError};

/// Interval between the starts that are tried, frames.
const EVERY_FRAMES: u64 = 5;
/// Share of the shorter unit above which two units with a person in common overlap; the less interesting is dropped.
const MOST_SHARED: f64 = 0.3;

/// The viewer's own frame.
const VIEWER: SpotFrame = SpotFrame { at_m: Vec2::ZERO, ahead: Vec2 { x: 0.0, y: 1.0 } };

/// The units cut at a spot.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitCuts {
    /// The units, by descending interest.
    pub cuts: Vec<UnitCut>,
    /// Diversity of speeds and headings in the area in front, over the whole motion.
    pub diversity: DiversityReport,
}

/// A unit with its origin in the motion.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitCut {
    /// The unit.
    pub unit: Unit,
    /// Start in the motion, seconds.
    pub start_s: f64,
    /// Ids of its members, in their order.
    pub ids: Vec<u32>,
    /// Interest of the unit: sum of the entropies of its speeds and headings, bits, see `Diversity`.
    pub interest_bits: f64,
}

/// Cuts the most interesting units out of a motion, as seen by a viewer at a spot.
///
/// Every half second a unit may start with the groups in the front and rear area. It ends when a member disappears, all
/// members have left the areas, another person comes near, or it reaches the largest duration. People who stay near each
/// other at the same velocity for seconds form a group. The sway of heads is smoothed. Of units that overlap, the most
/// interesting one is kept. Names begin with `name`.
///
/// # Errors
/// Errors of the motion, options out of range, [`UnitsError::NothingToCut`], [`UnitsError::Interrupted`].
pub fn cut(
    motion: &mut dyn Motion,
    name: &str,
    spot: SpotFrame,
    options: &CutOptions,
    progress: &dyn Progress,
) -> Result<UnitCuts, UnitsError> {
    options.check()?;
    let nothing =
        |reason: &str| UnitsError::NothingToCut { x: spot.at_m.x, y: spot.at_m.y, reason: reason.to_string() };
    let walks = SpotTracks::read(motion, &spot, progress)?;
    let Some([first, last]) = walks.span() else { return Err(nothing("nobody comes near")) };
    let together = groups(&walks);
    let mut found: Vec<(f64, UnitInterval)> = Vec::new();
    let mut frame = first;
    while frame <= last {
        progress.keep_on()?;
        if let Some(stretch) = stretch_from(&walks, &together, frame, options) {
            found.push((interest_bits(&walks, &stretch, options), stretch));
        }
        frame += EVERY_FRAMES;
    }
    // Of equally interesting ones, the earlier first.
    found.sort_by(|(a, s), (b, t)| b.total_cmp(a).then(s.from.cmp(&t.from)));
    let mut cuts: Vec<(UnitCut, UnitInterval)> = Vec::new();
    for (interest_bits, stretch) in found {
        if cuts.len() == options.most {
            break;
        }
        if cuts.iter().any(|(_, kept)| stretch.shares(kept) > MOST_SHARED) {
            continue;
        }
        let start_s = stretch.from as f64 / FPS;
        let unit = stretch.unit(&walks, &together, format!("{name} {start_s:.1} s"), options);
        // A unit that its file could not hold, such as one in which a person leaps, is skipped.
        let Ok(unit) = Unit::parse(&unit.to_toml(), std::path::Path::new("cut")) else { continue };
        let ids = stretch.members.iter().map(|&walk| walks.all[walk].id).collect();
        cuts.push((UnitCut { unit, start_s, ids, interest_bits }, stretch));
    }
    if cuts.is_empty() {
        return Err(nothing("nobody stays in the areas long enough, apart from others"));
    }
    let mut diversity = Diversity::new(VIEWER, options.areas);
    for moment in (first..=last).flat_map(|frame| walks.present(frame)).map(|(_, moment)| moment) {
        diversity.count_within(moment);
    }
    Ok(UnitCuts { cuts: cuts.into_iter().map(|(cut, _)| cut).collect(), diversity: diversity.report() })
}

fn interest_bits(walks: &SpotTracks, stretch: &UnitInterval, options: &CutOptions) -> f64 {
    let mut diversity = Diversity::new(VIEWER, options.areas);
    for &walk in &stretch.members {
        for frame in stretch.from..=stretch.to {
            if let Some(moment) = walks.all[walk].at(frame) {
                diversity.count(moment.velocity_m_s.length(), Some(moment.heading));
            }
        }
    }
    let report = diversity.report();
    report.speed_bits + report.heading_bits
}
