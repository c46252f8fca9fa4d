//! The payload on its elastic support: contact begins and ends inside steps.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::random::Random;
use common::run::Run;
use common::{assert_close, cases};
use proptest::prelude::*;
use uam::Structure;
use uam::autopilot::{AutopilotMode, Gains};
use uam::parameters::Balance;
use uam::parameters::defaults::default_parameters;

/// One link straight down with the payload in the gripper, without control: a point of M = 5.7 kg that moves
/// vertically; the payload is at y - 0.13 m.
const MASS: f64 = 4.2 + 1.0 + 0.5;
const G: f64 = 9.81;
const STIFFNESS: f64 = 1000.0;

fn plumb(gap: f64) -> Run {
    let structure = Structure::new(1, Balance::None).unwrap();
    let mut parameters = default_parameters(structure);
    parameters.autopilot.mode = AutopilotMode::External;
    parameters.support.stiffness = STIFFNESS;
    parameters.support.height = -0.13 - gap;
    let mut run = Run::new(structure, parameters);
    run.inputs.grasp = true;
    run
}

/// Height and velocity at time `t` of a point that falls from rest onto a spring `gap` below it, in closed
/// form: parabolas in the air, a cosine about the equilibrium M g / k below the spring's end in contact.
fn bouncing(gap: f64, t: f64) -> [f64; 2] {
    let fall = (2.0 * gap / G).sqrt();
    let omega = (STIFFNESS / MASS).sqrt();
    let (sag, speed) = (G / (omega * omega), G * fall);
    let amplitude = (sag * sag + (speed / omega).powi(2)).sqrt();
    // Phase at which the cosine about -sag passes the spring's end downwards.
    let phase = (sag / amplitude).acos();
    let contact = 2.0 * (std::f64::consts::PI - phase) / omega;
    let within = t % (2.0 * fall + contact);
    if within < fall {
        [-0.5 * G * within * within, -G * within]
    } else if within < fall + contact {
        let angle = phase + omega * (within - fall);
        [-gap - sag + amplitude * angle.cos(), -amplitude * omega * angle.sin()]
    } else {
        let left = within - 2.0 * fall - contact; // counted from the top
        [-0.5 * G * left * left, -G * left]
    }
}

/// Drops from far and near, against the closed form.
fn check_bouncing(gaps: &[f64]) {
    for &gap in gaps {
        for step in [1e-3, 0.0137] {
            let mut run = plumb(gap);
            while run.time < 1.5 {
                run.step(step);
                let found = [run.outputs.pose.y, run.outputs.velocity.y];
                let what = format!("gap {gap}, step {step}, t = {}", run.time);
                assert_close(&found, &bouncing(gap, run.time), 1e-9, &what);
            }
        }
    }
}

#[test]
fn bouncing_in_closed_form() {
    check_bouncing(&[0.1, 1e-2, 1e-3, 1e-4]);
}

/// From 1e-5 m the flight takes 3 ms, less than an internal step.
#[test]
fn bouncing_lower_than_an_internal_step_is_long() {
    check_bouncing(&[1e-5, 1e-6, 1e-7, 1e-8]);
}

/// The payload rests where spring and weight balance, and the support carries all.
#[test]
fn rest_on_the_support() {
    let mut run = plumb(-MASS * G / STIFFNESS);
    run.steps(20, 0.05);
    assert_close(&[run.outputs.pose.y, run.outputs.support_force], &[0.0, MASS * G], 1e-9, "rest");
}

/// The support never pulls: above it, nothing happens, and force appears with the gap.
#[test]
fn the_support_pushes_only() {
    let mut run = plumb(0.02);
    while run.time < 0.5 {
        run.step(1e-3);
        let gap = run.outputs.pose.y + 0.02;
        let expected = if gap < 0.0 { -STIFFNESS * gap } else { 0.0 };
        assert_close(&[run.outputs.support_force], &[expected], 1e-9, "force");
    }
}

/// Without the payload there is nothing to support; nor without stiffness.
#[test]
fn no_support_without_payload_or_stiffness() {
    let mut empty = plumb(-0.01);
    empty.inputs.grasp = false;
    let mut soft = plumb(-0.01);
    soft.model.parameters.support.stiffness = 0.0;
    let mut soft = {
        let mut run = Run::new(soft.model.structure, soft.model.parameters);
        run.inputs.grasp = true;
        run
    };
    for run in [&mut empty, &mut soft] {
        run.step(0.1);
        assert_close(&[run.outputs.pose.y], &[-0.5 * G * 0.01], 1e-14, "free fall");
        assert_eq!(run.outputs.support_force, 0.0);
    }
}

