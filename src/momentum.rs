//! Momentum of the whole system and of what lies outboard of each joint, in the UAV frame.
//!
//! h = (p, K) = H_b v_b + H_m q_dot, with p the momentum and K the angular momentum about the UAV's
//! centre of mass, both of absolute velocities (thesis 2.5). In the axes of the UAV frame, H_b and H_m
//! depend on the coordinates q only. The sums run from the tip inwards, each mass is added once.
//! What balances the arm hangs on the UAV itself.

use std::ops::{Add, Mul, Sub};

use nalgebra::SVector;

use crate::kinematics::Posture;
use crate::memory;
use crate::planar::{Vec2, cross, perp, vec2};
use crate::vehicle::{Balancer, Body, Vehicle};

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
    /// First moment of what lies outboard of each joint, a balance element's included, about it \[kg m\].
    pub outboard_first: [Vec2; N],
    /// Centre of mass of the whole system \[m\].
    pub center: Vec2,
    /// Inverse mass of the whole system \[1/kg\].
    lightness: f64,
    /// Moment of inertia of the whole system about its centre of mass, inverse \[1/(kg m2)\].
    compliance: f64,
    /// Moment of inertia of the whole system about the UAV's centre of mass \[kg m2\].
    inertia: f64,
}

memory!(MomentumMatrix<N> { mass, first, columns, outboard_first, center, lightness, compliance, inertia });

impl<const N: usize> MomentumMatrix<N> {
    /// Sums up all masses, from the tip to the UAV.
    #[must_use]
    pub fn new(vehicle: &Vehicle<N>, posture: &Posture<N>, held: bool) -> Self {
        let bodies = vehicle.bodies(held);
        let mut columns = [Twist::ZERO; N];
        let mut outboard_first = [Vec2::zeros(); N];
        // Composite of all links from i outwards, about joint i.
        let (mut mass, mut first, mut inertia) = (0.0, Vec2::zeros(), 0.0);
        for i in (0..N).rev() {
            let (body, direction, length) = (&bodies[i], posture.direction[i], vehicle.length[i]);
            inertia += body.second + length * (2.0 * direction.dot(&first) + mass * length);
            first += direction * (body.first + mass * length);
            mass += body.mass;
            outboard_first[i] = first;
            columns[i] = Twist { linear: perp(first), angular: posture.joint[i].dot(&first) + inertia };
        }
        inertia += vehicle.uav_inertia + vehicle.mount.dot(&(2.0 * first + mass * vehicle.mount));
        first += vehicle.mount * mass;
        mass += vehicle.uav_mass;
        match vehicle.balancer {
            None => {}
            Some(Balancer::Counterweight(slider)) => {
                let place = posture.counterweight;
                inertia += slider.inertia + slider.mass * place.norm_squared();
                first += place * slider.mass;
                mass += slider.mass;
                columns[N - 1] = Twist { linear: vec2(slider.mass, 0.0), angular: -slider.mass * place.y };
            }
            Some(Balancer::Element(body)) => {
                let own = posture.direction[N - 1] * body.first;
                inertia += body.second;
                first += own;
                mass += body.mass;
                outboard_first[N - 1] = own;
                columns[N - 1] = Twist { linear: perp(own), angular: body.second };
            }
        }
        let lightness = 1.0 / mass;
        let center = first * lightness;
        let compliance = 1.0 / (inertia - first.dot(&center));
        Self { mass, first, columns, outboard_first, center, lightness, compliance, inertia }
    }

    /// H_m q_dot: momentum from the rates alone.
    #[must_use]
    pub fn of_rates(&self, rate: &SVector<f64, N>) -> Twist {
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
        let angular = (h.angular - cross(self.center, h.linear)) * self.compliance;
        Twist { linear: h.linear * self.lightness - perp(self.center) * angular, angular }
    }
}

/// What a coordinate moves: all that lies outboard of a joint, or what balances the arm.
#[derive(Debug, Clone, Copy)]
pub struct Outboard {
    /// Its angular momentum about the joint \[N m s\], or momentum along the slide \[N s\].
    pub momentum: f64,
    /// How fast that changes, without any load, because joint or slide move \[N m, N\].
    pub drift: f64,
}

/// What each coordinate moves, with the base in motion `v` and the rates `rate`; absolute velocities.
#[must_use]
pub fn outboard<const N: usize>(
    vehicle: &Vehicle<N>,
    posture: &Posture<N>,
    held: bool,
    v: Twist,
    rate: &SVector<f64, N>,
) -> [Outboard; N] {
    let bodies = vehicle.bodies(held);
    let mut joint_velocity = [Vec2::zeros(); N];
    let mut own = [Twist::ZERO; N];
    let mut omega = v.angular;
    let mut velocity = v.linear + perp(vehicle.mount) * v.angular;
    for i in 0..N {
        omega += rate[i] * vehicle.revolute[i];
        joint_velocity[i] = velocity;
        own[i] = turning(&bodies[i], posture.direction[i], velocity, omega);
        velocity += perp(posture.direction[i]) * (omega * vehicle.length[i]);
    }
    let mut outboard = [Outboard { momentum: 0.0, drift: 0.0 }; N];
    let mut outer = Twist::ZERO;
    for i in (0..N).rev() {
        let lever = posture.direction[i] * vehicle.length[i];
        outer.angular += own[i].angular + cross(lever, outer.linear);
        outer.linear += own[i].linear;
        outboard[i] = Outboard { momentum: outer.angular, drift: -cross(joint_velocity[i], outer.linear) };
    }
    match vehicle.balancer {
        None => {}
        Some(Balancer::Counterweight(slider)) => {
            let velocity = v.linear + perp(posture.counterweight) * v.angular + vec2(rate[N - 1], 0.0);
            outboard[N - 1] =
                Outboard { momentum: slider.mass * velocity.x, drift: slider.mass * v.angular * velocity.y };
        }
        Some(Balancer::Element(body)) => {
            let own = turning(&body, posture.direction[N - 1], v.linear, v.angular + rate[N - 1]);
            outboard[N - 1] = Outboard { momentum: own.angular, drift: -cross(v.linear, own.linear) };
        }
    }
    outboard
}

