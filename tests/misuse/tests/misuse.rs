//! The program of this crate, on the FMUs of the default structure and of one with a counterweight.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::Mutex;

use fmu_build::{BuildOptions, build};
use uam::Structure;
use uam::parameters::Balance;

const PROGRAM: &str = env!("CARGO_BIN_EXE_misuse");

/// The folder with the FMUs of a structure; they are built if they are out of date.
fn fmus(structure: Structure) -> PathBuf {
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    let _one = ONE_AT_A_TIME.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let folder = PathBuf::from(PROGRAM).parent().unwrap().join("misuse-fmus").join(structure.to_string());
    build(&BuildOptions::new(structure, folder.clone()), &|_| ()).unwrap_or_else(|error| panic!("{error}"));
    folder
}

fn full() -> bool {
    std::env::var_os("UAM_FULL").is_some_and(|value| !value.is_empty())
}

/// Runs a program; what it prints.
fn run(command: &mut Command) -> String {
    let Output { status, stdout, stderr } = command.output().unwrap();
    let (said, complained) = (String::from_utf8_lossy(&stdout), String::from_utf8_lossy(&stderr));
    assert!(status.success(), "{command:?}: {status}\n{said}\n{complained}");
    said.into_owned()
}

fn play(structure: Structure, options: &[&str]) -> String {
    run(Command::new(PROGRAM).arg(fmus(structure)).args(options))
}

/// What a run says of the answers: per unit, the fingerprint.
fn fingerprints(said: &str) -> Vec<&str> {
    let found: Vec<_> =
        said.split("fingerprint ").skip(1).map(|rest| rest.split_whitespace().next().unwrap()).collect();
    assert_eq!(found.len(), 2, "{said}");
    found
}

#[test]
fn no_sequence_of_calls_does_harm() {
    let sequences = if full() { "1000000" } else { "100000" };
    let said = play(Structure::DEFAULT, &["--sequences", sequences]);
    fingerprints(&said);
    print!("{said}");
}

#[test]
fn nor_with_a_counterweight() {
    let structure = Structure::new(3, Balance::Counterweight).unwrap();
    fingerprints(&play(structure, &["--sequences", "5000", "--seed", "2"]));
}

/// The same calls get the same answers, bit by bit: in one thread or in eight, at once or after other use of the
/// libraries, in another process.
#[test]
fn the_same_calls_get_the_same_answers() {
    let once = play(Structure::DEFAULT, &["--sequences", "4000", "--threads", "1"]);
    let in_threads = play(Structure::DEFAULT, &["--sequences", "4000", "--threads", "8"]);
    let after_others = play(Structure::DEFAULT, &["--sequences", "4000", "--threads", "3", "--after", "3000"]);
    assert_eq!(fingerprints(&in_threads), fingerprints(&once));
    assert_eq!(fingerprints(&after_others), fingerprints(&once));
    let others = play(Structure::DEFAULT, &["--sequences", "4000", "--seed", "3"]);
    assert_ne!(fingerprints(&others), fingerprints(&once), "the fingerprint depends on the calls");
}

/// Whatever the host has set its processor to: how it rounds, what becomes of tiny numbers, which exceptions it traps.
/// The program checks that every call, and every message, leaves that as it was, and that no flag is raised.
#[test]
fn answers_do_not_depend_on_the_hosts_floating_point_environment() {
    let play = |environment, what: [&str; 2]| {
        play(Structure::DEFAULT, &["--environment", environment, "--seed", "4", what[0], what[1]])
    };
    let sequences = ["--sequences", if full() { "20000" } else { "1000" }];
    let usual = play("usual", sequences);
    for environment in ["up", "down", "zero", "flush", "trap", "hostile"] {
        assert_eq!(fingerprints(&play(environment, sequences)), fingerprints(&usual), "{environment}");
        play(environment, ["--instances", "20"]);
    }
    play("hostile", ["--forgeries", "50"]);
    play("hostile", ["--starts", "50"]);
}

/// What a unit reads is refused or does no harm: states with any content behind a checksum that is right, start files
/// with any values behind a GUID that is right.
#[test]
fn nothing_that_is_read_does_harm() {
    let (forgeries, starts) = if full() { ("50000", "10000") } else { ("2000", "500") };
    for options in [["--forgeries", forgeries], ["--starts", starts]] {
        let said = play(Structure::DEFAULT, &options);
        assert_eq!(said.lines().count(), 2, "one line for each unit: {said}");
        for line in said.lines() {
            let numbers: Vec<f64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
            let [tried, accepted, ..] = numbers[..] else { panic!("{line}") };
            assert!((0.05..0.95).contains(&(accepted / tried)), "both ways are gone: {line}");
        }
    }
}

/// Neither a leak nor an access outside of what is allocated, in instances that live as they should and in some
/// random sequences.
#[test]
fn valgrind_finds_nothing() {
    if Command::new("valgrind").arg("--version").output().is_err() {
        println!("skipped: valgrind");
        return;
    }
    let folder = fmus(Structure::DEFAULT);
    let (instances, sequences) = if full() { ("10000", "1000") } else { ("1000", "100") };
    for options in [["--instances", instances], ["--sequences", sequences]] {
        let checks = [
            "--quiet",
            "--error-exitcode=9",
            "--leak-check=full",
            "--show-leak-kinds=definite",
            "--errors-for-leak-kinds=definite",
        ];
        run(Command::new("valgrind").args(checks).arg(PROGRAM).arg(&folder).args(options));
    }
}
