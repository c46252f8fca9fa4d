//! What the program answers to mistakes, and its exit codes.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use std::path::Path;
use std::process::Command;

use uam::coupling::{Schedule, Unit, in_process};
use uam::scenarios::Scenario;

/// Exit code for a command line that cannot be understood.
const USAGE: i32 = 2;

/// Exit code, standard output and error output.
fn answer(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_uam")).args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn mistakes_are_named_with_what_is_allowed() {
    let cases: [(&[&str], i32, &str); 13] = [
        (&["simulate", "4.3x"], 1, "did you mean `4.3"),
        (&["simulate", "hover"], 1, "there is no scenario `hover`"),
        (&["simulate", "4.3a", "--step", "-0.001"], 1, "the communication step must be a number of seconds from"),
        (&["simulate", "4.3a", "--step", "nan"], 1, "but is NaN"),
        (&["simulate", "4.3a", "--stop", "0"], 1, "the stop time must be"),
        (&["build", "--links", "7"], USAGE, "1 to 6 links, not 7"),
        (&["build", "--links", "x"], USAGE, "1 to 6 links"),
        (&["build", "--scenario", "4.3x"], 1, "did you mean `4.3"),
        (&["build", "--scenario", "none.toml"], 1, "cannot read none.toml"),
        (&["build", "--scenario", "4.3a", "--links", "2"], USAGE, "cannot be used with"),
        (&["fly"], USAGE, "unrecognized subcommand"),
        (&["simulate"], USAGE, "<SCENARIO>"),
        (&["completions", "abacus"], USAGE, "zsh"),
    ];
    for (arguments, expected_code, expected) in cases {
        let (code, _, error) = answer(arguments);
        assert_eq!(code, Some(expected_code), "{arguments:?}");
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
}

/// Error output of a command that must be refused before anything is built.
#[track_caller]
fn refusal(arguments: &[&str]) -> String {
    let (code, _, error) = answer(arguments);
    assert_eq!(code, Some(1), "{arguments:?}");
    assert!(!error.contains("fmi2") && !error.contains("panicked"), "{arguments:?}: {error}");
    error
}

/// The parameter is named that is to blame, in its user's words, whatever the command.
#[test]
fn mistakes_in_numbers_and_methods_name_their_parameters() {
    let cases: [(&[&str], &str); 14] = [
        (&["vary", "4.3b", "gravity=nan"], "`gravity` must be a finite number, at least 0 [m/s2], but is nan"),
        (&["vary", "4.3b", "mount.x=-inf"], "`mount.x` must be a finite number [m], but is -inf"),
        (&["vary", "4.3b", "sample_time=1e5"], "sample_time = 100000.0 makes a simulation impossible"),
        (&["vary", "4.3b", "uav.inertia=1e-9"], "uav.inertia = 1e-9 makes a simulation impossible"),
        (&["vary", "4.3b", "link[2].length=1e300"], "link[2].length = 1e300 makes a simulation impossible"),
        (
            &["vary", "2.1a", "ik.resolution=extended_jacobian"],
            "ik.resolution = extended_jacobian does not go together",
        ),
        (&["vary", "4.3b", "ik.path_axes=horizontal"], "ik.path_axes = horizontal does not go together"),
        (&["vary", "4.3b", "external_reference.x=1"], "`external_reference.x` is an input of uam_controller"),
        (&["reach", "reference.leg[1].dx=0"], "reference.leg[1].dx = 0 does not go together"),
        (&["reach", "reference.leg[1].duration=0"], "reference.leg[1].duration = 0 does not go together"),
        (&["reach", "reference.kind=circle"], "reference.kind = circle does not go together"),
        (&["reach", "reference.kind=external"], "reference.kind = external does not go together"),
        (&["reach", "gravity=NaN"], "`gravity` must be a finite number"),
        (&["vary", "4.3b", "reference.leg[*].dz=1"], "did you mean `reference.leg[1].d"),
    ];
    for (arguments, expected) in cases {
        let error = refusal(arguments);
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
}

#[test]
fn mistakes_in_files_are_named_with_their_file_and_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    for (line, expected) in [
        ("parameters.uav.inertia = 1e-9", "uav.inertia = 1e-9 makes a simulation impossible"),
        ("parameters.sample_time = 1e5", "sample_time = 100000.0 makes a simulation impossible"),
        ("parameters.uav.mass = 1\nparameters.uav.mass = 2", "line 4: `parameters.uav.mass` stands in line 3 already"),
        ("link[1].mass = 2", "line 3: names with brackets need quotes: `\"link[1].mass\" = 2`"),
        ("parameters.grasp = true", "line 3: `grasp` is an input of uam_plant"),
        ("parameters.ik.path_axes = 'horizontal'", "line 3: ik.path_axes = horizontal does not go together"),
    ] {
        std::fs::write(&file, format!("id = 'mine'\nbased_on = '4.3b'\n{line}\n")).unwrap();
        let error = refusal(&["simulate", file.to_str().unwrap(), "--out", folder.path().to_str().unwrap()]);
        assert!(error.contains(expected), "{line}: {error}");
        assert!(!expected.starts_with("line") || error.contains("mine.toml"), "{line}: {error}");
    }
}

/// Largest roll \[deg\] and largest distance of the hand from its reference \[m\], with both units in this process.
fn simulated(file: &Path) -> [f64; 2] {
    let scenario = Scenario::read(&std::fs::read_to_string(file).unwrap()).unwrap();
    let mut pair = in_process::pair(scenario.structure, &scenario.parameters).unwrap();
    let (wanted, mut reference) = pair.controller.select(&["reference.x", "reference.y"]).unwrap();
    let (names, mut found) = pair.plant.select(&["base.roll", "end_effector.x", "end_effector.y"]).unwrap();
    let schedule = Schedule::new(0.0, scenario.duration, scenario.step).unwrap();
    let (mut roll, mut error): (f64, f64) = (0.0, 0.0);
    let mut observe = |_: f64, controller: &mut _, plant: &mut _| {
        Unit::read(controller, &wanted, &mut reference)?;
        Unit::read(plant, &names, &mut found)?;
        roll = roll.max(found[0].abs().to_degrees());
        error = error.max((found[1] - reference[0]).hypot(found[2] - reference[1]));
        Ok(())
    };
    pair.run(&schedule, &mut observe).unwrap();
    [roll, error]
}

#[test]
fn a_vehicle_of_ones_own_is_level_and_follows_its_path() {
    let folder = tempfile::tempdir().unwrap();
    for wishes in [
        "--links 1",
        "--links 2",
        "--links 3",
        "--links 5",
        "--links 6",
        "--links 1 --counterweight",
        "--links 3 --counterweight",
        "--links 3 --mass 12 --link-length 0.6 --link-mass 1.5",
        "--links 2 --mass 0.8 --link-length 0.1 --link-mass 0.05",
        "--links 6 --mass 2 --inertia 0.02 --link-length 0.15 --link-mass 0.1",
    ] {
        let file = folder.path().join(wishes.replace(' ', "_") + ".toml");
        let arguments: Vec<&str> = ["init", file.to_str().unwrap()].into_iter().chain(wishes.split(' ')).collect();
        let (code, said, error) = answer(&arguments);
        assert_eq!(code, Some(0), "{wishes}: {error}");
        assert!(said.contains("check"), "{said}");
        let (code, said, error) = answer(&["check", file.to_str().unwrap()]);
        assert_eq!(code, Some(0), "{wishes}: {said}{error}");
        assert!(said.contains(": nothing looks wrong."), "{wishes}: {said}");
        let [roll, distance] = simulated(&file);
        println!("{wishes}: roll {roll} degrees, error {distance} m");
        assert!(roll < 0.2, "{wishes}: {roll} degrees");
        assert!(distance < 1e-6, "{wishes}: {distance} m");
    }
}

/// What is said of an imbalance bounds what comes of it, for the resolution that does nothing against it closely.
#[test]
fn an_unbalanced_start_rolls_the_uav_as_far_as_check_says() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    let name = file.to_str().unwrap();
    assert_eq!(answer(&["init", name]).0, Some(0));
    let text = std::fs::read_to_string(&file).unwrap();
    let (before, after) = text.split_once("\"joint[1].start\" = ").unwrap();
    let (_, after) = after.split_once(' ').unwrap();
    let unbalanced = format!("{before}\"joint[1].start\" = -0.15 {after}");
    for (method, share) in [("minimum_norm", 0.8), ("extended_jacobian", 0.0), ("least_squares", 0.0)] {
        std::fs::write(&file, unbalanced.replace("\"extended_jacobian\"", &format!("\"{method}\""))).unwrap();
        let (code, said, _) = answer(&["check", name]);
        assert_eq!(code, Some(1), "{method}: {said}");
        let (_, number) =
            said.split_once("which rolls the UAV by ").unwrap().1.split_once("which rolls the UAV by ").unwrap();
        let foretold: f64 = number.split(' ').next().unwrap().parse().unwrap();
        let [roll, _] = simulated(&file);
        assert!(roll > share * foretold && roll < 1.05 * foretold, "{method}: {roll} degrees, foretold {foretold}");
    }
}

