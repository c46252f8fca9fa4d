//! One internal step: the classical Runge-Kutta method of order 4.
//!
//! Rates are imposed, so the arm itself is evaluated at two new instants only, and the four stages are
//! cheap. Methods of order 6 need twice as many instants; at the steps of a millisecond that a
//! communication with a controller asks for, order 4 already leaves nothing but rounding.

use super::Dynamics;
use super::law::{Flow, Node, Scene, turned};

/// Result of an internal step.
pub(super) struct Internal<const N: usize> {
    /// At the end.
    pub flow: Flow,
    /// The arm in the middle.
    pub middle: Node<N>,
    /// The arm at the end.
    pub node: Node<N>,
    /// Rates of the flow at the beginning and, as seen by the last stage, at the end.
    pub slopes: [Flow; 2],
}

impl<const N: usize> Dynamics<N> {
    /// One step of length `size` from `flow` with the rates `k_1`, where the arm is at `node`, under the motion of
    /// `scene`.
    pub(super) fn internal_step(
        &self,
        flow: &Flow,
        k_1: Flow,
        node: &Node<N>,
        size: f64,
        scene: &Scene<'_, N>,
    ) -> Internal<N> {
        let half = 0.5 * size;
        let middle = self.node_after(node, half, scene);
        let end = self.node_after(node, size, scene);

        let mut room = None;
        let [_, load_2, load_4] = scene.loads.at([scene.elapsed, size], &mut room);

        let k_2 = self.law(&(flow + k_1 * half), &middle, load_2, scene);
        let k_3 = self.law(&(flow + k_2 * half), &middle, load_2, scene);
        let k_4 = self.law(&(flow + k_3 * size), &end, load_4, scene);
        let mut after = flow + (k_1 + (k_2 + k_3) * 2.0 + k_4) * (size / 6.0);
        turned(&mut after, flow);
        Internal { flow: after, middle, node: end, slopes: [k_1, k_4] }
    }

    /// The arm after the time `t` from `node` on.
    fn node_after(&self, node: &Node<N>, t: f64, scene: &Scene<'_, N>) -> Node<N> {
        let configuration = node.configuration.displaced(&self.vehicle, &scene.motion.way(t));
        Node::new(&self.vehicle, configuration, scene.held, scene.motion.rate_after(t))
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
            let (mut flow, mut node) = (start.flow(BaseModel::Full), start.node);
            node.move_at(motion.rate);
            let scene = Scene {
                loads: &loads,
                elapsed: 0.0,
                held: false,
                contact: false,
                sampled: crate::planar::Vec2::zeros(),
                motion,
            };
            for _ in 0..steps {
                let k_1 = dynamics.law(&flow, &node, &loads.begin, &scene);
                let step = dynamics.internal_step(&flow, k_1, &node, size, &scene);
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
