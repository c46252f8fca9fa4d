//! How the controller's continuous outputs change with time.

use super::Data;
use crate::variables::Derivative::{self, At, Constant};

/// By names without indices.
///
/// Every continuous output has a first derivative: of reference and rates the present one, of predictions
/// the left limit, and 0 of what the controller holds until its next plan. Inputs take none: the controller reads
/// them at communication points.
pub const ALL: &[(&str, Derivative<Data>)] = &[
    ("joint.rate_command", At(|d, i| &mut d.outputs.acceleration_command[i])),
    ("counterweight.rate_command", At(|d, i| &mut d.outputs.acceleration_command[i])),
    ("balance_element.rate_command", At(|d, i| &mut d.outputs.acceleration_command[i])),
    ("joint.acceleration_command", HELD),
    ("counterweight.acceleration_command", HELD),
    ("balance_element.acceleration_command", HELD),
    ("reference.x", At(|d, _| &mut d.outputs.reference_velocity.x)),
    ("reference.y", At(|d, _| &mut d.outputs.reference_velocity.y)),
    ("reference.vx", At(|d, _| &mut d.rates.reference_velocity.x)),
    ("reference.vy", At(|d, _| &mut d.rates.reference_velocity.y)),
    ("predicted.base.x", At(|d, _| &mut d.outputs.predicted_velocity.x)),
    ("predicted.base.y", At(|d, _| &mut d.outputs.predicted_velocity.y)),
    ("predicted.base.roll", At(|d, _| &mut d.outputs.predicted_velocity.z)),
    ("predicted.base.vx", At(|d, _| &mut d.rates.predicted_velocity.x)),
    ("predicted.base.vy", At(|d, _| &mut d.rates.predicted_velocity.y)),
    ("predicted.base.roll_rate", At(|d, _| &mut d.rates.predicted_velocity.z)),
    ("predicted.end_effector.x", At(|d, _| &mut d.rates.predicted_end_effector.x)),
    ("predicted.end_effector.y", At(|d, _| &mut d.rates.predicted_end_effector.y)),
    ("predicted.joint.position", At(|d, i| &mut d.rates.predicted_position[i])),
    ("predicted.counterweight.position", At(|d, i| &mut d.rates.predicted_position[i])),
    ("predicted.balance_element.position", At(|d, i| &mut d.rates.predicted_position[i])),
    ("ik.min_singular_value", HELD),
    ("ik.velocity_residual", HELD),
    ("ik.moment_residual", HELD),
    ("ik.late_miss", HELD),
];

/// Changes at communication points only, or is extrapolated as if.
const HELD: Derivative<Data> = Constant(0.0);
