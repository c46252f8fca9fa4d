//! Paths that travel inside FMUs.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;
use std::process::Command;

use fmu_build::host::coupling::{Pair, Schedule};
use fmu_build::host::fmu::{Instance, Value};
use fmu_build::{BuildOptions, Design, build};
use uam::Structure;
use uam::scenarios::Scenario;

/// A scenario with this path, that takes 10 s and lifts nothing.
fn scenario(path: &str) -> Scenario {
    let text = format!(
        "id = 'eight'\ntitle = 'A figure of eight'\nduration = 10.5\n{path}\nstructure.links = 3\n\
         [parameters]\npayload.grasp_time = 1000.0"
    );
    Scenario::read(&text).unwrap()
}

/// A figure of eight below the starting point, 6 cm wide and 4 cm high, in 20 knots over 10 s.
fn eight(width: f64) -> String {
    let row = |i: u32| {
        let angle = TAU * f64::from(i) / 19.0;
        let [x, y] = [0.5 * width * angle.sin(), 0.02 * (2.0 * angle).sin()];
        format!("[{:?}, {x:?}, {y:?}]", 10.0 * f64::from(i) / 19.0)
    };
    format!("path = [{}]", (0..20).map(row).collect::<Vec<_>>().join(", "))
}

fn pair(design: Design, name: &str) -> Pair {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(env!("CARGO_CRATE_NAME")).join(name);
    let built = build(&BuildOptions::new(design, folder), &|_| ()).unwrap();
    Pair::open(&built.controller, &built.plant).unwrap()
}

fn number(unit: &mut Instance, name: &str) -> f64 {
    match unit.value(name).unwrap() {
        Value::Real(number) => number,
        other => panic!("{name} = {other:?}"),
    }
}

fn place(unit: &mut Instance, what: &str) -> [f64; 2] {
    ["x", "y"].map(|axis| number(unit, &format!("{what}.{axis}")))
}

#[test]
fn the_end_effector_follows_a_table() {
    let scenario = scenario(&eight(0.06));
    let table = scenario.parameters.reference.table.clone().unwrap();
    let mut coupling = pair(Design::from(scenario), "eight").couple().unwrap();
    let (mut origin, mut most, mut way) = (None, 0.0_f64, 0.0_f64);
    let schedule = Schedule::new(0.0, 10.5, 1e-3).unwrap();
    coupling
        .run(&schedule, &mut |time, controller, plant| {
            let ([x, y], [rx, ry]) = (place(plant, "end_effector"), place(controller, "reference"));
            let [x0, y0] = *origin.get_or_insert([rx, ry]);
            let wanted = table.at(time).displacement;
            // The instants of host and unit differ by rounding.
            assert!((rx - x0 - wanted.x).hypot(ry - y0 - wanted.y) < 1e-14, "t = {time}");
            most = most.max((x - rx).hypot(y - ry));
            way = way.max((rx - x0).abs());
            Ok(())
        })
        .unwrap();
    assert!(most < 1e-9, "{most:e}");
    assert!(way > 0.029, "{way}");
}

/// The controller alone, in a host that sets nothing.
fn controller(pair: &Pair) -> Instance {
    pair.controller.instantiate("controller").unwrap()
}

fn steps(unit: &mut Instance, range: std::ops::Range<u32>) -> Vec<u64> {
    let mut bits = Vec::new();
    for i in range {
        unit.do_step(f64::from(i) * 1e-3, 1e-3).unwrap();
        let names = ["reference.x", "reference.y", "joint[1].rate_command", "joint[3].rate_command"];
        bits.extend(names.map(|name| number(unit, name).to_bits()));
    }
    bits
}

