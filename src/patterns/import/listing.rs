//! Writes an imported pattern into a folder: its image, and its entry in `patterns.toml`.

use std::fs;
use std::io::Cursor;
use std::ops::Range;
use std::path::{Path, PathBuf};

use image::ImageFormat;
use serde::Deserialize;
use toml::Spanned;

use super::super::folder::{LISTING, listing_text};
use super::super::{Cause, Form, PatternsError, listing};
use super::{Import, ImportError};
use crate::files::WholeFile;

/// Longest name of a pattern.
const LONGEST_NAME: usize = 60;

/// How an imported pattern is to be listed.
#[derive(Clone, Debug)]
pub struct ImportEntry {
    /// Name of its image without ending: letters, digits, `-` and `_`.
    pub name: String,
    /// How often it occurs among those of its cause; `None` is as often as the others on average, or as it was.
    pub share: Option<f64>,
    /// What it is, in words.
    pub description: String,
    /// Whether a pattern of this name is replaced. Its entry keeps its place, its comments and its description.
    pub force: bool,
}

/// What was written.
#[derive(Clone, Debug)]
pub struct Listed {
    /// The image.
    pub image: PathBuf,
    /// The list.
    pub listing: PathBuf,
    /// The share that was written.
    pub share: f64,
    /// How many patterns of the cause the folder lists now.
    pub of_cause: usize,
}

/// A pattern's name made of that of a photograph: `IMG 2031.jpeg` becomes `img_2031`.
pub fn name_of_photo(photo: &Path) -> String {
    let stem = photo.file_stem().map(|stem| stem.to_string_lossy().to_lowercase()).unwrap_or_default();
    let name: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' }).collect();
    let name: String = name.trim_matches('_').chars().take(LONGEST_NAME).collect();
    if name.is_empty() { "stain".to_owned() } else { name }
}

impl Import {
    /// Writes the image and lists it; makes the folder and its `patterns.toml` if there are none. What the list says
    /// otherwise stays as it is, comments and all.
    ///
    /// # Errors
    /// A name that is none, or that the folder has already, unless `force` is set; a share out of range; a
    /// `patterns.toml` that is wrong; no right to write.
    pub fn save(&self, folder: &Path, entry: &ImportEntry) -> Result<Listed, PatternsError> {
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
        // Both are ready before either appears.
        let image_path = folder.join(format!("{}.png", entry.name));
        let image = written(&image_path, png.get_ref(), entry.force)?;
        let list = written(&file, text.as_bytes(), !is_new)?;
        image.publish().map_err(ImportError::from)?;
        list.publish().map_err(ImportError::from)?;
        let of_cause = entries.iter().filter(|entry| entry.cause == self.cause).count();
        Ok(Listed { image: image_path, listing: file, share, of_cause })
    }

    /// The text of the listing with this pattern in it, and its share.
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
        // A list that lists nothing yet, as an editor leaves it, is as good as none.
        let raw: RawListing = toml::from_str(&text).unwrap_or_default();
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
        // What is written is read again: no more digits than a person would write.
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

    /// The entry's values changed where they stand.
    fn replaced(&self, text: String, there: &RawEntry, share: f64) -> String {
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
        // From the back, so that what comes before stays where it is.
        edits.sort_by_key(|(span, _)| std::cmp::Reverse((span.start, span.end)));
        let mut text = text;
        for (span, value) in edits {
            text.replace_range(span, &value);
        }
        text
    }
}

/// The whole line in which a value stands.
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

/// A file that is complete but does not have its name yet.
fn written(path: &Path, bytes: &[u8], force: bool) -> Result<WholeFile, ImportError> {
    let file = WholeFile::begin(path, force)?;
    file.write(bytes)?;
    Ok(file)
}

const NEW_LISTING: &str = "\
# Patterns: images of single stains, white where they leave soil, 10 px/cm. `trodden patterns` with this folder checks and
# draws them; [patterns] folder in a scenario uses them. Causes that are not listed here are those of the built-in library.

";

#[derive(Default, Deserialize)]
struct RawListing {
    #[serde(default)]
    pattern: Vec<RawEntry>,
}

#[derive(Deserialize)]
struct RawEntry {
    file: Spanned<String>,
    cause: Spanned<Cause>,
    form: Option<Spanned<Form>>,
    length_cm: Spanned<f64>,
    share: Spanned<f64>,
}
