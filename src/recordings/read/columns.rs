//! Roles of columns, found from their names.

use super::LengthUnit;

/// The quantity that a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// Id of the person.
    Id,
    /// Frame number.
    Frame,
    /// Time.
    Time,
    X,
    Y,
    /// The third axis: height, or the floor's second axis in files where y points up.
    Z,
    /// Body height.
    Height,
    VelocityX,
    VelocityY,
    HeadingX,
    HeadingY,
    /// Heading as an angle, counter-clockwise from +x.
    HeadingAngle,
    /// Time and position of the end of a step that starts at time, x, y.
    EndTime,
    EndX,
    EndY,
    /// Ignored.
    Unused,
}

/// The unit of a column, if its name gives one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ColumnUnit {
    Length(LengthUnit),
    /// Seconds per unit.
    Time(f64),
    /// Radians per unit.
    Angle(f64),
}

/// Role, unit and sign of a column, from its name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TextColumn {
    pub role: Role,
    pub unit: Option<ColumnUnit>,
    /// Whether the sign is reversed.
    pub flipped: bool,
}

impl TextColumn {
    pub const UNUSED: TextColumn = TextColumn { role: Role::Unused, unit: None, flipped: false };

    /// Whether the column may hold body heights.
    pub fn is_height(&self) -> bool {
        matches!(self.role, Role::Z | Role::Height)
    }

    /// Whether every line needs a value for it.
    pub fn is_needed(&self) -> bool {
        self.role != Role::Unused && !self.is_height()
    }
}

/// Names of each role by rank: of several matching columns in a file, the first name wins.
const NAMES: [(Role, &[&str]); 15] = [
    (
        Role::Id,
        &[
            "pedestrianid",
            "pedid",
            "persid",
            "personid",
            "agentid",
            "playerid",
            "userid",
            "trackid",
            "actorid",
            "entityid",
            "clientid",
            "characterid",
            "objectid",
            "participantid",
            "subjectid",
            "visitorid",
            "steamid",
            "id",
            "pid",
            "uid",
            "uuid",
            "guid",
            "no",
            "nr",
            "number",
            "pedestrian",
            "person",
            "ped",
            "agent",
            "player",
            "user",
            "actor",
            "entity",
            "track",
            "client",
            "character",
            "object",
            "participant",
            "subject",
            "visitor",
            "playername",
            "username",
            "name",
            "bot",
        ],
    ),
    (
        Role::Time,
        &[
            "time",
            "t",
            "simtime",
            "simsec",
            "seconds",
            "sec",
            "secs",
            "s",
            "elapsed",
            "elapsedtime",
            "gametime",
            "worldtime",
            "sessiontime",
            "matchtime",
            "realtime",
            "timestamp",
            "ts",
            "ms",
            "msec",
            "millis",
            "milliseconds",
            "datetime",
            "clock",
        ],
    ),
    (
        Role::Frame,
        &[
            "frame",
            "fr",
            "framenumber",
            "frameid",
            "frameno",
            "framenr",
            "frameindex",
            "framecount",
            "framenum",
            "tick",
            "ticks",
            "tickcount",
            "gametick",
            "timestep",
            "step",
        ],
    ),
    (
        Role::X,
        &[
            "x",
            "posx",
            "xpos",
            "positionx",
            "xposition",
            "px",
            "coordx",
            "coordcentx",
            "startx",
            "xcoord",
            "xcoordinate",
            "worldx",
            "locationx",
            "locx",
            "xloc",
            "centerx",
            "centrex",
        ],
    ),
    (
        Role::Y,
        &[
            "y",
            "posy",
            "ypos",
            "positiony",
            "yposition",
            "py",
            "coordy",
            "coordcenty",
            "starty",
            "ycoord",
            "ycoordinate",
            "worldy",
            "locationy",
            "locy",
            "yloc",
            "centery",
            "centrey",
        ],
    ),
    (
        Role::Z,
        &[
            "z",
            "posz",
            "zpos",
            "positionz",
            "zposition",
            "pz",
            "coordz",
            "coordcentz",
            "zcoord",
            "zcoordinate",
            "worldz",
            "locationz",
            "locz",
            "zloc",
        ],
    ),
    (Role::Height, &["height", "bodyheight", "stature"]),
    (Role::VelocityX, &["vx", "velx", "xvel", "velocityx", "xvelocity", "speedx"]),
    (Role::VelocityY, &["vy", "vely", "yvel", "velocityy", "yvelocity", "speedy"]),
    (Role::HeadingX, &["orix", "headingx", "facingx", "directionx", "dirx", "forwardx", "lookx", "hx", "orientationx"]),
    (Role::HeadingY, &["oriy", "headingy", "facingy", "directiony", "diry", "forwardy", "looky", "hy", "orientationy"]),
    (Role::HeadingAngle, &["heading", "facing", "yaw", "orientation"]),
    (Role::EndTime, &["endtime"]),
    (Role::EndX, &["endx"]),
    (Role::EndY, &["endy"]),
];

