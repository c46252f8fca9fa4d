//! The claims of the thesis on the coupled FMUs, and the report of the pick-up.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

mod common;

use fmu_build::claims::{self, Quantity};
use fmu_build::coupling::{Order, Schedule};
use fmu_build::record::Names;
use fmu_build::report;
use fmu_build::run::run;
use fmu_build::study::{self, Case};
use uam::scenarios::catalogue;

/// Every statement holds with both discretizations, but for those that are marked as deviations: none of these
/// holds by chance.
#[test]
fn every_statement_of_the_thesis_holds_or_is_a_known_deviation() {
    let scenarios = catalogue().unwrap();
    let summaries = study::run_all(scenarios, &|structure| Some(common::pair_of(structure)), &|| {}).unwrap();
    let table = study::table(&summaries);
    for summary in &summaries {
        let id = &summary.scenario.id;
        for outcome in &summary.outcomes {
            assert_eq!(outcome.complaint, None, "{id}");
        }
        let is_about = |claim: &claims::Claim| claim.scenario == id || claim.compared_with == Some(id);
        assert!(claims::all().any(is_about), "the thesis says nothing of {id}");
    }
    for claim in claims::all() {
        let values = study::values(&summaries, claim).unwrap();
        for (i, value) in values.into_iter().enumerate() {
            assert!(value.is_finite() || claim.quantity == Quantity::LostAt, "{claim:?}: {value}");
            assert_eq!(claim.agrees(value), claim.should_agree(i), "{claim:?}: {value}\n{table}");
        }
    }
    // Where the prediction is what the plant is, and exact, nothing but rounding is left.
    for id in EXACT {
        let summary = summaries.iter().find(|summary| summary.scenario.id == id).unwrap();
        let error = summary.outcomes[1].numbers.get(Quantity::TrackingError);
        assert!(error <= 1e-9, "{id}: {error}");
    }
}

/// Scenarios in which the controller predicts all that the plant does, far from singular configurations and
/// limits.
const EXACT: [&str; 12] = [
    "2.1a",
    "2.5a",
    "2.5b",
    "3.6a",
    "3.6a-segment",
    "3.6c",
    "3.6c-segment",
    "4.2a",
    "4.2b",
    "4.3a",
    "4.3b",
    "4.3c-extended-jacobian",
];

#[test]
fn the_pick_up_is_as_the_thesis_says() {
    let cases: Vec<Case> = study::pick_up()
        .unwrap()
        .into_iter()
        .map(|scenario| Case::run(&common::pair(), scenario, &|| {}).unwrap())
        .collect();
    let table = study::pick_up_table(&cases.iter().map(Case::summary).collect::<Vec<_>>());
    let (statements, agreeing) = table.agreement();
    assert!(statements >= 20);
    assert_eq!(statements, agreeing, "\n{table}");
    for case in &cases {
        assert!(case.runs.iter().all(|run| run.stopped.is_none()), "{}", case.scenario.id);
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
