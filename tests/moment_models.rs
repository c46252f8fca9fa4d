//! The models of the moment on the UAV (thesis 3.2, 3.3, 3.6), each against a list of bodies on a base that moves
//! as the model says.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::cases;
use common::coupling::Coupling;
use common::model::{Body, Coordinates, Model, Part, angular_momentum, center_of_mass, momentum, weight_moment};
use common::random::Random;
use common::simpson;
use nalgebra::{Vector2, Vector3};
use proptest::prelude::*;
use uam::autopilot::AutopilotMode;
use uam::control::{self, Status};
use uam::parameters::{Balance, BaseModel, Discretization, MomentModel, Resolution};
use uam::reference::{Leg, Profile};
use uam::{Parameters, Structure};

/// Instants at which a step is looked at.
const INSTANTS: usize = 9;

/// A random vehicle of 3 to 6 links that follows a short path, calm enough for steps of 5 ms.
fn vehicle(random: &mut Random) -> (Structure, Parameters) {
    let structure = Structure::new(3 + (random.unit() * 4.0) as usize, Balance::None).unwrap();
    let mut p = random.parameters(structure);
    for joint in &mut p.joints {
        joint.start = random.between(0.4, 1.2) * if random.coin() { 1.0 } else { -1.0 };
    }
    let leg = Leg {
        start: 0.0,
        duration: 0.5,
        ramp: 0.2,
        dx: random.about_zero(0.01),
        dy: random.about_zero(0.01),
        profile: Profile::Smooth,
    };
    p.reference.legs = [leg, Leg::NONE, Leg::NONE, Leg::NONE];
    (p.payload.mass, p.payload.grasp_time) = if random.coin() { (0.3, -1.0) } else { (0.0, 1e9) };
    p.ik.resolution = Resolution::ExtendedJacobian;
    p.ik.moment_damping = 0.0;
    p.ik.sample_time = 5e-3;
    // Mounted where the arm is in balance: it would fall otherwise.
    p.mount.x = 0.0;
    let model = Model { structure, parameters: p.clone() };
    let at = Coordinates { pose: Vector3::zeros(), q: p.joints[..structure.links].iter().map(|j| j.start).collect() };
    let mut bodies = model.bodies(&at, &at, p.payload.mass > 0.0);
    bodies.retain(|body| body.part != Part::Uav);
    p.mount.x = -center_of_mass(&bodies).x;
    (structure, p)
}

/// Away from configurations where path and moment contradict each other and rates grow.
fn calm(outputs: &control::Outputs) -> bool {
    matches!(outputs.status, Status::Ok | Status::Inexact) && outputs.rate_command.iter().all(|rate| rate.abs() < 1.0)
}

/// A step of a controller that predicts an ideal base, from without.
struct Step<'a> {
    model: &'a Model,
    size: f64,
    from: Vec<f64>,
    rate: Vec<f64>,
    held: bool,
}

impl Step<'_> {
    fn carried(&self, t: f64, base: Vector2<f64>) -> Vec<Body> {
        let at = Coordinates {
            pose: Vector3::zeros(),
            q: self.from.iter().zip(&self.rate).map(|(q, rate)| q + rate * t).collect(),
        };
        let speed = Coordinates { pose: Vector3::new(base.x, base.y, 0.0), q: self.rate.clone() };
        let mut bodies = self.model.bodies(&at, &speed, self.held);
        bodies.retain(|body| body.part != Part::Uav);
        bodies
    }

    /// How fast the base slides so that the momentum along x is zero.
    fn sliding(&self, t: f64) -> Vector2<f64> {
        let still = self.carried(t, Vector2::zeros());
        let mass = self.model.parameters.uav.mass + common::model::mass(&still);
        Vector2::new(-momentum(&still).x / mass, 0.0)
    }

    fn base(&self, t: f64, moment_model: MomentModel) -> Vector2<f64> {
        match moment_model {
            MomentModel::FixedBase => Vector2::zeros(),
            MomentModel::SlidingBase | MomentModel::FreeBase => self.sliding(t),
        }
    }

    /// Angular momentum of what the UAV carries at the end, and the impulse of its weight less v x p.
    fn balance(&self, moment_model: MomentModel) -> (f64, f64) {
        let spacing = self.size / (INSTANTS - 1) as f64;
        let loads: Vec<f64> = (0..INSTANTS)
            .map(|k| {
                let base = self.base(k as f64 * spacing, moment_model);
                let bodies = self.carried(k as f64 * spacing, base);
                weight_moment(&bodies, self.model.gravity(), Vector2::zeros())
                    - common::model::cross(base, momentum(&bodies))
            })
            .collect();
        let end = self.carried(self.size, self.base(self.size, moment_model));
        (angular_momentum(&end, Vector2::zeros()), simpson(&loads, spacing))
    }
}

