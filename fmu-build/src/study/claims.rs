//! What the thesis says came out of a simulation, beside what comes out here.

mod quantity;
mod reading;
mod table;
mod thesis;

pub use quantity::{Numbers, Quantity, peak};
pub use reading::Shown;
pub use table::{Cell, Row, Section, Table};
use thesis::{BASE_MOTION, PICK_UP, REACH, REDUNDANCY, TWO_LINKS};
use uam::parameters::Discretization;

use crate::study::variation::Changes;

/// The discretizations that are compared, in the order of the columns of tables.
pub const DISCRETIZATIONS: [Discretization; 2] = [Discretization::Euler, Discretization::Exact];

/// How far the end effector may be from its reference before it counts as having left the workspace \[m\].
pub const LOST: f64 = 0.01;

/// A statement of the thesis about one quantity of one scenario.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Claim {
    /// Which scenario.
    pub scenario: &'static str,
    /// About what.
    pub quantity: Quantity,
    /// The statement is about the ratio to the same quantity of this scenario.
    pub compared_with: Option<&'static str>,
    /// The statement.
    pub thesis: &'static str,
    /// Smallest and largest number (SI) that agrees with it.
    pub interval: [f64; 2],
    /// Where the statement does not hold here.
    pub deviation: Option<Deviation>,
}

/// A statement that does not hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// With which discretizations, in the order of [`DISCRETIZATIONS`].
    pub of: [bool; 2],
    /// Why, in a line.
    pub why: &'static str,
    /// Changes of the scenario, as [`crate::study::variation::vary`] takes them, with which it does hold; none: no evidence.
    pub holds_with: Changes<'static>,
}

impl Claim {
    /// Whether a number is what the thesis says; not a number never is.
    #[must_use]
    pub fn agrees(&self, value: f64) -> bool {
        let [smallest, largest] = self.interval;
        smallest <= value && value <= largest
    }

    /// Whether the statement should hold with the discretization at this place.
    #[must_use]
    pub fn should_agree(&self, discretization: usize) -> bool {
        !self.deviation.is_some_and(|deviation| deviation.of[discretization])
    }
}

/// All claims, in the order of the thesis.
pub fn all() -> impl Iterator<Item = &'static Claim> {
    [BASE_MOTION, REDUNDANCY, TWO_LINKS, PICK_UP, REACH].into_iter().flatten()
}

/// What the thesis says about a quantity of a scenario by itself, not compared with that of another.
pub fn of(scenario: &str, quantity: Quantity) -> Option<&'static Claim> {
    about(scenario).find(|claim| claim.quantity == quantity && claim.compared_with.is_none())
}

/// What the thesis says about a scenario.
pub fn about(scenario: &str) -> impl Iterator<Item = &'static Claim> {
    all().filter(move |claim| claim.scenario == scenario)
}

#[cfg(test)]
mod tests {
    use uam::Structure;

    use super::quantity::peak;
    use super::*;
    use crate::host::record::{Names, Recording};

    fn swinging() -> Recording {
        let names = ["base.x", "base.y", "end_effector.x", "end_effector.y", "reference.x", "reference.y"];
        let mut recording = Recording::new(names, 4);
        for (time, x, y, error) in
            [(0.0, 0.0, 0.0, 0.0), (1.0, 0.11, -0.1, 0.001), (2.0, -0.03, -0.05, 0.2), (3.0, 0.02, 0.0, 0.0)]
        {
            recording.push(time, [x, y, error, 0.0, 0.0, 0.0]);
        }
        recording
    }

    #[test]
    fn quantities_of_a_known_motion() {
        let recording = swinging();
        let measured = |quantity: Quantity| quantity.measure(&recording).unwrap();
        assert_eq!(measured(Quantity::FarthestRight), 0.11);
        assert_eq!(measured(Quantity::FarthestLeft), 0.03);
        assert_eq!(measured(Quantity::FinalX), 0.02);
        assert_eq!(measured(Quantity::Sinking), 0.1);
        assert_eq!(measured(Quantity::TrackingError), 0.2);
        assert_eq!(measured(Quantity::LostAt), 2.0);
    }

