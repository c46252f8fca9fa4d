//! `uam_controller`: the inverse kinematics as a co-simulation unit.

mod derivatives;

use super::start::{BALANCE, GEOMETRY, PLAN};
use super::{Balancing, declare_time};
use crate::bytes::{Memory, Tape};
use crate::control::{self, Inputs, OutputDerivatives, Outputs};
use crate::error::Error;
use crate::fmi::{CommunicationStep, Model};
use crate::parameters::culprit::blame;
use crate::parameters::defaults::default_parameters;
use crate::parameters::{self, Parameters, Structure};
use crate::variables::options::Choice;
use crate::variables::unit;
use crate::variables::{Bounds, Causality, Table, Variability};

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

impl AsMut<Parameters> for Data {
    fn as_mut(&mut self) -> &mut Parameters {
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

    type Structure = Structure;
    type Data = Data;
    type Error = Error;

    fn structures() -> impl Iterator<Item = Structure> {
        Structure::all()
    }

    fn table(structure: Structure) -> Table<Data> {
        let mut table = Table::default();
        declare_time(&mut table, |d: &mut Data, _| &mut d.time);
        parameters::declare_shared(&mut table, structure);
        parameters::declare_controller(&mut table, structure);
        declare_inputs(&mut table);
        declare_outputs(&mut table, structure);
        table.differentiate(derivatives::ALL);
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

    fn restore(structure: Structure, data: &Data, tape: &mut Tape<'_>) -> Result<Self, Error> {
        let mut planner = control::without_plan(structure, &data.parameters)?;
        planner.pass(tape);
        tape.check()?;
        planner.check_memory()?;
        Ok(Self(planner))
    }
}

fn declare_inputs(table: &mut Table<Data>) {
    table
        .group(Causality::Input, Variability::Continuous)
        .real(
            "external_reference.x",
            &unit::METRE,
            Bounds::ANY,
            "Wanted position of the end effector, to the right",
            |d, _| &mut d.inputs.position.x,
        )
        .real(
            "external_reference.y",
            &unit::METRE,
            Bounds::ANY,
            "Wanted position of the end effector, upwards",
            |d, _| &mut d.inputs.position.y,
        )
        .real(
            "external_reference.vx",
            &unit::METRE_PER_SECOND,
            Bounds::ANY,
            "Wanted velocity of the end effector, to the right",
            |d, _| &mut d.inputs.velocity.x,
        )
        .real(
            "external_reference.vy",
            &unit::METRE_PER_SECOND,
            Bounds::ANY,
            "Wanted velocity of the end effector, upwards",
            |d, _| &mut d.inputs.velocity.y,
        )
        .real(
            "external_reference.ax",
            &unit::METRE_PER_SECOND2,
            Bounds::ANY,
            "Wanted acceleration of the end effector, to the right",
            |d, _| &mut d.inputs.acceleration.x,
        )
        .real(
            "external_reference.ay",
            &unit::METRE_PER_SECOND2,
            Bounds::ANY,
            "Wanted acceleration of the end effector, upwards",
            |d, _| &mut d.inputs.acceleration.y,
        );
}

fn declare_outputs(table: &mut Table<Data>, structure: Structure) {
    for i in 0..structure.links {
        let n = i + 1;
        table.output().at(i).initially_from(&[PLAN]).real(
            format!("joint[{n}].rate_command"),
            &unit::RADIAN_PER_SECOND,
            Bounds::ANY,
            format!("Rate for joint {n} now, after any jump"),
            |d, i| &mut d.outputs.rate_command[i],
        );
    }
    if let Some(Balancing { name, noun, moved_by, units: [_, rate, ..], .. }) = Balancing::new(structure.balance) {
        table.output().at(structure.links).initially_from(&[PLAN]).real(
            format!("{name}.rate_command"),
            rate,
            Bounds::ANY,
            format!("Rate for the {noun} now, after any jump; 0, except with {}", moved_by.name()),
            |d, i| &mut d.outputs.rate_command[i],
        );
    }
    for i in 0..structure.links {
        let n = i + 1;
        table.output().at(i).initially_from(&[PLAN]).real(
            format!("joint[{n}].acceleration_command"),
            &unit::RADIAN_PER_SECOND2,
            Bounds::ANY,
            format!("Acceleration for joint {n} until the next communication point; 0 with a hold of zero order"),
            |d, i| &mut d.outputs.acceleration_command[i],
        );
    }
    if let Some(Balancing { name, noun, units: [_, _, acceleration, ..], .. }) = Balancing::new(structure.balance) {
        table.output().at(structure.links).initially_from(&[PLAN]).real(
            format!("{name}.acceleration_command"),
            acceleration,
            Bounds::ANY,
            format!("Acceleration for the {noun} until the next communication point; 0 with a hold of zero order"),
            |d, i| &mut d.outputs.acceleration_command[i],
        );
    }
    table.group(Causality::Output, Variability::Discrete).initially_from(&[&["payload.grasp_time"]]).boolean(
        "grasp",
        "Whether the payload is to be held",
        |d, _| &mut d.outputs.grasp,
    );
    table
        .output()
        .initially_from(&[GEOMETRY])
        .real(
            "reference.x",
            &unit::METRE,
            Bounds::ANY,
            "Wanted position of the end effector now, to the right",
            |d, _| &mut d.outputs.reference.x,
        )
        .real("reference.y", &unit::METRE, Bounds::ANY, "Wanted position of the end effector now, upwards", |d, _| {
            &mut d.outputs.reference.y
        });
    table
        .output()
        .real(
            "reference.vx",
            &unit::METRE_PER_SECOND,
            Bounds::ANY,
            "Wanted velocity of the end effector now, to the right",
            |d, _| &mut d.outputs.reference_velocity.x,
        )
        .real(
            "reference.vy",
            &unit::METRE_PER_SECOND,
            Bounds::ANY,
            "Wanted velocity of the end effector now, upwards",
            |d, _| &mut d.outputs.reference_velocity.y,
        );
    table
        .output()
        .real("predicted.base.x", &unit::METRE, Bounds::ANY, "Predicted position of the UAV, to the right", |d, _| {
            &mut d.outputs.predicted_pose.x
        })
        .real("predicted.base.y", &unit::METRE, Bounds::ANY, "Predicted position of the UAV, upwards", |d, _| {
            &mut d.outputs.predicted_pose.y
        })
        .real("predicted.base.roll", &unit::RADIAN, Bounds::ANY, "Predicted roll of the UAV", |d, _| {
            &mut d.outputs.predicted_pose.z
        })
        .real(
            "predicted.base.vx",
            &unit::METRE_PER_SECOND,
            Bounds::ANY,
            "Predicted velocity of the UAV, to the right",
            |d, _| &mut d.outputs.predicted_velocity.x,
        )
        .real(
            "predicted.base.vy",
            &unit::METRE_PER_SECOND,
            Bounds::ANY,
            "Predicted velocity of the UAV, upwards",
            |d, _| &mut d.outputs.predicted_velocity.y,
        )
        .real(
            "predicted.base.roll_rate",
            &unit::RADIAN_PER_SECOND,
            Bounds::ANY,
            "Predicted angular velocity of the UAV",
            |d, _| &mut d.outputs.predicted_velocity.z,
        );
    table
        .output()
        .initially_from(&[GEOMETRY])
        .real(
            "predicted.end_effector.x",
            &unit::METRE,
            Bounds::ANY,
            "Predicted position of the end effector, to the right",
            |d, _| &mut d.outputs.predicted_end_effector.x,
        )
        .real(
            "predicted.end_effector.y",
            &unit::METRE,
            Bounds::ANY,
            "Predicted position of the end effector, upwards",
            |d, _| &mut d.outputs.predicted_end_effector.y,
        );
    for i in 0..structure.links {
        let n = i + 1;
        table.output().at(i).initially_from(&[&["joint.start"]]).real(
            format!("predicted.joint[{n}].position"),
            &unit::RADIAN,
            Bounds::ANY,
            format!("Predicted angle of joint {n}"),
            |d, i| &mut d.outputs.predicted_position[i],
        );
    }
    if let Some(Balancing { name, place, units: [position, ..], .. }) = Balancing::new(structure.balance) {
        table.output().at(structure.links).initially_from(&[BALANCE]).real(
            format!("predicted.{name}.position"),
            position,
            Bounds::ANY,
            format!("{place}, predicted"),
            |d, i| &mut d.outputs.predicted_position[i],
        );
    }
    table.group(Causality::Output, Variability::Discrete).initially_from(&[PLAN]).choice(
        "ik.status",
        "How the present rates came about",
        |d, _| &mut d.outputs.status,
    );
    table
        .output()
        .initially_from(&[PLAN])
        .real(
            "ik.min_singular_value",
            &unit::METRE,
            Bounds::ANY,
            "Smallest singular value of the generalized Jacobian of the end effector's position",
            |d, _| &mut d.outputs.min_singular_value,
        )
        .real(
            "ik.velocity_residual",
            &unit::METRE_PER_SECOND,
            Bounds::ANY,
            "How far the present rates miss the wanted mean velocity of the end effector",
            |d, _| &mut d.outputs.velocity_residual,
        )
        .real(
            "ik.moment_residual",
            &unit::NEWTON_METRE,
            Bounds::ANY,
            "Predicted mean moment of all that the UAV carries on the UAV under the present rates",
            |d, _| &mut d.outputs.moment_residual,
        );
    table.output().real(
        "ik.late_miss",
        &unit::METRE,
        Bounds::ANY,
        "How far the finished plan has ended from where it said it would, relative to the reference, because the host's \
         steps, or an external reference, were not those that it was made for",
        |d, _| &mut d.outputs.late_miss,
    );
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
