use serde::Serialize;

mod stopwatch;

pub use stopwatch::Stopwatch;

/// A stage of the bake, as progress bars and the report name it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
#[allow(missing_docs)] // the names are the modules'
pub enum Stage {
    Plan,
    Walls,
    Routes,
    Patterns,
    Motion,
    Crowd,
    Marks,
    Stamps,
    Sums,
    Look,
    Export,
    Scene,
    Stills,
    Page,
}

impl Stage {
    /// All stages, in the order in which the data goes.
    pub const ALL: [Stage; 14] = [
        Stage::Plan,
        Stage::Walls,
        Stage::Routes,
        Stage::Patterns,
        Stage::Motion,
        Stage::Crowd,
        Stage::Marks,
        Stage::Stamps,
        Stage::Sums,
        Stage::Look,
        Stage::Export,
        Stage::Scene,
        Stage::Stills,
        Stage::Page,
    ];

    /// The stage's name: that of its module.
    pub const fn name(self) -> &'static str {
        match self {
            Stage::Plan => "plan",
            Stage::Walls => "walls",
            Stage::Routes => "routes",
            Stage::Patterns => "patterns",
            Stage::Motion => "motion",
            Stage::Crowd => "crowd",
            Stage::Marks => "marks",
            Stage::Stamps => "stamps",
            Stage::Sums => "sums",
            Stage::Look => "look",
            Stage::Export => "export",
            Stage::Scene => "scene",
            Stage::Stills => "stills",
            Stage::Page => "page",
        }
    }
}

/// Who watches a long piece of work, and may stop it.
pub trait Progress: Sync {
    /// The stage has done this share (0 to 1) of its work.
    fn advance(&self, stage: Stage, share: f64);

    /// Something that the user should know, though it stops nothing.
    fn warn(&self, message: &str);

    /// Whether the user wants the work to stop. Asked often, must be cheap.
    fn interrupted(&self) -> bool {
        false
    }

    /// Gives up once the user wants the work to stop.
    ///
    /// # Errors
    /// [`Interrupted`].
    fn keep_on(&self) -> Result<(), Interrupted> {
        if self.interrupted() { Err(Interrupted) } else { Ok(()) }
    }
}

/// Watches nothing: for pipes, tests and library users.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Progress for Silent {
    fn advance(&self, _stage: Stage, _share: f64) {}
    fn warn(&self, _message: &str) {}
}

/// The user stopped the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("interrupted; nothing was written")]
pub struct Interrupted;
