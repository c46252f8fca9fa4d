//! One explicit step from beginning to end, as the thesis makes it (appendix A.1): momentum by Euler's method,
//! velocities by the matrices of the beginning.

use nalgebra::SVector;

use super::advance::refreshed;
use super::integrated_state::IntegratedState;
use super::{Dynamics, Loads, Situation, State, in_inertial_frame};
use crate::mechanics::kinematics::Displacement;
use crate::mechanics::momentum::Twist;
use crate::mechanics::planar::Rotation;

impl<const N: usize> Dynamics<N> {
    /// Makes `state` the state `here`, but with the momentum and the integrals after a step of length `size` from
    /// time `t`; how much angular momentum what the UAV carries gains if no moment is exerted on the UAV \[N m s\].
    ///
    /// Loads are those at the beginning, as seen with the velocities just before it. Takes a sample of the autopilot
    /// if it is due.
    pub fn begin_explicit(&self, here: &Situation<N>, t: f64, size: f64, state: &mut State<N>) -> f64 {
        let (load, node) = (&Loads::CALM.begin, &here.node);
        *state = here.state;
        self.sample(state, load, t);
        let integrated = here.integrated_state(self.base);
        state.contact = self.touches(&integrated, node, state.held);
        let context = Self::context(state);
        let mut rate = IntegratedState::ZERO;
        self.written(&mut rate, &integrated, node, here.base(), load, &context);
        state.momentum += rate.momentum * size;
        state.integrals += rate.integrals * size;
        self.carried_load(node, &self.carrier(&integrated, &rate), load) * size
    }

    /// Brings `end`, whose state has begun the step in `here`, to its end: after the time `size` \[s\] from time `t` at
    /// the rates `rate`, over the way `way` of the coordinates.
    pub fn end_explicit(
        &self,
        here: &Situation<N>,
        rate: &SVector<f64, N>,
        way: &SVector<f64, N>,
        [t, size]: [f64; 2],
        end: &mut Situation<N>,
    ) {
        let (state, matrix) = (&mut end.state, &here.node.matrix);
        let arm = matrix.sum_of_rates(rate);
        let base = self.base_motion(&here.node, state.momentum_in(here.rotation), arm);
        state.velocity = in_inertial_frame(here.rotation, base);
        state.rate = *rate;
        state.pose += state.velocity * size;
        state.position += way;
        if self.on_carriage() {
            let h = matrix.of_base(base) + arm;
            (state.momentum.y, state.momentum.z) = (h.linear.y, h.angular);
        }
        if refreshed(t) != refreshed(t + size) {
            *end = self.situation(*state);
            return;
        }
        // Small turns instead of sines spare a third of the step.
        let turned = Rotation::from_small_angle(state.velocity.z * size);
        end.rotation = if self.base.turns_arm() { here.rotation.then(turned) } else { Rotation::NONE };
        end.node.follow(&self.vehicle, &here.node, &Displacement::small(&self.vehicle, way), state.held, rate);
    }

    /// Displaces the coordinates in `situation` by a `way` so short that all is linear in it, after which the rates are
    /// `rate`. Momentum stays, and the base gives way; the sums over the arm stay, for the next instant makes them anew.
    pub fn displace(&self, situation: &mut Situation<N>, way: &SVector<f64, N>, rate: &SVector<f64, N>) {
        let Situation { state, rotation, node } = situation;
        let base = self.base_motion(node, Twist::ZERO, node.matrix.of_rates(way));
        state.pose += in_inertial_frame(*rotation, base);
        state.position += way;
        state.rate = *rate;
        let posture = node.posture;
        node.posture.follow(&self.vehicle, &posture, &Displacement::tiny(&self.vehicle, way));
        node.move_at(rate);
        if self.base.turns_arm() {
            *rotation = rotation.then(Rotation::by_tiny(base.angular));
        }
        let base = self.base_motion(node, state.momentum_in(*rotation), node.arm);
        state.velocity = in_inertial_frame(*rotation, base);
        if self.on_carriage() {
            let h = node.matrix.of_base(base) + node.arm;
            (state.momentum.y, state.momentum.z) = (h.linear.y, h.angular);
        }
    }
}
