//! Writes an imported pattern into a folder: its image, and its entry in `patterns.toml`.

use std::fs;
use std::io::Cursor;
use std::ops::Range;
use std::path::{Path, PathBuf};

use image::ImageFormat;
use serde::Deserialize;
use toml::Spanned;

use super::{ImportError, ImportedPattern};
use crate::files::WholeFile;
use crate::patterns::folder::listing_text;
use crate::patterns::listing::{self, LISTING};
use crate::patterns::{Cause, Form, PatternsError};

/// Limit on the length of a pattern's name, characters.
const LONGEST_NAME: usize = 60;

/// The entry of an imported pattern in `patterns.toml`.
#[derive(Clone, Debug)]
pub struct ImportEntry {
    /// Name of the image without extension: letters, digits, `-` and `_`.
    pub name: String,
    /// Share among the patterns of its cause, above 0; `None` for the mean of the others, or the share of a replaced
    /// entry.
    pub share: Option<f64>,
    /// Description in words.
    pub description: String,
    /// Whether to replace a pattern of this name. Its entry keeps its place, comments and description.
    pub force: bool,
}

/// Files and share written by [`ImportedPattern::save`].
#[derive(Clone, Debug)]
pub struct SavedPattern {
    /// Path of the image.
    pub image: PathBuf,
    /// Path of the listing.
    pub listing: PathBuf,
    /// Share in the listing.
    pub share: f64,
    /// Number of patterns of the cause in the listing.
    pub of_cause: usize,
}

/// Derives a pattern's name from a photograph's: `IMG 2031.jpeg` becomes `img_2031`.
pub fn name_of_photo(photo: &Path) -> String {
    let stem = photo.file_stem().map(|stem| stem.to_string_lossy().to_lowercase()).unwrap_or_default();
    let name: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' }).collect();
    let name: String = name.trim_matches('_').chars().take(LONGEST_NAME).collect();
    if name.is_empty() { "stain".to_owned() } else { name }
}

impl ImportedPattern {
    /// Writes the image into a folder and adds it to the folder's `patterns.toml`.
    ///
    /// Creates both if missing. The rest of the listing, with its comments, stays unchanged.
    ///
    /// # Errors
    /// The name is invalid, or already listed and `force` is not set; the share is out of range; the `patterns.toml`
    /// is invalid; a file cannot be written.
    pub fn save(&self, folder: &Path, entry: &ImportEntry) -> Result<SavedPattern, PatternsError> {
        check_name(&entry.name)?;
        if let Some(share) = entry.share.filter(|share| !(*share > 0.0 && *share <= 1e6)) {
            return Err(ImportError::Share { share }.into());
        }
        fs::create_dir_all(folder).map_err(|source| ImportError::Folder { folder: folder.to_owned(), source })?;
        let file = folder.join(LISTING);
        let is_new = !file.exists();
        let text = if is_new { NEW_LISTING.to_owned() } else { listing_text(folder)? };
        let (text, share) = self.listed(text, is_new, &file, entry)?;
        let entries = listing::parse(&text, &file)?;

        let mut png = Cursor::new(Vec::new());
        self.coverage
            .write_to(&mut png, ImageFormat::Png)
            .map_err(|error| ImportError::Unreadable { reason: error.to_string() })?;
        // Both files are complete before either gets its name.
        let image_path = folder.join(format!("{}.png", entry.name));
        let image = written(&image_path, png.get_ref(), entry.force)?;
        let list = written(&file, text.as_bytes(), !is_new)?;
        image.publish().map_err(ImportError::from)?;
        list.publish().map_err(ImportError::from)?;
        let of_cause = entries.iter().filter(|entry| entry.cause == self.cause).count();
        Ok(SavedPattern { image: image_path, listing: file, share, of_cause })
    }

