//! A plain fixed-step master for controller and plant.

use std::path::Path;

use crate::fmu::{self, Causality, Description, Fmu, Instance, Selection, Values};
use crate::record::NotRecorded;
use crate::settings;

mod schedule;

pub use schedule::{LONGEST, Schedule};

/// Who steps when.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// Values are exchanged, then both units step (Jacobi).
    #[default]
    Parallel,
    /// The plant steps, and the controller steps with the plant's new outputs (Gauss-Seidel).
    PlantFirst,
    /// The controller steps, and the plant steps with the controller's new commands: one step too early.
    ControllerFirst,
}

/// A coupling that cannot be set up or cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Before the first step.
    #[error(transparent)]
    Fmu(#[from] fmu::Error),
    /// During the run.
    #[error("the run stops at t = {time} s")]
    Step {
        /// Beginning of the step that failed \[s\].
        time: f64,
        /// What the unit says.
        source: fmu::Error,
    },
    /// A structure whose FMUs nobody has built.
    #[error("the FMUs for {structure} were not built")]
    NotBuilt {
        /// The structure.
        structure: uam::Structure,
    },
    /// Parameters with which a run makes no sense.
    #[error(transparent)]
    Parameters(#[from] uam::Error),
    /// What a run should have recorded.
    #[error(transparent)]
    NotRecorded(#[from] NotRecorded),
    /// A schedule that makes no sense.
    #[error("{name} must be {expected}, but is {found}")]
    Schedule {
        /// Which number.
        name: &'static str,
        /// What is allowed.
        expected: String,
        /// The number.
        found: f64,
    },
}

/// The two files, opened.
#[derive(Debug, Clone)]
pub struct Pair {
    /// The controller.
    pub controller: Fmu,
    /// The plant.
    pub plant: Fmu,
}

impl Pair {
    /// Opens both files.
    ///
    /// # Errors
    /// If one of them cannot be loaded.
    pub fn open(controller: &Path, plant: &Path) -> Result<Self, fmu::Error> {
        Ok(Self { controller: Fmu::open(controller)?, plant: Fmu::open(plant)? })
    }
}

/// Connections from outputs of one unit to the inputs of the other that have the same name and type.
#[derive(Debug)]
struct Wires {
    from: Selection,
    to: Selection,
    values: Values,
}

impl Wires {
    fn between(from: &Description, to: &Description) -> Result<Self, fmu::Error> {
        let names: Vec<&str> = from
            .with(Causality::Output)
            .filter(|output| {
                to.with(Causality::Input).any(|input| input.name == output.name && input.data_type == output.data_type)
            })
            .map(|output| output.name.as_str())
            .collect();
        // Same names and types in the same order: the values of one selection fit the other.
        let [from, to] = [Selection::new(from, names.iter().copied())?, Selection::new(to, names)?];
        let values = from.values();
        Ok(Self { from, to, values })
    }

    fn carry(&mut self, from: &mut Instance, to: &mut Instance) -> Result<(), fmu::Error> {
        from.get(&self.from, &mut self.values)?;
        to.set(&self.to, &self.values)
    }
}

/// One instance of each unit, connected.
#[derive(Debug)]
pub struct Coupling {
    /// The controller.
    pub controller: Instance,
    /// The plant.
    pub plant: Instance,
    commands: Wires,
    measurements: Wires,
}

/// Called at the start and after every step with the time and both units.
pub type Observer<'a> = dyn FnMut(f64, &mut Instance, &mut Instance) -> Result<(), fmu::Error> + 'a;

impl Coupling {
    /// Instantiates and connects both units.
    ///
    /// # Errors
    /// If one of them does not start.
    pub fn new(pair: &Pair) -> Result<Self, fmu::Error> {
        let (controller, plant) = (pair.controller.description(), pair.plant.description());
        Ok(Self {
            commands: Wires::between(controller, plant)?,
            measurements: Wires::between(plant, controller)?,
            controller: pair.controller.instantiate("controller")?,
            plant: pair.plant.instantiate("plant")?,
        })
    }

    /// How many values go from the controller to the plant, and back.
    #[must_use]
    pub fn connections(&self) -> (usize, usize) {
        (self.commands.from.len(), self.measurements.from.len())
    }

    /// Sets the parameters of both units.
    ///
    /// # Errors
    /// If the units have other parameters, or do not accept a value.
    pub fn configure(&mut self, structure: uam::Structure, parameters: &uam::Parameters) -> Result<(), fmu::Error> {
        use uam::units::{controller::ControllerUnit, plant::PlantUnit};
        self.controller.set_values(&settings::named_values::<ControllerUnit>(structure, parameters))?;
        self.plant.set_values(&settings::named_values::<PlantUnit>(structure, parameters))
    }

    /// Initializes both units and runs them to the end of the schedule.
    ///
    /// # Errors
    /// If a unit refuses a call; what was observed until then stays valid.
    pub fn run(&mut self, schedule: &Schedule, order: Order, observe: &mut Observer<'_>) -> Result<(), Error> {
        self.initialize(schedule)?;
        observe(schedule.start(), &mut self.controller, &mut self.plant)?;
        for interval in schedule.intervals() {
            self.step(interval.from, interval.size, order)
                .and_then(|()| observe(interval.to, &mut self.controller, &mut self.plant))
                .map_err(|source| Error::Step { time: interval.from, source })?;
        }
        self.controller.terminate()?;
        self.plant.terminate()?;
        Ok(())
    }

    /// The initial outputs are handed over in initialization mode already: initial outputs of the other
    /// unit may depend on them.
    fn initialize(&mut self, schedule: &Schedule) -> Result<(), fmu::Error> {
        self.controller.enter_initialization(schedule.start(), schedule.stop())?;
        self.plant.enter_initialization(schedule.start(), schedule.stop())?;
        self.exchange()?;
        self.controller.exit_initialization()?;
        self.plant.exit_initialization()
    }

    fn step(&mut self, time: f64, size: f64, order: Order) -> Result<(), fmu::Error> {
        self.exchange()?;
        if order == Order::ControllerFirst {
            self.controller.do_step(time, size)?;
            self.commands.carry(&mut self.controller, &mut self.plant)?;
            return self.plant.do_step(time, size);
        }
        self.plant.do_step(time, size)?;
        if order == Order::PlantFirst {
            self.measurements.carry(&mut self.plant, &mut self.controller)?;
        }
        self.controller.do_step(time, size)
    }

    fn exchange(&mut self) -> Result<(), fmu::Error> {
        self.commands.carry(&mut self.controller, &mut self.plant)?;
        self.measurements.carry(&mut self.plant, &mut self.controller)
    }
}
