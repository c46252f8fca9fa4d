//! Rates that change linearly between two plans.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::assert_close;
use common::coupling::Coupling;
use uam::control::Status;
use uam::parameters::defaults::default_parameters;
use uam::parameters::{Discretization, Hold, MAX_COORDINATES, Resolution};
use uam::{Parameters, Structure};

const RESOLUTIONS: [Resolution; 3] = [Resolution::MinimumNorm, Resolution::Gradient, Resolution::ExtendedJacobian];

fn pick_up(resolution: Resolution, hold: Hold) -> Parameters {
    let mut parameters = default_parameters(Structure::DEFAULT);
    (parameters.ik.resolution, parameters.ik.hold) = (resolution, hold);
    parameters
}

/// What a run of the pick-up shows: largest errors of place and velocity at the samples, and
/// the largest jump of a rate from one interval to the next, the grasp excepted.
#[derive(Debug, Default)]
struct Seen {
    place: f64,
    velocity: f64,
    jump: f64,
    /// Sum over the coordinates of all changes of the acceleration \[rad/s2\].
    restless: f64,
}

fn run(parameters: &Parameters, step: f64, duration: f64) -> Seen {
    let mut coupling = Coupling::new(Structure::DEFAULT, parameters);
    let mut seen = Seen::default();
    let (mut last, mut slope) = ([0.0; MAX_COORDINATES], [0.0; MAX_COORDINATES]);
    for k in 0..(duration / step).round() as u64 {
        let (rate, acceleration) = (coupling.commands.rate_command, coupling.commands.acceleration_command);
        let time = k as f64 * step;
        for i in 0..3 {
            let jump = (rate[i] - last[i]).abs();
            if !(1.6 - 0.5 * step..1.6 + 1.5 * step).contains(&time) {
                seen.jump = seen.jump.max(jump);
            }
            seen.restless += (acceleration[i] - slope[i]).abs();
        }
        coupling.step(step);
        (last, slope) = (coupling.plant.outputs.rate, acceleration);
        let velocity = coupling.plant.outputs.end_effector_velocity - coupling.commands.reference_velocity;
        seen.place = seen.place.max(coupling.error());
        seen.velocity = seen.velocity.max(velocity.norm());
        let says = coupling.commands.status;
        let off = parameters.ik.discretization == Discretization::Euler && says == Status::Inexact;
        assert!(says == Status::Ok || off, "t = {time}: {says:?}");
    }
    seen
}

/// At 10 ms over the whole run: the place as exact as with constant rates, the velocity exact, too; and no
/// ringing, that is, no jumps and no restless accelerations.
#[test]
fn ramps_end_on_the_reference_with_its_velocity() {
    for resolution in RESOLUTIONS {
        let [constant, linear] =
            [Hold::ZeroOrder, Hold::FirstOrder].map(|hold| run(&pick_up(resolution, hold), 0.01, 30.0));
        assert!(linear.place < 5e-7 && linear.place <= constant.place, "{resolution:?}: {constant:?}, {linear:?}");
        assert!(linear.velocity < 1e-5 && constant.velocity > 1e-3, "{resolution:?}: {constant:?}, {linear:?}");
        assert!(linear.jump < 0.05 * constant.jump, "{resolution:?}: {constant:?}, {linear:?}");
        // What rings changes the more the shorter the steps are; a smooth curve, before the grasp, does not.
        let [coarse, fine] = [0.01, 5e-3].map(|step| run(&pick_up(resolution, Hold::FirstOrder), step, 1.5).restless);
        assert!(fine < 1.2 * coarse, "{resolution:?}: {coarse} {fine}");
    }
}

/// At 1 ms to a nanometre.
#[test]
fn one_millisecond_is_exact_to_a_nanometre() {
    for resolution in RESOLUTIONS {
        let seen = run(&pick_up(resolution, Hold::FirstOrder), 1e-3, 3.0);
        assert!(seen.place < 1e-9 && seen.velocity < 1e-8, "{resolution:?}: {seen:?}");
    }
}

/// Plans every 10 ms for a host that steps by 1 ms: within the interval the rates follow the ramp.
#[test]
fn rates_advance_between_plans() {
    let mut parameters = pick_up(Resolution::ExtendedJacobian, Hold::FirstOrder);
    parameters.ik.sample_time = 0.01;
    let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
    for k in 0..60 {
        let (rate, slope) = (coupling.commands.rate_command, coupling.commands.acceleration_command);
        coupling.step(1e-3);
        let ramp: Vec<f64> = (0..3).map(|i| rate[i] + 1e-3 * slope[i]).collect();
        assert_close(&coupling.plant.outputs.rate[..3], &ramp, 1e-14, "rates at the end");
        if (k + 1) % 10 != 0 {
            assert_close(&coupling.commands.rate_command[..3], &ramp, 1e-14, "rates from now on");
            assert_eq!(coupling.commands.acceleration_command, slope);
        } else if k > 10 {
            assert!(coupling.error() < 1e-9, "k = {k}: {:e}", coupling.error());
        }
    }
}

/// The thesis' step with its rates interpolated, as it handed them over: no worse than held.
#[test]
fn the_thesis_rates_may_be_interpolated() {
    for resolution in RESOLUTIONS {
        let [constant, linear] = [Hold::ZeroOrder, Hold::FirstOrder].map(|hold| {
            let mut parameters = pick_up(resolution, hold);
            parameters.ik.discretization = Discretization::Euler;
            run(&parameters, 1e-3, 3.0)
        });
        assert!(linear.place < 1.05 * constant.place, "{resolution:?}: {constant:?}, {linear:?}");
        // The first interval, planned before the steps of the host are known, has constant rates.
        assert!(linear.jump < 1e-6, "{resolution:?}: {linear:?}");
    }
}

/// Limits of acceleration are those between constant rates: the combination is refused by name.
#[test]
fn least_squares_holds_constant_rates() {
    let parameters = pick_up(Resolution::LeastSquares, Hold::FirstOrder);
    let mut outputs = uam::control::Outputs::default();
    let refusal = uam::control::new(Structure::DEFAULT, &parameters, &mut outputs).err().unwrap().to_string();
    assert!(refusal.contains("ik.hold") && refusal.contains("zero_order"), "{refusal}");
}
