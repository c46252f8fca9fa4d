//! The claims of the thesis on the coupled FMUs, and the report of the pick-up.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

mod common;

use std::sync::LazyLock;

use fmu_build::host::coupling::Schedule;
use fmu_build::host::record::Names;
use fmu_build::report;
use fmu_build::study::claims::{self, Quantity, peak};
use fmu_build::study::variation::vary;
use fmu_build::study::{self, Case, Summary};
use uam::autopilot::AutopilotMode;
use uam::parameters::{BaseModel, PathAxes};
use uam::scenarios::{Scenario, find, of_the_thesis};

/// All simulations of the thesis, run once for all tests.
static SUMMARIES: LazyLock<Vec<Summary>> = LazyLock::new(|| run(of_the_thesis().unwrap()));

fn run(scenarios: Vec<Scenario>) -> Vec<Summary> {
    study::run_all(scenarios, &|scenario| Ok(common::pair_of(scenario.structure)), &|| {}).unwrap()
}

/// Every statement holds with both discretizations, but for those that are marked as deviations: none of these
/// holds by chance.
#[test]
fn every_statement_of_the_thesis_holds_or_is_a_known_deviation() {
    let table = study::table(&SUMMARIES);
    for summary in SUMMARIES.iter() {
        let id = &summary.scenario.id;
        for outcome in &summary.outcomes {
            assert_eq!(outcome.complaint, None, "{id}");
        }
        let is_about = |claim: &claims::Claim| claim.scenario == id || claim.compared_with == Some(id);
        assert!(claims::all().any(is_about), "the thesis says nothing of {id}");
    }
    for claim in claims::all() {
        let values = study::values(&SUMMARIES, claim).unwrap();
        for (i, value) in values.into_iter().enumerate() {
            assert_eq!(value.is_none(), NOTHING_LEFT.contains(&(claim.scenario, claim.quantity, i)), "{claim:?}");
            let Some(value) = value else { continue };
            // The time of what never comes.
            assert!(value.is_finite() || claim.quantity == Quantity::LostAt, "{claim:?}: {value}");
            assert_eq!(claim.agrees(value), claim.should_agree(i), "{claim:?}: {value}\n{table}");
        }
    }
}

/// Ratios of what is nothing but rounding in both simulations, with the discretization at this place.
const NOTHING_LEFT: [(&str, Quantity, usize); 4] = [
    ("3.4-2", Quantity::ErrorX, 1),
    ("3.6c", Quantity::Moment, 1),
    ("3.6c-segment", Quantity::Moment, 1),
    ("3.7", Quantity::EarlyMoment, 1),
];

/// What is said to reproduce a statement that does not hold does so.
#[test]
fn deviations_go_away_with_the_changes_named() {
    let deviations = claims::all().filter_map(|claim| Some((claim, claim.deviation?)));
    let known: Vec<_> = deviations.filter(|(_, deviation)| !deviation.holds_with.is_empty()).collect();
    assert!(known.len() >= 8);
    let varied = known.iter().map(|(claim, deviation)| {
        assert!(claim.compared_with.is_none());
        vary(&find(claim.scenario).unwrap(), deviation.holds_with).unwrap()
    });
    for ((claim, deviation), summary) in known.iter().zip(run(varied.collect())) {
        for (outcome, deviates) in summary.outcomes.iter().zip(deviation.of) {
            let value = outcome.numbers.get(claim.quantity);
            assert!(claim.agrees(value) || !deviates, "{claim:?}: {value}");
        }
    }
}

/// Where the prediction is all that the plant does, and exact, nothing but rounding is left.
#[test]
fn exact_plans_leave_no_error_but_for_known_reasons() {
    for summary in SUMMARIES.iter() {
        let Scenario { id, parameters, .. } = &summary.scenario;
        let reason = NOT_FOLLOWED.iter().find(|(scenario, _)| scenario == id).map(|(_, reason)| reason);
        let ideal = parameters.ik.base_model == BaseModel::Ideal && parameters.autopilot.mode == AutopilotMode::Ideal;
        if parameters.ik.base_model == BaseModel::Full || ideal {
            let [_, exact] = &summary.outcomes;
            let error = exact.numbers.get(match parameters.ik.path_axes {
                PathAxes::Both => Quantity::TrackingError,
                PathAxes::Horizontal => Quantity::ErrorX,
            });
            assert_eq!(error > 1e-9, reason.is_some(), "{id}: {error:e}; {reason:?}");
        } else {
            assert_eq!(reason, None, "{id} predicts less than the plant does");
        }
    }
}

/// Simulations with an error though the base is predicted in full, and why.
const NOT_FOLLOWED: [(&str, &str); 3] = [
    ("3.6b", "the first joint has no motor, and the controller does not know"),
    ("3.6b-segment", "the first joint has no motor, and the controller does not know"),
    ("4.3c-minimum-norm", "swings until the path is out of reach"),
];

#[test]
fn the_pick_up_is_as_the_thesis_says() {
    let cases: Vec<Case> = study::pick_up()
        .unwrap()
        .into_iter()
        .map(|scenario| Case::run(&common::pair(), scenario, &|| {}).unwrap())
        .collect();
    let table = study::pick_up_table(&cases.iter().map(|case| case.summary().unwrap()).collect::<Vec<_>>());
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
        let run = fmu_build::host::run::run(&common::pair(), scenario, &schedule, &names, &|| {}).unwrap();
        // The first interval is planned before the host's step is known.
        let errors = run.recording.tracking_error().unwrap();
        assert!(errors[1] <= 5e-8, "{}: {}", scenario.id, errors[1]);
        assert!(peak(errors[2..].iter().copied()) <= 1e-11, "{}: {errors:?}", scenario.id);
    }
}
