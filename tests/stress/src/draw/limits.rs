//! Limits of rates, accelerations and positions, from none to tight ones.

use uam::parameters::{Balance, Resolution};
use uam::{Parameters, Structure};

use super::Draw;

/// How much they leave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limits {
    /// Those of the start values, which seldom bind.
    Wide,
    /// Sometimes they bind.
    Loose,
    /// They bind.
    Tight,
    /// Likewise, and a joint starts outside of its own.
    Outside,
}

impl Limits {
    /// Whether a way of some decimetres takes seconds.
    pub fn are_narrow(self) -> bool {
        matches!(self, Self::Tight | Self::Outside)
    }
}

/// Limits for a method and start that are known.
pub fn draw(draw: &mut Draw, structure: Structure, p: &mut Parameters) -> Limits {
    let limits = draw.weighed(&[(8, Limits::Wide), (4, Limits::Loose), (3, Limits::Tight), (1, Limits::Outside)]);
    if p.ik.resolution != Resolution::LeastSquares && limits == Limits::Outside {
        return Limits::Wide;
    }
    let rates = match limits {
        Limits::Wide => return limits,
        Limits::Loose => [3.0, 31.0],
        Limits::Tight | Limits::Outside => [0.3, 6.0],
    };
    let rate = draw.scale(rates[0], rates[1]);
    let braking = draw.scale(2.0, 300.0);
    let room = if limits == Limits::Loose { [0.8, 4.0] } else { [0.1, 1.5] };
    for joint in &mut p.joints[..structure.links] {
        joint.rate_limit = rate * draw.between(0.5, 1.5);
        joint.acceleration_limit = joint.rate_limit * braking;
        joint.lower = joint.start - draw.between(room[0], room[1]);
        joint.upper = joint.start + draw.between(room[0], room[1]);
    }
    if limits == Limits::Outside {
        let joint = &mut p.joints[draw.below(structure.links)];
        let outside = draw.scale(1e-3, 0.3);
        let width = draw.between(0.5, 2.0);
        (joint.lower, joint.upper) = if draw.percent(50) {
            (joint.start + outside, joint.start + outside + width)
        } else {
            (joint.start - outside - width, joint.start - outside)
        };
    }
    if structure.balance == Balance::Counterweight {
        let weight = &mut p.counterweight;
        weight.stroke = weight.start.abs() + draw.scale(0.005, 0.2);
        weight.rate_limit = if draw.percent(10) { 0.0 } else { draw.scale(0.05, 5.0) };
        weight.acceleration_limit = draw.scale(0.5, 50.0);
        weight.time_constant = draw.scale(0.01, 0.3);
    }
    limits
}
