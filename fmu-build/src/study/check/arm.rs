//! How far the arm is from configurations in which it cannot move its end in every direction, and from its stops.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Matrix3, Vector3};
use uam::mechanics::planar::{Vec2, cross};
use uam::parameters::{Balance, Joint, Parameters, Resolution, Structure};

use super::Finding;
use super::statics::Statics;

/// Below this share of the stretched arm's length a singular value counts as small. The controller damps rates
/// below 2 %.
pub const SINGULAR: f64 = 0.03;

/// An arm that starts too straight, and a start of one joint that bends it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bend {
    /// Smallest singular value now \[m\].
    pub found: f64,
    /// The least that is well away from singular \[m\].
    pub least: f64,
    /// Number of the joint, from 1.
    pub joint: usize,
    /// Start of that joint \[rad\].
    pub start: f64,
}

/// Smallest singular value of a matrix of two rows with these columns \[m\]; of a single column, its length.
#[must_use]
pub fn smallest_singular_value(columns: &[Vec2]) -> f64 {
    if let [column] = columns {
        return column.norm();
    }
    let sum = |of: &dyn Fn(&Vec2) -> f64| columns.iter().map(of).sum::<f64>();
    let [xx, xy, yy] = [sum(&|c| c.x * c.x), sum(&|c| c.x * c.y), sum(&|c| c.y * c.y)];
    let largest = 0.5 * (xx + yy + (xx - yy).hypot(2.0 * xy));
    // The determinant as a sum of squares: no digits cancel near singular configurations.
    let pairs = columns.iter().enumerate().flat_map(|(i, a)| columns[..i].iter().map(move |b| cross(*a, *b)));
    let determinant: f64 = pairs.map(|area| area * area).sum();
    if largest > 0.0 { (determinant / largest).sqrt() } else { 0.0 }
}

/// The same with a third task for an arm of three links or more: the centre of mass of what the UAV carries stays below the
/// UAV \[m\]. Where it is small, no moment on the UAV and the path get in each other's way.
#[must_use]
pub fn smallest_singular_value_with_moment(start: &Statics) -> Option<f64> {
    if start.jacobian.len() < 3 {
        return None;
    }
    let columns = start.jacobian.iter().zip(&start.outboard);
    let gram = columns.fold(Matrix3::zeros(), |gram, (tip, outboard)| {
        // A first moment turns like a place.
        let column = Vector3::new(tip.x, tip.y, -outboard.y / start.carried_mass);
        gram + column * column.transpose()
    });
    // Without mass there is no moment, and eigenvalues are sought in finite numbers only.
    let is_finite = gram.iter().all(|number| number.is_finite());
    is_finite.then(|| gram.symmetric_eigenvalues().min().max(0.0).sqrt())
}

/// Distance of each joint's start from the nearer of its stops \[rad\], negative beyond; none where they are not known.
#[must_use]
pub fn to_stops(structure: Structure, parameters: &Parameters) -> Vec<f64> {
    if parameters.ik.resolution != Resolution::LeastSquares {
        return Vec::new();
    }
    let distance = |joint: &Joint| (joint.start - joint.lower).min(joint.upper - joint.start);
    parameters.joints[..structure.links].iter().map(distance).collect()
}

/// What looks wrong with the start of the arm.
#[must_use]
pub fn findings(structure: Structure, parameters: &Parameters, start: &Statics) -> Vec<Finding> {
    let mut findings = Vec::new();
    findings.extend(bend(structure, parameters, start).map(Finding::Singular));
    findings.extend(beyond_stops(structure, parameters));
    findings
}

fn bend(structure: Structure, parameters: &Parameters, start: &Statics) -> Option<Bend> {
    let reach: f64 = parameters.links[..structure.links].iter().map(|link| link.length).sum();
    let (found, least) = (smallest_singular_value(&start.jacobian), SINGULAR * reach);
    if structure.links == 1 || found >= least {
        return None;
    }
    // The first joint turns the arm as a whole and bends nothing.
    let tries = (1..structure.links).flat_map(|i| [FRAC_PI_2, -FRAC_PI_2].map(|angle| (i, angle)));
    let tried = tries.filter_map(|(i, angle)| {
        let mut bent = parameters.clone();
        bent.joints[i].start = angle;
        let there = Statics::at_start(structure, &bent, false).ok()?;
        Some((smallest_singular_value(&there.jacobian), i, angle))
    });
    let (_, i, angle) = tried.max_by(|(a, ..), (b, ..)| a.total_cmp(b))?;
    Some(Bend { found, least, joint: i + 1, start: angle })
}

