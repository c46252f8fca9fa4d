//! The models of the base (thesis chapter 2), each against what the thesis derives for it.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::assert_close;
use common::coupling::Coupling;
use common::model::{Coordinates, Model, angular_momentum, momentum};
use common::run::Run;
use nalgebra::{DMatrix, Matrix2, Vector2, Vector3};
use uam::control;
use uam::parameters::{Balance, BaseModel, Discretization, MAX_COORDINATES, Resolution};
use uam::scenarios::{default_parameters, find};
use uam::{Parameters, Structure};

const MODELS: [BaseModel; 5] =
    [BaseModel::Ideal, BaseModel::HorizontalThrust, BaseModel::VerticalThrust, BaseModel::Translating, BaseModel::Full];

fn links(number: usize) -> Structure {
    Structure::new(number, Balance::None).unwrap()
}

/// (2.6) with (2.5) or (2.7), and (2.20) with (2.21), as printed but for the misprints: two equal links of
/// 1 kg, 0.13 m with the centre of mass in the middle, 4.2 kg UAV, payload at the end.
fn generalized_jacobian(model: BaseModel, q: [f64; 2], payload: f64) -> Matrix2<f64> {
    let (m, l, a, total) = (1.0, 0.13, 0.065, 6.2 + payload);
    let (angles, both) = (Vector2::new(q[0], q[0] + q[1]), q[0] + q[1]);
    let (c, s) = (angles.map(f64::cos), angles.map(f64::sin));
    let fixed = Matrix2::new(l * c[0] + l * c[1], l * both.cos(), l * s[0] + l * s[1], l * both.sin());
    let reaction = |t: Vector2<f64>| {
        let first = m * a * t[0] + m * (l * t[0] + a * t[1]) + payload * (l * t[0] + l * t[1]);
        Vector2::new(-first / total, -(m * a * t[1] + payload * l * t[1]) / total)
    };
    let (along_x, mut along_y) = (reaction(c), reaction(s));
    if model != BaseModel::Translating {
        along_y.fill(0.0);
    }
    fixed + Matrix2::new(along_x[0], along_x[1], along_y[0], along_y[1])
}

/// From rest and without gravity, the first rates solve `J_gen` `q_dot` = v.
#[test]
fn the_generalized_jacobians_are_those_of_the_thesis() {
    for model in [BaseModel::Ideal, BaseModel::HorizontalThrust, BaseModel::VerticalThrust, BaseModel::Translating] {
        for (payload, grasp_time) in [(0.0, 1e9), (0.9, -1.0)] {
            let mut parameters = default_parameters(links(2));
            parameters.gravity = 0.0;
            parameters.support.stiffness = 0.0;
            parameters.ik.discretization = Discretization::Euler;
            parameters.ik.base_model = model;
            parameters.ik.sample_time = 0.01;
            (parameters.payload.mass, parameters.payload.grasp_time) = (payload, grasp_time);
            let outputs = Coupling::new(links(2), &parameters).commands;
            let rate = Vector2::new(outputs.rate_command[0], outputs.rate_command[1]);
            let velocity = generalized_jacobian(model, [-0.32, 2.228], payload) * rate;
            let wanted = parameters.reference.at(0.01).velocity;
            assert!(wanted.norm() > 1e-6);
            assert_close(velocity.as_slice(), wanted.as_slice(), 1e-12, &format!("{model:?}, {payload} kg"));
        }
    }
}

