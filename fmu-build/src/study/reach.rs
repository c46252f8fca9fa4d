//! How far the arm reaches: a motion is enlarged until the inverse kinematics cannot follow any more.
//!
//! It cannot follow where the path gives way: `ik.status` says at some communication point that limits (of rate,
//! acceleration and position), or a singular configuration, leave no rates that keep to the path. In the thesis this is
//! where the equations of the path and the bounds contradict each other, and its program finds no solution. An error of
//! the end effector is no measure of that: the thesis' own step has one on any path.

use uam::parameters::Discretization;
use uam::reference::{Reference, ReferenceKind};
use uam::scenarios::Scenario;
use uam::variables::options::Choice;

use crate::host::coupling::{Error, Pair};
use crate::study::claims::Quantity;
use crate::study::run_with;

/// By how much the motion is enlarged until it cannot be followed \[m\].
pub const STRIDE: f64 = 0.01;
/// How far the result may be from the edge \[m\].
pub const PRECISION: f64 = 1e-3;
/// No arm of the catalogue is longer \[m\].
pub const FARTHEST: f64 = 0.5;
/// A moment on the UAV that is never larger than this counts as balanced: the order of what the thesis has \[N m\].
pub const BALANCED: f64 = 0.2;

/// A reach this near to that of the thesis, as a share of it, agrees.
pub const AGREEMENT: f64 = 0.15;

/// A scenario of the thesis that goes as far as its arm reaches.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    /// The scenario.
    pub scenario: &'static str,
    /// What is moved, and how.
    pub about: &'static str,
    /// How far the thesis gets \[m\].
    pub thesis: f64,
    /// The same in words.
    pub says: &'static str,
}

/// The motions of thesis 3.8 and 4.4, with the counterweight locked and moving.
pub const MOTIONS: [Motion; 4] = [
    Motion { scenario: "3.8a", about: "counterweight locked", thesis: 0.13, says: "130 mm" },
    Motion { scenario: "3.8b", about: "counterweight moving", thesis: 0.24, says: "240 mm" },
    Motion { scenario: "4.4a", about: "payload, counterweight locked", thesis: 0.11, says: "110 mm" },
    Motion { scenario: "4.4b", about: "payload, counterweight moving", thesis: 0.125, says: "125 mm" },
];

/// A motion of one size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trial {
    /// How far it goes to the right \[m\].
    pub way: f64,
    /// Whether it was followed to its end.
    pub followed: bool,
    /// Largest moment on the UAV \[N m\].
    pub moment: f64,
}

impl Trial {
    /// Runs a scenario enlarged to this `way`.
    ///
    /// # Errors
    /// If the run cannot be started.
    pub fn run(pair: &Pair, scenario: &Scenario, discretization: Discretization, way: f64) -> Result<Self, Error> {
        let run = run_with(pair, &enlarged(scenario, way)?, discretization, &|| {})?;
        let never = Quantity::GivesWayAt.measure(&run.recording)? == f64::INFINITY;
        // A run that stopped early, or that ends on the way, did not follow.
        let followed = run.stopped.is_none() && never && comes_to_its_end(scenario);
        Ok(Self { way, followed, moment: Quantity::Moment.measure(&run.recording)? })
    }

    fn balanced(&self) -> bool {
        self.followed && self.moment <= BALANCED
    }
}

/// What came out.
#[derive(Debug, Clone, PartialEq)]
pub struct Reach {
    /// The longest way that was followed, as was every shorter one that was tried \[m\].
    pub followed: f64,
    /// The longest way on which the moment on the UAV stayed balanced, too, as on every shorter one \[m\].
    pub balanced: f64,
    /// All motions that were tried, from the smallest.
    pub trials: Vec<Trial>,
}

/// Whether the wanted motion comes to its end while it is simulated.
#[must_use]
pub fn comes_to_its_end(scenario: &Scenario) -> bool {
    // Rounding of sums of times does not count.
    scenario.parameters.reference.end() <= scenario.duration * (1.0 + 1e-9)
}

