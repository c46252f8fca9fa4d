//! Scenario files: what is read, what is refused with its line, and that nothing is lost on the way to a file.

#![allow(clippy::unwrap_used)] // in helpers, too

use proptest::prelude::*;
use uam::parameters::Balance;
use uam::scenarios::{Error, Extent, Scenario, catalogue, default_parameters, find};
use uam::{Parameters, Structure};

const SMALL: &str = r#"id = "mine"
title = "A light payload"
duration = 5
[structure]
links = 2
[parameters]
payload.mass = 0.1
"joint[1].start" = -0.5
ik.discretization = "euler"
"#;

/// Reads a text that must be refused.
#[track_caller]
fn refusal(text: &str) -> String {
    Scenario::read(text).unwrap_err().to_string()
}

/// The refusal of [`SMALL`] with `line`, from 1, replaced by `text`.
#[track_caller]
fn changed(line: usize, text: &str) -> String {
    let lines: Vec<&str> = SMALL.lines().enumerate().map(|(i, old)| if i + 1 == line { text } else { old }).collect();
    refusal(&lines.join("\n"))
}

#[test]
fn a_file_changes_the_start_values() {
    let scenario = Scenario::read(SMALL).unwrap();
    let structure = Structure::new(2, Balance::None).unwrap();
    let mut expected = default_parameters(structure);
    expected.payload.mass = 0.1;
    expected.joints[0].start = -0.5;
    expected.ik.discretization = uam::parameters::Discretization::Euler;
    assert_eq!((scenario.structure, scenario.duration, scenario.step), (structure, 5.0, 1e-3));
    assert_eq!(scenario.parameters, expected);
}

#[test]
fn a_file_may_be_based_on_a_scenario() {
    let scenario = Scenario::read("id = 'heavy'\nbased_on = '4.3a'\nparameters.payload.mass = 1").unwrap();
    let mut expected = find("4.3a").unwrap();
    expected.id = "heavy".to_owned();
    expected.parameters.payload.mass = 1.0;
    assert_eq!(scenario, expected);
}

#[test]
fn tables_dots_and_quotes_mean_the_same() {
    let ways = [
        "parameters.autopilot.roll.kd = 9.0",
        "[parameters]\nautopilot.roll.kd = 9",
        "[parameters]\n\"autopilot.roll.kd\" = 9.0",
        "[parameters.autopilot.roll]\nkd = 9e0",
        "[parameters]\nautopilot = { roll = { kd = 9.0 } }",
    ];
    for way in ways {
        let scenario = Scenario::read(&format!("id = 'a'\nbased_on = '4.3b'\n{way}")).unwrap();
        assert_eq!(scenario.parameters, find("4.3c-extended-jacobian").unwrap().parameters, "{way}");
    }
}

#[test]
fn what_is_not_understood_is_refused_with_its_line() {
    let cases = [
        (1, "id = 3", "line 1: `id` must be a short name of letters, digits, `.`, `-` and `_`, in quotes, but is 3"),
        (1, "id = '../mine'", "line 1: `id` must be a short name"),
        (2, "titel = 'A'", "line 2: unknown key `titel`; did you mean `title`?"),
        (3, "duration = -1", "line 3: `duration` must be a number of seconds above 0, but is -1"),
        (3, "duration = inf", "line 3: `duration` must be"),
        (3, "duration = 1e-6", "line 3: `duration` must be"),
        (3, "duration = 5\nstep = 7.0", "line 4: `step` must be a number of seconds above 0, at most the duration"),
        (3, "duration = 5\ngravity = 1", "line 4: unknown key `gravity`; did you mean `parameters.gravity`?"),
        (3, "duration = 5\nbased_on = '4.3x'", "line 4: there is no scenario `4.3x`; did you mean `4.3"),
        (3, "duration = 5\nbased_on = '4.3a'", "line 6: `structure.links` must be that of the scenario"),
        (5, "links = 7", "line 5: `structure.links` must be a whole number from 1 to 6, but is 7"),
        (5, "links = 2.0", "line 5: `structure.links` must be a whole number"),
        (5, "links = 2\nbalance = 'disc'", "line 6: `structure.balance` must be \"none\""),
        (
            7,
            "payload.mas = 0.1",
            "line 7: a vehicle with 2 links has no parameter `payload.mas`; did you mean `payload.mass`",
        ),
        (
            7,
            "\"link[3].mass\" = 1.0",
            "line 7: a vehicle with 2 links has no parameter `link[3].mass`; did you mean `link[",
        ),
        (7, "payload.mass = -0.1", "line 7: `payload.mass` must be a finite number, at least 0 [kg], but is -0.1"),
        (7, "payload.mass = nan", "line 7: `payload.mass` must be a finite number"),
        (
            7,
            "payload.mass = '1 kg'",
            "line 7: `payload.mass` must be a finite number, at least 0 [kg], but is \"1 kg\"",
        ),
        (7, "payload = 1.0", "line 7: a vehicle with 2 links has no parameter `payload`"),
        (7, "payload.mass = 0.1\n\"payload.mass\" = 0.2", "line 8: `parameters.payload.mass` stands in line 7 already"),
        (7, "payload.mass = 0.1\npayload.mass = 0.2", "line 8: "),
        (7, "payload.mass = ", "line 7: "),
        (
            9,
            "ik.discretization = 'rk4'",
            "line 9: `ik.discretization` must be one of \"euler\", \"exact\", but is \"rk4\"",
        ),
        (9, "ik.discretization = 1", "line 9: `ik.discretization` must be one of"),
        (9, "\"reference.leg[1].ramp\" = 2.0", "line 9: reference.leg[1].ramp = 2 does not go together"),
    ];
    for (line, text, expected) in cases {
        let found = changed(line, text);
        assert!(found.starts_with(expected), "{text}: {found}");
    }
}

