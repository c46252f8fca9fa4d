//! A million communication steps: times, events and motion are those of the host's clock, without drift.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use fmi::fmi2::instance::{CoSimulation, Common};
use fmi_host::{Slave, Unit};
use uam::Structure;

const STEPS: u32 = 1_000_000;
const STEP: f64 = 1e-3;

/// Calls `look` with the number of steps that are done and the instance, at every communication point; beginnings of
/// steps are t0 + n h, as the host multiplies them.
fn run(slave: &mut Slave<'_>, start: f64, mut look: impl FnMut(u32, &mut Slave<'_>)) {
    look(0, slave);
    for n in 0..STEPS {
        slave.instance.do_step(start + f64::from(n) * STEP, STEP, true).unwrap();
        look(n + 1, slave);
    }
}

/// A joint swings around its start by a rate that changes its sign every millisecond, another turns at a constant
/// rate; the UAV hovers. What a million steps add up must be what one multiplication gives.
#[test]
fn the_plant_does_not_drift() {
    let unit = Unit::plant(Structure::DEFAULT);
    let mut slave = unit.instantiate("long");
    slave.set("autopilot.mode", 2.0);
    let starts = [0.2, 0.1, -0.4];
    for (n, start) in (1..).zip(starts) {
        slave.set(&format!("joint[{n}].start"), start);
    }
    let start = 5.0;
    slave.initialize(start, None);
    let turning = 1e-3;
    slave.set("joint[2].rate_command", turning);
    let swinging = unit.reference("joint[1].rate_command");
    let [time, timestamp] = ["time", "timestamp"].map(|name| unit.reference(name));
    let [first, second, third] = [1, 2, 3].map(|n| unit.reference(&format!("joint[{n}].position")));

    let mut values = [0.0; 5];
    run(&mut slave, start, |n, slave| {
        slave.instance.get_real(&[time, timestamp, first, second, third], &mut values).unwrap();
        let now = if n == 0 { start } else { (start + f64::from(n - 1) * STEP) + STEP };
        assert_eq!(values[..2], [now; 2], "exactly t + h after {n} steps");
        let rate = if n % 2 == 0 { 1.0 } else { -1.0 };
        let swung = if n % 2 == 0 { 0.0 } else { STEP };
        let elapsed = f64::from(n) * STEP;
        for (found, expected) in values[2..].iter().zip([starts[0] + swung, starts[1] + turning * elapsed, starts[2]]) {
            assert!((found - expected).abs() < 1e-11, "{found} instead of {expected} after {n} steps");
        }
        slave.instance.set_real(&[swinging], &[rate]).unwrap();
    });
}

/// The last leg of a path and the grasp come after nearly a thousand seconds, each at its communication point; and
/// what the arm follows is still followed.
#[test]
fn the_controller_does_not_drift() {
    let unit = Unit::controller(Structure::DEFAULT);
    let mut slave = unit.instantiate("long");
    let (late, grasped) = (998.0, 999.0);
    slave.set("reference.leg[1].start", late);
    slave.set("payload.grasp_time", grasped);
    for leg in [2, 3] {
        slave.set(&format!("reference.leg[{leg}].duration"), 0.0);
    }
    // The cheapest method: a million plans are made.
    slave.set("ik.discretization", 1.0);
    slave.initialize(0.0, None);
    let names = ["reference.x", "reference.y", "predicted.end_effector.x", "predicted.end_effector.y"];
    let references = names.map(|name| unit.reference(name));
    let grasp = unit.reference("grasp");

    let (mut values, mut begin) = ([0.0; 4], [0.0; 2]);
    let mut held = [0];
    let mut moved = None;
    run(&mut slave, 0.0, |n, slave| {
        slave.instance.get_real(&references, &mut values).unwrap();
        slave.instance.get_boolean(&[grasp], &mut held).unwrap();
        if n == 0 {
            begin.copy_from_slice(&values[..2]);
        }
        let elapsed = f64::from(n) * STEP;
        assert_eq!(held[0] == 1, elapsed >= grasped - 1e-9, "grasped at {elapsed}");
        if moved.is_none() && (values[0] - begin[0]).hypot(values[1] - begin[1]) > 1e-12 {
            moved = Some(n);
        }
        let off = (values[0] - values[2]).hypot(values[1] - values[3]);
        assert!(off < 1e-3, "{off} m off the path after {elapsed} s");
        if elapsed < late {
            assert!(off < 1e-12, "{off} m off a path that stands still, after {elapsed} s");
        }
    });
    // The first step after the start of the leg.
    assert_eq!(moved, Some(998_001));
}
