//! How errors of the coupled FMUs grow with the communication step.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

mod common;

use fmu_build::host::coupling::Order;
use fmu_build::study::budget::{EULER, EXACT, Errors, Pilot, VARIANTS, Variant, Watch, observed_order};
use uam::parameters::Hold;
use uam::scenarios::{Scenario, find};

/// The pick-up until the payload is held and the way back has begun.
fn scenario() -> Scenario {
    Scenario { duration: 4.0, ..find("4.3b").unwrap() }
}

fn errors<const N: usize>(variant: &Variant, steps: [f64; N]) -> [Errors; N] {
    let (pair, scenario) = (common::pair(), scenario());
    steps.map(|step| variant.run(&pair, &scenario, step, &|| {}).unwrap())
}

/// Observed order of an error.
fn order(variant: &Variant, steps: [f64; 3], of: fn(&Errors) -> f64) -> f64 {
    let points: Vec<(f64, f64)> = steps.into_iter().zip(errors(variant, steps).iter().map(of)).collect();
    let order = observed_order(&points);
    assert!(order.is_some(), "{points:?} shows no order");
    order.unwrap()
}

#[test]
fn the_step_of_the_thesis_is_of_order_one() {
    let steps = [5e-4, 1e-3, 2e-3];
    for of in [|errors: &Errors| errors.end_effector, |errors: &Errors| errors.base] {
        let order = order(&EULER, steps, of);
        assert!((order - 1.0).abs() < 0.15, "order {order}");
    }
}

/// To its end, as the documentation says it.
#[test]
fn an_exact_step_is_exact_at_the_samples() {
    let (pair, scenario) = (common::pair(), find("4.3b").unwrap());
    for hold in [Hold::ZeroOrder, Hold::FirstOrder] {
        for step in [1e-3, 1e-2, 2e-2] {
            let errors = Variant { hold, ..EXACT }.run(&pair, &scenario, step, &|| {}).unwrap();
            assert!(errors.end_effector <= 1e-11, "{hold:?}, {step} s: {errors:?}");
            assert!(errors.base <= 1e-11, "{hold:?}, {step} s: {errors:?}");
        }
    }
}

/// Between two points of the path, constant rates, which meet both places, cut the corner by path'' T^2 / 8; ramps,
/// which meet the velocity at the end as well, by 2 path''' T^3 / 81.
#[test]
fn between_the_samples_the_hold_decides() {
    for (hold, expected) in [(Hold::ZeroOrder, 2.0), (Hold::FirstOrder, 3.0)] {
        let variant = Variant { hold, watch: Watch::Between, ..EXACT };
        let order = order(&variant, [5e-3, 1e-2, 2e-2], |errors| errors.end_effector);
        assert!((order - expected).abs() < 0.2, "{hold:?}: order {order}");
    }
}

#[test]
fn a_controller_that_steps_first_is_a_step_ahead() {
    let variant = Variant { order: Order::ControllerFirst, ..EXACT };
    let order = order(&variant, [5e-4, 1e-3, 2e-3], |errors| errors.end_effector);
    assert!((order - 1.0).abs() < 0.1, "order {order}");
}

#[test]
fn a_sampled_autopilot_costs_nothing_if_the_controller_knows() {
    let [known] = errors(&Variant { pilot: Pilot::Sampled, ..EXACT }, [1e-3]);
    let [unknown] = errors(&Variant { pilot: Pilot::SampledUnknown, ..EXACT }, [1e-3]);
    assert!(known.end_effector <= 1e-11, "{known:?}");
    assert!(unknown.end_effector >= 1e-5, "{unknown:?}");
}

#[test]
fn every_variant_has_its_own_name() {
    let names: std::collections::HashSet<String> = VARIANTS.iter().map(Variant::name).collect();
    assert_eq!(names.len(), VARIANTS.len());
}
