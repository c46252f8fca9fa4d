//! The outputs of the plant: what decides them at the start, and which of them are computed on demand.

use super::Data;
use crate::parameters::{Balance, Structure};
use crate::units::decisive::{ANGLES, BALANCE, BALANCE_WEIGHT, GEOMETRY, LINKS};
use crate::variables::Table;
use crate::variables::declare::declare;

/// Where the masses are at the start, without the payload.
const MASSES: &[&[&str]] = &[&["uav.mass", "mount", "counterweight.height"], LINKS, BALANCE, BALANCE_WEIGHT];
/// What holds the vehicle at rest.
const HOVER: &[&[&str]] = &[&["gravity", "autopilot.mode", "uav.mass", "mount"], LINKS, BALANCE, BALANCE_WEIGHT];
/// The moment of what the UAV carries at rest.
const CARRIED: &[&[&str]] = &[&["gravity", "mount"], LINKS, BALANCE, BALANCE_WEIGHT];
/// The torque that holds a balance element at rest; a counterweight needs no force.
const BALANCE_EFFORT: &[&[&str]] =
    &[&["gravity", "balance_element.mass", "balance_element.com", "balance_element.start"]];

/// Of what changes at communication points only, of means over the step, and of accelerations, whose rates nobody
/// computes: a host that extrapolates holds them.
const HELD: fn(&Data, usize) -> f64 = |_, _| 0.0;

