//! The free view: `index.html`, one file that opens from disk and shows the baked plan in 3D, without network.
//!
//! The page carries the scene's triangles, the textures reduced, and a coarse map of distances and light. It mixes the
//! dirt itself, by the look's law, so that a reader can take causes away or have more of them.

mod content;
mod document;
mod field;
mod geometry;
mod images;
mod lamps;
mod light;

pub use content::{DirtKind, Page, PageOptions, PageSurface, Viewpoint};
pub use document::{PAGE_FILE, page_html, write_page};
