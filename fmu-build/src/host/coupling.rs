//! FMUs as units that can be coupled.

use std::path::Path;

use uam::coupling::{self, Port, Unit};
pub use uam::coupling::{MOST_STEPS, Order, Schedule, ScheduleError};
use uam::units::controller::ControllerUnit;
use uam::units::plant::PlantUnit;
use uam::{Parameters, Structure};

use crate::host::fmu::{self, Causality, DataType, Fmu, Instance, Selection, Values};
use crate::host::record::NotRecorded;
use crate::host::settings;

/// One instance of each FMU, connected.
pub type Coupling = coupling::Coupling<Instance, Instance>;

/// A coupling that cannot be set up or cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// Of a unit, before, during or after the run.
    #[error(transparent)]
    Run(#[from] coupling::Error<fmu::Error>),
    /// A structure whose FMUs nobody has built.
    #[error("the FMUs for {structure} were not built")]
    NotBuilt {
        /// The structure.
        structure: Structure,
    },
    /// Parameters with which a run makes no sense.
    #[error(transparent)]
    Parameters(#[from] uam::Error),
    /// What a run should have recorded.
    #[error(transparent)]
    NotRecorded(#[from] NotRecorded),
    /// A schedule that makes no sense.
    #[error(transparent)]
    Schedule(#[from] ScheduleError),
}

impl From<fmu::Error> for Error {
    fn from(error: fmu::Error) -> Self {
        coupling::Error::Unit(error).into()
    }
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

    /// Instantiates and connects both units.
    ///
    /// # Errors
    /// If one of them does not start.
    pub fn couple(&self) -> Result<Coupling, fmu::Error> {
        Coupling::between(self.controller.instantiate("controller")?, self.plant.instantiate("plant")?)
    }
}

/// Sets the parameters of both units.
///
/// # Errors
/// If the units have other parameters, or do not accept a value.
pub fn configure(coupling: &mut Coupling, structure: Structure, parameters: &Parameters) -> Result<(), fmu::Error> {
    coupling.controller.set_values(&settings::named_values::<ControllerUnit>(structure, parameters))?;
    coupling.plant.set_values(&settings::named_values::<PlantUnit>(structure, parameters))
}

impl Unit for Instance {
    type Selection = Selection;
    type Values = Values;
    type Error = fmu::Error;

    fn ports(&self) -> Vec<Port<'_>> {
        use uam::variables::Causality::{Input, Output};
        let port = |causality, kind| {
            let data_type = |data_type| match data_type {
                DataType::Real => "Real",
                DataType::Integer => "Integer",
                DataType::Enumeration => "Enumeration",
                DataType::Boolean => "Boolean",
                DataType::String => "String",
            };
            self.description().with(kind).map(move |variable| Port {
                name: &variable.name,
                causality,
                data_type: data_type(variable.data_type),
            })
        };
        port(Input, Causality::Input).chain(port(Output, Causality::Output)).collect()
    }

    fn select(&self, names: &[&str]) -> Result<(Selection, Values), fmu::Error> {
        let selection = Selection::new(self.description(), names.iter().copied())?;
        let values = selection.values();
        Ok((selection, values))
    }

    #[inline]
    fn read(&mut self, selection: &Selection, values: &mut Values) -> Result<(), fmu::Error> {
        self.get(selection, values)
    }

    #[inline]
    fn write(&mut self, selection: &Selection, values: &Values) -> Result<(), fmu::Error> {
        self.set(selection, values)
    }

    fn begin(&mut self, start: f64, stop: f64) -> Result<(), fmu::Error> {
        self.enter_initialization(start, stop)
    }

    fn initialize(&mut self) -> Result<(), fmu::Error> {
        self.exit_initialization()
    }

    #[inline]
    fn step(&mut self, from: f64, size: f64) -> Result<(), fmu::Error> {
        self.do_step(from, size)
    }

    fn end(&mut self) -> Result<(), fmu::Error> {
        self.terminate()
    }
}
