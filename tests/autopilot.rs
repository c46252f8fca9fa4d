//! The hover control in its modes.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::model::{self, Body};
use common::random::Random;
use common::run::Run;
use common::{assert_close, cases, simpson};
use nalgebra::{Vector2, Vector3};
use proptest::prelude::*;
use uam::autopilot::AutopilotMode;
use uam::parameters::Balance;
use uam::parameters::defaults::default_parameters;
use uam::{Parameters, Structure};

/// One link that hangs straight down: it moves vertically like a point of M = 4.2 kg + 1 kg.
fn plumb(change: impl Fn(&mut Parameters)) -> Run {
    let structure = Structure::new(1, Balance::None).unwrap();
    let mut parameters = default_parameters(structure);
    change(&mut parameters);
    Run::new(structure, parameters)
}

const MASS: f64 = 5.2;
const WEIGHT: f64 = 9.81 * MASS;

/// M y'' = -kp (y - y_ref) - kd y' - ki integral(y - y_ref): with kp = 37, ki = 8, kd = 18 the characteristic
/// polynomial M s^3 + kd s^2 + kp s + ki; here against an independent integration by small Euler steps with
/// Richardson extrapolation.
#[test]
fn the_altitude_follows_its_linear_equation() {
    let euler = |number: usize| {
        let size = 0.5 / number as f64;
        let (mut y, mut v, mut i) = (0.0, 0.0, 0.0);
        for _ in 0..number {
            let acceleration = (-37.0 * (y - 0.1) - 18.0 * v - 8.0 * i) / MASS;
            (y, v, i) = (y + size * v, v + size * acceleration, i + size * (y - 0.1));
        }
        Vector2::new(y, v)
    };
    let coarse: Vec<_> = [4000, 8000, 16000].iter().map(|&n| euler(n)).collect();
    let better = [coarse[1] * 2.0 - coarse[0], coarse[2] * 2.0 - coarse[1]];
    let expected = (better[1] * 4.0 - better[0]) / 3.0;

    let mut run = plumb(|_| {});
    run.inputs.load.altitude = 0.1;
    run.step(0.5);
    assert_close(&[run.outputs.pose.y, run.outputs.velocity.y], expected.as_slice(), 1e-10, "altitude");
    assert_eq!((run.outputs.pose.x, run.outputs.pose.z), (0.0, 0.0));
}

/// Thrust and torque are those of the hover laws, with the integrals by Simpson's rule here; the thrust that
/// hovers does not know of the payload.
#[test]
fn thrust_and_torque_follow_the_hover_laws() {
    for held in [false, true] {
        let mut parameters = default_parameters(Structure::DEFAULT);
        parameters.support.stiffness = 0.0;
        let mut run = Run::new(Structure::DEFAULT, parameters);
        run.inputs.rate_command[..3].copy_from_slice(&[0.5, -0.8, 0.3]);
        run.inputs.grasp = held;
        run.inputs.load.altitude = 0.03;
        run.inputs.load.roll = -0.02;
        run.inputs.load.thrust_feedforward = 1.5;
        run.inputs.load.base_force.x = 0.7;
        let record = run.record(300, 1e-3);
        let errors: Vec<_> = record.iter().map(|o| Vector2::new(o.pose.y - 0.03, o.pose.z + 0.02)).collect();
        let (integral, o) = (simpson(&errors, 1e-3), &run.outputs);
        let thrust = 9.81 * 7.2 + 1.5 - 37.0 * errors[300].x - 18.0 * o.velocity.y - 8.0 * integral.x;
        let torque = -40.0 * errors[300].y - 3.0 * o.velocity.z - 35.0 * integral.y;
        assert_close(&[o.thrust, o.torque], &[thrust, torque], 1e-8, "control");
    }
}

/// Sample 0 at rest: U1 = M g + kp y_ref. After T: y = a T^2 / 2, v = a T with a = kp y_ref / M; sample 1 sees
/// these and the integral -y_ref T of sample 0. Likewise once more.
#[test]
fn the_first_samples_by_hand() {
    let (sample, wanted) = (0.02, 0.1);
    let mut run = plumb(|p| p.autopilot.sample_time = 0.02);
    run.inputs.load.altitude = wanted;
    let (mut y, mut v, mut integral) = (0.0, 0.0, 0.0);
    for _ in 0..3 {
        let thrust = WEIGHT - 37.0 * (y - wanted) - 18.0 * v - 8.0 * integral;
        integral += (y - wanted) * sample;
        let a = (thrust - WEIGHT) / MASS;
        (y, v) = (y + v * sample + 0.5 * a * sample * sample, v + a * sample);
        run.step(0.005);
        assert_close(&[run.outputs.thrust], &[thrust], 1e-12, "thrust inside the interval");
        run.step(0.015);
        assert_close(&[run.outputs.thrust], &[thrust], 1e-12, "thrust at the end of the interval");
        assert_close(&[run.outputs.pose.y, run.outputs.velocity.y], &[y, v], 1e-13, "altitude");
    }
}

/// A sample reads the velocities before the jump of the rates at its instant: the first one sees rest.
#[test]
fn a_sample_does_not_see_the_jump_at_its_instant() {
    let mut run = plumb(|p| p.autopilot.sample_time = 0.01);
    run.inputs.rate_command[0] = 1.0;
    run.step(0.01);
    assert_eq!(run.outputs.torque, 0.0);
    let (roll, rate) = (run.outputs.pose.z, run.outputs.velocity.z);
    assert!(rate.abs() > 1e-3, "the base reacts at once");
    run.inputs.rate_command[0] = -1.0;
    run.step(0.01);
    // The integral of the first sample's error is 0.
    assert_close(&[run.outputs.torque], &[-40.0 * roll - 3.0 * rate], 1e-13, "second sample");
}

