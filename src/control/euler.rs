//! The thesis' own step: explicit Euler for the momentum, Jacobian at the old configuration (appendix A.1).
//!
//! Its error per step is of second order: at 1 ms it adds up to 0.1 mm over a calm run, and to 0.5 mm where
//! the arm oscillates in its null space.

use super::clock::Clock;
use super::plan::Plan;
use super::plan_context::PlanContext;
use super::prediction::Prediction;
use super::resolution::{Aims, Problem};
use crate::mechanics::dynamics::Motion;
use crate::mechanics::planar::Vec2;
use crate::parameters::Hold;

impl<const N: usize> PlanContext<N> {
    /// Rates for the interval of the `clock` from time `t`, at which the end effector moves with
    /// `velocity`; the prediction at its `end`.
    pub fn plan_euler(&self, t: f64, clock: &Clock, velocity: Vec2, end: &mut Prediction<N>) -> Plan<N> {
        let horizon = clock.horizon;
        let here = &self.now.situation;
        let carried = self.now.carried + self.dynamics.begin_explicit(here, t, horizon, &mut end.situation.state);
        let response = self.response(&here.node, here.rotation, &end.situation.state);
        let problem = Problem {
            path: response.jacobian,
            velocity: here.rotation.undo(velocity) - response.end_effector_free,
            interval: horizon,
            caution: self.damping.caution(),
            moment: self.moment_task(&response, carried),
        };
        let resolved = self.solve(&problem, clock, None, Aims::All);
        let rate = resolved.rate;
        self.end_explicit(here, &response, &rate, &(rate * horizon), [t, horizon], end);
        let motion = match self.hold {
            Hold::ZeroOrder => Motion::constant(rate),
            // As the thesis handed its rates to the multibody program.
            Hold::FirstOrder => self.accelerating_to(&rate, clock),
        };
        Plan {
            velocity_residual: (problem.path * rate - problem.velocity).norm(),
            moment_residual: (carried - end.carried) / horizon,
            ..Plan::of(&resolved, motion)
        }
    }

    /// The prediction `end` after `size` \[s\] from time `t` at the rates sent; the impulse of the moment on the UAV
    /// \[N m s\].
    pub fn predict_euler(&self, t: f64, size: f64, end: &mut Prediction<N>) -> f64 {
        if self.resolver.accelerates() {
            return self.predict_accelerated(t, size, end);
        }
        let (here, rate) = (&self.now.situation, self.motion.rate_after(size));
        let carried = self.now.carried + self.dynamics.begin_explicit(here, t, size, &mut end.situation.state);
        let response = self.response(&here.node, here.rotation, &end.situation.state);
        self.end_explicit(here, &response, &rate, &(rate * size), [t, size], end);
        carried - end.carried
    }
}
