use super::{
    CrowdRequest, CrowdSection, DEEPEST, ExampleRequest, FARTHEST_M, FormationRequest, FormationShape, KeyRequest,
    MOST_PEOPLE, Members,
};
use crate::math::Vec2;
use crate::options::{OptionError, Options};

fn wrong(key: &str, problem: impl Into<String>, hint: impl Into<Option<&'static str>>) -> OptionError {
    OptionError::Unfit { key: key.to_string(), problem: problem.into(), hint: hint.into().map(str::to_string) }
}

impl FormationRequest {
    /// Checks all values and their consistency, as far as possible without reading files.
    ///
    /// # Errors
    /// The first value out of range or in conflict, with its key, as `formation.key.2.time_s`.
    pub fn check(&self) -> Result<(), OptionError> {
        let path = "formation";
        self.check_ranges().map_err(|error| error.within(path))?;
        if let Some(way) = &self.way {
            let path = "formation.way";
            let points = way.from.iter().chain(&way.to).chain(&way.path);
            if points.clone().count() == 0 {
                return Err(wrong(path, "the path has no points", "write `from` and `to`, or a `path`"));
            }
            points.into_iter().try_for_each(|&point| place(path, "path", point))?;
            if way.to_s.is_some_and(|to_s| to_s <= way.from_s) {
                return Err(wrong(&format!("{path}.to_s"), "the path ends before it begins", None));
            }
        }
        self.section().check(path, 0, self.duration_s)
    }
}

impl CrowdSection<'_> {
    fn check(&self, path: &str, depth: usize, duration_s: Option<f64>) -> Result<(), OptionError> {
        self.example.check(&format!("{path}.example"))?;
        for (index, group) in self.together.iter().enumerate() {
            members(&format!("{path}.together.{index}"), group, 2)?;
        }
        for (index, edit) in self.adjacency.iter().enumerate() {
            let path = format!("{path}.adjacency.{index}");
            members(&format!("{path}.members"), &edit.members, 2)?;
        }
        let mut ends_s = None;
        for (index, key) in self.key.iter().enumerate() {
            let path = format!("{path}.key.{index}");
            key.check(&path, depth > 0)?;
            if let Some(before) = ends_s.filter(|&before| key.time_s <= before) {
                let problem =
                    format!("{} s is not after the key formation before it, which ends at {before} s", key.time_s);
                return Err(wrong(
                    &format!("{path}.time_s"),
                    problem,
                    "write key formations in the order of their times",
                ));
            }
            let end_s = key.time_s + key.hold_s;
            if let Some(duration_s) = duration_s.filter(|&duration_s| end_s > duration_s) {
                let problem =
                    format!("the key formation ends at {end_s} s, after the whole formation, at {duration_s} s");
                return Err(wrong(&format!("{path}.time_s"), problem, "set a longer `duration_s`"));
            }
            ends_s = Some(end_s);
        }
        for (index, crowd) in self.crowd.iter().enumerate() {
            crowd.check(&format!("{path}.crowd.{index}"), depth + 1, duration_s)?;
        }
        Ok(())
    }
}

impl CrowdRequest {
    fn check(&self, path: &str, depth: usize, duration_s: Option<f64>) -> Result<(), OptionError> {
        if depth > DEEPEST {
            return Err(wrong(path, format!("small crowds are nested {DEEPEST} deep at most"), None));
        }
        match &self.members {
            Members::Word(_) => {}
            Members::List(list) => members(&format!("{path}.members"), list, 1)?,
            Members::Every { every: 0, .. } => {
                return Err(wrong(&format!("{path}.members"), "`every` is 0, allowed is 1 or more", None));
            }
            Members::Every { .. } => {}
        }
        if self.rider && self.as_one == Some(false) {
            let problem = "a rider needs carriers who keep together";
            return Err(wrong(&format!("{path}.as_one"), problem, "leave `as_one` out, or the rider"));
        }
        self.section().check(path, depth, duration_s)
    }
}

impl ExampleRequest {
    fn check(&self, path: &str) -> Result<(), OptionError> {
        if let (Some(_), Some(_)) = (&self.file, self.kind) {
            let hint = "leave one of the two out";
            return Err(wrong(&format!("{path}.kind"), "the example has both a file and a kind", hint));
        }
        if self.to_s.is_some_and(|to_s| to_s <= self.from_s) {
            let problem = format!("the example ends before it begins, at {} s", self.from_s);
            return Err(wrong(&format!("{path}.to_s"), problem, None));
        }
        if let (Some(rows), Some(columns)) = (self.rows, self.columns) {
            let product = u64::from(rows) * u64::from(columns);
            if product > MOST_PEOPLE as u64 {
                let problem = format!("{rows} rows of {columns} are {product} people, allowed are {MOST_PEOPLE}");
                return Err(wrong(&format!("{path}.rows"), problem, None));
            }
            if let Some(people) = self.people.filter(|&people| u64::from(people) > product) {
                let problem = format!("{people} people do not stand in {rows} rows of {columns}");
                return Err(wrong(&format!("{path}.people"), problem, "leave `people` or `rows` out"));
            }
        }
        for (index, list) in self.choose.iter().flat_map(|choice| choice.lists()).enumerate() {
            let key = format!("{path}.choose");
            let key = if matches!(self.choose, Some(super::Choice::Each(_))) { format!("{key}.{index}") } else { key };
            members(&key, list, 1)?;
        }
        if self.choose.as_ref().is_some_and(|choice| choice.lists().is_empty()) {
            return Err(wrong(&format!("{path}.choose"), "no person is chosen", None));
        }
        Ok(())
    }
}

