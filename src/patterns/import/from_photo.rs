//! The steps of an import in their order.

use super::{ImportError, ImportOptions, ImportedPattern, cut, density, photo, stain, surface};

impl ImportedPattern {
    /// Extracts the stain of a photograph, given as the bytes of its file.
    ///
    /// # Errors
    /// The file is not an image or is too large; the crop exceeds it; a scale or an angle is out of range; the
    /// photograph shows no stain or too little wall around it; the stain is too small or too large for its cause.
    pub fn from_photo(bytes: &[u8], options: &ImportOptions) -> Result<ImportedPattern, ImportError> {
        options.check()?;
        let photo = photo::read(bytes, options)?;
        let surface = surface::fit(&photo)?;
        let found = stain::find(&surface.smooth, surface.noise)?;
        let density = density::of(&photo, &surface, &found);
        cut::cut_out(photo, &density, &found, &surface, options)
    }
}
