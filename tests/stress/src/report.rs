//! What all runs came to.

use std::collections::BTreeMap;
use std::fmt;

use comfy_table::Table;
use uam::variables::options::Choice;

use crate::case::Case;
use crate::play::{Broken, Track};
use crate::seen::status_name;

/// How many cases of a group are told one by one.
const TOLD: usize = 3;

/// Promises that are kept by most runs, not by all, with the largest share of those that break them. Random arms swing
/// slowly, get caught where path and moment contradict each other, and do so on one clock and not on the other. A plan ends with
/// a linear correction of less than 1e-12 m, which leaves out what a stiff autopilot that takes samples makes of it: up to
/// 2e-8 rad/s of the prediction.
const SHARES: [(&str, f64); 4] = [("clock", 0.03), ("path met", 0.01), ("prediction", 1e-4), ("rest", 0.13)];

/// A case in which a promise was broken.
#[derive(Debug, Clone)]
struct Failure {
    number: u64,
    case: String,
    broken: Broken,
}

/// Promise, resolution, clock.
type Key = (&'static str, &'static str, &'static str);

/// Sums over runs; the same whatever the order.
#[derive(Debug, Clone, Default)]
pub struct Report {
    cases: u64,
    failed: u64,
    tumbled: u64,
    steps: u64,
    digest: u64,
    statuses: [u64; 16],
    /// Runs of each kind.
    kinds: BTreeMap<(&'static str, String), u64>,
    /// Runs in which a promise was looked at.
    looked: BTreeMap<&'static str, u64>,
    /// How many runs broke a promise, and the first of them.
    broken: BTreeMap<Key, (u64, Vec<Failure>)>,
}

impl Report {
    /// Of one run.
    pub fn of(case: &Case, track: Track) -> Self {
        let p = &case.parameters;
        let (resolution, clock) = (p.ik.resolution.name(), case.steps.clock.name());
        let kinds = [
            ("structure", case.structure.to_string()),
            ("resolution", resolution.to_owned()),
            ("discretization", p.ik.discretization.name().to_owned()),
            ("hold", p.ik.hold.name().to_owned()),
            ("base model", p.ik.base_model.name().to_owned()),
            ("reference", p.reference.kind.name().to_owned()),
            ("start", format!("{:?}", case.start)),
            ("limits", format!("{:?}", case.limits)),
            ("clock", clock.to_owned()),
        ];
        let failed = u64::from(!track.broken.is_empty());
        let failure = |broken: Broken| {
            let key = (broken.check, resolution, clock);
            (key, (1, vec![Failure { number: case.number, case: case.to_string(), broken }]))
        };
        Self {
            cases: 1,
            failed,
            tumbled: track.tumbled.into(),
            steps: track.steps,
            digest: track.digest,
            statuses: track.statuses,
            kinds: kinds.into_iter().map(|kind| (kind, 1)).collect(),
            looked: track.looked.iter().map(|check| (*check, 1)).collect(),
            broken: track.broken.into_iter().map(failure).collect(),
        }
    }

    /// Of both.
    pub fn and(mut self, other: Self) -> Self {
        self.cases += other.cases;
        self.failed += other.failed;
        self.tumbled += other.tumbled;
        self.steps += other.steps;
        // The order of runs depends on the number of threads.
        self.digest = self.digest.wrapping_add(other.digest);
        self.statuses.iter_mut().zip(other.statuses).for_each(|(sum, more)| *sum += more);
        other.kinds.into_iter().for_each(|(kind, count)| *self.kinds.entry(kind).or_default() += count);
        other.looked.into_iter().for_each(|(check, count)| *self.looked.entry(check).or_default() += count);
        for (key, (count, failures)) in other.broken {
            let (sum, told) = self.broken.entry(key).or_default();
            *sum += count;
            told.extend(failures);
            told.sort_by_key(|failure| failure.number);
            told.truncate(TOLD);
        }
        self
    }

    /// A number that all runs have a part in, bit by bit.
    pub fn fingerprint(&self) -> u64 {
        self.digest
    }

    /// Whether each promise was kept: never broken, or in so few of the runs that were looked at as [`SHARES`] says.
    pub fn is_clean(&self) -> bool {
        self.looked.iter().all(|(check, looked)| {
            let broken: u64 = self.broken.iter().filter(|((of, ..), _)| of == check).map(|(_, (count, _))| count).sum();
            let share = SHARES.iter().find(|(of, _)| of == check).map_or(0.0, |(_, share)| *share);
            // So that a few runs do not decide.
            broken == 0 || (share > 0.0 && broken as f64 <= 2.0 + share * *looked as f64)
        })
    }

    /// How many runs there were of which kind, and what their statuses were.
    pub fn kinds(&self) -> String {
        let mut text = String::new();
        let mut last = "";
        for ((of, kind), count) in &self.kinds {
            text += &if *of == last { format!(", {kind} {count}") } else { format!("\n{of}: {kind} {count}") };
            last = of;
        }
        let points: u64 = self.statuses.iter().sum();
        text += "\nstatus:";
        for (number, count) in self.statuses.iter().enumerate().filter(|(_, count)| **count > 0) {
            text += &format!(" {} {:.2} %", status_name(number), 100.0 * *count as f64 / points as f64);
        }
        text.trim_start().to_owned() + "\n"
    }

    /// Broken promises by promise, resolution and clock.
    pub fn summary(&self) -> String {
        let mut clocks: Vec<_> = self.broken.keys().map(|(_, _, clock)| *clock).collect();
        clocks.sort_unstable();
        clocks.dedup();
        let mut table = Table::new();
        table.load_style(comfy_table::presets::ASCII_MARKDOWN);
        table.set_header([&["promise", "resolution"], clocks.as_slice(), &["all"]].concat());
        let rows: std::collections::BTreeSet<_> =
            self.broken.keys().map(|(check, resolution, _)| (*check, *resolution)).collect();
        for (check, resolution) in rows {
            let counts =
                clocks.iter().map(|clock| self.broken.get(&(check, resolution, *clock)).map_or(0, |(n, _)| *n));
            let counts: Vec<u64> = counts.collect();
            let shown = |count: &u64| if *count == 0 { String::new() } else { count.to_string() };
            let mut row = vec![check.to_owned(), resolution.to_owned()];
            row.extend(counts.iter().map(shown));
            row.push(counts.iter().sum::<u64>().to_string());
            table.add_row(row);
        }
        format!("{table}\n")
    }

    /// The first broken promises of each kind, with all that is needed to see them again.
    pub fn failures(&self) -> String {
        let mut text = String::new();
        for ((check, resolution, clock), (count, failures)) in &self.broken {
            text += &format!("{check}, {resolution}, {clock}: {count} of {}\n", self.looked.get(check).unwrap_or(&0));
            for Failure { number, case, broken: Broken { time, found, .. } } in failures {
                text += &format!("  number {number}, at {time:.6} s: {found}\n    {case}\n");
            }
        }
        text
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cases, failed, tumbled, steps, .. } = self;
        writeln!(f, "{cases} couplings, {steps} steps, {tumbled} turned over, {failed} broke a promise")?;
        for (check, looked) in &self.looked {
            let broken = self.broken.iter().filter(|((of, ..), _)| of == check).map(|(_, (count, _))| count);
            writeln!(f, "  {check}: broken in {} of {looked}", broken.sum::<u64>())?;
        }
        Ok(())
    }
}