/// Returns the column that a name means, and its rank in the list of names. Ignores case, blanks and punctuation; a
/// unit may follow: `x/m`, `pos_x [cm]`, `time_ms`.
pub(super) fn column_named(name: &str) -> Option<(TextColumn, usize)> {
    let name = name.trim().trim_matches('"').trim();
    if name == "-" {
        return Some((TextColumn::UNUSED, 0));
    }
    let (flipped, name) = match name.strip_prefix(['-', '!']) {
        Some(name) => (true, name),
        None => (false, name),
    };
    let lower = name.to_ascii_lowercase();
    // Vadere appends the number of a processor: `startX-PID1`.
    let lower = match lower.rfind("-pid") {
        Some(at) if at > 0 && lower[at + 4..].bytes().all(|b| b.is_ascii_digit()) => lower[..at].to_owned(),
        _ => lower,
    };
    let (base, unit) = split_unit(&lower);
    let word: String = base.chars().filter(char::is_ascii_alphanumeric).collect();
    let exact = NAMES.iter().find_map(|(role, names)| names.iter().position(|n| *n == word).map(|rank| (*role, rank)));
    // Telemetry uses paths of fields: `transform.position.x`.
    let (role, rank) = exact.or_else(|| {
        let ends = |ending: &str| word.ends_with(ending);
        let of = |axis: char| ["position", "pos", "location"].iter().any(|part| ends(&format!("{part}{axis}")));
        [('x', Role::X), ('y', Role::Y), ('z', Role::Z)]
            .into_iter()
            .find(|(axis, _)| of(*axis))
            .map(|(_, role)| (role, 99))
    })?;
    let unit = match (unit, word.as_str()) {
        (None, "ms" | "msec" | "millis" | "milliseconds") => Some(ColumnUnit::Time(1e-3)),
        (None, "simsec" | "simtime" | "seconds" | "sec" | "secs" | "s") => Some(ColumnUnit::Time(1.0)),
        (unit, _) => unit,
    };
    // An angle without a unit could be degrees or radians.
    if role == Role::HeadingAngle && !matches!(unit, Some(ColumnUnit::Angle(_))) {
        return None;
    }
    Some((TextColumn { role, unit, flipped }, rank))
}

/// Returns the unknown unit behind the name of an x or y column, such as `px` in `x [px]`.
pub(super) fn strange_unit(name: &str) -> Option<&str> {
    let (column, _) = column_named(name)?;
    if !matches!(column.role, Role::X | Role::Y) || column.unit.is_some() {
        return None;
    }
    let (_, unit) = name.split_once(['[', '(', '/'])?;
    let unit = unit.trim_end_matches([']', ')', '"', ' ']).trim();
    (!unit.is_empty()).then_some(unit)
}

/// Splits a name into quantity and unit.
fn split_unit(name: &str) -> (&str, Option<ColumnUnit>) {
    for (open, close) in [('[', "]"), ('(', ")"), ('/', "")] {
        if let Some((base, unit)) = name.split_once(open) {
            let unit = unit_named(unit.trim().trim_end_matches(close));
            return (base, unit);
        }
    }
    for between in ["_in_", " in ", "_", " "] {
        if let Some((base, word)) = name.rsplit_once(between)
            && let (false, Some(unit)) = (base.is_empty(), unit_named(word))
        {
            return (base, Some(unit));
        }
    }
    (name, None)
}

/// Returns the unit that a word names.
pub(super) fn unit_named(word: &str) -> Option<ColumnUnit> {
    Some(match word.trim().to_ascii_lowercase().as_str() {
        "m" | "meter" | "meters" | "metre" | "metres" => ColumnUnit::Length(LengthUnit::Metre),
        "cm" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => {
            ColumnUnit::Length(LengthUnit::Centimetre)
        }
        "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" => {
            ColumnUnit::Length(LengthUnit::Millimetre)
        }
        "ft" | "foot" | "feet" => ColumnUnit::Length(LengthUnit::Foot),
        "s" | "sec" | "secs" | "second" | "seconds" => ColumnUnit::Time(1.0),
        "ms" | "msec" | "millis" | "milliseconds" => ColumnUnit::Time(1e-3),
        "us" | "usec" | "micros" | "microseconds" => ColumnUnit::Time(1e-6),
        "ns" | "nanoseconds" => ColumnUnit::Time(1e-9),
        "deg" | "degree" | "degrees" => ColumnUnit::Angle(std::f64::consts::PI / 180.0),
        "rad" | "radian" | "radians" => ColumnUnit::Angle(1.0),
        _ => return None,
    })
}

