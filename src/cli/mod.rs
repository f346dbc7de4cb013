//! The command line: one file per subcommand, and shared parts. Only this module uses clap, indicatif and anyhow.

use std::path::Path;
use std::process::ExitCode;

use clap::builder::styling::{AnsiColor, Styles};
use clap::error::{ContextKind, ContextValue};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

mod arguments;
mod bake;
mod batch;
mod common;
mod crowd;
mod diff;
mod edit;
mod farm;
mod import_pattern;
mod init;
mod inspect;
mod job;
mod look;
mod merge;
mod motion;
mod patterns;
mod print;
mod progress;
mod resolve;
mod signals;
mod shell;
mod standard_input;
mod view;
mod why;

use arguments::WrongUsage;
use common::Common;

/// Turns a bitmap floor plan into the dirt that people leave in it.
#[derive(Parser)]
#[command(name = "trodden", version, styles = STYLES, max_term_width = 100, after_help = EXAMPLES)]
#[command(arg_required_else_help = true)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    common: Common,
}

#[derive(Subcommand)]
enum Command {
    Bake(bake::Bake),
    Batch(Box<batch::BatchCommand>),
    Crowd(crowd::Crowd),
    Motion(Box<motion::Motion>),
    Merge(merge::Merge),
    Job(Box<job::Job>),
    Resolve(resolve::Resolve),
    Look(look::LookCommand),
    View(view::ViewCommand),
    Why(why::WhyCommand),
    Init(init::Init),
    Inspect(inspect::Inspect),
    Edit(edit::Edit),
    Patterns(patterns::Patterns),
    Diff(diff::Diff),
    Completions(shell::Completions),
    Man(shell::Man),
}

const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Green.on_default().bold())
    .usage(AnsiColor::Green.on_default().bold())
    .literal(AnsiColor::Cyan.on_default().bold())
    .placeholder(AnsiColor::Cyan.on_default());

const EXAMPLES: &str = "\
Examples:
  trodden bake plan.png --metres-per-pixel 0.05      a plan alone is enough
  trodden init plan.png                              write plan.toml, with every default to edit
  trodden bake plan.toml --quick                     a coarse bake, in seconds
  trodden resolve out/plan --preset heavy            another look, without simulating again
  trodden crowd plan.toml -o paths.txt               where everybody went, for other programs
  trodden inspect plan.png --picture understood.png  what is understood of the plan
  trodden edit plan.png                              a page on which a click puts it right

`trodden COMMAND --help` says more about each.";

/// Parses the command line. Prints help, the version or a usage error, and exits, where one applies.
pub fn parse() -> Cli {
    let mut command = Cli::command();
    let matches = command.try_get_matches_from_mut(std::env::args_os()).unwrap_or_else(|error| with_tip(error).exit());
    let (mut used, mut given) = (&command, &matches);
    while let Some((name, below)) = given.subcommand() {
        (used, given) = (used.find_subcommand(name).unwrap_or(used), below);
    }
    let flags = used.get_arguments().filter_map(|argument| argument.get_long().map(str::to_string)).collect();
    let mut cli = Cli::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
    cli.common.flags = flags;
    cli
}

/// A file where a subcommand should stand is meant to be baked.
fn with_tip(mut error: clap::Error) -> clap::Error {
    let Some(ContextValue::String(given)) = error.get(ContextKind::InvalidSubcommand) else { return error };
    let path = Path::new(given);
    if path.is_file() || path.extension().is_some() {
        let tip = format!("`trodden bake {given}` bakes a plan or a scenario");
        error.remove(ContextKind::SuggestedSubcommand);
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    }
    error
}

impl Cli {
    pub fn run(&self) -> anyhow::Result<ExitCode> {
        signals::survive_size_limit();
        self.common.start_threads()?;
        let ran = match &self.command {
            Command::Bake(bake) => bake.run(&self.common),
            Command::Batch(batch) => batch.run(&self.common),
            Command::Crowd(crowd) => crowd.run(&self.common),
            Command::Motion(motion) => motion.run(&self.common),
            Command::Job(job) => job.run(&self.common),
            Command::Merge(merge) => merge.run(&self.common),
            Command::Resolve(resolve) => resolve.run(&self.common),
            Command::Look(look) => look.run(&self.common),
            Command::View(view) => view.run(&self.common),
            Command::Why(why) => why.run(&self.common),
            Command::Init(init) => init.run(&self.common),
            Command::Inspect(inspect) => inspect.run(&self.common),
            Command::Edit(edit) => edit.run(&self.common),
            Command::Patterns(patterns) => patterns.run(&self.common),
            Command::Diff(diff) => diff.run(&self.common),
            Command::Completions(completions) => completions.run(Cli::command()),
            Command::Man(man) => man.run(Cli::command()),
        };
        if let Some(usage) = ran.as_ref().err().and_then(|error| error.downcast_ref()) {
            refuse(usage);
        }
        ran
    }

    /// Prints an error and returns the exit code. Ends by a signal if one was caught.
    pub fn fail(&self, error: &anyhow::Error) -> ExitCode {
        let code = print::failure(error, &self.common);
        signals::end();
        code
    }
}

/// Prints what is wrong with the command line and how the subcommand is used, and exits.
fn refuse(usage: &WrongUsage) {
    let mut cli = Cli::command();
    // So that the usage is that of the whole command.
    cli.build();
    let mut found = &mut cli;
    for name in usage.command {
        let Some(next) = found.find_subcommand_mut(name) else { return };
        found = next;
    }
    found.error(usage.kind, &usage.message).exit();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
