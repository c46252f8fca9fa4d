//! What a redundant arm does beside its path: weighted norms and the gradient of the moment of weight
//! (thesis 1.8 and 3.1), against matrices built from other runs and a list of bodies.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::coupling::Coupling;
use common::model::{Coordinates, Model, Part, center_of_mass};
use common::random::Random;
use common::{assert_close, cases, derivative};
use nalgebra::{DMatrix, DVector, Vector3};
use proptest::prelude::*;
use uam::parameters::{Balance, BaseModel, Discretization, Resolution};
use uam::reference::{Leg, Profile};
use uam::{Parameters, Structure};

/// Length of the first interval \[s\].
const STEP: f64 = 0.01;

/// A random vehicle without gravity, so that from rest the first rates depend on path and method only.
fn vehicle(random: &mut Random) -> (Structure, Parameters) {
    let structure = Structure::new(3 + (random.unit() * 4.0) as usize, Balance::None).unwrap();
    let mut p = random.parameters(structure);
    for joint in &mut p.joints {
        joint.start = random.between(0.4, 1.2) * if random.coin() { 1.0 } else { -1.0 };
        joint.rate_limit = 1e9;
    }
    p.gravity = 0.0;
    p.payload.grasp_time = if random.coin() { -1.0 } else { 1e9 };
    p.ik.base_model = if random.coin() { BaseModel::Ideal } else { BaseModel::Full };
    p.ik.discretization = Discretization::Euler;
    p.ik.resolution = Resolution::MinimumNorm;
    p.ik.sample_time = STEP;
    (structure, p)
}

/// The first rates for a wanted velocity.
fn first_rates(structure: Structure, parameters: &Parameters, dx: f64, dy: f64) -> DVector<f64> {
    let mut p = parameters.clone();
    // Constant acceleration, of which the first interval ends at velocity (dx, dy).
    let leg = Leg { start: 0.0, duration: 2.0, ramp: 1.0, dx: dx / STEP, dy: dy / STEP, profile: Profile::Trapezoidal };
    p.reference.legs = [leg, Leg::NONE, Leg::NONE, Leg::NONE];
    let rates = Coupling::new(structure, &p).commands.rate_command;
    DVector::from_column_slice(&rates[..structure.links])
}

/// The matrix that makes rates of velocities.
fn inverse(structure: Structure, parameters: &Parameters) -> DMatrix<f64> {
    DMatrix::from_columns(&[first_rates(structure, parameters, 1.0, 0.0), first_rates(structure, parameters, 0.0, 1.0)])
}

/// The generalized Jacobian, of which the smallest rates come by its pseudo-inverse.
fn jacobian(structure: Structure, parameters: &Parameters) -> DMatrix<f64> {
    inverse(structure, parameters).pseudo_inverse(0.0).unwrap()
}

proptest! {
    #![proptest_config(cases(100))]

    /// Rates are `W^-1 J^T (J W^-1 J^T)^-1 v`; only ratios of weights count.
    #[test]
    fn weights_decide_who_moves(seed: u64) {
        let random = &mut Random(seed);
        let (structure, mut parameters) = vehicle(random);
        let j = jacobian(structure, &parameters);
        for joint in &mut parameters.joints {
            joint.weight = 10.0_f64.powf(random.about_zero(0.5));
        }
        let by_weight = parameters.joints[..structure.links].iter().map(|joint| 1.0 / joint.weight);
        let w = DMatrix::from_diagonal(&DVector::from_iterator(structure.links, by_weight));
        let expected = &w * j.transpose() * (&j * &w * j.transpose()).try_inverse().unwrap();
        let found = inverse(structure, &parameters);
        assert_close(found.as_slice(), expected.as_slice(), 1e-8, "inverse");
        for joint in &mut parameters.joints {
            joint.weight *= 1e3;
        }
        assert_close(inverse(structure, &parameters).as_slice(), found.as_slice(), 1e-12, "scaled weights");
    }

    /// A joint that weighs much holds still.
    #[test]
    fn a_heavy_joint_holds_still(seed: u64) {
        let random = &mut Random(seed);
        let (structure, mut parameters) = vehicle(random);
        let joint = (random.unit() * structure.links as f64) as usize;
        let before = inverse(structure, &parameters);
        parameters.joints[joint].weight = 1e12;
        prop_assert!(inverse(structure, &parameters).row(joint).norm() < 1e-6 * before.norm());
    }

    /// Beside the smallest rates, those down the gradient that do not disturb the path (3.5), (3.7).
    #[test]
    fn the_gradient_moves_the_centre_of_mass_below_the_uav(seed: u64) {
        let random = &mut Random(seed);
        let (structure, mut parameters) = vehicle(random);
        let j = jacobian(structure, &parameters);
        let smallest = first_rates(structure, &parameters, 0.1, -0.2);
        parameters.ik.resolution = Resolution::Gradient;
        parameters.ik.gradient_gain = random.between(-400.0, -10.0);

        let model = Model { structure, parameters: parameters.clone() };
        let start: Vec<f64> = parameters.joints[..structure.links].iter().map(|joint| joint.start).collect();
        let distance = |joint: usize, angle: f64| {
            let mut at = Coordinates { pose: Vector3::zeros(), q: start.clone() };
            at.q[joint] += angle;
            let mut bodies = model.bodies(&at, &at, parameters.payload.grasp_time < 0.0);
            bodies.retain(|body| body.part != Part::Uav);
            center_of_mass(&bodies).x
        };
        let gradient = |joint: usize| derivative(|angle| distance(joint, angle).powi(2));
        let preferred = DVector::from_fn(structure.links, |i, _| parameters.ik.gradient_gain * gradient(i));
        let beside = &preferred - j.clone().pseudo_inverse(0.0).unwrap() * (&j * &preferred);

        let found = first_rates(structure, &parameters, 0.1, -0.2);
        assert_close(found.as_slice(), (smallest + beside).as_slice(), 1e-7, "rates");
    }
}

/// On an arm at rest the gradient brings the centres of mass together while the end effector stays.
#[test]
fn at_rest_the_gradient_balances_the_arm() {
    let mut parameters = uam::parameters::defaults::default_parameters(Structure::DEFAULT);
    parameters.payload.grasp_time = 1e9;
    parameters.reference.legs = [const { Leg::NONE }; 4];
    parameters.joints[0].start += 0.3;
    parameters.ik.resolution = Resolution::Gradient;
    parameters.ik.sample_time = 5e-3;
    let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
    let moment = |coupling: &Coupling| coupling.plant.outputs.transmitted_moment.abs();
    let before = moment(&coupling);
    for _ in 0..800 {
        coupling.step(5e-3);
        assert!(coupling.error() < 1e-9, "t = {}: {:e}", coupling.plant.time, coupling.error());
    }
    assert!(moment(&coupling) < 0.02 * before, "{} of {before}", moment(&coupling));
}
