//! Plans that hold at the end of the interval, not only to first order.
//!
//! The coming interval is integrated under the rates in question; the end effector is then on the
//! reference at its end, and the mean moment on the UAV is zero if that is asked for. Each iteration
//! solves the whole resolution linearised at the present rates, not a correction to them: corrections of
//! minimum norm would let motion in the null space grow without bound.

use super::planner::Plan;
use super::prediction::Prediction;
use super::resolution::{Problem, Task};
use super::{Controller, Status};
use crate::dynamics::{Account, Loads, Motion};
use crate::error::Result;
use crate::planar::Vec2;

/// Iterations of a plan at most; two do normally, more where a stiff autopilot answers within the interval.
const ITERATIONS: usize = 6;

/// End effector this close to the reference at the end of the interval is on it \[m\].
const ON_REFERENCE: f64 = 1e-12;

/// Farther from the reference than this, an iteration that has come to its end has failed \[m\].
const INEXACT: f64 = 1e-6;

/// Moment impulses on the UAV below this are none \[N m s\].
const NO_IMPULSE: f64 = 1e-12;

impl<const N: usize> Controller<N> {
    /// Rates for the interval of length `horizon` from time `t` that bring the end effector to `target` at
    /// its end, as near as the iteration gets.
    ///
    /// # Errors
    /// If the interval cannot be integrated.
    pub(super) fn plan_exact(&self, t: f64, horizon: f64, target: Vec2) -> Result<Plan<N>> {
        let dynamics = &self.dynamics;
        // Rates that go on changing as they did are close already.
        let mut plan = Plan { places: self.places, ..Plan::holding(self.rate * 2.0 - self.rate_before, self.now) };
        let allowed = self.allowed(horizon);
        let mut left_over = 0.0;
        let mut nearest: Option<(f64, Plan<N>)> = None;
        for iteration in 0..=ITERATIONS {
            let mut end = self.now.situation;
            let motion = Motion::constant(plan.rate);
            let mut impulse = 0.0;
            dynamics.advance(&mut end, &motion, &Loads::CALM, t, horizon, Account::Carried(&mut impulse))?;
            plan.end = Prediction::at_end(dynamics, end);
            let moment = self.now.carried + impulse - plan.end.carried;
            plan.moment_residual = moment / horizon;
            let missing = target - plan.end.end_effector();
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
            let velocity = response.jacobian * plan.rate + end.turn.undo(missing / horizon);
            let moment = Task { row: response.carried, value: response.carried.dot(&plan.rate) + moment };
            let problem = Problem {
                beginning: &self.now.situation,
                path: response.jacobian,
                velocity,
                moment,
                allowed: &allowed,
                guess: &plan.places,
            };
            let resolved = self.resolver.solve(&dynamics.vehicle, &problem);
            (plan.rate, plan.status, plan.places) = (resolved.rate, resolved.status, resolved.places);
            plan.min_singular_value = resolved.min_singular_value;
            left_over = resolved.moment;
        }
        match nearest {
            Some((_, nearest)) if plan.status == Status::Ok => Ok(Plan { status: Status::Inexact, ..nearest }),
            _ => Ok(plan),
        }
    }
}
