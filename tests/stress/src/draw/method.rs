//! Methods that suit the structure.

use uam::parameters::{Balance, BaseModel, Discretization, Hold, MomentModel, PathAxes, Resolution};
use uam::{Parameters, Structure};

use super::Draw;

/// All settings of the inverse kinematics, but for its sample time.
pub fn draw(draw: &mut Draw, structure: Structure, p: &mut Parameters) {
    let coordinates = structure.links + usize::from(structure.balance == Balance::Element);
    let mut resolutions = vec![
        (2, Resolution::MinimumNorm),
        (1, Resolution::Gradient),
        (if structure.balance == Balance::Counterweight { 8 } else { 4 }, Resolution::LeastSquares),
    ];
    if structure.links > 2 {
        resolutions.push((4, Resolution::ExtendedJacobian));
    }
    if coordinates > 1 {
        resolutions.push((if structure.balance == Balance::Element { 4 } else { 2 }, Resolution::AccelerationLevel));
    }
    let ik = &mut p.ik;
    ik.resolution = draw.weighed(&resolutions);
    ik.discretization = draw.weighed(&[(7, Discretization::Exact), (1, Discretization::Euler)]);
    ik.hold = match ik.resolution {
        Resolution::LeastSquares => Hold::ZeroOrder,
        Resolution::AccelerationLevel => Hold::FirstOrder,
        _ => draw.weighed(&[(3, Hold::ZeroOrder), (1, Hold::FirstOrder)]),
    };
    let both = ik.resolution != Resolution::AccelerationLevel || (coordinates > 2 && draw.percent(80));
    ik.path_axes = if both { PathAxes::Both } else { PathAxes::Horizontal };
    ik.base_model = draw.weighed(&[
        (20, BaseModel::Full),
        (1, BaseModel::Ideal),
        (1, BaseModel::HorizontalThrust),
        (1, BaseModel::VerticalThrust),
        (1, BaseModel::Translating),
    ]);
    ik.moment_model =
        draw.weighed(&[(6, MomentModel::FreeBase), (1, MomentModel::FixedBase), (1, MomentModel::SlidingBase)]);
    ik.gradient_gain = draw.one_of(&[-392.0, -392.0, -50.0, -1500.0]);
    ik.rate_penalty = if draw.percent(15) { draw.scale(1e-6, 1e-1) } else { 0.0 };
    if draw.percent(15) {
        p.joints.iter_mut().for_each(|joint| joint.weight = draw.scale(1.0, 1e3));
    }
}

/// Values of parameters that are set where a unit has them.
pub fn damping(draw: &mut Draw) -> Vec<(&'static str, f64)> {
    match draw.below(4) {
        0 => vec![("ik.moment_damping", 0.0)],
        1 => vec![("ik.moment_damping", draw.scale(0.3, 50.0)), ("ik.moment_washout", draw.scale(0.1, 2.0))],
        _ => Vec::new(),
    }
}
