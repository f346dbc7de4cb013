use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{Args, Parser};

use super::arguments::WrongUsage;
use super::bake::Bake;
use super::print::{self, plan_file, save};
use super::{Common, standard_input};

const OPENJD: &str = include_str!("job/openjd.yaml");
const SLURM: [(&str, &str); 3] = [
    ("bake.sbatch", include_str!("job/bake.sbatch")),
    ("merge.sbatch", include_str!("job/merge.sbatch")),
    ("submit", include_str!("job/submit")),
];

/// Write what a render farm or a cluster needs to bake a scenario in parts, on many machines
///
/// Each part bakes some of the days; when all are done, a last step merges them. It is the same bake as that of one
/// machine, to the byte. docs/scale.md tells how many days are enough.
#[derive(Args)]
#[command(after_help = "\
Examples:
  trodden job plan.toml --days 160 --parts 16 --openjd farm    for AWS Deadline Cloud and others
  trodden job plan.toml --days 160 --parts 16 --slurm cluster  then: sh cluster/submit
  trodden job plan.toml --days 160 --parts 16 --slurm cluster -- --seed 3 --floor-only")]
#[command(group = clap::ArgGroup::new("form").required(true).multiple(true))]
pub struct Job {
    /// A scenario (TOML), or a plan alone
    #[arg(value_name = "SCENARIO|PLAN")]
    path: PathBuf,
    /// Days that people walk [default: those of the scenario]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    days: Option<u32>,
    /// Parts to bake, about one for each machine; at most as many as there are days
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    parts: u32,
    /// Write an Open Job Description to this folder: template.yaml
    #[arg(long, value_name = "FOLDER", group = "form")]
    openjd: Option<PathBuf>,
    /// Write batch scripts for Slurm to this folder, for `sh FOLDER/submit`
    #[arg(long, value_name = "FOLDER", group = "form")]
    slurm: Option<PathBuf>,
    /// Replace earlier files
    #[arg(long)]
    force: bool,
    /// More options of `trodden bake`, for every part
    #[arg(last = true, value_name = "OPTIONS OF BAKE")]
    options: Vec<String>,
}

/// The options of `bake`, as each part will have them.
#[derive(Parser)]
#[command(name = "trodden job ... --", bin_name = "trodden bake")]
struct Line {
    #[command(flatten)]
    bake: Bake,
    #[command(flatten)]
    _common: Common,
}

impl Job {
    pub fn run(&self, common: &Common) -> anyhow::Result<ExitCode> {
        let usage =
            |message: String| Err(WrongUsage { command: &["job"], kind: ErrorKind::ValueValidation, message }.into());
        if standard_input::is_meant(&self.path) {
            return usage("a job needs a scenario or a plan that can be read again, not standard input".into());
        }
        let path = std::path::absolute(&self.path)?;
        let words = ["bake".into(), path.clone().into_os_string(), "--part-of".into(), "parts".into()];
        let words = words.into_iter().chain(self.options.iter().map(Into::into));
        let bake = Line::try_parse_from(words).unwrap_or_else(|error| error.exit()).bake;
        // Mistakes in it are told now, not by every machine.
        let days = bake.read(self.days)?.days;
        if self.parts > days {
            return usage(format!("{} parts of {days} days; allowed are 1 to {days}", self.parts));
        }
        let mut files: Vec<(PathBuf, String)> = Vec::new();
        if let Some(folder) = &self.openjd {
            files.push((folder.join("template.yaml"), self.fill(OPENJD, days, &path, Language::Yaml)));
        }
        if let Some(folder) = &self.slurm {
            files.extend(SLURM.map(|(name, text)| (folder.join(name), self.fill(text, days, &path, Language::Shell))));
        }
        let planned = files.iter().map(|(file, _)| {
            fs::create_dir_all(file.parent().unwrap_or(Path::new(".")))?;
            Ok(plan_file(file, self.force, std::slice::from_ref(&path))?)
        });
        let planned = planned.collect::<anyhow::Result<Vec<_>>>()?;
        for (file, (_, text)) in planned.into_iter().zip(&files) {
            save(text.as_bytes(), file)?;
        }
        if !common.quiet {
            self.tell(path.parent().unwrap_or(Path::new("/")))?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Fills in what a file leaves open.
    fn fill(&self, text: &str, days: u32, path: &Path, language: Language) -> String {
        let of = |name: Option<&std::ffi::OsStr>| name.unwrap_or_default().to_string_lossy().into_owned();
        // A farm brings the scenario's folder to its machines; a cluster shares it.
        let (scenario, quoted): (String, fn(&str) -> String) = match language {
            Language::Yaml => (of(path.file_name()), yaml),
            Language::Shell => (path.to_string_lossy().into_owned(), shell),
        };
        let option = |option: &String| match language {
            Language::Yaml => format!("            - {}\n", quoted(option)),
            Language::Shell => format!(" {}", quoted(option)),
        };
        text.replace("@NAME@", &quoted(&format!("trodden {}", of(path.file_stem()))))
            .replace("@SCENARIO@", &quoted(&scenario))
            .replace("@DAYS@", &days.to_string())
            .replace("@PARTS@", &self.parts.to_string())
            .replace("@LAST@", &(self.parts - 1).to_string())
            .replace("@CHUNK@", &days.div_ceil(self.parts).to_string())
            .replace("@OPTIONS@", &self.options.iter().map(option).collect::<String>())
    }

    /// How to start the job.
    fn tell(&self, inputs: &Path) -> anyhow::Result<()> {
        if let Some(folder) = &self.openjd {
            let (template, inputs) = (folder.join("template.yaml"), shell(&format!("Inputs={}", inputs.display())));
            print::line(format!(
                "{0} is done; on this machine:\n  openjd run {0} --step Merge --run-dependencies -p {inputs} -p \"Parts=$PWD/out/parts\" -p \"Output=$PWD/out/bake\"",
                template.display()
            ))?;
        }
        if let Some(folder) = &self.slurm {
            print::line(format!("{0} is done; to start it:\n  sh {0}/submit", folder.display()))?;
        }
        Ok(())
    }
}

/// Language of a file that a job writes.
#[derive(Clone, Copy)]
enum Language {
    Yaml,
    Shell,
}

/// A text in quotes that YAML and JSON share.
fn yaml(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// A word of a shell.
fn shell(text: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        text.to_string()
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}
