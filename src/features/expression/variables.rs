//! The variables and constants that an expression may name.

/// The values that an expression's variables take.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Variables {
    /// `t`: seconds since the start.
    pub t: f64,
    /// `duration`: seconds from the start to the end.
    pub duration: f64,
    /// `i`: the component's number, from 1 on.
    pub i: f64,
    /// `c`: the component's coefficient at that moment, metres.
    pub c: f64,
    /// `sd`: the standard deviation of the component's coefficient over time, metres.
    pub sd: f64,
}

/// The name of one of the [`Variables`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Variable {
    T,
    Duration,
    I,
    C,
    Sd,
}

impl Variable {
    pub(super) const ALL: [(&str, Variable); 5] = [
        ("t", Variable::T),
        ("duration", Variable::Duration),
        ("i", Variable::I),
        ("c", Variable::C),
        ("sd", Variable::Sd),
    ];

    pub(super) fn of(self, variables: &Variables) -> f64 {
        match self {
            Variable::T => variables.t,
            Variable::Duration => variables.duration,
            Variable::I => variables.i,
            Variable::C => variables.c,
            Variable::Sd => variables.sd,
        }
    }
}

/// The constants by name.
pub(super) const CONSTANTS: [(&str, f64); 3] =
    [("pi", std::f64::consts::PI), ("tau", std::f64::consts::TAU), ("e", std::f64::consts::E)];
