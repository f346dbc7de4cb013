use std::fmt;
use std::str::FromStr;

use super::FeaturesError;
use super::decomposition::check_components;
use super::expression::{Expression, Variables};

/// The largest coefficient that a modulation may make, metres.
const MOST_COEFFICIENT_M: f64 = 1e6;

/// Which components a rule is about, from 1 on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComponentRange {
    /// All of them.
    All,
    /// From the first to the last number, both included.
    Numbers(usize, usize),
    /// From a number on.
    From(usize),
}

/// What becomes of a coefficient.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// It is multiplied.
    Scale(Expression),
    /// It is replaced, metres.
    Set(Expression),
}

/// What becomes of some components' coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// Which components.
    pub which: ComponentRange,
    /// What becomes of them.
    pub change: Change,
}

/// How a motion's coefficients are changed: of the rules that name a component the last one counts, and a component that
/// none names stays as it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Modulation {
    /// The rules in their order.
    pub rules: Vec<Rule>,
}

/// Why a text names no components.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ComponentsError {
    /// No `=`.
    #[error("{text:?} has no = between components and expression")]
    NoEquals {
        /// The text.
        text: String,
    },
    /// Not a number or a range.
    #[error("{text:?} names no components")]
    NotARange {
        /// The text.
        text: String,
    },
    /// A range that begins after its end.
    #[error("{text:?} runs backwards")]
    Backwards {
        /// The text.
        text: String,
    },
    /// Component 0.
    #[error("{text:?}: components are numbered from 1 on")]
    Zero {
        /// The text.
        text: String,
    },
}

impl ComponentsError {
    /// What the user can do about it.
    pub fn hint(&self) -> Option<String> {
        Some("write 1=2.0, 2..5=sin(2*pi*t/5), 3..=0 or all=2.0; a range includes both its ends".to_string())
    }
}

impl FromStr for ComponentRange {
    type Err = ComponentsError;

    /// Reads `all`, `3`, `2..5` (both included) or `2..`.
    fn from_str(text: &str) -> Result<ComponentRange, ComponentsError> {
        let text = text.trim();
        let owned = || text.to_string();
        let number = |part: &str| -> Result<usize, ComponentsError> {
            let digits = part.trim();
            let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
            match digits.parse() {
                Ok(0) => Err(ComponentsError::Zero { text: owned() }),
                Ok(number) if is_number => Ok(number),
                _ => Err(ComponentsError::NotARange { text: owned() }),
            }
        };
        if text.eq_ignore_ascii_case("all") {
            return Ok(ComponentRange::All);
        }
        match text.split_once("..") {
            None => number(text).map(|only| ComponentRange::Numbers(only, only)),
            Some((first, "")) => number(first).map(ComponentRange::From),
            Some((first, last)) => match (number(first)?, number(last)?) {
                (first, last) if first <= last => Ok(ComponentRange::Numbers(first, last)),
                _ => Err(ComponentsError::Backwards { text: owned() }),
            },
        }
    }
}

impl fmt::Display for ComponentRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ComponentRange::All => f.write_str("all"),
            ComponentRange::Numbers(first, last) if first == last => write!(f, "{first}"),
            ComponentRange::Numbers(first, last) => write!(f, "{first}..{last}"),
            ComponentRange::From(first) => write!(f, "{first}.."),
        }
    }
}

impl ComponentRange {
    /// Whether a component, from 1 on, is one of them.
    pub fn contains(&self, number: usize) -> bool {
        match *self {
            ComponentRange::All => true,
            ComponentRange::Numbers(first, last) => number >= first && number <= last,
            ComponentRange::From(first) => number >= first,
        }
    }

    /// The largest number that it speaks of.
    fn largest(&self) -> usize {
        match *self {
            ComponentRange::All => 1,
            ComponentRange::Numbers(_, last) => last,
            ComponentRange::From(first) => first,
        }
    }
}

impl Rule {
    /// Reads `COMPONENTS=FACTOR`, as `1=2.0`, `2..5=sin(2*pi*t/5)` or `all=2`.
    ///
    /// # Errors
    /// Text that names no components or has no expression.
    pub fn scale(text: &str) -> Result<Rule, FeaturesError> {
        let (which, expression) = parts(text)?;
        Ok(Rule { which, change: Change::Scale(expression) })
    }

    /// Reads `COMPONENTS=METRES`, as `1=sd*sqrt(2)*sin(2*pi*t/5)`.
    ///
    /// # Errors
    /// Text that names no components or has no expression.
    pub fn set(text: &str) -> Result<Rule, FeaturesError> {
        let (which, expression) = parts(text)?;
        Ok(Rule { which, change: Change::Set(expression) })
    }
}

fn parts(text: &str) -> Result<(ComponentRange, Expression), FeaturesError> {
    let (which, expression) =
        text.split_once('=').ok_or_else(|| ComponentsError::NoEquals { text: text.to_string() })?;
    Ok((which.parse()?, Expression::parse(expression)?))
}

/// A component that is chosen: its number among the chosen, from 1 on, which rules speak of, and its place among its own
/// crowd's, from 0 on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Chosen {
    pub(super) number: usize,
    pub(super) own: usize,
}

