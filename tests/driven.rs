//! Joints driven by torques, beside others with imposed rates: balances with all sums over bodies done here.

mod common;

use common::model::{self, center_of_mass};
use common::random::{Random, any_mode, free_mode};
use common::run::Run;
use common::{assert_close, cases, derivative};
use nalgebra::Vector2;
use proptest::prelude::*;
use uam::autopilot::AutopilotMode;
use uam::parameters::defaults::default_parameters;
use uam::parameters::{Actuation, Balance};
use uam::plant::{self, Outputs};
use uam::{Error, Parameters, Structure};

/// Which joints are driven: one at least.
fn drive(random: &mut Random, structure: Structure, parameters: &mut Parameters) {
    let always = random.between(0.0, structure.links as f64) as usize;
    for i in 0..structure.links {
        if i == always || random.coin() {
            parameters.joints[i].actuation = Actuation::Torque;
        }
    }
}

fn driven(parameters: &Parameters, structure: Structure) -> Vec<usize> {
    (0..structure.links).filter(|&i| parameters.joints[i].actuation == Actuation::Torque).collect()
}

fn new_torques(random: &mut Random, run: &mut Run) {
    for torque in &mut run.inputs.joint_torque_command {
        *torque = random.about_zero(0.2);
    }
}

/// A random vehicle with driven joints under random loads, in motion; with the payload in the gripper if `held`,
/// pressed on a soft support throughout.
fn in_motion(seed: u64, mode: AutopilotMode, held: bool) -> (Run, Random) {
    let mut random = Random(seed);
    let structure = random.structure();
    let mut parameters = random.parameters(structure);
    drive(&mut random, structure, &mut parameters);
    parameters.autopilot.mode = mode;
    let mut run = Run::new(structure, parameters.clone());
    parameters.support.stiffness = 20.0;
    parameters.support.height = run.model.payload(&run.model.coordinates(&run.outputs)).y + 0.3;
    run = Run::new(structure, parameters);
    run.inputs = random.inputs(structure);
    new_torques(&mut random, &mut run);
    run.inputs.grasp = held;
    run.steps(10, 0.005);
    (run, random)
}

/// Angular momentum about each driven joint of all that lies outboard; a payload that was not held is at rest.
fn momenta(run: &Run, held: bool) -> Vec<f64> {
    let (model, o) = (&run.model, &run.outputs);
    let joints = model.joints(&model.coordinates(o));
    let bodies = model.observed(o, held);
    let about = |i: usize| {
        let outer: Vec<_> = bodies.iter().copied().filter(|b| b.part.is_moved_by(i, model.structure)).collect();
        model::angular_momentum(&outer, joints[i])
    };
    driven(&model.parameters, model.structure).into_iter().map(about).collect()
}

