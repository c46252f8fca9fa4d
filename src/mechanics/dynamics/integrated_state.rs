//! What Runge-Kutta integrates beside the driven joints: the base, the autopilot's integrals, and two impulses.

use std::ops::{Add, Mul};

use nalgebra::Vector3;

use super::{Situation, State};
use crate::mechanics::planar::{Rotation, Vec2};
use crate::parameters::BaseModel;

/// The integrated state, or its rate: then every field is the derivative of the quantity that it names.
///
/// The cosine and sine of the roll are integrated with the rest and corrected after every step
/// ([`IntegratedState::align_rotation`]): stages that need no sines take a third less time.
///
/// On an ideal carriage vertical and angular momentum are no states, for they follow from the rates. There these two
/// fields collect the impulses of all but the carriage, so that momentum less these is what the carriage gave.
#[derive(Debug, Clone, Copy)]
pub(super) struct IntegratedState {
    /// Pose of the UAV: x, y \[m\], roll \[rad\].
    pub pose: Vector3<f64>,
    /// Momentum of the whole system, and angular momentum about the UAV's centre of mass \[N s, N s, N m s\].
    pub momentum: Vector3<f64>,
    /// Integrals of altitude error \[m s\] and roll error \[rad s\].
    pub integrals: Vec2,
    /// Cosine and sine of the roll.
    pub rotation: Vec2,
    /// Impulse of the rotors' torque \[N m s\].
    pub torque_impulse: f64,
    /// Impulse of the support force \[N s\].
    pub support_impulse: f64,
}

impl IntegratedState {
    /// All zero.
    pub const ZERO: Self = Self {
        pose: Vector3::new(0.0, 0.0, 0.0),
        momentum: Vector3::new(0.0, 0.0, 0.0),
        integrals: Vec2::new(0.0, 0.0),
        rotation: Vec2::new(0.0, 0.0),
        torque_impulse: 0.0,
        support_impulse: 0.0,
    };

    /// The rotation of the UAV.
    #[inline]
    pub fn uav_rotation(&self) -> Rotation {
        Rotation::with(self.rotation.x, self.rotation.y)
    }

    /// Sets the rotation of the UAV.
    #[inline]
    pub fn set_rotation(&mut self, rotation: Rotation) {
        self.rotation = rotation.cos_sin().into();
    }

    /// Makes the rotation agree with the roll, given that it did in the state `previous`, a small angle away.
    #[inline]
    pub fn align_rotation(&mut self, previous: &Self) {
        self.set_rotation(previous.uav_rotation().then(Rotation::from_small_angle(self.pose.z - previous.pose.z)));
    }

    /// The state after the time `t` \[s\] at the rate `k`, for a stage: x and the impulses stay 0, because no rate depends
    /// on them.
    #[inline]
    pub fn stage(&self, k: &Self, t: f64) -> Self {
        Self {
            pose: Vector3::new(0.0, self.pose.y + k.pose.y * t, self.pose.z + k.pose.z * t),
            momentum: self.momentum + k.momentum * t,
            integrals: self.integrals + k.integrals * t,
            rotation: self.rotation + k.rotation * t,
            torque_impulse: 0.0,
            support_impulse: 0.0,
        }
    }

    /// The largest difference of any quantity.
    #[cfg(test)]
    pub fn distance(&self, other: &Self) -> f64 {
        let difference = *self + *other * -1.0;
        [
            difference.pose.amax(),
            difference.momentum.amax(),
            difference.integrals.amax(),
            difference.rotation.amax(),
            difference.torque_impulse.abs(),
            difference.support_impulse.abs(),
        ]
        .into_iter()
        .fold(0.0, f64::max)
    }
}

impl Add for IntegratedState {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self {
            pose: self.pose + other.pose,
            momentum: self.momentum + other.momentum,
            integrals: self.integrals + other.integrals,
            rotation: self.rotation + other.rotation,
            torque_impulse: self.torque_impulse + other.torque_impulse,
            support_impulse: self.support_impulse + other.support_impulse,
        }
    }
}

impl Mul<f64> for IntegratedState {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self {
            pose: self.pose * factor,
            momentum: self.momentum * factor,
            integrals: self.integrals * factor,
            rotation: self.rotation * factor,
            torque_impulse: self.torque_impulse * factor,
            support_impulse: self.support_impulse * factor,
        }
    }
}

impl<const N: usize> Situation<N> {
    /// The part of the state that the laws of motion integrate; the impulses begin at 0.
    pub(super) fn integrated_state(&self, base: BaseModel) -> IntegratedState {
        let State { pose, momentum, integrals, .. } = self.state;
        let rotation = if base.turns_arm() { self.rotation } else { Rotation::by(pose.z) };
        let rotation = rotation.cos_sin().into();
        IntegratedState { pose, momentum, integrals, rotation, torque_impulse: 0.0, support_impulse: 0.0 }
    }
}
