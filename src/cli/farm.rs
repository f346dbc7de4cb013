//! Work as a render farm or a cluster gives it out: days of a bake, messages to the scheduler, exit codes.

use std::io;
use std::process::ExitCode;

use clap::builder::TypedValueParser;
use trodden::export::ExportError;

use super::{Common, arguments, print};

/// Most days of a bake.
const MOST_DAYS: u32 = 10_000;

/// The days that a bake walks, or some of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Days {
    /// Number of all days, if given.
    pub all: Option<u32>,
    /// First and last of some, counted from 1.
    pub some: Option<[u32; 2]>,
}

/// Parses `32`, `17..32`, `17..32/160`; a scheduler's `17-32` and a single day's `17-17` too.
pub fn days(text: &str) -> Result<Days, String> {
    let number = |text: &str| match text.parse::<u32>() {
        Ok(number) if (1..=MOST_DAYS).contains(&number) => Ok(number),
        _ => Err(format!(
            "{text} is not in 1..={MOST_DAYS}; give a number of days, or some of them as 17..32 or 17..32/160"
        )),
    };
    let (range, all) = match text.split_once('/') {
        Some((range, all)) => (range, Some(number(all)?)),
        None => (text, None),
    };
    match range.split_once("..").or_else(|| range.split_once('-').filter(|(first, _)| !first.is_empty())) {
        Some((first, last)) => Ok(Days { all, some: Some([number(first)?, number(last)?]) }),
        None if all.is_some() => number(range).map(|day| Days { all, some: Some([day; 2]) }),
        None => Ok(Days { all: Some(number(range)?), some: None }),
    }
}

/// How a scheduler wants to be told of progress and failures, on standard output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// Open Job Description: lines such as `openjd_progress: 50`.
    OpenJd,
}

pub fn form() -> impl TypedValueParser<Value = Form> {
    arguments::one_of([Form::OpenJd], |Form::OpenJd| "openjd")
}

impl Form {
    /// The lines about a stage: its name if it begins, and percent.
    pub fn progress(self, begun: Option<&str>, percent: u32) -> String {
        let status = begun.map_or(String::new(), |stage| format!("openjd_status: {stage}\n"));
        format!("{status}openjd_progress: {percent}")
    }
}

/// Does work that a scheduler may try again. Exit code 1 says that another attempt may succeed, 2 that it would not: the
/// input is wrong, not the disk or the machine.
pub fn attempt(
    common: &Common,
    form: Option<Form>,
    work: impl FnOnce() -> anyhow::Result<()>,
) -> anyhow::Result<ExitCode> {
    let Err(error) = work() else { return Ok(ExitCode::SUCCESS) };
    if form.is_some() {
        print::line(format!("openjd_fail: {}", error.to_string().replace('\n', "; ")))?;
    }
    if may_succeed(&error) {
        return Err(error);
    }
    print::failure(&error, common);
    Ok(ExitCode::from(2))
}

/// Whether an error may not come again: one of the system, an interruption, what another process holds or has yet to write.
fn may_succeed(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        let ours = match cause.downcast_ref::<trodden::Error>() {
            Some(trodden::Error::Interrupted(_)) => return true,
            Some(trodden::Error::Export(error)) => Some(error),
            _ => cause.downcast_ref::<ExportError>(),
        };
        cause.is::<io::Error>()
            || matches!(ours, Some(ExportError::PartsMissing { .. } | ExportError::OutputInUse { .. }))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_a_number_or_a_range_of_some() {
        let of = |all, some| Ok(Days { all, some });
        assert_eq!(days("32"), of(Some(32), None));
        assert_eq!(days("17..32"), of(None, Some([17, 32])));
        assert_eq!(days("17..32/160"), of(Some(160), Some([17, 32])));
        assert_eq!(days("5-5/160"), of(Some(160), Some([5, 5])));
        assert_eq!(days("5/160"), of(Some(160), Some([5, 5])));
        for wrong in ["0", "-3", "..3", "3..", "1..20000", "a", "1..2/0", "1..2/"] {
            assert!(days(wrong).is_err(), "{wrong}");
        }
    }
}