/// From rest and without gravity, 2 or 3 links with and without payload move the base as the momentum that a model
/// conserves wants it, and the end effector as it is wanted: by differences of places, without any Jacobian.
#[test]
fn every_model_conserves_its_momentum_from_rest() {
    for (number, payload, model) in [2, 3]
        .into_iter()
        .flat_map(|n| [0.0, 0.9].into_iter().flat_map(move |m| MODELS.map(move |model| (n, m, model))))
    {
        let mut parameters = default_parameters(links(number));
        parameters.gravity = 0.0;
        parameters.support.stiffness = 0.0;
        parameters.ik.discretization = Discretization::Euler;
        parameters.ik.resolution = Resolution::MinimumNorm;
        parameters.ik.base_model = model;
        parameters.ik.sample_time = 0.01;
        (parameters.payload.mass, parameters.payload.grasp_time) = (payload, if payload > 0.0 { -1.0 } else { 1e9 });
        let outputs = Coupling::new(links(number), &parameters).commands;

        let vehicle = Model { structure: links(number), parameters: parameters.clone() };
        let angles = parameters.joints[..number].iter().map(|joint| joint.start).collect();
        let start = Coordinates { pose: Vector3::zeros(), q: angles };
        // Base x, y and roll, each alone, and the arm as the controller moves it.
        let still = Coordinates { pose: Vector3::zeros(), q: vec![0.0; number] };
        let base: [Coordinates; 3] =
            std::array::from_fn(|i| Coordinates { pose: Vector3::ith(i, 1.0), ..still.clone() });
        let arm = Coordinates { q: outputs.rate_command[..number].to_vec(), ..still };
        let momentum_of = |speed: &Coordinates| {
            let bodies = vehicle.bodies(&start, speed, payload > 0.0);
            momentum(&bodies).push(angular_momentum(&bodies, Vector2::zeros()))
        };
        let conserved = match model {
            BaseModel::Full => 3,
            BaseModel::Translating => 2,
            _ => 1,
        };
        let columns = base.each_ref().map(momentum_of);
        let matrix = DMatrix::from_fn(conserved, conserved, |row, column| columns[column][row]);
        let reaction = matrix.lu().solve(&-momentum_of(&arm).rows(0, conserved)).unwrap();

        let speed = Coordinates { pose: Vector3::from_fn(|i, _| reaction.get(i).copied().unwrap_or(0.0)), ..arm };
        let velocity = vehicle.velocity_of(&start, &speed, Model::end_effector);
        let wanted = parameters.reference.at(0.01).velocity;
        assert!(wanted.norm() > 1e-6);
        let error = (velocity - wanted).norm() / wanted.norm();
        assert!(error < 1e-8, "{number} links, {payload} kg, {model:?}: {error:e}");
    }
}

/// Whatever a model neglects, its own end effector is on the reference: with 1 to 6 links, with and without
/// payload, by both discretizations.
#[test]
fn every_model_follows_the_path_in_its_own_prediction() {
    for number in 1..=6 {
        for model in MODELS {
            for (discretization, tolerance) in [(Discretization::Euler, 1e-3), (Discretization::Exact, 1e-9)] {
                for grasp_time in [1e9, 0.08] {
                    let mut parameters = default_parameters(links(number));
                    parameters.support.stiffness = 0.0;
                    parameters.payload.grasp_time = grasp_time;
                    parameters.ik.resolution = Resolution::MinimumNorm;
                    parameters.ik.discretization = discretization;
                    parameters.ik.base_model = model;
                    let mut outputs = control::Outputs::default();
                    let mut planner = control::new(links(number), &parameters, &mut outputs).unwrap();
                    for k in 0..15 {
                        let t = 0.01 * f64::from(k);
                        planner.step(&control::Inputs::default(), t, 0.01, &mut outputs).unwrap();
                    }
                    let error = (outputs.predicted_end_effector - outputs.reference).norm();
                    // A single link cannot follow a path in the plane.
                    let bound = if number == 1 { 1.0 } else { tolerance };
                    assert!(error < bound, "{number} links, {model:?}, {discretization:?}: {error:e}");
                }
            }
        }
    }
}

/// (2.18) and (2.19): the altitude follows M y'' = -PID - weight of the payload, whatever the arm does.
#[test]
fn the_altitude_of_vertical_thrust_is_that_of_a_rigid_body() {
    let mut scenario = find("2.3b").unwrap();
    scenario.parameters.payload.grasp_time = -1.0;
    let mut outputs = control::Outputs::default();
    let parameters = &scenario.parameters;
    let mut planner = control::new(scenario.structure, parameters, &mut outputs).unwrap();
    for k in 0..20 {
        let t = 0.01 * f64::from(k);
        planner.step(&control::Inputs::default(), t, 0.01, &mut outputs).unwrap();
    }
    let (mass, size, load) = (7.1, 1e-6, -0.9 * 9.81);
    let (mut y, mut v, mut integral) = (0.0, 0.0, 0.0);
    for _ in 0..200_000 {
        integral += size * y;
        v += size * (load - 1000.0 * y - 500.0 * v - 500.0 * integral) / mass;
        y += size * v;
    }
    assert!(outputs.predicted_pose.z.abs() < 2e-3, "cos roll is nearly 1: {}", outputs.predicted_pose.z);
    assert_close(&[outputs.predicted_pose.y], &[y], 1e-6, "altitude");
    assert_close(&[outputs.predicted_velocity.y], &[v], 1e-5, "velocity");
}

