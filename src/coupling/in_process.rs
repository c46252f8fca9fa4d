//! Both units without FMUs: the same instances, the same bits, in this process.

use super::{Coupling, Port, Unit};
use crate::fmi::v2::{Error, Instance};
use crate::fmi::{Identity, Model, Naming};
use crate::parameters::{Parameters, Structure};
use crate::units::controller::ControllerUnit;
use crate::units::plant::PlantUnit;
use crate::variables::{Causality, Kind, Variable};

/// A controller and a plant in this process.
pub type Pair = Coupling<Instance<ControllerUnit>, Instance<PlantUnit>>;

/// Both units of a `structure` with the same `parameters`, connected.
///
/// # Errors
/// If a unit does not know its own variables.
pub fn pair(structure: Structure, parameters: &Parameters) -> Result<Pair, Error> {
    Coupling::between(
        instance::<ControllerUnit>(structure, |data| data.parameters.clone_from(parameters)),
        instance::<PlantUnit>(structure, |data| data.parameters.clone_from(parameters)),
    )
}

/// An instance of a unit whose start values are changed by `set`.
pub fn instance<M: Model<Structure = Structure>>(structure: Structure, set: impl FnOnce(&mut M::Data)) -> Instance<M> {
    let mut start = M::start(structure);
    set(&mut start);
    Instance::new(Identity { structure, naming: Naming::Structured, start })
}

/// Values are numbers: truth is 1, an alternative its number.
impl<M: Model> Unit for Instance<M> {
    type Selection = Vec<u32>;
    type Values = Vec<f64>;
    type Error = Error;

    fn ports(&self) -> Vec<Port<'_>> {
        let connected = |variable: &&Variable<_>| matches!(variable.causality, Causality::Input | Causality::Output);
        self.variables().iter().filter(connected).map(port).collect()
    }

    fn select(&self, names: &[&str]) -> Result<(Vec<u32>, Vec<f64>), Error> {
        let variables = self.variables();
        let reference = |name: &&str| {
            let found = (0..).zip(variables).find(|(_, variable)| variable.name == **name);
            found.map(|(reference, _)| reference).ok_or_else(|| Error::UnknownName((*name).to_owned()))
        };
        let references = names.iter().map(reference).collect::<Result<Vec<_>, _>>()?;
        let values = vec![0.0; references.len()];
        Ok((references, values))
    }

    fn read(&mut self, selection: &Vec<u32>, values: &mut Vec<f64>) -> Result<(), Error> {
        self.get(selection, values)
    }

    fn write(&mut self, selection: &Vec<u32>, values: &Vec<f64>) -> Result<(), Error> {
        self.set(selection, values)
    }

    fn begin(&mut self, start: f64, stop: f64) -> Result<(), Error> {
        self.setup_experiment(start, Some(stop))?;
        self.enter_initialization()
    }

    fn initialize(&mut self) -> Result<(), Error> {
        self.exit_initialization()
    }

    fn step(&mut self, from: f64, size: f64) -> Result<(), Error> {
        self.do_step(from, size)
    }

    fn end(&mut self) -> Result<(), Error> {
        self.terminate()
    }
}

fn port<D>(variable: &Variable<D>) -> Port<'_> {
    let data_type = match variable.kind {
        Kind::Real { .. } => "Real",
        Kind::Boolean { .. } => "Boolean",
        Kind::Enumeration { .. } => "Enumeration",
    };
    Port { name: &variable.name, causality: variable.causality, data_type }
}
