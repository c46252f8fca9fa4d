//! The claims of the thesis on the coupled FMUs, and the report of the pick-up.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

mod common;

use fmu_build::claims::{BASE_MOTION, Quantity};
use fmu_build::coupling::{Order, Schedule};
use fmu_build::record::Names;
use fmu_build::report;
use fmu_build::run::run;
use fmu_build::study::{self, Case, DISCRETIZATIONS};
use uam::options::Choice;
use uam::scenarios::catalogue;

/// Chapter 2. Two statements do not hold. With vertical thrust, the error along x grows linearly after the
/// grasp, but to 0.15 mm only. With the step of the thesis, the second singular configuration of 2.5a costs more
/// than 1 mm: how much depends on how close it is passed.
#[test]
fn following_a_path_although_the_base_moves_is_as_the_thesis_says() {
    let run = |id: &str| {
        let scenario = uam::scenarios::find(id).unwrap();
        let pair = if scenario.structure.links == 2 { common::two_links() } else { common::pair() };
        Case::run(&pair, scenario, &|| {}).unwrap()
    };
    let cases: Vec<Case> = catalogue()
        .unwrap()
        .iter()
        .filter(|scenario| scenario.id.starts_with('2'))
        .map(|scenario| run(&scenario.id))
        .collect();
    let case = |id: &str| cases.iter().find(|case| case.scenario.id == id).unwrap();
    let table = study::table(&cases);

    let mut wrong = Vec::new();
    for claim in BASE_MOTION {
        for (run, discretization) in case(claim.scenario).runs.iter().zip(DISCRETIZATIONS) {
            assert!(run.stopped.is_none(), "{}", claim.scenario);
            if !claim.agrees.contains(&claim.quantity.measure(&run.recording)) {
                wrong.push((claim.scenario, claim.quantity, discretization.name()));
            }
        }
    }
    let expected = [
        ("2.3a", Quantity::FinalErrorX, "euler"),
        ("2.3a", Quantity::FinalErrorX, "exact"),
        ("2.5a", Quantity::TrackingError, "euler"),
    ];
    assert_eq!(wrong, expected, "\n{table}");

    for i in 0..DISCRETIZATIONS.len() {
        let measure = |id: &str, quantity: Quantity| quantity.measure(&case(id).runs[i].recording);
        // Predicting the altitude takes an order of magnitude off the error of 2.2b.
        assert!(measure("2.3a", Quantity::ErrorY) < 0.1 * measure("2.2b", Quantity::ErrorY), "\n{table}");
        // Three times as fast: more roll, less way of the UAV.
        assert!(measure("2.3b", Quantity::Roll) > measure("2.3a", Quantity::Roll), "\n{table}");
        assert!(measure("2.3b", Quantity::FarthestRight) < measure("2.3a", Quantity::FarthestRight), "\n{table}");
        // The arm's vertical momentum: y improves from centimetres to a millimetre.
        assert!(measure("2.4b", Quantity::ErrorY) < 0.1 * measure("2.4a", Quantity::ErrorY), "\n{table}");
    }
    // Where the prediction is what the plant is, and exact, nothing but rounding is left.
    for id in ["2.1a", "2.5a", "2.5b"] {
        let error = Quantity::TrackingError.measure(&case(id).exact().recording);
        assert!(error <= 1e-9, "{id}: {error}");
    }
}

#[test]
fn the_pick_up_is_as_the_thesis_says() {
    let cases: Vec<Case> = study::pick_up()
        .unwrap()
        .into_iter()
        .map(|scenario| Case::run(&common::pair(), scenario, &|| {}).unwrap())
        .collect();
    let table = study::table(&cases);
    let (statements, agreeing) = table.agreement();
    assert!(statements >= 20);
    assert_eq!(statements, agreeing, "\n{table}");
    for case in &cases {
        assert!(case.runs.iter().all(|run| run.stopped.is_none()), "{}", case.scenario.id);
        if case.scenario.id != "4.3c-minimum-norm" {
            let error = Quantity::TrackingError.measure(&case.exact().recording);
            assert!(error <= 1e-9, "{}: {error}", case.scenario.id);
        }
    }

    let page = report::pick_up::report(&cases).unwrap().html();
    // Base, joints and controls have three, three and two panels; twice the base; two strips of the arm.
    assert_eq!(page.matches("<svg").count(), 2 + 3 + 1 + 3 + 2 + 1 + 1 + 3);
    let addresses = page.matches("http").count() - page.matches("http://www.w3.org/2000/svg").count();
    assert_eq!(addresses, 0, "the page must not need the network");
    assert!(!page.contains("NaN") && !page.contains("inf "));
}

#[test]
fn ten_milliseconds_are_enough_without_touching_the_sample_time() {
    for scenario in study::pick_up().unwrap().iter().take(2) {
        let schedule = Schedule::new(0.0, scenario.duration, 0.01).unwrap();
        let names = Names::standard(scenario.structure);
        let run = run(&common::pair(), scenario, &schedule, Order::Parallel, &names, &|| {}).unwrap();
        let error = Quantity::TrackingError.measure(&run.recording);
        assert!(error <= 5e-7, "{}: {error}", scenario.id);
    }
}
