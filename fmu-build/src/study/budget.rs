//! Error budget of the coupling: how far the end effector is from its reference, and the base from where the
//! controller predicts it, by the length of the communication step and by how both units are run.

use uam::parameters::{Discretization, Hold};
use uam::scenarios::Scenario;

use crate::host::coupling::{Error, Order, Pair, Schedule, configure};
use crate::host::fmu::Value;
use crate::host::record::{Names, NotRecorded, Recording};
use crate::host::run::run_prepared;
use crate::study::claims::peak;

mod order;

pub use order::observed_order;

/// Steps that are tried \[s\].
pub const STEPS: [f64; 9] = [1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2, 5e-2];
/// Shortest step between whose ends errors are looked for \[s\].
const SHORTEST_WATCHED: f64 = 5e-4;
/// So many times within a step.
const WATCHED: f64 = 10.0;
/// Sample time of an autopilot that is not continuous \[s\].
const SAMPLE_TIME: f64 = 0.01;

/// How the autopilot runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pilot {
    /// Continuously, as both units know.
    Continuous,
    /// With a sample time, as both units know.
    Sampled,
    /// With a sample time in the plant, while the controller predicts a continuous one.
    SampledUnknown,
}

/// Where errors are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Watch {
    /// At the ends of the steps.
    Samples,
    /// Within the steps, too.
    Between,
}

/// How both units are run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Variant {
    /// Step of the inverse kinematics.
    pub discretization: Discretization,
    /// How rates move within a step.
    pub hold: Hold,
    /// Which unit steps with which values.
    pub order: Order,
    /// The autopilot.
    pub pilot: Pilot,
    /// Where errors are looked for.
    pub watch: Watch,
}

/// The start values of the units.
pub const EXACT: Variant = Variant {
    discretization: Discretization::Exact,
    hold: Hold::ZeroOrder,
    order: Order::Parallel,
    pilot: Pilot::Continuous,
    watch: Watch::Samples,
};
/// The thesis' step.
pub const EULER: Variant = Variant { discretization: Discretization::Euler, ..EXACT };

/// What is compared: the start values of the units, the thesis' step, and each with one thing changed.
pub const VARIANTS: [Variant; 12] = [
    EXACT,
    Variant { hold: Hold::FirstOrder, ..EXACT },
    EULER,
    Variant { hold: Hold::FirstOrder, ..EULER },
    Variant { watch: Watch::Between, ..EXACT },
    Variant { hold: Hold::FirstOrder, watch: Watch::Between, ..EXACT },
    Variant { watch: Watch::Between, ..EULER },
    Variant { order: Order::ControllerFirst, ..EXACT },
    Variant { order: Order::ControllerFirst, ..EULER },
    Variant { pilot: Pilot::Sampled, ..EXACT },
    Variant { pilot: Pilot::Sampled, ..EULER },
    Variant { pilot: Pilot::SampledUnknown, ..EXACT },
];

impl Variant {
    /// In a few words.
    #[must_use]
    pub fn name(&self) -> String {
        use uam::variables::options::Choice;
        let mut words = vec![self.discretization.name(), self.hold.name()];
        words.push(match self.order {
            Order::Parallel => "parallel",
            Order::ControllerFirst => "controller first",
        });
        words.extend(match self.pilot {
            Pilot::Continuous => None,
            Pilot::Sampled => Some("sampled autopilot"),
            Pilot::SampledUnknown => Some("sampled autopilot, predicted as continuous"),
        });
        words.extend((self.watch == Watch::Between).then_some("within the steps"));
        words.join(", ")
    }

    /// Those of [`STEPS`] with which it is run.
    pub fn steps(&self) -> impl Iterator<Item = f64> + use<> {
        let shortest = if self.watch == Watch::Between { SHORTEST_WATCHED } else { 0.0 };
        STEPS.into_iter().filter(move |&step| step >= shortest)
    }

    /// Communication points of a run of a scenario with steps of this length \[s\].
    ///
    /// # Errors
    /// If the scenario is shorter than the step.
    pub fn schedule(&self, scenario: &Scenario, step: f64) -> Result<Schedule, Error> {
        let points = if self.watch == Watch::Between { WATCHED } else { 1.0 };
        Ok(Schedule::new(0.0, scenario.duration, step / points)?)
    }

    /// Runs a scenario with steps of this length \[s\]. `progress` hears of every communication point.
    ///
    /// # Errors
    /// If it cannot be run to its end.
    pub fn run(&self, pair: &Pair, scenario: &Scenario, step: f64, progress: &dyn Fn()) -> Result<Errors, Error> {
        let schedule = self.schedule(scenario, step)?;
        let mut parameters = scenario.parameters.clone();
        // Between its plans, the controller holds what it has planned.
        parameters.ik.sample_time = step;
        (parameters.ik.discretization, parameters.ik.hold) = (self.discretization, self.hold);
        parameters.autopilot.sample_time = if self.pilot == Pilot::Sampled { SAMPLE_TIME } else { 0.0 };
        let mut coupling = pair.couple()?.in_order(self.order);
        configure(&mut coupling, scenario.structure, &parameters)?;
        if self.pilot == Pilot::SampledUnknown {
            coupling.plant.set_value("autopilot.sample_time", Value::Real(SAMPLE_TIME))?;
        }
        let run = run_prepared(coupling, scenario, &schedule, &names(), progress)?;
        match run.stopped {
            None => Ok(Errors::of(&run.recording)?),
            Some(stopped) => Err(stopped),
        }
    }
}

/// The points between which errors are distances.
fn names() -> Names {
    let of =
        |points: [&str; 2]| points.iter().flat_map(|point| ["x", "y"].map(|axis| format!("{point}.{axis}"))).collect();
    Names { controller: of(["reference", "predicted.base"]), plant: of(["end_effector", "base"]) }
}

/// The largest errors of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Distance of the end effector from its reference \[m\].
    pub end_effector: f64,
    /// Distance of the UAV from where the controller predicts it \[m\].
    pub base: f64,
}

impl Errors {
    fn of(recording: &Recording) -> Result<Self, NotRecorded> {
        let largest = |found, wanted| recording.distance(found, wanted).map(peak);
        Ok(Self { end_effector: largest("end_effector", "reference")?, base: largest("base", "predicted.base")? })
    }
}

/// The errors of a variant with each of its steps.
#[derive(Debug, Clone)]
pub struct Curve {
    /// How both units were run.
    pub variant: Variant,
    /// Length of the step \[s\], and what came out.
    pub points: Vec<(f64, Errors)>,
}

impl Curve {
    /// An error by the length of the step.
    pub fn of(&self, error: impl Fn(&Errors) -> f64) -> Vec<(f64, f64)> {
        self.points.iter().map(|(step, errors)| (*step, error(errors))).collect()
    }

    /// The longest step with which the end effector stays within `error` \[m\] of its reference, as with all
    /// shorter ones.
    #[must_use]
    pub fn longest_step_within(&self, error: f64) -> Option<f64> {
        let within = self.points.iter().take_while(|(_, errors)| errors.end_effector <= error);
        within.last().map(|(step, _)| *step)
    }
}
