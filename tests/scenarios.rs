//! Scenario files: what is read, what is refused with its line, and that nothing is lost on the way to a file.

#![allow(clippy::unwrap_used)] // in helpers, too

use proptest::prelude::*;
use uam::fmi::Model;
use uam::parameters::Balance;
use uam::scenarios::{Error, Extent, Scenario, catalogue, default_parameters, find};
use uam::units::{controller::ControllerUnit, plant::PlantUnit};
use uam::variables::Causality;
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

/// 60 degrees are pi / 3, 5 cm are 0.05 m; numbers alone are in SI units.
#[test]
fn a_number_may_stand_with_its_unit() {
    let text = "id = 'a'\nbased_on = '4.3b'\nduration = '0.5 min'\nstep = '2 ms'
        [parameters]\n'joint[2].start' = '60 deg'\nmount.x = '5 cm'\nsupport.stiffness = '0.4 kN/m'";
    let scenario = Scenario::read(text).unwrap();
    assert_eq!((scenario.duration, scenario.step), (30.0, 2e-3));
    let parameters = scenario.parameters;
    assert!((parameters.joints[1].start - std::f64::consts::FRAC_PI_3).abs() < 1e-15);
    assert_eq!((parameters.mount.x, parameters.support.stiffness), (0.05, 400.0));
}

/// A line of its own counts more, wherever it stands.
#[test]
fn a_star_stands_for_every_member_of_a_family() {
    for lines in ["'joint[2].weight' = 3\n'joint[*].weight' = 2", "'joint[*].weight' = 2\n'joint[2].weight' = 3"] {
        let text = format!("id = 'a'\nbased_on = '4.3b'\n[parameters]\n{lines}\n'reference.leg[*].ramp' = '50 ms'");
        let parameters = Scenario::read(&text).unwrap().parameters;
        assert_eq!(parameters.joints[..3].iter().map(|joint| joint.weight).collect::<Vec<_>>(), [2.0, 3.0, 2.0]);
        assert!(parameters.reference.legs.iter().all(|leg| leg.ramp == 0.05));
    }
}

