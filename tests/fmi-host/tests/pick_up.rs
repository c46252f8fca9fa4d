//! The payload pick-up of thesis 4.3, coupled by a plain parallel master: 30 s, both resolutions.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use fmi_host::{Coupling, Track, steps};
use uam::Structure;

const MINIMUM_NORM: (&str, f64) = ("ik.resolution", 1.0);
const EXTENDED_JACOBIAN: (&str, f64) = ("ik.resolution", 3.0);
const EULER: (&str, f64) = ("ik.discretization", 1.0);
const EXACT: (&str, f64) = ("ik.discretization", 2.0);
/// As in the thesis, which damps nothing.
const UNDAMPED: (&str, f64) = ("ik.moment_damping", 0.0);
const STIFF_ROLL_RATE: (&str, f64) = ("autopilot.roll.kd", 9.0);

/// Thesis 4.3 holds a distance of 1 cm from the path for lost.
const LOST: f64 = 0.01;

fn run(parameters: &[(&str, f64)], size: f64, count: u32) -> Track {
    Coupling::open(Structure::DEFAULT).run(parameters, steps(0.0, size, count)).unwrap()
}

/// 30 s at the thesis' step of 1 ms.
fn at_one_millisecond(parameters: &[(&str, f64)]) -> Track {
    run(parameters, 1e-3, 30_000)
}

/// Thesis 4.3, minimum norm: about 11 cm to the right and 10 cm down; the error stays below 0.1 mm.
#[test]
fn the_smallest_rates_move_the_uav() {
    let track = at_one_millisecond(&[MINIMUM_NORM, EULER]);
    let (right, down) = (track.farthest(0, 1.0), track.farthest(1, -1.0));
    assert!((0.105..0.115).contains(&right), "right: {right}");
    assert!((0.095..0.105).contains(&down), "down: {down}");
    assert!((1e-6..1e-4).contains(&track.largest_error()), "the thesis' own error: {}", track.largest_error());
}

/// Thesis 4.3, extended Jacobian: ends about 5 mm to the right, practically without roll.
#[test]
fn the_extended_jacobian_keeps_the_uav_still() {
    let track = at_one_millisecond(&[EXTENDED_JACOBIAN, EULER, UNDAMPED]);
    let [x, _, _] = track.end();
    assert!((0.004..0.007).contains(&x), "right: {x}");
    let roll = track.farthest(2, 1.0).max(track.farthest(2, -1.0));
    assert!(roll < 1e-4, "roll: {roll} rad");
}

/// Thesis 4.3 with roll kd = 9: minimum norm leaves the workspace at about 13 s.
#[test]
fn a_stiffer_roll_rate_costs_the_smallest_rates_their_workspace() {
    for discretization in [EULER, EXACT] {
        let track = at_one_millisecond(&[MINIMUM_NORM, discretization, STIFF_ROLL_RATE]);
        let lost = track.lost_at(LOST);
        assert!(lost.is_some_and(|time| (11.5..14.0).contains(&time)), "{discretization:?}: {lost:?}");
        assert!(track.pose.iter().flatten().all(|value| value.is_finite()), "the units go on");
    }
}

/// Thesis 4.3 with roll kd = 9: the extended Jacobian does not mind.
#[test]
fn a_stiffer_roll_rate_leaves_the_extended_jacobian_as_it_is() {
    let soft = at_one_millisecond(&[EXTENDED_JACOBIAN, EULER, UNDAMPED]);
    let stiff = at_one_millisecond(&[EXTENDED_JACOBIAN, EULER, UNDAMPED, STIFF_ROLL_RATE]);
    assert_eq!(stiff.lost_at(LOST), None);
    for (soft, stiff) in soft.pose.iter().zip(&stiff.pose) {
        let apart = (soft[0] - stiff[0]).hypot(soft[1] - stiff[1]);
        assert!(apart < 1e-4, "{apart} m apart: {soft:?} and {stiff:?}");
    }
}

/// On the path at every communication point: 1e-9 m at 1 ms, 5e-7 m at 10 ms with the same `sample_time`.
#[test]
fn the_exact_discretization_stays_on_the_path() {
    for resolution in [MINIMUM_NORM, EXTENDED_JACOBIAN] {
        for (size, count, bar) in [(1e-3, 30_000, 1e-9), (1e-2, 3000, 5e-7)] {
            let track = run(&[resolution, EXACT], size, count);
            assert!((track.time.last().unwrap() - 30.0).abs() < 1e-9);
            let error = track.largest_error();
            assert!(error <= bar, "{resolution:?} at {size} s: {error} m");
        }
    }
}

/// What the extended Jacobian imposes: no moment of the arm on the UAV, mean over every step.
#[test]
fn the_exact_extended_jacobian_keeps_moments_off_the_uav() {
    let track = at_one_millisecond(&[EXTENDED_JACOBIAN, EXACT, UNDAMPED]);
    let largest = track.moment.iter().skip(1).fold(0.0, |largest: f64, moment| largest.max(moment.abs()));
    assert!(largest < 1e-7, "{largest} N m");
}

/// With the damping of the start values the UAV still keeps within what thesis 4.3 says: 5 mm to the right at the end, a roll
/// below 0.1 degrees, and a moment of the arm below 0.05 N m; the arm is at rest at the end, where it swings on without.
#[test]
fn the_damping_of_the_start_values_costs_little() {
    for (size, count) in [(1e-3, 30_000), (1e-2, 3000)] {
        let track = run(&[], size, count);
        let [x, _, _] = track.end();
        assert!((0.004..0.006).contains(&x), "right: {x}");
        let roll = track.farthest(2, 1.0).max(track.farthest(2, -1.0));
        assert!(roll < 0.1_f64.to_radians(), "roll: {roll} rad");
        let moment = track.moment.iter().skip(1).fold(0.0, |largest: f64, moment| largest.max(moment.abs()));
        assert!(moment < 0.05, "{moment} N m");
        let late = track.moment[track.moment.len() * 9 / 10..].iter();
        assert!(
            late.clone().all(|moment| moment.abs() < 1e-4),
            "at the end: {:e} N m",
            late.fold(0.0_f64, |a, b| a.max(b.abs()))
        );
    }
}

/// Whoever sets nothing gets the extended Jacobian, exact.
#[test]
fn the_start_values_are_the_pick_up() {
    let untouched = run(&[], 1e-2, 3000);
    assert_eq!(untouched, run(&[EXTENDED_JACOBIAN, EXACT], 1e-2, 3000));
}
