//! Wrong parameters are errors that name the parameter.

mod common;

use uam::fmi::v2::Instance;
use uam::fmi::{CommunicationStep, Identity, Model};
use uam::parameters::defaults::default_parameters;
use uam::parameters::{Balance, MAX_LINKS, Resolution};
use uam::units::{controller::ControllerUnit, plant::PlantUnit};
use uam::variables::declare::Part;
use uam::variables::{Bounds, Causality, Kind, Variable};
use uam::{Error, Parameters, Structure, control, plant};

type Change = fn(&mut Parameters);

fn changed(structure: Structure, change: Change) -> Parameters {
    let mut parameters = default_parameters(structure);
    change(&mut parameters);
    parameters
}

#[test]
fn defaults_are_within_their_bounds() {
    for structure in Structure::all() {
        default_parameters(structure).check(structure).unwrap();
    }
}

#[test]
fn check_names_the_parameter_out_of_its_bounds() {
    let structure = Structure::new(3, Balance::Counterweight).unwrap();
    let wrong: [(&str, Change); 16] = [
        ("gravity", |p| p.gravity = -9.81),
        ("uav.mass", |p| p.uav.mass = -1.0),
        ("uav.mass", |p| p.uav.mass = 0.0),
        ("uav.mass", |p| p.uav.mass = f64::NAN),
        ("uav.inertia", |p| p.uav.inertia = f64::INFINITY),
        ("mount.x", |p| p.mount.x = f64::NAN),
        ("link[2].mass", |p| p.links[1].mass = -0.1),
        ("link[3].length", |p| p.links[2].length = 0.0),
        ("link[1].inertia", |p| p.links[0].inertia = -1e-9),
        ("joint[2].start", |p| p.joints[1].start = f64::NEG_INFINITY),
        ("joint[3].rate_limit", |p| p.joints[2].rate_limit = 0.0),
        ("counterweight.mass", |p| p.counterweight.mass = -1.0),
        ("autopilot.roll.kd", |p| p.autopilot.roll.kd = -3.0),
        ("payload.mass", |p| p.payload.mass = f64::NAN),
        ("sample_time", |p| p.ik.sample_time = 0.0),
        ("reference.leg[2].duration", |p| p.reference.legs[1].duration = -1.0),
    ];
    for (name, change) in wrong {
        match changed(structure, change).check(structure).unwrap_err() {
            Error::OutOfBounds { name: found, .. } => assert_eq!(found, name),
            other => panic!("{name}: {other}"),
        }
    }
    let ramps = changed(structure, |p| p.reference.legs[0].ramp = 0.8).check(structure).unwrap_err();
    assert!(matches!(&ramps, Error::Inconsistent { name, .. } if name == "reference.leg[1].ramp"), "{ramps}");
}

/// The real parameters of a structure: name, bounds, and the start values with another one for this.
fn with_each_set_to(structure: Structure, value: f64) -> Vec<(String, Bounds, Parameters)> {
    let changed = |variable: &Variable<Parameters>| {
        let Kind::Real { at, bounds, .. } = variable.kind else { return None };
        let mut parameters = default_parameters(structure);
        *at.get_mut(&mut parameters) = value;
        Some((variable.name.clone(), bounds, parameters))
    };
    Parameters::table(structure).variables().iter().filter_map(changed).collect()
}

/// Whoever makes a plant or a controller hears of any parameter out of its bounds, and of which one.
#[test]
fn both_constructors_name_every_parameter_out_of_its_bounds() {
    for structure in Structure::all() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -3.0, 0.0] {
            for (name, bounds, parameters) in with_each_set_to(structure, value) {
                if !bounds.admit(value) {
                    let refusals = [plant::new(structure, &parameters).err(), new_controller(structure, &parameters)];
                    for refusal in refusals {
                        let said = refusal.map(|refusal| refusal.to_string());
                        let expected = format!("{name} must be {bounds}, but is {value}");
                        assert_eq!(said.as_deref(), Some(&*expected), "{structure}");
                    }
                }
            }
        }
    }
}