#[test]
fn a_file_that_is_there_stays_unless_forced() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    std::fs::write(&file, "mine").unwrap();
    let name = file.to_str().unwrap();
    assert!(refusal(&["init", name]).contains("is there already"));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    assert_eq!(answer(&["init", name, "--force", "--name", "other"]).0, Some(0));
    assert!(std::fs::read_to_string(&file).unwrap().contains("id = \"other\""));
}

#[test]
fn vehicles_that_cannot_be_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    let name = file.to_str().unwrap();
    for (arguments, expected_code, expected) in [
        (&["--links", "7"], USAGE, "1 to 6 links"),
        (&["--mass", "-1"], 1, "uav.mass must be a finite number, above 0, but is -1"),
        (&["--link-length", "0"], 1, "link[1].length must be"),
        (&["--name", "my drone"], 1, "`id` must be"),
        (&["--counterweight-mass", "1"], USAGE, "--counterweight"),
    ] {
        let arguments: Vec<&str> = ["init", name].into_iter().chain(*arguments).collect();
        let (code, _, error) = answer(&arguments);
        assert_eq!(code, Some(expected_code), "{arguments:?}: {error}");
        assert!(error.contains(expected), "{arguments:?}: {error}");
        assert!(!file.exists());
    }
    assert!(refusal(&["init", "mine.json"]).contains("must end in .toml"));
}

