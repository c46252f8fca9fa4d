//! One internal step: the classical Runge-Kutta method of order 4.
//!
//! Rates are imposed, so the arm itself is evaluated at two new instants only, and the four stages are
//! cheap. Methods of order 6 need twice as many instants; at the steps of a millisecond that a
//! communication with a controller asks for, order 4 already leaves nothing but rounding.

use super::Dynamics;
use super::law::{Carrier, Flow, Node, Scene, turned};

/// Result of an internal step.
pub(super) struct Internal<const N: usize> {
    /// At the end.
    pub flow: Flow,
    /// The arm in the middle.
    pub middle: Node<N>,
    /// The arm at the end.
    pub end: Node<N>,
    /// Rates of the flow at the beginning and, as seen by the last stage, at the end.
    pub slopes: [Flow; 2],
    /// The UAV at the beginning, in the middle and at the end, as the stages see it.
    pub carrier: [Carrier; 3],
}

impl<const N: usize> Internal<N> {
    /// No time has passed; `node`: the arm.
    pub fn none(flow: Flow, node: &Node<N>) -> Self {
        let (slopes, carrier) = ([Flow::zeros(); 2], [Carrier::REST; 3]);
        Self { flow, middle: *node, end: *node, slopes, carrier }
    }
}

impl<const N: usize> Dynamics<N> {
    /// One step of length `size` from `flow` with the rates `k_1`, where the arm is at `node`, under the motion of
    /// `scene`; written to `step`.
    pub(super) fn internal_step(
        &self,
        step: &mut Internal<N>,
        flow: &Flow,
        k_1: &Flow,
        node: &Node<N>,
        size: f64,
        scene: &Scene<'_, N>,
    ) {
        let half = 0.5 * size;
        step.middle.follow(&self.vehicle, node, &scene.motion.way(half), scene.held, scene.motion.rate_after(half));
        step.end.follow(&self.vehicle, node, &scene.motion.way(size), scene.held, scene.motion.rate_after(size));
        let (middle, end) = (&step.middle, &step.end);

        let mut room = None;
        let [_, load_2, load_4] = scene.loads.at([scene.elapsed, size], &mut room);

        let y_2 = after(flow, k_1, half);
        let k_2 = self.law(&y_2, middle, load_2, scene);
        let y_3 = after(flow, &k_2, half);
        let k_3 = self.law(&y_3, middle, load_2, scene);
        let y_4 = after(flow, &k_3, size);
        let k_4 = self.law(&y_4, end, load_4, scene);
        let sixth = size / 6.0;
        step.flow = Flow::from_fn(|i, _| flow[i] + (k_1[i] + (k_2[i] + k_3[i]) * 2.0 + k_4[i]) * sixth);
        turned(&mut step.flow, flow);
        step.carrier[0] = self.carrier(flow, k_1);
        step.carrier[1] = self.carrier(&mean(&y_2, &y_3), &mean(&k_2, &k_3));
        step.carrier[2] = self.carrier(&y_4, &k_4);
        step.slopes = [*k_1, k_4];
    }
}

/// Where `flow` is after the time `t` at the rates `k`.
#[inline]
fn after(flow: &Flow, k: &Flow, t: f64) -> Flow {
    Flow::from_fn(|i, _| flow[i] + k[i] * t)
}

#[inline]
fn mean(a: &Flow, b: &Flow) -> Flow {
    Flow::from_fn(|i, _| 0.5 * (a[i] + b[i]))
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
            let mut step = Internal::none(flow, &node);
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
                dynamics.internal_step(&mut step, &flow, &k_1, &node, size, &scene);
                (flow, node) = (step.flow, step.end);
            }
            flow
        };
        let exact = end_in(1280);
        let error = |steps| (end_in(steps) - exact).amax();
        let ratio = error(20) / error(40);
        assert!((14.0..18.0).contains(&ratio), "{ratio}");
    }
}
