use std::path::Path;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{FilePlace, LookError};
use super::image::decode;
use super::image_set::look_files;
use super::settings::{AreaLook, Look};
use crate::files::read_text;
use crate::options::{self, Mistake, Options, value_at};

impl Look {
    /// Reads a look file: TOML with the keys of [`Look`], under `[look]` or without a section.
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
        let wrong = |mistake: Mistake| wrong(&mistake, text, path);
        let table = DeTable::parse(text).map_err(|error| wrong(Mistake::syntax(&error)))?;
        // The keys may stand in a section of their own, as in a scenario.
        let whole = table.get_ref();
        let section = whole.get("look").filter(|_| whole.len() == 1).and_then(|look| look.get_ref().as_table());
        let keys = section.unwrap_or(whole);
        let place_of = |key: &str| value_at(keys, key).map(|value| place(text, path, value.span().start));

        let preset = keys.get("preset").and_then(|value| value.get_ref().as_str()).unwrap_or("commuters");
        let mut look = preset_named(preset, || place_of("preset"))?;
        look.lay(&Spanned::new(table.span(), DeValue::Table(keys.clone()))).map_err(wrong)?;
        look.check_ranges().map_err(|error| LookError::Option { place: place_of(error.key()), error })?;
        if let Some(folder) = path.parent() {
            for image in look.images().into_iter().flatten() {
                *image = folder.join(&*image);
            }
        }
        Ok(look)
    }

    /// Another preset, with what this look changes from its own one: the floor's material, the people who have walked.
    /// A scenario's look becomes what it would be with `preset` in place of its own.
    ///
    /// # Errors
    /// There is no preset of that name.
    pub fn with_preset(&self, name: &str) -> Result<Look, LookError> {
        let (mut look, own) = (preset_named(name, || None)?, preset_named(&self.preset, || None)?);
        let text = changed(self.table(), &own.table()).to_string();
        let laid = DeTable::parse(&text)
            .map_err(|error| Mistake::syntax(&error))
            .and_then(|table| look.lay(&Spanned::new(table.span(), DeValue::Table(table.into_inner()))));
        laid.map_err(|mistake| wrong(&mistake, &text, Path::new("look")))?;
        Ok(look)
    }

    /// Checks that the images of floor and walls can be read, before any long computation.
    ///
    /// # Errors
    /// An image is missing, damaged, too large or of an unknown format.
    pub fn check_images(&self) -> Result<(), LookError> {
        let floors = self.area.iter().map(|area| &area.floor).chain([&self.floor]).map(|floor| &floor.image);
        floors
            .chain([&self.wall.image])
            .flatten()
            .try_for_each(|path| look_files(path)?.iter().try_for_each(|file| decode(file).map(drop)))
    }

    /// Checks every number against its range.
    ///
    /// # Errors
    /// [`LookError::Option`] names the key, its value and the range allowed; an area without an outline.
    pub fn check(&self) -> Result<(), LookError> {
        self.check_ranges().map_err(|error| LookError::Option { error, place: None })?;
        let unknown = |area: &AreaLook| area.room.is_none() && area.outline.len() < 2;
        match self.area.iter().position(unknown) {
            Some(index) => Err(LookError::NoOutline { number: index + 1, corners: self.area[index].outline.len() }),
            None => Ok(()),
        }
    }

    /// All settings, as a manifest keeps them.
    pub fn settings(&self) -> serde_json::Value {
        // Only numbers that JSON cannot hold stop it; `check` refuses them.
        serde_json::to_value(self.table()).unwrap_or_default()
    }

    /// The look of [`Look::settings`].
    ///
    /// # Errors
    /// What is no look, in words.
    pub fn of_settings(settings: &serde_json::Value) -> Result<Look, String> {
        let text = toml::Table::try_from(settings).map_err(|error| error.to_string())?.to_string();
        options::parse(&text).map_err(|mistake| mistake.explain(&text).0)
    }
}

fn preset_named(name: &str, place: impl FnOnce() -> Option<FilePlace>) -> Result<Look, LookError> {
    Look::preset(name).ok_or_else(|| LookError::UnknownPreset { name: name.to_string(), place: place() })
}

fn wrong(mistake: &Mistake, text: &str, path: &Path) -> LookError {
    let (message, hint) = mistake.explain(text);
    LookError::Syntax { place: place(text, path, mistake.span.start), message, hint }
}

/// The keys whose values differ from those of `own`.
fn changed(table: toml::Table, own: &toml::Table) -> toml::Table {
    let differs = |(key, value): (String, toml::Value)| match (value, own.get(&key)) {
        (toml::Value::Table(part), Some(toml::Value::Table(own))) => {
            let part = changed(part, own);
            (!part.is_empty()).then_some((key, toml::Value::Table(part)))
        }
        (value, own) => (own != Some(&value)).then_some((key, value)),
    };
    table.into_iter().filter_map(differs).collect()
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
            let text = look.table().to_string();
            assert_eq!(parse(&text).unwrap(), look, "{text}");
        }
    }

    #[test]
    fn errors_name_line_and_column() {
        assert!(message("[film]\ndensty = 0.3\n").starts_with("looks/mine.toml:2:1: [film] has no key `densty`"));
        assert!(message("[film]\ndensity = \"much\"\n").starts_with("looks/mine.toml:2:11: `density` takes a number"));
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
        assert!(message("[wall]\nskirt = 3\n").starts_with("looks/mine.toml:2:1: [wall] has no key `skirt`"));
        assert!(message("[wall]\nmaterial = \"silk\"\n").contains("one of matt, gloss, concrete"));
    }

    #[test]
    fn a_missing_file_is_named() {
        let error = Look::read(Path::new("/nowhere/look.toml")).unwrap_err();
        assert!(error.to_string().starts_with("cannot read the look file /nowhere/look.toml: "));
    }
}