/// Momentum, and angular momentum about its joint, of a body that turns by `omega` while its joint moves.
fn turning(body: &Body, direction: Vec2, joint_velocity: Vec2, omega: f64) -> Twist {
    Twist {
        linear: joint_velocity * body.mass + perp(direction) * (omega * body.first),
        angular: cross(direction, joint_velocity) * body.first + omega * body.second,
    }
}

/// Force and moment about the UAV's centre of mass that keep the masses on their way while the base does
/// not accelerate: from angular velocities and from the accelerations `rate_slope` of the coordinates.
/// Axes of the UAV frame.
#[must_use]
pub fn inertial_load<const N: usize>(
    vehicle: &Vehicle<N>,
    posture: &Posture<N>,
    held: bool,
    roll_rate: f64,
    rate: &SVector<f64, N>,
    rate_slope: &SVector<f64, N>,
) -> Twist {
    let bodies = vehicle.bodies(held);
    let mut load = Twist::ZERO;
    let (mut omega, mut alpha) = (roll_rate, 0.0);
    let mut acceleration = vehicle.mount * (-roll_rate * roll_rate);
    for i in 0..N {
        omega += rate[i] * vehicle.revolute[i];
        alpha += rate_slope[i] * vehicle.revolute[i];
        let (body, direction) = (&bodies[i], posture.direction[i]);
        // Acceleration of the link per distance from its joint.
        let spread = perp(direction) * alpha - direction * (omega * omega);
        let force = acceleration * body.mass + spread * body.first;
        load.linear += force;
        load.angular +=
            cross(posture.joint[i], force) + cross(direction, acceleration) * body.first + alpha * body.second;
        acceleration += spread * vehicle.length[i];
    }
    match vehicle.balancer {
        None => {}
        Some(Balancer::Counterweight(slider)) => {
            let place = posture.counterweight;
            let coriolis = vec2(0.0, 2.0 * roll_rate * rate[N - 1]);
            let force = (vec2(rate_slope[N - 1], 0.0) + coriolis - place * (roll_rate * roll_rate)) * slider.mass;
            load.linear += force;
            load.angular += cross(place, force);
        }
        Some(Balancer::Element(body)) => {
            let (direction, omega) = (posture.direction[N - 1], roll_rate + rate[N - 1]);
            load.linear += (perp(direction) * rate_slope[N - 1] - direction * (omega * omega)) * body.first;
            load.angular += rate_slope[N - 1] * body.second;
        }
    }
    load
}

/// The moments about the joints that keep what lies outboard of each on its way, likewise; none for what
/// balances the arm.
#[must_use]
pub fn inertial_moments<const N: usize>(
    vehicle: &Vehicle<N>,
    posture: &Posture<N>,
    held: bool,
    roll_rate: f64,
    rate: &SVector<f64, N>,
    rate_slope: &SVector<f64, N>,
) -> SVector<f64, N> {
    let bodies = vehicle.bodies(held);
    let mut own = [Twist::ZERO; N];
    let (mut omega, mut alpha) = (roll_rate, 0.0);
    let mut acceleration = vehicle.mount * (-roll_rate * roll_rate);
    for i in 0..vehicle.links {
        omega += rate[i];
        alpha += rate_slope[i];
        let (body, direction) = (&bodies[i], posture.direction[i]);
        let spread = perp(direction) * alpha - direction * (omega * omega);
        own[i] = Twist {
            linear: acceleration * body.mass + spread * body.first,
            angular: cross(direction, acceleration) * body.first + alpha * body.second,
        };
        acceleration += spread * vehicle.length[i];
    }
    let mut moments = SVector::zeros();
    let mut outer = Twist::ZERO;
    for i in (0..vehicle.links).rev() {
        let lever = posture.direction[i] * vehicle.length[i];
        outer.angular += own[i].angular + cross(lever, outer.linear);
        outer.linear += own[i].linear;
        moments[i] = outer.angular;
    }
    moments
}

/// Acceleration of the end effector while the base accelerates by `base` and the coordinates by
/// `rate_slope`; axes of the UAV frame.
#[must_use]
pub fn tip_acceleration<const N: usize>(
    vehicle: &Vehicle<N>,
    posture: &Posture<N>,
    base: Twist,
    roll_rate: f64,
    rate: &SVector<f64, N>,
    rate_slope: &SVector<f64, N>,
) -> Vec2 {
    let (mut omega, mut alpha) = (roll_rate, base.angular);
    let mut acceleration = base.linear + perp(vehicle.mount) * alpha - vehicle.mount * (omega * omega);
    for i in 0..vehicle.links {
        omega += rate[i];
        alpha += rate_slope[i];
        let direction = posture.direction[i];
        acceleration += (perp(direction) * alpha - direction * (omega * omega)) * vehicle.length[i];
    }
    acceleration
}
