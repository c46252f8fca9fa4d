//! What changes the momentum of what the coordinates move, besides their motors.

use nalgebra::SVector;

use super::law::{Carrier, Node};
use super::{Dynamics, Load};
use crate::mechanics::momentum::outboard_drift;
use crate::mechanics::planar::{cross, vec2};
use crate::mechanics::vehicle::Balancer;

impl<const N: usize> Dynamics<N> {
    /// For each coordinate, what changes the momentum of what it moves, its motor excepted: moments about the joint,
    /// or forces along the slide, of weight, outer loads and its own motion \[N m, N\].
    #[inline]
    pub(super) fn outboard_load(&self, node: &Node<N>, carrier: &Carrier, held: bool, load: &Load) -> SVector<f64, N> {
        let (vehicle, posture, rotation) = (&self.vehicle, &node.posture, carrier.rotation);
        let mut sum = outboard_drift(vehicle, posture, held, carrier.motion, &node.rate);

        let drift = sum[N - 1];
        let gravity = rotation.undo(vec2(0.0, -vehicle.gravity));
        for (i, sum) in sum.iter_mut().enumerate() {
            *sum += cross(node.matrix.outboard_first(i), gravity);
        }
        if load.pushes_arm() || carrier.support != 0.0 {
            let tip = rotation.undo(load.tip_force);
            let lift = rotation.undo(vec2(0.0, carrier.support));
            let pushed = load.tip_torque + cross(posture.end_effector, tip) + cross(posture.payload, lift);
            for (sum, joint) in sum.iter_mut().zip(&posture.joint) {
                *sum += pushed - cross(*joint, tip + lift);
            }
        }
        // What stands in for a link in the place of a balancer was pushed along.
        match vehicle.balancer {
            None => {}
            Some(Balancer::Counterweight(slider)) => sum[N - 1] = drift + slider.mass * gravity.x,
            Some(Balancer::Element(_)) => sum[N - 1] = drift + cross(node.matrix.outboard_first(N - 1), gravity),
        }
        sum
    }
}
