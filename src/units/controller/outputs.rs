//! The outputs of the controller.

use super::Data;
use crate::parameters::{Balance, Structure};
use crate::units::decisive::{ANGLES, BALANCE, GEOMETRY, PLAN};
use crate::variables::Table;
use crate::variables::declare::declare;

/// Of what the controller holds until its next plan.
const HELD: fn(&Data, usize) -> f64 = |_, _| 0.0;

/// Declares the outputs. Every continuous one has a first derivative: of reference and rates the present one, of predictions
/// the left limit.
pub(super) fn declare(table: &mut Table<Data>, structure: Structure) {
    for i in 0..structure.links {
        let n = i + 1;
        declare! { table.output().at(i), Data;
            "joint[{n}].rate_command" [RADIAN_PER_SECOND] "Rate for joint {n} now, after any jump"
                |d, i| d.outputs.rate_command[i], from(&[PLAN]);
        }
    }
    match structure.balance {
        Balance::None => {}
        Balance::Counterweight => declare! { table.output().at(structure.links), Data;
            "counterweight.rate_command" [METRE_PER_SECOND]
                "Rate for the counterweight now, after any jump; 0, except with least_squares"
                |d, i| d.outputs.rate_command[i], from(&[PLAN]);
        },
        Balance::Element => declare! { table.output().at(structure.links), Data;
            "balance_element.rate_command" [RADIAN_PER_SECOND]
                "Rate for the balance element now, after any jump; 0, except with acceleration_level"
                |d, i| d.outputs.rate_command[i], from(&[PLAN]);
        },
    }
    for i in 0..structure.links {
        let n = i + 1;
        declare! { table.output().at(i), Data;
            "joint[{n}].acceleration_command" [RADIAN_PER_SECOND2]
                "Acceleration for joint {n} until the next communication point; 0 with a hold of zero order"
                |d, i| d.outputs.acceleration_command[i],
                derivative_of(format!("joint[{n}].rate_command")), derivative(HELD), from(&[PLAN]);
        }
    }
    match structure.balance {
        Balance::None => {}
        Balance::Counterweight => declare! { table.output().at(structure.links), Data;
            "counterweight.acceleration_command" [METRE_PER_SECOND2]
                "Acceleration for the counterweight until the next communication point; 0 with a hold of zero order"
                |d, i| d.outputs.acceleration_command[i],
                derivative_of("counterweight.rate_command"), derivative(HELD), from(&[PLAN]);
        },
        Balance::Element => declare! { table.output().at(structure.links), Data;
            "balance_element.acceleration_command" [RADIAN_PER_SECOND2]
                "Acceleration for the balance element until the next communication point; 0 with a hold of zero \
                 order"
                |d, i| d.outputs.acceleration_command[i],
                derivative_of("balance_element.rate_command"), derivative(HELD), from(&[PLAN]);
        },
    }
    declare! { table.discrete_output(), Data;
        "grasp" [bool] "Whether the payload is to be held"
            |d, _| d.outputs.grasp, from(&[&["payload.grasp_time"]]);
    }
    declare! { table.output(), Data;
        "reference.x" [METRE] "Wanted position of the end effector now, to the right"
            |d, _| d.outputs.reference.x, from(&[GEOMETRY]);
        "reference.y" [METRE] "Wanted position of the end effector now, upwards"
            |d, _| d.outputs.reference.y, from(&[GEOMETRY]);
        "reference.vx" [METRE_PER_SECOND] "Wanted velocity of the end effector now, to the right"
            |d, _| d.outputs.reference_velocity.x,
            derivative_of("reference.x"), derivative(|d, _| d.rates.reference_velocity.x);
        "reference.vy" [METRE_PER_SECOND] "Wanted velocity of the end effector now, upwards"
            |d, _| d.outputs.reference_velocity.y,
            derivative_of("reference.y"), derivative(|d, _| d.rates.reference_velocity.y);
        "predicted.base.x" [METRE] "Predicted position of the UAV, to the right"
            |d, _| d.outputs.predicted_pose.x;
        "predicted.base.y" [METRE] "Predicted position of the UAV, upwards"
            |d, _| d.outputs.predicted_pose.y;
        "predicted.base.roll" [RADIAN] "Predicted roll of the UAV"
            |d, _| d.outputs.predicted_pose.z;
        "predicted.base.vx" [METRE_PER_SECOND] "Predicted velocity of the UAV, to the right"
            |d, _| d.outputs.predicted_velocity.x,
            derivative_of("predicted.base.x"), derivative(|d, _| d.rates.predicted_velocity.x);
        "predicted.base.vy" [METRE_PER_SECOND] "Predicted velocity of the UAV, upwards"
            |d, _| d.outputs.predicted_velocity.y,
            derivative_of("predicted.base.y"), derivative(|d, _| d.rates.predicted_velocity.y);
        "predicted.base.roll_rate" [RADIAN_PER_SECOND] "Predicted angular velocity of the UAV"
            |d, _| d.outputs.predicted_velocity.z,
            derivative_of("predicted.base.roll"), derivative(|d, _| d.rates.predicted_velocity.z);
        "predicted.end_effector.x" [METRE] "Predicted position of the end effector, to the right"
            |d, _| d.outputs.predicted_end_effector.x,
            derivative(|d, _| d.rates.predicted_end_effector.x), from(&[GEOMETRY]);
        "predicted.end_effector.y" [METRE] "Predicted position of the end effector, upwards"
            |d, _| d.outputs.predicted_end_effector.y,
            derivative(|d, _| d.rates.predicted_end_effector.y), from(&[GEOMETRY]);
    }
    for i in 0..structure.links {
        let n = i + 1;
        declare! { table.output().at(i), Data;
            "predicted.joint[{n}].position" [RADIAN] "Predicted angle of joint {n}"
                |d, i| d.outputs.predicted_position[i],
                derivative(|d, i| d.rates.predicted_position[i]), from(&[ANGLES]);
        }
    }
    match structure.balance {
        Balance::None => {}
        Balance::Counterweight => declare! { table.output().at(structure.links), Data;
            "predicted.counterweight.position" [METRE] "Position of the counterweight along the UAV's x axis, predicted"
                |d, i| d.outputs.predicted_position[i],
                derivative(|d, i| d.rates.predicted_position[i]), from(&[BALANCE]);
        },
        Balance::Element => declare! { table.output().at(structure.links), Data;
            "predicted.balance_element.position" [RADIAN] "Angle of the balance element in the UAV frame, predicted"
                |d, i| d.outputs.predicted_position[i],
                derivative(|d, i| d.rates.predicted_position[i]), from(&[BALANCE]);
        },
    }
    declare! { table.discrete_output(), Data;
        "ik.status" [choice] "How the present rates came about"
            |d, _| d.outputs.status, from(&[PLAN]);
    }
    declare! { table.output(), Data;
        "ik.min_singular_value" [METRE]
            "Smallest singular value of the generalized Jacobian of the end effector's position"
            |d, _| d.outputs.min_singular_value, derivative(HELD), from(&[PLAN]);
        "ik.velocity_residual" [METRE_PER_SECOND]
            "How far the present rates miss the wanted mean velocity of the end effector"
            |d, _| d.outputs.velocity_residual, derivative(HELD), from(&[PLAN]);
        "ik.moment_residual" [NEWTON_METRE]
            "Predicted mean moment of all that the UAV carries on the UAV under the present rates"
            |d, _| d.outputs.moment_residual, derivative(HELD), from(&[PLAN]);
        "ik.late_miss" [METRE]
            "How far the finished plan has ended from where it said it would, relative to the reference, because the \
             host's steps, or an external reference, were not those that it was made for"
            |d, _| d.outputs.late_miss, derivative(HELD);
    }
}
