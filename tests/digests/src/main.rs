//! Runs every scenario of the catalogue with every discretization, both units coupled in this program, and prints a
//! digest of all outputs for each. It needs nothing but Rust's standard library and runs on every platform.

use std::process::ExitCode;

use uam::parameters::Discretization;
use uam::scenarios::catalogue;
use uam::variables::options::Choice;

fn main() -> ExitCode {
    let scenarios = match catalogue() {
        Ok(scenarios) => scenarios,
        Err(error) => {
            eprintln!("error: {error}");
            return ExitCode::FAILURE;
        }
    };
    for scenario in scenarios {
        for discretization in [Discretization::Euler, Discretization::Exact] {
            let mut variant = scenario.clone();
            variant.parameters.ik.discretization = discretization;
            match digests::in_process(&variant) {
                Ok(digest) => println!("{}", digest.line(&scenario.id, discretization.name())),
                Err(error) => println!("{} {} cannot start: {error}", scenario.id, discretization.name()),
            }
        }
    }
    ExitCode::SUCCESS
}
