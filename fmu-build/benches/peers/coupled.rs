//! Both FMUs coupled through 30 s of the pick-up (thesis 4.3) in steps of 1 ms, against real time.

use std::process::Command;
use std::time::Instant;

use fmu_build::host::coupling::{Pair, Schedule};
use fmu_build::host::fmu::{Instance, Selection};
use uam::parameters::{Discretization, Resolution};
use uam::variables::options::Choice;

use crate::kinematics::choose;
use crate::measure::{Candidate, Contest, Spread};

const DURATION: f64 = 30.0;
const STEP: f64 = 1e-3;
const STEPS: u32 = 30_000;
const METHODS: [(Discretization, Resolution); 4] = [
    (Discretization::Euler, Resolution::MinimumNorm),
    (Discretization::Euler, Resolution::ExtendedJacobian),
    (Discretization::Exact, Resolution::MinimumNorm),
    (Discretization::Exact, Resolution::ExtendedJacobian),
];

/// Joint rates and grasp go from the controller to the plant, and nothing back: seconds per simulated second.
fn commands_only(controller: &mut Instance, plant: &mut Instance) -> f64 {
    let names = ["joint[1].rate_command", "joint[2].rate_command", "joint[3].rate_command", "grasp"];
    let [from, to] = [&*controller, &*plant].map(|unit| Selection::new(unit.description(), names).unwrap());
    let mut values = from.values();
    controller.initialize(0.0, DURATION).unwrap();
    plant.initialize(0.0, DURATION).unwrap();
    let begin = Instant::now();
    for n in 0..STEPS {
        let t = f64::from(n) * STEP;
        controller.get(&from, &mut values).unwrap();
        plant.set(&to, &values).unwrap();
        plant.do_step(t, STEP).unwrap();
        controller.do_step(t, STEP).unwrap();
    }
    let elapsed = begin.elapsed().as_secs_f64();
    controller.reset().unwrap();
    plant.reset().unwrap();
    elapsed / DURATION
}

/// Every output goes to the input of the same name: seconds per simulated second.
fn all_values(pair: &Pair, discretization: Discretization, resolution: Resolution) -> f64 {
    let mut coupling = pair.couple().unwrap();
    choose(&mut coupling.controller, discretization, resolution);
    let schedule = Schedule::new(0.0, DURATION, STEP).unwrap();
    let begin = Instant::now();
    coupling.run(&schedule, &mut |_, _, _| Ok(())).unwrap();
    begin.elapsed().as_secs_f64() / DURATION
}

pub fn contest(pair: &Pair) -> Contest<'_> {
    let mut candidates = Vec::new();
    for (discretization, resolution) in METHODS {
        let name = |what: &str| format!("native, {what}, {}, {}", discretization.name(), resolution.name());
        let mut controller = pair.controller.instantiate("controller").unwrap();
        let mut plant = pair.plant.instantiate("plant").unwrap();
        candidates.push(Candidate::new(name("rates and grasp"), None, move || {
            choose(&mut controller, discretization, resolution);
            commands_only(&mut controller, &mut plant)
        }));
        candidates.push(Candidate::new(name("all values"), None, move || all_values(pair, discretization, resolution)));
    }
    Contest { title: "Coupled run, 30 s in steps of 1 ms", candidates }
}

/// The same with masters in FMPy: name, times real time.
pub fn in_fmpy(pair: &Pair, rounds: usize) -> Vec<(String, Spread)> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/peers/masters.py");
    let Some(python) = std::env::var_os("PEERS_PYTHON") else {
        println!("skipped: FMPy (the environment variable PEERS_PYTHON names no interpreter)");
        return Vec::new();
    };
    let run = Command::new(python)
        .arg(script)
        .args([pair.controller.path(), pair.plant.path()])
        .arg(rounds.to_string())
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let mut results: Vec<(String, Vec<f64>)> = Vec::new();
    for line in String::from_utf8(run.stdout).unwrap().lines() {
        let (number, name) = line.split_once(' ').unwrap();
        let (number, name) =
            (number.parse().unwrap(), format!("FMPy, {name}, {}", Resolution::ExtendedJacobian.name()));
        match results.iter_mut().find(|(found, _)| *found == name) {
            Some((_, numbers)) => numbers.push(number),
            None => results.push((name, vec![number])),
        }
    }
    results.into_iter().map(|(name, numbers)| (name, Spread::of(numbers))).collect()
}