    /// Returns the text of the listing with this pattern in it, and its share.
    fn listed(
        &self,
        text: String,
        is_new: bool,
        file: &Path,
        entry: &ImportEntry,
    ) -> Result<(String, f64), PatternsError> {
        let image = format!("{}.png", entry.name);
        if is_new {
            let share = entry.share.unwrap_or(1.0);
            return Ok((text + &self.table(&image, share, &entry.description), share));
        }
        // A listing without patterns is extended like a missing one.
        let raw: KeptListing = toml::from_str(&text).unwrap_or_default();
        if !raw.pattern.is_empty() {
            listing::parse(&text, file)?;
        }
        if let Some(there) = raw.pattern.iter().find(|there| there.file.get_ref() == &image) {
            if !entry.force {
                return Err(ImportError::IsListed { file: file.to_owned(), image }.into());
            }
            let share = entry.share.unwrap_or(*there.share.get_ref());
            return Ok((self.replaced(text, there, share), share));
        }
        let shares = raw.pattern.iter().filter(|there| *there.cause.get_ref() == self.cause);
        let shares: Vec<f64> = shares.map(|there| *there.share.get_ref()).collect();
        let mean = if shares.is_empty() { 1.0 } else { shares.iter().sum::<f64>() / shares.len() as f64 };
        // Four digits, as a person would write.
        let share = entry.share.unwrap_or((mean * 1e4).round().max(1.0) / 1e4);
        let gap = if text.is_empty() || text.ends_with("\n\n") {
            ""
        } else if text.ends_with('\n') {
            "\n"
        } else {
            "\n\n"
        };
        Ok((format!("{text}{gap}{}", self.table(&image, share, &entry.description)), share))
    }

    fn table(&self, image: &str, share: f64, description: &str) -> String {
        let form = self.form.map_or(String::new(), |form| format!("form = \"{}\"\n", form.name()));
        let described = match description {
            "" => String::new(),
            text => format!("description = {}\n", toml::Value::String(text.to_owned())),
        };
        format!(
            "[[pattern]]\nfile = \"{image}\"\ncause = \"{}\"\n{form}length_cm = {:.1}\nshare = {share:?}\n{described}",
            self.cause.name(),
            self.length_cm(),
        )
    }

    /// Replaces the values of an entry in the text.
    fn replaced(&self, text: String, there: &KeptEntry, share: f64) -> String {
        let mut edits: Vec<(Range<usize>, String)> = vec![
            (there.cause.span(), format!("\"{}\"", self.cause.name())),
            (there.length_cm.span(), format!("{:.1}", self.length_cm())),
            (there.share.span(), format!("{share:?}")),
        ];
        match (&there.form, self.form) {
            (Some(old), Some(form)) => edits.push((old.span(), format!("\"{}\"", form.name()))),
            (Some(old), None) if old.get_ref().cause() != self.cause => {
                edits.push((line_of(&text, &old.span()), String::new()))
            }
            (None, Some(form)) => {
                let end = there.cause.span().end;
                edits.push((end..end, format!("\nform = \"{}\"", form.name())));
            }
            _ => {}
        }
        // From the back, so that earlier spans stay valid.
        edits.sort_by_key(|(span, _)| std::cmp::Reverse((span.start, span.end)));
        let mut text = text;
        for (span, value) in edits {
            text.replace_range(span, &value);
        }
        text
    }
}

/// Byte range of the line that holds a value.
fn line_of(text: &str, span: &Range<usize>) -> Range<usize> {
    let start = text[..span.start].rfind('\n').map_or(0, |newline| newline + 1);
    let end = text[span.end..].find('\n').map_or(text.len(), |newline| span.end + newline + 1);
    start..end
}

fn check_name(name: &str) -> Result<(), ImportError> {
    let is_fit = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    match !name.is_empty() && name.len() <= LONGEST_NAME && name.chars().all(is_fit) {
        true => Ok(()),
        false => Err(ImportError::Name { name: name.to_owned() }),
    }
}

/// Writes a complete file that does not have its name yet.
fn written(path: &Path, bytes: &[u8], force: bool) -> Result<WholeFile, ImportError> {
    let file = WholeFile::begin(path, force)?;
    file.write(bytes)?;
    Ok(file)
}

/// Start of a listing created by an import.
const NEW_LISTING: &str = "\
# Patterns: images of single stains, white where they leave soil, 10 px/cm. `trodden patterns` with this folder checks and
# draws them; [patterns] folder in a scenario uses them. Causes that are not listed here are those of the built-in library.

";

#[derive(Default, Deserialize)]
struct KeptListing {
    #[serde(default)]
    pattern: Vec<KeptEntry>,
}

#[derive(Deserialize)]
struct KeptEntry {
    file: Spanned<String>,
    cause: Spanned<Cause>,
    form: Option<Spanned<Form>>,
    length_cm: Spanned<f64>,
    share: Spanned<f64>,
}
