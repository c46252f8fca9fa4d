//! Forward kinematics of the arm in the UAV frame.
//!
//! Link i points along (sin, -cos) of its absolute angle, roll + q_1 + ... + q_i; here everything is
//! expressed in the UAV frame, where it depends on the joint angles only. A posture follows another by turning
//! its directions by small angles, which takes no sines.

use nalgebra::SVector;

use crate::mechanics::planar::{Rotation, Vec2, vec2};
use crate::mechanics::vehicle::{Balancer, Vehicle};
use crate::memory;

/// Where everything is, in the UAV frame \[m\].
#[derive(Debug, Clone, Copy)]
pub struct Posture<const N: usize> {
    /// Directions of the links and of a balance element.
    pub direction: [Vec2; N],
    /// Joints of the links.
    pub joint: [Vec2; N],
    /// End of the last link.
    pub end_effector: Vec2,
    /// The payload, if it is held.
    pub payload: Vec2,
    /// Centre of mass of the counterweight.
    pub counterweight: Vec2,
}

memory!(Posture<N> { direction, joint, end_effector, payload, counterweight });

/// A displacement of the coordinates, as postures take it: by how much each link turns.
#[derive(Debug, Clone, Copy)]
pub struct Displacement<const N: usize> {
    /// Turns of the links and of a balance element.
    rotation: [Rotation; N],
    /// Way of the counterweight \[m\].
    slide: f64,
}

impl<const N: usize> Displacement<N> {
    /// By `dq` \[rad, m\], usually small.
    #[inline]
    #[must_use]
    pub fn small(vehicle: &Vehicle<N>, dq: &SVector<f64, N>) -> Self {
        Self::by(vehicle, dq, Rotation::from_small_angle)
    }

    /// By `dq` \[rad, m\] so small that its square is nothing.
    #[inline]
    #[must_use]
    pub fn tiny(vehicle: &Vehicle<N>, dq: &SVector<f64, N>) -> Self {
        Self::by(vehicle, dq, Rotation::by_tiny)
    }

    #[inline]
    fn by(vehicle: &Vehicle<N>, dq: &SVector<f64, N>, turn_by: impl Fn(f64) -> Rotation) -> Self {
        let mut angle = 0.0;
        let mut rotation = [Rotation::NONE; N];
        for i in 0..N {
            angle += dq[i] * vehicle.revolute[i];
            rotation[i] = turn_by(angle);
        }
        let mut slide = 0.0;
        match vehicle.balancer {
            None => {}
            Some(Balancer::Counterweight(_)) => slide = dq[N - 1],
            Some(Balancer::Element(_)) => rotation[N - 1] = turn_by(dq[N - 1]),
        }
        Self { rotation, slide }
    }
}

impl<const N: usize> Posture<N> {
    /// Everything in one place.
    pub(crate) const NOWHERE: Self = {
        let place = vec2(0.0, 0.0);
        Self { direction: [place; N], joint: [place; N], end_effector: place, payload: place, counterweight: place }
    };

    /// The posture with the coordinates `q` \[rad, m\].
    #[must_use]
    pub fn new(vehicle: &Vehicle<N>, q: &SVector<f64, N>) -> Self {
        let mut posture = Self::NOWHERE;
        posture.take(vehicle, q);
        posture
    }

    /// Becomes the posture with the coordinates `q` \[rad, m\].
    #[inline]
    pub fn take(&mut self, vehicle: &Vehicle<N>, q: &SVector<f64, N>) {
        let way = Displacement::by(vehicle, q, Rotation::by);
        for (direction, rotation) in self.direction.iter_mut().zip(way.rotation) {
            *direction = rotation.down();
        }
        self.counterweight = match vehicle.balancer {
            Some(Balancer::Counterweight(slider)) => vec2(way.slide, slider.height),
            Some(Balancer::Element(_)) | None => Vec2::zeros(),
        };
        self.join(vehicle);
    }

    /// Becomes the posture that is `way` from the posture `from`.
    #[inline]
    pub fn follow(&mut self, vehicle: &Vehicle<N>, from: &Self, way: &Displacement<N>) {
        for i in 0..N {
            self.direction[i] = way.rotation[i].apply(from.direction[i]);
        }
        self.counterweight = vec2(from.counterweight.x + way.slide, from.counterweight.y);
        self.join(vehicle);
    }

    /// Joins the links, each at the end of the one before.
    #[inline(always)]
    fn join(&mut self, vehicle: &Vehicle<N>) {
        let mut tip = vehicle.mount;
        for i in 0..N {
            self.joint[i] = tip;
            tip += self.direction[i] * vehicle.length[i];
        }
        self.end_effector = tip;
        let last = vehicle.links - 1;
        self.payload = self.joint[last] + self.direction[last] * vehicle.payload_com;
    }
}
