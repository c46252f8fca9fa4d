//! Cost of the mechanics: the right-hand side and steps of the plant, by number of links.
//!
//!     cargo bench --bench plant

#![allow(clippy::unwrap_used, reason = "a benchmark that cannot start has nothing to say")]

use std::cell::RefCell;

use divan::Bencher;
use nalgebra::SVector;
use uam::mechanics::dynamics::Dynamics;
use uam::parameters::defaults::default_parameters;
use uam::parameters::{Actuation, Balance, BaseModel};
use uam::{Parameters, Structure};

mod motion;

use motion::{PlantRun, STEPS, links};

fn main() {
    divan::main();
}

/// Sines, posture, H_b and H_m, forces: how momentum changes in a given state.
#[divan::bench(consts = [1, 2, 3, 4, 5, 6])]
fn right_hand_side<const N: usize>(bencher: Bencher<'_, '_>) {
    let parameters = default_parameters(links(N));
    let dynamics = Dynamics::<N>::new(links(N), &parameters, BaseModel::Full).unwrap();
    let mut state = dynamics.start(&parameters).state;
    state.rate = SVector::from_fn(|i, _| 0.5 - 0.2 * i as f64);
    bencher.bench_local(|| {
        let situation = dynamics.situation(divan::black_box(state));
        let mut end = state;
        dynamics.begin_explicit(&situation, 0.0, 1e-3, &mut end);
        end
    });
}

/// A millisecond with the gains of the pick-up, by number of links.
#[divan::bench(args = [1, 2, 3, 4, 5, 6], sample_size = STEPS)]
fn step(bencher: Bencher<'_, '_>, number: usize) {
    run(bencher, links(number), |_| {});
}

/// The same with all outputs, most of which are computed when they are asked for.
#[divan::bench(sample_size = STEPS)]
fn step_with_outputs(bencher: Bencher<'_, '_>) {
    let mut plant = PlantRun::new(Structure::DEFAULT, default_parameters(Structure::DEFAULT));
    bencher.bench_local(|| plant.observed_step());
}

/// The same with a counterweight, by number of links.
#[divan::bench(args = [1, 3, 6], sample_size = STEPS)]
fn step_with_counterweight(bencher: Bencher<'_, '_>, number: usize) {
    run(bencher, Structure { balance: Balance::Counterweight, ..links(number) }, |_| {});
}

/// The same with the rigid gains, which ask for several internal steps.
#[divan::bench(sample_size = STEPS)]
fn step_with_rigid_gains(bencher: Bencher<'_, '_>) {
    run(bencher, Structure::DEFAULT, |parameters| {
        let autopilot = &mut parameters.autopilot;
        (autopilot.altitude.kp, autopilot.altitude.ki, autopilot.altitude.kd) = (1000.0, 500.0, 500.0);
        (autopilot.roll.kp, autopilot.roll.ki, autopilot.roll.kd) = (600.0, 500.0, 30.0);
    });
}

/// The same with so many joints, the inner ones, that no motor moves: more states, and links that whip about.
#[divan::bench(args = [1, 3], sample_size = STEPS)]
fn step_with_free_joints(bencher: Bencher<'_, '_>, free: usize) {
    run(bencher, Structure::DEFAULT, |parameters| {
        parameters.joints.iter_mut().take(free).for_each(|joint| joint.actuation = Actuation::Torque);
    });
}

thread_local! {
    static OWN: RefCell<PlantRun> =
        RefCell::new(PlantRun::new(Structure::DEFAULT, default_parameters(Structure::DEFAULT)));
}

/// A plant in each of several threads: time per step of one of them.
#[divan::bench(threads = [1, 2, 4], sample_size = STEPS)]
fn step_in_threads(bencher: Bencher<'_, '_>) {
    bencher.bench(|| OWN.with_borrow_mut(PlantRun::step));
}

/// A copy of a plant in the middle of its motion.
#[divan::bench]
fn copy(bencher: Bencher<'_, '_>) {
    let plant = PlantRun::new(Structure::DEFAULT, default_parameters(Structure::DEFAULT)).halfway();
    bencher.bench_local(|| plant.simulation().clone_box());
}

fn run(bencher: Bencher<'_, '_>, structure: Structure, change: impl FnOnce(&mut Parameters)) {
    let mut parameters = default_parameters(structure);
    change(&mut parameters);
    let mut plant = PlantRun::new(structure, parameters);
    bencher.bench_local(|| plant.step());
}
