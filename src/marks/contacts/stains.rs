//! The patterns of a library that walls take.

use crate::patterns::{Cause, Form, Pattern, PatternLibrary};

/// Patterns of one cause and, maybe, one form.
#[derive(Default)]
struct Choices {
    cause: Option<(Cause, Option<Form>)>,
    patterns: Vec<Chosen>,
    total: f64,
}

/// A pattern in its natural size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chosen {
    /// Its place in the library.
    pub pattern: u16,
    pub length_m: f64,
    pub breadth_m: f64,
    share: f64,
}

/// All patterns for walls, ready to be chosen from.
pub(super) struct Stains {
    lists: Vec<Choices>,
}

const FORMS: [Form; 6] = [Form::Palm, Form::Drag, Form::Fingertips, Form::Toe, Form::HeelLine, Form::Sole];

impl Stains {
    pub fn new(library: &PatternLibrary) -> Stains {
        let wanted = Cause::WALL
            .into_iter()
            .flat_map(|cause| FORMS.into_iter().map(Some).chain([None]).map(move |form| (cause, form)));
        let list = |(cause, form): (Cause, Option<Form>)| {
            let counts = |pattern: &Pattern| pattern.cause == cause && (form.is_none() || pattern.form == form);
            let patterns: Vec<Chosen> = (library.patterns.iter().enumerate())
                .filter(|(_, pattern)| counts(pattern))
                .filter_map(|(place, pattern)| {
                    Some(Chosen {
                        pattern: u16::try_from(place).ok()?,
                        length_m: pattern.length_cm / 100.0,
                        breadth_m: pattern.breadth_cm() / 100.0,
                        share: pattern.share,
                    })
                })
                .collect();
            let total = patterns.iter().map(|chosen| chosen.share).sum();
            Choices { cause: Some((cause, form)), patterns, total }
        };
        Stains { lists: wanted.map(list).filter(|list| !list.patterns.is_empty()).collect() }
    }

    /// Whether no wall takes any of them.
    pub fn is_empty(&self) -> bool {
        self.lists.is_empty()
    }

    /// Chooses by share: `draw` is uniform in `[0, 1)`. Where none has the form, all of the cause count; `None` if there is
    /// none of the cause.
    pub fn choose(&self, cause: Cause, form: Option<Form>, draw: f64) -> Option<Chosen> {
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
