//! The free view: `index.html`, one file that opens from disk and shows the baked plan in 3D, without network.
//!
//! The page carries the scene's triangles, the textures reduced, and a coarse map of distances and light. It mixes the
//! dirt itself, by the look's law, so that a reader can take causes away or have more of them.

mod content;
pub(super) mod document;
mod field;
mod geometry;
mod images;
mod light_grid;

pub use content::{DirtKind, Page, PageOptions, PageSurface};
pub use document::page_html;
pub(crate) use document::write_page;
