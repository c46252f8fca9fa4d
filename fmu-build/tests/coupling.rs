//! The master on the built FMUs: what it hands over, and what becomes of mistakes.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

mod common;

use fmu_build::host::coupling::Schedule;
use fmu_build::host::fmu::{Fmu, Selection, Value};
use fmu_build::host::record::{Names, Recording};
use fmu_build::host::run::run;
use uam::coupling::{Unit, in_process};
use uam::scenarios::{Scenario, find};

fn scenario() -> Scenario {
    find("4.3a").unwrap()
}

fn recorded(schedule: &Schedule) -> Recording {
    let scenario = scenario();
    let run = run(&common::pair(), &scenario, schedule, &Names::standard(scenario.structure), &|| {}).unwrap();
    assert!(run.stopped.is_none());
    run.recording
}

/// The pose of the UAV at the end, coupled in this process, without C interface between.
fn pose_in_process(scenario: &Scenario, schedule: &Schedule) -> Vec<f64> {
    let mut coupling = in_process::pair(scenario.structure, &scenario.parameters).unwrap();
    coupling.run(schedule, &mut |_, _, _| Ok(())).unwrap();
    let (pose, mut values) = coupling.plant.select(&POSE).unwrap();
    coupling.plant.read(&pose, &mut values).unwrap();
    values
}

const POSE: [&str; 3] = ["base.x", "base.y", "base.roll"];

#[test]
fn nothing_is_lost_on_the_way_through_the_c_interface() {
    let schedule = Schedule::new(0.0, 3.0, 1e-3).unwrap();
    let recording = recorded(&schedule);
    let expected = pose_in_process(&scenario(), &schedule);
    for (name, expected) in POSE.into_iter().zip(&expected) {
        assert_eq!(recording.column(name).unwrap()[recording.len() - 1], *expected, "{name}");
    }
    assert!(expected[0] > 0.05, "the UAV has moved: {}", expected[0]);
}

#[test]
fn rates_and_grasp_are_connected_by_name() {
    let coupling = common::pair().couple().unwrap();
    // A rate and an acceleration for each of three joints, and the grasp.
    assert_eq!(coupling.connections().0, 3 + 3 + 1);
}

#[test]
fn the_initial_outputs_are_handed_over_before_the_first_step() {
    let mut scenario = scenario();
    scenario.parameters.payload.grasp_time = -1.0;
    let schedule = Schedule::new(0.0, 0.01, 1e-3).unwrap();
    let names = Names::standard(scenario.structure);
    let run = run(&common::pair(), &scenario, &schedule, &names, &|| {}).unwrap();
    assert_eq!(run.recording.column("payload.attached").unwrap()[1], 1.0);
}

#[test]
fn instances_do_not_disturb_each_other() {
    let schedule = Schedule::new(0.0, 1.0, 1e-3).unwrap();
    let alone = recorded(&schedule);
    let all: Vec<Recording> = std::thread::scope(|scope| {
        let threads = [(); 3].map(|()| scope.spawn(|| recorded(&schedule)));
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    assert!(all.iter().all(|recording| *recording == alone));
}

#[test]
fn an_instance_can_be_reset_and_run_again() {
    let mut plant = common::pair().plant.instantiate("again").unwrap();
    let mut run = || {
        plant.initialize(0.0, 1.0).unwrap();
        plant.set_value("joint[1].rate_command", Value::Real(0.3)).unwrap();
        for n in 0..10 {
            plant.do_step(f64::from(n) * 0.01, 0.01).unwrap();
        }
        let end = plant.value("base.roll").unwrap();
        plant.terminate().unwrap();
        plant.reset().unwrap();
        end
    };
    assert_eq!(run(), run());
}

#[test]
fn the_units_own_words_come_back_as_errors() {
    let pair = common::pair();
    let mut plant = pair.plant.instantiate("plant").unwrap();

    let order = plant.do_step(0.0, 1e-3).unwrap_err().to_string();
    assert!(order.contains("plant: fmi2DoStep answers fmi2Error"), "{order}");

    let mut plant = pair.plant.instantiate("plant").unwrap();
    let mass = plant.set_value("uav.mass", Value::Real(-1.0)).and_then(|()| plant.initialize(0.0, 1.0));
    let mass = mass.unwrap_err().to_string();
    assert!(mass.contains("uav.mass") && mass.contains("-1"), "{mass}");
}

#[test]
fn wrong_names_and_types_are_refused_before_any_call() {
    let mut plant = common::pair().plant.instantiate("plant").unwrap();
    let name = plant.value("base.z").unwrap_err().to_string();
    assert!(name.contains("no variable `base.z`") && name.contains("`base."), "{name}");
    let kind = plant.set_value("grasp", Value::Real(1.0)).unwrap_err().to_string();
    assert_eq!(kind, "`grasp` of uam_plant is of type Boolean, not a real number");
    assert!(Selection::new(plant.description(), ["base.x", "nothing"]).is_err());
}

#[test]
fn what_is_no_fmu_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let missing = Fmu::open(&folder.path().join("none.fmu")).unwrap_err().to_string();
    assert!(missing.contains("none.fmu"), "{missing}");
    let path = folder.path().join("text.fmu");
    std::fs::write(&path, "not a zip").unwrap();
    let text = Fmu::open(&path).unwrap_err().to_string();
    assert!(text.contains("no zip archive"), "{text}");
}

#[test]
fn a_saved_state_brings_an_instance_back_also_as_bytes() {
    let pair = common::pair();
    let [mut plant, mut other] = ["plant", "other"].map(|name| pair.plant.instantiate(name).unwrap());
    assert!(plant.restore().is_err(), "nothing is saved");
    for unit in [&mut plant, &mut other] {
        unit.initialize(0.0, 1.0).unwrap();
    }
    plant.set_value("joint[1].rate_command", Value::Real(0.5)).unwrap();
    plant.do_step(0.0, 0.1).unwrap();
    plant.save().unwrap();
    let bytes = plant.saved_bytes().unwrap();
    plant.do_step(0.1, 0.1).unwrap();
    let went_on = plant.value("base.roll").unwrap();
    plant.restore().unwrap();
    other.save_bytes(&bytes).unwrap();
    other.restore().unwrap();
    for unit in [&mut plant, &mut other] {
        assert_ne!(unit.value("base.roll").unwrap(), went_on);
        unit.do_step(0.1, 0.1).unwrap();
        assert_eq!(unit.value("base.roll").unwrap(), went_on);
    }
    assert!(other.save_bytes(&bytes[1..]).is_err());
}
