//! Momentum of the whole system and of what lies outboard of each joint, in the UAV frame.
//!
//! h = (p, K) = H_b v_b + H_m q_dot, with p the momentum and K the angular momentum about the UAV's
//! centre of mass, both of absolute velocities (thesis 2.5). In the axes of the UAV frame, H_b and H_m
//! depend on the coordinates q only. The sums run from the tip inwards, each mass is added once.
//! What balances the arm hangs on the UAV itself.

mod inertial;

use std::ops::{Add, Mul, Sub};

use nalgebra::SVector;

pub use inertial::{inertial_load, inertial_moments, tip_acceleration};

use crate::mechanics::kinematics::Posture;
use crate::mechanics::planar::{Vec2, cross, perp, vec2};
use crate::mechanics::vehicle::{Balancer, Body, Vehicle};
use crate::memory;

/// A planar motion or load of the base: a vector in the plane and a component out of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist {
    /// Velocity \[m/s\], momentum \[N s\] or force \[N\].
    pub linear: Vec2,
    /// Angular velocity \[rad/s\], angular momentum \[N m s\] or moment \[N m\].
    pub angular: f64,
}

memory!(Twist { linear, angular });

impl Twist {
    /// No motion, no load.
    pub const ZERO: Self = Self { linear: vec2(0.0, 0.0), angular: 0.0 };
}

impl Twist {
    /// Sum of the products of its parts with those of `other`.
    #[must_use]
    pub fn dot(self, other: Self) -> f64 {
        self.linear.dot(&other.linear) + self.angular * other.angular
    }
}

impl Add for Twist {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { linear: self.linear + other.linear, angular: self.angular + other.angular }
    }
}

impl Sub for Twist {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { linear: self.linear - other.linear, angular: self.angular - other.angular }
    }
}

impl Mul<f64> for Twist {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { linear: self.linear * factor, angular: self.angular * factor }
    }
}

/// The matrices H_b and H_m at one posture, in the axes of the UAV frame.
#[derive(Debug, Clone, Copy)]
pub struct MomentumMatrix<const N: usize> {
    /// Mass of the whole system \[kg\].
    pub mass: f64,
    /// First moment of the whole system about the UAV's centre of mass \[kg m\].
    pub first: Vec2,
    /// Columns of H_m.
    pub columns: [Twist; N],
    /// Centre of mass of the whole system \[m\].
    pub center: Vec2,
    /// Inverse mass of the whole system \[1/kg\].
    inverse_mass: f64,
    /// Moment of inertia of the whole system about its centre of mass, inverse \[1/(kg m2)\].
    inverse_inertia: f64,
    /// Moment of inertia of the whole system about the UAV's centre of mass \[kg m2\].
    inertia: f64,
}

memory!(MomentumMatrix<N> { mass, first, columns, center, inverse_mass, inverse_inertia, inertia });

impl<const N: usize> MomentumMatrix<N> {
    /// Nothing has been summed up yet.
    pub(crate) const NOTHING: Self = Self {
        mass: 0.0,
        first: vec2(0.0, 0.0),
        columns: [Twist::ZERO; N],
        center: vec2(0.0, 0.0),
        inverse_mass: 0.0,
        inverse_inertia: 0.0,
        inertia: 0.0,
    };

    /// Sums up all masses, from the tip to the UAV.
    #[must_use]
    pub fn new(vehicle: &Vehicle<N>, posture: &Posture<N>, held: bool) -> Self {
        let mut matrix = Self::NOTHING;
        matrix.sum_up(vehicle, posture, held);
        matrix
    }

    /// Becomes the matrices of another posture.
    #[inline]
    pub fn sum_up(&mut self, vehicle: &Vehicle<N>, posture: &Posture<N>, held: bool) {
        let masses = vehicle.masses(held);
        // Of all links from i outwards, about joint i.
        let (mut first, mut inertia) = (Vec2::zeros(), 0.0);
        for i in (0..N).rev() {
            let (body, direction) = (&masses.augmented[i], posture.direction[i]);
            inertia += body.second + 2.0 * vehicle.length[i] * direction.dot(&first);
            first += direction * body.first;
            self.columns[i] = Twist { linear: perp(first), angular: posture.joint[i].dot(&first) + inertia };
        }
        let arm = masses.augmented[0].mass;
        inertia += vehicle.uav_inertia + vehicle.mount.dot(&(2.0 * first + arm * vehicle.mount));
        first += vehicle.mount * arm;
        match vehicle.balancer {
            None => {}
            Some(Balancer::Counterweight(slider)) => {
                let place = posture.counterweight;
                inertia += slider.inertia + slider.mass * place.norm_squared();
                first += place * slider.mass;
                self.columns[N - 1] = Twist { linear: vec2(slider.mass, 0.0), angular: -slider.mass * place.y };
            }
            Some(Balancer::Element(body)) => {
                let own = posture.direction[N - 1] * body.first;
                inertia += body.second;
                first += own;
                self.columns[N - 1] = Twist { linear: perp(own), angular: body.second };
            }
        }
        self.mass = masses.whole;
        self.first = first;
        self.inverse_mass = masses.inverse_mass;
        self.center = first * self.inverse_mass;
        self.inertia = inertia;
        self.inverse_inertia = 1.0 / (inertia - first.dot(&self.center));
    }

    /// First moment about joint `i` of what lies outboard of it \[kg m\]; of a balance element likewise.
    #[must_use]
    pub fn outboard_first(&self, i: usize) -> Vec2 {
        -perp(self.columns[i].linear)
    }

    /// H_m q_dot: momentum from the rates alone.
    #[must_use]
    pub fn of_rates(&self, rate: &SVector<f64, N>) -> Twist {
        self.sum_of_rates(rate)
    }

