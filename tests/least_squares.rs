//! Rates within limits: what is never exceeded, what gives way, and what it is like without limits.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::coupling::Coupling;
use common::random::Random;
use common::{assert_close, cases};
use proptest::prelude::*;
use uam::control::Status;
use uam::parameters::defaults::default_parameters;
use uam::parameters::{Balance, BaseModel, Discretization, MAX_COORDINATES, Resolution};
use uam::reference::{Circle, ReferenceKind};
use uam::{Parameters, Structure};

/// Three links with the payload on the ground, on a circle of 6 cm (thesis 3.6 and 3.7).
fn circle(duration: f64) -> Parameters {
    let mut p = default_parameters(Structure::DEFAULT);
    p.reference.kind = ReferenceKind::Circle;
    p.reference.circle = Circle { diameter: 0.06, duration, start_angle: std::f64::consts::PI };
    p.payload.grasp_time = 1e9;
    p.ik.moment_damping = 0.0;
    p
}

/// The vehicle of thesis 3.8 on the way to the right and back, without payload.
fn counterweight(way: f64) -> (Structure, Parameters) {
    let structure = Structure { balance: Balance::Counterweight, ..Structure::DEFAULT };
    let mut p = default_parameters(structure);
    p.ik.resolution = Resolution::LeastSquares;
    p.payload.grasp_time = 1e9;
    for joint in &mut p.joints {
        (joint.rate_limit, joint.acceleration_limit) = (6.0, 60.0);
    }
    let leg = uam::reference::Leg { duration: 2.0, ramp: 0.5, dx: way, dy: 0.0, ..p.reference.legs[0] };
    p.reference.legs = std::array::from_fn(|_| uam::reference::Leg::NONE);
    p.reference.legs[0] = leg;
    p.reference.legs[1] = uam::reference::Leg { start: 2.0, dx: -way, ..leg };
    (structure, p)
}

/// A path through everything, singular configurations included.
fn wild_path(p: &mut Parameters, random: &mut Random) {
    for leg in &mut p.reference.legs {
        leg.start = random.between(0.0, 0.5);
        leg.duration = random.between(0.2, 0.6);
        leg.ramp = random.between(0.02, 0.1);
        (leg.dx, leg.dy) = (random.about_zero(0.3), random.about_zero(0.3));
    }
}

