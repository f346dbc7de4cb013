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
    /// The least of so many.
    Min(usize),
    /// The largest of so many.
    Max(usize),
    Clamp,
}

/// A function by its name, and how many arguments it takes: a number, or two and more.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    pub(super) name: &'static str,
    function: Function,
}

const fn known(name: &'static str, function: Function) -> Known {
    Known { name, function }
}

/// All functions.
pub(super) const FUNCTIONS: [Known; 20] = [
    known("sin", Function::Sin),
    known("cos", Function::Cos),
    known("tan", Function::Tan),
    known("asin", Function::Asin),
    known("acos", Function::Acos),
    known("atan", Function::Atan),
    known("sinh", Function::Sinh),
    known("cosh", Function::Cosh),
    known("tanh", Function::Tanh),
    known("exp", Function::Exp),
    known("ln", Function::Ln),
    known("sqrt", Function::Sqrt),
    known("abs", Function::Abs),
    known("sign", Function::Sign),
    known("floor", Function::Floor),
    known("ceil", Function::Ceil),
    known("round", Function::Round),
    known("min", Function::Min(2)),
    known("max", Function::Max(2)),
    known("clamp", Function::Clamp),
];

impl Known {
    /// The function for so many arguments, if it takes as many.
    pub(super) fn with(self, arguments: usize) -> Option<Function> {
        match self.function {
            Function::Min(least) => (arguments >= least).then_some(Function::Min(arguments)),
            Function::Max(least) => (arguments >= least).then_some(Function::Max(arguments)),
            function => (arguments == function.arguments()).then_some(function),
        }
    }

    /// How many it takes, for messages.
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

    /// Its value; of too few arguments NaN.
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
            // NaN is not passed over: it has to be reported.
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
