//! `trodden`: the command line. Parse, call, print the error with its hint, exit.
//!
//! Exit codes: 0 done, 1 it could not be done (or `diff` found a difference), 2 the command line is wrong (or `diff` could
//! not compare, or a part of a bake or a merge would fail again).

use std::process::ExitCode;

mod cli;

fn main() -> ExitCode {
    let cli = cli::parse();
    match cli.run() {
        Ok(code) => code,
        Err(error) => cli.fail(&error),
    }
}
