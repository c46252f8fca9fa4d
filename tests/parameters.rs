//! Wrong parameters are errors that name the parameter.

mod common;

use uam::parameters::{Balance, MAX_LINKS, Resolution};
use uam::scenarios::default_parameters;
use uam::{Error, Parameters, Structure, controller, plant};

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
    controller::new(structure, parameters, &mut controller::Outputs::default()).err()
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
