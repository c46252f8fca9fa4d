//! One internal step: the classical Runge-Kutta method of order 4.
//!
//! Rates are imposed, so the arm itself is evaluated at two new instants only, and the four stages are
//! cheap. Methods of order 6 need twice as many instants; at the steps of a millisecond that a
//! communication with a controller asks for, order 4 already leaves nothing but rounding.

use super::integrated_state::IntegratedState;
use super::law::{Carrier, Node, StepContext};
use super::{Dynamics, Load, Loads};
use crate::mechanics::kinematics::Displacement;

/// An internal step, as far as it is of interest afterwards; only its end is kept elsewhere.
#[derive(Debug, Clone, Copy)]
pub(super) struct Internal<const N: usize> {
    /// The arm at the beginning and in the middle.
    pub nodes: [Node<N>; 2],
    /// At the beginning.
    pub from: IntegratedState,
    /// Rates of the integrated state as the four stages see them.
    pub rates: [IntegratedState; 4],
    /// When it begins, from the beginning of the loads \[s\].
    pub elapsed: f64,
    /// Its length \[s\].
    pub size: f64,
    /// Whether the payload is held.
    pub held: bool,
}

impl<const N: usize> Internal<N> {
    /// None yet; `node`: any arm.
    pub fn none(node: &Node<N>) -> Self {
        Self {
            nodes: [*node; 2],
            from: IntegratedState::ZERO,
            rates: [IntegratedState::ZERO; 4],
            elapsed: 0.0,
            size: 0.0,
            held: false,
        }
    }
}

impl<const N: usize> Dynamics<N> {
    /// One step of length `size` under the motion of `context`, from where `step` says that it begins: integrated state and its rates
    /// there, and the arm. Where it ends is written to `to` and `end`, all else to `step`.
    pub(super) fn internal_step(
        &self,
        step: &mut Internal<N>,
        size: f64,
        context: &StepContext<'_, N>,
        (to, end): (&mut IntegratedState, &mut Node<N>),
    ) {
        let half = 0.5 * size;
        let StepContext { motion, held, .. } = context;
        let [begin, middle] = &mut step.nodes;
        let way = |t: f64| Displacement::small(&self.vehicle, &motion.way(t));
        let first_half = way(half);
        if motion.is_steady() {
            // The second half is like the first one.
            middle.follow(&self.vehicle, begin, &first_half, *held, &motion.rate);
            end.follow(&self.vehicle, middle, &first_half, *held, &motion.rate);
        } else {
            middle.follow(&self.vehicle, begin, &first_half, *held, &motion.rate_after(half));
            end.follow(&self.vehicle, begin, &way(size), *held, &motion.rate_after(size));
        }
        (step.elapsed, step.size, step.held) = (context.elapsed, size, context.held);

        let mut room = None;
        let [_, load_2, load_4] = context.loads.at([context.elapsed, size], &mut room);

        let (from, [k_1, k_2, k_3, k_4]) = (&step.from, &mut step.rates);
        self.law(k_2, &from.stage(k_1, half), middle, load_2, context);
        self.law(k_3, &from.stage(k_2, half), middle, load_2, context);
        self.law(k_4, &from.stage(k_3, size), end, load_4, context);
        let sixth = size / 6.0;
        *to = *from + (*k_1 + (*k_2 + *k_3) * 2.0 + *k_4) * sixth;
        to.align_rotation(from);
    }

    /// Hands what the stages of `step` saw at the beginning, in the middle and at the end, where the arm is at `end`, to
    /// `entry`, with the weight of each \[s\].
    ///
    /// By Simpson's rule, the stages in the middle taken together: of order 4 like the step itself.
    #[inline]
    pub(super) fn by_simpson(
        &self,
        step: &Internal<N>,
        end: &Node<N>,
        loads: &Loads,
        mut entry: impl FnMut(&Node<N>, &Carrier, &Load, f64),
    ) {
        let Internal { nodes: [begin, middle], from, rates: [k_1, k_2, k_3, k_4], elapsed, size, .. } = step;
        let mut room = None;
        let [load_1, load_2, load_4] = loads.at([*elapsed, *size], &mut room);
        let (y_2, y_3, y_4) = (from.stage(k_1, 0.5 * size), from.stage(k_2, 0.5 * size), from.stage(k_3, *size));
        let carriers =
            [self.carrier(from, k_1), self.carrier(&mean(&y_2, &y_3), &mean(k_2, k_3)), self.carrier(&y_4, k_4)];
        let instants = [begin, middle, end].into_iter().zip(&carriers).zip([load_1, load_2, load_4]);
        for (((node, carrier), load), share) in instants.zip([1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0]) {
            entry(node, carrier, load, size * share);
        }
    }
}

#[inline]
fn mean(a: &IntegratedState, b: &IntegratedState) -> IntegratedState {
    (*a + *b) * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::dynamics::{Loads, Motion};
    use crate::parameters::defaults::default_parameters;
    use crate::parameters::{BaseModel, Structure};

    /// The error after a fixed time falls by 2^4 when the steps are halved, on the real equations.
    #[test]
    fn halving_the_step_divides_the_error_by_sixteen() {
        let mut parameters = default_parameters(Structure::DEFAULT);
        parameters.mount.x = 0.05;
        let dynamics = Dynamics::<3>::new(Structure::DEFAULT, &parameters, BaseModel::Full).unwrap();
        let start = dynamics.start(&parameters);
        let motion = Motion::constant([1.5, -2.0, 2.5].into());
        let loads = Loads::CALM;
        let end_in = |steps: u32| {
            let size = 0.4 / f64::from(steps);
            let (mut integrated, mut node) = (start.integrated_state(BaseModel::Full), start.node);
            node.move_at(&motion.rate);
            let mut step = Internal::none(&node);
            let context = StepContext {
                loads: &loads,
                elapsed: 0.0,
                held: false,
                contact: false,
                sampled: crate::mechanics::planar::Vec2::zeros(),
                motion,
            };
            for _ in 0..steps {
                step.nodes[0] = node;
                dynamics.law(&mut step.rates[0], &integrated, &node, loads.begin, &context);
                step.from = integrated;
                dynamics.internal_step(&mut step, size, &context, (&mut integrated, &mut node));
            }
            integrated
        };
        let exact = end_in(1280);
        let error = |steps| end_in(steps).distance(&exact);
        let ratio = error(20) / error(40);
        assert!((14.0..18.0).contains(&ratio), "{ratio}");
    }
}
