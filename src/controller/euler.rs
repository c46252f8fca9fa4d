//! The thesis' own step: explicit Euler for the momentum, Jacobian at the old configuration (appendix A.1).
//!
//! Its error per step is of second order: at 1 ms it adds up to 0.1 mm over a calm run, and to 0.5 mm where
//! the arm oscillates in its null space.

use nalgebra::SVector;

use super::Controller;
use super::planner::Plan;
use super::resolution::{Problem, Resolved, Task};
use super::response::{Response, moment_impulse};
use crate::dynamics::{Dynamics, Loads, Situation, State, in_inertial_frame};
use crate::planar::Vec2;

/// The explicit part of a step: momentum at its end, and how the system answers to rates.
struct Explicit<const N: usize> {
    /// At the beginning, but with the momentum and the integrals of the end.
    situation: Situation<N>,
    response: Response<N>,
    torque_impulse: f64,
}

impl<const N: usize> Explicit<N> {
    /// The state at the end of a step of length `size` at the rates `rate`.
    fn end(&self, dynamics: &Dynamics<N>, rate: &SVector<f64, N>, size: f64) -> State<N> {
        let base = self.response.base_velocity(rate);
        let mut state = self.situation.state;
        state.velocity = in_inertial_frame(self.situation.turn, base);
        state.rate = *rate;
        state.pose += state.velocity * size;
        state.position += rate * size;
        if dynamics.on_carriage() {
            let matrix = &self.situation.node.matrix;
            let h = matrix.of_base(base) + matrix.of_rates(rate);
            (state.momentum.y, state.momentum.z) = (h.linear.y, h.angular);
        }
        state
    }

    /// Moment impulse of arm, payload and counterweight on the UAV in a step from `before` to `end`.
    fn moment_impulse(&self, dynamics: &Dynamics<N>, before: &State<N>, end: &State<N>) -> f64 {
        // What a carriage gives is what the angular momentum has gained beyond weight and loads.
        let carriage = if dynamics.on_carriage() { end.momentum.z - self.situation.state.momentum.z } else { 0.0 };
        moment_impulse(dynamics, before, end, self.torque_impulse + carriage)
    }
}

impl<const N: usize> Controller<N> {
    fn explicit(&self, t: f64, size: f64) -> Explicit<N> {
        let mut situation = self.situation;
        let trend = self.dynamics.at_beginning(&mut situation, &Loads::default(), t);
        situation.state.momentum += trend.momentum * size;
        situation.state.integrals += trend.integrals * size;
        Explicit { response: self.response(&situation), torque_impulse: trend.torque * size, situation }
    }

    /// Rates for the interval of length `horizon` from time `t`, at which the end effector moves with
    /// `velocity`.
    pub(super) fn plan_euler(&self, t: f64, horizon: f64, velocity: Vec2) -> Plan<N> {
        let (dynamics, before) = (&self.dynamics, &self.situation.state);
        let explicit = self.explicit(t, horizon);
        let response = &explicit.response;
        let resting = explicit.end(dynamics, &SVector::zeros(), horizon);
        let wanted = explicit.situation.turn.undo(velocity) - response.end_effector_free;
        let moment = Task { row: response.moment, value: -explicit.moment_impulse(dynamics, before, &resting) };
        let Resolved { rate, status, min_singular_value } =
            self.resolver.solve(&Problem { path: response.jacobian, velocity: wanted, moment });
        let end = explicit.end(dynamics, &rate, horizon);
        Plan {
            rate,
            status,
            min_singular_value,
            velocity_residual: (response.jacobian * rate - wanted).norm(),
            moment_residual: explicit.moment_impulse(dynamics, before, &end) / horizon,
            end: dynamics.situation(end),
        }
    }

    /// The prediction after `size` \[s\] from time `t` at the rates sent.
    pub(super) fn predict_euler(&self, t: f64, size: f64) -> Situation<N> {
        self.dynamics.situation(self.explicit(t, size).end(&self.dynamics, &self.rate, size))
    }
}