#[test]
fn a_state_saved_on_the_way_goes_on_with_the_same_numbers() {
    let pair = pair(Design::from(scenario(&eight(0.06))), "states");
    let mut unit = controller(&pair);
    unit.initialize(0.0, 10.5).unwrap();
    steps(&mut unit, 0..2000);
    unit.save().unwrap();
    let bytes = unit.saved_bytes().unwrap();
    assert!(bytes.len() < 100_000, "the table stays out of it: {}", bytes.len());
    let expected = steps(&mut unit, 2000..2500);
    unit.restore().unwrap();
    assert_eq!(steps(&mut unit, 2000..2500), expected);

    let mut other = controller(&pair);
    other.save_bytes(&bytes).unwrap();
    other.restore().unwrap();
    assert_eq!(steps(&mut other, 2000..2500), expected);
}

/// A state does not hold its table, so that it is one of units with this table alone.
#[test]
fn a_state_of_a_unit_with_another_path_is_refused() {
    let [one, other] = [0.06, 0.05].map(|width| pair(Design::from(scenario(&eight(width))), &format!("width {width}")));
    let none = pair(Design::from(Structure::DEFAULT), "no path");
    let mut unit = controller(&one);
    unit.initialize(0.0, 1.0).unwrap();
    unit.save().unwrap();
    let bytes = unit.saved_bytes().unwrap();
    for (pair, expected) in [(&other, "a unit with another path"), (&none, "a unit with another path")] {
        let refused = controller(pair).save_bytes(&bytes).unwrap_err().to_string();
        assert!(refused.contains(expected), "{refused}");
    }
    let mut bare = controller(&none);
    bare.initialize(0.0, 1.0).unwrap();
    bare.save().unwrap();
    let refused = controller(&one).save_bytes(&bare.saved_bytes().unwrap()).unwrap_err().to_string();
    assert!(refused.contains("a state of a unit without path"), "{refused}");
}

/// Names of files in a scenario count from where it lies; what cannot hold a table is refused.
#[test]
fn a_path_may_lie_beside_its_scenario() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.toml");
    fs::write(&file, "id = 'mine'\nbased_on = '4.3b'\npath = 'points.csv'").unwrap();
    let answer = |command: &str| {
        let program = Command::new(env!("CARGO_BIN_EXE_uam")).args([command, file.to_str().unwrap()]).output().unwrap();
        String::from_utf8([program.stdout, program.stderr].concat()).unwrap()
    };
    let missing = answer("show");
    assert!(
        missing.contains("line 3: `path = \"points.csv\"`: cannot read") && missing.contains("points.csv: "),
        "{missing}"
    );
    fs::write(folder.path().join("points.csv"), "time,x,y\n0,0,0\n1,0.01,0.02\n").unwrap();
    let shown = answer("show");
    assert!(shown.contains("[1.0, 0.01, 0.02],") && shown.contains("reference.kind = \"table\""), "{shown}");
    let refused = answer("export");
    assert!(refused.contains("which no parameter set can hold"), "{refused}");
}

/// Whoever wants another kind gets it, and whoever wants a table where there is none learns what to do.
#[test]
fn a_host_may_choose_another_kind() {
    let kind = |unit: &mut Instance, number| unit.set_value("reference.kind", Value::Integer(number));
    let with = pair(Design::from(scenario(&eight(0.06))), "kinds");
    let mut unit = controller(&with);
    assert_eq!(unit.value("reference.kind").unwrap(), Value::Integer(4));
    kind(&mut unit, 2).unwrap();
    unit.initialize(0.0, 10.0).unwrap();
    let [start, _] = [(); 2].map(|()| place(&mut unit, "reference"));
    for i in 0..2000 {
        unit.do_step(f64::from(i) * 1e-3, 1e-3).unwrap();
    }
    // Half of the circle of 6 cm, which begins leftmost.
    let half = place(&mut unit, "reference");
    assert!((half[0] - start[0] - 0.06).abs() < 1e-12 && (half[1] - start[1]).abs() < 1e-12, "{half:?}");

    let mut without = controller(&pair(Design::from(Structure::DEFAULT), "no table"));
    kind(&mut without, 4).unwrap();
    let refused = without.initialize(0.0, 1.0).unwrap_err().to_string();
    assert!(refused.contains("reference.kind = table") && refused.contains("build --scenario FILE"), "{refused}");
}
