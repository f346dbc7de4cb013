use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use crate::options::{OptionError, Options, names, options};

/// Largest number of people.
const MOST_PEOPLE: f64 = 5e6;
/// Latest time, seconds.
const LATEST_S: f64 = 1e7;

options! {
    /// Timetable of arrivals, of the whole crowd or of one route. Times in seconds.
    pub struct Timetable {
        /// When people come: "rate" (evenly), "bursts" (a train every few minutes) or "list".
        kind: TimetableKind = TimetableKind::default();
        /// Of a rate and of bursts: when the first come.
        first_s: Option<f64> = None, in 0.0..=1e7, eg "30.0";
        /// Of a rate: people per second; left out: by entry_rate.
        per_second: Option<f64> = None, in 1e-4..=1e3, eg "0.5";
        /// Of bursts: from one to the next.
        every_s: Option<f64> = None, in 1.0..=1e7, eg "360.0";
        /// Of bursts: how many come in one.
        people: Option<u32> = None, in 1.0..=5e6, eg "120";
        /// Of bursts: or which share of all people comes in one.
        ///
        /// More people than an opening lets in meanwhile come in more bursts.
        share: Option<f64> = None, in 1e-6..=1.0, eg "0.25";
        /// Of bursts: how long the people of one take to come; 0: all at once.
        spread_s: Option<f64> = None, in 0.0..=1e7, eg "45.0";
        /// Of a list: times, each with how many come then.
        times: Vec<[f64; 2]> = Vec::new(), unit "s", eg "[[60, 20], [300, 80]]";
        /// Of a list: a CSV file of them, relative to this file.
        file: Option<PathBuf> = None, eg "\"arrivals.csv\"";
    } with {
        /// Rows of the file, once it has been read.
        of_file: Vec<[f64; 2]> = Vec::new();
    }
}

/// Kind of a timetable.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TimetableKind {
    /// A steady stream.
    #[default]
    Rate,
    /// Regular bursts, such as trains or school bells.
    Bursts,
    /// Given times.
    List,
}

names!(TimetableKind);

impl Timetable {
    /// Whether all values are the defaults.
    pub fn is_default(&self) -> bool {
        *self == Timetable::default()
    }

    /// Rows of a list, those of the file first.
    pub fn rows(&self) -> impl Iterator<Item = [f64; 2]> {
        self.of_file.iter().chain(&self.times).copied()
    }

    /// Total number of people in a list; `None` for other kinds.
    pub(crate) fn listed(&self) -> Option<u64> {
        (self.kind == TimetableKind::List).then(|| self.rows().map(|row| row[1] as u64).sum())
    }

    /// Checks every value.
    ///
    /// # Errors
    /// The first value that is not finite, out of its range, missing, or does not go with the kind.
    pub fn check(&self) -> Result<(), OptionError> {
        self.check_ranges()?;
        self.check_fit().map_err(|(key, problem)| OptionError::unfit(key, problem))
    }

    /// Checks what goes with the kind; an error holds the key and the problem.
    fn check_fit(&self) -> Result<(), (&'static str, String)> {
        use TimetableKind::{Bursts, List, Rate};
        let kinds = [
            ("first_s", self.first_s.is_some(), [Rate, Bursts]),
            ("per_second", self.per_second.is_some(), [Rate, Rate]),
            ("every_s", self.every_s.is_some(), [Bursts, Bursts]),
            ("people", self.people.is_some(), [Bursts, Bursts]),
            ("share", self.share.is_some(), [Bursts, Bursts]),
            ("spread_s", self.spread_s.is_some(), [Bursts, Bursts]),
        ];
        if let Some((key, ..)) = kinds.into_iter().find(|(_, given, kinds)| *given && !kinds.contains(&self.kind)) {
            return Err((key, format!("`{key}` does not go with the kind {}", self.kind.quoted())));
        }
        let has_list = !self.times.is_empty() || self.file.is_some();
        match self.kind {
            Bursts if self.every_s.is_none() => Err(("kind", "bursts need `every_s`: the time between them".into())),
            Bursts if self.people.is_some() == self.share.is_some() => {
                Err(("kind", "bursts need either `people` or `share`: how many come in one".into()))
            }
            List if !has_list => Err(("kind", "a list needs `times` or a `file`".into())),
            Rate | Bursts if has_list => {
                let key = if self.times.is_empty() { "file" } else { "times" };
                Err((key, format!("`{key}` does not go with the kind {}", self.kind.quoted())))
            }
            List => self.check_rows(),
            _ => Ok(()),
        }
    }

