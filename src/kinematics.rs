//! Forward kinematics of the arm in the UAV frame.
//!
//! Link i points along (sin, -cos) of its absolute angle, roll + q_1 + ... + q_i; here everything is
//! expressed in the UAV frame, where it depends on the joint angles only.

use nalgebra::SVector;

use crate::memory;
use crate::planar::{Turn, Vec2, vec2};
use crate::vehicle::{Balancer, Vehicle};

/// A configuration of the arm in trigonometric form: cheap to advance by small angles.
#[derive(Debug, Clone, Copy)]
pub struct Configuration<const N: usize> {
    /// Turn of each link, and of a balance element, relative to the UAV.
    turn: [Turn; N],
    /// Position of the counterweight along the UAV's x axis \[m\].
    slide: f64,
}

memory!(Configuration<N> { turn, slide });

impl<const N: usize> Configuration<N> {
    /// The configuration with coordinates `q` \[rad, m\].
    #[must_use]
    pub fn new(vehicle: &Vehicle<N>, q: &SVector<f64, N>) -> Self {
        Self { turn: [Turn::NONE; N], slide: 0.0 }.moved(vehicle, q, Turn::by)
    }

    /// The configuration after a small displacement `dq` \[rad, m\].
    #[must_use]
    pub fn displaced(&self, vehicle: &Vehicle<N>, dq: &SVector<f64, N>) -> Self {
        self.moved(vehicle, dq, Turn::by_small)
    }

    fn moved(&self, vehicle: &Vehicle<N>, dq: &SVector<f64, N>, turn_by: impl Fn(f64) -> Turn) -> Self {
        let mut moved = *self;
        let mut angle = 0.0;
        for i in 0..N {
            angle += dq[i] * vehicle.revolute[i];
            moved.turn[i] = self.turn[i].then(turn_by(angle));
        }
        match vehicle.balancer {
            None => {}
            Some(Balancer::Counterweight(_)) => moved.slide += dq[N - 1],
            Some(Balancer::Element(_)) => moved.turn[N - 1] = self.turn[N - 1].then(turn_by(dq[N - 1])),
        }
        moved
    }
}

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
    /// The posture in a configuration.
    #[must_use]
    pub fn new(vehicle: &Vehicle<N>, configuration: &Configuration<N>) -> Self {
        let mut posture = Self {
            direction: [Vec2::zeros(); N],
            joint: [Vec2::zeros(); N],
            end_effector: vehicle.mount,
            payload: vehicle.mount,
            counterweight: match vehicle.balancer {
                Some(Balancer::Counterweight(slider)) => vec2(configuration.slide, slider.height),
                Some(Balancer::Element(_)) | None => Vec2::zeros(),
            },
        };
        for i in 0..N {
            posture.direction[i] = configuration.turn[i].down();
            posture.joint[i] = posture.end_effector;
            posture.end_effector += posture.direction[i] * vehicle.length[i];
        }
        let last = vehicle.links - 1;
        posture.payload = posture.joint[last] + posture.direction[last] * vehicle.payload_com;
        posture
    }
}
