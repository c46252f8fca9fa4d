//! Plays random couplings of both FMUs through their C functions and checks what the controller promises: vehicles,
//! methods, paths, clocks, jumps, limits and roll-backs at random. Each follows from its number and the seed alone.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail like a test")]
#![allow(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "small numbers"
)]

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use misuse::unit::Unit;
use misuse::{crowd, watch};

mod case;
mod checks;
mod course;
mod draw;
mod environment;
mod pair;
mod play;
mod report;
mod seen;

use case::Case;
use environment::Environment;
use play::Player;
use report::Report;

/// Plays random couplings of the FMUs, and checks what the controller promises.
///
/// Ends with an error if a promise is broken, with the numbers of the first couplings that do, by promise, resolution
/// and clock.
#[derive(Parser)]
struct Options {
    /// Folder with uam_controller.fmu and uam_plant.fmu of any structure; without it they are built.
    #[arg(value_name = "FOLDER")]
    folder: Option<PathBuf>,
    /// How many couplings to play.
    #[arg(long, value_name = "NUMBER", default_value_t = 2000)]
    couplings: u64,
    /// Number of the first coupling.
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    from: u64,
    /// Other seeds, other couplings.
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    seed: u64,
    /// Play one of them, by its number.
    #[arg(long, value_name = "NUMBER")]
    only: Option<u64>,
    /// Threads that play at a time.
    #[arg(long, value_name = "NUMBER", default_value_t = 2, value_parser = clap::value_parser!(u16).range(1..=64))]
    threads: u16,
    /// Say what each coupling is, in one line, and play none.
    #[arg(long)]
    list: bool,
    /// Write one of them as a scenario file, and play none.
    #[arg(long, value_name = "NUMBER")]
    describe: Option<u64>,
    /// Tell broken promises as a table by promise, resolution and clock, without examples.
    #[arg(long)]
    summary: bool,
    /// With --only: print every communication point.
    #[arg(long, requires = "only")]
    trace: bool,
    /// Print a digest of all values of each coupling, bit by bit, and check nothing.
    #[arg(long, conflicts_with_all = ["environments", "trace"])]
    digests: bool,
    /// Play all again in each rounding mode that a host can set; the fingerprints must be equal.
    #[arg(long)]
    environments: bool,
}

fn main() -> ExitCode {
    let options = Options::parse();
    match run(&options) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Whether all promises were kept.
fn run(options: &Options) -> Result<bool, String> {
    let numbers = options.only.map_or(options.from..options.from + options.couplings, |only| only..only + 1);
    if let Some(number) = options.describe {
        print!("{}", Case::draw(options.seed, number).describe());
        return Ok(true);
    }
    if options.list {
        numbers.for_each(|number| println!("{number}: {}", Case::draw(options.seed, number)));
        return Ok(true);
    }
    let units = units(options.folder.as_deref())?;
    watch::begin();
    if options.digests {
        let mut player = Player::new(&units, Environment::Usual, false);
        for number in numbers {
            let case = Case::draw(options.seed, number).varied();
            println!("{number} {} {case}", player.digest(&case)?);
        }
        return Ok(true);
    }
    let environments = if options.environments { Environment::ALL } else { &[Environment::Usual] };
    let mut fingerprints = Vec::new();
    let mut clean = true;
    for environment in environments {
        if options.environments {
            println!("rounding: {environment:?}");
        }
        let begin = Instant::now();
        let player = || Ok(Player::new(&units, *environment, options.trace));
        let play = |player: &mut Player<'_>, number| player.play(&Case::draw(options.seed, number));
        let report = match crowd::share(numbers.clone(), options.threads, player, play, Report::and) {
            Ok(report) => report,
            Err(message) if options.environments => {
                println!("{message}");
                clean = false;
                continue;
            }
            Err(message) => return Err(message),
        };
        tell(options, &report);
        let (seconds, fingerprint) = (begin.elapsed().as_secs_f64(), report.fingerprint());
        println!("seed {}, {seconds:.1} s, fingerprint {fingerprint:016x}\n", options.seed);
        fingerprints.push(fingerprint);
        clean &= report.is_clean();
    }
    if fingerprints.iter().any(|fingerprint| *fingerprint != fingerprints[0]) {
        println!("the bits depend on how the host rounds");
        clean = false;
    }
    Ok(clean)
}

fn tell(options: &Options, report: &Report) {
    if options.only.is_none() {
        print!("{}", report.kinds());
    }
    print!("{report}");
    if !report.is_clean() {
        print!("\n{}", if options.summary { report.summary() } else { report.failures() });
    }
}

/// Controller and plant; one library serves all structures.
fn units(folder: Option<&Path>) -> Result<[Unit; 2], String> {
    let folder = match folder {
        Some(folder) => folder.to_owned(),
        None => built()?,
    };
    let open = |name: &str| {
        let path = folder.join(name);
        Unit::open(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    Ok([open("uam_controller.fmu")?, open("uam_plant.fmu")?])
}

/// The folder with FMUs of the present sources, beside this program.
fn built() -> Result<PathBuf, String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let folder = program.parent().ok_or("the program is in no folder")?.join("stress-fmus");
    let options = fmu_build::BuildOptions::new(uam::Structure::DEFAULT, folder.clone());
    fmu_build::build(&options, &|_| ()).map_err(|error| error.to_string())?;
    Ok(folder)
}
