//! The pattern library: images of single stains, sorted by cause, with their real size and share.
//!
//! A library is a folder with `patterns.toml` and the images that it lists. In an image white leaves full soil and
//! black leaves none; the toes (or the direction of the drag) point to the right, and a sole is a **left** foot as
//! its print lies on the floor, so that the big toe is below. What is left on walls is upright, as one sees it.
//! [`PatternLibrary::built_in`] is compiled in.

mod decode;
mod error;
mod folder;
pub(crate) mod font;
mod import;
mod library;
mod listing;
mod sheet;

pub use error::{ListedAt, PatternsError};
pub use folder::PatternFolder;
pub use import::{Import, ImportEntry, ImportError, ImportOptions, Listed, PhotoScale, import_picture, name_of_photo};
pub use sheet::contact_sheet;

use decode::aspects;
use listing::lengths_cm;

/// Resolution at which patterns are kept, pixels per centimetre.
pub const PATTERN_PX_PER_CM: f64 = 10.0;

/// What leaves a mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cause {
    /// A shoe sole set down: the footprint.
    Sole,
    /// A heel or toe dragged over the floor: the thin black mark.
    Heel,
    /// A hand on a wall: palm, dragged fingers, fingertips.
    Hand,
    /// A forearm or an elbow along a wall.
    Arm,
    /// A shoulder or an upper arm against a wall.
    Shoulder,
    /// A bag, a case or a trolley against a wall.
    Bag,
    /// A shoe against the foot of a wall.
    Shoe,
}

impl Cause {
    /// Every cause, in the order in which lists name them.
    pub const ALL: [Cause; 7] =
        [Cause::Sole, Cause::Heel, Cause::Hand, Cause::Arm, Cause::Shoulder, Cause::Bag, Cause::Shoe];
    /// Those that leave marks on walls; each has a sum of its own.
    pub const WALL: [Cause; 5] = [Cause::Hand, Cause::Arm, Cause::Shoulder, Cause::Bag, Cause::Shoe];

    /// The cause as `patterns.toml` writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Cause::Sole => "sole",
            Cause::Heel => "heel",
            Cause::Hand => "hand",
            Cause::Arm => "arm",
            Cause::Shoulder => "shoulder",
            Cause::Bag => "bag",
            Cause::Shoe => "shoe",
        }
    }

    /// Place in [`Cause::WALL`]; `None` for what the floor takes.
    pub const fn on_wall(self) -> Option<usize> {
        match self {
            Cause::Sole | Cause::Heel => None,
            Cause::Hand => Some(0),
            Cause::Arm => Some(1),
            Cause::Shoulder => Some(2),
            Cause::Bag => Some(3),
            Cause::Shoe => Some(4),
        }
    }
}

/// What kind of stain a pattern shows, where a cause has several: a contact chooses by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// Hand: laid flat, as one pushes or leans; mostly a soft cloud.
    Palm,
    /// Hand: fingers dragged along the wall, the drag to the right.
    Drag,
    /// Hand: touched with the tips of the fingers.
    Fingertips,
    /// Shoe: the toe scuffs the wall.
    Toe,
    /// Shoe: a heel drawn along the wall: a thin line.
    HeelLine,
    /// Shoe: a sole set against the wall.
    Sole,
}

impl Form {
    /// Every form, in the order in which lists name them.
    pub const ALL: [Form; 6] = [Form::Palm, Form::Drag, Form::Fingertips, Form::Toe, Form::HeelLine, Form::Sole];

    /// The form as `patterns.toml` writes it.
    pub const fn name(self) -> &'static str {
        match self {
            Form::Palm => "palm",
            Form::Drag => "drag",
            Form::Fingertips => "fingertips",
            Form::Toe => "toe",
            Form::HeelLine => "heel_line",
            Form::Sole => "sole",
        }
    }

    /// What leaves stains of this form.
    pub const fn cause(self) -> Cause {
        match self {
            Form::Palm | Form::Drag | Form::Fingertips => Cause::Hand,
            Form::Toe | Form::HeelLine | Form::Sole => Cause::Shoe,
        }
    }

    /// The forms that a cause has, in words: `"palm", "drag" or "fingertips"`, or `none`.
    pub fn of_cause_in_words(cause: Cause) -> String {
        let forms = Form::ALL.into_iter().filter(|form| form.cause() == cause);
        let names: Vec<String> = forms.map(|form| format!("\"{}\"", form.name())).collect();
        match names.split_last() {
            Some((last, others)) if !others.is_empty() => format!("{} or {last}", others.join(", ")),
            Some((only, _)) => only.clone(),
            None => "none".to_owned(),
        }
    }
}

/// One pattern: coverage at 10 px/cm, toes (or the direction of the drag) to the right (+x), a left foot.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// File name without ending.
    pub name: String,
    /// What it is, in words.
    pub description: String,
    /// What leaves it.
    pub cause: Cause,
    /// What kind of stain it is, if its cause has several.
    pub form: Option<Form>,
    /// Real length along +x, centimetres, at which the image has 10 px/cm.
    pub length_cm: f64,
    /// Share at which it occurs among the patterns of its cause; the library scales them to sum up to 1.
    pub share: f64,
    /// Lengths of sole that wear it, centimetres, if not all.
    pub lengths_cm: Option<[f64; 2]>,
    /// Width in pixels.
    pub width_px: u32,
    /// Height in pixels.
    pub height_px: u32,
    /// 0 (leaves nothing) to 255 (full), in image order (row 0 at the top: the left of someone walking right).
    pub coverage: Vec<u8>,
}

impl Pattern {
    /// Real extent across the length, centimetres.
    pub fn breadth_cm(&self) -> f64 {
        self.length_cm * f64::from(self.height_px) / f64::from(self.width_px)
    }
}

/// All patterns.
#[derive(Clone, Debug)]
pub struct PatternLibrary {
    /// In the order of `patterns.toml`; a mark names a pattern by its place here.
    pub patterns: Vec<Pattern>,
}
