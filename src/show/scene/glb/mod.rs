//! A scene as glTF 2.0 in one binary file (Khronos Group, "glTF 2.0 Specification", section 4.4).

mod document;
mod picture;
#[cfg(test)]
mod tests;
mod views;
mod write;

pub use write::write_glb;
