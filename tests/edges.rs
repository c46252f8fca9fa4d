//! The controller at its edges: out of reach, within limits, from odd starts, with weights, and what it says there.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::coupling::Coupling;
use common::random::Random;
use common::{assert_close, cases};
use proptest::prelude::*;
use uam::control::Status;
use uam::parameters::defaults::default_parameters;
use uam::parameters::{Balance, Discretization, Hold, Resolution};
use uam::reference::{Leg, Profile};
use uam::{Parameters, Structure};

const EVERY: [Resolution; 5] = [
    Resolution::MinimumNorm,
    Resolution::Gradient,
    Resolution::ExtendedJacobian,
    Resolution::LeastSquares,
    Resolution::AccelerationLevel,
];

/// Three links without payload on a smooth way to (`dx`, `dy`) in the time `duration`, and back in as long if `back`.
fn way(resolution: Resolution, [dx, dy]: [f64; 2], duration: f64, back: Option<f64>) -> Parameters {
    let mut p = default_parameters(Structure::DEFAULT);
    p.payload.grasp_time = 1e9;
    p.ik.resolution = resolution;
    if resolution == Resolution::AccelerationLevel {
        p.ik.hold = Hold::FirstOrder;
    }
    let leg = Leg { start: 0.0, duration, ramp: 0.4 * duration, dx, dy, profile: Profile::Smooth };
    p.reference.legs = [leg, Leg::NONE, Leg::NONE, Leg::NONE];
    if let Some(start) = back {
        p.reference.legs[1] = Leg { start, dx: -dx, dy: -dy, ..leg };
    }
    p
}

fn fastest(coupling: &Coupling) -> f64 {
    coupling.commands.rate_command.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()))
}

/// Largest rate from the time `from` to the time `to` \[rad/s\], of a run in steps of `step`.
fn fastest_between(parameters: &Parameters, step: f64, [from, to]: [f64; 2]) -> f64 {
    let mut coupling = Coupling::new(Structure::DEFAULT, parameters);
    let mut rate = 0.0_f64;
    while coupling.plant.time < to {
        coupling.step(step);
        if coupling.plant.time > from {
            rate = rate.max(fastest(&coupling));
        }
    }
    rate
}

/// 20 cm down in 2 s is 4 cm out of reach, 16.5 cm just about at its edge: four seconds later no joint is more than 0.1 rad/s
/// faster than with minimum norm.
#[test]
fn a_reference_at_rest_brings_rest() {
    for dy in [-0.2, -0.165] {
        for step in [1e-2, 2e-2] {
            let late = |resolution| fastest_between(&way(resolution, [0.0, dy], 2.0, None), step, [6.0, 6.5]);
            let usual = late(Resolution::MinimumNorm);
            for resolution in EVERY {
                let rate = late(resolution);
                assert!(rate <= usual + 0.1, "{resolution:?}, {dy} m, {step} s: {rate} rad/s, {usual}");
            }
        }
    }
}

/// Back within reach the path is met again.
#[test]
fn back_within_reach_the_path_is_met_again() {
    for resolution in EVERY {
        let mut coupling = Coupling::new(Structure::DEFAULT, &way(resolution, [0.0, -0.2], 1.5, Some(2.0)));
        let mut farthest = 0.0_f64;
        // By accelerations the path is met by and by.
        while coupling.plant.time < if resolution == Resolution::AccelerationLevel { 5.5 } else { 4.5 } {
            coupling.step(5e-3);
            farthest = farthest.max(coupling.error());
        }
        let near = if resolution == Resolution::AccelerationLevel { 5e-9 } else { 1e-9 };
        assert!(farthest > 0.02 && coupling.error() < near, "{resolution:?}: {farthest}, {:e}", coupling.error());
        assert!(coupling.commands.status.keeps_path(), "{resolution:?}");
    }
}

/// Where rate limits bind, the moment gives way and not the path: 1.5 rad/s in the pick-up, whose extended Jacobian takes 3.
#[test]
fn limits_take_from_the_moment_before_they_take_from_the_path() {
    for (resolution, hold) in [
        (Resolution::ExtendedJacobian, Hold::ZeroOrder),
        (Resolution::ExtendedJacobian, Hold::FirstOrder),
        (Resolution::Gradient, Hold::ZeroOrder),
        (Resolution::LeastSquares, Hold::ZeroOrder),
    ] {
        for step in [2e-3, 2e-2] {
            let mut parameters = default_parameters(Structure::DEFAULT);
            parameters.joints.iter_mut().for_each(|joint| joint.rate_limit = 1.5);
            (parameters.ik.resolution, parameters.ik.hold) = (resolution, hold);
            let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
            let (mut limited, mut first) = (false, true);
            while coupling.plant.time < 2.5 {
                coupling.step(step);
                assert!(fastest(&coupling) <= 1.5 * (1.0 + 1e-12));
                assert!(first || coupling.error() <= 1e-6, "{resolution:?}, {step}: {:e} m", coupling.error());
                limited |= coupling.commands.status == Status::TaskLimited;
                first = false;
            }
            assert!(limited, "{resolution:?}, {hold:?}, {step}");
        }
    }
}

