//! Cost of the finished FMUs through their C interface: loading, starting, steps, coupled runs.
//!
//!     cargo bench --package fmu-build

#![allow(clippy::unwrap_used, reason = "a benchmark that cannot start has nothing to say")]

use std::path::Path;
use std::sync::LazyLock;

use divan::Bencher;
use divan::counter::ItemsCount;
use fmu_build::coupling::{Coupling, Order, Pair, Schedule};
use fmu_build::fmu::{Fmu, Instance, Selection, Value};
use fmu_build::{BuildOptions, Built, build};
use uam::Structure;
use uam::options::Choice;
use uam::parameters::{Discretization, Resolution};

static BUILT: LazyLock<Built> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("benches");
    build(&BuildOptions::new(Structure::DEFAULT, folder), &|_| {}).unwrap()
});

/// Length of a run, and of a step \[s\].
const DURATION: u32 = 30;
const STEP: f64 = 1e-3;

fn main() {
    LazyLock::force(&BUILT);
    divan::main();
}

fn pair() -> Pair {
    Pair::open(&BUILT.controller, &BUILT.plant).unwrap()
}

/// From the file to an instance: unpacking, loading of the library, `fmi2Instantiate`.
#[divan::bench]
fn open_and_instantiate() -> Instance {
    Fmu::open(&BUILT.plant).unwrap().instantiate("plant").unwrap()
}

/// `fmi2Instantiate` and `fmi2FreeInstance` of a loaded plant.
#[divan::bench]
fn instantiate(bencher: Bencher<'_, '_>) {
    let pair = pair();
    bencher.bench_local(|| drop(pair.plant.instantiate("plant").unwrap()));
}

/// A step of the plant, with all inputs set before it and all outputs got after it.
#[divan::bench(sample_size = 1000)]
fn plant_step_with_all_values(bencher: Bencher<'_, '_>) {
    let pair = pair();
    let description = pair.plant.description();
    let names = |causality| description.with(causality).map(|variable| variable.name.as_str());
    let inputs = Selection::new(description, names(fmu_build::fmu::Causality::Input)).unwrap();
    let outputs = Selection::new(description, names(fmu_build::fmu::Causality::Output)).unwrap();
    let (given, mut seen) = (inputs.values(), outputs.values());
    let mut plant = pair.plant.instantiate("plant").unwrap();
    plant.enter_initialization(0.0, 1e6).unwrap();
    plant.exit_initialization().unwrap();
    let mut steps = 0_u32;
    bencher.bench_local(|| {
        plant.set(&inputs, &given).unwrap();
        plant.do_step(f64::from(steps) * STEP, STEP).unwrap();
        plant.get(&outputs, &mut seen).unwrap();
        steps += 1;
    });
}

/// The pick-up of thesis 4.3, both units, all connected values, no recording. Items are simulated seconds:
/// items per second say how many times faster than real time it is.
#[divan::bench(args = [Discretization::Euler, Discretization::Exact], sample_count = 20)]
fn coupled(bencher: Bencher<'_, '_>, discretization: Discretization) {
    run(bencher, discretization, Resolution::ExtendedJacobian);
}

/// The same with the smallest joint rates.
#[divan::bench(args = [Discretization::Euler, Discretization::Exact], sample_count = 20)]
fn coupled_minimum_norm(bencher: Bencher<'_, '_>, discretization: Discretization) {
    run(bencher, discretization, Resolution::MinimumNorm);
}

/// The same, one pair in each of several threads.
#[divan::bench(threads = [1, 2, 4], sample_count = 8)]
fn coupled_in_threads(bencher: Bencher<'_, '_>) {
    let pair = pair();
    let schedule = Schedule::new(0.0, f64::from(DURATION), STEP).unwrap();
    bencher.counter(ItemsCount::new(DURATION)).bench(|| {
        Coupling::new(&pair).unwrap().run(&schedule, Order::Parallel, &mut |_, _, _| Ok(())).unwrap();
    });
}

fn run(bencher: Bencher<'_, '_>, discretization: Discretization, resolution: Resolution) {
    let pair = pair();
    let schedule = Schedule::new(0.0, f64::from(DURATION), STEP).unwrap();
    bencher
        .counter(ItemsCount::new(DURATION))
        .with_inputs(|| {
            let mut coupling = Coupling::new(&pair).unwrap();
            let choices = [("ik.discretization", discretization.number()), ("ik.resolution", resolution.number())];
            for (name, number) in choices {
                coupling.controller.set_value(name, Value::Integer(number)).unwrap();
            }
            coupling
        })
        .bench_local_values(|mut coupling| {
            coupling.run(&schedule, Order::Parallel, &mut |_, _, _| Ok(())).unwrap();
        });
}