impl Modulation {
    /// A modulation of one rule.
    pub fn of(rule: Rule) -> Modulation {
        Modulation { rules: vec![rule] }
    }

    /// Whether all rules speak of components that there are.
    pub(super) fn check(&self, components: usize) -> Result<(), FeaturesError> {
        self.rules.iter().try_for_each(|rule| check_components(rule.which.largest(), components))
    }

    /// Changes the coefficients of a component, from 1 on, in the order of time.
    pub(super) fn apply(&self, number: usize, coefficients_m: &mut [f64], fps: f64) -> Result<(), FeaturesError> {
        let Some(rule) = self.rules.iter().rfind(|rule| rule.which.contains(number)) else { return Ok(()) };
        let count = coefficients_m.len();
        let variance = coefficients_m.iter().map(|c| c * c).sum::<f64>() / count.max(1) as f64;
        let duration = count.saturating_sub(1) as f64 / fps;
        let mut variables = Variables { t: 0.0, duration, i: number as f64, c: 0.0, sd: variance.sqrt() };
        let mut stack = Vec::new();
        for (moment, coefficient) in coefficients_m.iter_mut().enumerate() {
            variables.t = moment as f64 / fps;
            variables.c = *coefficient;
            let (expression, value) = match &rule.change {
                Change::Scale(expression) => (expression, *coefficient * expression.value_with(&variables, &mut stack)),
                Change::Set(expression) => (expression, expression.value_with(&variables, &mut stack)),
            };
            // Written so that NaN is out of range.
            let allowed = value.abs() <= MOST_COEFFICIENT_M;
            if !allowed {
                let (expression, t_s) = (Box::new(expression.clone()), variables.t);
                let most_m = MOST_COEFFICIENT_M;
                return Err(FeaturesError::Coefficient { expression, component: number, t_s, value, most_m });
            }
            *coefficient = value;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_read_and_written() {
        for (text, range) in [
            ("all", ComponentRange::All),
            ("3", ComponentRange::Numbers(3, 3)),
            ("2..5", ComponentRange::Numbers(2, 5)),
            ("4..", ComponentRange::From(4)),
        ] {
            assert_eq!(text.parse(), Ok(range));
            assert_eq!(range.to_string(), text);
        }
        for text in ["", "0", "0..3", "x", "-1", "+1", "5..2", "..4", "1..x", "1...3", "99999999999999999999999"] {
            assert!(text.parse::<ComponentRange>().is_err(), "{text}");
        }
    }

    #[test]
    fn rules_without_sense_say_so() {
        let what = |text: &str| Rule::scale(text).unwrap_err().to_string();
        assert!(what("2.0").contains("no ="), "{}", what("2.0"));
        assert!(what("x=2").contains("names no components"));
        assert!(what("5..2=1").contains("backwards"));
        assert!(what("1=sin(").contains("column 5"), "{}", what("1=sin("));
        assert!(what("0=1").contains("from 1 on"));
        assert!(Rule::scale("x=2").unwrap_err().hint().is_some());
        assert!(Rule::set("all = sd * sin(t)").is_ok());
    }

    #[test]
    fn the_last_rule_that_names_a_component_counts() {
        let rules = ["all=2", "2..3=10", "3=0"].map(|text| Rule::scale(text).unwrap()).to_vec();
        let modulation = Modulation { rules };
        let changed = |number| {
            let mut coefficients = [1.0, -1.0];
            modulation.apply(number, &mut coefficients, 1.0).unwrap();
            coefficients
        };
        assert_eq!([1, 2, 3, 4].map(changed), [[2.0, -2.0], [10.0, -10.0], [0.0, 0.0], [2.0, -2.0]]);
        assert!(modulation.check(2).is_err());
        assert!(modulation.check(3).is_ok());
    }

    #[test]
    fn expressions_know_time_number_and_coefficient() {
        let mut coefficients = [1.0, 3.0, -1.0, -3.0];
        Modulation::of(Rule::set("all=c + 100*t + 1000*i + 10000*duration + 1e5*round(sd*sd)").unwrap())
            .apply(2, &mut coefficients, 2.0)
            .unwrap();
        assert_eq!(
            coefficients,
            [0.0, 50.0, 100.0, 150.0]
                .map(|t| t + 2000.0 + 15000.0 + 5e5)
                .iter()
                .zip([1.0, 3.0, -1.0, -3.0])
                .map(|(a, b)| a + b)
                .collect::<Vec<_>>()[..]
        );
    }

    #[test]
    fn what_is_no_number_is_refused_with_its_moment() {
        let mut coefficients = [1.0; 10];
        let rule = Rule::scale("all=1/(t-2)").unwrap();
        let error = Modulation::of(rule).apply(3, &mut coefficients, 2.0).unwrap_err().to_string();
        assert!(error.contains("component 3") && error.contains("inf") && error.contains("t = 2.000 s"), "{error}");
        for text in ["all=sqrt(-1)", "all=1e7", "all=0/0"] {
            assert!(Modulation::of(Rule::scale(text).unwrap()).apply(1, &mut [1.0], 1.0).is_err(), "{text}");
        }
    }
}