/// Under an ideal autopilot the base can only slide: every model predicts the same.
#[test]
fn under_an_ideal_autopilot_all_models_are_ideal() {
    let rates = |model: BaseModel| {
        let mut parameters = find("2.1a").unwrap().parameters;
        parameters.ik.base_model = model;
        let mut coupling = Coupling::new(links(2), &parameters);
        (0..20).for_each(|_| coupling.step(0.01));
        coupling.commands.rate_command
    };
    assert!(MODELS.iter().all(|&model| rates(model) == rates(BaseModel::Ideal)));
}

/// 2.1a as the thesis ran it, rates computed beforehand and interpolated between the samples: velocity errors
/// of the order of 1e-6 m/s, position errors of hundredths of a millimetre.
#[test]
fn interpolated_rates_err_by_a_micrometre_per_second() {
    let scenario = find("2.1a").unwrap();
    let mut parameters = scenario.parameters;
    parameters.ik.discretization = Discretization::Euler;
    let mut commands = control::Outputs::default();
    let mut planner = control::new(scenario.structure, &parameters, &mut commands).unwrap();
    let mut plant = Run::new(scenario.structure, parameters.clone());
    let (size, mut before) = (scenario.step, [0.0; MAX_COORDINATES]);
    let (mut velocity_error, mut position_error) = (0.0_f64, 0.0_f64);
    for _ in 0..5000 {
        let (now, t) = (commands.rate_command, plant.time);
        plant.inputs.rate_command = before;
        plant.inputs.acceleration_command = std::array::from_fn(|i| (now[i] - before[i]) / size);
        plant.step(size);
        planner.step(&control::Inputs::default(), t, size, &mut commands).unwrap();
        before = now;
        velocity_error = velocity_error.max((plant.outputs.end_effector_velocity - commands.reference_velocity).norm());
        position_error = position_error.max((plant.outputs.end_effector - commands.reference).norm());
    }
    assert!(velocity_error < 3e-5, "{velocity_error:e}");
    assert!(position_error < 1e-4, "{position_error:e}");
}

/// The path is symmetric in time, the thrust is not: the arm comes back another way than it went, unless
/// momentum is conserved.
#[test]
fn the_arm_comes_back_another_way_if_the_thrust_tilts() {
    let differs = |id: &str| {
        let scenario = find(id).unwrap();
        let mut coupling = Coupling::new(scenario.structure, &scenario.parameters);
        let mut angles = vec![coupling.plant.outputs.position[0]];
        for _ in 0..1000 {
            coupling.step(0.01);
            angles.push(coupling.plant.outputs.position[0]);
        }
        angles.iter().zip(angles.iter().rev()).map(|(there, back)| (there - back).abs()).fold(0.0, f64::max)
    };
    assert!(differs("2.1a") < 1e-3, "{}", differs("2.1a"));
    assert!(differs("2.2a") > 0.1, "{}", differs("2.2a"));
}

/// What is left out shows where the thesis says: sinking by the model without altitude, nothing by the full one.
#[test]
fn what_a_model_leaves_out_is_its_error() {
    let error = |model: BaseModel| {
        let mut parameters: Parameters = find("2.3b").unwrap().parameters;
        parameters.payload.grasp_time = -1.0;
        parameters.ik.base_model = model;
        let mut coupling = Coupling::new(links(2), &parameters);
        let mut error = Vector2::zeros();
        for _ in 0..300 {
            coupling.step(1e-3);
            error = (coupling.plant.outputs.end_effector - coupling.commands.reference).abs().sup(&error);
        }
        error
    };
    let [sinking, rigid, full] = [BaseModel::HorizontalThrust, BaseModel::VerticalThrust, BaseModel::Full].map(error);
    assert!(sinking.y > 3e-3, "{sinking}");
    assert!(rigid.y < 0.25 * sinking.y, "{rigid}");
    assert!(full.norm() < 1e-9, "{full}");
}
