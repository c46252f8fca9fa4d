//! Momentum and mass matrices, against sums over all bodies with velocities by differences.

mod common;

use common::model::{self, Coordinates, Model};
use common::random::Random;
use common::run::Run;
use common::{assert_close, cases};
use nalgebra::{SVector, Vector2, Vector3};
use proptest::prelude::*;
use uam::for_coordinates;
use uam::mechanics::kinematics::Posture;
use uam::mechanics::momentum::{MomentumMatrix, Twist, inertial_load, outboard_drift, outboard_momentum};
use uam::mechanics::planar::Rotation;
use uam::mechanics::vehicle::Vehicle;
use uam::{Parameters, Structure};

/// A vehicle in any pose and motion.
struct Case {
    model: Model,
    at: Coordinates,
    speed: Coordinates,
    held: bool,
}

fn case(seed: u64, held: bool) -> Case {
    let mut random = Random(seed);
    let structure = random.structure();
    let parameters = random.parameters(structure);
    let n = structure.coordinates();
    let mut coordinates = |size: f64| Coordinates {
        pose: Vector3::from_fn(|_, _| random.about_zero(size)),
        q: (0..n).map(|_| random.about_zero(size)).collect(),
    };
    let (at, speed) = (coordinates(3.0), coordinates(2.0));
    Case { model: Model { structure, parameters }, at, speed, held }
}

/// Base velocity in the axes of the UAV frame.
fn base_twist(case: &Case) -> Twist {
    let v = case.speed.pose;
    Twist { linear: Rotation::by(case.at.pose.z).undo(v.xy()), angular: v.z }
}

fn prepare<const N: usize>(
    structure: Structure,
    parameters: &Parameters,
    at: &Coordinates,
) -> uam::Result<(Vehicle<N>, Posture<N>)> {
    let vehicle = Vehicle::<N>::new(structure, parameters)?;
    let posture = Posture::new(&vehicle, &SVector::from_fn(|i, _| at.q[i]));
    Ok((vehicle, posture))
}

/// (p, K) of the library in the inertial frame, then back through the inverse to the base velocity.
fn library(case: &Case) -> uam::Result<(Vec<f64>, Vec<f64>)> {
    let Case { model, at, speed, held } = case;
    for_coordinates!(model.structure, N => {
        let (vehicle, posture) = prepare::<N>(model.structure, &model.parameters, at)?;
        let matrix = MomentumMatrix::new(&vehicle, &posture, *held);
        let rate = SVector::<f64, N>::from_fn(|i, _| speed.q[i]);
        let v = base_twist(case);
        let h = matrix.of_base(v) + matrix.of_rates(&rate);
        let p = Rotation::by(at.pose.z).apply(h.linear);
        // v = H_b^-1 h + sum of reactions.
        let back = matrix.columns.map(|column| matrix.base_response(column * -1.0)).iter().zip(rate.iter())
            .fold(matrix.base_response(h), |sum, (reaction, rate)| sum + *reaction * *rate);
        let difference = back - v;
        Ok((vec![p.x, p.y, h.angular], vec![difference.linear.x, difference.linear.y, difference.angular]))
    })
}

/// Momentum of what each coordinate moves, and how fast it changes by the motion alone.
fn library_outboard(case: &Case) -> uam::Result<Vec<[f64; 2]>> {
    let Case { model, at, speed, held } = case;
    for_coordinates!(model.structure, N => {
        let (vehicle, posture) = prepare::<N>(model.structure, &model.parameters, at)?;
        let rate = SVector::<f64, N>::from_fn(|i, _| speed.q[i]);
        let momentum = outboard_momentum(&vehicle, &posture, *held, base_twist(case), &rate);
        let drift = outboard_drift(&vehicle, &posture, *held, base_twist(case), &rate);
        Ok(momentum.iter().zip(drift.iter()).map(|(momentum, drift)| [*momentum, *drift]).collect())
    })
}

/// Load that moves the masses along the rates with these slopes under a base without acceleration.
fn library_inertial_load(case: &Case, slope: &[f64]) -> uam::Result<[f64; 3]> {
    let Case { model, at, speed, held } = case;
    for_coordinates!(model.structure, N => {
        let (vehicle, posture) = prepare::<N>(model.structure, &model.parameters, at)?;
        let rate = SVector::<f64, N>::from_fn(|i, _| speed.q[i]);
        let slope = SVector::<f64, N>::from_fn(|i, _| slope[i]);
        let load = inertial_load(&vehicle, &posture, *held, speed.pose.z, &rate, &slope);
        let force = Rotation::by(at.pose.z).apply(load.linear);
        Ok([force.x, force.y, load.angular])
    })
}

