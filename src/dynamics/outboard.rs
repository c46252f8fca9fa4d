//! What changes the momentum of what the coordinates move, besides their motors.

use nalgebra::SVector;

use super::law::{Flow, Node, Scene};
use super::{Dynamics, Load};
use crate::momentum::outboard;
use crate::planar::{cross, vec2};
use crate::vehicle::Balancer;

impl<const N: usize> Dynamics<N> {
    /// For each coordinate, what changes the momentum of what it moves, its motor excepted: moments about the joint,
    /// or forces along the slide, of weight, outer loads and its own motion \[N m, N\].
    pub(super) fn outboard_load(&self, y: &Flow, node: &Node<N>, load: &Load, scene: &Scene<'_, N>) -> SVector<f64, N> {
        let (vehicle, posture, turn) = (&self.vehicle, &node.posture, self.arm_turn(y));
        let v = self.base_velocity(y, turn, node);
        let outboard = outboard(vehicle, posture, scene.held, v, &node.rate);

        let gravity = turn.undo(vec2(0.0, -vehicle.gravity));
        let tip = turn.undo(load.tip_force);
        let lift = turn.undo(vec2(0.0, self.support_force(y, turn, node, scene)));
        let pushed = load.tip_torque + cross(posture.end_effector, tip) + cross(posture.payload, lift);
        let mut load = SVector::from_fn(|i, _| {
            let weighed = cross(node.matrix.outboard_first[i], gravity);
            weighed + pushed - cross(posture.joint[i], tip + lift) + outboard[i].drift
        });
        if let Some(balancer) = vehicle.balancer {
            let weighed = match balancer {
                Balancer::Counterweight(slider) => slider.mass * gravity.x,
                Balancer::Element(_) => cross(node.matrix.outboard_first[N - 1], gravity),
            };
            load[N - 1] = weighed + outboard[N - 1].drift;
        }
        load
    }
}
