//! What is chosen when a pair of units is built.

use uam::fmi::{Identity, Model, Naming};
use uam::parameters::defaults;
use uam::scenarios::{self, Scenario};
use uam::units::controller::ControllerUnit;
use uam::units::plant::PlantUnit;
use uam::variables::declare::Part;
use uam::{Parameters, Structure};

/// Everything in which one pair of units differs from another.
#[derive(Debug, Clone)]
pub struct Design {
    /// The vehicle; it decides which variables the units have.
    pub structure: Structure,
    /// How the variables are called.
    pub naming: Naming,
    /// Start values of the parameters of both units.
    pub parameters: Parameters,
    /// What importers propose to simulate.
    pub experiment: Experiment,
    /// Whether the FMUs say which variables belong together, in `terminalsAndIcons.xml`.
    pub terminals: bool,
}

/// When a simulation ends, and how long its steps are.
#[derive(Debug, Clone, Copy)]
pub struct Experiment {
    /// End, counted from 0 \[s\].
    pub stop_time: f64,
    /// Communication step \[s\].
    pub step_size: f64,
}

impl Experiment {
    /// That which belongs to the library's own start values.
    pub const PICK_UP: Self = Self { stop_time: defaults::PICK_UP_DURATION, step_size: defaults::THESIS_STEP };
}

/// Whether a simulation can begin with these parameters.
///
/// # Errors
/// If one is out of its bounds, or they do not go together.
pub fn check(structure: Structure, parameters: &Parameters) -> uam::Result<()> {
    fn begin<M: Model<Structure = Structure, Error = uam::Error>>(
        structure: Structure,
        parameters: &Parameters,
    ) -> uam::Result<()>
    where
        M::Data: Part<Parameters>,
    {
        let mut data = M::start(structure);
        data.part_mut().clone_from(parameters);
        M::initialize(structure, &mut data, 0.0).map(|_| ())
    }
    begin::<PlantUnit>(structure, parameters)?;
    begin::<ControllerUnit>(structure, parameters)
}

impl From<Structure> for Design {
    fn from(structure: Structure) -> Self {
        Self {
            structure,
            naming: Naming::Structured,
            parameters: scenarios::default_parameters(structure),
            experiment: Experiment::PICK_UP,
            terminals: false,
        }
    }
}

impl From<Scenario> for Design {
    fn from(scenario: Scenario) -> Self {
        let Scenario { structure, parameters, duration, step, .. } = scenario;
        let experiment = Experiment { stop_time: duration, step_size: step };
        Self { structure, naming: Naming::Structured, parameters, experiment, terminals: false }
    }
}

impl Design {
    /// Whether a simulation can begin with these start values.
    ///
    /// # Errors
    /// As [`check`].
    pub fn check(&self) -> uam::Result<()> {
        check(self.structure, &self.parameters)
    }

    /// One of the two units.
    #[must_use]
    pub fn unit<M>(&self) -> Identity<M>
    where
        M: Model<Structure = Structure>,
        M::Data: Part<Parameters>,
    {
        let mut unit = Identity::<M> { naming: self.naming, ..Identity::of(self.structure) };
        unit.start.part_mut().clone_from(&self.parameters);
        unit
    }
}