proptest! {
    #![proptest_config(cases(48))]

    /// The mean torque of a driven joint's motor, from the change of momentum outboard, is the commanded one.
    #[test]
    fn torques_are_those_commanded(seed: u64, mode in any_mode(), held: bool) {
        let (mut run, mut random) = in_motion(seed, mode, held);
        random.new_rates(run.model.structure, &mut run.inputs);
        new_torques(&mut random, &mut run);
        run.step(0.01);
        for i in driven(&run.model.parameters, run.model.structure) {
            assert_close(&[run.outputs.effort[i]], &[run.inputs.joint_torque_command[i]], 1e-9, "torque");
        }
    }

    /// Where imposed rates jump, or a payload at rest is taken over, the driven joints keep their momenta and the
    /// system its own.
    #[test]
    fn momenta_are_continuous(seed: u64, mode in free_mode(), held: bool, capture: bool) {
        let (mut run, mut random) = in_motion(seed, mode, held && !capture);
        let (k, p) = (momenta(&run, held && !capture), model::momentum(&run.bodies()));
        let rate = run.outputs.rate;
        random.new_rates(run.model.structure, &mut run.inputs);
        run.inputs.grasp = held || capture;
        run.jump();
        assert_close(&momenta(&run, held || capture), &k, 1e-10, "K");
        assert_close(model::momentum(&run.bodies()).as_slice(), p.as_slice(), 1e-10, "p");
        let imposed = run.model.structure.coordinates() > driven(&run.model.parameters, run.model.structure).len();
        if imposed || (capture && !held) {
            let jump = driven(&run.model.parameters, run.model.structure).iter()
                .map(|&i| (rate[i] - run.outputs.rate[i]).abs())
                .fold(0.0, f64::max);
            prop_assert!(jump > 1e-9, "the driven joints answer: {jump}");
        }
    }

    /// A payload that is let go changes no velocity.
    #[test]
    fn letting_go_changes_no_velocity(seed: u64, mode in any_mode()) {
        let (mut run, _) = in_motion(seed, mode, true);
        let before = run.outputs.clone();
        run.inputs.grasp = false;
        run.jump();
        assert_close(run.outputs.velocity.as_slice(), before.velocity.as_slice(), 1e-11, "velocity");
        assert_close(&run.outputs.rate, &before.rate, 1e-10, "rate");
    }

    /// Accelerations of base and joints are the derivatives of their velocities along one step.
    #[test]
    fn accelerations_are_derivatives(seed: u64, mode in any_mode(), held: bool) {
        let (mut run, mut random) = in_motion(seed, mode, held);
        random.new_slopes(run.model.structure, &mut run.inputs);
        run.jump();
        let after = |t: f64| { let mut run = run.clone(); run.step(t); run };
        let velocity = derivative(|s| after(0.01 + s).outputs.velocity);
        let rate = derivative(|s| nalgebra::DVector::from_row_slice(&after(0.01 + s).outputs.rate));
        let end = after(0.01);
        let size = 1.0 + rate.amax();
        assert_close(end.outputs.acceleration.as_slice(), velocity.as_slice(), 1e-6 * size, "acceleration of the base");
        assert_close(&end.rates().coordinates, rate.as_slice(), 1e-6 * size, "acceleration of the joints");
    }

    /// Without rotors, motors and loads, energy stays and the centre of mass falls on a parabola.
    #[test]
    fn a_free_arm_keeps_its_energy(seed: u64) {
        let mut run = tumbling(seed);
        let (energy, size) = (run.model.energy(&run.outputs), kinetic(&run));
        let (start, speed) = (center_of_mass(&run.bodies()), model::momentum(&run.bodies()) / model::mass(&run.bodies()));
        for n in 1..=20 {
            run.step(0.01);
            let t = 0.01 * f64::from(n);
            assert_close(&[run.model.energy(&run.outputs)], &[energy], 1e-11 * size.max(1.0), "energy");
            let fallen = start + speed * t - Vector2::new(0.0, 0.5 * run.model.gravity() * t * t);
            assert_close(center_of_mass(&run.bodies()).as_slice(), fallen.as_slice(), 1e-11, "centre of mass");
        }
    }

    /// One long step is as good as many short ones.
    #[test]
    fn steps_of_any_length_agree(seed: u64, mode in any_mode(), held: bool) {
        let (run, _) = in_motion(seed, mode, held);
        let (mut once, mut often) = (run.clone(), run);
        once.step(0.03);
        often.steps(30, 1e-3);
        let size = 1.0 + once.outputs.rate.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
        assert_close(&once.motion(), &often.motion(), 1e-10 * size, "motion");
    }

    /// The mirror image of a motion is the motion of the mirror image.
    #[test]
    fn mirror_image(seed: u64, mode in any_mode(), held: bool) {
        let mut first = None;
        for side in [1.0, -1.0] {
            let mut random = Random(seed);
            let structure = random.structure();
            let mut p = random.parameters(structure);
            drive(&mut random, structure, &mut p);
            p.autopilot.mode = mode;
            p.mount.x *= side;
            p.joints.iter_mut().for_each(|joint| joint.start *= side);
            p.counterweight.start *= side;
            p.balance_element.start *= side;
            let mut run = Run::new(structure, p);
            run.inputs = random.inputs(structure);
            new_torques(&mut random, &mut run);
            run.inputs.grasp = held;
            let inputs = &mut run.inputs;
            inputs.rate_command.iter_mut().for_each(|rate| *rate *= side);
            inputs.joint_torque_command.iter_mut().for_each(|torque| *torque *= side);
            for odd in [
                &mut inputs.load.roll, &mut inputs.load.torque, &mut inputs.load.base_force.x,
                &mut inputs.load.base_torque, &mut inputs.load.tip_force.x, &mut inputs.load.tip_torque,
            ] {
                *odd *= side;
            }
            run.steps(10, 0.005);
            let seen = odd_and_even(&run.outputs, side);
            let first = first.get_or_insert_with(|| seen.clone());
            assert_close(&seen, first, 1e-11, "mirror image");
        }
    }
}

