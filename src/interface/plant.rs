//! `uam_plant`: the multibody system as a co-simulation unit.

mod derivatives;

use super::{Balancing, declare_time};
use crate::bytes::{Memory, Tape};
use crate::defaults::default_parameters;
use crate::error::Error;
use crate::fmi2::{CommunicationStep, Model};
use crate::parameters::{self, Parameters, Structure};
use crate::plant::{self, Inputs, Outputs, Rates};
use crate::unit;
use crate::variables::{Bounds, Causality, Table, Variability};

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
    pub rates: Rates,
}

impl AsMut<Parameters> for Data {
    fn as_mut(&mut self) -> &mut Parameters {
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
        declare_time(&mut table, |d: &mut Data, _| &mut d.time);
        parameters::declare_shared(&mut table, structure);
        parameters::declare_plant(&mut table, structure);
        declare_inputs(&mut table, structure);
        declare_outputs(&mut table, structure);
        table.differentiate(derivatives::ALL);
        table.postpone(ON_DEMAND);
        table
    }

    fn start(structure: Structure) -> Data {
        Data {
            time: 0.0,
            parameters: default_parameters(structure),
            inputs: Inputs::default(),
            outputs: Outputs::default(),
            rates: Rates::default(),
        }
    }

    fn initialize(structure: Structure, data: &mut Data, _start_time: f64) -> Result<Self, Error> {
        let simulation = plant::new(structure, &data.parameters)?;
        simulation.initial_outputs(&mut data.outputs)?;
        Ok(Self(simulation))
    }

    fn step(&mut self, data: &mut Data, step: CommunicationStep) -> Result<(), Error> {
        let t = step.from - step.start_time;
        self.0.step(&data.parameters, &data.inputs, t, step.size, &mut data.outputs)?;
        // They were for this step only.
        data.inputs.slopes = None;
        Ok(())
    }

    fn observe(&self, data: &mut Data) -> Result<(), Error> {
        // A copy, so that a failure leaves nothing that is not finite.
        let mut outputs = data.outputs.clone();
        self.0.observe(&mut outputs)?;
        data.outputs = outputs;
        Ok(())
    }

    fn differentiate(&self, data: &mut Data, _: f64) {
        data.rates = self.0.rates();
    }

    fn restore(structure: Structure, data: &Data, tape: &mut Tape<'_>) -> Result<Self, Error> {
        let mut simulation = plant::new(structure, &data.parameters)?;
        simulation.pass(tape);
        tape.check()?;
        simulation.check_memory()?;
        Ok(Self(simulation))
    }

    fn pass_unnamed(data: &mut Data, tape: &mut Tape<'_>) {
        data.inputs.slopes.pass(tape);
    }
}

