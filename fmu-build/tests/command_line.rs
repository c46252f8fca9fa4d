//! What the program answers to mistakes, and its exit codes.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use std::process::Command;

/// Exit code, standard output and error output.
fn answer(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_fmu-build")).args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn mistakes_are_named_with_what_is_allowed() {
    let cases: [(&[&str], &str); 11] = [
        (&["simulate", "4.3x"], "did you mean `4.3"),
        (&["simulate", "hover"], "there is no scenario `hover`"),
        (&["simulate", "4.3a", "--step", "-0.001"], "the communication step must be a number of seconds from"),
        (&["simulate", "4.3a", "--step", "nan"], "but is NaN"),
        (&["simulate", "4.3a", "--stop", "0"], "the stop time must be"),
        (&["build", "--links", "7"], "1 to 6 links, not 7"),
        (&["build", "--links", "x"], "1 to 6 links"),
        (&["build", "--scenario", "4.3x"], "did you mean `4.3"),
        (&["build", "--scenario", "none.toml"], "cannot read none.toml"),
        (&["build", "--scenario", "4.3a", "--links", "2"], "cannot be used with"),
        (&["fly"], "unrecognized subcommand"),
    ];
    for (arguments, expected) in cases {
        let (code, _, error) = answer(arguments);
        assert_eq!(code, Some(1), "{arguments:?}");
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
}

#[test]
fn help_teaches_with_examples() {
    let (code, help, _) = answer(&["--help"]);
    assert_eq!(code, Some(0));
    assert!(help.contains("Examples:") && help.contains("simulate 4.3a"), "{help}");
}

#[test]
fn every_scenario_has_a_line() {
    let (code, list, _) = answer(&["list"]);
    assert_eq!(code, Some(0));
    assert_eq!(list.lines().count(), uam::scenarios::catalogue().unwrap().len());
}

#[test]
#[cfg(unix)]
fn who_reads_no_further_gets_no_error() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let output = Command::new(env!("CARGO_BIN_EXE_fmu-build")).arg("list").stdout(writer).output().unwrap();
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
}
