//! Reads a unit from its file.

use std::ops::Range;
use std::path::Path;

use serde::Deserialize;
use toml::Spanned;

use super::error::{UnitAt, UnitsError};
use super::track::{TrackSample, UnitTrack};
use super::unit::{
    AREA_DEPTHS_M, AREA_WIDTHS_M, FASTEST_M_S, HARDEST_M_S2, LEAST_APART_M, LONGEST_S, MOST_MEMBERS, Member, Unit,
};
use crate::math::{Vec2, sin_cos, vec2};

/// Largest size of a unit file, bytes.
pub(super) const LARGEST_BYTES: u64 = 4 << 20;
/// Largest coordinate of a position, metres.
const FARTHEST_M: f64 = 100.0;
/// Interval at which paths are checked, seconds.
const LOOK_S: f64 = 0.1;
/// The shortest unit, seconds.
const SHORTEST_S: f64 = 1.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawUnit {
    name: Spanned<String>,
    #[serde(default)]
    description: String,
    area: Spanned<[f64; 2]>,
    duration: Spanned<f64>,
    #[serde(default)]
    viewer: Vec<Spanned<Vec<f64>>>,
    #[serde(default)]
    member: Vec<Spanned<RawMember>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawMember {
    group: Option<String>,
    path: Spanned<Vec<Spanned<Vec<f64>>>>,
}

/// A unit file's text, with the locations of its values.
struct UnitText<'t> {
    text: &'t str,
    file: &'t Path,
}

impl UnitText<'_> {
    fn at(&self, span: Option<Range<usize>>) -> UnitAt {
        let start = span.map_or(0, |span| span.start).min(self.text.len());
        let before = String::from_utf8_lossy(&self.text.as_bytes()[..start]);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        UnitAt {
            file: self.file.to_path_buf(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        }
    }

    fn wrong(&self, span: Range<usize>, problem: String) -> UnitsError {
        UnitsError::Value { at: self.at(Some(span)), problem }
    }

    /// Checks a number against a range; NaN is out of it.
    fn within(&self, span: Range<usize>, name: &str, value: f64, [low, high]: [f64; 2]) -> Result<(), UnitsError> {
        match value >= low && value <= high {
            true => Ok(()),
            false => Err(self.wrong(span, format!("{name} is {value}, allowed is {low} to {high}"))),
        }
    }
}

impl Unit {
    /// Parses the text of a unit file; `file` is only used in error messages.
    ///
    /// ```toml
    /// name = "stops at the phone"       # what the report calls it
    /// description = "..."               # left out: empty
    /// area = [3.0, 5.0]                 # [m] width and depth before the viewer
    /// duration = 8.0                    # [s]
    /// viewer = [[0.0, 0.0, 0.0]]        # [t, x, y]; left out: stands at [0, 0]
    ///
    /// [[member]]                        # one per person, 1 to 12
    /// group = "a"                       # those of one group walk together; left out: alone
    /// path = [                          # [s], [m], [m], heading [degrees] counter-clockwise from +x, the right
    ///     [0.0, -0.4, 2.9, -90],
    ///     [0.5, -0.4, 2.3, -90],
    /// ]
    /// ```
    ///
    /// # Errors
    /// Invalid TOML, unknown keys, wrong types, numbers out of range, times that do not ascend or do not span the unit,
    /// members who overlap or who move faster than people can: with line and column.
    pub fn parse(text: &str, file: &Path) -> Result<Unit, UnitsError> {
        let source = UnitText { text, file };
        let raw: RawUnit = toml::from_str(text).map_err(|error| UnitsError::Syntax {
            at: source.at(error.span()),
            message: error.message().trim().replace('\n', "; "),
        })?;
        let span = raw.name.span();
        if raw.name.get_ref().trim().is_empty() || raw.name.get_ref().chars().count() > 120 {
            return Err(source.wrong(span, "the name has no letters, or more than 120".to_string()));
        }
        let [width_m, depth_m] = *raw.area.get_ref();
        source.within(raw.area.span(), "the width of the area", width_m, AREA_WIDTHS_M)?;
        source.within(raw.area.span(), "the depth of the area", depth_m, AREA_DEPTHS_M)?;
        let duration_s = *raw.duration.get_ref();
        source.within(raw.duration.span(), "duration", duration_s, [SHORTEST_S, LONGEST_S])?;
        if raw.member.is_empty() || raw.member.len() > MOST_MEMBERS {
            let problem = format!("the unit has {} members, allowed is 1 to {MOST_MEMBERS}", raw.member.len());
            return Err(source.wrong(span, problem));
        }
        let viewer = viewer(&source, &raw.viewer)?;
        let mut names: Vec<String> = Vec::new();
        let mut members = Vec::new();
        for (index, member) in raw.member.iter().enumerate() {
            members.push(read_member(&source, member.get_ref(), (index, duration_s), &mut names)?);
        }
        let unit = Unit {
            name: raw.name.get_ref().trim().to_string(),
            description: raw.description.trim().to_string(),
            viewer,
            area_m: [width_m, depth_m],
            duration_s,
            members,
        };
        let spans: Vec<Range<usize>> = raw.member.iter().map(|member| member.get_ref().path.span()).collect();
        check_paths(&source, &unit, &spans)?;
        Ok(unit)
    }
}