#[test]
fn what_is_not_understood_is_refused_with_its_line() {
    let cases = [
        (
            7,
            "\"joint[1].lower\" = '30 degrees'",
            "line 7: `joint[1].lower` must be a finite number [rad], or with its unit as in \"2.5 deg\", but is \"30 degrees\"",
        ),
        (
            7,
            "gravity = '9.8 N'",
            "line 7: `gravity` must be a finite number, at least 0 [m/s2], or with its unit as in",
        ),
        (
            7,
            "\"link[*].mas\" = 1",
            "line 7: a vehicle with 2 links has no parameter `link[*].mas`; did you mean `link[1].mass`",
        ),
        (7, "\"joint[*].weight\" = 0", "line 7: `joint[*].weight` must be a finite number, above 0"),
        (1, "id = 3", "line 1: `id` must be a short name of letters, digits, `.`, `-` and `_`, in quotes, but is 3"),
        (1, "id = '../mine'", "line 1: `id` must be a short name"),
        (2, "titel = 'A'", "line 2: unknown key `titel`; did you mean `title`?"),
        (3, "duration = -1", "line 3: `duration` must be a number of seconds above 0, but is -1"),
        (3, "duration = inf", "line 3: `duration` must be"),
        (3, "duration = 1e-6", "line 3: `duration` must be"),
        (3, "duration = 5\nstep = 7.0", "line 4: `step` must be a number of seconds above 0, at most the duration"),
        (3, "duration = 5\ngravity = 1", "line 4: unknown key `gravity`; did you mean `parameters.gravity`?"),
        (
            3,
            "duration = 5\nbased_on = '4.3x'",
            "line 4: `based_on` must be the name of a scenario of the catalogue, but there is no `4.3x`; did you mean `4.3",
        ),
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
            "payload.mass = '1 lb'",
            "line 7: `payload.mass` must be a finite number, at least 0 [kg], or with its unit as in \"2.5 kg\", but is \"1 lb\"",
        ),
        (7, "payload = 1.0", "line 7: a vehicle with 2 links has no parameter `payload`"),
        (7, "payload.mass = 0.1\n\"payload.mass\" = 0.2", "line 8: `parameters.payload.mass` stands in line 7 already"),
        (7, "payload.mass = 0.1\npayload.mass = 0.2", "line 8: `parameters.payload.mass` stands in line 7 already"),
        (2, "title = 'A'\n id = 'again'", "line 3: `id` stands in line 1 already"),
        (7, "payload = { mass = 0.1, mass = 0.2 }", "line 7: duplicate key, in `payload = { mass = 0.1, mass = 0.2 }`"),
        (6, "[parameters]\n[structure]", "line 7: duplicate key, in `[structure]`"),
        (7, "payload.mass = ", "line 7: "),
        (7, "payload.mass = NaN", "line 7: invalid float, expected `nan`, in `payload.mass = NaN`"),
        (7, "link[1].mass = 2.0", "line 7: names with brackets need quotes: `\"link[1].mass\" = 2.0`"),
        (7, "  reference.leg[2].dx=1 # m", "line 7: names with brackets need quotes: `\"reference.leg[2].dx\"=1 # m`"),
        (
            6,
            "[parameters.joint[1]]\nstart = 1.0",
            "line 6: names with brackets need quotes: `[\"parameters.joint[1]\"]`",
        ),
        (1, "id = \"a\u{7}b\"", "line 1: "),
        (
            2,
            "title = 'A'\nbased_on = 'mine.toml'",
            "line 3: `based_on` must be the name of a scenario of the catalogue",
        ),
        (
            2,
            "title = \"A\\u0007\"",
            "line 2: `title` must be one line on what happens, in quotes, without control characters",
        ),
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

/// Corrected as the message says, the file is read.
#[test]
fn the_correction_of_a_name_without_quotes_is_right() {
    for line in ["link[2].mass = 2.0", "parameters.link[2].mass = 2.0", "[parameters.link[2]]\nmass = 2.0"] {
        let text = format!("id = 'a'\nbased_on = '4.3b'\n{line}");
        let refused = refusal(&text);
        let Some((_, correct)) = refused.split_once("need quotes: `") else { panic!("{refused}") };
        let correct = text.replace(line.lines().next().unwrap(), correct.trim_end_matches('`'));
        match Scenario::read(&correct) {
            Ok(scenario) => assert_eq!(scenario.parameters.links[1].mass, 2.0, "{correct}"),
            // Outside the table of parameters, the next message says where it belongs.
            Err(error) => assert!(error.to_string().contains("did you mean `parameters.link[2].mass`"), "{error}"),
        }
    }
}

/// Whoever bases a scenario on one that there is not learns which there are.
#[test]
fn a_base_that_does_not_exist_is_answered_with_those_that_do() {
    let refused = refusal("id = 'a'\nbased_on = 'hover'");
    for scenario in catalogue().unwrap() {
        assert!(refused.contains(&format!("`{}`", scenario.id)), "{refused}");
    }
}

/// Every variable of the units that is no parameter is called what it is; an input with the way to drive it.
#[test]
fn variables_that_are_no_parameters_are_called_what_they_are() {
    let structure = find("4.3b").unwrap().structure;
    let tables = [
        ControllerUnit::table(structure).variables().iter().map(|v| (v.name.clone(), v.causality)).collect::<Vec<_>>(),
        PlantUnit::table(structure).variables().iter().map(|v| (v.name.clone(), v.causality)).collect(),
    ];
    let inputs: Vec<_> = tables.iter().flatten().filter(|(_, causality)| *causality == Causality::Input).collect();
    for (name, causality) in tables.iter().flatten().filter(|(_, causality)| *causality != Causality::Parameter) {
        for place in ["parameters.", ""] {
            let refused = refusal(&format!("id = 'a'\nbased_on = '4.3b'\n{place}\"{name}\" = 1.0"));
            let is_input = *causality == Causality::Input || inputs.iter().any(|(input, _)| input == name);
            let role = if is_input { "is an input of uam_" } else { "is an output of uam_" };
            assert!(refused.starts_with(&format!("line 3: `{name}` {role}")), "{name}: {refused}");
            assert_eq!(is_input, refused.contains("hosts set it between steps, or connect"), "{refused}");
        }
    }
    let refused = find("4.3b").unwrap().with([("external_reference.vx", "1")]).unwrap_err().to_string();
    assert!(refused.contains("it acts with reference.kind = \"external\""), "{refused}");
}

/// What is no number at all is refused under the name that was given, for every parameter.
#[test]
fn numbers_that_are_none_are_refused_by_name() {
    let known = find("4.4b").unwrap();
    for variable in Parameters::table(known.structure).variables() {
        for value in ["nan", "NaN", "-nan", "inf", "-inf", "infinity", "1e999"] {
            let refused = known.with([(variable.name.as_str(), value)]).unwrap_err().to_string();
            assert!(refused.starts_with(&format!("`{}` must be ", variable.name)), "{value}: {refused}");
        }
    }
}

#[test]
fn methods_that_do_not_go_together_are_refused_with_their_line() {
    let refused = refusal("id = 'a'\nbased_on = '4.3b'\nparameters.ik.path_axes = 'horizontal'");
    assert!(refused.starts_with("line 3: ik.path_axes = horizontal does not go together"), "{refused}");
    let refused = refusal("id = 'a'\nbased_on = '4.3b'\nparameters.ik.resolution = 'acceleration_level'");
    assert!(refused.contains("ik.hold = zero_order") && refused.contains("acceleration_level"), "{refused}");
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

    /// A title is one line, and can stand in any document.
    #[test]
    fn any_title_survives_or_is_refused_for_its_control_characters(title in "\\PC*|[\\x00-\\x9f\u{fffe}\u{ffff}]*") {
        let mut scenario = find("4.3b").unwrap();
        scenario.title = title.clone();
        let text = scenario.write(Extent::Changes);
        if title.contains(|c: char| c.is_control() || c == '\u{fffe}' || c == '\u{ffff}') {
            let refused = Scenario::read(&text).unwrap_err().to_string();
            prop_assert!(refused.contains("`title` must be one line on what happens"), "{}", refused);
            prop_assert!(!refused.contains(char::is_control), "{:?}", refused);
        } else {
            prop_assert_eq!(Scenario::read(&text).unwrap(), scenario);
        }
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
