use std::path::Path;

use toml::de::{DeTable, DeValue};

use super::error::{FilePlace, LookError};
use super::image::decode;
use super::settings::Look;
use crate::files::read_text;

impl Look {
    /// Reads a look file: TOML with the keys of [`Look`].
    /// Missing keys come from its `preset`, by default `commuters`. Paths of images are relative to the file.
    ///
    /// # Errors
    /// The file cannot be read; syntax errors, unknown keys, wrong types, unknown presets and values out of range, with
    /// line and column.
    pub fn read(path: &Path) -> Result<Look, LookError> {
        let text = read_text(path).map_err(|source| LookError::Unreadable { path: path.to_path_buf(), source })?;
        Look::parse(&text, path)
    }

    /// Parses a look from `text`; `path` is its file, for errors and paths of images.
    ///
    /// # Errors
    /// As [`Look::read`].
    pub fn parse(text: &str, path: &Path) -> Result<Look, LookError> {
        let at = |offset: usize| place(text, path, offset);
        let syntax = |error: toml::de::Error| LookError::Syntax {
            place: at(error.span().map_or(0, |span| span.start)),
            message: error.message().to_string(),
        };
        // Parsed twice: directly, so that errors have a position in the file, and merged with the preset.
        toml::from_str::<Look>(text).map_err(syntax)?;
        let spans = DeTable::parse(text).map_err(syntax)?;
        let written: toml::Table = toml::from_str(text).map_err(syntax)?;
        let place_of = |key: &str| Some(at(offset_of(spans.get_ref(), key)));

        let preset = written.get("preset").and_then(toml::Value::as_str).unwrap_or("commuters");
        let base = Look::preset(preset)
            .ok_or_else(|| LookError::UnknownPreset { name: preset.to_string(), place: place_of("preset") })?;
        let mut look = base.overlaid(written).map_err(syntax)?;
        if let Some(range) = look.first_out_of_range() {
            let place = place_of(range.key);
            return Err(LookError::Range { range, place });
        }
        if let Some(folder) = path.parent() {
            for image in look.images().into_iter().flatten() {
                *image = folder.join(&*image);
            }
        }
        Ok(look)
    }

    /// Checks that the images of floor and walls can be read, before any long computation.
    ///
    /// # Errors
    /// An image is missing, damaged, too large or of an unknown format.
    pub fn check_images(&self) -> Result<(), LookError> {
        [&self.floor.image, &self.wall.image].into_iter().flatten().try_for_each(|path| decode(path).map(drop))
    }

    /// Returns these settings, overridden by a TOML table.
    ///
    /// # Errors
    /// [`Look`] has no such key, or a key of another type.
    pub fn overlaid(&self, table: toml::Table) -> Result<Look, toml::de::Error> {
        let own = toml::Table::try_from(self).map_err(serde::de::Error::custom)?;
        toml::Value::Table(laid_over(own, table)).try_into()
    }
}

fn laid_over(mut below: toml::Table, above: toml::Table) -> toml::Table {
    for (key, value) in above {
        let merged = match (below.remove(&key), value) {
            (Some(toml::Value::Table(old)), toml::Value::Table(new)) => toml::Value::Table(laid_over(old, new)),
            (_, value) => value,
        };
        below.insert(key, merged);
    }
    below
}

/// Byte offset of a key's value, such as `film.density`, or of the nearest section that exists.
fn offset_of(table: &DeTable<'_>, key: &str) -> usize {
    let (first, rest) = key.split_once('.').unwrap_or((key, ""));
    let Some((_, value)) = table.iter().find(|(name, _)| name.get_ref() == first) else { return 0 };
    match (rest, value.get_ref()) {
        ("", _) => value.span().start,
        (rest, DeValue::Table(inner)) => match offset_of(inner, rest) {
            0 => value.span().start,
            offset => offset,
        },
        _ => value.span().start,
    }
}

