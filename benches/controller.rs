//! Cost of the inverse kinematics: steps of the controller by method and by number of links.
//!
//!     cargo bench --bench controller

#![allow(clippy::unwrap_used, reason = "a benchmark that cannot start has nothing to say")]

use divan::Bencher;
use uam::parameters::defaults::default_parameters;
use uam::parameters::{Discretization, Hold, Resolution};
use uam::{Parameters, Structure};

mod motion;

use motion::{ControllerRun, STEPS, links};

fn main() {
    divan::main();
}

/// A method, and whether a limit binds.
#[derive(Debug)]
struct Method {
    name: &'static str,
    change: fn(&mut Parameters),
}

impl std::fmt::Display for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

const METHODS: [Method; 7] = [
    Method { name: "minimum_norm", change: |parameters| parameters.ik.resolution = Resolution::MinimumNorm },
    Method { name: "extended_jacobian", change: |parameters| parameters.ik.resolution = Resolution::ExtendedJacobian },
    Method { name: "gradient", change: |parameters| parameters.ik.resolution = Resolution::Gradient },
    Method { name: "least_squares", change: |parameters| parameters.ik.resolution = Resolution::LeastSquares },
    Method {
        name: "least_squares, limited",
        change: |parameters| {
            parameters.ik.resolution = Resolution::LeastSquares;
            parameters.joints.iter_mut().for_each(|joint| joint.rate_limit = 0.3);
        },
    },
    Method {
        name: "extended_jacobian, first_order",
        change: |parameters| {
            parameters.ik.resolution = Resolution::ExtendedJacobian;
            parameters.ik.hold = Hold::FirstOrder;
        },
    },
    Method {
        name: "extended_jacobian, limited",
        change: |parameters| {
            parameters.ik.resolution = Resolution::ExtendedJacobian;
            parameters.joints.iter_mut().for_each(|joint| joint.rate_limit = 0.3);
        },
    },
];

/// The step of the thesis.
#[divan::bench(args = METHODS, sample_size = STEPS)]
fn euler(bencher: Bencher<'_, '_>, method: &Method) {
    run(bencher, Structure::DEFAULT, Discretization::Euler, method.change);
}

/// Integrated through the coming interval.
#[divan::bench(args = METHODS, sample_size = STEPS)]
fn exact(bencher: Bencher<'_, '_>, method: &Method) {
    run(bencher, Structure::DEFAULT, Discretization::Exact, method.change);
}

/// Accelerations of one link and of the body that balances it (thesis 3.4).
#[divan::bench(sample_size = STEPS)]
fn acceleration_level(bencher: Bencher<'_, '_>) {
    let scenario = uam::scenarios::find("3.4-1").unwrap();
    let mut controller = ControllerRun::new(scenario.structure, scenario.parameters);
    bencher.bench_local(|| controller.step());
}

/// Minimum norm with the step of the thesis, by number of links.
#[divan::bench(args = [1, 2, 3, 4, 5, 6], sample_size = STEPS)]
fn euler_by_links(bencher: Bencher<'_, '_>, number: usize) {
    run(bencher, links(number), Discretization::Euler, METHODS[0].change);
}

/// Minimum norm, integrated through the coming interval, by number of links.
#[divan::bench(args = [1, 2, 3, 4, 5, 6], sample_size = STEPS)]
fn exact_by_links(bencher: Bencher<'_, '_>, number: usize) {
    run(bencher, links(number), Discretization::Exact, METHODS[0].change);
}

fn run(bencher: Bencher<'_, '_>, structure: Structure, discretization: Discretization, change: fn(&mut Parameters)) {
    let mut parameters = default_parameters(structure);
    change(&mut parameters);
    parameters.ik.discretization = discretization;
    let mut controller = ControllerRun::new(structure, parameters);
    bencher.bench_local(|| controller.step());
}