fn declare_inputs(table: &mut Table<Data>, structure: Structure) {
    for i in 0..structure.links {
        let n = i + 1;
        table
            .input()
            .at(i)
            .real(
                format!("joint[{n}].rate_command"),
                &unit::RADIAN_PER_SECOND,
                Bounds::ANY,
                format!("Rate of joint {n} from the beginning of the communication step, if its motor follows a rate"),
                |d, i| &mut d.inputs.rate_command[i],
            )
            .real(
                format!("joint[{n}].acceleration_command"),
                &unit::RADIAN_PER_SECOND2,
                Bounds::ANY,
                format!("Slope of the rate of joint {n} within the communication step; 0: zero-order hold"),
                |d, i| &mut d.inputs.acceleration_command[i],
            )
            .real(
                format!("joint[{n}].torque_command"),
                &unit::NEWTON_METRE,
                Bounds::ANY,
                format!("Torque of the motor of joint {n}, if that follows a torque"),
                |d, i| &mut d.inputs.joint_torque_command[i],
            );
    }
    if let Some(Balancing { name, noun, units: [_, rate, acceleration, _], .. }) = Balancing::new(structure.balance) {
        table
            .input()
            .at(structure.links)
            .real(
                format!("{name}.rate_command"),
                rate,
                Bounds::ANY,
                format!("Rate of the {noun} from the beginning of the communication step"),
                |d, i| &mut d.inputs.rate_command[i],
            )
            .real(
                format!("{name}.acceleration_command"),
                acceleration,
                Bounds::ANY,
                format!("Slope of the rate of the {noun} within the communication step; 0: zero-order hold"),
                |d, i| &mut d.inputs.acceleration_command[i],
            );
    }
    table.group(Causality::Input, Variability::Discrete).boolean(
        "grasp",
        "Rising edge, or true in the first step: the payload is taken over at rest; falling edge: it is let go",
        |d, _| &mut d.inputs.grasp,
    );
    table
        .input()
        .real("autopilot.altitude_reference", &unit::METRE, Bounds::ANY, "Wanted altitude of the UAV", |d, _| {
            &mut d.inputs.altitude_reference
        })
        .real("autopilot.roll_reference", &unit::RADIAN, Bounds::ANY, "Wanted roll of the UAV", |d, _| {
            &mut d.inputs.roll_reference
        })
        .real(
            "autopilot.thrust_feedforward",
            &unit::NEWTON,
            Bounds::ANY,
            "Added to the thrust of the pid autopilot",
            |d, _| &mut d.inputs.thrust_feedforward,
        )
        .real("autopilot.thrust_command", &unit::NEWTON, Bounds::ANY, "Thrust, if the autopilot is external", |d, _| {
            &mut d.inputs.thrust_command
        })
        .real(
            "autopilot.torque_command",
            &unit::NEWTON_METRE,
            Bounds::ANY,
            "Torque on the UAV, if the autopilot is external",
            |d, _| &mut d.inputs.torque_command,
        )
        .real(
            "base.external_force_x",
            &unit::NEWTON,
            Bounds::ANY,
            "External force on the UAV at its centre of mass, to the right",
            |d, _| &mut d.inputs.base_force.x,
        )
        .real(
            "base.external_force_y",
            &unit::NEWTON,
            Bounds::ANY,
            "External force on the UAV at its centre of mass, upwards",
            |d, _| &mut d.inputs.base_force.y,
        )
        .real("base.external_torque", &unit::NEWTON_METRE, Bounds::ANY, "External torque on the UAV", |d, _| {
            &mut d.inputs.base_torque
        })
        .real(
            "end_effector.external_force_x",
            &unit::NEWTON,
            Bounds::ANY,
            "External force on the end effector, to the right",
            |d, _| &mut d.inputs.end_effector_force.x,
        )
        .real(
            "end_effector.external_force_y",
            &unit::NEWTON,
            Bounds::ANY,
            "External force on the end effector, upwards",
            |d, _| &mut d.inputs.end_effector_force.y,
        )
        .real(
            "end_effector.external_torque",
            &unit::NEWTON_METRE,
            Bounds::ANY,
            "External torque on the last link",
            |d, _| &mut d.inputs.end_effector_torque,
        );
}

/// Parameters that decide where things are at the start.
const GEOMETRY: &[&str] = &["mount", "link.length", "joint.start"];
/// Parameters that decide where masses are at the start, without the payload.
const MASSES: &[&str] = &[
    "uav.mass",
    "mount",
    "link.mass",
    "link.length",
    "link.com",
    "joint.start",
    "counterweight.mass",
    "counterweight.start",
    "counterweight.height",
    "balance_element.mass",
    "balance_element.com",
    "balance_element.start",
];
/// Parameters that decide what holds the vehicle at rest.
const HOVER: &[&str] = &[
    "gravity",
    "autopilot.mode",
    "uav.mass",
    "mount",
    "link.mass",
    "link.length",
    "link.com",
    "joint.start",
    "counterweight.mass",
    "counterweight.start",
    "balance_element.mass",
    "balance_element.com",
    "balance_element.start",
];
/// Parameters that decide the moment of what the UAV carries at rest.
const CARRIED: &[&str] = &[
    "gravity",
    "mount",
    "link.mass",
    "link.length",
    "link.com",
    "joint.start",
    "counterweight.mass",
    "counterweight.start",
    "balance_element.mass",
    "balance_element.com",
    "balance_element.start",
];
/// Parameters that decide the torques that hold the joints at rest.
const JOINTS: &[&str] = &["gravity", "link.mass", "link.length", "link.com", "joint.start"];
/// Parameters that decide where what balances the arm is at the start.
const BALANCE_START: &[&str] = &["counterweight.start", "balance_element.start"];
/// Parameters that decide the torque that holds a balance element at rest; a counterweight needs no force.
const BALANCE_EFFORT: &[&str] = &["gravity", "balance_element.mass", "balance_element.com", "balance_element.start"];

/// What a step itself does not need: a coupling that connects none of it is spared a sixth of the time.
const ON_DEMAND: &[&str] = &[
    "base.ax",
    "base.ay",
    "base.roll_acceleration",
    "joint.torque",
    "counterweight.force",
    "balance_element.torque",
    "end_effector.x",
    "end_effector.y",
    "end_effector.vx",
    "end_effector.vy",
    "autopilot.thrust",
    "autopilot.torque",
    "transmitted.force_x",
    "transmitted.force_y",
    "transmitted.moment",
    "center_of_mass.x",
    "center_of_mass.y",
    "payload.force_x",
    "payload.force_y",
    "support.force",
];

