//! Numbers, counts and sizes that are absurd are refused with a message, never believed.

mod inputs;
mod manifests;
mod messages;
mod sizes;

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use super::sandbox::Sandbox;

/// How a run under watch ended.
struct Watched {
    code: Option<i32>,
    err: String,
    /// The most memory that was seen, MiB; 0 where the system does not tell.
    peak_mib: f64,
    seconds: f64,
}

/// Runs the program, and stops it after so many seconds: a test that shows a hang must not hang.
#[track_caller]
fn watched(sandbox: &Sandbox, arguments: &[&str], most_s: u64) -> Watched {
    let mut command: Command = sandbox.command(arguments);
    let mut child: Child = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let begin = Instant::now();
    let mut peak_mib: f64 = 0.0;
    let code = loop {
        peak_mib = peak_mib.max(peak_mib_of(child.id()));
        if let Some(status) = child.try_wait().unwrap() {
            break status.code();
        }
        if begin.elapsed() > Duration::from_secs(most_s) {
            child.kill().unwrap();
            panic!("{arguments:?} takes more than {most_s} s");
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    let mut err = String::new();
    std::io::Read::read_to_string(&mut child.stderr.take().unwrap(), &mut err).unwrap();
    Watched { code, err, peak_mib, seconds: begin.elapsed().as_secs_f64() }
}

fn peak_mib_of(process: u32) -> f64 {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok()).unwrap_or(0.0) / 1024.0
}
