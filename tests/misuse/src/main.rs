//! Plays random sequences of calls, legal and illegal, in any order and with hostile arguments, on the C functions
//! of both FMUs, which are loaded into one process with global symbols. Every sequence follows from its number and
//! the seed, and must leave an instance that is as new after `fmi2Reset`. Likewise it makes up states and start files.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail like a test")]

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::{ArgGroup, Parser};

mod forgery;
mod guest;
mod hostile;
mod lifetimes;
mod outputs;
mod player;
mod reference;
mod sequence;
mod starts;

use environment::Environment;
use guest::{Fate, Guest};
use misuse::{crowd, digest, environment, functions, host, unit, watch};
use sequence::Outcome;
use unit::Unit;

/// Plays random sequences of calls on the C functions of the FMUs.
///
/// Ends with an error, and the number of the sequence, if a unit crashes, hangs, panics, returns anything but fmi2OK
/// and fmi2Error, refuses without a message, accepts what the standard forbids, gives an output that is no finite
/// number, gives none at too many points, or is not as new after fmi2Reset.
#[derive(Parser)]
#[command(group = ArgGroup::new("what"))]
struct Options {
    /// Folder with uam_controller.fmu and uam_plant.fmu.
    #[arg(value_name = "FOLDER", default_value = "out")]
    folder: PathBuf,
    /// How many sequences to play on each unit; each has about 20 calls.
    #[arg(long, value_name = "NUMBER", default_value_t = 100_000, group = "what")]
    sequences: u64,
    /// Instead of sequences: so many situations of each unit, whose state is saved and forged eight times, with a
    /// checksum that is right.
    #[arg(long, value_name = "NUMBER", group = "what")]
    forgeries: Option<u64>,
    /// Instead of sequences: so many made-up start files in the resources of each unit.
    #[arg(long, value_name = "NUMBER", group = "what")]
    starts: Option<u64>,
    /// Instead of sequences: so many instances of each unit, one after the other, from instantiation through
    /// two steps, a state and its bytes, to the end.
    #[arg(long, value_name = "NUMBER", group = "what")]
    instances: Option<u32>,
    /// Number of the first sequence, situation or file.
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    from: u64,
    /// Other seeds, other sequences.
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    seed: u64,
    /// Play one of them, by its number.
    #[arg(long, value_name = "NUMBER")]
    only: Option<u64>,
    /// Play so many other sequences before, whose answers are not in the fingerprint.
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    after: u64,
    /// Floating-point environment in which the units are called; they must leave it as it is.
    #[arg(long, value_name = "NAME", value_enum, default_value = "usual")]
    environment: Environment,
    /// Threads that play at a time.
    #[arg(long, value_name = "NUMBER", default_value_t = 2, value_parser = clap::value_parser!(u16).range(1..=64))]
    threads: u16,
}

impl Options {
    /// The numbers of what is to be played, out of `count`.
    fn numbers(&self, count: u64) -> std::ops::Range<u64> {
        self.only.map_or(self.from..self.from + count, |only| only..only + 1)
    }

    fn seed(&self, number: u64) -> u64 {
        (self.seed << 40) ^ number
    }
}

fn main() -> ExitCode {
    let options = Options::parse();
    match run(&options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), String> {
    environment::choose(options.environment);
    let open = |name: &str| {
        let path = options.folder.join(name);
        Unit::open(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let units = [open("uam_controller.fmu")?, open("uam_plant.fmu")?];
    if let Some(count) = options.instances {
        return units.iter().try_for_each(|unit| lifetimes::run(unit, count));
    }
    watch::begin();
    for (unit, other) in [(&units[0], &units[1]), (&units[1], &units[0])] {
        match (options.forgeries, options.starts) {
            (Some(count), _) => forge(unit, options, count),
            (None, Some(count)) => start(unit, options, count),
            (None, None) => play(unit, other, options),
        }?;
    }
    Ok(())
}

/// Plays all sequences on one unit.
fn play(unit: &Unit, other: &Unit, options: &Options) -> Result<(), String> {
    let begin = Instant::now();
    let expected = reference::of_new(unit)?;
    let play = |numbers, seed: &(dyn Fn(u64) -> u64 + Sync)| {
        let stranger = || Guest::new(other);
        let play = |stranger: &mut Guest<'_>, number| {
            sequence::play(unit, stranger.component, &expected, seed(number)).map_err(repeated(unit, number))
        };
        crowd::share(numbers, options.threads, stranger, play, Outcome::and)
    };
    play(0..options.after, &|number| options.seed(number) + (1 << 40))?;
    let numbers = options.numbers(options.sequences);
    let count = numbers.end - numbers.start;
    let Outcome { digest, tally } = play(numbers, &|number| options.seed(number))?;
    let (percent, seconds) = (100 * tally.refused / tally.calls.max(1), begin.elapsed().as_secs_f64());
    println!(
        "{}: {count} sequences, {} calls, {percent} % refused, {}, {seconds:.1} s",
        unit.name, tally.calls, tally.points
    );
    println!("{}: fingerprint {digest:016x}", unit.name);
    tally.points.tell()
}

/// Forges states of one unit.
fn forge(unit: &Unit, options: &Options, count: u64) -> Result<(), String> {
    let forge = |(): &mut (), number| forgery::play(unit, options.seed(number)).map_err(repeated(unit, number));
    let fate = crowd::share(options.numbers(count), options.threads, || Ok(()), forge, Fate::and)?;
    println!("{}: {} forged states, {} accepted; {}", unit.name, fate.tried, fate.accepted, fate.points);
    fate.points.tell()
}

/// Makes start files up.
fn start(unit: &Unit, options: &Options, count: u64) -> Result<(), String> {
    let desk = || starts::Desk::new(unit);
    let start = |desk: &mut starts::Desk, number| {
        starts::play(unit, desk, options.seed(number)).map_err(repeated(unit, number))
    };
    let fate = crowd::share(options.numbers(count), options.threads, desk, start, Fate::and)?;
    println!("{}: {} start files, {} accepted; {}", unit.name, fate.tried, fate.accepted, fate.points);
    fate.points.tell()
}

/// A message with the way to see the same again.
fn repeated(unit: &Unit, number: u64) -> impl FnOnce(String) -> String {
    move |message| format!("{}, number {number}: {message}\n(--only {number} repeats it)", unit.name)
}
