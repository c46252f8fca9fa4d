//! Forward kinematics, against closed forms and against the independent model.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::model::Model;
use common::random::Random;
use common::run::Run;
use common::{assert_close, cases};
use nalgebra::Vector2;
use proptest::prelude::*;
use uam::Structure;
use uam::parameters::Balance;
use uam::parameters::defaults::default_parameters;
use uam::plant::Outputs;

fn hanging(links: usize) -> Run {
    let structure = Structure::new(links, Balance::None).unwrap();
    let mut parameters = default_parameters(structure);
    parameters.joints.iter_mut().for_each(|joint| joint.start = 0.0);
    (parameters.mount.x, parameters.mount.y) = (0.02, -0.05);
    Run::new(structure, parameters)
}

/// At q = 0 all links hang straight down from the mount: 0.13 m each.
#[test]
fn the_arm_hangs_straight_down_at_zero() {
    for links in 1..=6 {
        let tip = hanging(links).outputs.end_effector;
        assert_close(tip.as_slice(), &[0.02, -0.05 - 0.13 * links as f64], 1e-15, "tip");
    }
}

/// One link of length l at the angle a: (l sin a, -l cos a); the second one turns on from there.
#[test]
fn the_end_effector_of_two_links_in_closed_form() {
    let structure = Structure::new(2, Balance::None).unwrap();
    let mut parameters = default_parameters(structure);
    (parameters.joints[0].start, parameters.joints[1].start) = (0.4, 0.5);
    let tip = Run::new(structure, parameters).outputs.end_effector;
    let expected = [0.13 * (0.4_f64.sin() + 0.9_f64.sin()), -0.13 * (0.4_f64.cos() + 0.9_f64.cos())];
    assert_close(tip.as_slice(), &expected, 1e-15, "tip");
}

/// With equal links the centre of mass of the hanging arm is half-way down:
/// y = -(n 1 kg)(n 0.13 m / 2) / (4.2 kg + n 1 kg).
#[test]
fn the_center_of_mass_of_the_hanging_arm_in_closed_form() {
    for links in 1..=6 {
        let n = links as f64;
        let expected = [0.02 * n / (4.2 + n), n * (-0.05 - 0.065 * n) / (4.2 + n)];
        assert_close(hanging(links).outputs.center_of_mass.as_slice(), &expected, 1e-15, "centre of mass");
    }
}

/// The defaults of arms up to three links start in balance: centre of mass below the UAV's.
#[test]
fn the_default_arms_start_in_balance() {
    for structure in Structure::all() {
        let run = Run::new(structure, default_parameters(structure));
        let x = run.outputs.center_of_mass.x;
        assert!(x.abs() < 1e-4, "{structure}: {x}");
    }
}

fn tip_of(model: &Model, outputs: &Outputs) -> [Vector2<f64>; 2] {
    let (at, speed) = (model.coordinates(outputs), model.speed(outputs));
    [model.end_effector(&at), model.velocity_of(&at, &speed, Model::end_effector)]
}

proptest! {
    #![proptest_config(cases(64))]

    /// Position of the end effector, and its velocity by differences of that, in whatever motion.
    #[test]
    fn the_end_effector_moves_as_the_model_says(seed: u64, held: bool) {
        let mut random = Random(seed);
        let structure = random.structure();
        let mut run = Run::new(structure, random.parameters(structure));
        run.inputs = random.inputs(structure);
        run.inputs.grasp = held;
        run.steps(10, 0.02);
        let [position, velocity] = tip_of(&run.model, &run.outputs);
        assert_close(run.outputs.end_effector.as_slice(), position.as_slice(), 1e-13, "position");
        assert_close(run.outputs.end_effector_velocity.as_slice(), velocity.as_slice(), 1e-10, "velocity");
    }

    /// Joints go where their rates lead: q + rate t + slope t^2 / 2.
    #[test]
    fn coordinates_follow_their_rates(seed: u64) {
        let mut random = Random(seed);
        let structure = random.structure();
        let mut run = Run::new(structure, random.parameters(structure));
        let start = run.outputs.position;
        run.inputs = random.inputs(structure);
        random.new_slopes(structure, &mut run.inputs);
        run.step(0.05);
        let (rate, slope) = (run.inputs.rate_command, run.inputs.acceleration_command);
        for i in 0..structure.coordinates() {
            let expected = start[i] + rate[i] * 0.05 + 0.5 * slope[i] * 0.0025;
            assert_close(&[run.outputs.position[i]], &[expected], 1e-15, "position");
            assert_close(&[run.outputs.rate[i]], &[rate[i] + slope[i] * 0.05], 1e-14, "rate");
        }
    }
}
