//! One internal step: the classical Runge-Kutta method of order 4.
//!
//! Rates are imposed, so the arm itself is evaluated at two new instants only, and the four stages are
//! cheap. Methods of order 6 need twice as many instants; at the steps of a millisecond that a
//! communication with a controller asks for, order 4 already leaves nothing but rounding.

use super::law::{Flow, Node, Scene};
use super::{Dynamics, Impulse};
use crate::kinematics::Configuration;

/// Result of an internal step.
pub(super) struct Internal<const N: usize> {
    /// At the end.
    pub flow: Flow,
    /// The arm at the end.
    pub node: Node<N>,
    /// Over the step.
    pub impulse: Impulse<N>,
}

impl<const N: usize> Dynamics<N> {
    /// One step of length `size` from `flow`, where the arm is at `node`, under the motion of `scene`.
    pub(super) fn stepped<const TORQUES: bool>(
        &self,
        flow: &Flow,
        node: &Node<N>,
        size: f64,
        scene: &Scene<'_, N>,
    ) -> Internal<N> {
        let end = scene.configuration_after(&self.vehicle, node, size);
        self.internal_step::<TORQUES>(flow, node, end, size, scene)
    }

    /// One step of length `size` from `flow`, where the arm is at `node`, to where it is at `end`.
    pub(super) fn internal_step<const TORQUES: bool>(
        &self,
        flow: &Flow,
        node: &Node<N>,
        end: Configuration<N>,
        size: f64,
        scene: &Scene<'_, N>,
    ) -> Internal<N> {
        let (vehicle, half) = (&self.vehicle, 0.5 * size);
        let middle = scene.configuration_after(vehicle, node, half);
        let middle = Node::new(vehicle, middle, scene.held, scene.motion.rate_after(half));
        let end = Node::new(vehicle, end, scene.held, scene.motion.rate_after(size));

        let mut room = None;
        let [load_1, load_2, load_4] = scene.loads.at([scene.elapsed, size], &mut room);

        let (k_1, impulse_1) = self.law::<TORQUES>(flow, node, load_1, scene);
        let (k_2, impulse_2) = self.law::<TORQUES>(&(flow + k_1 * half), &middle, load_2, scene);
        let (k_3, impulse_3) = self.law::<TORQUES>(&(flow + k_2 * half), &middle, load_2, scene);
        let (k_4, impulse_4) = self.law::<TORQUES>(&(flow + k_3 * size), &end, load_4, scene);
        Internal {
            flow: flow + (k_1 + (k_2 + k_3) * 2.0 + k_4) * (size / 6.0),
            node: end,
            impulse: (impulse_1 + (impulse_2 + impulse_3) * 2.0 + impulse_4) * (size / 6.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::defaults::default_parameters;
    use crate::dynamics::{Loads, Motion};
    use crate::parameters::{BaseModel, Structure};

    /// The error after a fixed time falls by 2^4 when the steps are halved, on the real equations.
    #[test]
    fn halving_the_step_divides_the_error_by_sixteen() {
        let mut parameters = default_parameters(Structure::DEFAULT);
        parameters.mount.x = 0.05;
        let dynamics = Dynamics::<3>::new(Structure::DEFAULT, &parameters, BaseModel::Full).unwrap();
        let start = dynamics.start(&parameters);
        let motion = Motion::constant([1.5, -2.0, 2.5].into());
        let loads = Loads::default();
        let end_in = |steps: u32| {
            let size = 0.4 / f64::from(steps);
            let (mut flow, mut node) = (start.state.flow(), start.node);
            node.move_at(motion.rate);
            for _ in 0..steps {
                let scene = Scene {
                    loads: &loads,
                    elapsed: 0.0,
                    held: false,
                    contact: false,
                    sampled: crate::planar::Vec2::zeros(),
                    near: (flow[2], crate::planar::Turn::by(flow[2])),
                    motion,
                };
                let end = scene.configuration_after(&dynamics.vehicle, &node, size);
                let step = dynamics.internal_step::<false>(&flow, &node, end, size, &scene);
                (flow, node) = (step.flow, step.node);
            }
            flow
        };
        let exact = end_in(1280);
        let error = |steps| (end_in(steps) - exact).amax();
        let ratio = error(20) / error(40);
        assert!((14.0..18.0).contains(&ratio), "{ratio}");
    }
}