    /// Every quantity tells a recording that lacks what it takes from a vehicle that has nothing of the kind.
    #[test]
    fn what_was_not_recorded_is_no_number() {
        let nothing = Recording::new([], 0);
        for quantity in Quantity::ALL {
            let refused = quantity.measure(&nothing).unwrap_err().to_string();
            assert!(refused.ends_with("was not recorded"), "{quantity:?}: {refused}");
        }
        for structure in Structure::all() {
            let names = Names::standard(structure);
            let mut complete = Recording::new(names.plant.iter().chain(&names.controller).map(String::as_str), 3);
            (0..3).for_each(|n| complete.push(f64::from(n), std::iter::repeat(1.0)));
            let numbers = Numbers::of(&complete, structure).unwrap();
            for quantity in Quantity::ALL {
                assert_eq!(numbers.get(quantity).is_nan(), !quantity.is_of(structure), "{structure}: {quantity:?}");
            }
        }
    }

    #[test]
    fn nothing_hides_behind_not_a_number() {
        assert!(peak([]).is_nan());
        assert!(peak([1.0, f64::NAN, 2.0]).is_nan());
        assert_eq!(peak([1.0, 3.0, 2.0]), 3.0);
    }

    #[test]
    fn two_roundings_have_no_ratio() {
        assert_eq!(Quantity::TrackingError.ratio(3e-4, 1e-4), Some(3e-4 / 1e-4));
        assert_eq!(Quantity::TrackingError.ratio(3e-4, 1e-14), Some(3e-4 / 1e-9));
        assert_eq!(Quantity::TrackingError.ratio(1e-14, 1e-4), Some(1e-9 / 1e-4));
        assert_eq!(Quantity::TrackingError.ratio(1e-14, 1e-12), None);
        assert_eq!(Quantity::FarthestRight.ratio(-0.02, 0.1), Some(-0.02 / 0.1));
        assert_eq!(Quantity::ElementSwings.ratio(0.0, 0.0), None);
        assert!(Quantity::TrackingError.ratio(f64::NAN, 1e-12).is_some_and(f64::is_nan));
    }

    #[test]
    fn every_claim_is_about_a_scenario_of_the_catalogue() {
        let catalogue = uam::scenarios::catalogue().unwrap();
        let known = |id: &str| catalogue.iter().any(|scenario| scenario.id == id);
        assert!(all().all(|claim| known(claim.scenario) && claim.compared_with.is_none_or(known)));
    }

    #[test]
    fn the_table_marks_agreement() {
        let numbers = |quantity: Quantity| quantity.measure(&swinging()).unwrap();
        let mut table = Table::new(["euler"]);
        let row = |scenario, quantity| Row::of(of(scenario, quantity).unwrap(), [Some(numbers(quantity))]);
        table.add(
            "4.3a",
            vec![
                row("4.3a", Quantity::FarthestRight),
                Row::plain(Quantity::TrackingError, [Quantity::TrackingError.show(0.2).to_string()]),
            ],
        );
        table.add("4.3c", vec![row("4.3c-minimum-norm", Quantity::LostAt)]);
        assert_eq!(table.agreement(), (2, 1));
        let text = table.to_string();
        assert!(text.contains("110.0 mm ✓") && text.contains("2.0e-1 m"), "{text}");
        assert!(text.contains("2.0 s ✗"), "{text}");
    }

    #[test]
    fn more_quantities_of_a_known_motion() {
        let names = ["base.x", "transmitted.moment", "joint[1].position", "joint[2].position", "joint[1].rate_command"];
        let mut recording = Recording::new(names, 11);
        for k in 0..=10 {
            let t = 0.4 * f64::from(k);
            recording.push(t, [0.01 * t * t, 3.0 - t, 0.2 * t, -0.3 * t, -0.5 * t]);
        }
        let measured = |quantity: Quantity| quantity.measure(&recording).unwrap();
        // From 3 s or the communication point before, 2.8 s, to 4 s.
        assert!((measured(Quantity::DriftSpeed) - 0.01 * (16.0 - 2.8 * 2.8) / 1.2).abs() < 1e-12);
        assert!((measured(Quantity::EarlyMoment) - 3.0).abs() < 1e-12);
        assert!((measured(Quantity::LateMoment) - 1.0).abs() < 1e-12);
        assert!((measured(Quantity::JointsReturn) - 1.2).abs() < 1e-12);
        assert!((measured(Quantity::Rate) - 2.0).abs() < 1e-12);
    }
}