/// How far each joint of the pick-up goes from the grasp at 1.6 s to 3 s, where the reference hardly moves \[rad\].
fn swings(resolution: Resolution, damping: f64, step: f64) -> [f64; 3] {
    let mut parameters = default_parameters(Structure::DEFAULT);
    (parameters.ik.resolution, parameters.ik.moment_damping) = (resolution, damping);
    if resolution == Resolution::AccelerationLevel {
        parameters.ik.hold = Hold::FirstOrder;
    }
    let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
    let mut range = [[f64::MAX, f64::MIN]; 3];
    while coupling.plant.time < 3.0 {
        coupling.step(step);
        if coupling.plant.time > 1.6 {
            for ([least, most], angle) in range.iter_mut().zip(&coupling.plant.outputs.position) {
                (*least, *most) = (least.min(*angle), most.max(*angle));
            }
        }
    }
    range.map(|[least, most]| most - least)
}

/// The free motion beside the path is damped, and alike for every step. Without damping, constant rates damp it the more the
/// longer they are held.
#[test]
fn free_motion_is_damped_alike_for_every_step() {
    let apart = |one: [f64; 3], other: [f64; 3]| {
        one.iter().zip(other).map(|(one, other)| (one / other - 1.0).abs()).fold(0.0, f64::max)
    };
    for resolution in [Resolution::ExtendedJacobian, Resolution::LeastSquares, Resolution::AccelerationLevel] {
        let fine = swings(resolution, 3.0, 2e-3);
        for step in [1e-2, 2e-2] {
            let apart = apart(swings(resolution, 3.0, step), fine);
            assert!(apart < 0.1, "{resolution:?}, {step} s: {apart}");
        }
    }
    let undamped = [2e-3, 2e-2].map(|step| swings(Resolution::ExtendedJacobian, 0.0, step));
    assert!(apart(undamped[1], undamped[0]) > 0.15, "{undamped:?}");
}

/// Four seconds after a hasty reach the arm is at rest on the reference.
#[test]
fn a_hasty_reach_ends_at_rest() {
    for resolution in [Resolution::ExtendedJacobian, Resolution::LeastSquares, Resolution::AccelerationLevel] {
        let mut coupling = Coupling::new(Structure::DEFAULT, &way(resolution, [0.06, -0.04], 0.8, None));
        while coupling.plant.time < 4.8 {
            coupling.step(1e-2);
        }
        assert!(fastest(&coupling) < 0.2 && coupling.error() < 1e-6, "{resolution:?}: {}", fastest(&coupling));
    }
}

/// After limits of rate and acceleration have bound (8 cm in 0.3 s), the arm settles on the reference, and the UAV does not
/// drift away.
#[test]
fn the_arm_settles_after_limits_have_bound() {
    for step in [2e-3, 2e-2] {
        let mut parameters = way(Resolution::LeastSquares, [0.08, 0.0], 0.3, None);
        parameters.joints.iter_mut().for_each(|joint| (joint.rate_limit, joint.acceleration_limit) = (6.0, 20.0));
        let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
        while coupling.plant.time < 4.5 {
            coupling.step(step);
        }
        assert!(fastest(&coupling) < 0.2 && coupling.error() < 1e-6, "{step}: {}", fastest(&coupling));
        assert!(coupling.plant.outputs.pose.x.abs() < 0.05, "{step}: {} m", coupling.plant.outputs.pose.x);
    }
}

/// Where the rates are unique, weights change nothing: two links, and three with the extended Jacobian.
#[test]
fn weights_do_not_matter_where_rates_are_unique() {
    for (links, resolution) in [
        (2, Resolution::MinimumNorm),
        (2, Resolution::LeastSquares),
        (3, Resolution::ExtendedJacobian),
        (3, Resolution::LeastSquares),
    ] {
        let structure = Structure::new(links, Balance::None).unwrap();
        for joint in 0..links {
            for weight in [1e-2, 1e3, 1e4] {
                let mut parameters = default_parameters(structure);
                parameters.ik.resolution = resolution;
                parameters.joints[joint].weight = weight;
                let mut coupling = Coupling::new(structure, &parameters);
                for n in 0..300 {
                    coupling.step(1e-2);
                    let off = coupling.error();
                    assert!(n == 0 || off < 1e-9, "{links} {resolution:?}, weight {weight} of {joint}: {off:e} m");
                    assert!(coupling.commands.status.keeps_path());
                }
            }
        }
    }
}

