//! The pick-up of thesis 4.3: 3 links, 8 cm right and 12 cm down, payload from an elastic support at 1.6 s.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use std::f64::consts::PI;

use common::coupling::Coupling;
use uam::control::Status;
use uam::parameters::Discretization;
use uam::scenarios::{PICK_UP_DURATION, Scenario, find};

/// What a run looks like from afar.
#[derive(Debug, Default)]
struct Seen {
    /// Largest distance of the end effector from the reference [m].
    error: f64,
    right: f64,
    down: f64,
    roll: f64,
    torque: f64,
    /// Largest transmitted moment [N m].
    moment: f64,
    /// UAV at the end [m].
    end_x: f64,
    /// When the arm first could not follow [s].
    lost: Option<f64>,
}

fn run(scenario: &Scenario, step: f64, duration: f64) -> Seen {
    let mut coupling = Coupling::new(scenario.structure, &scenario.parameters);
    let mut seen = Seen::default();
    for _ in 0..(duration / step).round() as u64 {
        coupling.step(step);
        let o = &coupling.plant.outputs;
        seen.error = seen.error.max(coupling.error());
        seen.right = seen.right.max(o.pose.x);
        seen.down = seen.down.max(-o.pose.y);
        seen.roll = seen.roll.max(o.pose.z.abs());
        seen.torque = seen.torque.max(o.torque.abs());
        seen.moment = seen.moment.max(o.transmitted_moment.abs());
        seen.end_x = o.pose.x;
        if coupling.commands.status != Status::Ok && seen.lost.is_none() {
            seen.lost = Some(coupling.plant.time);
        }
    }
    seen
}

/// Minimum norm: the UAV swings 11 cm to the right, U2 reaches 0.7 N m, and it sinks 10 cm under the load.
fn swings(seen: &Seen) {
    assert!((seen.right - 0.11).abs() < 0.01, "{seen:?}");
    assert!((seen.down - 0.10).abs() < 0.01, "{seen:?}");
    assert!((seen.torque - 0.7).abs() < 0.1, "{seen:?}");
    assert_eq!(seen.lost, None);
}

/// Extended Jacobian: the UAV ends about 5 mm to the right and its roll is negligible; steps of 10 ms, whose
/// moments are zero in the mean only, leave it twice as large.
fn keeps_still(seen: &Seen) {
    assert!((seen.end_x - 0.005).abs() < 1e-3, "{seen:?}");
    assert!(seen.roll < 0.02 * PI / 180.0, "{seen:?}");
    assert!(seen.torque < 0.02, "{seen:?}");
    assert!((seen.down - 0.10).abs() < 0.01, "{seen:?}");
    assert_eq!(seen.lost, None);
}

#[test]
fn minimum_norm_follows_exactly_while_the_uav_swings() {
    let seen = run(&find("4.3a").unwrap(), 0.01, PICK_UP_DURATION);
    assert!(seen.error < 5e-7, "{seen:?}");
    swings(&seen);
}

#[test]
fn extended_jacobian_follows_exactly_and_the_uav_keeps_still() {
    let seen = run(&find("4.3b").unwrap(), 0.01, PICK_UP_DURATION);
    assert!(seen.error < 5e-7, "{seen:?}");
    keeps_still(&seen);
}

/// At 1 ms to a nanometre, through reaching, grasp and the first lift; the roll stays below 0.01 deg.
#[test]
fn one_millisecond_is_exact_to_a_nanometre() {
    for id in ["4.3a", "4.3b"] {
        let seen = run(&find(id).unwrap(), 1e-3, 3.0);
        assert!(seen.error < 1e-9, "{id}: {seen:?}");
        if id == "4.3b" {
            assert!(seen.roll < 0.01 * PI / 180.0, "{seen:?}");
            assert!(seen.moment < 1e-7, "{seen:?}");
        }
    }
}

/// The thesis' own step: about 0.1 mm of error at 1 ms while the UAV swings as in the exact run.
#[test]
fn the_thesis_step_errs_by_a_tenth_of_a_millimetre() {
    let mut scenario = find("4.3a").unwrap();
    scenario.parameters.ik.discretization = Discretization::Euler;
    let seen = run(&scenario, 1e-3, 3.0);
    assert!(seen.error > 2e-5 && seen.error < 1.2e-4, "{seen:?}");
    assert!((seen.right - 0.11).abs() < 0.01, "{seen:?}");
}

/// With the extended Jacobian the thesis' step leaves the roll alone, too.
#[test]
fn the_thesis_step_keeps_the_uav_still() {
    let mut scenario = find("4.3b").unwrap();
    scenario.parameters.ik.discretization = Discretization::Euler;
    let seen = run(&scenario, 1e-3, 3.0);
    assert!(seen.roll < 0.01 * PI / 180.0, "{seen:?}");
    assert!(seen.error > 2e-5 && seen.error < 3e-4, "{seen:?}");
}

/// With roll kd = 9 the swings grow until the arm leaves its workspace (thesis: at about 13 s; this model: 12 s);
/// the extended Jacobian does not care.
#[test]
fn stiff_roll_damping_breaks_minimum_norm_only() {
    let lost = run(&find("4.3c-minimum-norm").unwrap(), 0.01, 13.0).lost.unwrap();
    assert!((11.5..14.0).contains(&lost), "{lost}");
    keeps_still(&run(&find("4.3c-extended-jacobian").unwrap(), 0.01, PICK_UP_DURATION));
}
