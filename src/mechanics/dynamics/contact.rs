//! The payload on its elastic support: contact begins and ends inside a step.
//!
//! The support pushes with k (y_s - y_payload) and never pulls (thesis 4.1). The force has a kink where
//! contact switches, so a step is cut there, at an instant found by iterating on the step's length.

use super::advance::RESOLUTION;
use super::integrated_state::IntegratedState;
use super::law::{Node, StepContext};
use super::runge_kutta::Internal;
use super::{Dynamics, in_inertial_frame};

/// Gaps below this are zero \[m\]: their force is rounding.
pub(super) const NO_GAP: f64 = 1e-13;

/// Iterations that find a switching instant; the bracket shrinks superlinearly.
const ITERATIONS: usize = 60;

impl<const N: usize> Dynamics<N> {
    /// Whether the support pushes on the held payload right after the present instant.
    pub(super) fn touches(&self, integrated: &IntegratedState, node: &Node<N>, held: bool) -> bool {
        if !held || self.support.stiffness == 0.0 {
            return false;
        }
        let rotation = self.arm_rotation(integrated);
        let gap = self.gap(integrated, rotation, node);
        if gap.abs() > NO_GAP {
            return gap < 0.0;
        }
        let velocity = in_inertial_frame(rotation, self.base_velocity(integrated, rotation, node));
        self.gap_rate(rotation, node, &velocity) < 0.0
    }

    /// Length of an internal step within which contact switches, or `None` if it lasts, or stays away, all through
    /// `whole`, the step that ends with the integrated state `to` and the arm at `end`.
    #[inline]
    pub(super) fn switches_within(
        &self,
        whole: &Internal<N>,
        (to, end): (&IntegratedState, &Node<N>),
        context: &StepContext<'_, N>,
    ) -> Option<f64> {
        if !context.held || self.support.stiffness == 0.0 {
            return None;
        }
        let margin = self.margin(to, end, context);
        if margin < -NO_GAP {
            return Some(whole.size);
        }
        // Both ends lie on the same side; in between there may be a way across and back, but not a long one.
        let start = self.margin(&whole.from, &whole.nodes[0], context);
        let dip = self.deepest_dip(&whole.rates, whole.size);
        if start > dip && margin > dip {
            return None;
        }
        self.dips_within(whole, (to, end), [start, margin], context)
    }

    /// Length of an internal step at whose end the `whole` one has crossed the support, to come back: its margins at both
    /// ends are positive.
    #[inline(never)]
    fn dips_within(
        &self,
        whole: &Internal<N>,
        (to, end): (&IntegratedState, &Node<N>),
        [start, margin]: [f64; 2],
        context: &StepContext<'_, N>,
    ) -> Option<f64> {
        let Internal { nodes: [begin, _], from, rates: [k_1, .., k_4], size, .. } = whole;
        let rate = |integrated: &IntegratedState, k: &IntegratedState, node: &Node<N>| {
            context.side() * self.gap_rate(self.arm_rotation(integrated), node, &k.pose)
        };
        let dip = lowest([start.max(0.0), margin], [rate(from, k_1, begin), rate(to, k_4, end)], *size)?;
        (self.margin_after(dip, whole, context) < -NO_GAP).then_some(dip)
    }

    /// More than the margin can dip below its smaller end in an internal step of length `size` with these `rates` of the
    /// integrated state \[m\]. Away from the support it spares the velocities of the payload, a twentieth of the whole step.
    #[inline]
    fn deepest_dip(&self, [k_1, .., k_4]: &[IntegratedState; 4], size: f64) -> f64 {
        // An internal step is so short that the links, and the UAV as at its beginning, turn no farther than this.
        let turning = 2.0 * RESOLUTION + k_4.pose.z.abs() * size;
        let way = (k_1.pose.y.abs() + k_4.pose.y.abs()) * size + turning * self.vehicle.payload_reach;
        // A cubic dips by 4/27 of its slopes at both ends.
        0.15 * way
    }

    /// The instant within the internal `step`, or one of length `size` with the same beginning, at which contact switches.
    #[cold]
    pub(super) fn switching_instant(&self, step: &Internal<N>, size: f64, context: &StepContext<'_, N>) -> f64 {
        let begin = self.margin(&step.from, &step.nodes[0], context);
        switching_instant(begin, size, &|length| self.margin_after(length, step, context))
    }

    /// [`Dynamics::margin`] after an internal step of this `length` that begins like `step`.
    #[cold]
    #[inline(never)]
    fn margin_after(&self, length: f64, step: &Internal<N>, context: &StepContext<'_, N>) -> f64 {
        let mut step = *step;
        let (mut to, mut end) = (IntegratedState::ZERO, step.nodes[0]);
        self.internal_step(&mut step, length, context, (&mut to, &mut end));
        self.margin(&to, &end, context)
    }

    /// Distance \[m\] from switching: positive while the present state of contact lasts.
    pub(super) fn margin(&self, integrated: &IntegratedState, node: &Node<N>, context: &StepContext<'_, N>) -> f64 {
        context.side() * self.gap(integrated, self.arm_rotation(integrated), node)
    }
}

