//! The controller with the plant: tracking, limits, host steps and wrong parameters.

mod common;

use std::f64::consts::PI;

use common::assert_close;
use common::coupling::Coupling;
use uam::autopilot::AutopilotMode;
use uam::control::{self, Status};
use uam::parameters::defaults::default_parameters;
use uam::parameters::{Discretization, Resolution};
use uam::{Parameters, Structure};

const DEFAULT: Structure = Structure::DEFAULT;

fn with(change: impl Fn(&mut Parameters)) -> Parameters {
    let mut parameters = default_parameters(DEFAULT);
    change(&mut parameters);
    parameters
}

fn undamped(change: impl Fn(&mut Parameters)) -> Parameters {
    with(|p| {
        p.ik.moment_damping = 0.0;
        change(p);
    })
}

/// Where coordinates and end effector are predicted is where they are, within `tolerance` \[rad, m\].
#[track_caller]
fn assert_foreseen(coupling: &Coupling, tolerance: f64) {
    let (o, c) = (&coupling.plant.outputs, &coupling.commands);
    assert_close(&c.predicted_position, &o.position, tolerance, "position");
    assert_close(c.predicted_end_effector.as_slice(), o.end_effector.as_slice(), tolerance, "end effector");
}

fn start(parameters: &Parameters) -> control::Outputs {
    Coupling::new(DEFAULT, parameters).commands
}

/// Every structure that can be built runs with its default parameters for a second and follows its path.
#[test]
fn all_structures_run_with_their_defaults() {
    for structure in Structure::all() {
        let mut coupling = Coupling::new(structure, &default_parameters(structure));
        for _ in 0..100 {
            coupling.step(0.01);
            let (o, c) = (&coupling.plant.outputs, &coupling.commands);
            let all = [&coupling.plant.motion()[..], &o.effort, &c.rate_command, &c.predicted_position].concat();
            assert!(all.iter().all(|value| value.is_finite()), "{structure}");
            let limits = coupling.plant.model.parameters.joints.iter().map(|joint| joint.rate_limit);
            assert!(c.rate_command.iter().zip(limits).take(structure.links).all(|(r, l)| r.abs() <= l * (1.0 + 1e-15)));
        }
    }
}

/// The prediction is the plant's motion: nothing but rounding between them, in every mode of the autopilot.
#[test]
fn the_prediction_is_the_plant() {
    let modes = [(AutopilotMode::Pid, 0.0), (AutopilotMode::Pid, 3e-3), (AutopilotMode::Ideal, 0.0)];
    for (mode, sample_time) in modes {
        let mut coupling = Coupling::new(
            DEFAULT,
            &with(|p| {
                p.autopilot.mode = mode;
                p.autopilot.sample_time = sample_time;
                p.payload.grasp_time = 0.45;
            }),
        );
        for _ in 0..150 {
            coupling.step(5e-3);
            let (o, c) = (&coupling.plant.outputs, &coupling.commands);
            assert_close(c.predicted_pose.as_slice(), o.pose.as_slice(), 1e-11, "pose");
            assert_close(c.predicted_velocity.as_slice(), o.velocity.as_slice(), 1e-10, "velocity");
            assert_foreseen(&coupling, 1e-11);
        }
    }
}

/// At a millisecond most plans end where a first guess leads, displaced by the little that it leaves: arm and base.
#[test]
fn what_a_guess_leaves_is_displaced_in_the_prediction() {
    for resolution in [Resolution::MinimumNorm, Resolution::ExtendedJacobian] {
        let mut coupling = Coupling::new(DEFAULT, &with(|p| p.ik.resolution = resolution));
        for _ in 0..1500 {
            coupling.step(1e-3);
            assert_foreseen(&coupling, 5e-13);
        }
    }
}

/// A step of nearly no time leaves the plan, but not to be taken up as if nothing of it had passed.
#[test]
fn a_plan_is_taken_up_once() {
    for discretization in [Discretization::Exact, Discretization::Euler] {
        let mut coupling = Coupling::new(DEFAULT, &with(|p| p.ik.discretization = discretization));
        for _ in 0..20 {
            coupling.step(0.01);
        }
        for size in [1e-10, 0.01, 0.01] {
            coupling.step(size);
            let (o, c) = (&coupling.plant.outputs, &coupling.commands);
            assert_close(c.predicted_end_effector.as_slice(), o.end_effector.as_slice(), 1e-4, "end effector");
        }
    }
}

/// On the carriage, too, the arm keeps moments off the base: what the plant measures is zero, if nothing is to be damped.
#[test]
fn the_extended_jacobian_keeps_moments_off_the_base() {
    for mode in [AutopilotMode::Pid, AutopilotMode::Ideal] {
        let mut coupling = Coupling::new(DEFAULT, &undamped(|p| p.autopilot.mode = mode));
        for _ in 0..100 {
            coupling.step(0.01);
            assert!(coupling.plant.outputs.transmitted_moment.abs() < 1e-8, "{mode:?}");
        }
        assert_eq!(coupling.commands.status, Status::Ok);
    }
}

/// Steps with rounding in them, plans every 2 ms: at the samples the end effector is on the reference.
#[test]
fn host_steps_with_rounding_do_not_disturb_the_plans() {
    let mut coupling = Coupling::new(DEFAULT, &with(|p| p.ik.sample_time = 2e-3));
    let odd = 0.000_999_999_999_984_546;
    for i in 0..250 {
        coupling.step(odd);
        coupling.step(1e-13);
        coupling.step(1e-3 + (1e-3 - odd) - 1e-13);
        if i > 0 {
            assert!(coupling.error() < 1e-9, "t = {}: {:e}", coupling.plant.time, coupling.error());
        }
    }
}