/// p and K about the UAV's centre of mass, summed over all bodies.
fn summed(case: &Case) -> [f64; 3] {
    let bodies = case.model.bodies(&case.at, &case.speed, case.held);
    let p = model::momentum(&bodies);
    [p.x, p.y, model::angular_momentum(&bodies, case.at.pose.xy())]
}

proptest! {
    #![proptest_config(cases(128))]

    #[test]
    fn momentum_is_the_sum_over_all_bodies(seed: u64, held: bool) {
        let case = case(seed, held);
        let (found, round_trip) = library(&case).unwrap();
        assert_close(&found, &summed(&case), 1e-10, "momentum");
        assert_close(&round_trip, &[0.0; 3], 1e-12, "velocity from momentum");
    }

    #[test]
    fn outboard_momentum_is_the_sum_over_the_bodies_outboard(seed: u64, held: bool) {
        let case = case(seed, held);
        let Case { model, at, speed, .. } = &case;
        let bodies = model.bodies(at, speed, held);
        for (i, found) in library_outboard(&case).unwrap().iter().enumerate() {
            let outer: Vec<_> = bodies.iter().copied().filter(|body| body.part.is_moved_by(i, model.structure)).collect();
            let p = model::momentum(&outer);
            let expected = if model.slides(i) {
                // Along the UAV's x axis, which turns with the roll.
                let (sin, cos) = at.pose.z.sin_cos();
                let (x, y) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
                [p.dot(&x), p.dot(&y) * speed.pose.z]
            } else {
                let joint = |model: &Model, at: &Coordinates| model.axis(at, i);
                let velocity = model.velocity_of(at, speed, joint);
                [model::angular_momentum(&outer, joint(model, at)), -model::cross(velocity, p)]
            };
            assert_close(found, &expected, 1e-9, "outboard");
        }
    }

    /// Force and moment are the rates of p and of the angular momentum about the point where the UAV's centre
    /// of mass is now, along a motion with constant base velocity: differences of sums over all bodies.
    #[test]
    fn inertial_load_is_the_rate_of_momentum(seed: u64, held: bool) {
        let case = case(seed, held);
        let mut random = Random(!seed);
        let slope: Vec<f64> = case.speed.q.iter().map(|_| random.about_zero(5.0)).collect();
        let about = case.at.pose.xy();
        let rate = common::derivative(|s| {
            let mut at = case.at.moved(&case.speed, s);
            let mut speed = case.speed.clone();
            for (i, slope) in slope.iter().enumerate() {
                at.q[i] += 0.5 * slope * s * s;
                speed.q[i] += slope * s;
            }
            let bodies = case.model.bodies(&at, &speed, held);
            let p = model::momentum(&bodies);
            Vector3::new(p.x, p.y, model::angular_momentum(&bodies, about))
        });
        let found = library_inertial_load(&case, &slope).unwrap();
        assert_close(&found, rate.as_slice(), 1e-7, "load");
    }

    /// The outputs `momentum` and `center_of_mass` of the plant, in whatever motion.
    #[test]
    fn the_plant_reports_momentum_and_center_of_mass(seed: u64, held: bool) {
        let mut random = Random(seed);
        let structure = random.structure();
        let mut run = Run::new(structure, random.parameters(structure));
        run.inputs = random.inputs(structure);
        run.inputs.grasp = held;
        run.steps(5, 0.02);
        let bodies = run.bodies();
        let p = model::momentum(&bodies);
        let k = model::angular_momentum(&bodies, run.outputs.pose.xy());
        assert_close(run.outputs.momentum.as_slice(), &[p.x, p.y, k], 1e-10, "momentum");
        let center = model::center_of_mass(&bodies);
        assert_close(run.outputs.center_of_mass.as_slice(), center.as_slice(), 1e-13, "centre of mass");
    }

    /// Where rates jump, velocities jump and the momentum, summed over all bodies, does not.
    #[test]
    fn a_jump_of_the_rates_keeps_momentum(seed: u64, held: bool) {
        let mut random = Random(seed);
        let structure = random.structure();
        let mut run = Run::new(structure, random.parameters(structure));
        run.inputs = random.inputs(structure);
        run.inputs.grasp = held;
        run.steps(5, 0.02);
        let (before, velocity) = (run.bodies(), run.outputs.velocity);
        random.new_rates(structure, &mut run.inputs);
        run.jump();
        let after = run.bodies();
        assert_close(model::momentum(&after).as_slice(), model::momentum(&before).as_slice(), 1e-10, "p");
        let about = run.outputs.pose.xy();
        let k = model::angular_momentum;
        assert_close(&[k(&after, about)], &[k(&before, about)], 1e-10, "K");
        prop_assert!((run.outputs.velocity - velocity).norm() > 1e-5);
    }
}
