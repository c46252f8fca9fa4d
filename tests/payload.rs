//! Grasp and release of the payload.

mod common;

use common::model;
use common::random::{Random, any_mode, free_mode};
use common::run::Run;
use common::{assert_close, cases};
use proptest::prelude::*;
use uam::autopilot::AutopilotMode;

fn in_motion(seed: u64, mode: AutopilotMode, held: bool) -> (Run, Random) {
    let mut random = Random(seed);
    let structure = random.structure();
    let mut parameters = random.parameters(structure);
    parameters.autopilot.mode = mode;
    let mut run = Run::new(structure, parameters);
    run.inputs = random.inputs(structure);
    run.inputs.grasp = held;
    run.steps(10, 0.01);
    (run, random)
}

proptest! {
    #![proptest_config(cases(48))]

    /// The payload is taken over at rest: momentum, summed over all bodies, is continuous, the base jumps.
    #[test]
    fn capture_keeps_momentum(seed: u64, mode in free_mode()) {
        let (mut run, _) = in_motion(seed, mode, false);
        let (before, velocity, about) = (run.bodies(), run.outputs.velocity, run.outputs.pose.xy());
        run.inputs.grasp = true;
        run.jump();
        let after = run.bodies();
        prop_assert!(run.outputs.attached);
        prop_assert_eq!(after.len(), before.len() + 1);
        assert_close(model::momentum(&after).as_slice(), model::momentum(&before).as_slice(), 1e-10, "p");
        let k = model::angular_momentum;
        assert_close(&[k(&after, about)], &[k(&before, about)], 1e-10, "K");
        prop_assert!((run.outputs.velocity - velocity).norm() > 1e-4);
    }

    /// The payload leaves with its own momentum: nothing that remains jumps.
    #[test]
    fn release_keeps_velocities(seed: u64, mode in any_mode()) {
        let (mut run, _) = in_motion(seed, mode, true);
        let before = run.outputs.clone();
        run.inputs.grasp = false;
        run.jump();
        let o = &run.outputs;
        prop_assert!(!o.attached);
        assert_close(o.velocity.as_slice(), before.velocity.as_slice(), 1e-12, "velocity");
        assert_close(o.end_effector_velocity.as_slice(), before.end_effector_velocity.as_slice(), 1e-12, "tip");
        let p = model::momentum(&run.bodies());
        assert_close(&[o.momentum.x, o.momentum.y], p.as_slice(), 1e-10, "momentum of what remains");
    }

    /// Where rates jump at the same instant, the release comes first: momentum of what remains is continuous.
    #[test]
    fn rates_jump_after_the_release(seed: u64, mode in free_mode()) {
        let (mut run, mut random) = in_motion(seed, mode, true);
        let remaining = run.model.observed(&run.outputs, false);
        run.inputs.grasp = false;
        random.new_rates(run.model.structure, &mut run.inputs);
        run.jump();
        assert_close(model::momentum(&run.bodies()).as_slice(), model::momentum(&remaining).as_slice(), 1e-10, "p");
    }

    /// A payload without mass changes nothing.
    #[test]
    fn a_payload_without_mass_changes_nothing(seed: u64, mode in any_mode()) {
        let (mut run, _) = in_motion(seed, mode, false);
        run.model.parameters.payload.mass = 0.0;
        let mut random = Random(seed);
        let structure = random.structure();
        let mut weightless = Run::new(structure, run.model.parameters.clone());
        weightless.inputs = run.inputs.clone();
        let mut without = weightless.clone();
        weightless.inputs.grasp = true;
        weightless.steps(5, 0.02);
        without.steps(5, 0.02);
        assert_close(&weightless.motion(), &without.motion(), 1e-13, "motion");
        assert_close(&weightless.outputs.effort, &without.outputs.effort, 1e-10, "torque");
        assert_eq!(weightless.outputs.payload_force.norm(), 0.0);
    }
}
