//! Signals that ask a run to end.

#![cfg(unix)]

use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use super::super::sandbox::Sandbox;

const LONG: [&str; 9] = ["-q", "bake", "plan.png", "--metres-per-pixel", "0.1", "--people", "200000", "-o", "out"];

/// Starts a long bake, and waits until it is at work.
fn started(sandbox: &Sandbox, mut command: Command) -> Child {
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let start = Instant::now();
    while !sandbox.path(".out.new").exists() {
        assert!(child.try_wait().unwrap().is_none() && start.elapsed() < Duration::from_secs(20), "it never began");
        std::thread::sleep(Duration::from_millis(20));
    }
    std::thread::sleep(Duration::from_millis(300));
    child
}

fn send(signal: &str, child: &Child) {
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
}

/// Whether these tests, and all that they start, ignore a closed terminal.
fn hangup_is_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| u64::from_str_radix(line.strip_prefix("SigIgn:")?.trim(), 16).ok());
    mask.is_some_and(|mask| mask & 1 == 1)
}

/// SIGTERM and SIGHUP left the hidden folder behind. After Ctrl-C the program ended with 1, and the shell's loop went on.
#[test]
fn a_bake_cleans_up_and_ends_by_its_signal() {
    // Tests that run under nohup cannot try the hangup: the program is to ignore it then.
    let hangup = (!hangup_is_ignored()).then_some(("-HUP", 1));
    for (signal, number) in [("-INT", 2), ("-TERM", 15)].into_iter().chain(hangup) {
        let sandbox = Sandbox::new();
        sandbox.plan();
        let before = sandbox.contents();
        let child = started(&sandbox, sandbox.command(&LONG));
        send(signal, &child);
        let output = child.wait_with_output().unwrap();
        assert_eq!((output.status.code(), output.status.signal()), (None, Some(number)), "{output:?}");
        sandbox.ran(before, output).fails(128 + number, &["interrupted"]);
    }
}

/// `nohup` is there so that a closed terminal does not end the program.
#[test]
fn a_bake_goes_on_where_a_hangup_is_ignored() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let mut command = Command::new("sh");
    command.args(["-c", "trap '' HUP; exec \"$0\" \"$@\""]).arg(sandbox.command(&[]).get_program()).args(LONG);
    command.current_dir(sandbox.path(""));
    let mut child = started(&sandbox, command);
    send("-HUP", &child);
    std::thread::sleep(Duration::from_millis(500));
    assert!(child.try_wait().unwrap().is_none(), "it ended by the hangup");
    send("-TERM", &child);
    assert_eq!(child.wait().unwrap().signal(), Some(15));
}

/// A file that grew beyond the limit of its size killed the program by SIGXFSZ, and the hidden folder stayed.
#[test]
fn a_limit_on_the_size_of_files_is_an_error_of_the_write() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let script = "ulimit -c 0; ulimit -f 2; exec \"$0\" \"$@\"";
    let arguments =
        ["bake", "plan.png", "--metres-per-pixel", "0.1", "--people", "3", "--quick", "--floor-only", "-o", "out"];
    let mut command = Command::new("bash");
    command.args(["-c", script]).arg(sandbox.command(&[]).get_program()).args(arguments).current_dir(sandbox.path(""));
    sandbox.run_command(&mut command).fails(1, &["cannot write", "out/"]);
}
