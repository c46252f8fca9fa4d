//! Pairs of FMUs, built once per test program.

#![allow(dead_code, reason = "every test takes what it needs")]

use std::path::Path;
use std::sync::LazyLock;

use fmu_build::coupling::Pair;
use fmu_build::{BuildOptions, Built, build};
use uam::Structure;
use uam::parameters::Balance;

static BUILT: LazyLock<Built> = LazyLock::new(|| built(Structure::DEFAULT));
static TWO_LINKS: LazyLock<Built> = LazyLock::new(|| built(Structure::new(2, Balance::None).unwrap()));

fn built(structure: Structure) -> Built {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(env!("CARGO_CRATE_NAME"));
    let folder = folder.join(structure.to_string().replace(' ', "-"));
    build(&BuildOptions::new(structure, folder), &|_| {}).unwrap()
}

/// The two FMUs of a vehicle with two links, loaded.
pub fn two_links() -> Pair {
    Pair::open(&TWO_LINKS.controller, &TWO_LINKS.plant).unwrap()
}

/// The two FMUs of the default vehicle, loaded.
pub fn pair() -> Pair {
    Pair::open(&BUILT.controller, &BUILT.plant).unwrap()
}
