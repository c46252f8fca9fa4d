//! Cost of the finished FMUs through their C interface: loading, starting, steps, coupled runs.
//!
//!     cargo bench --package fmu-build

#![allow(clippy::unwrap_used, reason = "a benchmark that cannot start has nothing to say")]

use std::cell::RefCell;
use std::path::Path;
use std::sync::LazyLock;

use divan::Bencher;
use divan::counter::ItemsCount;
use fmu_build::host::coupling::{Pair, Schedule};
use fmu_build::host::fmu::{Causality, Fmu, Instance, Selection, Value, Values};
use fmu_build::{BuildOptions, Built, build};
use uam::Structure;
use uam::parameters::{Discretization, Resolution};
use uam::variables::options::Choice;

static BUILT: LazyLock<Built> = LazyLock::new(|| built(Structure::DEFAULT.links));

/// Length of a run, and of a step \[s\].
const DURATION: u32 = 30;
const STEP: f64 = 1e-3;
/// Longer than any measurement \[s\].
const LONG: f64 = 1e6;

fn main() {
    LazyLock::force(&BUILT);
    divan::main();
}

/// The FMUs of a vehicle with this number of links.
fn built(links: usize) -> Built {
    let structure = Structure { links, ..Structure::DEFAULT };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("benches-{links}"));
    build(&BuildOptions::new(structure, folder), &|_| {}).unwrap()
}

fn open(built: &Built) -> Pair {
    Pair::open(&built.controller, &built.plant).unwrap()
}

fn pair() -> Pair {
    open(&BUILT)
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

/// A step of the plant, with all inputs set before it and all outputs got after it, by number of links.
#[divan::bench(args = [1, 2, 3, 4, 5, 6], sample_size = 1000)]
fn plant_step_with_all_values(bencher: Bencher<'_, '_>, links: usize) {
    let pair = open(&built(links));
    let mut unit = Stepped::new(&pair.plant);
    bencher.bench_local(|| unit.step());
}

/// The same for the controller.
#[divan::bench(args = [1, 2, 3, 4, 5, 6], sample_size = 1000)]
fn controller_step_with_all_values(bencher: Bencher<'_, '_>, links: usize) {
    let pair = open(&built(links));
    let mut unit = Stepped::new(&pair.controller);
    bencher.bench_local(|| unit.step());
}

thread_local! {
    static OWN: RefCell<Stepped> = RefCell::new(Stepped::new(&pair().plant));
}

/// A plant in each of several threads: time per step of one of them.
#[divan::bench(threads = [1, 2, 4], sample_size = 1000)]
fn plant_step_in_threads(bencher: Bencher<'_, '_>) {
    bencher.bench(|| OWN.with_borrow_mut(Stepped::step));
}

/// Of which unit a state is copied.
#[derive(Debug, Clone, Copy)]
enum Side {
    Plant,
    Controller,
}

const SIDES: [Side; 2] = [Side::Plant, Side::Controller];

/// `fmi2GetFMUstate` into a state that is there.
#[divan::bench(args = SIDES)]
fn get_state(bencher: Bencher<'_, '_>, side: Side) {
    let mut unit = saved(side);
    bencher.bench_local(|| unit.save().unwrap());
}

/// `fmi2SetFMUstate`.
#[divan::bench(args = SIDES)]
fn set_state(bencher: Bencher<'_, '_>, side: Side) {
    let mut unit = saved(side);
    bencher.bench_local(|| unit.restore().unwrap());
}

/// `fmi2SerializedFMUstateSize` and `fmi2SerializeFMUstate`.
#[divan::bench(args = SIDES)]
fn serialize_state(bencher: Bencher<'_, '_>, side: Side) {
    let mut unit = saved(side);
    bencher.bench_local(|| unit.saved_bytes().unwrap());
}

/// `fmi2DeSerializeFMUstate` into a state that is there.
#[divan::bench(args = SIDES)]
fn deserialize_state(bencher: Bencher<'_, '_>, side: Side) {
    let mut unit = saved(side);
    let bytes = unit.saved_bytes().unwrap();
    bencher.bench_local(|| unit.save_bytes(&bytes).unwrap());
}

/// A unit after its first step, with its state saved.
fn saved(side: Side) -> Instance {
    let pair = pair();
    let mut unit = match side {
        Side::Plant => pair.plant.instantiate("plant"),
        Side::Controller => pair.controller.instantiate("controller"),
    }
    .unwrap();
    unit.initialize(0.0, LONG).unwrap();
    unit.do_step(0.0, STEP).unwrap();
    unit.save().unwrap();
    unit
}

/// A unit that is stepped on and on, with all its inputs and outputs.
struct Stepped {
    unit: Instance,
    inputs: Selection,
    outputs: Selection,
    given: Values,
    seen: Values,
    steps: u32,
}

impl Stepped {
    fn new(fmu: &Fmu) -> Self {
        let description = fmu.description();
        let select = |causality| {
            Selection::new(description, description.with(causality).map(|variable| variable.name.as_str())).unwrap()
        };
        let (inputs, outputs) = (select(Causality::Input), select(Causality::Output));
        let mut unit = fmu.instantiate("unit").unwrap();
        unit.initialize(0.0, LONG).unwrap();
        Self { unit, given: inputs.values(), seen: outputs.values(), inputs, outputs, steps: 0 }
    }

    fn step(&mut self) {
        self.unit.set(&self.inputs, &self.given).unwrap();
        self.unit.do_step(f64::from(self.steps) * STEP, STEP).unwrap();
        self.unit.get(&self.outputs, &mut self.seen).unwrap();
        self.steps += 1;
    }
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
        pair.couple().unwrap().run(&schedule, &mut |_, _, _| Ok(())).unwrap();
    });
}

fn run(bencher: Bencher<'_, '_>, discretization: Discretization, resolution: Resolution) {
    let pair = pair();
    let schedule = Schedule::new(0.0, f64::from(DURATION), STEP).unwrap();
    bencher
        .counter(ItemsCount::new(DURATION))
        .with_inputs(|| {
            let mut coupling = pair.couple().unwrap();
            let choices = [("ik.discretization", discretization.number()), ("ik.resolution", resolution.number())];
            for (name, number) in choices {
                coupling.controller.set_value(name, Value::Integer(number)).unwrap();
            }
            coupling
        })
        .bench_local_values(|mut coupling| {
            coupling.run(&schedule, &mut |_, _, _| Ok(())).unwrap();
        });
}
