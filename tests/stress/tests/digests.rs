//! Where only code moves, no bit changes: digests of random couplings of all structures and methods, as they are under
//! version control.
//!
//! If results are meant to change: `UAM_REGENERATE=1 cargo test -p stress --test digests`, and the commit says which and
//! why.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::path::PathBuf;
use std::process::Command;
use std::{env, fs};

use fmu_build::{BuildOptions, build};
use uam::Structure;

const PROGRAM: &str = env!("CARGO_BIN_EXE_stress");
/// A line for each coupling: its number, its digest, what it is.
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/digests.txt");

#[test]
fn random_couplings_give_the_digests_under_version_control() {
    let folder = PathBuf::from(PROGRAM).parent().unwrap().join("stress-fmus-of-digests");
    build(&BuildOptions::new(Structure::DEFAULT, folder.clone()), &|_| ()).unwrap_or_else(|error| panic!("{error}"));
    let output =
        Command::new(PROGRAM).arg(folder).args(["--digests", "--couplings", "300", "--seed", "13"]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let found = String::from_utf8(output.stdout).unwrap();
    if env::var_os("UAM_REGENERATE").is_some() {
        fs::write(FILE, &found).unwrap();
    }
    print!("{found}");
    let expected = fs::read_to_string(FILE).unwrap();
    let other: Vec<_> = expected.lines().zip(found.lines()).filter(|(expected, found)| expected != found).collect();
    assert!(
        other.is_empty() && expected.lines().count() == found.lines().count(),
        "{} of 300 couplings give other bits than in tests/stress/digests.txt; (there, now): {:#?}\n\
         If the change is meant: UAM_REGENERATE=1 cargo test -p stress --test digests",
        other.len(),
        &other[..other.len().min(5)]
    );
}
