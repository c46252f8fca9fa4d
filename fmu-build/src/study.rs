//! Scenarios with each discretization, beside what the thesis says; among them the pick-up of 4.3.

pub mod budget;
pub mod check;
pub mod claims;
pub mod own_file;
pub mod own_vehicle;
pub mod particulars;
pub mod reach;
pub mod variation;
pub mod verdict;

use std::time::Duration;

use rayon::prelude::*;
use uam::parameters::Discretization;
use uam::scenarios::{self, Scenario, catalogue};
use uam::variables::options::Choice;

use crate::host::coupling::{Error, Pair, Schedule};
use crate::host::record::{Names, NotRecorded};
use crate::host::run::{Run, run};
use claims::{Claim, DISCRETIZATIONS, Numbers, Quantity, Row, Table};
use verdict::Verdict;

/// Runs a scenario at its own step with a discretization. `progress` hears of every communication point.
///
/// # Errors
/// If it cannot be started.
pub fn run_with(
    pair: &Pair,
    scenario: &Scenario,
    discretization: Discretization,
    progress: &dyn Fn(),
) -> Result<Run, Error> {
    let schedule = Schedule::new(0.0, scenario.duration, scenario.step)?;
    let mut variant = scenario.clone();
    variant.parameters.ik.discretization = discretization;
    run(pair, &variant, &schedule, &Names::standard(scenario.structure), progress)
}

/// A scenario, run with each of [`DISCRETIZATIONS`].
#[derive(Debug)]
pub struct Case {
    /// The scenario.
    pub scenario: Scenario,
    /// The runs.
    pub runs: [Run; 2],
}

impl Case {
    /// Runs the scenario at its own step.
    ///
    /// # Errors
    /// If it cannot be started.
    pub fn run(pair: &Pair, scenario: Scenario, progress: &dyn Fn()) -> Result<Self, Error> {
        let [euler, exact] = DISCRETIZATIONS.map(|discretization| run_with(pair, &scenario, discretization, progress));
        Ok(Self { runs: [euler?, exact?], scenario })
    }

    /// The run with the discretization `exact`.
    #[must_use]
    pub fn exact(&self) -> &Run {
        let [_, exact] = &self.runs;
        exact
    }

    /// The run with the discretization of the thesis.
    #[must_use]
    pub fn euler(&self) -> &Run {
        let [euler, _] = &self.runs;
        euler
    }

    /// The numbers of both runs.
    ///
    /// # Errors
    /// If they lack what is to be measured.
    pub fn summary(&self) -> Result<Summary, NotRecorded> {
        let outcomes = [Outcome::of(self.euler())?, Outcome::of(self.exact())?];
        Ok(Summary { scenario: self.scenario.clone(), outcomes })
    }
}

/// What is kept of a run.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// All quantities.
    pub numbers: Numbers,
    /// Why the run stopped early, if it did.
    pub complaint: Option<String>,
    /// What became of it.
    pub verdict: Verdict,
    /// Time that was simulated \[s\].
    pub simulated: f64,
    /// Time that it took.
    pub elapsed: Duration,
}

impl Outcome {
    /// Sums up a run.
    ///
    /// # Errors
    /// If it lacks what is to be measured.
    pub fn of(run: &Run) -> Result<Self, NotRecorded> {
        Ok(Self {
            numbers: Numbers::of(&run.recording, run.scenario.structure)?,
            complaint: run.complaint(),
            verdict: Verdict::of(run)?,
            simulated: run.simulated(),
            elapsed: run.elapsed,
        })
    }
}

/// A scenario with what came out with each of [`DISCRETIZATIONS`].
#[derive(Debug, Clone)]
pub struct Summary {
    /// The scenario.
    pub scenario: Scenario,
    /// One per discretization.
    pub outcomes: [Outcome; 2],
}

/// Runs scenarios with each discretization, on all cores. `pair` finds the FMUs of a scenario.
///
/// # Errors
/// If one of them cannot be started.
pub fn run_all<'a>(
    scenarios: Vec<Scenario>,
    pair: &(dyn Fn(&Scenario) -> Result<&'a Pair, Error> + Sync),
    progress: &(dyn Fn() + Sync),
) -> Result<Vec<Summary>, Error> {
    let jobs = with_each(&scenarios);
    let run = |&(scenario, discretization): &(&Scenario, Discretization)| {
        let run = run_with(pair(scenario)?, scenario, discretization, progress)?;
        Ok(Outcome::of(&run)?)
    };
    let outcomes = on_all_cores(&jobs, run).into_iter().collect::<Result<Vec<Outcome>, Error>>()?;
    let (outcomes, _) = outcomes.as_chunks();
    let summary = |(scenario, outcomes): (_, &[Outcome; 2])| Summary { scenario, outcomes: outcomes.clone() };
    Ok(scenarios.clone().into_iter().zip(outcomes).map(summary).collect())
}