fn declare_outputs(table: &mut Table<Data>, structure: Structure) {
    table
        .output()
        .real("base.x", &unit::METRE, Bounds::ANY, "Position of the UAV's centre of mass, to the right", |d, _| {
            &mut d.outputs.pose.x
        })
        .real("base.y", &unit::METRE, Bounds::ANY, "Position of the UAV's centre of mass, upwards", |d, _| {
            &mut d.outputs.pose.y
        })
        .real("base.roll", &unit::RADIAN, Bounds::ANY, "Roll of the UAV, counter-clockwise", |d, _| {
            &mut d.outputs.pose.z
        })
        .real(
            "base.vx",
            &unit::METRE_PER_SECOND,
            Bounds::ANY,
            "Velocity of the UAV's centre of mass, to the right",
            |d, _| &mut d.outputs.velocity.x,
        )
        .real(
            "base.vy",
            &unit::METRE_PER_SECOND,
            Bounds::ANY,
            "Velocity of the UAV's centre of mass, upwards",
            |d, _| &mut d.outputs.velocity.y,
        )
        .real("base.roll_rate", &unit::RADIAN_PER_SECOND, Bounds::ANY, "Angular velocity of the UAV", |d, _| {
            &mut d.outputs.velocity.z
        })
        .real(
            "base.ax",
            &unit::METRE_PER_SECOND2,
            Bounds::ANY,
            "Acceleration of the UAV's centre of mass, to the right",
            |d, _| &mut d.outputs.acceleration.x,
        )
        .real(
            "base.ay",
            &unit::METRE_PER_SECOND2,
            Bounds::ANY,
            "Acceleration of the UAV's centre of mass, upwards",
            |d, _| &mut d.outputs.acceleration.y,
        )
        .real(
            "base.roll_acceleration",
            &unit::RADIAN_PER_SECOND2,
            Bounds::ANY,
            "Angular acceleration of the UAV",
            |d, _| &mut d.outputs.acceleration.z,
        );
    for i in 0..structure.links {
        let n = i + 1;
        table.output().at(i).initially_from(&["joint.start"]).real(
            format!("joint[{n}].position"),
            &unit::RADIAN,
            Bounds::ANY,
            format!("Angle of joint {n}"),
            |d, i| &mut d.outputs.position[i],
        );
        table.output().at(i).real(
            format!("joint[{n}].rate"),
            &unit::RADIAN_PER_SECOND,
            Bounds::ANY,
            format!("Rate of joint {n}"),
            |d, i| &mut d.outputs.rate[i],
        );
        table.output().at(i).initially_from(JOINTS).real(
            format!("joint[{n}].torque"),
            &unit::NEWTON_METRE,
            Bounds::ANY,
            format!(
                "Torque of the motor of joint {n} on the outer link, mean over the step, jumps of the rates included"
            ),
            |d, i| &mut d.outputs.effort[i],
        );
    }
    if let Some(Balancing { name, noun, place, exerted, effort, units: [position, rate, _, effort_unit], .. }) =
        Balancing::new(structure.balance)
    {
        table.output().at(structure.links).initially_from(BALANCE_START).real(
            format!("{name}.position"),
            position,
            Bounds::ANY,
            place,
            |d, i| &mut d.outputs.position[i],
        );
        table.output().at(structure.links).real(
            format!("{name}.rate"),
            rate,
            Bounds::ANY,
            format!("Rate of the {noun}"),
            |d, i| &mut d.outputs.rate[i],
        );
        table.output().at(structure.links).initially_from(BALANCE_EFFORT).real(
            format!("{name}.{effort}"),
            effort_unit,
            Bounds::ANY,
            format!("{exerted}, mean over the step, jumps of the rates included"),
            |d, i| &mut d.outputs.effort[i],
        );
    }
    table
        .output()
        .initially_from(GEOMETRY)
        .real("end_effector.x", &unit::METRE, Bounds::ANY, "Position of the end effector, to the right", |d, _| {
            &mut d.outputs.end_effector.x
        })
        .real("end_effector.y", &unit::METRE, Bounds::ANY, "Position of the end effector, upwards", |d, _| {
            &mut d.outputs.end_effector.y
        });
    table
        .output()
        .real(
            "end_effector.vx",
            &unit::METRE_PER_SECOND,
            Bounds::ANY,
            "Velocity of the end effector, to the right",
            |d, _| &mut d.outputs.end_effector_velocity.x,
        )
        .real(
            "end_effector.vy",
            &unit::METRE_PER_SECOND,
            Bounds::ANY,
            "Velocity of the end effector, upwards",
            |d, _| &mut d.outputs.end_effector_velocity.y,
        );
    table
        .output()
        .initially_from(HOVER)
        .real(
            "autopilot.thrust",
            &unit::NEWTON,
            Bounds::ANY,
            "Thrust along the UAV's own vertical axis; mean over the step if ideal",
            |d, _| &mut d.outputs.thrust,
        )
        .real(
            "autopilot.torque",
            &unit::NEWTON_METRE,
            Bounds::ANY,
            "Torque of the rotors on the UAV; mean over the step if ideal",
            |d, _| &mut d.outputs.torque,
        );
    table
        .output()
        .initially_from(CARRIED)
        .real(
            "transmitted.force_y",
            &unit::NEWTON,
            Bounds::ANY,
            "Force upwards of all that the UAV carries on the UAV, mean over the step",
            |d, _| &mut d.outputs.transmitted_force.y,
        )
        .real(
            "transmitted.moment",
            &unit::NEWTON_METRE,
            Bounds::ANY,
            "Moment about the UAV's centre of mass of all that the UAV carries on the UAV, mean over the step",
            |d, _| &mut d.outputs.transmitted_moment,
        );
    table
        .output()
        .real(
            "transmitted.force_x",
            &unit::NEWTON,
            Bounds::ANY,
            "Force to the right of all that the UAV carries on the UAV, mean over the step",
            |d, _| &mut d.outputs.transmitted_force.x,
        )
        .real("momentum.x", &unit::NEWTON_SECOND, Bounds::ANY, "Momentum of the whole system, to the right", |d, _| {
            &mut d.outputs.momentum.x
        })
        .real("momentum.y", &unit::NEWTON_SECOND, Bounds::ANY, "Momentum of the whole system, upwards", |d, _| {
            &mut d.outputs.momentum.y
        })
        .real(
            "momentum.angular",
            &unit::NEWTON_METRE_SECOND,
            Bounds::ANY,
            "Angular momentum of the whole system about the UAV's centre of mass, of absolute velocities",
            |d, _| &mut d.outputs.momentum.z,
        );
    table
        .output()
        .initially_from(MASSES)
        .real(
            "center_of_mass.x",
            &unit::METRE,
            Bounds::ANY,
            "Centre of mass of the whole system, to the right",
            |d, _| &mut d.outputs.center_of_mass.x,
        )
        .real("center_of_mass.y", &unit::METRE, Bounds::ANY, "Centre of mass of the whole system, upwards", |d, _| {
            &mut d.outputs.center_of_mass.y
        });
    table.group(Causality::Output, Variability::Discrete).boolean(
        "payload.attached",
        "Whether the payload is held",
        |d, _| &mut d.outputs.attached,
    );
    table
        .output()
        .real(
            "payload.force_x",
            &unit::NEWTON,
            Bounds::ANY,
            "Force to the right of the held payload on the arm, mean over the step",
            |d, _| &mut d.outputs.payload_force.x,
        )
        .real(
            "payload.force_y",
            &unit::NEWTON,
            Bounds::ANY,
            "Force upwards of the held payload on the arm, mean over the step",
            |d, _| &mut d.outputs.payload_force.y,
        )
        .real(
            "support.force",
            &unit::NEWTON,
            Bounds::ANY,
            "Force of the support on the held payload, upwards",
            |d, _| &mut d.outputs.support_force,
        );
    table.output().real("timestamp", &unit::SECOND, Bounds::ANY, "Time of the outputs", |d, _| &mut d.time);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All that is no output on demand is right after the step already, and all names in the list are outputs.
    #[test]
    fn outputs_on_demand_are_those_that_the_step_leaves_out() {
        let mut left = ON_DEMAND.to_vec();
        for structure in Structure::all() {
            let table = PlantUnit::table(structure);
            let mut data = PlantUnit::start(structure);
            let mut plant = PlantUnit::initialize(structure, &mut data, 0.0).unwrap();
            data.inputs.rate_command = std::array::from_fn(|i| 1.0 - 0.3 * i as f64);
            plant.step(&mut data, CommunicationStep { start_time: 0.0, from: 0.0, size: 1e-3 }).unwrap();
            let mut observed = data.clone();
            plant.observe(&mut observed).unwrap();
            for variable in table.variables().iter().filter(|variable| variable.causality == Causality::Output) {
                let name = &variable.name;
                if let (Some(now), Some(then)) = (variable.real(&mut data).copied(), variable.real(&mut observed)) {
                    assert!(variable.on_demand || now.to_bits() == then.to_bits(), "{structure}: {name}");
                }
                left.retain(|plain| !variable.on_demand || *plain != crate::variables::plain(name));
            }
        }
        assert!(left.is_empty(), "{left:?}");
    }
}
