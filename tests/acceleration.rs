//! Accelerations of arm and balance element that leave the UAV without moment (thesis 3.4), on the plant.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::cases;
use common::coupling::Coupling;
use common::random::Random;
use proptest::prelude::*;
use uam::autopilot::AutopilotMode;
use uam::control::Status;
use uam::parameters::{Balance, BaseModel, Discretization, Hold, MomentModel, PathAxes, Resolution};
use uam::reference::{Leg, Profile};
use uam::scenarios::{self, Scenario};
use uam::{Parameters, Structure};

/// A random vehicle with an arm as short as the followed axes allow or by one link longer, in an ordinary pose,
/// its balance element massive and near equilibrium, or a disc. It moves a little and grasps on the way.
fn vehicle(random: &mut Random, axes: PathAxes, mode: AutopilotMode) -> (Structure, Parameters) {
    let links = axes.number() + usize::from(random.coin());
    let structure = Structure::new(links, Balance::Element).unwrap();
    let mut p = random.parameters(structure);
    for (i, joint) in p.joints.iter_mut().enumerate() {
        let side = if i % 2 == 0 { -0.5 } else { 1.0 };
        joint.start = side * random.between(0.8, 1.2);
        joint.rate_limit = 1e3;
    }
    for link in &mut p.links {
        link.length = random.between(0.15, 0.3);
        link.com = 0.5 * link.length;
    }
    if random.coin() {
        (p.balance_element.mass, p.balance_element.com) = (0.0, 0.0);
    }
    p.balance_element.inertia = random.between(0.02, 0.05);
    p.balance_element.start = 0.5;
    (p.mount.x, p.mount.y) = (random.about_zero(0.02), random.about_zero(0.02));
    p.payload.mass = random.between(0.05, 0.3);
    p.payload.com = p.links[links - 1].length;
    p.payload.grasp_time = 0.25;
    p.autopilot.mode = mode;
    p.ik.moment_damping = 0.0;
    (p.ik.base_model, p.ik.moment_model) = (BaseModel::Full, MomentModel::FreeBase);
    (p.ik.resolution, p.ik.hold, p.ik.path_axes) = (Resolution::AccelerationLevel, Hold::FirstOrder, axes);
    for leg in &mut p.reference.legs {
        leg.duration = 0.0;
    }
    let (dx, dy) = (random.about_zero(0.02), random.about_zero(0.02));
    p.reference.legs[0] = Leg { start: 0.0, duration: 0.5, ramp: 0.2, dx, dy, profile: Profile::Smooth };
    (structure, p)
}

fn axes() -> impl Strategy<Value = PathAxes> {
    prop_oneof![Just(PathAxes::Both), Just(PathAxes::Horizontal)]
}

fn mode() -> impl Strategy<Value = AutopilotMode> {
    prop_oneof![Just(AutopilotMode::Ideal), Just(AutopilotMode::Pid)]
}

proptest! {
    #![proptest_config(cases(24))]

    /// The plant's mean moment is zero, the followed axes are on the reference and no rate ever jumps: before the
    /// grasp, through it and after it.
    #[test]
    fn path_and_moment_hold_without_jumps(seed: u64, axes in axes(), mode in mode()) {
        let (structure, parameters) = vehicle(&mut Random(seed), axes, mode);
        let mut coupling = Coupling::new(structure, &parameters);
        for k in 1..=500 {
            let before = coupling.plant.outputs.rate;
            let jump = coupling.commands.rate_command.iter().zip(before)
                .map(|(after, before)| (after - before).abs()).fold(0.0, f64::max);
            prop_assert!(jump < 1e-9, "{k}: rates jump by {jump}");
            coupling.step(1e-3);
            let grasping = (250..270).contains(&k);
            match coupling.commands.status {
                Status::Ok => {}
                // The velocity of the end effector jumps at the grasp, and what that brings is made good.
                Status::CatchingUp => prop_assert!(grasping, "{k}: {:?}", coupling.commands),
                // Too near to a singular configuration to say anything.
                _ => return Err(TestCaseError::reject("singular")),
            }
            let outputs = &coupling.plant.outputs;
            prop_assert!(outputs.transmitted_moment.abs() < 1e-6, "{k}: {} N m", outputs.transmitted_moment);
            let off = outputs.end_effector - coupling.commands.reference;
            let off = if axes == PathAxes::Both { off.norm() } else { off.x.abs() };
            prop_assert!(off < if grasping { 1e-4 } else { 1e-7 }, "{k}: {off} m");
        }
    }
}

/// The largest error along x of a run of thesis 3.4 up to the time `until` \[s\].
fn error(scenario: &Scenario, discretization: Discretization, step: f64, until: f64) -> f64 {
    let mut parameters = scenario.parameters.clone();
    (parameters.ik.discretization, parameters.ik.sample_time) = (discretization, step);
    let mut coupling = Coupling::new(scenario.structure, &parameters);
    let mut largest = 0.0_f64;
    for _ in 0..(until / step).round() as u64 {
        coupling.step(step);
        // What the explicit step is off, it says.
        assert!(matches!(coupling.commands.status, Status::Ok | Status::Inexact));
        largest = largest.max((coupling.plant.outputs.end_effector.x - coupling.commands.reference.x).abs());
    }
    largest
}

/// The explicit step is of first order; the plan of the whole interval leaves nothing.
#[test]
fn the_explicit_step_is_of_first_order() {
    let scenario = scenarios::find("3.4-2").unwrap();
    let [coarse, fine] = [0.01, 5e-3].map(|step| error(&scenario, Discretization::Euler, step, 2.5));
    assert!(coarse < 1e-4 && (1.9..2.1).contains(&(coarse / fine)), "{coarse} {fine}");
    let exact = error(&scenario, Discretization::Exact, 0.01, 2.5);
    assert!(exact < 1e-8, "{exact}");
}

#[test]
fn what_does_not_go_together_is_refused_by_name() {
    let refusal = |change: fn(&mut Structure, &mut Parameters)| {
        let Scenario { mut structure, mut parameters, .. } = scenarios::find("3.4-1").unwrap();
        change(&mut structure, &mut parameters);
        uam::control::new(structure, &parameters, &mut uam::control::Outputs::default()).err().unwrap().to_string()
    };
    let hold = refusal(|_, p| p.ik.hold = Hold::ZeroOrder);
    assert!(hold.contains("ik.hold") && hold.contains("first_order"), "{hold}");
    let axes = refusal(|_, p| p.ik.path_axes = PathAxes::Both);
    assert!(axes.contains("ik.path_axes") && axes.contains("at most 1"), "{axes}");
    let resolution = refusal(|_, p| p.ik.resolution = Resolution::MinimumNorm);
    assert!(resolution.contains("ik.path_axes") && resolution.contains("minimum_norm"), "{resolution}");
    // A counterweight cannot cancel the moment at every instant, and holds still.
    let counterweight = refusal(|s, _| s.balance = Balance::Counterweight);
    assert!(counterweight.contains("ik.path_axes"), "{counterweight}");
}
