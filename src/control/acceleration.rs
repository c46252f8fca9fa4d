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

use super::clock::Clock;
use super::plan::Plan;
use super::plan_context::PlanContext;
use super::prediction::Prediction;
use super::resolution::{Aims, Problem, Task};
use super::response::Response;
use crate::mechanics::dynamics::{Motion, Situation};
use crate::mechanics::kinematics::Displacement;
use crate::mechanics::planar::{Rotation, Vec2};

impl<const N: usize> PlanContext<N> {
    /// Accelerations for the interval of the `clock` from time `t`, with which the end effector has the
    /// `acceleration` now; the prediction at its `end`.
    pub fn accelerate_euler(&self, t: f64, clock: &Clock, acceleration: Vec2, end: &mut Prediction<N>) -> Plan<N> {
        let horizon = clock.horizon;
        let here = &self.now.situation;
        // After the jump of the base's velocity, if the payload has just been taken over.
        let base = self.dynamics.base_motion(&here.node, here.state.momentum_in(here.rotation), here.node.arm);
        let velocity = self.end_effector_velocity(here, base) + acceleration * horizon;
        let (ahead, carried) = self.ahead(t, horizon, end);
        let response = self.response(&ahead.node, ahead.rotation, &ahead.state);
        let problem = self.at_end(&response, ahead.rotation, velocity, self.moment_task(&response, carried), horizon);
        let resolved = self.solve(&problem, clock, None, Aims::All);
        let motion = self.accelerating_to(&resolved.rate, clock);
        self.accelerated(&ahead, &response, &motion, [t, horizon], end);
        Plan {
            velocity_residual: (problem.path * resolved.rate - problem.velocity).norm(),
            moment_residual: (carried - end.carried) / horizon,
            ..Plan::of(&resolved, motion)
        }
    }

    /// The prediction `end` by explicit steps after `size` \[s\] from time `t` under the accelerations sent; the impulse
    /// of the moment on the UAV \[N m s\].
    pub fn predict_accelerated(&self, t: f64, size: f64, end: &mut Prediction<N>) -> f64 {
        let (ahead, carried) = self.ahead(t, size, end);
        let response = self.response(&ahead.node, ahead.rotation, &ahead.state);
        self.accelerated(&ahead, &response, &self.motion, [t, size], end);
        carried - end.carried
    }

    /// The configuration in which a step of length `size` from time `t` at the present rates ends, with the momentum
    /// of its end, and the angular momentum at its end of what the UAV carries, if no moment is exerted on the UAV
    /// \[N m s\]. `end` has begun this step.
    fn ahead(&self, t: f64, size: f64, end: &mut Prediction<N>) -> (Situation<N>, f64) {
        let here = &self.now.situation;
        let state = &mut end.situation.state;
        let gained = self.dynamics.begin_explicit(here, t, size, state);
        let displacement = self.motion.rate * size;
        state.position += displacement;
        let mut ahead = Situation { state: *state, ..*here };
        let displacement = Displacement::small(&self.dynamics.vehicle, &displacement);
        ahead.node.follow(&self.dynamics.vehicle, &here.node, &displacement, state.held, &state.rate);
        (ahead, self.now.carried + gained)
    }

    /// Brings `end` to the end of the step, over the way from the configuration `ahead` that `motion` adds.
    fn accelerated(
        &self,
        ahead: &Situation<N>,
        response: &Response<N>,
        motion: &Motion<N>,
        [t, size]: [f64; 2],
        end: &mut Prediction<N>,
    ) {
        let displacement = motion.slope * (0.5 * size * size);
        self.end_explicit(ahead, response, &motion.rate_after(size), &displacement, [t, size], end);
    }

    /// What is asked of the rates at the end of an interval of length `interval` \[s\], where the system answers with
    /// `response`: the `velocity` along the followed axes (inertial frame), and what is asked of the `moment`.
    pub fn at_end(
        &self,
        response: &Response<N>,
        rotation: Rotation,
        velocity: Vec2,
        moment: Task<N>,
        interval: f64,
    ) -> Problem<N> {
        let followed = |v: Vec2| self.resolver.followed(rotation.apply(v));
        let mut path = response.jacobian;
        for mut column in path.column_iter_mut() {
            column.copy_from(&followed(column.clone_owned()));
        }
        Problem {
            path,
            velocity: self.resolver.followed(velocity) - followed(response.end_effector_free),
            interval,
            caution: self.damping.caution(),
            moment,
        }
    }
}
