//! One scenario on a pair of FMUs.

use std::error::Error as _;
use std::time::{Duration, Instant};

use uam::scenarios::Scenario;

use uam::coupling;

use crate::host::coupling::{Coupling, Error, Pair, Schedule, configure};
use crate::host::record::{Names, Recorder, Recording};
use crate::package::design;

/// What came out of a scenario.
#[derive(Debug)]
pub struct Run {
    /// What was run.
    pub scenario: Scenario,
    /// What was recorded, up to the end or to where the run stopped.
    pub recording: Recording,
    /// Why the run stopped early, if it did.
    pub stopped: Option<Error>,
    /// Time that the coupling took, recording included.
    pub elapsed: Duration,
}

impl Run {
    /// Why the run stopped early, in words.
    #[must_use]
    pub fn complaint(&self) -> Option<String> {
        let stopped = self.stopped.as_ref()?;
        let reason = stopped.source().map_or_else(String::new, |reason| format!(": {reason}"));
        Some(format!("{stopped}{reason}"))
    }

    /// Time that was simulated \[s\].
    #[must_use]
    pub fn simulated(&self) -> f64 {
        match self.recording.times() {
            [first, .., last] => last - first,
            _ => 0.0,
        }
    }
}

/// Runs a scenario. `progress` hears of every communication point.
///
/// # Errors
/// If the units cannot be initialized for this scenario. An error during the run is part of the result.
pub fn run(
    pair: &Pair,
    scenario: &Scenario,
    schedule: &Schedule,
    names: &Names,
    progress: &dyn Fn(),
) -> Result<Run, Error> {
    // In terms of parameters, not of the calls by which the units would refuse them.
    design::check(scenario.structure, &scenario.parameters)?;
    let mut coupling = pair.couple()?;
    configure(&mut coupling, scenario.structure, &scenario.parameters)?;
    run_prepared(coupling, scenario, schedule, names, progress)
}

/// Runs units whose parameters are set, if not all to those of the scenario.
///
/// # Errors
/// As [`run`].
pub fn run_prepared(
    mut coupling: Coupling,
    scenario: &Scenario,
    schedule: &Schedule,
    names: &Names,
    progress: &dyn Fn(),
) -> Result<Run, Error> {
    let (controller, plant) = (coupling.controller.description(), coupling.plant.description());
    let mut recorder = Recorder::new(names, controller, plant, schedule.steps() + 1)?;
    let begin = Instant::now();
    let result = coupling.run(schedule, &mut |time, controller, plant| {
        progress();
        recorder.record(time, controller, plant)
    });
    let elapsed = begin.elapsed();
    let stopped = match result {
        Ok(()) => None,
        Err(stopped @ coupling::Error::Step { .. }) => Some(stopped.into()),
        Err(error) => return Err(error.into()),
    };
    Ok(Run { scenario: scenario.clone(), recording: recorder.finish(), stopped, elapsed })
}
