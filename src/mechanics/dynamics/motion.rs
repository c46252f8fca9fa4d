//! Rates that are imposed on the coordinates.

use std::ops::Sub;

use nalgebra::SVector;

use crate::memory;

/// The rates imposed during one step: `rate + slope * (time since the beginning of the step)`.
#[derive(Debug, Clone, Copy)]
pub struct Motion<const N: usize> {
    /// Rates at the beginning \[rad/s, m/s\].
    pub rate: SVector<f64, N>,
    /// Their slopes \[rad/s2, m/s2\].
    pub slope: SVector<f64, N>,
}

memory!(Motion<N> { rate, slope });

impl<const N: usize> Motion<N> {
    /// Constant rates.
    #[must_use]
    pub fn constant(rate: SVector<f64, N>) -> Self {
        Self { rate, slope: SVector::zeros() }
    }

    /// Whether the rates are constant.
    #[must_use]
    pub fn is_steady(&self) -> bool {
        self.slope.iter().all(|slope| *slope == 0.0)
    }

    /// Rates after the time `t` \[s\].
    #[must_use]
    pub fn rate_after(&self, t: f64) -> SVector<f64, N> {
        self.rate + self.slope * t
    }

    /// Way covered in the time `t` \[s\].
    #[must_use]
    pub fn way(&self, t: f64) -> SVector<f64, N> {
        (self.rate + self.slope * (0.5 * t)) * t
    }

    /// The motion that remains after the time `t` \[s\].
    #[must_use]
    pub fn after(&self, t: f64) -> Self {
        Self { rate: self.rate_after(t), slope: self.slope }
    }
}

impl<const N: usize> Sub for Motion<N> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { rate: self.rate - other.rate, slope: self.slope - other.slope }
    }
}
