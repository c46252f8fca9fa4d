//! A reference from outside: values of the beginning of a step, as FMI has it, or of its end, with or without derivatives.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::coupling::Coupling;
use nalgebra::Vector2;
use uam::Structure;
use uam::parameters::defaults::default_parameters;
use uam::reference::{ReferenceInstant, ReferenceKind};

/// Which derivatives a host gives beside the position.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Given {
    Nothing,
    Velocity,
    Acceleration,
}

/// Largest distance of the end effector from the path of the pick-up as it truly is at the time, when a host hands that over as
/// an external reference, over the way there and the beginning of the way back \[m\].
fn error(instant: ReferenceInstant, given: Given, step: f64) -> f64 {
    let mut parameters = default_parameters(Structure::DEFAULT);
    let path = parameters.reference.clone();
    (parameters.reference.kind, parameters.reference.instant) = (ReferenceKind::External, instant);
    let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
    let origin = coupling.plant.outputs.end_effector;
    let mut error = 0.0_f64;
    while coupling.plant.time < 2.5 {
        let t = coupling.plant.time;
        let wanted = path.at(if instant == ReferenceInstant::StepStart { t } else { t + step });
        coupling.external.position = origin + wanted.displacement;
        if given != Given::Nothing {
            coupling.external.velocity = wanted.velocity;
        }
        if given == Given::Acceleration {
            coupling.external.acceleration = wanted.acceleration;
        }
        coupling.step(step);
        let off = coupling.plant.outputs.end_effector - origin - path.at(t + step).displacement;
        error = error.max(off.norm());
    }
    error
}

/// The jerk of the path is at most 3.1 m/s3. With the acceleration given, two steps are foreseen from a value of the beginning
/// of a step: 3.1/6 (2 h)^3 = 4.1e-9 m at 1 ms, and an eighth of that from one of its end. Differences in place of a
/// derivative cost some more.
#[test]
fn a_reference_from_outside_is_foreseen() {
    for instant in [ReferenceInstant::StepStart, ReferenceInstant::StepEnd] {
        for (given, bars) in
            [(Given::Acceleration, [1e-8, 1e-5]), (Given::Velocity, [1e-8, 1e-5]), (Given::Nothing, [2e-8, 4e-5])]
        {
            for (step, bar) in [1e-3, 1e-2].into_iter().zip(bars) {
                let error = error(instant, given, step);
                assert!(error < bar, "{instant:?}, {given:?}, {step} s: {error:e} m");
            }
        }
    }
}

/// A jump of a position that comes alone is a jump, and no velocity: the end effector goes there at 2 m/s at most, arrives, and
/// does not shoot beyond by more than what a millisecond of that makes.
#[test]
fn a_jump_is_not_taken_for_a_velocity() {
    let mut parameters = default_parameters(Structure::DEFAULT);
    parameters.reference.kind = ReferenceKind::External;
    parameters.payload.grasp_time = 1e9;
    let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
    let origin = coupling.plant.outputs.end_effector;
    let jump = Vector2::new(0.03, -0.02);
    for n in 0..1500 {
        coupling.external.position = if n < 100 { origin } else { origin + jump };
        coupling.step(1e-3);
        let along = (coupling.plant.outputs.end_effector - origin).dot(&jump) / jump.norm();
        assert!(along < jump.norm() + 2e-3, "{along} m at {n} ms");
    }
    assert!(coupling.error() < 1e-9, "{:e}", coupling.error());
}
