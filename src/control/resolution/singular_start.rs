//! Out of a singular configuration at rest, where no rates move the end effector the way it is to go.
//!
//! A stretched arm that is to be drawn in shows the case: to first order, no rate shortens it. To second order bending
//! does, in either sense. So where the arm is as good as singular, and rests, it is set going in the rates that lead
//! nowhere to first order, if the end effector then accelerates towards where it is to go. As soon as the
//! arm is bent, the inverse kinematics goes on by itself.

use nalgebra::SVector;

use super::{Problem, PseudoInverse, Resolver};
use crate::mechanics::dynamics::Situation;
use crate::mechanics::momentum::{Twist, tip_acceleration};
use crate::mechanics::vehicle::Vehicle;
use crate::parameters::PathAxes;

/// Norm of the rates that set the arm going \[rad/s\].
const KICK: f64 = 0.01;

/// Singular values below this share of the arm's reach leave the arm at rest for long.
const AS_GOOD_AS_SINGULAR: f64 = 1e-5;

/// Shorter ways within an interval are rounding, or the last bit of a path that ends there \[m\].
const SHORT: f64 = 1e-9;

impl Resolver {
    /// Leads the rates `found` for the `problem` out of a singular configuration at the `beginning`. In place: a copy
    /// would have to wait until what is copied has left the processor's store buffer.
    #[inline]
    pub(super) fn set_going<const N: usize>(
        &self,
        vehicle: &Vehicle<N>,
        beginning: &Situation<N>,
        problem: &Problem<N>,
        found: &mut PseudoInverse<N>,
    ) {
        if found.min_singular_value >= AS_GOOD_AS_SINGULAR * self.reach || self.axes == PathAxes::Horizontal {
            return;
        }
        if let Some(kick) = self.kick(vehicle, beginning, problem, found) {
            found.rate += kick;
        }
    }

    #[cold]
    fn kick<const N: usize>(
        &self,
        vehicle: &Vehicle<N>,
        beginning: &Situation<N>,
        problem: &Problem<N>,
        found: &PseudoInverse<N>,
    ) -> Option<SVector<f64, N>> {
        let missing = problem.velocity - problem.path * found.rate;
        if missing.norm() * problem.interval < SHORT || found.rate.norm() >= KICK {
            return None;
        }
        // All rates but those that move the end effector in the direction in which it moves most easily.
        let strong = problem.path.column_iter().max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()))?;
        let led = (problem.path.transpose() * strong).try_normalize(f64::MIN_POSITIVE)?;
        let posture = &beginning.node.posture;
        let towards = |rate: &SVector<f64, N>| {
            tip_acceleration(vehicle, posture, Twist::ZERO, 0.0, rate, &SVector::zeros()).dot(&missing)
        };
        let kicks = (0..self.links).filter_map(|i| {
            let mut rate = SVector::zeros();
            rate[i] = 1.0;
            rate -= led * led[i];
            Some(rate.try_normalize(1e-3)? * KICK)
        });
        let best = kicks.max_by(|a, b| towards(a).total_cmp(&towards(b)))?;
        (towards(&best) > 0.0).then_some(best)
    }
}
