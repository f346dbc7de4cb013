//! Paths and names of files as people have them.

use std::fs;

use super::sandbox::{Ran, Sandbox, corridor};

/// Bakes a plan to a folder, twice.
fn bake(sandbox: &Sandbox, plan: &str, output: &str) -> Ran {
    corridor().save_with_format(sandbox.write(plan, ""), image::ImageFormat::Png).unwrap();
    let bake = ["bake", plan, "--metres-per-pixel", "0.1", "--people", "3", "--quick", "-o", output];
    let first = sandbox.run(&bake).succeeds();
    assert!(sandbox.path(output).join("manifest.json").is_file());
    let again = sandbox.run(&[&bake[..], &["--force", "--seed", "2"]].concat()).succeeds();
    assert!(again.made().is_empty(), "{:?}", again.made());
    sandbox.run(&["resolve", output, "--preset", "wet"]).succeeds();
    first
}

#[test]
fn spaces_quotes_and_letters_of_any_script() {
    let sandbox = Sandbox::new();
    let plan = "Pläne von 'nebenan' (1)/平面図 №1 – Грязь #2 100%.png";
    bake(&sandbox, plan, "out put/Ergebnis & \"é\" 🥾");
    sandbox.run(&["init", plan]).succeeds();
    sandbox.run(&["bake", &plan.replace(".png", ".toml"), "--quick", "--floor-only", "-o", "toml ☂"]).succeeds();
}

#[test]
fn names_as_long_as_the_system_allows() {
    let sandbox = Sandbox::new();
    bake(&sandbox, &("p".repeat(251) + ".png"), &"o".repeat(255));
    // The same beginning, another folder; letters of several bytes.
    bake(&sandbox, &("ß".repeat(125) + "x.png"), &("o".repeat(253) + "é"));
    let names = fs::read_dir(sandbox.path("")).unwrap().count();
    assert_eq!(names, 4, "two plans and two bakes, and nothing else");
}

#[cfg(unix)]
#[test]
fn inputs_that_may_only_be_read() {
    use std::os::unix::fs::PermissionsExt;
    let sandbox = Sandbox::new();
    corridor().save(sandbox.write("in/plan.png", "")).unwrap();
    sandbox.write("in/plan.toml", "[plan]\nimage = \"plan.png\"\nmetres_per_pixel = 0.1\n");
    let rights = |mode| fs::Permissions::from_mode(mode);
    for (name, mode) in [("in/plan.png", 0o444), ("in/plan.toml", 0o444), ("in", 0o555)] {
        fs::set_permissions(sandbox.path(name), rights(mode)).unwrap();
    }
    let ran = sandbox.run(&["bake", "in/plan.toml", "--quick", "--people", "3", "-o", "out"]).succeeds();
    assert!(ran.made().iter().all(|path| path.starts_with(sandbox.path("out"))), "{:?}", ran.made());
    fs::set_permissions(sandbox.path("in"), rights(0o755)).unwrap();
}

/// Names that are no text, as old archives leave them.
#[cfg(target_os = "linux")]
#[test]
fn names_that_are_no_text() {
    use std::os::unix::ffi::OsStrExt;
    let sandbox = Sandbox::new();
    let plan = sandbox.path("").join(std::ffi::OsStr::from_bytes(b"gr\xfcnd.png"));
    corridor().save_with_format(&plan, image::ImageFormat::Png).unwrap();
    let mut command = sandbox.command(&["bake", "--metres-per-pixel", "0.1", "--quick", "--people", "3", "-o", "out"]);
    sandbox.run_command(command.arg(&plan)).succeeds();
}
