//! Runs of the FMUs that users have believed although they should not have, and what is said of them first.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

mod common;

use fmu_build::host::coupling::Schedule;
use fmu_build::host::record::Names;
use fmu_build::host::run::run;
use fmu_build::study::variation::vary;
use fmu_build::study::verdict::Verdict;
use uam::scenarios::{Scenario, find};

fn verdict(scenario: &Scenario) -> Verdict {
    let schedule = Schedule::new(0.0, scenario.duration, scenario.step).unwrap();
    let pair = common::pair_of(scenario.structure);
    let run = run(pair, scenario, &schedule, &Names::standard(scenario.structure), &|| ()).unwrap();
    Verdict::of(&run).unwrap()
}

fn changed(changes: &[(&str, &str)]) -> Verdict {
    verdict(&vary(&find("pick-up").unwrap(), changes).unwrap())
}

#[test]
fn the_pick_up_is_followed_and_nothing_looks_wrong() {
    let verdict = changed(&[]);
    assert!(verdict.is_good(), "{verdict}");
    assert!(verdict.sentence.starts_with("The path was followed: the end effector stays within 1e-9 m"), "{verdict}");
}

#[test]
fn a_uav_that_nobody_flies_is_said_to_fall() {
    let verdict = changed(&[("autopilot.mode", "external"), ("duration", "3")]);
    assert!(!verdict.followed);
    assert!(verdict.doubts[0].contains("autopilot.thrust_command"), "{verdict}");
    assert!(verdict.to_string().contains("does not hold its altitude"), "{verdict}");
}

#[test]
fn a_path_that_nobody_gives_is_named() {
    let verdict = changed(&[("reference.kind", "external"), ("duration", "3")]);
    assert!(verdict.doubts[0].contains("external_reference.x"), "{verdict}");
}

#[test]
fn a_path_out_of_reach_is_not_followed_because_the_arm_is_singular() {
    let verdict = changed(&[("reference.leg[1].dy", "-0.6"), ("duration", "4")]);
    assert!(verdict.sentence.contains("NOT followed from") && verdict.sentence.contains("path_damped"), "{verdict}");
}

#[test]
fn degrees_for_radians_are_recognized() {
    let verdict = changed(&[("joint[2].start", "60"), ("duration", "1")]);
    assert!(verdict.doubts[0].contains("\"joint[2].start\" = 1.0472"), "{verdict}");
}

/// What happens to whoever changes the arm and keeps payload and support of the thesis.
#[test]
fn a_payload_that_nobody_asked_for_is_named() {
    let verdict = changed(&[("link[3].length", "0.1"), ("duration", "4")]);
    assert!(verdict.doubts.iter().any(|doubt| doubt.contains("support.height = ")), "{verdict}");
}
