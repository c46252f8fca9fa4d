//! Where the arm is at the start.

use uam::mechanics::planar::{Rotation, Vec2};
use uam::{Parameters, Structure};

use super::Draw;

/// What is special about it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// The arm's centre of mass below the UAV's, all joints bent.
    Balanced,
    /// All joints bent.
    Bent,
    /// All links in line.
    Straight,
    /// Each link back along the one before, nearly or entirely.
    Folded,
}

/// Joint angles for the vehicle of `p`.
pub fn draw(draw: &mut Draw, structure: Structure, p: &mut Parameters) -> Start {
    let start = draw.weighed(&[(16, Start::Balanced), (2, Start::Bent), (1, Start::Straight), (1, Start::Folded)]);
    let exactly = draw.percent(50);
    for joint in &mut p.joints {
        let sign = draw.one_of(&[-1.0, 1.0]);
        joint.start = match start {
            Start::Balanced | Start::Bent => sign * draw.between(0.5, 2.5),
            Start::Straight if exactly => 0.0,
            Start::Straight => draw.about_zero(0.02),
            Start::Folded => sign * (std::f64::consts::PI - if exactly { 0.0 } else { draw.about_zero(0.02) }),
        };
    }
    p.joints[0].start = match start {
        Start::Balanced => balanced(structure, p, draw.percent(80)),
        _ if draw.percent(50) => 0.0,
        _ => draw.about_zero(1.5),
    };
    start
}

/// The angle of the first joint at which the arm's centre of mass is below that of the UAV, as far as it can be.
fn balanced(structure: Structure, p: &Parameters, hanging: bool) -> f64 {
    let (mut angle, mut joint, mut moment, mut mass) = (0.0, Vec2::zeros(), Vec2::zeros(), 0.0);
    for (i, link) in p.links[..structure.links].iter().enumerate() {
        angle += if i == 0 { 0.0 } else { p.joints[i].start };
        let along = Rotation::by(angle).down();
        moment += (joint + along * link.com) * link.mass;
        joint += along * link.length;
        mass += link.mass;
    }
    let aside = |first: f64| Rotation::by(first).apply(moment).x + mass * p.mount.x;
    // It changes its sign once on the way from farthest left to farthest right; the way round leads below or above.
    let half = std::f64::consts::PI;
    let farthest = |sign: f64| {
        (0..64).map(|i| f64::from(i) * half / 32.0).max_by(|a, b| (sign * aside(*a)).total_cmp(&(sign * aside(*b))))
    };
    let (Some(left), Some(right)) = (farthest(-1.0), farthest(1.0)) else { return 0.0 };
    let ways = [right, if right > left { right - 2.0 * half } else { right + 2.0 * half }];
    let roots = ways.map(|right| bisect(aside, left, right));
    let height = |first: f64| Rotation::by(first).apply(moment).y;
    let [lower, upper] = if height(roots[0]) <= height(roots[1]) { roots } else { [roots[1], roots[0]] };
    let root = if hanging { lower } else { upper };
    if root > half { root - 2.0 * half } else { root }
}

/// Where `f` changes its sign between where it is negative and where it is positive; one of the ends if it does not.
fn bisect(f: impl Fn(f64) -> f64, mut negative: f64, mut positive: f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (negative + positive);
        if f(middle) < 0.0 {
            negative = middle;
        } else {
            positive = middle;
        }
    }
    0.5 * (negative + positive)
}
