//! What is planned for one interval.

use super::Status;
use super::resolution::Resolved;
use crate::control::qp::{self, Places};
use crate::error::Result;
use crate::mechanics::dynamics::{Motion, check_finite};

/// End effector this close to the reference at the end of an interval follows the path \[m\].
pub(super) const ON_PATH: f64 = 1e-6;

/// Rates for one interval.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plan<const N: usize> {
    /// The motion of the coordinates.
    pub motion: Motion<N>,
    /// What had to give way.
    pub status: Status,
    /// Which rates are at their limits.
    pub places: Places,
    /// Smallest singular value of the end effector's generalized Jacobian \[m\].
    pub min_singular_value: f64,
    /// By how much the velocity of the end effector misses the wanted one \[m/s\].
    pub velocity_residual: f64,
    /// Mean moment on the UAV \[N m\].
    pub moment_residual: f64,
    /// Angular momentum that the rates at the end give to what the UAV carries \[N m s\].
    pub momentum: f64,
}

impl<const N: usize> Plan<N> {
    /// A plan to be made, so far of this motion.
    pub fn moving(motion: Motion<N>) -> Self {
        Self {
            motion,
            status: Status::Ok,
            places: qp::FREE,
            min_singular_value: 0.0,
            velocity_residual: 0.0,
            moment_residual: 0.0,
            momentum: 0.0,
        }
    }

    /// The `resolved` rates, reached by this motion.
    pub fn of(resolved: &Resolved<N>, motion: Motion<N>) -> Self {
        let &Resolved { status, places, min_singular_value, momentum, .. } = resolved;
        Self { status, places, min_singular_value, momentum, ..Self::moving(motion) }
    }

    /// Says that the path is given up if the end of the interval is off the reference by this `miss` \[m\], whatever
    /// else has been said.
    pub fn admit_miss(&mut self, miss: f64) {
        if miss > ON_PATH && self.status.keeps_path() {
            self.status = Status::Inexact;
        }
    }

    /// Whether the moment on the UAV is what was wanted, as far as is known.
    pub fn moment_is_met(&self) -> bool {
        matches!(self.status, Status::Ok | Status::CatchingUp)
    }

    /// Whether all that the host will see of it is finite; residuals are not if rates are not.
    pub fn check(&self, t: f64) -> Result<()> {
        let residuals = [self.velocity_residual, self.moment_residual, self.min_singular_value];
        if residuals.iter().sum::<f64>().is_finite() {
            return Ok(());
        }
        let Motion { rate, slope } = &self.motion;
        let quantities =
            [("planned rate", rate.as_slice()), ("planned acceleration", slope.as_slice()), ("residual", &residuals)];
        check_finite(&quantities, t)
    }
}
