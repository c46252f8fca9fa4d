//! Pairs of FMUs, built once per test program.

#![allow(dead_code, reason = "every test takes what it needs")]

pub mod emulators;

use std::path::Path;
use std::sync::Mutex;

use fmu_build::host::coupling::Pair;
use fmu_build::{BuildOptions, Built, build};
use uam::Structure;

/// Built so far.
static PAIRS: Mutex<Vec<(Structure, &'static Pair)>> = Mutex::new(Vec::new());

/// The two FMUs of a vehicle, loaded. Each is built once per test program, and stays.
pub fn pair_of(structure: Structure) -> &'static Pair {
    let mut pairs = PAIRS.lock().unwrap();
    if let Some((_, pair)) = pairs.iter().find(|(built, _)| *built == structure) {
        return pair;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(env!("CARGO_CRATE_NAME"));
    let folder = folder.join(structure.to_string().replace(' ', "-"));
    let Built { controller, plant, .. } = build(&BuildOptions::new(structure, folder), &|_| {}).unwrap();
    let pair: &'static Pair = Box::leak(Box::new(Pair::open(&controller, &plant).unwrap()));
    pairs.push((structure, pair));
    pair
}

/// The two FMUs of the default vehicle, loaded.
pub fn pair() -> Pair {
    pair_of(Structure::DEFAULT).clone()
}
