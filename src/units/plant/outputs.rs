//! The outputs of the plant: what decides them at the start, and which of them are computed on demand.

use super::Data;
use crate::parameters::Structure;
use crate::units::Balancing;
use crate::units::start::{BALANCE, BALANCE_WEIGHT, GEOMETRY, LINKS};
use crate::variables::unit;
use crate::variables::{Bounds, Causality, Table, Variability};

/// Where the masses are at the start, without the payload.
const MASSES: &[&[&str]] = &[&["uav.mass", "mount", "counterweight.height"], LINKS, BALANCE, BALANCE_WEIGHT];
/// What holds the vehicle at rest.
const HOVER: &[&[&str]] = &[&["gravity", "autopilot.mode", "uav.mass", "mount"], LINKS, BALANCE, BALANCE_WEIGHT];
/// The moment of what the UAV carries at rest.
const CARRIED: &[&[&str]] = &[&["gravity", "mount"], LINKS, BALANCE, BALANCE_WEIGHT];
/// The torque that holds a balance element at rest; a counterweight needs no force.
const BALANCE_EFFORT: &[&[&str]] =
    &[&["gravity", "balance_element.mass", "balance_element.com", "balance_element.start"]];

/// What a step itself does not need: a coupling that connects none of it is spared a sixth of the time.
pub(super) const ON_DEMAND: &[&str] = &[
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

pub(super) fn declare(table: &mut Table<Data>, structure: Structure) {
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
        table.output().at(i).initially_from(&[&["joint.start"]]).real(
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
        table.output().at(i).initially_from(&[&["gravity"], LINKS]).real(
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
        table.output().at(structure.links).initially_from(&[BALANCE]).real(
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
        .initially_from(&[GEOMETRY])
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
