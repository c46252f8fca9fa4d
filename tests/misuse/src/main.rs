//! Plays random sequences of calls, legal and illegal, in any order and with hostile arguments, on the C functions
//! of both FMUs, which are loaded into one process with global symbols. Every sequence follows from its number and
//! the seed, and must leave an instance that is as new after `fmi2Reset`.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail like a test")]

use std::path::PathBuf;
use std::process::ExitCode;
use std::thread;
use std::time::Instant;

use clap::Parser;

mod digest;
mod functions;
mod host;
mod hostile;
mod lifetimes;
mod reference;
mod sequence;
mod unit;
mod watch;

use sequence::Outcome;
use unit::Unit;

/// Plays random sequences of calls on the C functions of the FMUs.
///
/// Ends with an error, and the number of the sequence, if a unit crashes, hangs, returns anything but fmi2OK and
/// fmi2Error, refuses without a message, accepts what the standard forbids, gives an output that is no finite
/// number, or is not as new after fmi2Reset.
#[derive(Parser)]
struct Options {
    /// Folder with uam_controller.fmu and uam_plant.fmu.
    #[arg(value_name = "FOLDER", default_value = "out")]
    folder: PathBuf,
    /// How many sequences to play on each unit; each has about 20 calls.
    #[arg(long, value_name = "NUMBER", default_value_t = 100_000)]
    sequences: u64,
    /// Number of the first sequence.
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    from: u64,
    /// Other seeds, other sequences.
    #[arg(long, value_name = "NUMBER", default_value_t = 1)]
    seed: u64,
    /// Play one sequence, by its number.
    #[arg(long, value_name = "NUMBER")]
    only: Option<u64>,
    /// Play so many other sequences before, whose answers are not in the fingerprint.
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    after: u64,
    /// Threads that play at a time.
    #[arg(long, value_name = "NUMBER", default_value_t = 2, value_parser = clap::value_parser!(u16).range(1..=64))]
    threads: u16,
    /// Instead of random calls: so many instances of each unit, one after the other, from instantiation through
    /// two steps, a state and its bytes, to the end.
    #[arg(long, value_name = "NUMBER")]
    instances: Option<u32>,
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
        play(unit, other, options)?;
    }
    Ok(())
}

/// Plays all sequences on one unit. The threads share them out.
fn play(unit: &Unit, other: &Unit, options: &Options) -> Result<(), String> {
    let begin = Instant::now();
    let new = reference::instantiate(unit)?;
    let expected = reference::run(unit, new)?;
    // SAFETY: not used again.
    unsafe { (unit.functions.free_instance)(new) };

    for number in 0..options.after {
        play_some(unit, other, &expected, options.seed + 1, 0, std::iter::once(number))?;
    }
    let sequences = options.only.map_or(options.from..options.from + options.sequences, |only| only..only + 1);
    let threads = usize::from(options.threads);
    let played: Result<Vec<_>, String> = thread::scope(|scope| {
        let players: Vec<_> = (0..threads)
            .map(|thread| {
                let (mine, expected) = (sequences.clone().skip(thread).step_by(threads), &expected);
                scope.spawn(move || play_some(unit, other, expected, options.seed, thread, mine))
            })
            .collect();
        players.into_iter().map(|player| player.join().expect("the players do not panic")).collect()
    });
    let Outcome { digest, calls, refused, steps } = played?.into_iter().fold(Outcome::default(), Outcome::and);
    let count = sequences.end - sequences.start;
    let (percent, seconds) = (100 * refused / calls.max(1), begin.elapsed().as_secs_f64());
    println!(
        "{}: {count} sequences, {calls} calls, {percent} % refused, {steps} steps done, {seconds:.1} s",
        unit.name
    );
    println!("{}: fingerprint {digest:016x}", unit.name);
    Ok(())
}

/// Plays some sequences in this thread.
fn play_some(
    unit: &Unit,
    other: &Unit,
    expected: &[u64],
    seed: u64,
    thread: usize,
    sequences: impl Iterator<Item = u64>,
) -> Result<Outcome, String> {
    let stranger = reference::instantiate(other)?;
    let mut sum = Outcome::default();
    for number in sequences {
        watch::playing(thread, Some(number));
        let own_seed = (seed << 40) ^ number;
        let outcome = sequence::play(unit, stranger, expected, own_seed)
            .map_err(|message| format!("{}, sequence {number}: {message}\n(--only {number} repeats it)", unit.name))?;
        sum = sum.and(outcome);
    }
    watch::playing(thread, None);
    // SAFETY: not used again.
    unsafe { (other.functions.free_instance)(stranger) };
    Ok(sum)
}
