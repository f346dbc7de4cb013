//! `patterns.toml`, parsed and checked; errors name line and column.

use std::ops::Range;
use std::path::Path;

use serde::Deserialize;
use toml::Spanned;

use super::{Cause, Form, ListedAt, PatternsError};

/// Name of the listing in a library's folder.
pub(super) const LISTING: &str = "patterns.toml";
/// Limit on the number of patterns: marks refer to a pattern by a `u16`, and a wrong file must not fill memory.
const MOST_PATTERNS: usize = 1000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawListing {
    #[serde(default)]
    pattern: Vec<RawPattern>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawPattern {
    file: Spanned<String>,
    cause: Cause,
    form: Option<Spanned<Form>>,
    length_cm: Spanned<f64>,
    share: Spanned<f64>,
    lengths_cm: Option<Spanned<[f64; 2]>>,
    #[serde(default)]
    description: String,
}

/// One checked `[[pattern]]` of a listing; its image is not read yet.
pub(super) struct ListedPattern {
    pub file: String,
    pub listed_at: ListedAt,
    pub cause: Cause,
    pub form: Option<Form>,
    pub length_cm: f64,
    pub share: f64,
    pub lengths_cm: Option<[f64; 2]>,
    pub description: String,
}

/// Parses and checks the text of a listing; `file` appears in messages only.
pub(super) fn parse(text: &str, file: &Path) -> Result<Vec<ListedPattern>, PatternsError> {
    let at = |span: Option<Range<usize>>| listed_at(text, file, span);
    let listing: RawListing = toml::from_str(text)
        .map_err(|error| PatternsError::Syntax { at: at(error.span()), message: error.message().to_owned() })?;
    if listing.pattern.len() > MOST_PATTERNS {
        return Err(PatternsError::TooMany {
            file: file.to_owned(),
            count: listing.pattern.len(),
            most: MOST_PATTERNS,
        });
    }
    let entries = listing.pattern.into_iter().map(|raw| check(raw, at)).collect::<Result<Vec<_>, _>>()?;
    if entries.is_empty() {
        return Err(PatternsError::MissingCause { file: file.to_owned(), cause: Cause::Sole });
    }
    Ok(entries)
}

fn check(raw: RawPattern, at: impl Fn(Option<Range<usize>>) -> ListedAt) -> Result<ListedPattern, PatternsError> {
    let lengths = raw.cause.lengths_cm();
    let value = |span: Range<usize>, key, value: String, allowed: String| {
        Err(PatternsError::Value { at: at(Some(span)), key, value, allowed })
    };
    let (length_cm, share) = (*raw.length_cm.get_ref(), *raw.share.get_ref());
    if !(lengths[0]..=lengths[1]).contains(&length_cm) {
        let allowed = format!("{} to {} for cause = \"{}\"", lengths[0], lengths[1], raw.cause.name());
        return value(raw.length_cm.span(), "length_cm", length_cm.to_string(), allowed);
    }
    if !(share > 0.0 && share <= 1e6) {
        return value(raw.share.span(), "share", share.to_string(), "above 0, to 1000000".to_owned());
    }
    if let Some(range) = &raw.lengths_cm {
        let [from, to] = *range.get_ref();
        if !(from >= 0.0 && from <= to && to <= 100.0) {
            let allowed = "[from, to] with 0 <= from <= to <= 100".to_owned();
            return value(range.span(), "lengths_cm", format!("[{from}, {to}]"), allowed);
        }
    }
    if let Some(form) = raw.form.as_ref().filter(|form| form.get_ref().cause() != raw.cause) {
        let allowed = format!("{} for cause = \"{}\"", Form::of_cause_in_words(raw.cause), raw.cause.name());
        return value(form.span(), "form", format!("\"{}\"", form.get_ref().name()), allowed);
    }
    if raw.file.get_ref().is_empty() {
        return value(raw.file.span(), "file", "empty".to_owned(), "the path of an image".to_owned());
    }
    Ok(ListedPattern {
        listed_at: at(Some(raw.file.span())),
        file: raw.file.into_inner(),
        cause: raw.cause,
        form: raw.form.map(Spanned::into_inner),
        length_cm,
        share,
        lengths_cm: raw.lengths_cm.map(Spanned::into_inner),
        description: raw.description,
    })
}

/// Line and column of the start of a byte range; the start of the file without one.
fn listed_at(text: &str, file: &Path, span: Option<Range<usize>>) -> ListedAt {
    let start = span.map_or(0, |span| span.start).min(text.len());
    let before = String::from_utf8_lossy(&text.as_bytes()[..start]);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    ListedAt {
        file: file.to_owned(),
        line: before.matches('\n').count() + 1,
        column: before[line_start..].chars().count() + 1,
    }
}
