//! The wall patterns of a library, by cause and form.

use crate::patterns::{Cause, Form, Pattern, PatternLibrary};

/// Candidates of one cause and, optionally, one form.
#[derive(Default)]
struct PatternChoices {
    cause: Option<(Cause, Option<Form>)>,
    patterns: Vec<SizedPattern>,
    total: f64,
}

/// A pattern with its natural size.
#[derive(Clone, Copy, Debug)]
pub(super) struct SizedPattern {
    /// Index in the library.
    pub pattern: u16,
    pub length_m: f64,
    pub breadth_m: f64,
    share: f64,
}

/// The wall patterns of a library, for random choice.
pub(super) struct WallPatterns {
    lists: Vec<PatternChoices>,
}

impl WallPatterns {
    pub fn new(library: &PatternLibrary) -> WallPatterns {
        let wanted = Cause::WALL
            .into_iter()
            .flat_map(|cause| Form::ALL.into_iter().map(Some).chain([None]).map(move |form| (cause, form)));
        let list = |(cause, form): (Cause, Option<Form>)| {
            let counts = |pattern: &Pattern| pattern.cause == cause && (form.is_none() || pattern.form == form);
            let patterns: Vec<SizedPattern> = (library.patterns.iter().enumerate())
                .filter(|(_, pattern)| counts(pattern))
                .filter_map(|(place, pattern)| {
                    Some(SizedPattern {
                        pattern: u16::try_from(place).ok()?,
                        length_m: pattern.length_cm / 100.0,
                        breadth_m: pattern.breadth_cm() / 100.0,
                        share: pattern.share,
                    })
                })
                .collect();
            let total = patterns.iter().map(|chosen| chosen.share).sum();
            PatternChoices { cause: Some((cause, form)), patterns, total }
        };
        WallPatterns { lists: wanted.map(list).filter(|list| !list.patterns.is_empty()).collect() }
    }

    /// Whether the library has no wall pattern.
    pub fn is_empty(&self) -> bool {
        self.lists.is_empty()
    }

    /// Chooses a pattern by share; `draw` is uniform in `[0, 1)`.
    ///
    /// Falls back to all patterns of the cause where none has the form; `None` without a pattern of the cause.
    pub fn choose(&self, cause: Cause, form: Option<Form>, draw: f64) -> Option<SizedPattern> {
        let of = |form: Option<Form>| self.lists.iter().find(|list| list.cause == Some((cause, form)));
        let list = of(form).or_else(|| of(None))?;
        let mut left = draw * list.total;
        let found = list.patterns.iter().find(|chosen| {
            left -= chosen.share;
            left < 0.0
        });
        found.or(list.patterns.last()).copied()
    }
}
