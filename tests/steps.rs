//! Any communication step is as good as any other.

mod common;

use common::random::{Random, any_mode, free_mode};
use common::run::Run;
use common::{assert_close, cases};
use proptest::prelude::*;
use uam::Error;
use uam::Structure;
use uam::autopilot::AutopilotMode;
use uam::parameters::defaults::default_parameters;

fn random_run(seed: u64, mode: AutopilotMode, sample_time: f64) -> (Run, Random) {
    let mut random = Random(seed);
    let structure = random.structure();
    let mut parameters = random.parameters(structure);
    parameters.autopilot.mode = mode;
    parameters.autopilot.sample_time = sample_time;
    let mut run = Run::new(structure, parameters);
    run.inputs = random.inputs(structure);
    run.inputs.grasp = random.coin();
    (run, random)
}

/// Runs through steps of these sizes, the rates going on along their slopes.
fn through(mut run: Run, sizes: &[f64]) -> Vec<f64> {
    let slope = run.inputs.acceleration_command;
    for &size in sizes {
        run.step(size);
        for (rate, slope) in run.inputs.rate_command.iter_mut().zip(slope) {
            *rate += slope * size;
        }
    }
    [run.motion(), vec![run.outputs.thrust, run.outputs.torque]].concat()
}

/// 20 ms in the ways hosts send them.
fn partitions() -> [Vec<f64>; 4] {
    let odd = 0.009_999_999_999_998_455;
    [
        vec![0.02],
        vec![1e-3; 20],
        vec![odd, 1e-13, 0.02 - odd - 1e-13],
        vec![0.0, 0.007, 1e-13, 1e-13, 1e-10, 0.004, 1e-6, 0.02 - 0.011 - 1e-6 - 1e-10 - 2e-13],
    ]
}

proptest! {
    #![proptest_config(cases(24))]

    /// Three times 20 ms with constant rates, cut in whatever way.
    #[test]
    fn motion_does_not_depend_on_the_steps(seed: u64, mode in free_mode()) {
        let (run, _) = random_run(seed, mode, 0.0);
        let results = partitions().map(|sizes| through(run.clone(), &sizes.repeat(3)));
        for result in &results[1..] {
            assert_close(result, &results[0], 1e-10, "motion");
        }
    }

    /// First-order hold: rates on a ramp within a step are those on many small ramps, and in the limit those
    /// on many small steps of a staircase.
    #[test]
    fn rates_may_have_slopes(seed: u64, mode in free_mode()) {
        let (mut run, mut random) = random_run(seed, mode, 0.0);
        random.new_slopes(run.model.structure, &mut run.inputs);
        let results = partitions().map(|sizes| through(run.clone(), &sizes));
        for result in &results[1..] {
            assert_close(result, &results[0], 1e-10, "motion");
        }
        let staircase = |number: usize| {
            let mut stairs = run.clone();
            let size = 0.02 / number as f64;
            for i in 0..number {
                let middle = (i as f64 + 0.5) * size;
                for (k, rate) in stairs.inputs.rate_command.iter_mut().enumerate() {
                    *rate = run.inputs.rate_command[k] + run.inputs.acceleration_command[k] * middle;
                }
                stairs.inputs.acceleration_command = Default::default();
                stairs.step(size);
            }
            stairs.outputs.pose
        };
        let mut ramp = run.clone();
        ramp.step(0.02);
        let errors = [10, 20].map(|number| (staircase(number) - ramp.outputs.pose).norm());
        // The midpoint staircase is of second order.
        prop_assert!(errors[0] < 1e-4 && errors[1] < 0.3 * errors[0] + 1e-13, "{errors:?}");
    }

    /// Samples inside a step split it; a sample at its end belongs to the next one.
    #[test]
    fn sampling_does_not_depend_on_the_steps(seed: u64) {
        let (run, _) = random_run(seed, AutopilotMode::Pid, 3e-3);
        let results = partitions().map(|sizes| through(run.clone(), &sizes.repeat(3)));
        for result in &results[1..] {
            assert_close(result, &results[0], 1e-10, "motion");
        }
    }

    /// A step of no length moves nothing; done twice it is the same as once.
    #[test]
    fn a_step_of_no_length_moves_nothing(seed: u64, mode in any_mode()) {
        let (mut run, mut random) = random_run(seed, mode, 0.0);
        run.steps(5, 0.01);
        let before = run.outputs.clone();
        run.jump();
        assert_close(run.outputs.velocity.as_slice(), before.velocity.as_slice(), 1e-14, "velocity");
        random.new_rates(run.model.structure, &mut run.inputs);
        run.jump();
        let once = run.outputs.clone();
        run.jump();
        prop_assert_eq!(&run.outputs, &once);
        prop_assert_eq!((once.pose, once.position), (before.pose, before.position));
        assert_close(once.end_effector.as_slice(), before.end_effector.as_slice(), 1e-14, "end effector");
    }

    /// A copy goes its own way.
    #[test]
    fn copies_are_independent(seed: u64, mode in any_mode()) {
        let (mut run, mut random) = random_run(seed, mode, 0.0);
        run.steps(3, 0.01);
        let (mut copy, mut other) = (run.clone(), run.clone());
        random.new_rates(run.model.structure, &mut other.inputs);
        other.steps(3, 0.01);
        run.steps(3, 0.01);
        copy.steps(3, 0.01);
        prop_assert_eq!(&run.outputs, &copy.outputs);
        prop_assert!(run.outputs != other.outputs);
    }
}

fn default_run() -> Run {
    Run::new(Structure::DEFAULT, default_parameters(Structure::DEFAULT))
}

/// Ten million internal steps of at most 4 ms.
#[test]
fn a_step_that_would_take_for_ever_is_refused() {
    let mut run = default_run();
    assert!(matches!(run.try_step(1e6), Err(Error::StepTooLong { size: 1e6, .. })));
    run.inputs.rate_command[0] = f64::INFINITY;
    assert!(run.try_step(1e-3).is_err());
}

#[test]
fn a_state_that_is_not_finite_is_an_error_that_names_it() {
    for (what, change) in [
        ("joint position", (|run: &mut Run| run.inputs.rate_command[1] = f64::NAN) as fn(&mut Run)),
        ("base position", |run| run.inputs.load.base_force.x = f64::NAN),
        ("base position", |run| run.inputs.load.thrust_feedforward = f64::INFINITY),
    ] {
        for grasp in [false, true] {
            let mut run = default_run();
            run.inputs.grasp = grasp;
            change(&mut run);
            let error = run.try_step(1e-3).unwrap_err();
            assert!(matches!(error, Error::NotFinite { .. }), "{what}: {error}");
        }
    }
}