    fn check_rows(&self) -> Result<(), (&'static str, String)> {
        for [time_s, people] in self.rows() {
            if !(0.0..=LATEST_S).contains(&time_s) {
                return Err(("times", format!("the time {time_s} is not within 0 to {LATEST_S} seconds")));
            }
            let whole = (0.0..=MOST_PEOPLE).contains(&people) && people.fract() == 0.0;
            if !whole {
                return Err(("times", format!("{people} people are not a whole number of 0 to {MOST_PEOPLE}")));
            }
        }
        // A file that has not been read has no rows.
        let empty = self.listed() == Some(0) && !(self.file.is_some() && self.of_file.is_empty());
        if empty { Err(("times", "the list holds no people".into())) } else { Ok(()) }
    }

    /// Parses the rows of a CSV file: a time in seconds and a number of people, by default 1. Lines that begin with `#`
    /// and a first line of names are skipped.
    ///
    /// # Errors
    /// Returns the number of the first invalid line, from 1, and the problem. The line is not quoted: the file may be
    /// the wrong one.
    pub(crate) fn rows_of_csv(text: &str) -> Result<Vec<[f64; 2]>, (usize, &'static str)> {
        let mut rows = Vec::new();
        let mut may_be_names = true;
        for (index, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let cells: Vec<&str> = line.split([',', ';', '\t']).map(str::trim).collect();
            let numbers: Option<Vec<f64>> = cells.iter().map(|cell| cell.parse().ok()).collect();
            match numbers.as_deref() {
                Some(&[time_s]) => rows.push([time_s, 1.0]),
                Some(&[time_s, people]) => rows.push([time_s, people]),
                None if may_be_names && cells.len() <= 2 && cells.iter().all(|cell| is_name(cell)) => {}
                None => return Err((index + 1, "it is no time and number of people")),
                Some(_) => return Err((index + 1, "it has more than two columns, a time and a number of people")),
            }
            may_be_names = false;
        }
        Ok(rows)
    }

    /// Returns the arrival times of `count` people, seconds, ascending. `draw` gives a uniform number in `[0, 1)` per
    /// person index. A rate without `per_second` spreads them over `period_s`. Bursts by `share` have at most
    /// `most_in_burst` people: more people take longer, they do not stand denser.
    ///
    /// A list with more or fewer people than `count` is scaled in proportion.
    pub fn times_s(&self, count: usize, period_s: f64, most_in_burst: usize, draw: impl Fn(usize) -> f64) -> Vec<f64> {
        let first_s = self.first_s.unwrap_or(0.0);
        match self.kind {
            TimetableKind::Rate => {
                let part_s = self.per_second.map_or(period_s / count.max(1) as f64, |rate| 1.0 / rate);
                (0..count).map(|k| first_s + (k as f64 + draw(k)) * part_s).collect()
            }
            TimetableKind::Bursts => {
                let share = self.share.unwrap_or(1.0) * count as f64;
                let size =
                    self.people.map_or((share.ceil() as usize).min(most_in_burst), |people| people as usize).max(1);
                let (every_s, spread_s) = (self.every_s.unwrap_or(1.0), self.spread_s.unwrap_or(0.0));
                let time_s = |k: usize| {
                    let (burst, within) = (k / size, k % size);
                    let of_burst = size.min(count - burst * size);
                    first_s + burst as f64 * every_s + (within as f64 + draw(k)) / of_burst as f64 * spread_s
                };
                let mut times: Vec<f64> = (0..count).map(time_s).collect();
                // Long bursts overlap.
                times.sort_by(f64::total_cmp);
                times
            }
            TimetableKind::List => {
                let mut rows: Vec<[f64; 2]> = self.rows().collect();
                rows.sort_by(|a, b| a[0].total_cmp(&b[0]));
                let total: f64 = rows.iter().map(|row| row[1]).sum();
                let (mut row, mut before) = (0, 0.0);
                let time_s = |k: usize| {
                    let place = (k as f64 + 0.5) * total / count as f64;
                    while row + 1 < rows.len() && place >= before + rows[row][1] {
                        before += rows[row][1];
                        row += 1;
                    }
                    rows.get(row).map_or(0.0, |row| row[0])
                };
                (0..count).map(time_s).collect()
            }
        }
    }
}

/// Whether a cell can be a column name with a unit.
fn is_name(cell: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || " _-.()[]".contains(c);
    cell.starts_with(char::is_alphabetic) && cell.chars().all(is_part)
}

