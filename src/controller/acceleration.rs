//! Accelerations instead of rates, by which arm and balance element together leave the UAV without moment
//! (thesis 3.4).
//!
//! Rates are continuous, at the grasp too. In the coming interval the coordinates accelerate uniformly, so that at
//! its end the end effector has the wanted velocity along the axes of the path that are followed, and the moment on
//! the UAV has been zero in the mean. That is (3.18), `J_ext` q'' = (wanted acceleration, moment) - `J_ext`' q',
//! with both sides integrated over the interval, where the right-hand side has become a difference of states:
//!
//! - `exact`: the state at the end is that under the accelerations in question, and the wanted velocity makes good
//!   what the place is off. To impose the place alone would ring, since the rates cannot jump.
//! - `euler`: the state at the end is foreseen with the present rates, and the velocity is the present one plus
//!   the wanted acceleration times the step. As in the thesis nothing that is off is ever made good.

use nalgebra::{SMatrix, SVector};

use super::Status;
use super::exact::{INEXACT, ITERATIONS, NO_IMPULSE, ON_REFERENCE};
use super::limits::Allowed;
use super::outset::Outset;
use super::plan::Plan;
use super::prediction::Prediction;
use super::resolution::{Problem, Task};
use super::response::Response;
use crate::dynamics::{Motion, Situation};
use crate::error::Result;
use crate::planar::{Turn, Vec2};

impl<const N: usize> Outset<N> {
    /// Accelerations for the interval of length `horizon` from time `t`, at the end of which the end effector
    /// moves with `velocity`; the prediction at its `end`.
    ///
    /// # Errors
    /// If the interval cannot be integrated.
    pub fn accelerate_exact(&self, t: f64, horizon: f64, velocity: Vec2, end: &mut Prediction<N>) -> Result<Plan<N>> {
        let mut plan = Plan::moving(self.accelerating_to(&self.motion.rate_after(horizon), horizon));
        let allowed = self.allowed(horizon);
        let mut left_over = 0.0;
        for iteration in 0..=ITERATIONS {
            let impulse = self.carry_out(&mut plan, t, horizon, end)?;
            let Situation { node, turn, state } = &end.situation;
            let response = self.response(node, *turn, state);
            let problem = self.at_end(&response, *turn, velocity, self.now.carried + impulse, &allowed);
            let miss = horizon * (problem.velocity - problem.path * plan.motion.rate_after(horizon)).norm();
            if iteration > 0 {
                let moment_free = (plan.moment_residual * horizon - left_over).abs() <= NO_IMPULSE;
                if (miss <= ON_REFERENCE && moment_free) || iteration == ITERATIONS {
                    if miss > INEXACT && plan.status == Status::Ok {
                        plan.status = Status::Inexact;
                    }
                    break;
                }
            }
            let resolved = self.resolver.solve(&self.dynamics.vehicle, &problem);
            left_over = resolved.moment;
            (plan.status, plan.min_singular_value) = (resolved.status, resolved.min_singular_value);
            plan.motion = self.accelerating_to(&resolved.rate, horizon);
        }
        Ok(plan)
    }

    /// Accelerations for the interval of length `horizon` from time `t`, with which the end effector has the
    /// `acceleration` now; the prediction at its `end`.
    pub fn accelerate_euler(&self, t: f64, horizon: f64, acceleration: Vec2, end: &mut Prediction<N>) -> Plan<N> {
        let (here, allowed) = (&self.now.situation, self.allowed(horizon));
        // After the jump of the base's velocity, if the payload has just been taken over.
        let now = self.response(&here.node, here.turn, &here.state);
        let velocity = here.turn.apply(now.end_effector_velocity(&self.motion.rate));
        let (ahead, carried) = self.ahead(t, horizon, end);
        let response = self.response(&ahead.node, ahead.turn, &ahead.state);
        let problem = self.at_end(&response, ahead.turn, velocity + acceleration * horizon, carried, &allowed);
        let resolved = self.resolver.solve(&self.dynamics.vehicle, &problem);
        let motion = self.accelerating_to(&resolved.rate, horizon);
        self.accelerated(&ahead, &response, &motion, t, horizon, end);
        Plan {
            status: resolved.status,
            min_singular_value: resolved.min_singular_value,
            velocity_residual: (problem.path * resolved.rate - problem.velocity).norm(),
            moment_residual: (carried - end.carried) / horizon,
            ..Plan::moving(motion)
        }
    }

    /// The prediction `end` by explicit steps after `size` \[s\] from time `t` under the accelerations sent.
    pub fn predict_accelerated(&self, t: f64, size: f64, end: &mut Prediction<N>) {
        let (ahead, _) = self.ahead(t, size, end);
        let response = self.response(&ahead.node, ahead.turn, &ahead.state);
        self.accelerated(&ahead, &response, &self.motion, t, size, end);
    }

    /// The configuration in which a step of length `size` from time `t` at the present rates ends, with the momentum
    /// of its end, and the angular momentum at its end of what the UAV carries, if no moment is exerted on the UAV
    /// \[N m s\]. `end` has begun this step.
    fn ahead(&self, t: f64, size: f64, end: &mut Prediction<N>) -> (Situation<N>, f64) {
        let gained = self.dynamics.begin_explicit(&self.now.situation, t, size, &mut end.situation.state);
        let state = &mut end.situation.state;
        state.position += self.motion.rate * size;
        (self.dynamics.situation(*state), self.now.carried + gained)
    }

    /// Brings `end` to the end of the step, over the way from the configuration `ahead` that `motion` adds.
    fn accelerated(
        &self,
        ahead: &Situation<N>,
        response: &Response<N>,
        motion: &Motion<N>,
        t: f64,
        size: f64,
        end: &mut Prediction<N>,
    ) {
        let (rate, rest) = (motion.rate_after(size), motion.slope * (0.5 * size * size));
        self.dynamics.end_explicit(ahead, response.base_velocity(&rate), &rate, &rest, [t, size], &mut end.situation);
        end.carried = response.carried_momentum(&rate);
    }

    /// From the present rates to the rates `last`.
    fn accelerating_to(&self, last: &SVector<f64, N>, horizon: f64) -> Motion<N> {
        let first = self.resolver.within_limits(self.motion.rate);
        Motion { rate: first, slope: (last - first) / horizon }
    }

    /// What is asked of the rates at the end of the interval, where the system answers with `response`: the
    /// `velocity` along the followed axes (inertial frame), and the angular momentum `carried` without moment.
    fn at_end<'a>(
        &'a self,
        response: &Response<N>,
        turn: Turn,
        velocity: Vec2,
        carried: f64,
        allowed: &'a Allowed,
    ) -> Problem<'a, N> {
        let followed = |v: Vec2| self.resolver.followed(turn.apply(v));
        let mut path = SMatrix::<f64, 2, N>::zeros();
        for (i, column) in response.jacobian.column_iter().enumerate() {
            path.set_column(i, &followed(column.into()));
        }
        Problem {
            beginning: &self.now.situation,
            path,
            velocity: self.resolver.followed(velocity) - followed(response.end_effector_free),
            moment: Task { row: response.carried, value: carried - response.carried_free },
            allowed,
            guess: &self.places,
        }
    }
}
