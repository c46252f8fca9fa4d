//! The laws of motion of the plant: balances of momentum and energy, with all sums over bodies done here.

mod common;

use common::model::{self, Body, center_of_mass};
use common::random::{Random, any_mode, free_mode};
use common::run::Run;
use common::{assert_close, cases, simpson};
use nalgebra::{Vector2, Vector3};
use proptest::prelude::*;
use uam::Structure;
use uam::autopilot::AutopilotMode;
use uam::plant::Outputs;

const STEP: f64 = 1e-3;

/// A random vehicle under random loads after a tenth of a second, with the payload in the gripper if `held`,
/// pressed on a soft support throughout.
fn in_motion(seed: u64, mode: AutopilotMode, held: bool) -> (Run, Random) {
    let mut random = Random(seed);
    let structure = random.structure();
    let mut parameters = random.parameters(structure);
    parameters.autopilot.mode = mode;
    let mut run = Run::new(structure, parameters.clone());
    parameters.support.stiffness = 20.0;
    parameters.support.height = run.model.payload(&run.model.coordinates(&run.outputs)).y + 0.3;
    run = Run::new(structure, parameters);
    run.inputs = random.inputs(structure);
    run.inputs.grasp = held;
    run.steps(10, 0.01);
    random.new_rates(structure, &mut run.inputs);
    run.jump();
    (run, random)
}

fn momenta(bodies: &[Body]) -> Vector3<f64> {
    let p = model::momentum(bodies);
    Vector3::new(p.x, p.y, model::angular_momentum(bodies, Vector2::zeros()))
}

proptest! {
    #![proptest_config(cases(48))]

    /// Newton and Euler for the whole system about the origin: the change of momentum is the integral of the
    /// forces and moments from outside. Together with the imposed rates this fixes all motion.
    #[test]
    fn momentum_changes_by_the_impulse_of_the_loads(seed: u64, mode in free_mode(), held: bool, sloped: bool) {
        let (mut run, mut random) = in_motion(seed, mode, held);
        if sloped {
            random.new_slopes(run.model.structure, &mut run.inputs);
        }
        // Slopes would start again in every step: the nodes come from copies that start at the same instant.
        let start = run.clone();
        let mut loads = vec![run.load(&run.outputs)];
        for i in 1..=40 {
            run = start.clone();
            run.step(f64::from(i) * STEP);
            loads.push(run.load(&run.outputs));
        }
        let change = momenta(&run.bodies()) - momenta(&start.bodies());
        assert_close(change.as_slice(), simpson(&loads, STEP).as_slice(), 2e-10, "impulse");
    }

    /// Work of the coordinates' motors (mean torque or force times way), rotors and outer loads is the change
    /// of energy.
    #[test]
    fn energy_changes_by_the_work_done(seed: u64, mode in free_mode(), held: bool) {
        let (mut run, _) = in_motion(seed, mode, held);
        run.step(STEP); // the torques of this one contain the jump
        let before = run.model.energy(&run.outputs);
        let record = run.record(40, STEP);
        let rate = run.inputs.rate_command;
        let motors: f64 = record[1..].iter()
            .map(|o| o.effort.iter().zip(&rate).map(|(effort, rate)| effort * rate * STEP).sum::<f64>())
            .sum();
        let power: Vec<f64> = record.iter().map(|o| power(&run, o)).collect();
        let change = run.model.energy(&run.outputs) - before;
        assert_close(&[motors + simpson(&power, STEP)], &[change], 5e-10, "work");
    }

    /// Accelerations are derivatives of the velocities along one held step.
    #[test]
    fn accelerations_are_derivatives_of_velocities(seed: u64, mode in any_mode(), held: bool) {
        let (mut run, mut random) = in_motion(seed, mode, held);
        random.new_slopes(run.model.structure, &mut run.inputs);
        let after = |t: f64| { let mut run = run.clone(); run.step(t); run.outputs };
        let difference = common::derivative(|s| after(0.01 + s).velocity);
        assert_close(after(0.01).acceleration.as_slice(), difference.as_slice(), 2e-8, "acceleration");
    }

    /// Without rotors and loads the centre of mass falls on a parabola and p_y = -M g t, whatever the
    /// coordinates do, jumps and slopes included.
    #[test]
    fn free_fall(seed: u64) {
        let mut run = falling(seed, true);
        let start = center_of_mass(&run.bodies());
        let mass = model::mass(&run.bodies());
        let mut random = Random(seed);
        for _ in 0..5 {
            random.new_rates(run.model.structure, &mut run.inputs);
            random.new_slopes(run.model.structure, &mut run.inputs);
            run.step(0.1);
        }
        let (g, bodies) = (run.model.gravity(), run.bodies());
        assert_close(model::momentum(&bodies).as_slice(), &[0.0, -mass * g * 0.5], 1e-10, "p");
        let fallen = start - Vector2::new(0.0, 0.5 * g * 0.25);
        assert_close(center_of_mass(&bodies).as_slice(), fallen.as_slice(), 1e-11, "parabola");
        // Nothing turns a falling system about its centre of mass.
        assert_close(&[model::angular_momentum(&bodies, fallen)], &[0.0], 1e-10, "spin");
    }

    /// Without gravity the centre of mass stays and all momentum is zero.
    #[test]
    fn nothing_moves_the_center_of_mass_without_gravity_and_loads(seed: u64) {
        let mut run = falling(seed, false);
        let start = center_of_mass(&run.bodies());
        let mut random = Random(seed);
        for _ in 0..5 {
            random.new_rates(run.model.structure, &mut run.inputs);
            random.new_slopes(run.model.structure, &mut run.inputs);
            run.step(0.1);
        }
        let bodies = run.bodies();
        assert_close(momenta(&bodies).as_slice(), &[0.0; 3], 1e-10, "momentum");
        assert_close(center_of_mass(&bodies).as_slice(), start.as_slice(), 1e-12, "centre of mass");
        prop_assert!(run.outputs.pose.norm() > 1e-4, "the base reacts");
    }

    /// The mirror image of a motion is the motion of the mirror image.
    #[test]
    fn mirror_image(seed: u64, mode in any_mode(), held: bool) {
        let (mut run, mut random) = (None, Random(seed));
        let structure = random.structure();
        let mut parameters = random.parameters(structure);
        parameters.autopilot.mode = mode;
        let mut inputs = random.inputs(structure);
        random.new_slopes(structure, &mut inputs);
        inputs.grasp = held;
        for side in [1.0, -1.0] {
            let mut p = parameters.clone();
            p.mount.x *= side;
            p.joints.iter_mut().for_each(|joint| joint.start *= side);
            p.counterweight.start *= side;
            p.balance_element.start *= side;
            let mut now = Run::new(structure, p);
            now.inputs = inputs.clone();
            now.inputs.rate_command.iter_mut().for_each(|rate| *rate *= side);
            now.inputs.acceleration_command.iter_mut().for_each(|slope| *slope *= side);
            for odd in [
                &mut now.inputs.load.roll, &mut now.inputs.load.torque, &mut now.inputs.load.base_force.x,
                &mut now.inputs.load.base_torque, &mut now.inputs.load.tip_force.x, &mut now.inputs.load.tip_torque,
            ] {
                *odd *= side;
            }
            now.steps(10, 0.02);
            let seen = mirrored(&now.outputs, side);
            let first = run.get_or_insert_with(|| seen.clone());
            assert_close(&seen, first, 1e-12, "mirror image");
        }
    }
}

