//! Both units beside what else could be used: MuJoCo, Pinocchio, DAQP, Clarabel, and FMPy as a master.
//!
//!     bash fmu-build/benches/peers/run
//!
//! fetches and compiles the peers, and then runs this program; without them, it measures what is there.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a benchmark that cannot start has nothing to say")]
use std::path::{Path, PathBuf};

use clap::Parser;
use fmu_build::host::coupling::Pair;
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

/// Measures both units beside other programs, and prints tables.
#[derive(Parser)]
struct Arguments {
    /// How often everything is measured
    #[arg(long, value_name = "NUMBER", default_value_t = 15, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Cargo says so to every benchmark
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() {
    let Arguments { rounds, .. } = Arguments::parse();
    let rounds = rounds as usize;
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
