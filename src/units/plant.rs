//! `uam_plant`: the multibody system as a co-simulation unit.

mod inputs;
mod outputs;

use crate::bytes::{Memory, Tape};
use crate::error::Error;
use crate::fmi::{CommunicationStep, Model};
use crate::parameters::culprit::blame;
use crate::parameters::defaults::default_parameters;
use crate::parameters::{self, Parameters, Structure};
use crate::pass;
use crate::plant::{self, Inputs, OutputDerivatives, Outputs};
use crate::variables::Table;
use crate::variables::declare::{Part, declare};

/// All that the host sees of the plant.
#[derive(Debug, Clone)]
pub struct Data {
    /// Independent variable \[s\].
    pub time: f64,
    /// Parameters; those of the controller are ignored.
    pub parameters: Parameters,
    /// Inputs.
    pub inputs: Inputs,
    /// Outputs.
    pub outputs: Outputs,
    /// Derivatives of outputs, where no other output is that; see [`Model::differentiate`].
    pub rates: OutputDerivatives,
}

impl Part<Parameters> for Data {
    fn part(&self) -> &Parameters {
        &self.parameters
    }

    fn part_mut(&mut self) -> &mut Parameters {
        &mut self.parameters
    }
}

/// The plant unit.
#[derive(Clone)]
pub struct PlantUnit(Box<dyn plant::Simulation>);

impl Memory for PlantUnit {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        self.0.pass(tape);
    }
}

impl Model for PlantUnit {
    const IDENTIFIER: &'static str = "uam_plant";
    const DESCRIPTION: &'static str =
        "Planar aerial manipulator: multicopter in hover with an arm, payload and elastic support";

    const INTERFACE_VERSION: u32 = super::INTERFACE_VERSION;

    type Structure = Structure;
    type Data = Data;
    type Error = Error;

    fn structures() -> impl Iterator<Item = Structure> {
        Structure::all()
    }

    fn table(structure: Structure) -> Table<Data> {
        let mut table = Table::default();
        declare! { table.independent(), Data;
            "time" [SECOND] "Simulation time"
                |d, _| d.time;
        }
        parameters::declare_shared(&mut table, structure);
        parameters::declare_plant(&mut table, structure);
        inputs::declare(&mut table, structure);
        outputs::declare(&mut table, structure);
        table
    }

    fn start(structure: Structure) -> Data {
        Data {
            time: 0.0,
            parameters: default_parameters(structure),
            inputs: Inputs::default(),
            outputs: Outputs::default(),
            rates: OutputDerivatives::default(),
        }
    }

    fn initialize(structure: Structure, data: &mut Data, _start_time: f64) -> Result<Self, Error> {
        // Called from two places, and one copy of it in the library.
        let begin: &dyn Fn(&mut Data) -> Result<Self, Error> = &|data| {
            let simulation = plant::new(structure, &data.parameters)?;
            simulation.initial_outputs(&mut data.outputs).map(|()| Self(simulation))
        };
        begin(data).map_err(|error| blame(structure, data, begin, error))
    }

    fn tune(&mut self, data: &Data) {
        self.0.tune(&data.parameters);
    }

    fn step(&mut self, data: &mut Data, step: CommunicationStep) -> Result<(), Error> {
        let t = step.from - step.start_time;
        self.0.step(&data.inputs, t, step.size, &mut data.outputs)?;
        // They were for this step only.
        data.inputs.slopes = None;
        Ok(())
    }

    fn observe(&self, data: &mut Data) -> Result<(), Error> {
        // A copy, so that a failure leaves nothing that is not finite.
        let mut outputs = data.outputs.clone();
        self.0.observe(data.time, &mut outputs)?;
        data.outputs = outputs;
        Ok(())
    }

    fn differentiate(&self, data: &mut Data, _: f64) {
        data.rates = self.0.output_derivatives();
    }

    fn restore(structure: Structure, data: &Data, tape: &mut Tape<'_>) -> Result<Self, Error> {
        let mut simulation = plant::new(structure, &data.parameters)?;
        simulation.pass(tape);
        tape.check()?;
        simulation.check_memory()?;
        Ok(Self(simulation))
    }

    fn pass_unnamed(data: &mut Data, tape: &mut Tape<'_>) {
        let slopes = &mut data.inputs.slopes;
        pass!(tape: slopes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::variables::Causality;

    /// All that is no output on demand is right after the step already; the first step moves all that is one, but for what
    /// is the same in each structure: nothing is held, and the vehicle has not moved sideways.
    #[test]
    fn outputs_on_demand_are_those_that_the_step_leaves_out() {
        for structure in Structure::all() {
            let table = PlantUnit::table(structure);
            let mut data = PlantUnit::start(structure);
            let mut plant = PlantUnit::initialize(structure, &mut data, 0.0).unwrap();
            data.inputs.rate_command = std::array::from_fn(|i| 1.0 - 0.3 * i as f64);
            plant.step(&mut data, CommunicationStep { start_time: 0.0, from: 0.0, size: 1e-3 }).unwrap();
            let mut observed = data.clone();
            plant.observe(&mut observed).unwrap();
            for variable in table.variables().iter().filter(|variable| variable.causality == Causality::Output) {
                if let (Some(now), Some(then)) = (variable.real(&data), variable.real(&observed)) {
                    let unchanged = now.to_bits() == then.to_bits();
                    let nothing_held = variable.name.starts_with("payload") || variable.name.starts_with("support");
                    assert!(unchanged != variable.on_demand || nothing_held, "{structure}: {}", variable.name);
                }
            }
        }
    }
}
