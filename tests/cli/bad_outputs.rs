//! Outputs that cannot be written.

use std::fs;

use super::sandbox::Sandbox;

/// A bake that takes next to no time.
const QUICK: [&str; 8] = ["bake", "plan.png", "--metres-per-pixel", "0.1", "--people", "5", "--quick", "-o"];

fn quick<'a>(more: &[&'a str]) -> Vec<&'a str> {
    QUICK.iter().chain(more).copied().collect()
}

#[test]
fn an_output_that_is_a_file_is_refused() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("out", "a file");
    sandbox.run(&quick(&["out"])).fails(1, &["out", "is a file", "--output"]);
    sandbox.run(&quick(&["out", "--force"])).fails(1, &["out", "is a file"]);
    sandbox.run(&quick(&["out/below"])).fails(1, &["out/below"]);
    sandbox.run(&quick(&["plan.png", "--force"])).fails(1, &["plan.png", "is a file"]);
}

#[test]
fn an_output_that_holds_something_else_is_never_replaced() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("out/thesis.tex", "three years of work");
    sandbox.run(&quick(&["out"])).fails(1, &["out", "not a bake", "thesis.tex", "--output"]);
    sandbox.run(&quick(&["out", "--force"])).fails(1, &["out", "not a bake", "thesis.tex"]);
    sandbox.run(&quick(&[".", "--force"])).fails(1, &[]);
    sandbox.run(&quick(&["/", "--force"])).fails(1, &["/"]);
    sandbox.run(&quick(&[""])).fails(2, &["--output"]);
}

#[test]
fn a_bake_is_replaced_with_force_only() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.run(&quick(&["out"])).succeeds();
    sandbox.run(&quick(&["out"])).fails(1, &["out", "earlier bake", "--force"]);
    let ran = sandbox.run(&quick(&["out", "--force", "--seed", "2"])).succeeds();
    assert!(ran.made().is_empty(), "{:?}", ran.made());
}

#[test]
fn an_empty_folder_is_taken() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    fs::create_dir(sandbox.path("out")).unwrap();
    sandbox.run(&quick(&["out"])).succeeds();
    assert!(sandbox.path("out/manifest.json").is_file());
}

#[cfg(unix)]
#[test]
fn an_output_that_may_not_be_written_is_refused() {
    use std::os::unix::fs::PermissionsExt;
    let sandbox = Sandbox::new();
    sandbox.plan();
    let locked = sandbox.path("locked");
    fs::create_dir(&locked).unwrap();
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o555)).unwrap();
    // Permissions do not stop the superuser: there the kernel's own file systems do.
    let superuser = fs::write(locked.join("probe"), "").is_ok();
    let output = if superuser { "/proc/trodden/out" } else { "locked/out" };
    if superuser {
        fs::remove_file(locked.join("probe")).unwrap();
    }
    sandbox.run(&quick(&[output])).fails(1, &[output]);
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o755)).unwrap();
}

/// A limit on the size of files stops a write halfway, as a full disk does.
#[cfg(unix)]
#[test]
fn a_write_that_fails_halfway_leaves_nothing() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    let script = "trap '' XFSZ; ulimit -f 2; exec \"$0\" \"$@\"";
    let mut command = std::process::Command::new("bash");
    command.args(["-c", script, env!("CARGO_BIN_EXE_trodden")]).args(quick(&["out"])).current_dir(sandbox.path(""));
    sandbox.run_command(&mut command).fails(1, &["cannot write", "out/"]);
}

/// A file system of 64 KiB, where the system lets us make one.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_said_to_be_full() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    fs::create_dir(sandbox.path("disk")).unwrap();
    let script = "mount -t tmpfs -o size=64k none disk || exit 77; \"$0\" \"$@\"; code=$?; ls -A disk; exit $code";
    let mut command = std::process::Command::new("unshare");
    command.args(["--user", "--map-root-user", "--mount", "bash", "-c", script, env!("CARGO_BIN_EXE_trodden")]);
    command.args(quick(&["disk/out"])).current_dir(sandbox.path(""));
    let Ok(output) = command.output() else { return };
    if !String::from_utf8_lossy(&output.stderr).starts_with("error: cannot write") {
        // No right to make file systems here; the test above stands in.
        assert!(matches!(output.status.code(), Some(1 | 77)), "{output:?}");
        assert!(!String::from_utf8_lossy(&output.stderr).contains("panicked"), "{output:?}");
        return;
    }
    sandbox.ran(sandbox.contents(), output).fails(1, &["disk/out", "hint: the disk is full"]);
}

#[test]
fn other_files_are_written_whole_or_not_at_all() {
    let sandbox = Sandbox::new();
    sandbox.plan();
    sandbox.write("mine.toml", "mine");
    sandbox.run(&["init", "plan.png", "-o", "mine.toml"]).fails(1, &["mine.toml exists", "--force"]);
    sandbox.run(&["init", "plan.png", "-o", "no/where.toml"]).fails(1, &["no/where.toml"]);
    let ran = sandbox.run(&["-q", "inspect", "plan.png", "--picture", "no/where.png"]);
    ran.fails(1, &["no/where.png"]);
    sandbox.run(&["-q", "patterns", "--picture", "."]).fails(1, &[]);
    sandbox.run(&["patterns", "nowhere"]).fails(1, &["nowhere", "patterns.toml", "hint: "]);
    sandbox.run(&["resolve", "nowhere", "--preset", "wet"]).fails(1, &["nowhere"]);
    sandbox.write("empty/x", "");
    sandbox.run(&["resolve", "empty", "--preset", "wet"]).fails(1, &["empty"]);
    sandbox.run(&["resolve", "empty", "--look", "nowhere.toml"]).fails(1, &["nowhere.toml"]);
}
