//! Options of all stages: each is declared once, with its type, default, range, unit and explanation.
//!
//! `options!` makes the struct and its fields. From these come the reader of scenarios, the checks of ranges, the
//! explained scenario file and its JSON Schema.

mod declare;
mod error;
mod explain;
mod field;
mod read;
mod schema;
mod values;

pub(crate) use declare::options;
pub use error::OptionError;
pub(crate) use explain::{Explanation, nearest};
pub use field::Limits;
pub(crate) use field::{Field, Kind, Table, key};
pub(crate) use read::{Mistake, Problem, Spot, value_at};
pub(crate) use schema::schema_of;
pub(crate) use values::{Leaf, Options, Value, check_parts, kept, names, names_of, parse, read_parts, write_parts};
