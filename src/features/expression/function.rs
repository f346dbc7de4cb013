use crate::math;

/// A function that expressions call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Sqrt,
    Abs,
    Sign,
    Floor,
    Ceil,
    Round,
    /// The least of this number of arguments.
    Min(usize),
    /// The largest of this number of arguments.
    Max(usize),
    Clamp,
}

/// A function with its name.
#[derive(Clone, Copy, Debug)]
pub(super) struct NamedFunction {
    pub(super) name: &'static str,
    function: Function,
}

const fn named(name: &'static str, function: Function) -> NamedFunction {
    NamedFunction { name, function }
}

/// All functions.
pub(super) const FUNCTIONS: [NamedFunction; 20] = [
    named("sin", Function::Sin),
    named("cos", Function::Cos),
    named("tan", Function::Tan),
    named("asin", Function::Asin),
    named("acos", Function::Acos),
    named("atan", Function::Atan),
    named("sinh", Function::Sinh),
    named("cosh", Function::Cosh),
    named("tanh", Function::Tanh),
    named("exp", Function::Exp),
    named("ln", Function::Ln),
    named("sqrt", Function::Sqrt),
    named("abs", Function::Abs),
    named("sign", Function::Sign),
    named("floor", Function::Floor),
    named("ceil", Function::Ceil),
    named("round", Function::Round),
    named("min", Function::Min(2)),
    named("max", Function::Max(2)),
    named("clamp", Function::Clamp),
];

impl NamedFunction {
    /// The function with this number of arguments; `None` if it takes another number.
    pub(super) fn with_arguments(self, arguments: usize) -> Option<Function> {
        match self.function {
            Function::Min(least) => (arguments >= least).then_some(Function::Min(arguments)),
            Function::Max(least) => (arguments >= least).then_some(Function::Max(arguments)),
            function => (arguments == function.arguments()).then_some(function),
        }
    }

    /// The number of arguments that it takes, as error messages say it.
    pub(super) fn takes(self) -> &'static str {
        match self.function {
            Function::Min(_) | Function::Max(_) => "two arguments or more",
            Function::Clamp => "three arguments",
            _ => "one argument",
        }
    }
}

impl Function {
    pub(super) fn arguments(self) -> usize {
        match self {
            Function::Min(count) | Function::Max(count) => count,
            Function::Clamp => 3,
            _ => 1,
        }
    }

    /// Evaluates the function; NaN for too few arguments.
    pub(super) fn of(self, arguments: &[f64]) -> f64 {
        let &[x, ..] = arguments else { return f64::NAN };
        match self {
            Function::Sin => math::sin_cos(x).0,
            Function::Cos => math::sin_cos(x).1,
            Function::Tan => libm::tan(x),
            Function::Asin => libm::asin(x),
            Function::Acos => libm::acos(x),
            Function::Atan => libm::atan(x),
            Function::Sinh => libm::sinh(x),
            Function::Cosh => libm::cosh(x),
            Function::Tanh => libm::tanh(x),
            Function::Exp => math::exp(x),
            Function::Ln => math::ln(x),
            Function::Sqrt => x.sqrt(),
            Function::Abs => x.abs(),
            Function::Sign if x == 0.0 => 0.0,
            Function::Sign => x.signum(),
            Function::Floor => x.floor(),
            Function::Ceil => x.ceil(),
            Function::Round => x.round(),
            // NaN is kept, so that it is reported.
            Function::Min(_) => arguments.iter().fold(x, |a, &b| if b.is_nan() || b < a { b } else { a }),
            Function::Max(_) => arguments.iter().fold(x, |a, &b| if b.is_nan() || b > a { b } else { a }),
            Function::Clamp => match *arguments {
                [_, low, high] if low > high => f64::NAN,
                [x, low, _] if x < low => low,
                [x, _, high] if x > high => high,
                [x, low, high] if low <= high => x,
                _ => f64::NAN,
            },
        }
    }
}