/// Power of rotors and outer loads.
fn power(run: &Run, o: &Outputs) -> f64 {
    let (inputs, roll) = (&run.inputs, o.pose.z);
    let spin = o.velocity.z + o.rate[..run.model.structure.links].iter().sum::<f64>();
    let (at, speed) = (run.model.coordinates(o), run.model.speed(o));
    let tip = run.model.velocity_of(&at, &speed, model::Model::end_effector);
    let base_force = inputs.load.base_force + o.thrust * Vector2::new(-roll.sin(), roll.cos());
    base_force.dot(&o.velocity.xy())
        + (o.torque + inputs.load.base_torque) * o.velocity.z
        + inputs.load.tip_force.dot(&tip)
        + inputs.load.tip_torque * spin
}

/// A random vehicle without rotors and support.
fn falling(seed: u64, gravity: bool) -> Run {
    let mut random = Random(seed);
    let structure: Structure = random.structure();
    let mut parameters = random.parameters(structure);
    parameters.autopilot.mode = AutopilotMode::External;
    parameters.gravity = if gravity { parameters.gravity } else { 0.0 };
    Run::new(structure, parameters)
}

/// All outputs, with those that change sign in a mirror multiplied by `side`.
fn mirrored(o: &Outputs, side: f64) -> Vec<f64> {
    let mut all = Vec::new();
    for v in [o.pose, o.velocity, o.acceleration, o.momentum] {
        all.extend([side * v.x, v.y, side * v.z]);
    }
    for v in [o.end_effector, o.end_effector_velocity, o.transmitted_force, o.center_of_mass, o.payload_force] {
        all.extend([side * v.x, v.y]);
    }
    all.extend([o.thrust, side * o.torque, side * o.transmitted_moment, o.support_force]);
    all.extend([o.position, o.rate, o.effort].concat().iter().map(|odd| side * odd));
    all
}