/// The instant within an internal step of length `size` at which the margin, `begin` at its beginning, is zero.
#[cold]
pub(super) fn switching_instant(begin: f64, size: f64, margin_after: &dyn Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = ((0.0, begin), (size, margin_after(size)));
    // Right after switching the margin is rounding: what is wanted is the way back, not the way here.
    while low.1 <= NO_GAP && high.0 > f64::EPSILON * size {
        let length = 0.5 * high.0;
        let value = margin_after(length);
        if value > NO_GAP {
            low = (length, value);
        } else {
            high = (length, value);
        }
    }
    // Regula falsi with halving of the stale end's value (Illinois).
    let mut side = 0;
    for _ in 0..ITERATIONS {
        let length = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        let value = margin_after(length);
        if value.abs() <= NO_GAP || high.0 - low.0 <= f64::EPSILON * size {
            return length;
        }
        if value > 0.0 {
            low = (length, value);
            high.1 *= if side == 1 { 0.5 } else { 1.0 };
            side = 1;
        } else {
            high = (length, value);
            low.1 *= if side == -1 { 0.5 } else { 1.0 };
            side = -1;
        }
    }
    high.0
}

/// Where the cubic with these values and slopes at both ends of an interval of length `size` falls below
/// zero, if it does: its minimum.
pub(super) fn lowest([start, end]: [f64; 2], [down, up]: [f64; 2], size: f64) -> Option<f64> {
    if down >= 0.0 || up <= 0.0 {
        return None;
    }
    // Hermite form in s = t / size: c0 + c1 s + c2 s^2 + c3 s^3.
    let (c1, slope) = (down * size, up * size);
    let c2 = 3.0 * (end - start) - 2.0 * c1 - slope;
    let c3 = 2.0 * (start - end) + c1 + slope;
    let root = (c2 * c2 - 3.0 * c1 * c3).max(0.0).sqrt();
    let s = -c1 / (c2 + root);
    let value = start + s * (c1 + s * (c2 + s * c3));
    (s > 0.0 && s < 1.0 && value < 0.0).then_some(s * size)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::mechanics::dynamics::advance::TUMBLING;
    use crate::mechanics::dynamics::{Load, Loads, Situation, State};
    use crate::parameters::defaults::default_parameters;
    use crate::parameters::{BaseModel, Structure};

    /// No cubic with the slopes of the real margin dips deeper, whatever moves the payload, which may be behind its joint:
    /// links on a heavy UAV, its momentum, or a torque on it.
    #[test]
    fn no_dip_is_deeper_than_the_deepest() {
        for com in [2.0, -2.0] {
            let mut parameters = default_parameters(Structure::DEFAULT);
            parameters.payload.com = com;
            (parameters.joints[0].start, parameters.joints[1].start, parameters.joints[2].start) =
                (FRAC_PI_2, 0.0, 0.0);
            (parameters.uav.mass, parameters.uav.inertia) = (1e4, 1e4);
            let dynamics = Dynamics::<3>::new(Structure::DEFAULT, &parameters, BaseModel::Full).unwrap();
            let start = dynamics.start(&parameters).state;
            for momentum in [[0.0; 3], [0.0, 2e5, 0.0], [0.0, 0.0, 1e5], [1e5, -3e5, -5e4]] {
                for rate in [[0.0; 3], [0.5, 0.0, 0.0], [20.0, 0.0, 0.0], [0.0, 0.0, -15.0], [8.0, -8.0, 8.0]] {
                    for base_torque in [0.0, 1e9] {
                        let state = State { held: true, rate: rate.into(), momentum: momentum.into(), ..start };
                        check(&dynamics, &dynamics.situation(state), &Load { base_torque, ..Load::NONE });
                    }
                }
            }
        }
    }

    fn check(dynamics: &Dynamics<3>, start: &Situation<3>, load: &Load) {
        let loads = Loads { begin: load, slope: None };
        let context = StepContext { loads: &loads, ..Dynamics::context(&start.state) };
        let (node, from) = (&start.node, &start.integrated_state(BaseModel::Full));
        let mut step = Internal::none(node);
        step.from = *from;
        dynamics.law(&mut step.rates[0], from, node, load, &context);
        let turning = dynamics.turning(&node.rate) + TUMBLING * step.rates[0].pose.z.abs();
        let size = RESOLUTION / turning.max(10.0);
        let (mut to, mut end) = (*from, *node);
        dynamics.internal_step(&mut step, size, &context, (&mut to, &mut end));
        let slope = |integrated: &IntegratedState, k: &IntegratedState, node: &Node<3>| {
            dynamics.gap_rate(dynamics.arm_rotation(integrated), node, &k.pose).abs() * size
        };
        let dip = 4.0 / 27.0 * (slope(from, &step.rates[0], node) + slope(&to, &step.rates[3], &end));
        let deepest = dynamics.deepest_dip(&step.rates, size);
        assert!(dip <= deepest, "{dip} > {deepest}: {:?}, {from:?}, {load:?}", node.rate);
    }
}