/// Assigns each role to at most one column: the column whose name has the best rank. `numbers_rows` returns whether an
/// id column only numbers the rows.
pub(super) fn assign(names: &[&str], numbers_rows: impl Fn(usize) -> bool) -> Vec<TextColumn> {
    let known: Vec<Option<(TextColumn, usize)>> = names.iter().map(|name| column_named(name)).collect();
    let mut columns = vec![TextColumn::UNUSED; names.len()];
    for (role, _) in NAMES {
        let rank = |at: usize| known[at].filter(|(column, _)| column.role == role).map(|(_, rank)| rank);
        let mut candidates: Vec<usize> = (0..names.len()).filter(|&at| rank(at).is_some()).collect();
        candidates.sort_by_key(|&at| rank(at));
        let best = candidates.iter().find(|&&at| role != Role::Id || !numbers_rows(at)).or(candidates.first());
        if let Some(&at) = best
            && let Some((column, _)) = known[at]
        {
            columns[at] = column;
        }
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    fn role(name: &str) -> Option<Role> {
        column_named(name).map(|(column, _)| column.role)
    }

    #[test]
    fn names_are_known_in_many_spellings() {
        for (names, expected) in [
            (&["id", "ID", "PersID", "pedID", "Player Name", "\"player_id\"", "NO", "agent"][..], Role::Id),
            (&["t", "Time", "time_ms", "SIMSEC", "timestamp [ms]", "gameTime(s)"], Role::Time),
            (&["Frame", "FR", "tick", "frame_number"], Role::Frame),
            (&["X", "x/m", "pos_x", "posX", "x (cm)", "startX-PID1", "COORDCENTX", "Transform.Position.X"], Role::X),
            (&["y", "Y/cm", "location_y", "PosY", "y_m", "-y"], Role::Y),
            (&["v_x", "vx", "velocity x", "vel_x/m"], Role::VelocityX),
            (&["endTime-PID1", "end_time"], Role::EndTime),
            (&["heading_deg", "Yaw [rad]", "facing (degrees)"], Role::HeadingAngle),
            (&["height_m", "Height"], Role::Height),
            (&["-"], Role::Unused),
        ] {
            for name in names {
                assert_eq!(role(name), Some(expected), "{name}");
            }
        }
        for name in ["", "health", "rho", "velocity", "M", "xyz", "é", "-pid1", "heading", "yaw_m", "speed_m_s"] {
            assert_eq!(role(name), None, "{name}");
        }
    }

    #[test]
    fn units_are_taken_from_names() {
        let unit = |name| column_named(name).and_then(|(column, _)| column.unit);
        for name in ["x/cm", "x [cm]", "x_cm", "x (cm)", "x in cm"] {
            assert_eq!(unit(name), Some(ColumnUnit::Length(LengthUnit::Centimetre)), "{name}");
        }
        assert_eq!(unit("t/s"), Some(ColumnUnit::Time(1.0)));
        assert_eq!(unit("time_ms"), Some(ColumnUnit::Time(1e-3)));
        assert_eq!(unit("milliseconds"), Some(ColumnUnit::Time(1e-3)));
        assert_eq!((unit("x"), unit("pos_x")), (None, None));
        assert_eq!(
            ["x [px]", "y/furlong", "x/m", "x", "rho/x"].map(strange_unit),
            [Some("px"), Some("furlong"), None, None, None]
        );
    }

    #[test]
    fn of_several_the_best_name_wins() {
        let roles = |names: &[&str]| assign(names, |_| false).iter().map(|c| c.role).collect::<Vec<_>>();
        assert_eq!(
            roles(&["name", "id", "t", "x", "y", "y"])[..5],
            [Role::Unused, Role::Id, Role::Time, Role::X, Role::Y]
        );
        let with_row_numbers = assign(&["id", "player", "time", "x", "y"], |at| at == 0);
        assert_eq!((with_row_numbers[0].role, with_row_numbers[1].role), (Role::Unused, Role::Id));
    }
}