impl KeyRequest {
    fn check(&self, path: &str, in_crowd: bool) -> Result<(), OptionError> {
        let sources = [
            ("shape", self.shape.is_some()),
            ("text", self.text.is_some()),
            ("points", self.points.is_some()),
            ("file", self.file.is_some()),
        ];
        let mut given = sources.iter().filter(|source| source.1).map(|source| source.0);
        match (given.next(), given.next()) {
            (None, _) => {
                let hint = "write a `shape`, a `text`, `points` or a `file`";
                return Err(wrong(path, "the key formation has no positions", hint));
            }
            (Some(first), Some(second)) => {
                let problem = format!("the key formation has both `{first}` and `{second}`");
                return Err(wrong(&format!("{path}.{second}"), problem, "leave one of the two out"));
            }
            _ => {}
        }
        self.check_fit(path)?;
        if let Some(letters) = self.text.as_deref() {
            let unknown = super::super::places::unknown_letters(letters);
            if !unknown.is_empty() {
                let hint = "there are letters for A to Z, 0 to 9, blanks and - + . : ! ? / '";
                return Err(wrong(&format!("{path}.text"), format!("there are no letters for \"{unknown}\""), hint));
            }
            if letters.trim().is_empty() || letters.chars().count() > 200 {
                let problem = format!("`text` has {} letters, allowed are 1 to 200", letters.chars().count());
                return Err(wrong(&format!("{path}.text"), problem, None));
            }
        }
        if in_crowd && self.at.is_some() {
            let hint = "leave `at` out: a small crowd is at the position of the individual that it replaces";
            return Err(wrong(&format!("{path}.at"), "a small crowd has no position of its own", hint));
        }
        for (index, &point) in self.points.iter().flatten().enumerate() {
            place(&format!("{path}.points"), &index.to_string(), point)?;
        }
        self.at.map_or(Ok(()), |at| place(path, "at", at))
    }

    /// Checks that keys for one kind of formation are used with that kind.
    fn check_fit(&self, path: &str) -> Result<(), OptionError> {
        let is = |shapes: &[FormationShape]| self.shape.is_some_and(|shape| shapes.contains(&shape));
        let fits = [
            ("columns", self.columns.is_some(), is(&[FormationShape::Grid]), "a grid"),
            ("rings", self.rings.is_some(), is(&[FormationShape::Ring]), "a ring"),
            (
                "corners",
                self.corners.is_some(),
                is(&[FormationShape::Polygon, FormationShape::Star]),
                "a polygon or a star",
            ),
            ("inner", self.inner.is_some(), is(&[FormationShape::Star]), "a star"),
            ("angle_deg", self.angle_deg.is_some(), is(&[FormationShape::Wedge]), "a wedge"),
            ("height_m", self.height_m.is_some(), self.text.is_some(), "a text"),
            ("metres_per_pixel", self.metres_per_pixel.is_some(), self.file.is_some(), "a file"),
            (
                "radius_m",
                self.radius_m.is_some(),
                is(&[
                    FormationShape::Ring,
                    FormationShape::Disc,
                    FormationShape::Polygon,
                    FormationShape::Star,
                    FormationShape::Triangle,
                ]),
                "a ring, disc, polygon, star or triangle",
            ),
            (
                "filled",
                self.filled.is_some(),
                self.file.is_some() || is(&[FormationShape::Polygon, FormationShape::Star, FormationShape::Triangle]),
                "a file, a polygon, a star or a triangle",
            ),
            (
                "spacing_m",
                self.spacing_m.is_some(),
                self.points.is_none() && self.file.is_none() && !is(&[FormationShape::Example]),
                "a shape or a text",
            ),
        ];
        for (name, given, fit, kind) in fits {
            if given && !fit {
                return Err(wrong(&format!("{path}.{name}"), format!("`{name}` applies to {kind} only"), None));
            }
        }
        Ok(())
    }
}

fn place(path: &str, name: &str, at: Vec2) -> Result<(), OptionError> {
    let beyond = [at.x, at.y].into_iter().find(|number| !(-FARTHEST_M..=FARTHEST_M).contains(number));
    match beyond {
        Some(number) => {
            let problem = format!("{number} m is out of range, allowed is -{FARTHEST_M} to {FARTHEST_M}");
            Err(wrong(&format!("{path}.{name}"), problem, None))
        }
        None => Ok(()),
    }
}

/// Checks a list of individuals: its length, and that none is repeated.
fn members(key: &str, list: &[u32], least: usize) -> Result<(), OptionError> {
    if list.len() < least {
        return Err(wrong(key, format!("{} named, at least {least} are needed", list.len()), None));
    }
    let mut sorted = list.to_vec();
    sorted.sort_unstable();
    match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(wrong(key, format!("{} is named twice", pair[0]), None)),
        None => Ok(()),
    }
}