/// A straight arm that is to be drawn in by 10 cm gets going by itself, and arrives; one that is to become longer stays.
#[test]
fn a_straight_arm_gets_going() {
    for resolution in EVERY {
        let mut parameters = way(resolution, [0.0, 0.1], 2.0, None);
        parameters.joints.iter_mut().for_each(|joint| joint.start = 0.0);
        let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
        while coupling.plant.time < 4.0 {
            coupling.step(5e-3);
        }
        assert!(coupling.error() < 1e-9, "{resolution:?}: {:e}", coupling.error());

        parameters.reference.legs[0].dy = -0.1;
        let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
        (0..100).for_each(|_| coupling.step(1e-2));
        assert_close(&coupling.plant.outputs.position[..3], &[0.0; 3], 1e-9, "angles");
        assert_ne!(coupling.commands.status, Status::Ok, "{resolution:?}");
    }
}

/// Joints that start past their stops come back as fast as they may, which is said: from 0.3 rad past with 4 rad/s2 up to 1
/// rad/s, that takes 0.3 s + 0.5 (1 rad/s) / (4 rad/s2).
#[test]
fn joints_come_back_from_past_their_stops() {
    let mut parameters = way(Resolution::LeastSquares, [0.0, 0.0], 1.0, None);
    for joint in &mut parameters.joints {
        (joint.rate_limit, joint.acceleration_limit) = (1.0, 4.0);
    }
    parameters.joints[1].upper = parameters.joints[1].start - 0.3;
    let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
    let is_outside = |coupling: &Coupling| coupling.plant.outputs.position[1] > parameters.joints[1].upper + 1e-9;
    let mut inside_at = f64::NAN;
    while coupling.plant.time < 1.0 {
        if is_outside(&coupling) {
            assert!(
                !matches!(coupling.commands.status, Status::Ok | Status::TaskDamped),
                "{:?}",
                coupling.commands.status
            );
        } else if inside_at.is_nan() {
            inside_at = coupling.plant.time;
        }
        coupling.step(2e-3);
    }
    let shortest = 0.3 + 0.5 / 4.0;
    assert!((shortest - 0.01..shortest + 0.02).contains(&inside_at), "{inside_at} s");
    assert!(!is_outside(&coupling));
}

proptest! {
    #![proptest_config(cases(48))]

    /// Whatever happens, a status that keeps the path ends the interval on the reference: all methods, vehicles, ways, limits.
    #[test]
    fn the_status_tells_the_truth(seed: u64) {
        let random = &mut Random(seed);
        let structure = Structure::new(2 + (random.unit() * 4.0) as usize, Balance::None).unwrap();
        let mut p = way(EVERY[(random.unit() * 5.0) as usize], [random.about_zero(0.3), random.about_zero(0.3)], 0.5, None);
        p.joints = default_parameters(structure).joints;
        if structure.links == 2 {
            (p.ik.resolution, p.ik.hold) = (Resolution::MinimumNorm, Hold::ZeroOrder);
        }
        if random.coin() {
            p.ik.discretization = Discretization::Euler;
        }
        for joint in &mut p.joints {
            joint.rate_limit = random.between(1.0, 30.0);
            joint.acceleration_limit = random.between(10.0, 1e3);
        }
        p.ik.sample_time = [1e-3, 1e-2, 2e-2][(random.unit() * 3.0) as usize];
        let mut coupling = Coupling::new(structure, &p);
        for n in 0..80 {
            let status = coupling.commands.status;
            coupling.step(p.ik.sample_time);
            let miss = (coupling.commands.predicted_end_effector - coupling.commands.reference).norm();
            prop_assert!(!status.keeps_path() || miss <= 1e-6, "{n}: {status:?} and {miss:e} m");
            prop_assert!(coupling.commands.late_miss <= 1e-9, "{n}: late by {:e} m", coupling.commands.late_miss);
        }
    }
}

/// A miss that only became known afterwards has an output of its own: a step of 5 ms where 1 ms was planned for.
#[test]
fn what_is_missed_by_an_uneven_clock_is_said() {
    let mut coupling = Coupling::new(Structure::DEFAULT, &way(Resolution::ExtendedJacobian, [0.05, -0.05], 0.5, None));
    (0..100).for_each(|_| coupling.step(1e-3));
    assert!(coupling.commands.late_miss < 1e-10);
    coupling.step(5e-3);
    let miss = (coupling.commands.predicted_end_effector - coupling.commands.reference).norm();
    assert_close(&[coupling.commands.late_miss], &[miss], 1e-10, "late miss");
    assert!(miss > 1e-6, "{miss:e}");
}