/// The refusals of both units to begin, and to make a step of a millisecond.
fn refusals(structure: Structure, parameters: &Parameters) -> Vec<String> {
    fn refusal<M: Model<Structure = Structure, Error = Error>>(
        structure: Structure,
        parameters: &Parameters,
    ) -> Option<Error>
    where
        M::Data: Part<Parameters>,
    {
        let mut data = M::start(structure);
        data.part_mut().clone_from(parameters);
        let step = CommunicationStep { start_time: 0.0, from: 0.0, size: 1e-3 };
        M::initialize(structure, &mut data, 0.0).and_then(|mut model| model.step(&mut data, step)).err()
    }
    let both = [refusal::<ControllerUnit>(structure, parameters), refusal::<PlantUnit>(structure, parameters)];
    both.into_iter().flatten().map(|error| error.to_string()).collect()
}

/// Whatever a number within its bounds brings about in the first plan, or makes so fast that no step can be made: it is
/// the number that is named.
#[test]
fn whatever_goes_wrong_the_parameter_is_named() {
    let mut seen = 0;
    for structure in [Structure::DEFAULT, Structure::new(2, Balance::Counterweight).unwrap()] {
        for value in [1e-300, 1e-9, 1e300, -1e300] {
            for (name, bounds, parameters) in with_each_set_to(structure, value) {
                for refusal in refusals(structure, &parameters) {
                    // Once it runs, what overflows follows from many numbers.
                    let overflows = refusal.starts_with("the state is no longer finite after t = 0.001")
                        || refusal.contains("links and UAV turn at");
                    let named = refusal.contains(&name) || overflows;
                    assert!(!bounds.admit(value) || named, "{name} = {value:e}: {refusal}");
                    seen += 1;
                }
            }
        }
    }
    assert!(seen > 50, "{seen}");
}

/// What a host hears that sets every parameter to what it cannot be: at once, and by name; and what it hears of values
/// that are refused together, when it asks for outputs.
#[test]
fn hosts_hear_which_parameter_it_is() {
    fn host<M: Model<Structure = Structure>>() -> impl Fn(&str, f64) -> String {
        |name: &str, value: f64| {
            let mut instance = Instance::<M>::new(Identity::of(Structure::DEFAULT));
            let position = |name: &str| M::table(Structure::DEFAULT).variables().iter().position(|v| v.name == name);
            let output = M::table(Structure::DEFAULT).variables().iter().position(|v| v.causality == Causality::Output);
            let [parameter, output] = [position(name), output].map(|place| u32::try_from(place.unwrap()).unwrap());
            let set = instance.set(&[parameter], &[value]);
            set.and_then(|()| instance.get(&[output], &mut [0.0])).unwrap_err().to_string()
        }
    }
    let (controller, plant) = (host::<ControllerUnit>(), host::<PlantUnit>());
    for (host, table) in [
        (
            &controller as &dyn Fn(&str, f64) -> String,
            ControllerUnit::table(Structure::DEFAULT).variables().iter().map(named).collect::<Vec<_>>(),
        ),
        (&plant, PlantUnit::table(Structure::DEFAULT).variables().iter().map(named).collect()),
    ] {
        for (name, _) in table.iter().filter(|(_, causality)| *causality == Causality::Parameter) {
            let said = host(name, f64::NAN);
            assert!(said.starts_with(&format!("{name} must be ")) && said.ends_with("but is NaN"), "{said}");
        }
    }
    for (name, value) in [("uav.inertia", 1e-9), ("sample_time", 1e5), ("ik.path_axes", 2.0), ("link[1].length", 1e300)]
    {
        let said = controller(name, value);
        assert!(said.starts_with(&format!("the simulation cannot begin: {name} = ")), "{said}");
    }
}

fn named<D>(variable: &Variable<D>) -> (String, Causality) {
    (variable.name.clone(), variable.causality)
}

