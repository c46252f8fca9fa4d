//! Recordings made by hand, and what is to be said of them.

use std::time::Duration;

use uam::parameters::Actuation;
use uam::reference::ReferenceKind;
use uam::scenarios::{Scenario, find};

use super::*;
use crate::host::record::{Names, Recording};

const COLUMNS: [&str; 9] = [
    "end_effector.x",
    "end_effector.y",
    "reference.x",
    "reference.y",
    "base.x",
    "base.y",
    "base.roll",
    "autopilot.thrust",
    "ik.status",
];

/// A hover of 20 seconds; `change` may set a value at a share of that time.
fn run(scenario: Scenario, change: impl Fn(&str, f64) -> Option<f64>) -> Run {
    let mut recording = Recording::new(COLUMNS, 11);
    for n in 0..=10 {
        let share = f64::from(n) / 10.0;
        let usual = |name: &str| match name {
            "autopilot.thrust" => 50.0,
            "ik.status" => 1.0,
            _ => 0.0,
        };
        recording.push(20.0 * share, COLUMNS.map(|name| change(name, share).unwrap_or_else(|| usual(name))));
    }
    Run { scenario, recording, stopped: None, elapsed: Duration::ZERO }
}

fn verdict(change: impl Fn(&str, f64) -> Option<f64>) -> Verdict {
    Verdict::of(&run(find("pick-up").unwrap(), change)).unwrap()
}

fn number_of(status: Status) -> f64 {
    f64::from(status.number())
}

#[test]
fn a_path_that_is_followed_is_said_to_be_so_with_how_well() {
    let verdict = verdict(|name, share| (name == "end_effector.x").then_some(3e-5 * share));
    assert!(verdict.is_good(), "{verdict}");
    assert!(verdict.sentence.contains("within 3.0e-5 m of its reference for 20.0 s"), "{verdict}");
}

#[test]
fn a_path_that_is_lost_is_said_to_be_so_from_when_on_and_why() {
    let verdict = verdict(|name, share| match name {
        "end_effector.y" if share > 0.55 => Some(-0.02 * share),
        "ik.status" if share > 0.45 => Some(number_of(Status::RateLimited)),
        _ => None,
    });
    assert!(!verdict.followed && verdict.doubts.is_empty());
    assert_eq!(
        verdict.sentence,
        "The path was NOT followed from 12.0 s on: rates are at their limits (ik.status says rate_limited). The end effector \
         is off its reference by 20.0 mm at most, and by 20.0 mm at the end."
    );
}

#[test]
fn a_path_that_is_met_again_is_missed_for_a_while() {
    let verdict = verdict(|name, share| (name == "end_effector.x" && (0.25..0.45).contains(&share)).then_some(0.1));
    assert!(verdict.sentence.contains("between 6.00 and 10.0 s: the controller foresaw nothing of it"), "{verdict}");
    assert!(verdict.sentence.ends_with("by 1e-9 m at the end."), "{verdict}");
}

/// A number that is none is not near anything.
#[test]
fn what_is_no_number_was_not_followed() {
    assert!(!verdict(|name, share| (name == "end_effector.x" && share > 0.95).then_some(f64::NAN)).followed);
}

/// The status of a row is about the interval after it: that of the row itself comes too late.
#[test]
fn the_reason_is_what_was_planned_before() {
    let verdict = verdict(|name, share| match name {
        "end_effector.x" if share > 0.55 => Some(0.1),
        "ik.status" if share > 0.55 => Some(number_of(Status::CatchingUp)),
        _ => None,
    });
    assert!(verdict.sentence.contains("foresaw nothing"), "{verdict}");
}

#[test]
fn every_status_that_gives_up_the_path_has_a_reason_that_names_it() {
    for item in Status::Ok.items() {
        let mut status = Status::Ok;
        let number = (1..).zip(Status::Ok.items()).find(|(_, other)| other.name == item.name).unwrap().0;
        status.choose(number);
        assert_eq!(status_of(f64::from(number)), status);
        assert_eq!(why(status).contains(item.name), !status.keeps_path() || status == Status::Ok, "{}", item.name);
    }
}

/// Each thing that looks wrong, made by one number, is said in one sentence.
#[test]
fn what_looks_wrong_is_said() {
    let flight: [(&str, f64, &str); 4] = [
        ("autopilot.thrust", -1e-3, "The thrust falls below zero at 12.0 s"),
        ("base.roll", -0.8, "rolls beyond 45 degrees at 12.0 s"),
        ("base.y", -1200.0, "1 m from where it began at 12.0 s, and 1200.0 m below it"),
        ("base.x", 1.1, "drifts away sideways"),
    ];
    for (wrong, value, expected) in flight {
        let verdict = verdict(|name, share| (name == wrong && share > 0.55).then_some(value));
        let said = verdict.doubts.join("\n");
        assert!(verdict.doubts.len() == 1 && said.contains(expected), "{said}");
    }
}

/// A swing of the UAV that goes on, and a path that does.
#[test]
fn what_has_not_come_to_its_end_is_said() {
    let swings = verdict(|name, share| (name == "base.x" && share > 0.95).then_some(0.1));
    assert!(swings.doubts.len() == 1 && swings.doubts[0].contains("not come to rest along x"), "{swings}");
    let mut longer = find("pick-up").unwrap();
    longer.parameters.reference.legs[2].start = 12.0;
    let doubts = Verdict::of(&run(longer, |_, _| None)).unwrap().doubts;
    assert!(
        doubts.iter().any(|doubt| doubt == "The run ends after 20.0 s, while the path goes on until 21.0 s."),
        "{doubts:?}"
    );
}

fn doubts(change: impl FnOnce(&mut Scenario)) -> Vec<String> {
    let mut scenario = find("pick-up").unwrap();
    change(&mut scenario);
    Verdict::of(&run(scenario, |_, _| None)).unwrap().doubts
}

/// What `check` finds is said of the run, too, with what to change.
#[test]
fn what_could_be_known_beforehand_is_said() {
    let expect = |doubts: Vec<String>, expected: &[&str]| {
        assert_eq!(doubts.len(), expected.len(), "{doubts:?}");
        for (doubt, expected) in doubts.iter().zip(expected) {
            assert!(doubt.contains(expected), "{doubt}");
        }
    };
    expect(doubts(|scenario| scenario.parameters.reference.kind = ReferenceKind::External), &["external_reference.x"]);
    expect(
        doubts(|scenario| scenario.parameters.joints[1].actuation = Actuation::Torque),
        &["joint[2].torque_command"],
    );
    expect(doubts(|scenario| scenario.parameters.joints[1].upper = 1.0), &["knows no stops"]);
    expect(doubts(|scenario| scenario.parameters.support.height += 0.01), &["support.height"]);
    expect(doubts(|scenario| scenario.parameters.joints[2].start = 45.0), &["\"joint[3].start\" = 0.7854"]);
}

/// Whatever is recorded of a run anyway is enough for its verdict.
#[test]
fn all_that_is_read_is_recorded() {
    let names = Names::standard(find("pick-up").unwrap().structure);
    assert!(COLUMNS.iter().all(|column| names.plant.iter().chain(&names.controller).any(|name| name == column)));
}