impl TimetableKind {
    fn quoted(self) -> &'static str {
        match self {
            TimetableKind::Rate => "\"rate\"",
            TimetableKind::Bursts => "\"bursts\"",
            TimetableKind::List => "\"list\"",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bursts_come_in_bursts() {
        let timetable = Timetable {
            kind: TimetableKind::Bursts,
            first_s: Some(30.0),
            every_s: Some(360.0),
            people: Some(40),
            spread_s: Some(20.0),
            ..Timetable::default()
        };
        timetable.check().unwrap();
        let times = timetable.times_s(100, 1.0, usize::MAX, |k| (k % 10) as f64 / 10.0);
        for burst in 0..3 {
            let from = 30.0 + 360.0 * f64::from(burst);
            let within = times.iter().filter(|t| (from..from + 20.0).contains(*t)).count();
            assert_eq!(within, if burst < 2 { 40 } else { 20 });
        }
        let by_share = Timetable { people: None, share: Some(0.25), ..timetable };
        by_share.check().unwrap();
        let times = by_share.times_s(100, 1.0, usize::MAX, |_| 0.5);
        assert_eq!(times.iter().filter(|t| **t < 100.0).count(), 25);
        let times = by_share.times_s(100, 1.0, 20, |_| 0.5);
        assert!((0..5).all(|burst| times[20 * burst] > 360.0 * burst as f64), "five bursts of 20: {times:?}");
    }

    #[test]
    fn lists_are_exact_and_keep_their_proportions() {
        let list = Timetable {
            kind: TimetableKind::List,
            times: vec![[300.0, 80.0], [60.0, 20.0], [90.0, 0.0]],
            ..Timetable::default()
        };
        list.check().unwrap();
        assert_eq!(list.listed(), Some(100));
        let times = list.times_s(100, 1.0, usize::MAX, |_| 0.9);
        assert!(times[..20].iter().all(|t| *t == 60.0) && times[20..].iter().all(|t| *t == 300.0));
        let tenth = list.times_s(10, 1.0, usize::MAX, |_| 0.0);
        assert_eq!(tenth.iter().filter(|t| **t == 60.0).count(), 2);
    }

    #[test]
    fn a_csv_file_holds_times_and_numbers_of_people() {
        let text = "\u{feff}time, people\n# a train\n60, 20\n\n300; 80\r\n400\n";
        assert_eq!(Timetable::rows_of_csv(text), Ok(vec![[60.0, 20.0], [300.0, 80.0], [400.0, 1.0]]));
        assert_eq!(Timetable::rows_of_csv("1,2\nx,3\n").unwrap_err().0, 2);
        assert_eq!(Timetable::rows_of_csv("1,2,3\n").unwrap_err().0, 1);
        assert_eq!(Timetable::rows_of_csv("time\npeople\n1,2\n").unwrap_err().0, 2);
    }

    #[test]
    fn what_does_not_go_together_is_refused() {
        let rate = Timetable::default();
        let bursts =
            Timetable { kind: TimetableKind::Bursts, every_s: Some(60.0), people: Some(5), ..Timetable::default() };
        for (wrong, key) in [
            (Timetable { every_s: Some(60.0), ..rate.clone() }, "every_s"),
            (Timetable { times: vec![[1.0, 1.0]], ..rate.clone() }, "times"),
            (Timetable { per_second: Some(f64::NAN), ..rate.clone() }, "per_second"),
            (Timetable { every_s: None, ..bursts.clone() }, "kind"),
            (Timetable { share: Some(0.5), ..bursts.clone() }, "kind"),
            (Timetable { people: None, ..bursts.clone() }, "kind"),
            (Timetable { people: Some(0), ..bursts.clone() }, "people"),
            (Timetable { spread_s: Some(-1.0), ..bursts }, "spread_s"),
            (Timetable { kind: TimetableKind::List, ..rate.clone() }, "kind"),
            (Timetable { kind: TimetableKind::List, times: vec![[f64::NAN, 1.0]], ..rate.clone() }, "times"),
            (Timetable { kind: TimetableKind::List, times: vec![[1.0, 1.5]], ..rate.clone() }, "times"),
            (Timetable { kind: TimetableKind::List, times: vec![[1.0, 0.0]], ..rate }, "times"),
        ] {
            assert_eq!(wrong.check().unwrap_err().key(), key, "{wrong:?}");
        }
    }
}
