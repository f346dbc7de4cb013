//! What the program says about itself.

use snapbox::{assert_data_eq, file, str};

use super::sandbox::Sandbox;

#[test]
fn every_help_text_is_as_it_is_kept() {
    let sandbox = Sandbox::new();
    for (arguments, kept) in [
        (vec!["--help"], file!["help/trodden.txt"]),
        (vec!["bake", "--help"], file!["help/bake.txt"]),
        (vec!["crowd", "--help"], file!["help/crowd.txt"]),
        (vec!["job", "--help"], file!["help/job.txt"]),
        (vec!["merge", "--help"], file!["help/merge.txt"]),
        (vec!["resolve", "--help"], file!["help/resolve.txt"]),
        (vec!["look", "fit", "--help"], file!["help/look_fit.txt"]),
        (vec!["init", "--help"], file!["help/init.txt"]),
        (vec!["inspect", "--help"], file!["help/inspect.txt"]),
        (vec!["edit", "--help"], file!["help/edit.txt"]),
        (vec!["patterns", "--help"], file!["help/patterns.txt"]),
        (vec!["patterns", "import", "--help"], file!["help/patterns_import.txt"]),
        (vec!["batch", "--help"], file!["help/batch.txt"]),
        (vec!["diff", "--help"], file!["help/diff.txt"]),
        (vec!["why", "--help"], file!["help/why.txt"]),
        (vec!["motion", "--help"], file!["help/motion.txt"]),
        (vec!["motion", "info", "--help"], file!["help/motion_info.txt"]),
        (vec!["motion", "convert", "--help"], file!["help/motion_convert.txt"]),
        (vec!["motion", "formation", "keys", "--help"], file!["help/motion_formation_keys.txt"]),
    ] {
        assert_data_eq!(sandbox.run(&arguments).succeeds().out, kept.raw());
    }
}

#[test]
fn shells_and_manuals_know_every_subcommand() {
    let sandbox = Sandbox::new();
    let names = [
        "bake", "crowd", "motion", "resolve", "look", "view", "why", "batch", "init", "inspect", "edit", "patterns",
        "diff",
    ];
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = sandbox.run(&["completions", shell]).succeeds().out;
        let missing: Vec<_> = names.iter().filter(|name| !script.contains(**name)).collect();
        assert!(missing.is_empty() && script.contains("texels-per-metre"), "{shell}: {missing:?}");
    }
    sandbox.run(&["man", "pages"]).succeeds();
    for name in names {
        let page = std::fs::read_to_string(sandbox.path(&format!("pages/trodden-{name}.1"))).expect("a page");
        assert!(page.contains(".SH OPTIONS"), "{name}: {page}");
    }
    assert!(sandbox.run(&["man"]).succeeds().out.contains(".TH trodden 1"));
}

#[test]
fn without_arguments_help_goes_to_standard_error() {
    let sandbox = Sandbox::new();
    let ran = sandbox.run(&[]);
    assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""));
    assert!(ran.err.contains("Usage: trodden"), "{}", ran.err);
}

#[test]
fn the_version_is_the_crates() {
    let ran = Sandbox::new().run(&["--version"]).succeeds();
    assert_eq!(ran.out, format!("trodden {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn mistakes_of_the_command_line_are_explained() {
    let sandbox = Sandbox::new();
    let err = |arguments: &[&str]| sandbox.run(arguments).fails(2, &[]).err;
    assert_data_eq!(
        err(&["bake"]),
        str![[r#"
error: the following required arguments were not provided:
  <SCENARIO|PLAN>

Usage: trodden bake <SCENARIO|PLAN>

For more information, try '--help'.

"#]]
    );
    assert_data_eq!(
        err(&["bake", "plan.png", "--people", "-3"]),
        str![[r#"
error: invalid value '-3' for '--people <N>': allowed are whole numbers from 1 to 5000000

For more information, try '--help'.

"#]]
    );
    assert_data_eq!(
        err(&["bake", "plan.png", "--texels-per-metre", "nan"]),
        str![[r#"
error: invalid value 'nan' for '--texels-per-metre <T>': allowed is 1 to 1000

For more information, try '--help'.

"#]]
    );
    assert_data_eq!(
        err(&["bake", "plan.png", "--preset", "comuters"]),
        str![[r#"
error: invalid value 'comuters' for '--preset <NAME>'
  [possible values: commuters, heavy, wet, paper]

  tip: a similar value exists: 'commuters'

For more information, try '--help'.

"#]]
    );
    assert_data_eq!(
        err(&["backe", "plan.png"]),
        str![[r#"
error: unrecognized subcommand 'backe'

  tip: some similar subcommands exist: 'batch', 'bake'

Usage: trodden [OPTIONS] <COMMAND>

For more information, try '--help'.

"#]]
    );
}

#[test]
fn failures_are_explained() {
    let sandbox = Sandbox::new();
    sandbox.write("plan.toml", "[plan]\nimage = \"plan.png\"\n[crowd]\npeple = 10\n");
    let err = |arguments: &[&str]| sandbox.run(arguments).fails(1, &[]).err;
    assert_data_eq!(
        err(&["bake", "plan.toml"]),
        str![[r#"
error: [crowd] has no key `peple`
 --> plan.toml:4:1
  |
4 | peple = 10
  | ^^^^^
hint: did you mean `people`?

"#]]
    );
    assert_data_eq!(
        err(&["bake", "plan.png"]),
        str![[r#"
error: cannot read the plan plan.png: No such file or directory (os error 2)

"#]]
    );
    assert_data_eq!(
        err(&["bake", "other.toml"]),
        str![[r#"
error: cannot read the scenario other.toml: No such file or directory (os error 2)
hint: `trodden init PLAN` writes a scenario for a plan

"#]]
    );
}

#[test]
fn colour_is_for_terminals_and_for_those_who_ask() {
    let sandbox = Sandbox::new();
    let err = |arguments: &[&str]| sandbox.run(arguments).fails_in_colour();
    assert!(!err(&["bake", "plan.png"]).contains('\u{1b}'));
    assert!(!err(&["bake", "plan.png", "--color", "never"]).contains('\u{1b}'));
    assert!(err(&["bake", "plan.png", "--color", "always"]).contains('\u{1b}'));
}
