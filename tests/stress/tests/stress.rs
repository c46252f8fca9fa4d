//! The program of this crate, on the FMUs of the present sources.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::OnceLock;

use fmu_build::{BuildOptions, build};
use uam::Structure;

const PROGRAM: &str = env!("CARGO_BIN_EXE_stress");

/// The folder with the FMUs; they are built if they are out of date.
fn fmus() -> &'static PathBuf {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let folder = PathBuf::from(PROGRAM).parent().unwrap().join("stress-fmus");
        build(&BuildOptions::new(Structure::DEFAULT, folder.clone()), &|_| ())
            .unwrap_or_else(|error| panic!("{error}"));
        folder
    })
}

fn full() -> bool {
    std::env::var_os("UAM_FULL").is_some_and(|value| !value.is_empty())
}

/// Whether all promises are kept, and all that is said of it.
fn play(options: &[&str]) -> (bool, String) {
    let Output { status, stdout, stderr } = Command::new(PROGRAM).arg(fmus()).args(options).output().unwrap();
    let said = [stdout, stderr].map(|text| String::from_utf8_lossy(&text).into_owned()).concat();
    assert!(said.contains("fingerprint "), "it did not come to an end: {status}\n{said}");
    (status.success(), said)
}

/// Every fingerprint that is printed.
fn fingerprints(said: &str) -> Vec<&str> {
    said.split("fingerprint ").skip(1).map(|rest| rest.split_whitespace().next().unwrap()).collect()
}

#[test]
fn every_promise_is_kept_in_random_couplings() {
    let couplings = if full() { "200000" } else { "20000" };
    let (kept, said) = play(&["--couplings", couplings, "--seed", "7"]);
    assert!(kept, "{said}");
    print!("{said}");
}

/// The same couplings give the same bits: in one thread or in eight, from the start or from the middle, in another process.
#[test]
fn the_same_couplings_give_the_same_bits() {
    let of = |options: &[&str]| {
        let (_, said) = play(&[&["--couplings", "60", "--from", "40"], options].concat());
        fingerprints(&said)[0].to_owned()
    };
    let once = of(&["--threads", "1"]);
    assert_eq!(of(&["--threads", "8"]), once);
    assert_ne!(of(&["--seed", "2"]), once, "the fingerprint depends on the couplings");
}

/// However the host rounds while it calls, the same bits come out.
#[test]
fn the_bits_do_not_depend_on_how_the_host_rounds() {
    let couplings = if full() { "5000" } else { "500" };
    let (_, said) = play(&["--couplings", couplings, "--environments", "--summary"]);
    let fingerprints = fingerprints(&said);
    let modes = if cfg!(target_arch = "x86_64") { 4 } else { 1 };
    assert_eq!(fingerprints.len(), modes, "{said}");
    assert!(fingerprints.iter().all(|one| *one == fingerprints[0]), "{said}");
}

/// What is written of a coupling is a scenario that other programs read.
#[test]
fn couplings_are_described_as_scenarios() {
    for number in 0..200 {
        let Output { stdout, .. } = Command::new(PROGRAM).args(["--describe", &number.to_string()]).output().unwrap();
        let text = String::from_utf8(stdout).unwrap();
        uam::scenarios::Scenario::read(&text).unwrap_or_else(|error| panic!("{number}: {error}\n{text}"));
    }
}