fn viewer(source: &UnitText<'_>, rows: &[Spanned<Vec<f64>>]) -> Result<UnitTrack, UnitsError> {
    let mut samples: Vec<TrackSample> = Vec::new();
    for row in rows {
        let [time_s, x, y] = row.get_ref()[..] else {
            let problem = format!("a row of the viewer is [t, x, y], not {} numbers", row.get_ref().len());
            return Err(source.wrong(row.span(), problem));
        };
        samples.push(TrackSample { time_s, place_m: place(source, row.span(), [x, y])?, heading: vec2(0.0, 1.0) });
        ascends(source, row.span(), &samples)?;
    }
    if samples.is_empty() {
        samples.push(TrackSample { time_s: 0.0, place_m: Vec2::ZERO, heading: vec2(0.0, 1.0) });
    }
    if samples[0].time_s != 0.0 || samples[0].place_m != Vec2::ZERO {
        let problem = "the viewer starts at [0, 0] at second 0".to_string();
        return Err(source.wrong(rows[0].span(), problem));
    }
    Ok(UnitTrack::new(samples))
}

fn read_member(
    source: &UnitText<'_>,
    raw: &RawMember,
    (index, duration_s): (usize, f64),
    names: &mut Vec<String>,
) -> Result<Member, UnitsError> {
    let mut samples: Vec<TrackSample> = Vec::new();
    for row in raw.path.get_ref() {
        let [time_s, x, y, heading_deg] = row.get_ref()[..] else {
            let problem = format!("a row of a path is [t, x, y, heading], not {} numbers", row.get_ref().len());
            return Err(source.wrong(row.span(), problem));
        };
        source.within(row.span(), "the heading", heading_deg, [-720.0, 720.0])?;
        let (sin, cos) = sin_cos(heading_deg.to_radians());
        samples.push(TrackSample { time_s, place_m: place(source, row.span(), [x, y])?, heading: vec2(cos, sin) });
        ascends(source, row.span(), &samples)?;
    }
    let (first, last) = (samples.first().map_or(f64::NAN, |s| s.time_s), samples.last().map_or(0.0, |s| s.time_s));
    if samples.len() < 2 || first != 0.0 || last < duration_s - 1e-6 {
        let problem = format!("a path lasts from second 0 to the end of the unit, {duration_s}");
        return Err(source.wrong(raw.path.span(), problem));
    }
    // A member without a group is a group of one.
    let name = raw.group.clone().unwrap_or_else(|| format!("\0{index}"));
    let group = names.iter().position(|known| *known == name).unwrap_or_else(|| {
        names.push(name);
        names.len() - 1
    });
    Ok(Member { group: group as u32, track: UnitTrack::new(samples) })
}

fn place(source: &UnitText<'_>, span: Range<usize>, [x, y]: [f64; 2]) -> Result<Vec2, UnitsError> {
    for value in [x, y] {
        source.within(span.clone(), "a place", value, [-FARTHEST_M, FARTHEST_M])?;
    }
    Ok(vec2(x, y))
}

fn ascends(source: &UnitText<'_>, span: Range<usize>, samples: &[TrackSample]) -> Result<(), UnitsError> {
    let [.., before, now] = samples else {
        let first_s = samples.first().map_or(0.0, |sample| sample.time_s);
        return source.within(span, "the first time", first_s, [0.0, 0.0]);
    };
    // Written so that NaN does not ascend.
    if now.time_s >= before.time_s + 0.01 && now.time_s <= 2.0 * LONGEST_S {
        return Ok(());
    }
    let problem = format!("{} s does not come at least 0.01 s after {} s", now.time_s, before.time_s);
    Err(source.wrong(span, problem))
}

