//! Scenarios with each discretization, beside what the thesis says; among them the pick-up of 4.3.

use uam::options::Choice;
use uam::parameters::Discretization;
use uam::scenarios::{self, Scenario, catalogue};

use crate::claims::{self, Quantity, Table};
use crate::coupling::{Error, Order, Pair, Schedule};
use crate::record::Names;
use crate::run::{Run, run};

/// The discretizations that are compared, in the order of the columns of tables.
pub const DISCRETIZATIONS: [Discretization; 2] = [Discretization::Euler, Discretization::Exact];

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
        let schedule = Schedule::new(0.0, scenario.duration, scenario.step)?;
        let names = Names::standard(scenario.structure);
        let with = |discretization| {
            let mut variant = scenario.clone();
            variant.parameters.ik.discretization = discretization;
            run(pair, &variant, &schedule, Order::Parallel, &names, progress)
        };
        let [euler, exact] = DISCRETIZATIONS;
        Ok(Self { runs: [with(euler)?, with(exact)?], scenario })
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

    fn title(&self) -> String {
        let Scenario { id, title, parameters, .. } = &self.scenario;
        let ik = &parameters.ik;
        if id.starts_with("4.3") {
            format!("{id} · {}, roll kd {}", ik.resolution.name(), parameters.autopilot.roll.kd)
        } else {
            format!("{id} · {} · {title}", ik.base_model.name())
        }
    }

    /// What is to be said of this scenario: all of the pick-up, otherwise what the thesis makes a statement
    /// about. Once the arm has left a workspace that it should not leave, no other number means anything.
    fn quantities(&self) -> Vec<Quantity> {
        let claimed = |quantity: Quantity| claims::find(&self.scenario.id, quantity).is_some();
        if !self.scenario.id.starts_with("4.3") {
            return Quantity::ALL.into_iter().filter(|&quantity| claimed(quantity)).collect();
        }
        let lost = |run: &Run| Quantity::LostAt.measure(&run.recording).is_finite();
        if self.runs.iter().any(lost) { vec![Quantity::LostAt] } else { PICK_UP.to_vec() }
    }
}

/// What is to be said of a pick-up.
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

/// The scenarios of thesis 4.3.
///
/// # Errors
/// If a file of the catalogue is wrong.
pub fn pick_up() -> Result<Vec<Scenario>, scenarios::Error> {
    Ok(catalogue()?.into_iter().filter(|scenario| scenario.id.starts_with("4.3")).collect())
}

/// What the thesis says of these cases beside what came out.
#[must_use]
pub fn table(cases: &[Case]) -> Table {
    let mut table = Table::new(DISCRETIZATIONS.map(|discretization| discretization.name()));
    for case in cases {
        let recordings = case.runs.each_ref().map(|run| &run.recording);
        table.add(Some(&case.scenario.id), &case.title(), &case.quantities(), &recordings);
    }
    table
}
