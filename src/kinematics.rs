//! Forward kinematics of the arm in the UAV frame.
//!
//! Link i points along (sin, -cos) of its absolute angle, roll + q_1 + ... + q_i; here everything is
//! expressed in the UAV frame, where it depends on the joint angles only. A posture follows another by turning
//! its directions by small angles, which takes no sines.

use nalgebra::SVector;

use crate::memory;
use crate::planar::{Turn, Vec2, vec2};
use crate::vehicle::{Balancer, Vehicle};

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

impl<const N: usize> Posture<N> {
    /// The posture with the coordinates `q` \[rad, m\].
    #[must_use]
    pub fn new(vehicle: &Vehicle<N>, q: &SVector<f64, N>) -> Self {
        let hanging = Self {
            direction: [Turn::NONE.down(); N],
            joint: [vehicle.mount; N],
            end_effector: vehicle.mount,
            payload: vehicle.mount,
            counterweight: match vehicle.balancer {
                Some(Balancer::Counterweight(slider)) => vec2(0.0, slider.height),
                Some(Balancer::Element(_)) | None => Vec2::zeros(),
            },
        };
        let mut posture = hanging;
        posture.follow_by(vehicle, &hanging, q, Turn::by);
        posture
    }

    /// Becomes the posture after a small displacement `dq` \[rad, m\] from the posture `from`.
    #[inline]
    pub fn follow(&mut self, vehicle: &Vehicle<N>, from: &Self, dq: &SVector<f64, N>) {
        self.follow_by(vehicle, from, dq, Turn::by_small);
    }

    #[inline]
    fn follow_by(&mut self, vehicle: &Vehicle<N>, from: &Self, dq: &SVector<f64, N>, turn_by: impl Fn(f64) -> Turn) {
        let mut angle = 0.0;
        let mut tip = vehicle.mount;
        for i in 0..N {
            angle += dq[i] * vehicle.revolute[i];
            self.direction[i] = turn_by(angle).apply(from.direction[i]);
            self.joint[i] = tip;
            tip += self.direction[i] * vehicle.length[i];
        }
        self.end_effector = tip;
        let last = vehicle.links - 1;
        self.payload = self.joint[last] + self.direction[last] * vehicle.payload_com;
        self.counterweight = from.counterweight;
        match vehicle.balancer {
            None => {}
            Some(Balancer::Counterweight(_)) => self.counterweight.x += dq[N - 1],
            Some(Balancer::Element(_)) => self.direction[N - 1] = turn_by(dq[N - 1]).apply(from.direction[N - 1]),
        }
    }
}
