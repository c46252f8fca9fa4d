//! `uam_controller`: the inverse kinematics as a co-simulation unit.

mod inputs;
mod outputs;

use std::sync::Arc;

use crate::bytes::{Memory, Tape};
use crate::control::{self, Inputs, OutputDerivatives, Outputs};
use crate::error::Error;
use crate::fmi::{CommunicationStep, Model};
use crate::parameters::culprit::blame;
use crate::parameters::defaults::default_parameters;
use crate::parameters::{self, Parameters, Structure};
use crate::reference::PathTable;
use crate::variables::Table;
use crate::variables::declare::{Part, declare};

/// All that the host sees of the controller.
#[derive(Debug, Clone)]
pub struct Data {
    /// Independent variable \[s\].
    pub time: f64,
    /// Parameters.
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

/// The controller unit.
#[derive(Clone)]
pub struct ControllerUnit(Box<dyn control::Planner>);

impl Memory for ControllerUnit {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        self.0.pass(tape);
    }
}

impl Model for ControllerUnit {
    const IDENTIFIER: &'static str = "uam_controller";
    const DESCRIPTION: &'static str =
        "Inverse kinematics of an aerial manipulator: joint rates that follow a path although the hovering base reacts";

    const INTERFACE_VERSION: u32 = super::INTERFACE_VERSION;
    const ROWS: &'static str = "path";

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
        parameters::declare_controller(&mut table, structure);
        inputs::declare(&mut table);
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
            let mut planner = control::without_plan(structure, &data.parameters)?;
            planner.begin(&mut data.outputs)?;
            data.outputs.check(0.0).map(|()| Self(planner))
        };
        begin(data).map_err(|error| blame(structure, data, begin, error))
    }

    fn tune(&mut self, data: &Data) {
        self.0.tune(&data.parameters);
    }

    fn step(&mut self, data: &mut Data, step: CommunicationStep) -> Result<(), Error> {
        let t = step.from - step.start_time;
        self.0.step(&data.inputs, t, step.size, &mut data.outputs)?;
        if let Err(error) = data.outputs.check(t + step.size) {
            // A failure leaves nothing that is not finite.
            data.outputs = Outputs::default();
            return Err(error);
        }
        Ok(())
    }

    fn differentiate(&self, data: &mut Data, elapsed: f64) {
        data.rates = self.0.output_derivatives(elapsed);
    }

    fn rows(data: &Data) -> Vec<Vec<f64>> {
        data.parameters.reference.table.iter().flat_map(|table| table.rows()).collect()
    }

    fn take_rows(data: &mut Data, rows: &[Vec<f64>]) -> Result<(), String> {
        let table = PathTable::new(rows).map_err(|error| error.to_string())?;
        data.parameters.reference.table = Some(Arc::new(table));
        Ok(())
    }

    fn has_same_rows(one: &Data, other: &Data) -> bool {
        one.parameters.reference.table == other.parameters.reference.table
    }

    fn restore(structure: Structure, data: &Data, tape: &mut Tape<'_>) -> Result<Self, Error> {
        let mut planner = control::without_plan(structure, &data.parameters)?;
        planner.pass(tape);
        tape.check()?;
        planner.check_memory()?;
        Ok(Self(planner))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::Leg;

    /// A path that is faster than any number can say, and begins where no plan is due: each value of it is within bounds.
    #[test]
    fn outputs_that_overflow_are_an_error_and_are_not_handed_out() {
        let mut data = ControllerUnit::start(Structure::DEFAULT);
        data.parameters.ik.sample_time = 1.0;
        data.parameters.reference.legs = [Leg::NONE; _];
        data.parameters.reference.legs[0] = Leg { start: 0.01, duration: 0.1, ramp: 0.03, dx: 1e308, ..Leg::NONE };
        data.parameters.reference.legs[1] = Leg { dx: -1e308, ..data.parameters.reference.legs[0] };
        data.parameters.reference.legs[1].start = 0.5;
        let mut controller = ControllerUnit::initialize(Structure::DEFAULT, &mut data, 0.0).unwrap();
        let step = |n: i32| CommunicationStep { start_time: 0.0, from: f64::from(n) * 1e-2, size: 1e-2 };
        let error = (0..20).find_map(|n| controller.step(&mut data, step(n)).err()).unwrap().to_string();
        assert!(error.contains("velocity of the reference"), "{error}");
        data.outputs.check(0.0).unwrap();
    }
}
