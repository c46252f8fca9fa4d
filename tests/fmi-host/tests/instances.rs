//! Many instances of both units in one process.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use std::thread;

use fmi::fmi2::instance::Common;
use fmi::traits::FmiImport;
use fmi_host::{Coupling, Slave, Unit, steps};
use uam::Structure;

fn both() -> [Unit; 2] {
    [Unit::controller(Structure::DEFAULT), Unit::plant(Structure::DEFAULT)]
}

/// From initialization through 100 steps, the plant with a rate; all outputs.
fn run(slave: &mut Slave<'_>, rate: Option<f64>) -> Vec<(String, u64)> {
    slave.initialize(0.0, Some(1.0));
    if let Some(rate) = rate {
        slave.set("joint[2].rate_command", rate);
        slave.set("grasp", 1.0);
    }
    for n in 0..100 {
        slave.step(f64::from(n) * 1e-2, 1e-2).unwrap();
    }
    slave.outputs()
}

/// The plant takes rates, the controller does not.
fn rate_of(unit: &Unit) -> Option<f64> {
    (unit.import().model_description().model_name == "uam_plant").then_some(0.3)
}

/// FMI 2.0, 2.1.6: after `fmi2Reset` an instance is as new, with its start values.
#[test]
fn reset_equals_new() {
    for unit in both() {
        let expected = run(&mut unit.instantiate("new"), rate_of(&unit));
        let mut used = unit.instantiate("used");
        used.set("uav.mass", 6.0);
        used.set("payload.mass", 1.0);
        used.set("autopilot.roll.kd", 5.0);
        assert_ne!(run(&mut used, rate_of(&unit).map(|rate| 3.0 * rate)), expected);
        used.instance.reset().unwrap();
        assert_eq!(run(&mut used, rate_of(&unit)), expected);
        used.instance.terminate().unwrap();
        used.instance.reset().unwrap();
        assert_eq!(run(&mut used, rate_of(&unit)), expected, "once more, after the end");
    }
}

#[test]
fn a_reset_during_initialization_starts_over() {
    for unit in both() {
        let mut slave = unit.instantiate("undecided");
        slave.set("uav.mass", 6.0);
        slave.instance.setup_experiment(None, 5.0, None).unwrap();
        slave.instance.enter_initialization_mode().unwrap();
        slave.instance.reset().unwrap();
        assert_eq!(run(&mut slave, rate_of(&unit)), run(&mut unit.instantiate("new"), rate_of(&unit)));
    }
}

#[test]
fn two_instances_step_by_step() {
    let plant = Unit::plant(Structure::DEFAULT);
    let expected = [0.3, -0.4].map(|rate| run(&mut plant.instantiate("alone"), Some(rate)));
    let mut pair = [0.3, -0.4].map(|rate| {
        let mut slave = plant.instantiate("twin");
        slave.initialize(0.0, Some(1.0));
        slave.set("joint[2].rate_command", rate);
        slave.set("grasp", 1.0);
        slave
    });
    for n in 0..100 {
        for slave in &mut pair {
            slave.step(f64::from(n) * 1e-2, 1e-2).unwrap();
        }
    }
    assert_eq!(pair.map(|mut slave| slave.outputs()), expected);
}

/// Coupled runs in several threads give the same numbers, bit by bit.
#[test]
fn threads_do_not_disturb_each_other() {
    let coupling = Coupling::open(Structure::DEFAULT);
    let run = || coupling.run(&[("ik.resolution", 1.0)], steps(0.0, 1e-2, 300)).unwrap();
    let alone = run();
    thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(run)).collect();
        for thread in threads {
            assert_eq!(thread.join().unwrap(), alone);
        }
    });
}

#[test]
fn instances_come_and_go() {
    for unit in both() {
        for _ in 0..200 {
            let mut slave = unit.instantiate("short-lived");
            slave.initialize(0.0, None);
            slave.step(0.0, 1e-3).unwrap();
        }
    }
}

/// Some hosts load libraries with global symbols: the functions of both units have the same names.
#[cfg(unix)]
#[test]
fn both_units_with_global_symbols() {
    use libloading::os::unix::{Library, RTLD_GLOBAL, RTLD_NOW};

    let local = Coupling::open(Structure::DEFAULT).run(&[], steps(0.0, 1e-2, 300)).unwrap();
    let coupling = Coupling::open(Structure::DEFAULT);
    let libraries = [&coupling.plant, &coupling.controller].map(|unit| {
        let import = unit.import();
        let library = import.shared_lib_path(&import.model_description().model_name).unwrap();
        // SAFETY: the library does nothing when it is loaded.
        unsafe { Library::open(Some(import.archive_path().join(library)), RTLD_NOW | RTLD_GLOBAL) }.unwrap()
    });
    assert_eq!(coupling.run(&[], steps(0.0, 1e-2, 300)).unwrap(), local);
    drop(libraries);
}