#[test]
fn what_is_missing_is_named() {
    assert!(refusal("").starts_with("`id` is missing: a short name"));
    assert!(refusal("id = 'a'").starts_with("`title` is missing"));
    assert!(refusal("id = 'a'\ntitle = 'b'").starts_with("`duration` is missing"));
    assert!(refusal("id = 'a'\ntitle = 'b'\nduration = 1").starts_with("`structure.links` is missing"));
    let late_ramp = "id = 'a'\nbased_on = '4.3b'\n[parameters]\n\"reference.leg[1].duration\" = 0.2";
    assert!(refusal(late_ramp).starts_with("reference.leg[1].ramp = 0.55 does not go together"));
}

#[test]
fn unknown_scenarios_are_answered_with_similar_ones() {
    let Err(Error::NoScenario { near, .. }) = find("4.3") else { panic!("there is none") };
    assert!(near.iter().all(|id| id.starts_with("4.3")) && !near.is_empty(), "{near:?}");
    assert_eq!(find("hover").unwrap_err().to_string(), "there is no scenario `hover`");
}

#[test]
fn every_scenario_survives_being_written_and_read() {
    for scenario in catalogue().unwrap() {
        for extent in [Extent::Changes, Extent::Everything] {
            assert_eq!(Scenario::read(&scenario.write(extent)).unwrap(), scenario, "{}", scenario.id);
        }
    }
}

#[test]
fn written_files_hold_what_was_asked_for() {
    let scenario = find("4.3c-minimum-norm").unwrap();
    let changes = scenario.write(Extent::Changes);
    assert!(changes.contains("autopilot.roll.kd = 9.0 #") && changes.contains("[N.m.s/rad]"), "{changes}");
    assert!(changes.contains("ik.resolution = \"minimum_norm\" #") && !changes.contains("gravity"), "{changes}");
    let everything = scenario.write(Extent::Everything);
    let table = Parameters::table(scenario.structure);
    assert!(table.variables().iter().all(|variable| everything.contains(&variable.name)), "{everything}");
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in "\\PC*") {
        let _ = Scenario::read(&text);
    }

    #[test]
    fn any_damage_is_read_or_refused(position in 0..SMALL.len(), replacement in "\\PC{0,4}") {
        let mut text = SMALL.to_owned();
        text.replace_range(position..=position, &replacement);
        let _ = Scenario::read(&text);
    }

    #[test]
    fn any_title_survives(title in "\\PC*|[\\x00-\\x7f]*") {
        let mut scenario = find("4.3b").unwrap();
        scenario.title = title;
        prop_assert_eq!(Scenario::read(&scenario.write(Extent::Changes)).unwrap(), scenario);
    }
}

#[test]
fn a_scenario_with_changes_is_the_same_but_for_these() {
    let known = find("4.4b").unwrap();
    let changed = known
        .with([("counterweight.time_constant", "1e-1"), ("ik.discretization", "euler"), ("duration", "12")])
        .unwrap();
    let mut expected = Scenario { duration: 12.0, ..known.clone() };
    expected.parameters.counterweight.time_constant = 0.1;
    expected.parameters.ik.discretization = uam::parameters::Discretization::Euler;
    assert_eq!(changed, expected);

    let refusal = |name: &str, value: &str| known.with([(name, value)]).unwrap_err().to_string();
    assert!(refusal("counterweight.strok", "1").contains("did you mean `counterweight.stroke`"));
    assert!(refusal("joint[1].rate_limit", "fast").contains("`joint[1].rate_limit` must be a finite number, above 0"));
    assert!(refusal("step", "-1").contains("`step` must be a number of seconds above 0"));
    assert!(!refusal("step", "-1").contains("line"));
}
