//! What acts from outside, besides gravity and support.

use crate::mechanics::planar::{Vec2, vec2};
use crate::memory;

/// What acts from outside at one instant.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Load {
    /// Force on the UAV at its centre of mass \[N\].
    pub base_force: Vec2,
    /// Torque on the UAV \[N m\].
    pub base_torque: f64,
    /// Force on the end effector \[N\].
    pub tip_force: Vec2,
    /// Torque on the last link \[N m\].
    pub tip_torque: f64,
    /// Wanted altitude \[m\].
    pub altitude: f64,
    /// Wanted roll \[rad\].
    pub roll: f64,
    /// Added to the thrust of the pid autopilot \[N\].
    pub thrust_feedforward: f64,
    /// Thrust of an external autopilot \[N\].
    pub thrust: f64,
    /// Torque of an external autopilot \[N m\].
    pub torque: f64,
}

memory!(Load { base_force, base_torque, tip_force, tip_torque, altitude, roll, thrust_feedforward, thrust, torque });

/// What acts from outside during one step: it changes linearly, or not at all.
#[derive(Debug, Clone, Copy)]
pub struct Loads<'s> {
    /// At the beginning.
    pub begin: &'s Load,
    /// Change per second, if there is any.
    pub slope: Option<&'s Load>,
}

impl<'s> Loads<'s> {
    /// Nothing acts from outside.
    pub const CALM: Self = Self { begin: &Load::NONE, slope: None };

    /// What acts after the time `t` \[s\]; written to `room` if it is not what acts at the beginning.
    #[inline]
    #[must_use]
    pub fn present<'a>(&self, t: f64, room: &'a mut Option<Load>) -> &'a Load
    where
        's: 'a,
    {
        match self.slope {
            None => self.begin,
            Some(slope) => room.insert(self.begin.moved(slope, t)),
        }
    }

    /// What acts at the beginning, in the middle and at the end of an interval, by beginning and size.
    #[inline]
    #[must_use]
    pub fn at<'a>(&self, [from, size]: [f64; 2], room: &'a mut Option<[Load; 3]>) -> [&'a Load; 3]
    where
        's: 'a,
    {
        match self.slope {
            None => [self.begin; 3],
            Some(slope) => self.begin.three(slope, [from, from + 0.5 * size, from + size], room),
        }
    }
}

impl Load {
    /// Nothing.
    pub const NONE: Self = Self {
        base_force: vec2(0.0, 0.0),
        base_torque: 0.0,
        tip_force: vec2(0.0, 0.0),
        tip_torque: 0.0,
        altitude: 0.0,
        roll: 0.0,
        thrust_feedforward: 0.0,
        thrust: 0.0,
        torque: 0.0,
    };

    /// Whether there is any force or torque on the end effector.
    #[inline]
    pub(super) fn pushes_arm(&self) -> bool {
        // By bits, in half of the instructions: that -0 counts does no harm.
        self.tip_force.x.to_bits() | self.tip_force.y.to_bits() | self.tip_torque.to_bits() != 0
    }

    /// Errors of altitude \[m\] and roll \[rad\].
    #[inline]
    pub(super) fn error(&self, altitude: f64, roll: f64) -> Vec2 {
        vec2(altitude - self.altitude, roll - self.roll)
    }

    /// What acts after the time `t` \[s\] at this `slope`.
    #[cold]
    #[inline(never)]
    fn moved(&self, slope: &Self, t: f64) -> Self {
        Self {
            base_force: self.base_force + slope.base_force * t,
            base_torque: self.base_torque + slope.base_torque * t,
            tip_force: self.tip_force + slope.tip_force * t,
            tip_torque: self.tip_torque + slope.tip_torque * t,
            altitude: self.altitude + slope.altitude * t,
            roll: self.roll + slope.roll * t,
            thrust_feedforward: self.thrust_feedforward + slope.thrust_feedforward * t,
            thrust: self.thrust + slope.thrust * t,
            torque: self.torque + slope.torque * t,
        }
    }

    #[cold]
    #[inline(never)]
    fn three<'a>(&self, slope: &Self, times: [f64; 3], room: &'a mut Option<[Self; 3]>) -> [&'a Self; 3] {
        room.insert(times.map(|t| self.moved(slope, t))).each_ref()
    }
}
