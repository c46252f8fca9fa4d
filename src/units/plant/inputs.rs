//! The inputs of the plant.

use super::Data;
use crate::parameters::{Balance, Structure};
use crate::variables::Table;
use crate::variables::declare::declare;

/// Takes the derivative of a rate for the coming step.
const RATE: fn(&mut Data, usize, f64) = |d, i, slope| *d.inputs.given_rate_slope(i) = Some(slope);
/// Accepts a derivative, because hosts give those of all inputs, without effect.
const IGNORED: fn(&mut Data, usize, f64) = |_, _, _| ();

/// Declares the inputs; every continuous one takes a first derivative.
pub(super) fn declare(table: &mut Table<Data>, structure: Structure) {
    for i in 0..structure.links {
        let n = i + 1;
        declare! { table.input().at(i), Data;
            "joint[{n}].rate_command" [RADIAN_PER_SECOND]
                "Rate of joint {n} from the beginning of the communication step, if its motor follows a rate"
                |d, i| d.inputs.rate_command[i], given_derivative(RATE);
            "joint[{n}].acceleration_command" [RADIAN_PER_SECOND2]
                "Slope of the rate of joint {n} within the communication step; 0: zero-order hold"
                |d, i| d.inputs.acceleration_command[i], given_derivative(IGNORED);
            "joint[{n}].torque_command" [NEWTON_METRE] "Torque of the motor of joint {n}, if that follows a torque"
                |d, i| d.inputs.joint_torque_command[i],
                given_derivative(|d, i, slope| *d.inputs.given_torque_slope(i) = slope);
        }
    }
    match structure.balance {
        Balance::None => {}
        Balance::Counterweight => declare! { table.input().at(structure.links), Data;
            "counterweight.rate_command" [METRE_PER_SECOND]
                "Rate of the counterweight from the beginning of the communication step"
                |d, i| d.inputs.rate_command[i], given_derivative(RATE);
            "counterweight.acceleration_command" [METRE_PER_SECOND2]
                "Slope of the rate of the counterweight within the communication step; 0: zero-order hold"
                |d, i| d.inputs.acceleration_command[i], given_derivative(IGNORED);
        },
        Balance::Element => declare! { table.input().at(structure.links), Data;
            "balance_element.rate_command" [RADIAN_PER_SECOND]
                "Rate of the balance element from the beginning of the communication step"
                |d, i| d.inputs.rate_command[i], given_derivative(RATE);
            "balance_element.acceleration_command" [RADIAN_PER_SECOND2]
                "Slope of the rate of the balance element within the communication step; 0: zero-order hold"
                |d, i| d.inputs.acceleration_command[i], given_derivative(IGNORED);
        },
    }
    declare! { table.discrete_input(), Data;
        "grasp" [bool]
            "Rising edge, or true in the first step: the payload is taken over at rest; falling edge: it is let go"
            |d, _| d.inputs.grasp;
    }
    declare! { table.input(), Data;
        "autopilot.altitude_reference" [METRE] "Wanted altitude of the UAV"
            |d, _| d.inputs.load.altitude, given_derivative(|d, _, slope| d.inputs.given_load_slope().altitude = slope);
        "autopilot.roll_reference" [RADIAN] "Wanted roll of the UAV"
            |d, _| d.inputs.load.roll, given_derivative(|d, _, slope| d.inputs.given_load_slope().roll = slope);
        "autopilot.thrust_feedforward" [NEWTON] "Added to the thrust of the pid autopilot"
            |d, _| d.inputs.load.thrust_feedforward,
            given_derivative(|d, _, slope| d.inputs.given_load_slope().thrust_feedforward = slope);
        "autopilot.thrust_command" [NEWTON] "Thrust, if the autopilot is external"
            |d, _| d.inputs.load.thrust, given_derivative(|d, _, slope| d.inputs.given_load_slope().thrust = slope);
        "autopilot.torque_command" [NEWTON_METRE] "Torque on the UAV, if the autopilot is external"
            |d, _| d.inputs.load.torque, given_derivative(|d, _, slope| d.inputs.given_load_slope().torque = slope);
        "base.external_force_x" [NEWTON] "External force on the UAV at its centre of mass, to the right"
            |d, _| d.inputs.load.base_force.x,
            given_derivative(|d, _, slope| d.inputs.given_load_slope().base_force.x = slope);
        "base.external_force_y" [NEWTON] "External force on the UAV at its centre of mass, upwards"
            |d, _| d.inputs.load.base_force.y,
            given_derivative(|d, _, slope| d.inputs.given_load_slope().base_force.y = slope);
        "base.external_torque" [NEWTON_METRE] "External torque on the UAV"
            |d, _| d.inputs.load.base_torque,
            given_derivative(|d, _, slope| d.inputs.given_load_slope().base_torque = slope);
        "end_effector.external_force_x" [NEWTON] "External force on the end effector, to the right"
            |d, _| d.inputs.load.tip_force.x,
            given_derivative(|d, _, slope| d.inputs.given_load_slope().tip_force.x = slope);
        "end_effector.external_force_y" [NEWTON] "External force on the end effector, upwards"
            |d, _| d.inputs.load.tip_force.y,
            given_derivative(|d, _, slope| d.inputs.given_load_slope().tip_force.y = slope);
        "end_effector.external_torque" [NEWTON_METRE] "External torque on the last link"
            |d, _| d.inputs.load.tip_torque,
            given_derivative(|d, _, slope| d.inputs.given_load_slope().tip_torque = slope);
    }
}
