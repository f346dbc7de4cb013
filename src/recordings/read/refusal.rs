/// Why a text is not a recording.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Refusal {
    /// The file is empty or has only a header.
    Empty(&'static str),
    /// The file has another format.
    Unknown { found: String, hint: String },
    /// A line cannot be parsed.
    Line { line: u64, problem: String, hint: String },
    /// The value of `--columns` is invalid.
    Columns(String),
}
