//! Runs every scenario of the catalogue with every discretization, both units coupled in this program, and prints a
//! digest of all outputs for each. It needs nothing but Rust's standard library and runs on every platform.

use std::process::ExitCode;

use digests::{Digest, EVERY};
use uam::fmi::v2::{Error, Instance};
use uam::fmi::{Identity, Model, Naming};
use uam::parameters::Discretization;
use uam::scenarios::{Scenario, catalogue};
use uam::units::{controller::ControllerUnit, plant::PlantUnit};
use uam::variables::Causality;
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
            match digest(&variant) {
                Ok(digest) => println!("{}", digest.line(&scenario.id, discretization.name())),
                Err(error) => println!("{} {} cannot start: {error}", scenario.id, discretization.name()),
            }
        }
    }
    ExitCode::SUCCESS
}

/// Runs a scenario to its end, or to where a unit cannot go on.
fn digest(scenario: &Scenario) -> Result<Digest, Error> {
    let mut controller = instance::<ControllerUnit>(scenario, |data| data.parameters = scenario.parameters.clone());
    let mut plant = instance::<PlantUnit>(scenario, |data| data.parameters = scenario.parameters.clone());
    let [commands, measurements] = [wires(&controller, &plant), wires(&plant, &controller)];
    let outputs = (references(&controller, Causality::Output), references(&plant, Causality::Output));

    controller.setup_experiment(0.0, Some(scenario.duration))?;
    plant.setup_experiment(0.0, Some(scenario.duration))?;
    controller.enter_initialization()?;
    plant.enter_initialization()?;
    carry(&commands, &mut controller, &mut plant)?;
    carry(&measurements, &mut plant, &mut controller)?;
    controller.exit_initialization()?;
    plant.exit_initialization()?;

    let mut digest = Digest::default();
    let mut look = |controller: &mut Instance<ControllerUnit>, plant: &mut Instance<PlantUnit>| {
        digest.add(values(controller, &outputs.0)?);
        digest.add(values(plant, &outputs.1)?);
        Ok::<_, Error>(())
    };
    look(&mut controller, &mut plant)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some thousands")]
    let steps = (scenario.duration / scenario.step).round() as usize;
    for n in 0..steps {
        #[expect(clippy::cast_precision_loss, reason = "some thousands")]
        let t = n as f64 * scenario.step;
        carry(&commands, &mut controller, &mut plant)?;
        carry(&measurements, &mut plant, &mut controller)?;
        if plant.do_step(t, scenario.step).and_then(|()| controller.do_step(t, scenario.step)).is_err() {
            break;
        }
        if (n + 1) % EVERY == 0 || n + 1 == steps {
            look(&mut controller, &mut plant)?;
        }
    }
    Ok(digest)
}

/// A new instance that begins with other values.
fn instance<M: Model<Structure = uam::Structure>>(scenario: &Scenario, set: impl FnOnce(&mut M::Data)) -> Instance<M> {
    let mut start = M::start(scenario.structure);
    set(&mut start);
    Instance::new(Identity { structure: scenario.structure, naming: Naming::Structured, start })
}

/// Value references of all variables of a causality.
fn references<M: Model>(instance: &Instance<M>, causality: Causality) -> Vec<u32> {
    let variables = (0..).zip(instance.variables());
    variables.filter(|(_, variable)| variable.causality == causality).map(|(reference, _)| reference).collect()
}

/// References of outputs of one unit, and of the inputs of the other with the same names.
type Wires = [Vec<u32>; 2];

fn wires<A: Model, B: Model>(from: &Instance<A>, to: &Instance<B>) -> Wires {
    let named = |reference: u32| from.variables().get(reference as usize).map(|variable| variable.name.as_str());
    let inputs = references(to, Causality::Input);
    let input = |name: Option<&str>| {
        inputs.iter().find(|input| to.variables().get(**input as usize).map(|variable| variable.name.as_str()) == name)
    };
    let outputs = references(from, Causality::Output);
    outputs.into_iter().filter_map(|output| Some((output, *input(named(output))?))).unzip().into()
}

fn carry<A: Model, B: Model>(
    [outputs, inputs]: &Wires,
    from: &mut Instance<A>,
    to: &mut Instance<B>,
) -> Result<(), Error> {
    to.set(inputs, &values(from, outputs)?)
}

/// Values as plain numbers: truth is 1, an alternative its number.
fn values<M: Model>(instance: &mut Instance<M>, references: &[u32]) -> Result<Vec<f64>, Error> {
    let mut values = vec![0.0; references.len()];
    instance.get(references, &mut values)?;
    Ok(values)
}
