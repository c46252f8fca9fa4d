//! Plans that hold at the end of the interval, not only to first order.
//!
//! The coming interval is integrated under the rates in question; the end effector is then on the
//! reference at its end, and the mean moment on the UAV is zero if that is asked for. Each iteration
//! solves the whole resolution linearised at the present rates, not a correction to them: corrections of
//! minimum norm would let motion in the null space grow without bound.

use nalgebra::SVector;

use super::Status;
use super::outset::Outset;
use super::plan::Plan;
use super::prediction::Prediction;
use super::resolution::{Problem, Task};
use crate::dynamics::{Account, Loads, Motion, Situation};
use crate::error::Result;
use crate::parameters::Hold;
use crate::reference::Target;

/// Iterations of a plan at most; one does normally, more where a stiff autopilot answers within the interval.
pub(super) const ITERATIONS: usize = 6;

/// End effector this close to the reference at the end of the interval is on it \[m\].
pub(super) const ON_REFERENCE: f64 = 1e-12;

/// Farther from the reference than this, an iteration that has come to its end has failed \[m\].
pub(super) const INEXACT: f64 = 1e-6;

/// Moment impulses on the UAV below this are none \[N m s\].
pub(super) const NO_IMPULSE: f64 = 1e-12;

impl<const N: usize> Outset<N> {
    /// Rates for the interval of length `horizon` from time `t` that bring the end effector onto the `target`
    /// at its end, as near as the iteration gets: its place, and with a hold of first order its velocity.
    /// Writes the prediction at its `end`.
    ///
    /// # Errors
    /// If the interval cannot be integrated.
    pub fn plan_exact(&self, t: f64, horizon: f64, target: &Target, end: &mut Prediction<N>) -> Result<Plan<N>> {
        let ramped = self.hold == Hold::FirstOrder;
        let mut plan = Plan { places: self.places, ..Plan::moving(if ramped { self.motion } else { self.go_on() }) };
        let allowed = self.allowed(horizon);
        let mut left_over = 0.0;
        let mut nearest: Option<(f64, Plan<N>)> = None;
        for iteration in 0..=ITERATIONS {
            let impulse = self.carry_out(&mut plan, t, horizon, end)?;
            let moment = plan.moment_residual * horizon;
            let missing = target.displacement - end.end_effector();
            let miss = missing.norm();
            let moment_free = !self.resolver.cancels_moment() || (moment - left_over).abs() <= NO_IMPULSE;
            if iteration > 0 {
                if (miss <= ON_REFERENCE && moment_free) || (iteration == ITERATIONS && miss <= INEXACT) {
                    return Ok(plan);
                }
                if plan.status == Status::Ok && nearest.as_ref().is_none_or(|(least, _)| miss < *least) {
                    nearest = Some((miss, plan));
                }
            }
            if iteration == ITERATIONS {
                break;
            }

            let Situation { node, turn, state } = &end.situation;
            let response = self.response(node, *turn, state);
            let mean = plan.motion.rate_after(0.5 * horizon);
            let velocity = response.jacobian * mean + turn.undo(missing / horizon);
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
                problem.velocity = turn.undo(target.velocity) - response.end_effector_free;
            }
            let resolved = self.resolver.solve(&self.dynamics.vehicle, &problem);
            if iteration > 0 && resolved.status != Status::Ok && resolved.status == plan.status && !ramped {
                // The path is given up in part: whether the rates still change says when it is over.
                let change = (resolved.rate - plan.motion.rate).norm() * horizon * self.resolver.reach;
                if change <= ON_REFERENCE {
                    return Ok(plan);
                }
            }
            let motion = if ramped && resolved.status == Status::Ok {
                self.ramp(&Problem { velocity, ..problem }, &resolved.rate, horizon)
            } else {
                Motion::constant(resolved.rate)
            };
            (plan.motion, plan.status, plan.places) = (motion, resolved.status, resolved.places);
            plan.min_singular_value = resolved.min_singular_value;
            left_over = resolved.moment;
        }
        if let Some((_, nearest)) = nearest
            && plan.status == Status::Ok
        {
            plan = Plan { status: Status::Inexact, ..nearest };
            self.carry_out(&mut plan, t, horizon, end)?;
        }
        Ok(plan)
    }

    /// Constant rates that go on changing as they did, along a cubic: so close that one iteration leaves nothing, where
    /// rates extrapolated along a straight line take two.
    fn go_on(&self) -> Motion<N> {
        let [first, second, third] = &self.before;
        Motion::constant((self.motion.rate + second) * 4.0 - first * 6.0 - third)
    }

    /// Integrates the interval of length `horizon` from time `t` in the motion of the `plan`: where it ends, and the
    /// moment on the UAV. The result is the impulse of all other moments on what the UAV carries \[N m s\].
    ///
    /// # Errors
    /// If it cannot be integrated.
    pub fn carry_out(&self, plan: &mut Plan<N>, t: f64, horizon: f64, end: &mut Prediction<N>) -> Result<f64> {
        let dynamics = &self.dynamics;
        let mut impulse = 0.0;
        end.situation = self.now.situation;
        dynamics.advance(&mut end.situation, &plan.motion, &Loads::CALM, t, horizon, Account::Carried(&mut impulse))?;
        end.end_step(dynamics);
        plan.moment_residual = (self.now.carried + impulse - end.carried) / horizon;
        Ok(impulse)
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
