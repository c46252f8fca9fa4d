//! What the program answers to mistakes, and its exit codes.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use std::process::Command;

/// Exit code for a command line that cannot be understood.
const USAGE: i32 = 2;

/// Exit code, standard output and error output.
fn answer(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_uam")).args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn mistakes_are_named_with_what_is_allowed() {
    let cases: [(&[&str], i32, &str); 13] = [
        (&["simulate", "4.3x"], 1, "did you mean `4.3"),
        (&["simulate", "hover"], 1, "there is no scenario `hover`"),
        (&["simulate", "4.3a", "--step", "-0.001"], 1, "the communication step must be a number of seconds from"),
        (&["simulate", "4.3a", "--step", "nan"], 1, "but is NaN"),
        (&["simulate", "4.3a", "--stop", "0"], 1, "the stop time must be"),
        (&["build", "--links", "7"], USAGE, "1 to 6 links, not 7"),
        (&["build", "--links", "x"], USAGE, "1 to 6 links"),
        (&["build", "--scenario", "4.3x"], 1, "did you mean `4.3"),
        (&["build", "--scenario", "none.toml"], 1, "cannot read none.toml"),
        (&["build", "--scenario", "4.3a", "--links", "2"], USAGE, "cannot be used with"),
        (&["fly"], USAGE, "unrecognized subcommand"),
        (&["simulate"], USAGE, "<SCENARIO>"),
        (&["completions", "abacus"], USAGE, "zsh"),
    ];
    for (arguments, expected_code, expected) in cases {
        let (code, _, error) = answer(arguments);
        assert_eq!(code, Some(expected_code), "{arguments:?}");
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
}

/// Error output of a command that must be refused before anything is built.
#[track_caller]
fn refusal(arguments: &[&str]) -> String {
    let (code, _, error) = answer(arguments);
    assert_eq!(code, Some(1), "{arguments:?}");
    assert!(!error.contains("fmi2") && !error.contains("panicked"), "{arguments:?}: {error}");
    error
}

/// The parameter is named that is to blame, in its user's words, whatever the command.
#[test]
fn mistakes_in_numbers_and_methods_name_their_parameters() {
    let cases: [(&[&str], &str); 14] = [
        (&["vary", "4.3b", "gravity=nan"], "`gravity` must be a finite number, at least 0 [m/s2], but is nan"),
        (&["vary", "4.3b", "mount.x=-inf"], "`mount.x` must be a finite number [m], but is -inf"),
        (&["vary", "4.3b", "sample_time=1e5"], "sample_time = 100000.0 makes a simulation impossible"),
        (&["vary", "4.3b", "uav.inertia=1e-9"], "uav.inertia = 1e-9 makes a simulation impossible"),
        (&["vary", "4.3b", "link[2].length=1e300"], "link[2].length = 1e300 makes a simulation impossible"),
        (
            &["vary", "2.1a", "ik.resolution=extended_jacobian"],
            "ik.resolution = extended_jacobian does not go together",
        ),
        (&["vary", "4.3b", "ik.path_axes=horizontal"], "ik.path_axes = horizontal does not go together"),
        (&["vary", "4.3b", "external_reference.x=1"], "`external_reference.x` is an input of uam_controller"),
        (&["reach", "reference.leg[1].dx=0"], "reference.leg[1].dx = 0 does not go together"),
        (&["reach", "reference.leg[1].duration=0"], "reference.leg[1].duration = 0 does not go together"),
        (&["reach", "reference.kind=circle"], "reference.kind = circle does not go together"),
        (&["reach", "reference.kind=external"], "reference.kind = external does not go together"),
        (&["reach", "gravity=NaN"], "`gravity` must be a finite number"),
        (&["vary", "4.3b", "reference.leg[*].dz=1"], "did you mean `reference.leg[1].d"),
    ];
    for (arguments, expected) in cases {
        let error = refusal(arguments);
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
}

#[test]
fn mistakes_in_files_are_named_with_their_file_and_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    for (line, expected) in [
        ("parameters.uav.inertia = 1e-9", "uav.inertia = 1e-9 makes a simulation impossible"),
        ("parameters.sample_time = 1e5", "sample_time = 100000.0 makes a simulation impossible"),
        ("parameters.uav.mass = 1\nparameters.uav.mass = 2", "line 4: `parameters.uav.mass` stands in line 3 already"),
        ("link[1].mass = 2", "line 3: names with brackets need quotes: `\"link[1].mass\" = 2`"),
        ("parameters.grasp = true", "line 3: `grasp` is an input of uam_plant"),
        ("parameters.ik.path_axes = 'horizontal'", "line 3: ik.path_axes = horizontal does not go together"),
    ] {
        std::fs::write(&file, format!("id = 'mine'\nbased_on = '4.3b'\n{line}\n")).unwrap();
        let error = refusal(&["simulate", file.to_str().unwrap(), "--out", folder.path().to_str().unwrap()]);
        assert!(error.contains(expected), "{line}: {error}");
        assert!(!expected.starts_with("line") || error.contains("mine.toml"), "{line}: {error}");
    }
}

#[test]
fn help_teaches_with_examples() {
    let (code, help, _) = answer(&["--help"]);
    assert_eq!(code, Some(0));
    assert!(help.contains("Examples:") && help.contains("uam simulate 4.3a"), "{help}");
    assert!(!help.contains('\u{1b}'), "no control characters where there is no terminal: {help}");
    assert!(!help.contains("describe"), "what only developers need is not shown: {help}");
}

#[test]
fn shells_learn_the_commands() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let (code, script, _) = answer(&["completions", shell]);
        assert_eq!(code, Some(0));
        assert!(script.contains("simulate") && script.contains("discretization"), "{shell}: {script}");
    }
}

/// Outside of the sources, which the test says by the folder and without what cargo says of itself.
fn elsewhere(arguments: &[&str]) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_uam"));
    command.args(arguments).current_dir(folder.path()).env_remove("CARGO_MANIFEST_DIR");
    let output = command.output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn other_platforms_ask_for_the_sources() {
    for arguments in [&["build", "--platforms", "win64"][..], &["build", "--platforms", "win64", "--sources", "."]] {
        let (code, error) = elsewhere(arguments);
        assert_eq!(code, Some(1), "{arguments:?}");
        assert!(error.contains("--sources") && error.contains("were not found"), "{arguments:?}: {error}");
    }
    let (code, error) = elsewhere(&["build", "--platforms", "win64", "--sources", "no/such/folder"]);
    assert_eq!(code, Some(1));
    assert!(error.contains("no/such/folder"), "{error}");
}

#[test]
fn the_quiet_say_nothing_but_results() {
    let folder = tempfile::tempdir().unwrap();
    let export = |quiet: &[&str]| {
        let arguments = [&["export", "4.3a", "--out", folder.path().to_str().unwrap()], quiet].concat();
        let (code, out, error) = answer(&arguments);
        assert_eq!((code, error.as_str()), (Some(0), ""));
        out
    };
    assert!(export(&[]).contains("Written:"));
    assert_eq!(export(&["--quiet"]), "");
    let (_, list, _) = answer(&["list", "-q"]);
    assert!(list.contains("4.3a"), "a list is a result");
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
    let output = Command::new(env!("CARGO_BIN_EXE_uam")).arg("list").stdout(writer).output().unwrap();
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
}
