//! Reads recordings of other programs, in any known format, as a [`Motion`].
//!
//! 1. `detect`: the layout of a text, from its beginning: `columns` knows names, `guess` handles unnamed numbers;
//! 2. `input`, `layout`, `number`: lines, fields, numbers; `rows`: persons' positions, from a text (`text_rows`), a
//!    `database`, or, if a file is not sorted by time, from `memory`;
//! 3. `census`: statistics of one pass over all rows; `scale`: the file's units in metres and seconds;
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
