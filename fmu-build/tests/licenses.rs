//! The FMUs name everything that is compiled into their libraries, and its licence.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::collections::{BTreeSet, HashSet};
use std::env;
use std::process::Command;

use fmu_build::package::contents::THIRD_PARTY;
use fmu_build::workspace;

/// The packages in the libraries of both units, each with its licence: what is needed at run time, not what compiles.
fn packages() -> BTreeSet<(String, String)> {
    let output = Command::new(env::var_os("CARGO").unwrap())
        .current_dir(workspace::root().unwrap())
        .args(["tree", "--locked", "--package", "uam_plant", "--package", "uam_controller"])
        .args(["--edges", "normal,no-proc-macro", "--prefix", "none", "--format", "{p}|{l}"])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let lines = text.lines().filter_map(|line| line.trim_end_matches(" (*)").split_once('|'));
    lines.map(|(name, license)| (name.split(' ').next().unwrap().to_owned(), license.to_owned())).collect()
}

#[test]
fn what_is_by_others_is_named_with_a_licence_that_it_offers() {
    let words = |text: &str| -> HashSet<String> {
        text.split(|c: char| !(c.is_alphanumeric() || "-_".contains(c))).map(str::to_owned).collect()
    };
    let (apache, bsd) = THIRD_PARTY.split_once("Under the BSD").unwrap();
    let (bsd, mit) = bsd.split_once("Under the MIT").unwrap();
    let [apache, bsd, mit] = [apache, bsd, mit].map(words);
    let packages = packages();
    assert!(packages.iter().any(|(name, _)| name == "nalgebra"));
    for (name, license) in packages.iter().filter(|(name, _)| !name.starts_with("uam")) {
        let named = match license.as_str() {
            license if license.contains("Apache-2.0") => &apache,
            "BSD-3-Clause" => &bsd,
            "MIT" => &mit,
            _ => panic!("{name}: {license}"),
        };
        assert!(named.contains(name), "modelDescription/THIRD-PARTY does not name {name} ({license})");
    }
}
