use proptest::prelude::*;

use super::*;

fn at(text: &str, t: f64) -> f64 {
    let variables = Variables { t, duration: 10.0, i: 3.0, c: 0.5, sd: 0.25 };
    Expression::parse(text).unwrap_or_else(|error| panic!("{error}")).value(&variables)
}

fn mistake(text: &str) -> (usize, Mistake) {
    let error = Expression::parse(text).expect_err(text);
    (error.column, error.mistake)
}

#[test]
fn arithmetic_is_what_it_is_everywhere() {
    for (text, value) in [
        ("2.0", 2.0),
        (" 1 + 2 * 3 ", 7.0),
        ("(1+2)*3", 9.0),
        ("2 - 3 - 4", -5.0),
        ("16/4/2", 2.0),
        ("-2^2", -4.0),
        ("2^3^2", 512.0),
        ("2^-1", 0.5),
        ("--2", 2.0),
        ("+.5e1", 5.0),
        ("7 % 5", 2.0),
        ("-1 % 5", 4.0),
        ("1e-3*2E3", 2.0),
        ("2*e", 2.0 * std::f64::consts::E),
        ("min(3, 1, 2) + max(1, 5)", 6.0),
        ("clamp(9, 0, 1) + clamp(-9, 0, 1) + clamp(0.5, 0, 1)", 1.5),
        ("sign(-3) + sign(0) + abs(-2) + floor(1.7) + ceil(1.2) + round(2.5)", -1.0 + 2.0 + 1.0 + 2.0 + 3.0),
        ("sqrt(2)^2", 2.0000000000000004),
        ("ln(exp(3))", 3.0),
        ("t*10 + duration + i + c + sd", 20.0 + 10.0 + 3.0 + 0.75),
    ] {
        assert_eq!(at(text, 2.0), value, "{text}");
    }
    for (text, value) in [("sin(2*pi*t/5)", 1.0), ("cos(tau*t)-tan(0)+asin(0)+acos(1)+atan(0)", 0.0)] {
        assert!((at(text, 1.25) - value).abs() < 1e-14, "{text}");
    }
    assert!((at("cosh(t)^2 - sinh(t)^2 + tanh(0)", 1.5) - 1.0).abs() < 1e-14);
}

#[test]
fn what_arithmetic_cannot_say_is_no_number() {
    assert!(at("1/(t-2)", 2.0).is_infinite());
    for text in ["sqrt(-1)", "0/0", "min(1, 0/0)", "max(0/0, 1)", "clamp(1, 3, 2)", "clamp(0/0, 1, 2)"] {
        assert!(at(text, 0.0).is_nan(), "{text}");
    }
}

#[test]
fn mistakes_are_shown_where_they_are() {
    let found = |found: &str| found.to_string();
    for (text, column, expected) in [
        ("", 1, Mistake::Empty),
        ("  ", 1, Mistake::Empty),
        ("2*", 3, Mistake::NoValue { found: found("the end of the expression") }),
        ("2*/3", 3, Mistake::NoValue { found: found("/") }),
        ("2t", 2, Mistake::NoOperator { found: found("t") }),
        ("2 3", 3, Mistake::NoOperator { found: found("3") }),
        ("sin(2*pi*t", 4, Mistake::NotClosed),
        ("(1+2)*(3", 7, Mistake::NotClosed),
        ("1)", 2, Mistake::NotOpened),
        ("1,2", 2, Mistake::Character { character: ',' }),
        ("(1,2)", 3, Mistake::Character { character: ',' }),
        ("2 * é", 5, Mistake::Character { character: 'é' }),
        ("1 + sinus(t)", 5, Mistake::Name { name: found("sinus") }),
        ("sin", 1, Mistake::NoArguments { name: "sin" }),
        ("sin()", 1, Mistake::Arguments { name: "sin", takes: "one argument", given: 0 }),
        ("1+clamp(1,2)", 3, Mistake::Arguments { name: "clamp", takes: "three arguments", given: 2 }),
        ("min(1)", 1, Mistake::Arguments { name: "min", takes: "two arguments or more", given: 1 }),
        ("t(2)", 1, Mistake::NotAFunction { name: found("t") }),
        ("1.2.3", 1, Mistake::Number { text: found("1.2.3") }),
        ("1e999", 1, Mistake::Number { text: found("1e999") }),
        (".", 1, Mistake::Number { text: found(".") }),
        ("2e", 2, Mistake::NoOperator { found: found("e") }),
    ] {
        assert_eq!(mistake(text), (column, expected), "{text}");
    }
}

#[test]
fn a_mistake_is_pointed_at_with_a_caret_and_a_hint() {
    let error = Expression::parse("2 * sinn(t)").unwrap_err();
    assert_eq!(error.to_string(), "sinn is not a known name\n  2 * sinn(t)\n      ^ column 5");
    assert_eq!(error.hint().unwrap(), "did you mean sin?");
    let unknown = Expression::parse("velocity").unwrap_err().hint().unwrap();
    assert!(unknown.starts_with("the known names are t duration i c sd pi tau e sin"), "{unknown}");
    let far = format!("{} + $", vec!["1"; 200].join("+"));
    let shown = Expression::parse(&far).unwrap_err().to_string();
    assert!(shown.lines().all(|line| line.chars().count() < 100), "{shown}");
    let lines: Vec<&str> = shown.lines().collect();
    assert_eq!(lines[1].chars().position(|c| c == '$'), lines[2].chars().position(|c| c == '^'), "{shown}");
}

#[test]
fn monstrous_expressions_are_refused() {
    let deep = |sign: &str| Expression::parse(&sign.repeat(240)).expect_err(sign).mistake;
    assert_eq!(deep("("), Mistake::TooDeep);
    assert_eq!(deep("-"), Mistake::TooDeep);
    assert_eq!(deep("2^"), Mistake::TooDeep);
    assert_eq!(deep("sin("), Mistake::TooDeep);
    assert_eq!(mistake(&"1+".repeat(100_000)).1, Mistake::TooLong);
    assert!(Expression::parse(&format!("{}1", "1+".repeat(499))).is_ok());
}

#[test]
fn constants_are_known_as_such() {}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn no_text_is_too_much(text in "\\PC{0,60}") {
        if let Err(error) = Expression::parse(&text) {
            prop_assert!(error.column <= text.chars().count() + 1);
            prop_assert!(error.to_string().contains('^'));
            let _ = error.hint();
        }
    }

    #[test]
    fn words_in_any_order_are_read_or_refused(
        words in prop::collection::vec(
            prop::sample::select(vec![
                "t", "i", "c", "sd", "pi", "2", ".5", "1e3", "+", "-", "*", "/", "%", "^", "(", ")", ",", " ", "sin",
                "min", "clamp", "abs(", "max(1,",
            ]),
            0..40,
        ),
    ) {
        let text = words.concat();
        if let Ok(expression) = Expression::parse(&text) {
            let variables = Variables { t: 1.5, duration: 3.0, i: 1.0, c: -2.0, sd: 1.0 };
            let value = expression.value(&variables);
            prop_assert_eq!(value.to_bits(), expression.value(&variables).to_bits());
            prop_assert_eq!(Expression::parse(&expression.to_string()).unwrap(), expression);
        }
    }
}