fn discretization(random: &mut Random) -> Discretization {
    if random.coin() { Discretization::Euler } else { Discretization::Exact }
}

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn no_limit_is_ever_exceeded(seed: u64) {
        let mut random = Random(seed);
        let structure = random.structure();
        let mut p = random.parameters(structure);
        wild_path(&mut p, &mut random);
        p.ik.resolution = Resolution::LeastSquares;
        p.ik.discretization = discretization(&mut random);
        p.ik.rate_penalty = if random.coin() { 0.0 } else { random.between(0.0, 0.2) };
        p.payload.grasp_time = random.between(0.0, 1.0);
        for joint in &mut p.joints {
            joint.rate_limit = random.between(0.5, 5.0);
            joint.acceleration_limit = random.between(5.0, 100.0);
            // Some start outside.
            joint.lower = joint.start - random.between(-0.1, 0.5);
            joint.upper = joint.lower.max(joint.start) + random.between(-0.1, 0.5);
            joint.upper = joint.upper.max(joint.lower);
        }
        (p.counterweight.rate_limit, p.counterweight.acceleration_limit) =
            (random.between(0.1, 1.0), random.between(1.0, 10.0));
        p.counterweight.stroke = random.between(0.05, 0.3);
        let limits = |i: usize| {
            let (joint, slider) = (&p.joints[i.min(structure.links - 1)], &p.counterweight);
            if i < structure.links {
                (joint.rate_limit, joint.acceleration_limit, joint.lower, joint.upper)
            } else {
                (slider.rate_limit, slider.acceleration_limit, -slider.stroke, slider.stroke)
            }
        };
        let step = random.between(1e-3, 1e-2);
        let mut coupling = Coupling::new(structure, &p);
        let mut before = [0.0; MAX_COORDINATES];
        for _ in 0..80 {
            let rates = coupling.commands.rate_command;
            let from = coupling.plant.outputs.position;
            for i in 0..structure.coordinates() {
                let (rate, acceleration, lower, upper) = limits(i);
                prop_assert!(rates[i].abs() <= rate, "rate {i}: {}", rates[i]);
                let change = (rates[i] - before[i]).abs() / coupling.plant.model.parameters.ik.sample_time.max(step);
                prop_assert!(change <= acceleration * (1.0 + 1e-9), "acceleration {i}: {change}");
                // The way to the stop suffices to brake in, continuously, from the end of the interval.
                let (to, brake) = (from[i] + rates[i] * step, rates[i] * rates[i] / (2.0 * acceleration));
                let room = if rates[i] > 0.0 { upper - to } else { to - lower };
                let way_back = rates[i] == 0.0 || (rates[i] > 0.0 && from[i] < lower) || (rates[i] < 0.0 && from[i] > upper);
                prop_assert!(
                    way_back || room >= brake - 0.5 * step * rates[i].abs() - 1e-9,
                    "coordinate {i} at {to} with {} between {lower} and {upper}", rates[i]
                );
            }
            before = rates;
            coupling.step(step);
            prop_assert!(rates.iter().all(|rate| rate.is_finite()));
        }
    }

    #[test]
    fn without_limits_it_is_the_extended_jacobian(seed: u64) {
        let mut random = Random(seed);
        let links = random.between(3.0, 6.999) as usize;
        let structure = Structure { links, ..Structure::DEFAULT };
        let mut p = random.parameters(structure);
        p.ik.discretization = discretization(&mut random);
        p.ik.base_model = BaseModel::Full;
        p.payload.grasp_time = 0.1;
        let leg = &mut p.reference.legs[0];
        (leg.dx, leg.dy) = (random.about_zero(0.03), random.about_zero(0.03));
        p.joints.iter_mut().for_each(|joint| joint.rate_limit = 1e6);
        let mut squares = p.clone();
        squares.ik.resolution = Resolution::LeastSquares;
        p.ik.resolution = Resolution::ExtendedJacobian;
        let (mut extended, mut squares) = (Coupling::new(structure, &p), Coupling::new(structure, &squares));
        for _ in 0..20 {
            assert_close(&squares.commands.rate_command, &extended.commands.rate_command, 1e-12, "rate");
            prop_assert_eq!(squares.commands.status, extended.commands.status);
            if extended.commands.rate_command.iter().any(|rate| rate.abs() > 50.0) {
                break; // so fast that the limits of the start values may bind
            }
            extended.step(0.01);
            squares.step(0.01);
        }
    }
}

/// Where the limit binds, the path is followed all the same, the moment rises, and falls again (thesis 3.7).
#[test]
fn a_rate_limit_costs_moment_but_no_error() {
    let largest = |commands: &[f64]| commands.iter().fold(0.0, |largest: f64, rate| largest.max(rate.abs()));
    for discretization in [Discretization::Euler, Discretization::Exact] {
        let mut p = circle(2.0);
        p.ik.discretization = discretization;
        let mut free = Coupling::new(Structure::DEFAULT, &p);
        p.ik.resolution = Resolution::LeastSquares;
        p.joints.iter_mut().for_each(|joint| joint.rate_limit = 2.0);
        let mut limited = Coupling::new(Structure::DEFAULT, &p);
        let (mut bound, mut moment) = (false, 0.0_f64);
        for _ in 0..2200 {
            let exceeded = largest(&free.commands.rate_command) > 2.0;
            if !bound && !exceeded {
                assert_close(&limited.commands.rate_command, &free.commands.rate_command, 1e-12, "rate");
            }
            bound |= exceeded;
            [&mut free, &mut limited].into_iter().for_each(|coupling| coupling.step(1e-3));
            moment = moment.max(limited.plant.outputs.transmitted_moment.abs());
            let most = if discretization == Discretization::Euler { 2.5e-4 } else { 1e-9 };
            assert!(limited.error() < most, "{:e}", limited.error());
        }
        assert!(bound && moment > 0.05, "{moment}");
        assert!(limited.plant.outputs.transmitted_moment.abs() < 1e-3);
    }
}