/// Each of these with each of [`DISCRETIZATIONS`].
pub fn with_each<T>(items: &[T]) -> Vec<(&T, Discretization)> {
    items.iter().flat_map(|item| DISCRETIZATIONS.map(|discretization| (item, discretization))).collect()
}

/// Does all jobs, as many at a time as there are cores; results are in the order of the jobs. Jobs take seconds, and some take
/// ten times as long as others: each is handed out by itself.
pub fn on_all_cores<J: Sync, R: Send>(jobs: &[J], work: impl Fn(&J) -> R + Sync + Send) -> Vec<R> {
    jobs.par_iter().with_max_len(1).map(work).collect()
}

/// What is said of a pick-up beside the claims.
const PICK_UP: [Quantity; 8] = [
    Quantity::FarthestRight,
    Quantity::FinalX,
    Quantity::Sinking,
    Quantity::Roll,
    Quantity::Torque,
    Quantity::Moment,
    Quantity::TrackingError,
    Quantity::LostAt,
];

/// The scenarios of thesis 4.3, and what the units hold.
///
/// # Errors
/// If a file of the catalogue is wrong.
pub fn pick_up() -> Result<Vec<Scenario>, scenarios::Error> {
    Ok(catalogue()?
        .into_iter()
        .filter(|Scenario { id, .. }| id.starts_with("4.3") || id == scenarios::PICK_UP)
        .collect())
}

/// What the thesis says of these scenarios beside what came out.
#[must_use]
pub fn table(summaries: &[Summary]) -> Table {
    let mut table = Table::new(DISCRETIZATIONS.map(|discretization| discretization.name()));
    for summary in summaries {
        let claims = claims::about(&summary.scenario.id);
        let rows = claims.filter_map(|claim| Some(Row::of(claim, values(summaries, claim)?)));
        table.add(title(&summary.scenario), rows.collect());
    }
    table
}

/// The same for the pick-up, with all that is to be said of it. Once the arm has left a workspace that it
/// should not leave, no other number means anything.
#[must_use]
pub fn pick_up_table(summaries: &[Summary]) -> Table {
    let mut table = Table::new(DISCRETIZATIONS.map(|discretization| discretization.name()));
    for summary in summaries {
        let numbers = summary.outcomes.each_ref().map(|outcome| &outcome.numbers);
        let lost = numbers.iter().any(|numbers| numbers.get(Quantity::LostAt).is_finite());
        let quantities = if lost { vec![Quantity::LostAt] } else { PICK_UP.to_vec() };
        let row = |quantity: Quantity| {
            let values = numbers.map(|numbers| numbers.get(quantity));
            match claims::of(&summary.scenario.id, quantity) {
                Some(claim) => Row::of(claim, values.map(Some)),
                None => Row::plain(quantity, values.map(|value| format!("{:#}", quantity.show(value)))),
            }
        };
        let Scenario { id, parameters, .. } = &summary.scenario;
        let title = format!("{id} · {}, roll kd {}", parameters.ik.resolution.name(), parameters.autopilot.roll.kd);
        table.add(title, quantities.into_iter().map(row).collect());
    }
    table
}

/// The numbers that a claim is about, if all its scenarios were run; none for a ratio of two roundings.
#[must_use]
pub fn values(summaries: &[Summary], claim: &Claim) -> Option<[Option<f64>; 2]> {
    let numbers = |id: &str| {
        let summary = summaries.iter().find(|summary| summary.scenario.id == id)?;
        Some(summary.outcomes.each_ref().map(|outcome| outcome.numbers.get(claim.quantity)))
    };
    let [euler, exact] = numbers(claim.scenario)?;
    Some(match claim.compared_with {
        None => [Some(euler), Some(exact)],
        Some(other) => {
            let [other_euler, other_exact] = numbers(other)?;
            [claim.quantity.ratio(euler, other_euler), claim.quantity.ratio(exact, other_exact)]
        }
    })
}

fn title(scenario: &Scenario) -> String {
    let Scenario { id, title, parameters, .. } = scenario;
    format!("{id} · {} · {} · {title}", parameters.ik.base_model.name(), parameters.ik.resolution.name())
}