/// A method that does not suit the arm, or the other methods, is named by both units' checks.
#[test]
fn methods_that_do_not_go_together_are_named() {
    let mut refused = Vec::new();
    for structure in Structure::all() {
        for variable in Parameters::table(structure).variables() {
            let Kind::Enumeration { at } = variable.kind else { continue };
            let mut parameters = default_parameters(structure);
            for number in 1..=at.get(&parameters).items().len() {
                at.get_mut(&mut parameters).choose(i32::try_from(number).unwrap());
                for refusal in refusals(structure, &parameters) {
                    // What does not suit a resolution is named together with it.
                    assert!(refusal.contains(&variable.name) || refusal.contains("with the resolution"), "{refusal}");
                    refused.push(variable.name.clone());
                }
            }
        }
    }
    refused.dedup();
    assert!(
        ["ik.resolution", "ik.path_axes"].iter().all(|name| refused.iter().any(|other| other == name)),
        "{refused:?}"
    );
}

/// What the structure does not have is not looked at.
#[test]
fn parameters_beyond_the_structure_are_ignored() {
    let structure = Structure::new(2, Balance::None).unwrap();
    let parameters = changed(structure, |p| {
        p.links[2].mass = -1.0;
        p.counterweight.mass = f64::NAN;
    });
    parameters.check(structure).unwrap();
    plant::new(structure, &parameters).unwrap();
}

#[test]
fn arms_of_no_or_too_many_links_are_refused() {
    for links in [0, MAX_LINKS + 1] {
        assert_eq!(Structure::new(links, Balance::None), Err(Error::Structure { links, largest: MAX_LINKS }));
    }
    assert_eq!(Structure::all().count(), 3 * MAX_LINKS);
}

fn new_controller(structure: Structure, parameters: &Parameters) -> Option<Error> {
    control::new(structure, parameters, &mut control::Outputs::default()).err()
}

/// Two joints follow the path and have nothing left; what balances the arm holds still.
#[test]
fn the_extended_jacobian_needs_three_joints() {
    for structure in Structure::all() {
        let enough = structure.links > 2;
        let parameters = changed(structure, |p| p.ik.resolution = Resolution::ExtendedJacobian);
        match new_controller(structure, &parameters) {
            None => assert!(enough, "{structure}"),
            Some(error) => {
                assert!(!enough);
                assert!(matches!(&error, Error::Inconsistent { name, .. } if name == "ik.resolution"), "{error}");
            }
        }
    }
}

#[test]
fn an_autopilot_cannot_sample_too_fast() {
    for (sample_time, good) in [(0.0, true), (1e-6, true), (0.9e-6, false), (-1.0, false)] {
        let mut parameters = default_parameters(Structure::DEFAULT);
        parameters.autopilot.sample_time = sample_time;
        let errors =
            [plant::new(Structure::DEFAULT, &parameters).err(), new_controller(Structure::DEFAULT, &parameters)];
        for error in errors {
            assert_eq!(error.is_none(), good, "{sample_time}");
            if let Some(error) = error {
                assert!(error.to_string().contains("autopilot.sample_time"), "{error}");
            }
        }
    }
}

/// Links without mass or inertia are admissible and do no harm: the UAV alone has both.
#[test]
fn links_without_mass_are_admissible() {
    for structure in Structure::all() {
        let mut parameters = default_parameters(structure);
        for link in &mut parameters.links {
            (link.mass, link.inertia) = (0.0, 0.0);
        }
        (parameters.counterweight.mass, parameters.counterweight.inertia) = (0.0, 0.0);
        (parameters.balance_element.mass, parameters.balance_element.inertia) = (0.0, 0.0);
        parameters.check(structure).unwrap();
        let mut coupling = common::coupling::Coupling::new(structure, &parameters);
        for _ in 0..20 {
            coupling.step(0.01);
            // Nothing that moves has mass: the UAV hovers where it is.
            assert!(coupling.plant.outputs.pose.norm() < 1e-12, "{structure}");
            assert!(coupling.commands.rate_command.iter().all(|rate| rate.is_finite()));
        }
    }
}
