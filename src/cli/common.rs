use clap::{Args, ColorChoice};

/// What every subcommand takes.
#[derive(Args)]
#[command(next_help_heading = "Common options")]
pub struct Common {
    /// Say nothing but errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Say more: seconds of each stage, memory
    #[arg(short, long, global = true)]
    pub verbose: bool,
    /// How many threads work, 1 to 256; all results are the same for any number [default: all cores]
    #[arg(long, global = true, value_name = "N", allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=256))]
    pub threads: Option<u16>,
    /// When to colour messages
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    pub color: ColorChoice,
    /// Long flags of the subcommand, without dashes.
    #[arg(skip)]
    pub flags: Vec<String>,
}

impl Common {
    /// Starts the threads that all work shares.
    pub fn start_threads(&self) -> anyhow::Result<()> {
        let threads = self.threads.map_or(0, usize::from);
        Ok(rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?)
    }
}