/// The UAV comes down and is thrown up again by a net thrust M g; at the bottom the payload dips into the
/// support by `depth`. In contact M s'' = -M g - k s for the depth s; it leaves as fast as it came, sooner
/// than without the support.
fn check_touch(depth: f64, step: f64) {
    // 0.1 s of fall, then a net upward acceleration g.
    let bottom = -G * 0.01;
    let mut run = plumb(-bottom - depth);
    run.step(0.1);
    run.inputs.load.thrust = 2.0 * MASS * G;
    let until = 0.3;
    while run.time < until - 1e-9 {
        run.step(step.min(until - run.time));
    }
    let speed = (2.0 * G * depth).sqrt();
    let omega = (STIFFNESS / MASS).sqrt();
    let contact = 2.0 * (speed * omega / G).atan() / omega;
    let left = until - (0.2 - speed / G) - contact;
    let expected = [bottom + depth + speed * left + 0.5 * G * left * left, speed + G * left];
    let found = [run.outputs.pose.y, run.outputs.velocity.y];
    assert_close(&found, &expected, 1e-11, &format!("depth {depth}, step {step}"));
}

#[test]
fn a_grazing_touch() {
    for depth in [1e-3, 1e-5, 1e-6, 1e-7, 1e-9] {
        check_touch(depth, 1e-3);
    }
}

/// A touch of 1e-6 m takes 0.9 ms.
#[test]
fn a_touch_shorter_than_an_internal_step() {
    for depth in [1e-5, 1e-6, 1e-7, 1e-8] {
        for step in [4e-3, 0.0137, 0.2] {
            check_touch(depth, step);
        }
    }
}

/// A bent arm that tumbles over the support, joints locked, no rotors.
fn tumbling(seed: u64) -> Run {
    let mut random = Random(seed);
    let structure = random.structure();
    let mut parameters = random.parameters(structure);
    parameters.autopilot.mode = AutopilotMode::External;
    let run = Run::new(structure, parameters.clone());
    let payload = run.model.payload(&run.model.coordinates(&run.outputs));
    parameters.support.stiffness = random.between(200.0, 3000.0);
    parameters.support.height = payload.y - random.between(0.0, 0.03);
    let mut run = Run::new(structure, parameters);
    run.inputs.grasp = true;
    run.jump();
    run
}

proptest! {
    #![proptest_config(cases(24))]

    /// Kinetic energy, weight and spring together, across all switching of contact.
    #[test]
    fn bouncing_keeps_energy(seed: u64) {
        let mut run = tumbling(seed);
        let energy = run.model.energy(&run.outputs);
        let mut touched = false;
        for _ in 0..60 {
            run.step(0.0075);
            touched |= run.outputs.support_force > 0.0;
            assert_close(&[run.model.energy(&run.outputs)], &[energy], 1e-9, "energy");
        }
        prop_assert!(touched);
    }

    /// One step of 0.3 s, or many, with moving joints and under control.
    #[test]
    fn contact_does_not_depend_on_the_steps(seed: u64, pid: bool) {
        let mut run = tumbling(seed);
        let mut random = Random(!seed);
        if pid {
            let mut parameters = run.model.parameters;
            parameters.autopilot.mode = AutopilotMode::Pid;
            parameters.autopilot.altitude = Gains { kp: 5.0, ki: 1.0, kd: 1.0 };
            run = Run::new(run.model.structure, parameters);
            run.inputs.grasp = true;
        }
        random.new_rates(run.model.structure, &mut run.inputs);
        let (mut fine, mut odd) = (run.clone(), run.clone());
        run.step(0.3);
        fine.steps(300, 1e-3);
        while odd.time < 0.3 {
            odd.step(random.between(0.0, 0.02).min(0.3 - odd.time));
        }
        assert_close(&fine.motion(), &run.motion(), 1e-9, "1 ms");
        assert_close(&odd.motion(), &run.motion(), 1e-9, "random steps");
    }
}