/// What new users have written, and what `check` says to it: the parameters to change.
#[test]
fn check_names_the_parameters_that_look_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    let name = file.to_str().unwrap();
    for (lines, expected) in [
        (
            // Nothing said of payload, spring, grasp and path.
            "uav.mass = 3.0\n'link[1].length' = 0.25\n'link[2].length' = 0.25\n'link[3].length' = 0.25",
            &["payload.mass = 0.0", "payload.com = 0.25", "support.height = ", "reference.leg[1]"][..],
        ),
        ("'joint[1].start' = -30.0", &["\"joint[1].start\" = -0.5236", "one thing looks wrong"]),
        (
            "'joint[2].start' = 0.0\n'joint[3].start' = 0.0",
            &["not balanced", "\"joint[2].start\" = 1.1987", "stretched"],
        ),
        ("'joint[2].lower' = -1.0", &["joint[2].lower", "ik.resolution = \"least_squares\""]),
        ("reference.kind = 'external'", &["reference.kind = \"path\" or \"circle\""]),
        ("autopilot.mode = 'external'", &["autopilot.mode = \"pid\""]),
        (
            "autopilot.roll.kd = 0.1",
            &["The roll does not come to rest", "autopilot.roll.kp = ", "autopilot.roll.kd = "],
        ),
        ("autopilot.sample_time = 0.5", &["autopilot.sample_time = "]),
        ("'reference.leg[1].dy' = -0.4", &["reference.leg[*].dx and .dy"]),
        ("payload.grasp_time = 0.75", &["payload.grasp_time = 1.4", "one thing looks wrong"]),
        ("support.height = 0.0", &["catapulted", "support.height = -0.3"]),
        ("support.height = -0.5", &["carries nothing", "support.height = -0.3"]),
        (
            "ik.resolution = 'least_squares'\n'joint[3].upper' = -3.0\n'joint[3].lower' = -4.0",
            &["\"joint[3].start\" = -3.0"],
        ),
    ] {
        let text =
            format!("id = 'mine'\ntitle = 'mine'\nduration = 30.0\n[structure]\nlinks = 3\n[parameters]\n{lines}\n");
        std::fs::write(&file, text).unwrap();
        let (code, said, error) = answer(&["check", name]);
        assert_eq!(code, Some(1), "{lines}: {said}{error}");
        assert!(said.starts_with("mine: ") && error.contains("look"), "{lines}: {said}{error}");
        for words in expected {
            assert!(said.contains(words), "{lines}: {words}: {said}");
        }
    }
}

