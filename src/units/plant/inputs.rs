//! The inputs of the plant.

use super::Data;
use crate::parameters::Structure;
use crate::units::Balancing;
use crate::variables::unit;
use crate::variables::{Bounds, Causality, Table, Variability};

pub(super) fn declare(table: &mut Table<Data>, structure: Structure) {
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
            &mut d.inputs.load.altitude
        })
        .real("autopilot.roll_reference", &unit::RADIAN, Bounds::ANY, "Wanted roll of the UAV", |d, _| {
            &mut d.inputs.load.roll
        })
        .real(
            "autopilot.thrust_feedforward",
            &unit::NEWTON,
            Bounds::ANY,
            "Added to the thrust of the pid autopilot",
            |d, _| &mut d.inputs.load.thrust_feedforward,
        )
        .real("autopilot.thrust_command", &unit::NEWTON, Bounds::ANY, "Thrust, if the autopilot is external", |d, _| {
            &mut d.inputs.load.thrust
        })
        .real(
            "autopilot.torque_command",
            &unit::NEWTON_METRE,
            Bounds::ANY,
            "Torque on the UAV, if the autopilot is external",
            |d, _| &mut d.inputs.load.torque,
        )
        .real(
            "base.external_force_x",
            &unit::NEWTON,
            Bounds::ANY,
            "External force on the UAV at its centre of mass, to the right",
            |d, _| &mut d.inputs.load.base_force.x,
        )
        .real(
            "base.external_force_y",
            &unit::NEWTON,
            Bounds::ANY,
            "External force on the UAV at its centre of mass, upwards",
            |d, _| &mut d.inputs.load.base_force.y,
        )
        .real("base.external_torque", &unit::NEWTON_METRE, Bounds::ANY, "External torque on the UAV", |d, _| {
            &mut d.inputs.load.base_torque
        })
        .real(
            "end_effector.external_force_x",
            &unit::NEWTON,
            Bounds::ANY,
            "External force on the end effector, to the right",
            |d, _| &mut d.inputs.load.tip_force.x,
        )
        .real(
            "end_effector.external_force_y",
            &unit::NEWTON,
            Bounds::ANY,
            "External force on the end effector, upwards",
            |d, _| &mut d.inputs.load.tip_force.y,
        )
        .real(
            "end_effector.external_torque",
            &unit::NEWTON_METRE,
            Bounds::ANY,
            "External torque on the last link",
            |d, _| &mut d.inputs.load.tip_torque,
        );
}
