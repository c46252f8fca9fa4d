//! The counterweight's own law: it balances what hangs below the UAV (thesis 3.8, steps 1 and 2).
//!
//! It does not go there within one interval even if it could. The arm answers to its motion at once, and that
//! moves the place where it should be by as much or more: it would chatter. With a time constant of many
//! intervals the loop is calm.

use crate::mechanics::dynamics::Situation;
use crate::mechanics::vehicle::{Balancer, Vehicle};

/// Where the counterweight brings the common centre of mass with arm and payload below the UAV's, in the UAV
/// frame \[m\]; none without a counterweight that weighs something.
pub(super) fn balance<const N: usize>(vehicle: &Vehicle<N>, now: &Situation<N>) -> Option<f64> {
    let Some(Balancer::Counterweight(slider)) = vehicle.balancer else { return None };
    let carried = now.node.matrix.first.x - slider.mass * now.node.posture.counterweight.x;
    (slider.mass > 0.0).then(|| -carried / slider.mass)
}