/// The error of a sampled autopilot against the continuous one is of first order in the sample time.
#[test]
fn a_fast_autopilot_is_nearly_continuous() {
    let pose = |sample_time: f64| {
        let mut parameters = default_parameters(Structure::DEFAULT);
        parameters.autopilot.sample_time = sample_time;
        let mut run = Run::new(Structure::DEFAULT, parameters);
        run.inputs.rate_command[..3].copy_from_slice(&[0.5, -0.8, 0.3]);
        run.step(0.2);
        run.outputs.pose
    };
    let continuous = pose(0.0);
    let errors = [2e-3, 1e-3, 5e-4].map(|sample_time| (pose(sample_time) - continuous).norm());
    assert!(errors[0] < 1e-3 && errors[2] > 1e-9, "{errors:?}");
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1] - 2.0).abs() < 0.05, "{errors:?}");
    }
}

/// Thrust and torque of an external autopilot are the inputs; at zero thrust everything falls.
#[test]
fn external_thrust_and_torque_are_the_inputs() {
    let mut run = plumb(|p| p.autopilot.mode = AutopilotMode::External);
    (run.inputs.load.thrust, run.inputs.load.torque) = (WEIGHT + 2.6, 0.0);
    run.inputs.load.thrust_feedforward = 9.0; // for the pid mode only
    run.step(0.1);
    assert_close(&[run.outputs.thrust, run.outputs.pose.y], &[WEIGHT + 2.6, 0.5 * 0.5 * 0.01], 1e-13, "climb");
    run.inputs.load.torque = 0.3;
    run.step(0.1);
    assert_eq!(run.outputs.torque, 0.3);
    assert!(run.outputs.pose.z > 0.0);
}

/// An outer force at the UAV and thrust along the tilted axis: gains are tunable between steps.
#[test]
fn gains_can_be_changed_between_steps() {
    let mut run = plumb(|_| {});
    run.inputs.load.altitude = 0.1;
    run.step(0.01);
    run.model.parameters.autopilot.altitude.kp = 0.0;
    run.model.parameters.autopilot.altitude.ki = 0.0;
    run.step(0.0);
    assert_close(&[run.outputs.thrust], &[WEIGHT - 18.0 * run.outputs.velocity.y], 1e-12, "thrust");
}

fn carriage(seed: u64, held: bool) -> (Run, Random) {
    let mut random = Random(seed);
    let structure = random.structure();
    let mut parameters = random.parameters(structure);
    parameters.autopilot.mode = AutopilotMode::Ideal;
    let mut run = Run::new(structure, parameters);
    run.inputs = random.inputs(structure);
    run.inputs.grasp = held;
    (run, random)
}

proptest! {
    #![proptest_config(cases(48))]

    /// On an ideal carriage altitude and roll are exactly 0, and without lateral forces the momentum along x,
    /// summed over all bodies, stays 0.
    #[test]
    fn the_ideal_carriage_slides_along_x_only(seed: u64, held: bool) {
        let (mut run, mut random) = carriage(seed, held);
        (run.inputs.load.base_force.x, run.inputs.load.tip_force.x) = (0.0, 0.0);
        for _ in 0..5 {
            random.new_rates(run.model.structure, &mut run.inputs);
            run.step(0.03);
            let o = &run.outputs;
            assert_eq!([o.pose.y, o.pose.z, o.velocity.y, o.velocity.z, o.acceleration.y, o.acceleration.z], [0.0; 6]);
            assert_close(&[model::momentum(&run.bodies()).x], &[0.0], 1e-10, "p_x");
        }
        prop_assert!(run.outputs.pose.x.abs() > 1e-6);
    }

    /// A lateral force accelerates the centre of mass; mean thrust and torque balance momentum and angular
    /// momentum of the whole system, jump of the rates included.
    #[test]
    fn thrust_and_torque_of_the_carriage_balance_momentum(seed: u64, held: bool) {
        let (mut run, mut random) = carriage(seed, held);
        run.steps(3, 0.01);
        random.new_rates(run.model.structure, &mut run.inputs);
        let sums = |bodies: &[Body], about: Vector2<f64>| {
            let p = model::momentum(bodies);
            Vector3::new(p.x, p.y, model::angular_momentum(bodies, about))
        };
        let before = sums(&run.bodies(), run.outputs.pose.xy());
        let mut nodes = run.clone();
        run.step(0.02);
        let change = sums(&run.bodies(), run.outputs.pose.xy()) - before;

        nodes.jump();
        let mut loads = Vec::new();
        for o in nodes.record(20, 1e-3) {
            // Nodes without rotors; moments about the moving UAV.
            let (model, about) = (&nodes.model, o.pose.xy());
            let bodies = model.observed(&o, o.attached);
            let (f, tip) = (nodes.inputs.load.tip_force, model.end_effector(&model.coordinates(&o)));
            let force = nodes.inputs.load.base_force + f - Vector2::new(0.0, model::mass(&bodies) * model.gravity());
            let moment = nodes.inputs.load.base_torque + nodes.inputs.load.tip_torque
                + model::cross(tip - about, f)
                + model::weight_moment(&bodies, model.gravity(), about)
                - model::cross(o.velocity.xy(), model::momentum(&bodies));
            loads.push(Vector3::new(force.x, force.y, moment));
        }
        let rotors = (change - simpson(&loads, 1e-3)) / 0.02;
        assert_close(&[0.0, run.outputs.thrust, run.outputs.torque], rotors.as_slice(), 1e-8, "rotors");
    }
}