fn beyond_stops(structure: Structure, parameters: &Parameters) -> Vec<Finding> {
    let mut findings = Vec::new();
    if parameters.ik.resolution == Resolution::LeastSquares {
        for (i, joint) in parameters.joints[..structure.links].iter().enumerate() {
            let nearest = joint.start.max(joint.lower).min(joint.upper);
            if nearest != joint.start {
                let name = format!("joint[{}].start", i + 1);
                findings.push(Finding::BeyondStop { name, found: joint.start, nearest });
            }
        }
    }
    let counterweight = &parameters.counterweight;
    let nearest = counterweight.start.max(-counterweight.stroke).min(counterweight.stroke);
    if structure.balance == Balance::Counterweight && nearest != counterweight.start {
        let name = "counterweight.start".to_owned();
        findings.push(Finding::BeyondStop { name, found: counterweight.start, nearest });
    }
    findings
}

#[cfg(test)]
mod tests {
    use uam::mechanics::planar::vec2;
    use uam::scenarios::default_parameters;

    use super::*;

    #[test]
    fn singular_values_of_known_matrices() {
        let close = |columns: &[Vec2], expected: f64| {
            let found = smallest_singular_value(columns);
            assert!((found - expected).abs() < 1e-15, "{columns:?}: {found}");
        };
        close(&[vec2(3.0, 4.0)], 5.0);
        close(&[vec2(3.0, 0.0), vec2(0.0, 2.0)], 2.0);
        close(&[vec2(1.0, 1.0), vec2(2.0, 2.0), vec2(-1.0, -1.0)], 0.0);
        // [1 1; 0 1] has the golden ratio and its inverse.
        close(&[vec2(1.0, 0.0), vec2(1.0, 1.0)], 0.5 * (5.0_f64.sqrt() - 1.0));
        close(&[vec2(0.0, 0.0), vec2(0.0, 0.0)], 0.0);
    }

    /// Two equal links at a right angle: columns (l, l) and (0, l) up to a turn, so l times the golden ratio's inverse.
    #[test]
    fn a_stretched_arm_is_to_be_bent() {
        let structure = Structure::new(2, Balance::None).unwrap();
        let mut parameters = default_parameters(structure);
        parameters.joints[1].start = 0.0;
        let start = Statics::at_start(structure, &parameters, false).unwrap();
        let [Finding::Singular(bend)] = findings(structure, &parameters, &start)[..] else { panic!("not singular") };
        assert!(bend.found < 1e-15 && bend.joint == 2 && bend.start.abs() == FRAC_PI_2);
        parameters.joints[1].start = bend.start;
        let bent = Statics::at_start(structure, &parameters, false).unwrap();
        let expected = 0.13 * 0.5 * (5.0_f64.sqrt() - 1.0);
        assert!((smallest_singular_value(&bent.jacobian) - expected).abs() < 1e-12);
        assert_eq!(findings(structure, &parameters, &bent), []);
    }

    #[test]
    fn nothing_weightless_has_a_moment() {
        let structure = Structure::DEFAULT;
        let mut parameters = default_parameters(structure);
        let of = |parameters: &Parameters| {
            smallest_singular_value_with_moment(&Statics::at_start(structure, parameters, false).unwrap())
        };
        assert!(of(&parameters).is_some_and(|value| value > 0.01));
        parameters.links.iter_mut().for_each(|link| link.mass = 0.0);
        assert_eq!(of(&parameters), None);
    }

    #[test]
    fn starts_beyond_stops_are_told_where_stops_are_known() {
        let structure = Structure::DEFAULT;
        let mut parameters = default_parameters(structure);
        parameters.joints[1].upper = 1.0;
        let start = Statics::at_start(structure, &parameters, false).unwrap();
        assert_eq!(findings(structure, &parameters, &start), []);
        assert!(to_stops(structure, &parameters).is_empty());
        parameters.ik.resolution = Resolution::LeastSquares;
        let [Finding::BeyondStop { name, nearest, .. }] = &findings(structure, &parameters, &start)[..] else {
            panic!("within")
        };
        assert_eq!((name.as_str(), *nearest), ("joint[2].start", 1.0));
        assert!((to_stops(structure, &parameters)[1] - (1.0 - parameters.joints[1].start)).abs() < 1e-15);
    }
}
