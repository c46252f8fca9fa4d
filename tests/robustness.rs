//! Whatever is asked of it, the controller answers with finite rates within their limits, and says what it gave up.

#![allow(clippy::unwrap_used)] // in helpers, too

mod common;

use common::cases;
use common::coupling::Coupling;
use common::random::Random;
use proptest::prelude::*;
use uam::Structure;
use uam::control::Status;
use uam::parameters::{Balance, BaseModel, Discretization, Hold, MomentModel, PathAxes, Resolution};
use uam::reference::ReferenceKind;

fn one_of<T: Copy>(random: &mut Random, choices: &[T]) -> T {
    choices[((random.unit() * choices.len() as f64) as usize).min(choices.len() - 1)]
}

/// The methods for an arm of so many links, of so many coordinates that can move by any law.
fn resolutions(links: usize, coordinates: usize) -> Vec<Resolution> {
    let mut suitable = vec![Resolution::MinimumNorm, Resolution::Gradient, Resolution::LeastSquares];
    if links > 2 {
        suitable.push(Resolution::ExtendedJacobian);
    }
    if coordinates > 1 {
        suitable.push(Resolution::AccelerationLevel);
    }
    suitable
}

proptest! {
    #![proptest_config(cases(120))]

    /// Random vehicles and methods; a reference that jumps, also far out of reach, with velocities that do not
    /// belong to it, while the payload comes and the arm passes singular configurations.
    #[test]
    fn rates_are_finite_and_within_their_limits(seed: u64) {
        let random = &mut Random(seed);
        let links = 1 + (random.unit() * 5.0) as usize;
        let structure = Structure::new(links, one_of(random, &Balance::ALL)).unwrap();
        let mut p = random.parameters(structure);
        p.reference.kind = ReferenceKind::External;
        p.payload.grasp_time = random.between(0.0, 0.5);
        let limit = random.between(0.5, 20.0);
        p.joints.iter_mut().for_each(|joint| joint.rate_limit = limit);
        for joint in &mut p.joints {
            joint.acceleration_limit = limit * random.between(5.0, 500.0);
            (joint.lower, joint.upper) =
                (joint.start - random.between(0.1, 3.0), joint.start + random.between(0.1, 3.0));
        }
        let coordinates = links + usize::from(structure.balance == Balance::Element);
        p.ik.resolution = one_of(random, &resolutions(links, coordinates));
        p.ik.discretization = one_of(random, &[Discretization::Euler, Discretization::Exact]);
        p.ik.hold = match p.ik.resolution {
            Resolution::LeastSquares => Hold::ZeroOrder,
            Resolution::AccelerationLevel => Hold::FirstOrder,
            _ => one_of(random, &[Hold::ZeroOrder, Hold::FirstOrder]),
        };
        if p.ik.resolution == Resolution::AccelerationLevel {
            let axes = [PathAxes::Horizontal, PathAxes::Both];
            p.ik.path_axes = one_of(random, &axes[..if coordinates < 3 { 1 } else { 2 }]);
        }
        p.ik.base_model = one_of(random, &[
            BaseModel::Ideal,
            BaseModel::HorizontalThrust,
            BaseModel::VerticalThrust,
            BaseModel::Translating,
            BaseModel::Full,
        ]);
        p.ik.moment_model =
            one_of(random, &[MomentModel::FixedBase, MomentModel::SlidingBase, MomentModel::FreeBase]);
        let mut coupling = Coupling::new(structure, &p);
        let origin = coupling.plant.outputs.end_effector;
        let step = 10.0_f64.powf(random.between(-3.0, -1.7));
        for k in 0..150 {
            if k % 30 == 0 {
                let size = one_of(random, &[1e-3, 0.1, 10.0]);
                coupling.external.position = origin + random.vector(size);
                coupling.external.velocity = random.vector(size);
                coupling.external.acceleration = random.vector(size);
            }
            coupling.step(step);
            let c = &coupling.commands;
            let seen = [&c.rate_command[..], &c.acceleration_command, &c.predicted_position, c.predicted_pose.as_slice()];
            prop_assert!(seen.concat().iter().all(|value| value.is_finite()), "{c:?}");
            let ends = (0..links).map(|i| c.rate_command[i] + step * c.acceleration_command[i]);
            let largest = c.rate_command[..links].iter().copied().chain(ends).fold(0.0, |a: f64, b| a.max(b.abs()));
            prop_assert!(largest <= limit * (1.0 + 1e-12), "{largest} of {limit}: {c:?}");
            // What is said to be met is met.
            let here = p.ik.discretization == Discretization::Exact && k % 30 != 0 && c.status == Status::Ok;
            prop_assert!(!here || c.velocity_residual * step < 1e-6, "{c:?}");
        }
    }
}
