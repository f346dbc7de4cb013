//! Reads what others recorded or simulated: whatever the format, out comes a [`Motion`].
//!
//! 1. `detect`: how a text is laid out, by its beginning: `columns` knows names, `guess` numbers without names;
//! 2. `input`, `layout`, `number`: lines, fields, numbers; `rows`: a person's positions, from a text (`text_rows`), a
//!    `database`, or, if a file is not in the order of time, from `memory`;
//! 3. `census`: one pass over all rows, which finds what there is; `scale`: what its numbers mean in metres and seconds;
//! 4. `weave`: frames.

mod census;
mod columns;
mod content;
mod database;
mod detect;
mod error;
mod format;
mod guess;
mod histogram;
mod input;
mod layout;
mod memory;
mod number;
mod open;
mod options;
mod recording;
mod refusal;
mod row;
mod rows;
mod scale;
mod survey;
mod text_rows;
mod unit;
mod weave;

pub use error::RecordingError;
pub use format::RecordingFormat;
pub use options::RecordingOptions;
pub use recording::Recording;
pub use survey::Survey;
pub use unit::LengthUnit;
