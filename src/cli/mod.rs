//! The command line: one file per subcommand, and shared parts. Only this module uses clap, indicatif and anyhow.

use std::process::ExitCode;

use clap::builder::styling::{AnsiColor, Styles};
use clap::{Args, ColorChoice, Parser, Subcommand};

mod arguments;
mod bake;
mod crowd;
mod diff;
mod import_pattern;
mod init;
mod inspect;
mod motion;
mod patterns;
mod print;
mod progress;
mod resolve;
mod signals;
mod standard_input;
mod view;

/// Turns a bitmap floor plan into the dirt that people leave in it.
#[derive(Parser)]
#[command(name = "trodden", version, styles = STYLES, max_term_width = 100, after_help = EXAMPLES)]
#[command(arg_required_else_help = true, disable_help_subcommand = true)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    common: Common,
}

#[derive(Subcommand)]
enum Command {
    Bake(bake::Bake),
    Crowd(crowd::Crowd),
    Motion(Box<motion::Motion>),
    Resolve(resolve::Resolve),
    View(view::ViewCommand),
    Init(init::Init),
    Inspect(inspect::Inspect),
    Patterns(patterns::Patterns),
    Diff(diff::Diff),
}

/// Options of every subcommand.
#[derive(Args)]
#[command(next_help_heading = "Common options")]
pub struct Common {
    /// Say nothing but errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Say more: seconds of each stage, memory
    #[arg(short, long, global = true)]
    verbose: bool,
    /// How many threads work, 1 to 256; all results are the same for any number [default: all cores]
    #[arg(long, global = true, value_name = "N", allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    /// When to colour messages
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    color: ColorChoice,
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
  trodden bake plan.toml --quick                     a coarse bake in about a second
  trodden resolve out/plan --preset heavy            another look, without simulating again
  trodden crowd plan.toml -o paths.txt               where everybody went, for other programs
  trodden inspect plan.png --picture understood.png  what is understood of the plan

`trodden COMMAND --help` says more about each.";

/// Parses the command line. Prints help, the version or a usage error, and exits, where one applies.
pub fn parse() -> Cli {
    Cli::parse()
}

impl Cli {
    pub fn run(&self) -> anyhow::Result<ExitCode> {
        signals::survive_size_limit();
        self.common.start_threads()?;
        match &self.command {
            Command::Bake(bake) => bake.run(&self.common),
            Command::Crowd(crowd) => crowd.run(&self.common),
            Command::Motion(motion) => motion.run(&self.common),
            Command::Resolve(resolve) => resolve.run(&self.common),
            Command::View(view) => view.run(&self.common),
            Command::Init(init) => init.run(&self.common),
            Command::Inspect(inspect) => inspect.run(&self.common),
            Command::Patterns(patterns) => patterns.run(&self.common),
            Command::Diff(diff) => diff.run(&self.common),
        }
    }

    /// Prints an error and returns the exit code. Ends by a signal if one was caught.
    pub fn fail(&self, error: &anyhow::Error) -> ExitCode {
        let code = print::failure(error, &self.common);
        signals::end();
        code
    }
}

impl Common {
    fn start_threads(&self) -> anyhow::Result<()> {
        let threads = self.threads.map_or(0, usize::from);
        Ok(rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?)
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