/// Checks speeds, accelerations and distances of all members.
fn check_paths(source: &UnitText<'_>, unit: &Unit, spans: &[Range<usize>]) -> Result<(), UnitsError> {
    let looks = (unit.duration_s / LOOK_S) as usize;
    let mut before: Vec<Vec2> = Vec::new();
    for k in 0..=looks {
        let time_s = k as f64 * LOOK_S;
        let moments: Vec<_> = unit.members.iter().map(|member| member.track.at(time_s)).collect();
        for (index, moment) in moments.iter().enumerate() {
            let wrong = |problem: String| {
                let member = index + 1;
                Err(source.wrong(spans[index].clone(), format!("at {time_s:.1} s member {member} {problem}")))
            };
            let speed = moment.velocity_m_s.length();
            if speed > FASTEST_M_S {
                return wrong(format!("moves at {speed:.1} m/s, allowed is {FASTEST_M_S}"));
            }
            if let Some(before) = before.get(index) {
                let change = moment.velocity_m_s.distance(*before) / LOOK_S;
                if change > HARDEST_M_S2 {
                    return wrong(format!("speeds up, brakes or turns by {change:.1} m/s2, allowed is {HARDEST_M_S2}"));
                }
            }
            for (other, near) in moments[..index].iter().enumerate() {
                let apart_m = near.place_m.distance(moment.place_m);
                if apart_m < LEAST_APART_M {
                    let other = other + 1;
                    return wrong(format!("is {apart_m:.2} m from member {other}, allowed is {LEAST_APART_M} or more"));
                }
            }
            let apart_m = unit.viewer.at(time_s).place_m.distance(moment.place_m);
            if apart_m < LEAST_APART_M {
                return wrong(format!("is {apart_m:.2} m from the viewer, allowed is {LEAST_APART_M} or more"));
            }
        }
        before = moments.iter().map(|moment| moment.velocity_m_s).collect();
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "name = \"two\"\narea = [3.0, 5.0]\nduration = 2.0\n\n[[member]]\ngroup = \"a\"\npath = [\n    \
                        [0.0, 0.5, 2.0, -90],\n    [1.0, 0.5, 1.5, -90],\n    [2.0, 0.5, 1.0, -90],\n]\n\n[[member]]\n\
                        group = \"a\"\npath = [[0.0, -0.5, 2.0, 90], [2.0, -0.5, 4.0, 90]]\n";

    fn problem(from: &str, to: &str) -> String {
        assert!(GOOD.contains(from), "{from}");
        Unit::parse(&GOOD.replacen(from, to, 1), Path::new("two.toml")).unwrap_err().to_string()
    }

    #[test]
    fn a_unit_is_read() {
        let unit = Unit::parse(GOOD, Path::new("two.toml")).unwrap();
        assert_eq!((unit.name.as_str(), unit.duration_s, unit.members.len()), ("two", 2.0, 2));
        assert_eq!(unit.composition(), [vec![2], vec![]]);
        let moment = unit.members[1].track.at(1.0);
        assert!(moment.place_m.distance(vec2(-0.5, 3.0)) < 1e-9 && moment.heading.distance(vec2(0.0, 1.0)) < 1e-9);
    }

    #[test]
    fn mistakes_are_named_with_their_line() {
        for (from, to, expected) in [
            ("[1.0, 0.5, 1.5, -90]", "[1.0, 0.5, 1.5]", "two.toml:9:5: a row of a path is [t, x, y, heading], not 3"),
            ("[1.0, 0.5, 1.5, -90]", "[0.0, 0.5, 1.5, -90]", "two.toml:9:5: 0 s does not come at least"),
            ("[1.0, 0.5, 1.5, -90]", "[1.0, nan, 1.5, -90]", "two.toml:9:5: a place is NaN"),
            ("[1.0, 0.5, 1.5, -90]", "[1.0, 0.5, inf, -90]", "two.toml:9:5: a place is inf"),
            ("[1.0, 0.5, 1.5, -90]", "[1.0, 0.5, 19.5, -90]", "m/s"),
            ("[1.0, 0.5, 1.5, -90]", "[1.0, 0.5, 1.5, nan]", "two.toml:9:5: the heading is NaN"),
            ("duration = 2.0", "duration = 3.0", "two.toml:7:8: a path lasts from second 0 to the end of the unit, 3"),
            ("duration = 2.0", "duration = 1e9", "two.toml:3:12: duration is 1000000000, allowed is 1 to 120"),
            ("duration = 2.0", "durations = 2.0", "two.toml:3:1: unknown field `durations`"),
            ("area = [3.0, 5.0]", "area = [3.0]", "two.toml:2:8: "),
            ("area = [3.0, 5.0]", "area = [3.0, -5.0]", "two.toml:2:8: the depth of the area is -5"),
            ("name = \"two\"", "name = two", "two.toml:1:8: "),
            ("name = \"two\"", "name = \" \"", "two.toml:1:8: the name has no letters"),
            (
                "[0.0, -0.5, 2.0, 90], [2.0, -0.5, 4.0, 90]",
                "[0.0, 0.3, 2.0, 90], [2.0, -0.5, 4.0, 90]",
                "two.toml:15:8: at 0.0 s member 2 is 0.20 m from member 1",
            ),
            (
                "[0.0, -0.5, 2.0, 90], [2.0, -0.5, 4.0, 90]",
                "[0.0, -0.5, -2.0, 90], [2.0, 0.5, 2.0, 90]",
                "from the viewer",
            ),
        ] {
            let said = problem(from, to);
            assert!(said.contains(expected), "{from} -> {to}: {said}");
        }
    }

    #[test]
    fn damaged_files_are_refused_without_a_panic() {
        for cut in 0..GOOD.len() {
            if GOOD.is_char_boundary(cut) {
                let _ = Unit::parse(&GOOD[..cut], Path::new("two.toml"));
            }
        }
        let none = "name = \"a\"\narea = [3, 5]\nduration = 2\n";
        assert!(Unit::parse(none, Path::new("a.toml")).unwrap_err().to_string().contains("0 members"));
    }
}
