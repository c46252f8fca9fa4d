//! What keeps the masses on their way: accelerations of the links, and the loads that they take.

use nalgebra::SVector;

use super::{Twist, sums_outboard};
use crate::mechanics::kinematics::Posture;
use crate::mechanics::planar::{Vec2, cross, perp, vec2};
use crate::mechanics::vehicle::{Balancer, Vehicle};

/// How a link accelerates.
#[derive(Clone, Copy)]
struct Acceleration {
    /// Its joint \[m/s2\].
    joint: Vec2,
    /// More per distance from the joint \[1/s2\].
    spread: Vec2,
    /// Its angular velocity \[rad/s2\].
    angular: f64,
}

/// The acceleration of each link and of the end effector \[m/s2\], in the axes of the UAV frame, while the base
/// accelerates by `base` and turns by `roll_rate`, and the coordinates move at `rate` and accelerate by `slope`.
fn link_accelerations<const N: usize>(
    vehicle: &Vehicle<N>,
    posture: &Posture<N>,
    base: Twist,
    roll_rate: f64,
    rate: &SVector<f64, N>,
    slope: &SVector<f64, N>,
) -> ([Acceleration; N], Vec2) {
    let mut links = [Acceleration { joint: Vec2::zeros(), spread: Vec2::zeros(), angular: 0.0 }; N];
    let (mut omega, mut angular) = (roll_rate, base.angular);
    let mut joint = base.linear + perp(vehicle.mount) * angular - vehicle.mount * (omega * omega);
    for i in 0..N {
        omega += rate[i] * vehicle.revolute[i];
        angular += slope[i] * vehicle.revolute[i];
        let direction = posture.direction[i];
        let spread = perp(direction) * angular - direction * (omega * omega);
        links[i] = Acceleration { joint, spread, angular };
        joint += spread * vehicle.length[i];
    }
    (links, joint)
}

/// For each link, force and moment about its joint that keep it on its way while the base does not accelerate.
fn link_loads<const N: usize>(
    vehicle: &Vehicle<N>,
    posture: &Posture<N>,
    held: bool,
    roll_rate: f64,
    rate: &SVector<f64, N>,
    slope: &SVector<f64, N>,
) -> [Twist; N] {
    let bodies = &vehicle.masses(held).links;
    let (links, _) = link_accelerations(vehicle, posture, Twist::ZERO, roll_rate, rate, slope);
    std::array::from_fn(|i| {
        let (body, Acceleration { joint, spread, angular }) = (&bodies[i], links[i]);
        Twist {
            linear: joint * body.mass + spread * body.first,
            angular: cross(posture.direction[i], joint) * body.first + angular * body.second,
        }
    })
}

/// Force and moment about the UAV's centre of mass that keep the masses on their way while the base does
/// not accelerate: from angular velocities and from the accelerations `slope` of the coordinates.
/// Axes of the UAV frame.
#[must_use]
pub fn inertial_load<const N: usize>(
    vehicle: &Vehicle<N>,
    posture: &Posture<N>,
    held: bool,
    roll_rate: f64,
    rate: &SVector<f64, N>,
    slope: &SVector<f64, N>,
) -> Twist {
    let own = link_loads(vehicle, posture, held, roll_rate, rate, slope);
    let mut load = own.iter().zip(&posture.joint).fold(Twist::ZERO, |load, (own, joint)| {
        load + Twist { linear: own.linear, angular: own.angular + cross(*joint, own.linear) }
    });
    match vehicle.balancer {
        None => {}
        Some(Balancer::Counterweight(slider)) => {
            let place = posture.counterweight;
            let coriolis = vec2(0.0, 2.0 * roll_rate * rate[N - 1]);
            let force = (vec2(slope[N - 1], 0.0) + coriolis - place * (roll_rate * roll_rate)) * slider.mass;
            load.linear += force;
            load.angular += cross(place, force);
        }
        Some(Balancer::Element(body)) => {
            let (direction, omega) = (posture.direction[N - 1], roll_rate + rate[N - 1]);
            load.linear += (perp(direction) * slope[N - 1] - direction * (omega * omega)) * body.first;
            load.angular += slope[N - 1] * body.second;
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
    slope: &SVector<f64, N>,
) -> SVector<f64, N> {
    sums_outboard(vehicle, posture, &link_loads(vehicle, posture, held, roll_rate, rate, slope))
}

/// Acceleration of the end effector while the base accelerates by `base` and the coordinates by
/// `slope`; axes of the UAV frame.
#[must_use]
pub fn tip_acceleration<const N: usize>(
    vehicle: &Vehicle<N>,
    posture: &Posture<N>,
    base: Twist,
    roll_rate: f64,
    rate: &SVector<f64, N>,
    slope: &SVector<f64, N>,
) -> Vec2 {
    link_accelerations(vehicle, posture, base, roll_rate, rate, slope).1
}