    /// The same, for a caller of its own: returned through memory, a twist is copied before it has left the processor's
    /// store buffer, which takes longer than the sums.
    #[inline(always)]
    pub(crate) fn sum_of_rates(&self, rate: &SVector<f64, N>) -> Twist {
        self.columns.iter().zip(rate.iter()).fold(Twist::ZERO, |sum, (column, rate)| sum + *column * *rate)
    }

    /// H_b v_b: momentum from the motion of the base alone.
    #[must_use]
    pub fn of_base(&self, v: Twist) -> Twist {
        Twist {
            linear: v.linear * self.mass + perp(self.first) * v.angular,
            angular: cross(self.first, v.linear) + self.inertia * v.angular,
        }
    }

    /// H_b^-1 h: the motion of the base that has the momentum `h`, or its acceleration under a load.
    #[must_use]
    pub fn base_response(&self, h: Twist) -> Twist {
        let angular = (h.angular - cross(self.center, h.linear)) * self.inverse_inertia;
        Twist { linear: h.linear * self.inverse_mass - perp(self.center) * angular, angular }
    }
}

/// The motion of each link: velocity of its joint \[m/s\] and angular velocity \[rad/s\], in the axes of the UAV frame,
/// with the base in motion `v` and the rates `rate`.
#[inline]
fn link_motions<const N: usize>(
    vehicle: &Vehicle<N>,
    posture: &Posture<N>,
    v: Twist,
    rate: &SVector<f64, N>,
) -> [Twist; N] {
    let mut motions = [Twist::ZERO; N];
    let mut motion = Twist { linear: v.linear + perp(vehicle.mount) * v.angular, angular: v.angular };
    for i in 0..N {
        motion.angular += rate[i] * vehicle.revolute[i];
        motions[i] = motion;
        motion.linear += perp(posture.direction[i]) * (motion.angular * vehicle.length[i]);
    }
    motions
}

/// For each coordinate, the momentum of what it moves: of all that lies outboard of a joint, angular and about the
/// joint \[N m s\]; of a counterweight, along its slide \[N s\]. Absolute velocities, with the base in motion `v`.
#[must_use]
pub fn outboard_momentum<const N: usize>(
    vehicle: &Vehicle<N>,
    posture: &Posture<N>,
    held: bool,
    v: Twist,
    rate: &SVector<f64, N>,
) -> SVector<f64, N> {
    let bodies = &vehicle.masses(held).links;
    let motions = link_motions(vehicle, posture, v, rate);
    let own = std::array::from_fn(|i| body_momentum(&bodies[i], posture.direction[i], motions[i]));
    let mut momentum = sums_outboard(vehicle, posture, &own);
    match vehicle.balancer {
        None => {}
        Some(Balancer::Counterweight(slider)) => {
            momentum[N - 1] = slider.mass * slider_velocity(posture, v, rate[N - 1]).x;
        }
        Some(Balancer::Element(body)) => {
            let motion = Twist { angular: v.angular + rate[N - 1], ..v };
            momentum[N - 1] = body_momentum(&body, posture.direction[N - 1], motion).angular;
        }
    }
    momentum
}

/// For each joint, the moments about it of what acts on the links outboard: `own`, a force and a moment about its own
/// joint for each link. The same for momentum and angular momentum.
#[inline]
fn sums_outboard<const N: usize>(vehicle: &Vehicle<N>, posture: &Posture<N>, own: &[Twist; N]) -> SVector<f64, N> {
    let mut sums = SVector::zeros();
    let mut outer = Twist::ZERO;
    for i in (0..N).rev() {
        let lever = posture.direction[i] * vehicle.length[i];
        outer.angular += own[i].angular + cross(lever, outer.linear);
        outer.linear += own[i].linear;
        sums[i] = outer.angular;
    }
    sums
}

/// How fast those momenta change without any load, because joints and slide move \[N m, N\].
#[inline]
#[must_use]
pub fn outboard_drift<const N: usize>(
    vehicle: &Vehicle<N>,
    posture: &Posture<N>,
    held: bool,
    v: Twist,
    rate: &SVector<f64, N>,
) -> SVector<f64, N> {
    let bodies = &vehicle.masses(held).links;
    let motions = link_motions(vehicle, posture, v, rate);
    let mut drift = SVector::zeros();
    let mut outer = Vec2::zeros();
    for i in (0..N).rev() {
        let Twist { linear: joint_velocity, angular } = motions[i];
        outer += joint_velocity * bodies[i].mass + perp(posture.direction[i]) * (angular * bodies[i].first);
        drift[i] = -cross(joint_velocity, outer);
    }
    match vehicle.balancer {
        None => {}
        Some(Balancer::Counterweight(slider)) => {
            drift[N - 1] = slider.mass * v.angular * slider_velocity(posture, v, rate[N - 1]).y;
        }
        Some(Balancer::Element(body)) => {
            let omega = v.angular + rate[N - 1];
            drift[N - 1] =
                -cross(v.linear, v.linear * body.mass + perp(posture.direction[N - 1]) * (omega * body.first));
        }
    }
    drift
}

/// Velocity of the counterweight; axes of the UAV frame.
fn slider_velocity<const N: usize>(posture: &Posture<N>, v: Twist, rate: f64) -> Vec2 {
    v.linear + perp(posture.counterweight) * v.angular + vec2(rate, 0.0)
}

/// Momentum, and angular momentum about its joint, of a body whose joint has the velocity `motion.linear`.
fn body_momentum(body: &Body, direction: Vec2, motion: Twist) -> Twist {
    Twist {
        linear: motion.linear * body.mass + perp(direction) * (motion.angular * body.first),
        angular: cross(direction, motion.linear) * body.first + motion.angular * body.second,
    }
}
