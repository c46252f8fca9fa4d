//! Both units beside what else could be used: MuJoCo, Pinocchio, DAQP, Clarabel, and FMPy as a master.
//!
//!     bash fmu-build/benches/peers/run
//!
//! fetches and compiles the peers, and then runs this program; without them, it measures what is there.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a benchmark that cannot start has nothing to say")]
use std::path::{Path, PathBuf};

use fmu_build::coupling::Pair;
use fmu_build::{BuildOptions, build};
use uam::Structure;

mod coupled;
mod kinematics;
mod library;
mod measure;
mod plant;
mod program;
mod table;

use measure::{Contest, Spread, measure};
use table::Page;

const ROUNDS: usize = 15;

fn main() {
    let rounds = rounds(std::env::args().skip(1)).unwrap_or_else(|complaint| {
        eprintln!("error: {complaint}");
        std::process::exit(2)
    });
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("peers");
    let built = build(&BuildOptions::new(Structure::DEFAULT, &folder), &|_| {}).unwrap();
    let pair = Pair::open(&built.controller, &built.plant).unwrap();

    let mut page = Page::new(rounds);
    let mut contests: Vec<Contest<'_>> = plant::contests(&pair, &folder);
    contests.push(kinematics::contest(&pair));
    contests.push(program::contest("Quadratic program of 3 rates, limits bind", 3));
    contests.push(program::contest("Quadratic program of 6 rates, limits bind", 6));
    for contest in &mut contests {
        let measured = measure(contest, rounds);
        page.add(contest.title, &measured);
    }
    let mut contest = coupled::contest(&pair);
    let native = measure(&mut contest, rounds).into_iter().map(|row| (row.name, row.time.inverse()));
    let rows: Vec<(String, Spread)> = native.chain(coupled::in_fmpy(&pair, rounds)).collect();
    page.add_times_real_time(contest.title, &rows);

    let place = std::env::var_os("PEERS").map_or(folder, PathBuf::from).join("peers.md");
    std::fs::write(&place, page.text()).unwrap();
    println!("Written: {}", place.display());
}

/// The number of rounds that the command line asks for. Cargo adds `--bench`.
fn rounds(arguments: impl Iterator<Item = String>) -> Result<usize, String> {
    let mut arguments = arguments.filter(|argument| argument != "--bench");
    match (arguments.next().as_deref(), arguments.next(), arguments.next()) {
        (None, ..) => Ok(ROUNDS),
        (Some("--rounds"), Some(number), None) => {
            number.parse().ok().filter(|&number| number > 0).ok_or(format!("there cannot be {number} rounds"))
        }
        (Some(argument), ..) => Err(format!("there is no option `{argument}`; there is --rounds N")),
    }
}