/// A path too fast for the limits is left, as little as possible, and found again.
#[test]
fn the_path_gives_way_and_the_status_says_so() {
    for discretization in [Discretization::Euler, Discretization::Exact] {
        let mut p = circle(2.0);
        (p.ik.resolution, p.ik.discretization) = (Resolution::LeastSquares, discretization);
        p.joints.iter_mut().for_each(|joint| joint.rate_limit = 0.5);
        let mut coupling = Coupling::new(Structure::DEFAULT, &p);
        let mut left = false;
        for _ in 0..4000 {
            coupling.step(1e-3);
            let c = &coupling.commands;
            assert!(c.rate_command.iter().all(|rate| rate.abs() <= 0.5));
            assert_eq!(c.status == Status::PathLimited, c.velocity_residual > 1e-6, "{:?}", c.status);
            left |= c.status == Status::PathLimited;
        }
        assert!(left);
        assert_ne!(coupling.commands.status, Status::PathLimited);
        if discretization == Discretization::Exact {
            assert!(coupling.error() < 1e-9, "{:e}", coupling.error());
        }
    }
}

/// Stops are approached in time: the joint that would pass its stop rests there, and the others follow the path.
#[test]
fn a_joint_brakes_before_its_stop() {
    let mut p = circle(4.0);
    p.ik.resolution = Resolution::LeastSquares;
    let start = p.joints[1].start;
    (p.joints[1].upper, p.joints[1].acceleration_limit) = (start + 0.2, 5.0);
    let mut coupling = Coupling::new(Structure::DEFAULT, &p);
    let (mut largest, mut before) = (f64::NEG_INFINITY, 0.0);
    for _ in 0..4000 {
        let rate = coupling.commands.rate_command[1];
        assert!((rate - before).abs() <= 5e-3 * (1.0 + 1e-9), "{rate} {before}");
        before = rate;
        coupling.step(1e-3);
        largest = largest.max(coupling.plant.outputs.position[1]);
        assert!(coupling.error() < 1e-9, "t = {}: {:e}", coupling.plant.time, coupling.error());
    }
    assert!((largest - (start + 0.2)).abs() < 1e-9, "{largest}");
}

/// The counterweight keeps the balance as far as its stroke goes (thesis 3.8), or stays where it is.
#[test]
fn the_counterweight_balances_the_arm() {
    for locked in [false, true] {
        let (structure, mut p) = counterweight(0.13);
        if locked {
            p.counterweight.rate_limit = 0.0;
        }
        let mut coupling = Coupling::new(structure, &p);
        let mut largest = 0.0_f64;
        for _ in 0..4000 {
            coupling.step(1e-3);
            assert!(coupling.error() < 1e-9, "{:e}", coupling.error());
            let position = coupling.plant.outputs.position[3];
            largest = largest.max(position.abs());
            assert!(position.abs() <= 0.125 + 1e-12);
            let o = &coupling.plant.outputs;
            // What is carried has its centre of mass below the UAV's; at these rates, within a millimetre.
            let (mass, all) = (5.2, 7.2);
            let offset = (o.center_of_mass.x - o.pose.x) * all / mass;
            assert!(locked || offset.abs() < 2e-3, "{offset}");
        }
        assert_eq!(locked, largest == 0.0);
    }
}

/// With a price on rates, moments are accepted and the arm moves less (thesis 4.4).
#[test]
fn a_price_on_rates_makes_them_smaller() {
    let mut totals = Vec::new();
    for price in [0.0, 0.08, 10.0] {
        let mut p = circle(2.4);
        (p.ik.resolution, p.ik.rate_penalty) = (Resolution::LeastSquares, price);
        let mut coupling = Coupling::new(Structure::DEFAULT, &p);
        let (mut way, mut moment) = (0.0, 0.0_f64);
        for _ in 0..2400 {
            way += coupling.commands.rate_command.iter().map(|rate| rate.abs()).sum::<f64>() * 1e-3;
            coupling.step(1e-3);
            assert!(coupling.error() < 1e-9, "{:e}", coupling.error());
            moment = moment.max(coupling.plant.outputs.transmitted_moment.abs());
        }
        totals.push((way, moment));
    }
    assert!(totals[0].1 < 1e-8 && totals[1].1 < totals[2].1, "{totals:?}");
    assert!(totals[2].0 < 0.99 * totals[0].0, "{totals:?}");
}

