//! How the plant's continuous variables change with time.

use super::Data;
use crate::variables::Derivative::{self, At, Constant, Given};

/// By names without indices.
///
/// Every continuous input takes a first derivative. Every continuous output has one: its left limit, or 0
/// where the output is a mean over the step, and for the accelerations, whose rates nobody computes: a host
/// that extrapolates with these holds them.
pub const ALL: &[(&str, Derivative<Data>)] = &[
    // Inputs.
    ("joint.rate_command", Given(|d, i, slope| *d.inputs.given_rate_slope(i) = Some(slope))),
    ("counterweight.rate_command", Given(|d, i, slope| *d.inputs.given_rate_slope(i) = Some(slope))),
    ("balance_element.rate_command", Given(|d, i, slope| *d.inputs.given_rate_slope(i) = Some(slope))),
    ("joint.torque_command", Given(|d, i, slope| *d.inputs.given_torque_slope(i) = slope)),
    ("joint.acceleration_command", IGNORED),
    ("counterweight.acceleration_command", IGNORED),
    ("balance_element.acceleration_command", IGNORED),
    ("autopilot.altitude_reference", Given(|d, _, slope| d.inputs.given_load_slope().altitude = slope)),
    ("autopilot.roll_reference", Given(|d, _, slope| d.inputs.given_load_slope().roll = slope)),
    ("autopilot.thrust_feedforward", Given(|d, _, slope| d.inputs.given_load_slope().thrust_feedforward = slope)),
    ("autopilot.thrust_command", Given(|d, _, slope| d.inputs.given_load_slope().thrust = slope)),
    ("autopilot.torque_command", Given(|d, _, slope| d.inputs.given_load_slope().torque = slope)),
    ("base.external_force_x", Given(|d, _, slope| d.inputs.given_load_slope().base_force.x = slope)),
    ("base.external_force_y", Given(|d, _, slope| d.inputs.given_load_slope().base_force.y = slope)),
    ("base.external_torque", Given(|d, _, slope| d.inputs.given_load_slope().base_torque = slope)),
    ("end_effector.external_force_x", Given(|d, _, slope| d.inputs.given_load_slope().tip_force.x = slope)),
    ("end_effector.external_force_y", Given(|d, _, slope| d.inputs.given_load_slope().tip_force.y = slope)),
    ("end_effector.external_torque", Given(|d, _, slope| d.inputs.given_load_slope().tip_torque = slope)),
    // Outputs.
    ("base.x", At(|d, _| &mut d.outputs.velocity.x)),
    ("base.y", At(|d, _| &mut d.outputs.velocity.y)),
    ("base.roll", At(|d, _| &mut d.outputs.velocity.z)),
    ("base.vx", At(|d, _| &mut d.outputs.acceleration.x)),
    ("base.vy", At(|d, _| &mut d.outputs.acceleration.y)),
    ("base.roll_rate", At(|d, _| &mut d.outputs.acceleration.z)),
    ("base.ax", HELD),
    ("base.ay", HELD),
    ("base.roll_acceleration", HELD),
    ("joint.position", At(|d, i| &mut d.outputs.rate[i])),
    ("joint.rate", At(|d, i| &mut d.rates.coordinates[i])),
    ("joint.torque", HELD),
    ("counterweight.position", At(|d, i| &mut d.outputs.rate[i])),
    ("counterweight.rate", At(|d, i| &mut d.rates.coordinates[i])),
    ("counterweight.force", HELD),
    ("balance_element.position", At(|d, i| &mut d.outputs.rate[i])),
    ("balance_element.rate", At(|d, i| &mut d.rates.coordinates[i])),
    ("balance_element.torque", HELD),
    ("end_effector.x", At(|d, _| &mut d.outputs.end_effector_velocity.x)),
    ("end_effector.y", At(|d, _| &mut d.outputs.end_effector_velocity.y)),
    ("end_effector.vx", At(|d, _| &mut d.rates.end_effector_velocity.x)),
    ("end_effector.vy", At(|d, _| &mut d.rates.end_effector_velocity.y)),
    ("autopilot.thrust", At(|d, _| &mut d.rates.thrust)),
    ("autopilot.torque", At(|d, _| &mut d.rates.torque)),
    ("transmitted.force_x", HELD),
    ("transmitted.force_y", HELD),
    ("transmitted.moment", HELD),
    ("momentum.x", At(|d, _| &mut d.rates.momentum.x)),
    ("momentum.y", At(|d, _| &mut d.rates.momentum.y)),
    ("momentum.angular", At(|d, _| &mut d.rates.momentum.z)),
    ("center_of_mass.x", At(|d, _| &mut d.rates.center_of_mass.x)),
    ("center_of_mass.y", At(|d, _| &mut d.rates.center_of_mass.y)),
    ("payload.force_x", HELD),
    ("payload.force_y", HELD),
    ("support.force", At(|d, _| &mut d.rates.support_force)),
    ("timestamp", Constant(1.0)),
];

/// Changes at communication points only, or is extrapolated as if.
const HELD: Derivative<Data> = Constant(0.0);

/// Accepted, because hosts give the derivatives of all inputs, and without effect.
const IGNORED: Derivative<Data> = Given(|_, _, _| ());