/// Rates keep their directions but none exceeds its limit; afterwards the path is caught up with.
#[test]
fn rate_limits_are_respected() {
    let limit = 0.6;
    let mut coupling =
        Coupling::new(DEFAULT, &with(|p| p.joints.iter_mut().for_each(|joint| joint.rate_limit = limit)));
    let mut limited = false;
    for _ in 0..600 {
        coupling.step(0.01);
        let c = &coupling.commands;
        let largest = c.rate_command.iter().fold(0.0, |largest: f64, rate| largest.max(rate.abs()));
        assert!(largest <= limit * (1.0 + 1e-15));
        if c.status == Status::RateLimited {
            assert_close(&[largest], &[limit], 1e-15, "largest rate");
            assert!(c.velocity_residual > 0.0);
            limited = true;
        }
    }
    assert!(limited);
    assert_eq!(coupling.commands.status, Status::Ok);
    assert!(coupling.error() < 1e-8, "{:e}", coupling.error());
}

/// A path that leads out of reach and back: bounded and finite beyond, on the reference again afterwards.
#[test]
fn beyond_reach_and_back() {
    for resolution in [Resolution::MinimumNorm, Resolution::ExtendedJacobian] {
        for discretization in [Discretization::Euler, Discretization::Exact] {
            let mut coupling = Coupling::new(
                DEFAULT,
                &with(|p| {
                    (p.ik.resolution, p.ik.discretization) = (resolution, discretization);
                    let leg = p.reference.legs[0];
                    p.reference.legs = std::array::from_fn(|_| uam::reference::Leg::NONE);
                    p.reference.legs[0] = uam::reference::Leg { dx: 0.0, dy: -0.25, ..leg };
                    p.reference.legs[1] = uam::reference::Leg { start: 2.0, dx: 0.0, dy: 0.25, ..leg };
                    p.payload.grasp_time = 100.0;
                }),
            );
            let mut damped = false;
            for _ in 0..400 {
                coupling.step(0.01);
                let rates = coupling.commands.rate_command;
                damped |= coupling.commands.status != Status::Ok;
                assert!(rates.iter().all(|rate| rate.abs() <= 10.0 * PI * (1.0 + 1e-15)), "{rates:?}");
            }
            assert!(damped, "{resolution:?} {discretization:?}");
            if discretization == Discretization::Exact {
                assert!(coupling.error() < 1e-9, "{resolution:?}: {:e}", coupling.error());
            }
        }
    }
}

/// Grasped at the first communication point from its time less 1e-9 s on; a negative time: from the start.
#[test]
fn the_grasp_comes_in_time() {
    for (time, before) in [(0.05, true), (0.05 + 0.9e-9, true), (0.05 + 2e-9, false)] {
        let mut coupling = Coupling::new(DEFAULT, &with(|p| p.payload.grasp_time = time));
        for _ in 0..4 {
            coupling.step(0.01);
            assert!(!coupling.commands.grasp);
        }
        coupling.step(0.01);
        assert_eq!(coupling.commands.grasp, before, "{time}");
        coupling.step(0.01);
        assert!(coupling.commands.grasp);
        assert_eq!(coupling.plant.outputs.attached, before);
    }
    assert!(start(&with(|p| p.payload.grasp_time = -1.0)).grasp);
    assert!(start(&with(|p| p.payload.grasp_time = 0.0)).grasp);
    assert!(!start(&with(|_| {})).grasp);
}

/// The grasp comes at the first communication point from its time on even if no plan is due there.
#[test]
fn the_grasp_does_not_wait_for_a_plan() {
    let mut coupling = Coupling::new(
        DEFAULT,
        &with(|p| {
            p.payload.grasp_time = 0.015;
            p.ik.sample_time = 0.01;
        }),
    );
    for _ in 0..15 {
        coupling.step(1e-3);
    }
    assert!(coupling.commands.grasp);
}

/// Plans depend on parameters only: the first rates are there before any step, and at rest there are none.
#[test]
fn the_first_interval_is_planned_at_once() {
    let outputs = start(&with(|p| p.ik.sample_time = 0.01));
    assert!(outputs.rate_command[..3].iter().any(|rate| rate.abs() > 1e-6));
    assert_close(outputs.predicted_end_effector.as_slice(), outputs.reference.as_slice(), 1e-15, "at the start");
    let still = start(&with(|p| p.reference.legs.iter_mut().for_each(|leg| leg.duration = 0.0)));
    assert!(still.rate_command.iter().all(|rate| rate.abs() < 1e-6), "{:?}", still.rate_command);
}

/// Rates that jump where a hasty path meets limits, and where the payload is grasped, do not lead the plans after them astray.
#[test]
fn plans_hold_after_rates_that_jumped() {
    let hasty = with(|p| {
        p.ik.resolution = Resolution::LeastSquares;
        p.payload.grasp_time = 0.35;
        let leg = &mut p.reference.legs[0];
        (leg.start, leg.duration, leg.ramp) = (0.0, 0.4, 0.05);
    });
    let mut coupling = Coupling::new(DEFAULT, &hasty);
    let mut seen = Vec::new();
    for n in 0..150 {
        coupling.step(0.01);
        let c = &coupling.commands;
        assert!(c.status != Status::Inexact, "{n}");
        assert!(c.status != Status::Ok || c.velocity_residual <= 1e-8, "{n}: {:e}", c.velocity_residual);
        seen.push(c.status);
    }
    assert!(seen.contains(&Status::TaskLimited), "limits bind");
}