/// A price that outweighs the moment leaves the rates steady: they neither jump nor take turns (thesis 4.3).
#[test]
fn the_highest_price_does_not_make_rates_chatter() {
    for discretization in [Discretization::Euler, Discretization::Exact] {
        for price in [1e5, 1e9, 1e300] {
            let mut parameters = default_parameters(Structure::DEFAULT);
            let ik = &mut parameters.ik;
            (ik.resolution, ik.discretization, ik.rate_penalty) = (Resolution::LeastSquares, discretization, price);
            ik.moment_damping = 0.0;
            let mut coupling = Coupling::new(Structure::DEFAULT, &parameters);
            let (mut before, mut last) = (coupling.commands.rate_command, [0.0; MAX_COORDINATES]);
            for _ in 0..3000 {
                coupling.step(1e-3);
                let rates = coupling.commands.rate_command;
                assert!(matches!(coupling.commands.status, Status::Ok | Status::Inexact));
                let changes: [f64; MAX_COORDINATES] = std::array::from_fn(|i| rates[i] - before[i]);
                for (change, last) in changes.iter().zip(last) {
                    assert!(change.abs() < 0.1, "{change} at {}", coupling.plant.time);
                    let turns = change * last < 0.0 && change.abs().min(last.abs()) > 0.02;
                    assert!(!turns, "{last}, then {change} at {}", coupling.plant.time);
                }
                (before, last) = (rates, changes);
                assert!(discretization == Discretization::Euler || coupling.error() < 1e-9);
            }
        }
    }
}

/// An arm without mass exerts no moment: the price alone counts, and the path is followed.
#[test]
fn an_arm_without_mass_follows_the_path_at_any_price() {
    for price in [1e-9, 1.0, 4.0, 1e6, 1e300] {
        let mut p = circle(2.4);
        (p.ik.resolution, p.ik.rate_penalty) = (Resolution::LeastSquares, price);
        for link in &mut p.links {
            (link.mass, link.inertia) = (0.0, 0.0);
        }
        let mut coupling = Coupling::new(Structure::DEFAULT, &p);
        for _ in 0..500 {
            coupling.step(1e-3);
            assert_ne!(coupling.commands.status, Status::PathLimited, "at a price of {price}");
            assert!(coupling.error() < 1e-9, "{:e}", coupling.error());
        }
    }
}

/// Limits may change during a run: from then on they count.
#[test]
fn limits_can_be_tuned() {
    let mut p = circle(2.0);
    p.ik.resolution = Resolution::LeastSquares;
    let mut coupling = Coupling::new(Structure::DEFAULT, &p);
    for _ in 0..1000 {
        coupling.step(1e-3);
    }
    for joint in &mut coupling.plant.model.parameters.joints {
        (joint.rate_limit, joint.acceleration_limit) = (0.5, 20.0);
    }
    let mut before = coupling.commands.rate_command;
    for i in 0..1000 {
        coupling.step(1e-3);
        let rates = coupling.commands.rate_command;
        for (rate, before) in rates.iter().zip(before) {
            // Down to the new limit as fast as may be.
            assert!((rate - before).abs() <= 0.02 * (1.0 + 1e-9));
            assert!(i < 150 || rate.abs() <= 0.5);
        }
        before = rates;
    }
}

/// With the payload in its hand at rest, the arm does not shake together with the counterweight.
#[test]
fn the_counterweight_does_not_chatter() {
    let (structure, mut p) = counterweight(0.0);
    p.reference.legs[0] = uam::reference::Leg { duration: 1.5, ramp: 0.5, dx: 0.11, dy: -0.05, ..p.reference.legs[0] };
    (p.payload.grasp_time, p.support.stiffness) = (-1.0, 0.0);
    let mut coupling = Coupling::new(structure, &p);
    let (mut before, mut total) = ([0.0; MAX_COORDINATES], 0.0);
    for i in 0..3000 {
        coupling.step(1e-3);
        let rates = coupling.commands.rate_command;
        if i > 2000 {
            total += rates.iter().zip(before).map(|(rate, before)| (rate - before).abs()).sum::<f64>();
        }
        before = rates;
    }
    assert!(total < 2.0, "{total}");
}

#[test]
fn stops_in_the_wrong_order_are_refused() {
    let mut p = default_parameters(Structure::DEFAULT);
    (p.joints[1].lower, p.joints[1].upper) = (1.0, 0.5);
    let message = p.check(Structure::DEFAULT).unwrap_err().to_string();
    assert!(message.contains("joint[2].upper") && message.contains("0.5"), "{message}");
}
