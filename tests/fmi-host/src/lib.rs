//! The FMUs as a host that is not ours sees them: built once, loaded by the `fmi` crate, coupled by a
//! plain parallel master.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Mutex;

use fmi::fmi2::Fmi2Error;
use fmi::fmi2::import::Fmi2Import;
use fmi::fmi2::instance::{CoSimulation, Common, InstanceCS};
use fmi::fmi2::schema::{Causality, ScalarVariableElement};
use fmi::traits::FmiImport;
use fmu_build::{BuildOptions, Built, build};
use uam::Structure;

mod log;
mod master;

pub use log::Messages;
pub use master::{Coupling, Track, steps};

/// The files of one structure. They are built at the first call of a process; several processes at once do
/// no harm, for equal files replace each other as a whole.
#[must_use]
pub fn built(structure: Structure) -> Built {
    static BUILT: Mutex<Option<HashMap<Structure, Built>>> = Mutex::new(None);
    let mut built = BUILT.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let files = built.get_or_insert_default().entry(structure).or_insert_with(|| {
        let folder = target_folder().join("fmi-host").join(structure.to_string().replace(' ', "-"));
        build(&BuildOptions::new(structure, folder), &|_| ()).unwrap_or_else(|error| panic!("{error}"))
    });
    files.clone()
}

/// Where the running test lies: `target/debug`, or what stands for it.
fn target_folder() -> PathBuf {
    let program = std::env::current_exe().unwrap();
    program.parent().and_then(|dependencies| dependencies.parent()).unwrap().to_owned()
}

/// A unit's FMU, unpacked and read.
#[derive(Debug)]
pub struct Unit {
    import: Fmi2Import,
    variables: HashMap<String, Variable>,
}

#[derive(Debug, Clone, Copy)]
struct Variable {
    reference: u32,
    kind: Kind,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Real,
    Integer,
    Boolean,
}

impl Unit {
    /// The controller of a structure.
    #[must_use]
    pub fn controller(structure: Structure) -> Self {
        Self::new(fmi::import::from_path(built(structure).controller).unwrap())
    }

    /// The plant of a structure.
    #[must_use]
    pub fn plant(structure: Structure) -> Self {
        Self::new(fmi::import::from_path(built(structure).plant).unwrap())
    }

    /// What the crate has read.
    #[must_use]
    pub fn new(import: Fmi2Import) -> Self {
        let variables = import.model_description().get_model_variables();
        let variables = variables.map(|variable| {
            let kind = match variable.elem {
                ScalarVariableElement::Real(_) => Kind::Real,
                ScalarVariableElement::Boolean(_) => Kind::Boolean,
                ScalarVariableElement::Integer(_) | ScalarVariableElement::Enumeration => Kind::Integer,
                ScalarVariableElement::String => panic!("{} is a text", variable.name),
            };
            (variable.name.clone(), Variable { reference: variable.value_reference, kind })
        });
        Self { variables: variables.collect(), import }
    }

    /// The unpacked FMU.
    #[must_use]
    pub fn import(&self) -> &Fmi2Import {
        &self.import
    }

    /// Names of the variables of a causality, in the order of the model description.
    #[must_use]
    pub fn names(&self, causality: &Causality) -> Vec<String> {
        let variables = self.import.model_description().get_model_variables();
        variables.filter(|variable| variable.causality == *causality).map(|variable| variable.name.clone()).collect()
    }

    /// Names of the outputs.
    #[must_use]
    pub fn outputs(&self) -> Vec<String> {
        self.names(&Causality::Output)
    }

    /// The value reference of a variable.
    #[must_use]
    pub fn reference(&self, name: &str) -> u32 {
        self.variable(name).reference
    }

    fn variable(&self, name: &str) -> Variable {
        *self.variables.get(name).unwrap_or_else(|| panic!("there is no variable {name}"))
    }

    /// A new instance.
    #[must_use]
    pub fn instantiate(&self, name: &str) -> Slave<'_> {
        let instance = self.import.instantiate_cs(name, false, false);
        Slave { unit: self, instance: instance.unwrap_or_else(|error| panic!("{name}: {error}")) }
    }
}

/// An instance of a unit.
#[derive(Debug)]
pub struct Slave<'a> {
    unit: &'a Unit,
    /// The crate's own handle, for everything that needs no names.
    pub instance: InstanceCS,
}

impl Slave<'_> {
    /// Sets a variable by its own type.
    ///
    /// # Errors
    /// If the unit refuses the value.
    pub fn try_set(&mut self, name: &str, value: f64) -> Result<(), Fmi2Error> {
        let Variable { reference, kind } = self.unit.variable(name);
        #[expect(clippy::cast_possible_truncation, reason = "whoever sets a whole number gives one")]
        let number = value as i32;
        match kind {
            Kind::Real => self.instance.set_real(&[reference], &[value]),
            Kind::Integer => self.instance.set_integer(&[reference], &[number]),
            Kind::Boolean => self.instance.set_boolean(&[reference], &[number]),
        }
        .map(|_| ())
    }

    /// Sets a variable that the unit must accept.
    pub fn set(&mut self, name: &str, value: f64) {
        self.try_set(name, value).unwrap_or_else(|error| panic!("{name} = {value}: {error}"));
    }

    /// Reads a variable by its own type.
    pub fn get(&mut self, name: &str) -> f64 {
        let Variable { reference, kind } = self.unit.variable(name);
        let (mut real, mut number) = ([0.0], [0]);
        match kind {
            Kind::Real => self.instance.get_real(&[reference], &mut real),
            Kind::Integer => self.instance.get_integer(&[reference], &mut number),
            Kind::Boolean => self.instance.get_boolean(&[reference], &mut number),
        }
        .unwrap_or_else(|error| panic!("{name}: {error}"));
        if kind == Kind::Real { real[0] } else { f64::from(number[0]) }
    }

    /// From instantiation to the first communication point.
    pub fn initialize(&mut self, start: f64, stop: Option<f64>) {
        self.instance.setup_experiment(None, start, stop).unwrap();
        self.instance.enter_initialization_mode().unwrap();
        self.instance.exit_initialization_mode().unwrap();
    }

    /// Advances by `size`.
    ///
    /// # Errors
    /// If the unit does not do the step.
    pub fn step(&mut self, from: f64, size: f64) -> Result<(), Fmi2Error> {
        self.instance.do_step(from, size, true).map(|_| ())
    }

    /// All outputs, bit by bit.
    #[must_use]
    pub fn outputs(&mut self) -> Vec<(String, u64)> {
        let names = self.unit.outputs();
        let values: Vec<u64> = names.iter().map(|name| self.get(name).to_bits()).collect();
        names.into_iter().zip(values).collect()
    }
}
