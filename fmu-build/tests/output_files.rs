//! What commands write, what they leave alone, and what they say of it.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn run(out: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_uam"));
    command.args(arguments).arg("--out").arg(out).output().unwrap()
}

/// What a command that succeeds says.
#[track_caller]
fn said(out: &Path, arguments: &[&str]) -> String {
    let Output { status, stdout, stderr } = run(out, arguments);
    let [stdout, stderr] = [stdout, stderr].map(|text| String::from_utf8(text).unwrap());
    assert!(status.success(), "{arguments:?}: {stderr}");
    stdout + &stderr
}

const SHORT: [&str; 4] = ["--stop", "0.02", "--step", "0.01"];

/// The user's own vehicle stays what it is, whatever else is run: only `build` and the main command write FMUs.
#[test]
fn commands_use_fmus_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let own = ["uam_controller.fmu", "uam_plant.fmu", "uam.ssp"].map(|name| folder.path().join(name));
    own.iter().for_each(|path| fs::write(path, "of my own vehicle").unwrap());
    let simulate = [&["simulate", "4.3a"], &SHORT[..]].concat();
    let commands: [&[&str]; 6] = [
        &simulate,
        &["vary", "4.3a", "duration=0.01"],
        &["reach", "duration=0.01"],
        &["thesis"],
        &["export", "4.3a"],
        &["show", "4.3a"],
    ];
    for command in commands {
        said(folder.path(), command);
        for path in &own {
            assert_eq!(fs::read(path).unwrap(), b"of my own vehicle", "{command:?} wrote {}", path.display());
        }
        let folders = fs::read_dir(folder.path()).unwrap().filter(|entry| entry.as_ref().unwrap().path().is_dir());
        assert_eq!(folders.count(), 0, "{command:?} made a folder");
    }
}

/// A file with other content is not replaced without a word; the same content is not worth one.
#[test]
fn what_is_replaced_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let simulate = |stop: &str| said(folder.path(), &["simulate", "4.3a", "--step", "0.01", "--stop", stop]);
    assert!(!simulate("0.05").contains("replaced"));
    assert!(!simulate("0.05").contains("replaced"), "nothing has changed");
    let again = simulate("0.02");
    for name in ["4.3a.csv", "4.3a.html"] {
        let line = again.lines().find(|line| line.contains(name)).unwrap();
        assert!(line.contains("replaced a file of this name with other content"), "{again}");
    }
    fs::write(folder.path().join("4.3b.toml"), "mine").unwrap();
    let exported = said(folder.path(), &["export", "4.3b"]);
    let replaced: Vec<&str> = exported.lines().filter(|line| line.contains("replaced")).collect();
    assert!(matches!(replaced[..], [line] if line.contains("4.3b.toml")), "{exported}");
}

#[test]
fn the_file_that_a_simulation_is_read_from_is_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    let text = "# My comments.\nid = 'mine'\nbased_on = '4.3b'\n";
    fs::write(&file, text).unwrap();
    let output = run(folder.path(), &["export", file.to_str().unwrap()]);
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success() && error.contains("mine.toml") && error.contains("--out"), "{error}");
    assert_eq!(fs::read_to_string(&file).unwrap(), text);
}

/// Control characters reach no document, least of all XML, which cannot hold them.
#[test]
fn a_title_with_control_characters_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bell.toml");
    for character in ["\\u0007", "\\u001b[31m", "\\u0085", "\\uFFFE", "\\n"] {
        fs::write(&file, format!("id = 'mine'\ntitle = \"a{character}b\"\nbased_on = '4.3b'\n")).unwrap();
        let output = run(folder.path(), &["export", file.to_str().unwrap()]);
        let error = String::from_utf8(output.stderr).unwrap();
        assert!(!output.status.success() && error.contains("line 2: `title` must be one line"), "{error}");
    }
}

/// Where nothing can be written, that is an error and no panic.
#[test]
#[cfg(target_os = "linux")]
fn a_standard_output_that_takes_nothing_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let simulate = [&["simulate", "4.3a"], &SHORT[..]].concat();
    let commands: [&[&str]; 10] = [
        &["list"],
        &["completions", "bash"],
        &["show", "4.3b"],
        &["show", "--all", "4.3b"],
        &["--help"],
        &["build", "--help"],
        &["--version"],
        &["export", "4.3b"],
        &["vary", "4.3a", "duration=0.01"],
        &simulate,
    ];
    for command in commands {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut program = Command::new(env!("CARGO_BIN_EXE_uam"));
        let output = program.args(command).arg("--out").arg(folder.path()).stdout(full).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{command:?}: {error}");
        assert!(error.contains("error: cannot write to the standard output"), "{command:?}: {error}");
    }
    // Where not even the error can be told, the code does.
    let full = || Stdio::from(fs::OpenOptions::new().write(true).open("/dev/full").unwrap());
    for (command, code) in [(["show", "4.3x"], 1), (["fly", "away"], 2), (["show", "4.3a"], 1)] {
        let mut program = Command::new(env!("CARGO_BIN_EXE_uam"));
        let status = program.args(command).stdout(full()).stderr(full()).status().unwrap();
        assert_eq!(status.code(), Some(code), "{command:?}");
    }
}