#[test]
fn check_finds_nothing_in_the_pick_up() {
    let (code, said, error) = answer(&["check", "pick-up"]);
    assert_eq!((code, error.as_str()), (Some(0), ""), "{said}");
    assert!(said.contains("Nobody holds the horizontal position"), "{said}");
}

#[test]
fn help_teaches_with_examples() {
    let (code, help, _) = answer(&["--help"]);
    assert_eq!(code, Some(0));
    assert!(help.contains("Examples:") && help.contains("uam simulate 4.3a"), "{help}");
    assert!(!help.contains('\u{1b}'), "no control characters where there is no terminal: {help}");
    assert!(!help.contains("describe"), "what only developers need is not shown: {help}");
}

#[test]
fn shells_learn_the_commands() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let (code, script, _) = answer(&["completions", shell]);
        assert_eq!(code, Some(0));
        assert!(script.contains("simulate") && script.contains("discretization"), "{shell}: {script}");
    }
}

/// Outside of the sources, which the test says by the folder and without what cargo says of itself.
fn elsewhere(arguments: &[&str]) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_uam"));
    command.args(arguments).current_dir(folder.path()).env_remove("CARGO_MANIFEST_DIR");
    let output = command.output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn other_platforms_ask_for_the_sources() {
    for arguments in [&["build", "--platforms", "win64"][..], &["build", "--platforms", "win64", "--sources", "."]] {
        let (code, error) = elsewhere(arguments);
        assert_eq!(code, Some(1), "{arguments:?}");
        assert!(error.contains("--sources") && error.contains("were not found"), "{arguments:?}: {error}");
    }
    let (code, error) = elsewhere(&["build", "--platforms", "win64", "--sources", "no/such/folder"]);
    assert_eq!(code, Some(1));
    assert!(error.contains("no/such/folder"), "{error}");
}

#[test]
fn the_quiet_say_nothing_but_results() {
    let folder = tempfile::tempdir().unwrap();
    let export = |quiet: &[&str]| {
        let arguments = [&["export", "4.3a", "--out", folder.path().to_str().unwrap()], quiet].concat();
        let (code, out, error) = answer(&arguments);
        assert_eq!((code, error.as_str()), (Some(0), ""));
        out
    };
    assert!(export(&[]).contains("Written:"));
    assert_eq!(export(&["--quiet"]), "");
    let (_, list, _) = answer(&["list", "-q"]);
    assert!(list.contains("4.3a"), "a list is a result");
}

#[test]
fn every_scenario_has_a_line() {
    let (code, list, _) = answer(&["list"]);
    assert_eq!(code, Some(0));
    assert_eq!(list.lines().count(), uam::scenarios::catalogue().unwrap().len());
}

#[test]
#[cfg(unix)]
fn who_reads_no_further_gets_no_error() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let output = Command::new(env!("CARGO_BIN_EXE_uam")).arg("list").stdout(writer).output().unwrap();
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
}