/// Declares the outputs. Every continuous one has a first derivative, its left limit. Those that a step itself does not need are
/// computed on demand: a coupling that connects none of them is spared a sixth of the time.
pub(super) fn declare(table: &mut Table<Data>, structure: Structure) {
    declare! { table.output(), Data;
        "base.x" [METRE] "Position of the UAV's centre of mass, to the right"
            |d, _| d.outputs.pose.x;
        "base.y" [METRE] "Position of the UAV's centre of mass, upwards"
            |d, _| d.outputs.pose.y;
        "base.roll" [RADIAN] "Roll of the UAV, counter-clockwise"
            |d, _| d.outputs.pose.z;
        "base.vx" [METRE_PER_SECOND] "Velocity of the UAV's centre of mass, to the right"
            |d, _| d.outputs.velocity.x, derivative_of("base.x");
        "base.vy" [METRE_PER_SECOND] "Velocity of the UAV's centre of mass, upwards"
            |d, _| d.outputs.velocity.y, derivative_of("base.y");
        "base.roll_rate" [RADIAN_PER_SECOND] "Angular velocity of the UAV"
            |d, _| d.outputs.velocity.z, derivative_of("base.roll");
        "base.ax" [METRE_PER_SECOND2] "Acceleration of the UAV's centre of mass, to the right"
            |d, _| d.outputs.acceleration.x, derivative_of("base.vx"), derivative(HELD), on_demand();
        "base.ay" [METRE_PER_SECOND2] "Acceleration of the UAV's centre of mass, upwards"
            |d, _| d.outputs.acceleration.y, derivative_of("base.vy"), derivative(HELD), on_demand();
        "base.roll_acceleration" [RADIAN_PER_SECOND2] "Angular acceleration of the UAV"
            |d, _| d.outputs.acceleration.z, derivative_of("base.roll_rate"), derivative(HELD), on_demand();
    }
    for i in 0..structure.links {
        let n = i + 1;
        declare! { table.output().at(i), Data;
            "joint[{n}].position" [RADIAN] "Angle of joint {n}"
                |d, i| d.outputs.position[i], from(&[ANGLES]);
            "joint[{n}].rate" [RADIAN_PER_SECOND] "Rate of joint {n}"
                |d, i| d.outputs.rate[i],
                derivative_of(format!("joint[{n}].position")), derivative(|d, i| d.rates.coordinates[i]);
            "joint[{n}].torque" [NEWTON_METRE]
                "Torque of the motor of joint {n} on the outer link, mean over the step, jumps of the rates included"
                |d, i| d.outputs.effort[i], derivative(HELD), from(&[&["gravity"], LINKS]), on_demand();
        }
    }
    match structure.balance {
        Balance::None => {}
        Balance::Counterweight => declare! { table.output().at(structure.links), Data;
            "counterweight.position" [METRE] "Position of the counterweight along the UAV's x axis"
                |d, i| d.outputs.position[i], from(&[BALANCE]);
            "counterweight.rate" [METRE_PER_SECOND] "Rate of the counterweight"
                |d, i| d.outputs.rate[i],
                derivative_of("counterweight.position"), derivative(|d, i| d.rates.coordinates[i]);
            "counterweight.force" [NEWTON]
                "Force of the motor of the counterweight on it, mean over the step, jumps of the rates included"
                |d, i| d.outputs.effort[i], derivative(HELD), from(BALANCE_EFFORT), on_demand();
        },
        Balance::Element => declare! { table.output().at(structure.links), Data;
            "balance_element.position" [RADIAN] "Angle of the balance element in the UAV frame"
                |d, i| d.outputs.position[i], from(&[BALANCE]);
            "balance_element.rate" [RADIAN_PER_SECOND] "Rate of the balance element"
                |d, i| d.outputs.rate[i],
                derivative_of("balance_element.position"), derivative(|d, i| d.rates.coordinates[i]);
            "balance_element.torque" [NEWTON_METRE]
                "Torque of the motor of the balance element on it, mean over the step, jumps of the rates included"
                |d, i| d.outputs.effort[i], derivative(HELD), from(BALANCE_EFFORT), on_demand();
        },
    }
    declare! { table.output(), Data;
        "end_effector.x" [METRE] "Position of the end effector, to the right"
            |d, _| d.outputs.end_effector.x, from(&[GEOMETRY]), on_demand();
        "end_effector.y" [METRE] "Position of the end effector, upwards"
            |d, _| d.outputs.end_effector.y, from(&[GEOMETRY]), on_demand();
        "end_effector.vx" [METRE_PER_SECOND] "Velocity of the end effector, to the right"
            |d, _| d.outputs.end_effector_velocity.x,
            derivative_of("end_effector.x"), derivative(|d, _| d.rates.end_effector_velocity.x), on_demand();
        "end_effector.vy" [METRE_PER_SECOND] "Velocity of the end effector, upwards"
            |d, _| d.outputs.end_effector_velocity.y,
            derivative_of("end_effector.y"), derivative(|d, _| d.rates.end_effector_velocity.y), on_demand();
        "autopilot.thrust" [NEWTON] "Thrust along the UAV's own vertical axis; mean over the step if ideal"
            |d, _| d.outputs.thrust, derivative(|d, _| d.rates.thrust), from(HOVER), on_demand();
        "autopilot.torque" [NEWTON_METRE] "Torque of the rotors on the UAV; mean over the step if ideal"
            |d, _| d.outputs.torque, derivative(|d, _| d.rates.torque), from(HOVER), on_demand();
        "transmitted.force_y" [NEWTON] "Force upwards of all that the UAV carries on the UAV, mean over the step"
            |d, _| d.outputs.transmitted_force.y, derivative(HELD), from(CARRIED), on_demand();
        "transmitted.moment" [NEWTON_METRE]
            "Moment about the UAV's centre of mass of all that the UAV carries on the UAV, mean over the step"
            |d, _| d.outputs.transmitted_moment, derivative(HELD), from(CARRIED), on_demand();
        "transmitted.force_x" [NEWTON] "Force to the right of all that the UAV carries on the UAV, mean over the step"
            |d, _| d.outputs.transmitted_force.x, derivative(HELD), on_demand();
        "momentum.x" [NEWTON_SECOND] "Momentum of the whole system, to the right"
            |d, _| d.outputs.momentum.x, derivative(|d, _| d.rates.momentum.x);
        "momentum.y" [NEWTON_SECOND] "Momentum of the whole system, upwards"
            |d, _| d.outputs.momentum.y, derivative(|d, _| d.rates.momentum.y);
        "momentum.angular" [NEWTON_METRE_SECOND]
            "Angular momentum of the whole system about the UAV's centre of mass, of absolute velocities"
            |d, _| d.outputs.momentum.z, derivative(|d, _| d.rates.momentum.z);
        "center_of_mass.x" [METRE] "Centre of mass of the whole system, to the right"
            |d, _| d.outputs.center_of_mass.x, derivative(|d, _| d.rates.center_of_mass.x), from(MASSES), on_demand();
        "center_of_mass.y" [METRE] "Centre of mass of the whole system, upwards"
            |d, _| d.outputs.center_of_mass.y, derivative(|d, _| d.rates.center_of_mass.y), from(MASSES), on_demand();
    }
    declare! { table.discrete_output(), Data;
        "payload.attached" [bool] "Whether the payload is held"
            |d, _| d.outputs.attached;
    }
    declare! { table.output(), Data;
        "payload.force_x" [NEWTON] "Force to the right of the held payload on the arm, mean over the step"
            |d, _| d.outputs.payload_force.x, derivative(HELD), on_demand();
        "payload.force_y" [NEWTON] "Force upwards of the held payload on the arm, mean over the step"
            |d, _| d.outputs.payload_force.y, derivative(HELD), on_demand();
        "support.force" [NEWTON] "Force of the support on the held payload, upwards"
            |d, _| d.outputs.support_force, derivative(|d, _| d.rates.support_force), on_demand();
        "timestamp" [SECOND] "Time of the outputs"
            |d, _| d.time, derivative(|_, _| 1.0);
    }
}