/// Largest mean moment on the UAV over the steps of a controller's own prediction, by the bodies.
fn largest_moment(random: &mut Random, moment_model: MomentModel, discretization: Discretization, size: f64) -> f64 {
    let (structure, mut parameters) = vehicle(random);
    parameters.ik.base_model = BaseModel::Ideal;
    parameters.ik.moment_model = moment_model;
    parameters.ik.discretization = discretization;
    parameters.ik.sample_time = size;
    let model = Model { structure, parameters: parameters.clone() };
    let mut outputs = control::Outputs::default();
    let mut planner = control::new(structure, &parameters, &mut outputs).unwrap();
    let (mut before, mut largest) = (0.0, 0.0_f64);
    for k in 0..(0.3 / size) as usize {
        if !calm(&outputs) {
            break;
        }
        let step = Step {
            model: &model,
            size,
            from: outputs.predicted_position[..structure.links].to_vec(),
            rate: outputs.rate_command[..structure.links].to_vec(),
            held: outputs.grasp,
        };
        let (after, impulse) = step.balance(moment_model);
        largest = largest.max(((before + impulse - after) / size).abs());
        before = after;
        planner.step(&control::Inputs::default(), k as f64 * size, size, &mut outputs).unwrap();
    }
    largest
}

proptest! {
    #![proptest_config(cases(8))]

    /// Rates that hold exactly: the mean moment of every interval is zero.
    #[test]
    fn exact_rates_cancel_the_mean_moment(seed: u64) {
        for model in [MomentModel::FixedBase, MomentModel::SlidingBase, MomentModel::FreeBase] {
            let moment = largest_moment(&mut Random(seed), model, Discretization::Exact, 5e-3);
            prop_assert!(moment < 1e-9, "{model:?}: {moment:e}");
        }
    }

    /// The thesis' rows hold to first order: half the step, half the moment.
    #[test]
    fn the_thesis_rows_hold_to_first_order(seed: u64) {
        for model in [MomentModel::FixedBase, MomentModel::SlidingBase] {
            let [coarse, fine] =
                [2e-3, 1e-3].map(|size| largest_moment(&mut Random(seed), model, Discretization::Euler, size));
            prop_assert!(fine < 0.1 && (coarse < 1e-7 || fine < 0.7 * coarse), "{model:?}: {coarse:e}, {fine:e}");
        }
    }

    /// What the plant measures is zero, for mounts anywhere, if all of the base's motion counts.
    #[test]
    fn a_free_base_feels_no_moment(seed: u64) {
        let (structure, mut parameters) = vehicle(&mut Random(seed));
        parameters.autopilot.mode = AutopilotMode::Pid;
        let mut coupling = Coupling::new(structure, &parameters);
        for _ in 0..60 {
            if !calm(&coupling.commands) {
                break;
            }
            coupling.step(5e-3);
            let moment = coupling.plant.outputs.transmitted_moment;
            prop_assert!(moment.abs() < 1e-9, "{moment:e}");
        }
    }
}

/// On an ideal base, a free one can only slide; on a base that is not predicted to turn, the models differ.
#[test]
fn the_models_differ_where_they_should() {
    let moments = |base_model: BaseModel| {
        [MomentModel::FixedBase, MomentModel::SlidingBase, MomentModel::FreeBase].map(|moment_model| {
            let mut parameters = uam::parameters::defaults::default_parameters(Structure::DEFAULT);
            parameters.ik.base_model = base_model;
            parameters.ik.moment_model = moment_model;
            parameters.ik.moment_damping = 0.0;
            let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
            (0..100).for_each(|_| coupling.step(0.01));
            coupling.plant.outputs.transmitted_moment.abs()
        })
    };
    let [fixed, sliding, free] = moments(BaseModel::Ideal);
    assert!(sliding < 0.5 * fixed && sliding == free, "{fixed:e} {sliding:e} {free:e}");
    let [fixed, sliding, free] = moments(BaseModel::Full);
    assert!(free < 1e-9 && 1e3 * free < sliding && 1e3 * free < fixed, "{fixed:e} {sliding:e} {free:e}");
}
