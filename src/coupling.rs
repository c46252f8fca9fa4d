//! Controller and plant, coupled by a fixed-step master.
//!
//! The master knows nothing of how a unit is made: whatever implements [`Unit`] can be coupled, FMUs behind their C
//! interface as well as the same models [in this process](in_process). Outputs are connected to the inputs of the other
//! unit that have the same name and type.
//!
//! ```
//! use uam::coupling::{Schedule, in_process};
//! use uam::parameters::defaults::default_parameters;
//! use uam::Structure;
//!
//! let structure = Structure::DEFAULT;
//! let mut coupling = in_process::pair(structure, &default_parameters(structure))?;
//! let schedule = Schedule::new(0.0, 0.1, 1e-3)?;
//! coupling.run(&schedule, &mut |_time, _controller, _plant| Ok(()))?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod in_process;
mod schedule;
mod wires;

pub use schedule::{Interval, MOST_STEPS, Schedule, ScheduleError};
pub use wires::{Port, Wires};

/// Something with named variables that can be stepped: an instance of a co-simulation unit.
///
/// Variables are looked up by name once, when they are selected; in the loop selections are read and written as a whole,
/// without allocation.
pub trait Unit {
    /// Variables that are read or written together.
    type Selection: std::fmt::Debug;
    /// Room for their values.
    type Values: std::fmt::Debug;
    /// Why a call failed.
    type Error: std::error::Error + 'static;

    /// Inputs and outputs in the order of declaration.
    fn ports(&self) -> Vec<Port<'_>>;

    /// Prepares the variables with these names, and room for their values.
    ///
    /// # Errors
    /// If there is none of one of these names.
    fn select(&self, names: &[&str]) -> Result<(Self::Selection, Self::Values), Self::Error>;

    /// Reads selected variables.
    ///
    /// # Errors
    /// If the unit refuses.
    fn read(&mut self, selection: &Self::Selection, values: &mut Self::Values) -> Result<(), Self::Error>;

    /// Writes selected variables.
    ///
    /// # Errors
    /// If the unit refuses.
    fn write(&mut self, selection: &Self::Selection, values: &Self::Values) -> Result<(), Self::Error>;

    /// Tells `start` and `stop` time \[s\] and begins initialization.
    ///
    /// # Errors
    /// If the unit refuses.
    fn begin(&mut self, start: f64, stop: f64) -> Result<(), Self::Error>;

    /// Ends initialization: outputs are right, the unit is ready for its first step.
    ///
    /// # Errors
    /// If the unit refuses, for instance because its parameters do not go together.
    fn initialize(&mut self) -> Result<(), Self::Error>;

    /// Makes one communication step from the time `from` by `size` \[s\].
    ///
    /// # Errors
    /// If the unit cannot.
    fn step(&mut self, from: f64, size: f64) -> Result<(), Self::Error>;

    /// Ends the run.
    ///
    /// # Errors
    /// If the unit refuses.
    fn end(&mut self) -> Result<(), Self::Error>;
}

/// Which values a unit steps with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// Values are exchanged, then both units step (Jacobi).
    ///
    /// Stepping the plant first and handing its new outputs to the controller changes nothing: the controller has no input
    /// that the plant gives.
    #[default]
    Parallel,
    /// The controller steps, and the plant steps with the controller's new commands: one step too early.
    ControllerFirst,
}

/// A run that cannot begin, or cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum Error<E: std::error::Error + 'static> {
    /// Before the first step, or at the end.
    #[error(transparent)]
    Unit(E),
    /// During the run.
    #[error("the run stops at t = {time} s")]
    Step {
        /// Beginning of the step that failed \[s\].
        time: f64,
        /// What the unit says.
        source: E,
    },
}

/// One instance of each unit, connected.
#[derive(Debug)]
pub struct Coupling<C: Unit, P: Unit> {
    /// The controller.
    pub controller: C,
    /// The plant.
    pub plant: P,
    /// Which unit steps with which values.
    pub order: Order,
    commands: Wires<C, P>,
    measurements: Wires<P, C>,
}

impl<E: std::error::Error + 'static, V, C, P> Coupling<C, P>
where
    C: Unit<Error = E, Values = V>,
    P: Unit<Error = E, Values = V>,
{
    /// Connects both units, in parallel.
    ///
    /// # Errors
    /// If a unit does not know its own variables.
    pub fn between(controller: C, plant: P) -> Result<Self, E> {
        let (commands, measurements) = (Wires::between(&controller, &plant)?, Wires::between(&plant, &controller)?);
        Ok(Self { controller, plant, order: Order::Parallel, commands, measurements })
    }

    /// The same, with another order of steps.
    #[must_use]
    pub fn in_order(self, order: Order) -> Self {
        Self { order, ..self }
    }

    /// How many values go from the controller to the plant, and back.
    #[must_use]
    pub fn connections(&self) -> (usize, usize) {
        (self.commands.len(), self.measurements.len())
    }

    /// Initializes both units and runs them to the end of the `schedule`. `observe` is called at the start and after every
    /// step with the time \[s\] and both units.
    ///
    /// # Errors
    /// If a unit refuses a call; what was observed until then stays valid.
    pub fn run(
        &mut self,
        schedule: &Schedule,
        observe: &mut dyn FnMut(f64, &mut C, &mut P) -> Result<(), E>,
    ) -> Result<(), Error<E>> {
        self.initialize(schedule).map_err(Error::Unit)?;
        observe(schedule.start(), &mut self.controller, &mut self.plant).map_err(Error::Unit)?;
        for interval in schedule.intervals() {
            self.step(interval.from, interval.size)
                .and_then(|()| observe(interval.to, &mut self.controller, &mut self.plant))
                .map_err(|source| Error::Step { time: interval.from, source })?;
        }
        self.controller.end().and_then(|()| self.plant.end()).map_err(Error::Unit)
    }

    /// Initializes both units for a run over the `schedule`. Initial outputs are handed over while both are in initialization:
    /// initial outputs of the other unit may depend on them.
    ///
    /// # Errors
    /// If a unit refuses.
    pub fn initialize(&mut self, schedule: &Schedule) -> Result<(), E> {
        self.controller.begin(schedule.start(), schedule.stop())?;
        self.plant.begin(schedule.start(), schedule.stop())?;
        self.exchange()?;
        self.controller.initialize()?;
        self.plant.initialize()
    }

    /// One communication step of both from the time `from` by `size` \[s\].
    ///
    /// # Errors
    /// If a unit refuses.
    pub fn step(&mut self, from: f64, size: f64) -> Result<(), E> {
        self.exchange()?;
        match self.order {
            Order::Parallel => {
                self.plant.step(from, size)?;
                self.controller.step(from, size)
            }
            Order::ControllerFirst => {
                self.controller.step(from, size)?;
                self.commands.carry(&mut self.controller, &mut self.plant)?;
                self.plant.step(from, size)
            }
        }
    }

    fn exchange(&mut self) -> Result<(), E> {
        self.commands.carry(&mut self.controller, &mut self.plant)?;
        self.measurements.carry(&mut self.plant, &mut self.controller)
    }
}