fn place(text: &str, path: &Path, offset: usize) -> FilePlace {
    let before = &text[..text.floor_char_boundary(offset)];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    FilePlace {
        path: path.to_path_buf(),
        line: before.matches('\n').count() + 1,
        column: before[line_start..].chars().count() + 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Look, LookError> {
        Look::parse(text, Path::new("looks/mine.toml"))
    }

    fn message(text: &str) -> String {
        parse(text).unwrap_err().to_string()
    }

    #[test]
    fn an_empty_file_is_the_default() {
        assert_eq!(parse("").unwrap(), Look::default());
        assert_eq!(Look::preset("commuters").unwrap(), Look::default());
    }

    #[test]
    fn a_file_is_laid_over_the_preset_that_it_names() {
        let look = parse("preset = \"heavy\"\n[film]\nper_pass = 0.02\n").unwrap();
        let heavy = Look::preset("heavy").unwrap();
        assert_eq!(look.film.per_pass, 0.02);
        assert_eq!(look.film.density, heavy.film.density);
        assert_eq!(look.edge, heavy.edge);
    }

    #[test]
    fn every_preset_survives_writing_and_reading() {
        for name in super::super::LOOK_PRESETS {
            let look = Look::preset(name).unwrap();
            look.check().unwrap();
            let text = toml::to_string(&look).unwrap();
            assert_eq!(parse(&text).unwrap(), look, "{text}");
        }
    }

    #[test]
    fn errors_name_line_and_column() {
        assert!(message("[film]\ndensty = 0.3\n").starts_with("looks/mine.toml:2:1: unknown field `densty`"));
        assert!(message("[film]\ndensity = \"much\"\n").starts_with("looks/mine.toml:2:11: invalid type"));
        assert!(message("[film\n").starts_with("looks/mine.toml:1:6:"), "{}", message("[film\n"));
        assert_eq!(
            message("seed = 2\n\n[edge]\nreach_m = 0.04\ncorner = 9.5\n"),
            "looks/mine.toml:5:10: edge.corner is 9.5, allowed is 1 to 4"
        );
        assert_eq!(
            message("[noise]\nfine = { size_m = nan, sd = 0.1 }\n"),
            "looks/mine.toml:2:19: noise.fine.size_m is NaN, allowed is 0.002 to 20"
        );
    }

    #[test]
    fn an_unknown_preset_is_named_with_its_place_and_the_nearest() {
        let error = parse("# mine\npreset = \"havy\"\n").unwrap_err();
        assert_eq!(
            error.to_string(),
            "looks/mine.toml:2:10: there is no look preset \"havy\"; there are commuters, heavy, wet, paper"
        );
        assert_eq!(error.hint().unwrap(), "did you mean \"heavy\"?");
    }

    #[test]
    fn a_floor_image_is_relative_to_the_look_file() {
        let look = parse("[floor]\nimage = \"oak.png\"\n").unwrap();
        assert_eq!(look.floor.image.unwrap(), Path::new("looks/oak.png"));
    }

    #[test]
    fn walls_have_sections_of_their_own() {
        let look = parse("[wall]\nmaterial = \"gloss\"\nimage = \"brick.png\"\n[wall.skin]\nstrength = 2\n").unwrap();
        assert_eq!((look.wall.material, look.wall.skin.strength), (super::super::WallMaterial::Gloss, 2.0));
        assert_eq!(look.wall.skin.density, Look::default().wall.skin.density);
        assert_eq!(look.wall.image.unwrap(), Path::new("looks/brick.png"));
        assert_eq!(
            message("[wall.rubber]\nspread_m = 3\n"),
            "looks/mine.toml:2:12: wall.rubber.spread_m is 3, allowed is 0.005 to 0.5"
        );
        assert_eq!(
            message("[wall.noise]\nfine = { size_m = nan, sd = 0.1 }\n"),
            "looks/mine.toml:2:19: wall.noise.fine.size_m is NaN, allowed is 0.002 to 20"
        );
        assert!(message("[wall]\nskirt = 3\n").starts_with("looks/mine.toml:2:1: unknown field `skirt`"));
        assert!(message("[wall]\nmaterial = \"silk\"\n").contains("expected one of `matt`, `gloss`, `concrete`"));
    }

    #[test]
    fn a_missing_file_is_named() {
        let error = Look::read(Path::new("/nowhere/look.toml")).unwrap_err();
        assert!(error.to_string().starts_with("cannot read the look file /nowhere/look.toml: "));
    }
}
