/// Why a text is no recording.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Refusal {
    /// There is nothing, or nothing but a header.
    Empty(&'static str),
    /// It is something else.
    Unknown { found: String, hint: String },
    /// A line makes no sense.
    Line { line: u64, problem: String, hint: String },
    /// `--columns` makes no sense.
    Columns(String),
}
