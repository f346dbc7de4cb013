use super::component_range::{ComponentRange, ComponentsError};
use super::error::FeaturesError;
use super::expression::{Expression, Variables};

/// The largest coefficient that a modulation may make, metres.
const MOST_COEFFICIENT_M: f64 = 1e6;

/// The change of a coefficient.
#[derive(Clone, Debug, PartialEq)]
pub enum CoefficientChange {
    /// Multiplies it by the expression's value.
    Scale(Expression),
    /// Replaces it by the expression's value, metres.
    Set(Expression),
}

/// A change of some components' coefficients.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// The components.
    pub which: ComponentRange,
    /// The change of their coefficients.
    pub change: CoefficientChange,
}

/// The changes of a motion's coefficients.
///
/// If several rules name a component, the last one counts; components without a rule keep their coefficients.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Modulation {
    /// The rules, in order.
    pub rules: Vec<Rule>,
}

impl Rule {
    /// Parses `COMPONENTS=FACTOR`, as `1=2.0`, `2..5=sin(2*pi*t/5)` or `all=2`.
    ///
    /// # Errors
    /// [`FeaturesError::Which`], [`FeaturesError::Expression`].
    pub fn scale(text: &str) -> Result<Rule, FeaturesError> {
        let (which, expression) = parse_rule(text)?;
        Ok(Rule { which, change: CoefficientChange::Scale(expression) })
    }

    /// Parses `COMPONENTS=METRES`, as `1=sd*sqrt(2)*sin(2*pi*t/5)`.
    ///
    /// # Errors
    /// [`FeaturesError::Which`], [`FeaturesError::Expression`].
    pub fn set(text: &str) -> Result<Rule, FeaturesError> {
        let (which, expression) = parse_rule(text)?;
        Ok(Rule { which, change: CoefficientChange::Set(expression) })
    }
}

fn parse_rule(text: &str) -> Result<(ComponentRange, Expression), FeaturesError> {
    let (which, expression) =
        text.split_once('=').ok_or_else(|| ComponentsError::NoEquals { text: text.to_string() })?;
    Ok((which.parse()?, Expression::parse(expression)?))
}

/// A selected component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SelectedComponent {
    /// Its number among the selected ones, from 1, as rules count.
    pub(super) number: usize,
    /// Its index among its own crowd's components, from 0.
    pub(super) own: usize,
}

/// Checks a number of components against the number of those that exist.
pub(super) fn check_components(asked: usize, most: usize) -> Result<(), FeaturesError> {
    if (1..=most).contains(&asked) { Ok(()) } else { Err(FeaturesError::Components { asked, most }) }
}

impl Modulation {
    /// Makes a modulation of one rule.
    pub fn of(rule: Rule) -> Modulation {
        Modulation { rules: vec![rule] }
    }

    /// Checks that the components of all rules exist.
    pub(super) fn check(&self, components: usize) -> Result<(), FeaturesError> {
        self.rules.iter().try_for_each(|rule| check_components(rule.which.largest(), components))
    }

    /// Changes the coefficients of a component, numbered from 1; one per frame.
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
                CoefficientChange::Scale(expression) => {
                    (expression, *coefficient * expression.value_with(&variables, &mut stack))
                }
                CoefficientChange::Set(expression) => (expression, expression.value_with(&variables, &mut stack)),
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
    fn mistakes_in_rules_are_explained() {
        let what = |text: &str| Rule::scale(text).unwrap_err().to_string();
        assert!(what("2.0").contains("no ="), "{}", what("2.0"));
        assert!(what("x=2").contains("is not a range of components"));
        assert!(what("5..2=1").contains("ends before it starts"));
        assert!(what("1=sin(").contains("column 5"), "{}", what("1=sin("));
        assert!(what("0=1").contains("numbered from 1"));
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
    fn a_coefficient_out_of_range_is_reported_with_its_time() {
        let mut coefficients = [1.0; 10];
        let rule = Rule::scale("all=1/(t-2)").unwrap();
        let error = Modulation::of(rule).apply(3, &mut coefficients, 2.0).unwrap_err().to_string();
        assert!(error.contains("component 3") && error.contains("inf") && error.contains("t = 2.000 s"), "{error}");
        for text in ["all=sqrt(-1)", "all=1e7", "all=0/0"] {
            assert!(Modulation::of(Rule::scale(text).unwrap()).apply(1, &mut [1.0], 1.0).is_err(), "{text}");
        }
    }
}
