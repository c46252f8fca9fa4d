//! Digests of runs: equal digests, equal bits.

use std::error::Error;

use uam::coupling::{self, Schedule, Unit};
use uam::fmi::Model;
use uam::fmi::hash::fnv1a;
use uam::fmi::v2::{self, Instance};
use uam::scenarios::Scenario;
use uam::variables::Causality;

/// Every so many communication points are part of a digest, beside the last one.
pub const EVERY: usize = 50;

/// What a run gave so far.
#[derive(Debug, Clone, Default)]
pub struct Digest(Vec<u8>);

impl Digest {
    /// Adds numbers in the order in which the units name them.
    pub fn add(&mut self, numbers: impl IntoIterator<Item = f64>) {
        self.0.extend(numbers.into_iter().flat_map(f64::to_le_bytes));
    }

    /// The line for a run of this name.
    #[must_use]
    pub fn line(&self, scenario: &str, discretization: &str) -> String {
        format!("{scenario} {discretization} {:016x}", fnv1a(&self.0))
    }
}

/// Runs a scenario with both units in this process, to its end or to where a unit cannot go on.
///
/// # Errors
/// If it cannot start.
pub fn in_process(scenario: &Scenario) -> Result<Digest, Box<dyn Error>> {
    let mut coupling = coupling::in_process::pair(scenario.structure, &scenario.parameters)?;
    let schedule = Schedule::new(0.0, scenario.duration, scenario.step)?;
    let mut controller = Outputs::of(&coupling.controller)?;
    let mut plant = Outputs::of(&coupling.plant)?;
    let (mut digest, mut count) = (Digest::default(), 0);
    let outcome = coupling.run(&schedule, &mut |_, c, p| {
        if count % EVERY == 0 || count == schedule.steps() {
            digest.add(controller.read(c)?);
            digest.add(plant.read(p)?);
        }
        count += 1;
        Ok(())
    });
    match outcome {
        Ok(()) | Err(coupling::Error::Step { .. }) => Ok(digest),
        Err(error) => Err(error.into()),
    }
}

/// All outputs of a unit.
struct Outputs {
    selection: Vec<u32>,
    values: Vec<f64>,
}

impl Outputs {
    fn of<M: Model>(unit: &Instance<M>) -> Result<Self, v2::Error> {
        let outputs = unit.ports().into_iter().filter(|port| port.causality == Causality::Output);
        let (selection, values) = unit.select(&outputs.map(|port| port.name).collect::<Vec<_>>())?;
        Ok(Self { selection, values })
    }

    fn read<M: Model>(&mut self, unit: &mut Instance<M>) -> Result<impl Iterator<Item = f64>, v2::Error> {
        unit.read(&self.selection, &mut self.values)?;
        Ok(self.values.iter().copied())
    }
}
