//! Plans that hold at the end of the interval, not only to first order.
//!
//! The coming interval is integrated under the rates in question; the end effector is then on the
//! reference at its end, and the mean moment on the UAV is zero if that is asked for. Each iteration
//! solves the whole resolution linearised at the present rates, not a correction to them: corrections of
//! minimum norm would let motion in the null space grow without bound.

use nalgebra::SVector;

use super::planner::Plan;
use super::prediction::Prediction;
use super::resolution::{Problem, Task};
use super::{Controller, Status};
use crate::dynamics::{Account, Loads, Motion};
use crate::error::Result;
use crate::parameters::Hold;
use crate::reference::Target;

/// Iterations of a plan at most; two do normally, more where a stiff autopilot answers within the interval.
const ITERATIONS: usize = 6;

/// End effector this close to the reference at the end of the interval is on it \[m\].
const ON_REFERENCE: f64 = 1e-12;

/// Farther from the reference than this, an iteration that has come to its end has failed \[m\].
const INEXACT: f64 = 1e-6;

/// Moment impulses on the UAV below this are none \[N m s\].
const NO_IMPULSE: f64 = 1e-12;

impl<const N: usize> Controller<N> {
    /// Rates for the interval of length `horizon` from time `t` that bring the end effector onto the `target`
    /// at its end, as near as the iteration gets: its place, and with a hold of first order its velocity.
    ///
    /// # Errors
    /// If the interval cannot be integrated.
    pub(super) fn plan_exact(&self, t: f64, horizon: f64, target: &Target) -> Result<Plan<N>> {
        let dynamics = &self.dynamics;
        let ramped = self.hold == Hold::FirstOrder;
        // Rates that go on changing as they did are close already.
        let guess = if ramped { self.motion } else { Motion::constant(self.motion.rate * 2.0 - self.rate_before) };
        let mut plan = Plan { places: self.places, ..Plan::moving(guess, self.now) };
        let allowed = self.allowed(horizon);
        let mut left_over = 0.0;
        let mut nearest: Option<(f64, Plan<N>)> = None;
        for iteration in 0..=ITERATIONS {
            let mut end = self.now.situation;
            let mut impulse = 0.0;
            dynamics.advance(&mut end, &plan.motion, &Loads::CALM, t, horizon, Account::Carried(&mut impulse))?;
            plan.end = Prediction::at_end(dynamics, end);
            let moment = self.now.carried + impulse - plan.end.carried;
            plan.moment_residual = moment / horizon;
            let missing = target.displacement - plan.end.end_effector();
            let miss = missing.norm();
            let moment_free = !self.resolver.cancels_moment() || (moment - left_over).abs() <= NO_IMPULSE;
            if iteration > 0 {
                if (miss <= ON_REFERENCE && moment_free) || (iteration == ITERATIONS && miss <= INEXACT) {
                    return Ok(plan);
                }
                if plan.status == Status::Ok && nearest.as_ref().is_none_or(|(least, _)| miss < *least) {
                    nearest = Some((miss, plan.clone()));
                }
            }
            if iteration == ITERATIONS {
                break;
            }

            let response = self.response(&end);
            let mean = plan.motion.rate_after(0.5 * horizon);
            let velocity = response.jacobian * mean + end.turn.undo(missing / horizon);
            let moment = Task { row: response.carried, value: self.now.carried + impulse - response.carried_free };
            let mut problem = Problem {
                beginning: &self.now.situation,
                path: response.jacobian,
                velocity,
                moment,
                allowed: &allowed,
                guess: &plan.places,
            };
            if ramped {
                problem.velocity = end.turn.undo(target.velocity) - response.end_effector_free;
            }
            let resolved = self.resolver.solve(&dynamics.vehicle, &problem);
            let motion = if ramped && resolved.status == Status::Ok {
                self.ramp(&Problem { velocity, ..problem }, &resolved.rate, horizon)
            } else {
                Motion::constant(resolved.rate)
            };
            (plan.motion, plan.status, plan.places) = (motion, resolved.status, resolved.places);
            plan.min_singular_value = resolved.min_singular_value;
            left_over = resolved.moment;
        }
        match nearest {
            Some((_, nearest)) if plan.status == Status::Ok => Ok(Plan { status: Status::Inexact, ..nearest }),
            _ => Ok(plan),
        }
    }

    /// The motion that ends at the rates `last` and follows the path of `problem` in the mean.
    ///
    /// Where it has a choice it begins at the rates with which the interval before ended; in the direction of
    /// the path it cannot, for a ramp from given rates to a given place would ring for ever.
    fn ramp(&self, problem: &Problem<'_, N>, last: &SVector<f64, N>, horizon: f64) -> Motion<N> {
        let smooth = (self.motion.rate + last) * 0.5;
        let mean = self.resolver.nearest(problem, &smooth);
        let first = self.resolver.within_limits(mean * 2.0 - last);
        Motion { rate: first, slope: (last - first) / horizon }
    }
}