fn odd_and_even(o: &Outputs, side: f64) -> Vec<f64> {
    let mut all = vec![side * o.pose.x, o.pose.y, side * o.pose.z, o.transmitted_force.y, side * o.transmitted_moment];
    all.extend([o.position, o.rate, o.effort].concat().iter().map(|odd| side * odd));
    all
}

/// A vehicle without rotors and loads, all of its joints free, after a push; what balances the arm holds still.
fn tumbling(seed: u64) -> Run {
    let mut random = Random(seed);
    let structure = random.structure();
    let mut parameters = random.parameters(structure);
    parameters.autopilot.mode = AutopilotMode::External;
    parameters.joints.iter_mut().for_each(|joint| joint.actuation = Actuation::Torque);
    let mut run = Run::new(structure, parameters);
    run.inputs.load.base_torque = random.about_zero(2.0);
    run.inputs.joint_torque_command[0] = random.about_zero(0.3);
    run.steps(10, 0.01);
    run.inputs.load.base_torque = 0.0;
    run.inputs.joint_torque_command[0] = 0.0;
    run.jump();
    run
}

fn kinetic(run: &Run) -> f64 {
    run.bodies().iter().map(|b| 0.5 * (b.mass * b.velocity.norm_squared() + b.inertia * b.spin * b.spin)).sum()
}

/// A free link under a UAV that hardly moves swings as a pendulum: T = 2 pi sqrt((I + m a^2) / (m g a)).
#[test]
fn a_free_link_swings_as_a_pendulum() {
    let structure = Structure::new(1, Balance::None).unwrap();
    let mut parameters = default_parameters(structure);
    (parameters.uav.mass, parameters.uav.inertia) = (1e12, 1e12);
    parameters.autopilot.mode = AutopilotMode::Ideal;
    parameters.joints[0].start = 1e-4;
    parameters.joints[0].actuation = Actuation::Torque;
    let mut run = Run::new(structure, parameters);
    let frequency = (9.81 * 0.065_f64 / (6e-4 + 0.065 * 0.065)).sqrt();
    for n in 1..=200 {
        run.step(0.005);
        let expected = 1e-4 * (frequency * 0.005 * f64::from(n)).cos();
        // Its amplitude changes the period by a share of 6e-10.
        assert_close(&[run.outputs.position[0]], &[expected], 1e-12, "angle");
    }
}

/// A joint that moves nothing with inertia cannot follow a torque.
#[test]
fn a_torque_needs_inertia() {
    let mut parameters = default_parameters(Structure::DEFAULT);
    parameters.joints[2].actuation = Actuation::Torque;
    assert!(plant::new(Structure::DEFAULT, &parameters).is_ok());
    (parameters.links[2].mass, parameters.links[2].inertia) = (0.0, 0.0);
    let error = plant::new(Structure::DEFAULT, &parameters).err().unwrap();
    assert!(matches!(&error, Error::Inconsistent { name, .. } if name == "joint[3].actuation"), "{error}");
}