/// The scenario with all its ways along x in proportion, such that the first leg goes `way` to the right \[m\].
///
/// # Errors
/// If its motion is no path whose first leg goes along x.
pub fn enlarged(scenario: &Scenario, way: f64) -> uam::Result<Scenario> {
    let mut scenario = scenario.clone();
    let Reference { kind, legs, .. } = &mut scenario.parameters.reference;
    let refused = |name: &str, expected: &str, found: String| {
        let expected = format!("{expected}, for the motion is enlarged in proportion to its first leg's way along x");
        Err(uam::Error::Inconsistent { name: name.to_owned(), expected, found })
    };
    if *kind != ReferenceKind::Path {
        return refused("reference.kind", "path", kind.name().to_owned());
    }
    if legs[0].duration == 0.0 {
        return refused("reference.leg[1].duration", "a time above 0", legs[0].duration.to_string());
    }
    let factor = way / legs[0].dx;
    if !factor.is_finite() {
        return refused("reference.leg[1].dx", "another number than 0", legs[0].dx.to_string());
    }
    for leg in legs {
        leg.dx *= factor;
    }
    Ok(scenario)
}

/// Enlarges a motion by [`STRIDE`] until it cannot be followed, then halves the strides at both edges down to
/// [`PRECISION`].
///
/// # Errors
/// If `run` fails.
pub fn reach<E>(mut run: impl FnMut(f64) -> Result<Trial, E>) -> Result<Reach, E> {
    let mut trials: Vec<Trial> = Vec::new();
    let mut way = STRIDE;
    while trials.last().is_none_or(|trial| trial.followed) && way < FARTHEST {
        trials.push(run(way)?);
        way += STRIDE;
    }
    let mut edge = |good: fn(&Trial) -> bool| {
        let beyond = trials.iter().position(|trial| !good(trial));
        let within = beyond.unwrap_or(trials.len()).checked_sub(1).map_or(0.0, |last| trials[last].way);
        let (mut within, mut beyond) = (within, beyond.map_or(within, |first| trials[first].way));
        while beyond - within > PRECISION {
            let trial = run(0.5 * (within + beyond))?;
            *(if good(&trial) { &mut within } else { &mut beyond }) = trial.way;
            trials.push(trial);
        }
        trials.sort_by(|a, b| a.way.total_cmp(&b.way));
        Ok(within)
    };
    let (followed, balanced) = (edge(|trial| trial.followed)?, edge(Trial::balanced)?);
    Ok(Reach { followed, balanced, trials })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_edges_are_found_within_the_precision() {
        for (follows, balances) in [(0.004, 0.002), (0.1304, 0.013), (0.2399, 0.2399), (0.3, 0.0)] {
            let run = |way: f64| {
                let moment = if way > balances { 1.0 } else { 0.01 };
                Ok::<_, ()>(Trial { way, followed: way <= follows, moment })
            };
            let found = reach(run).unwrap();
            for (edge, found) in [(follows, found.followed), (balances, found.balanced)] {
                assert!((edge - PRECISION..=edge).contains(&found), "{edge}: {found}");
            }
            assert!(found.trials.is_sorted_by(|a, b| a.way < b.way));
        }
    }

    #[test]
    fn the_smallest_gap_counts() {
        let run = |way: f64| Ok::<_, ()>(Trial { way, followed: !(0.115..0.125).contains(&way), moment: f64::NAN });
        let found = reach(run).unwrap();
        assert!((0.114..0.115).contains(&found.followed) && found.balanced == 0.0, "{found:?}");
        assert!(found.trials.iter().all(|trial| trial.way < 0.13));
    }

    #[test]
    fn enlarging_keeps_the_proportions() {
        let scenario = uam::scenarios::find("4.4a").unwrap();
        let legs = enlarged(&scenario, 0.2).unwrap().parameters.reference.legs;
        assert!((legs[0].dx - 0.2).abs() < 1e-15 && (legs.iter().map(|leg| leg.dx).sum::<f64>()).abs() < 1e-15);
        assert_eq!(legs[0].dy, -0.05);
    }
}
