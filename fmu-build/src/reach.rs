//! How far the arm reaches: a motion is enlarged until the end effector cannot follow any more.

use uam::parameters::Discretization;
use uam::scenarios::Scenario;

use crate::claims::Quantity;
use crate::coupling::{Error, Pair};
use crate::study::run_with;

/// An end effector that is farther from its reference than this, at any communication point, does not follow \[m\].
pub const FOLLOWS: f64 = 1e-3;
/// By how much the motion is enlarged until it cannot be followed \[m\].
pub const STRIDE: f64 = 0.01;
/// How far the result may be from the edge \[m\].
pub const PRECISION: f64 = 1e-3;
/// No arm of the catalogue is longer \[m\].
const LONGEST: f64 = 0.5;

/// A scenario of the thesis that goes as far as its arm reaches.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    /// The scenario.
    pub scenario: &'static str,
    /// How far the thesis gets \[m\].
    pub thesis: f64,
}

/// The motions of thesis 3.8 and 4.4, with the counterweight locked and moving.
pub const MOTIONS: [Motion; 4] = [
    Motion { scenario: "3.8a", thesis: 0.13 },
    Motion { scenario: "3.8b", thesis: 0.24 },
    Motion { scenario: "4.4a", thesis: 0.11 },
    Motion { scenario: "4.4b", thesis: 0.125 },
];

/// What came out.
#[derive(Debug, Clone, PartialEq)]
pub struct Reach {
    /// The longest way to the right that was followed, as was every shorter one that was tried \[m\].
    pub followed: f64,
    /// Ways that were tried, with the largest error of the end effector \[m\].
    pub tried: Vec<[f64; 2]>,
}

/// The scenario with all its ways along x in proportion, such that the first leg goes `way` to the right \[m\].
#[must_use]
pub fn enlarged(scenario: &Scenario, way: f64) -> Scenario {
    let mut scenario = scenario.clone();
    let factor = way / scenario.parameters.reference.legs[0].dx;
    for leg in &mut scenario.parameters.reference.legs {
        leg.dx *= factor;
    }
    scenario
}

/// Enlarges the motion by [`STRIDE`] until it cannot be followed, then halves the last stride down to
/// [`PRECISION`].
///
/// # Errors
/// If a run cannot be started.
pub fn reach(pair: &Pair, scenario: &Scenario, discretization: Discretization) -> Result<Reach, Error> {
    let follow = |way: f64| {
        let run = run_with(pair, &enlarged(scenario, way), discretization, &|| {})?;
        let error = Quantity::TrackingError.measure(&run.recording);
        // A run that stopped early did not follow.
        Ok::<f64, Error>(if run.stopped.is_some() { f64::INFINITY } else { error })
    };
    search(follow)
}

fn search<E>(mut follow: impl FnMut(f64) -> Result<f64, E>) -> Result<Reach, E> {
    let mut reach = Reach { followed: 0.0, tried: Vec::new() };
    let mut stride = STRIDE;
    let mut lost = f64::INFINITY;
    while stride >= PRECISION && reach.followed < LONGEST {
        let way = if lost.is_finite() { reach.followed + stride } else { reach.followed + STRIDE };
        let error = follow(way)?;
        reach.tried.push([way, error]);
        if error <= FOLLOWS {
            reach.followed = way;
        } else {
            lost = way;
        }
        stride = if lost.is_finite() { 0.5 * (lost - reach.followed) } else { STRIDE };
    }
    Ok(reach)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_edge_is_found_within_the_precision() {
        for edge in [0.004, 0.013, 0.1304, 0.2399] {
            let reach = search(|way| Ok::<f64, ()>(if way > edge { 1.0 } else { 1e-12 })).unwrap();
            assert!((edge - 2.0 * PRECISION..=edge).contains(&reach.followed), "{edge}: {reach:?}");
        }
        assert_eq!(search(|_| Ok::<f64, ()>(f64::NAN)).unwrap().followed, 0.0);
    }

    #[test]
    fn enlarging_keeps_the_proportions() {
        let scenario = uam::scenarios::find("4.4a").unwrap();
        let legs = enlarged(&scenario, 0.2).parameters.reference.legs;
        assert!((legs[0].dx - 0.2).abs() < 1e-15 && (legs.iter().map(|leg| leg.dx).sum::<f64>()).abs() < 1e-15);
        assert_eq!(legs[0].dy, -0.05);
    }
}
