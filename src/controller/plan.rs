//! What is planned for one interval.

use super::Status;
use super::resolution::Resolved;
use crate::dynamics::{Motion, check_finite};
use crate::error::Result;
use crate::qp::{self, Places};

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
    /// Mean moment on the UAV that is left \[N m\].
    pub moment_residual: f64,
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
        }
    }

    /// The `resolved` rates, reached by this motion.
    pub fn of(resolved: &Resolved<N>, motion: Motion<N>) -> Self {
        let &Resolved { status, places, min_singular_value, .. } = resolved;
        Self { status, places, min_singular_value, ..Self::moving(motion) }
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
