//! What the thesis says came out of a simulation, beside what comes out here.

use std::ops::RangeInclusive;

mod quantity;
mod table;
mod thesis;

pub use quantity::{Quantity, Shown};
pub use table::{Cell, Row, Section, Table};
pub use thesis::{BASE_MOTION, PICK_UP};

/// How far the end effector may be from its reference before it counts as having left the workspace \[m\].
pub const LOST: f64 = 0.01;

/// A statement of the thesis about one quantity of one scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// Which scenario.
    pub scenario: &'static str,
    /// About what.
    pub quantity: Quantity,
    /// The statement.
    pub thesis: &'static str,
    /// Numbers (SI) that agree with it.
    pub agrees: RangeInclusive<f64>,
}

/// All claims, in the order of the thesis.
pub fn all() -> impl Iterator<Item = &'static Claim> {
    BASE_MOTION.iter().chain(PICK_UP)
}

/// What the thesis says about this quantity of this scenario.
#[must_use]
pub fn find(scenario: &str, quantity: Quantity) -> Option<&'static Claim> {
    all().find(|claim| claim.scenario == scenario && claim.quantity == quantity)
}

#[cfg(test)]
mod tests {
    use super::quantity::peak;
    use super::*;
    use crate::record::Recording;

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
        let measured = |quantity: Quantity| quantity.measure(&recording);
        assert_eq!(measured(Quantity::FarthestRight), 0.11);
        assert_eq!(measured(Quantity::FarthestLeft), 0.03);
        assert_eq!(measured(Quantity::FinalX), 0.02);
        assert_eq!(measured(Quantity::Sinking), 0.1);
        assert_eq!(measured(Quantity::TrackingError), 0.2);
        assert_eq!(measured(Quantity::LostAt), 2.0);
        assert!(measured(Quantity::Roll).is_nan());
    }

    #[test]
    fn nothing_hides_behind_not_a_number() {
        assert!(peak([].into_iter()).is_nan());
        assert!(peak([1.0, f64::NAN, 2.0].into_iter()).is_nan());
        assert_eq!(peak([1.0, 3.0, 2.0].into_iter()), 3.0);
    }

    #[test]
    fn numbers_read_well() {
        let shown = |quantity: Quantity, value: f64| quantity.show(value).to_string();
        assert_eq!(shown(Quantity::FarthestRight, 0.112_34), "112.3 mm");
        assert_eq!(shown(Quantity::FinalX, 0.005_04), "5.04 mm");
        assert_eq!(shown(Quantity::TrackingError, 1.23e-4), "1.2e-4 m");
        assert_eq!(shown(Quantity::LostAt, f64::INFINITY), "never");
        assert_eq!(shown(Quantity::Roll, f64::NAN), "–");
        assert_eq!(shown(Quantity::Roll, 1e-9), "6e-8 °");
    }

    #[test]
    fn every_claim_is_about_a_scenario_of_the_catalogue() {
        let catalogue = uam::scenarios::catalogue().unwrap();
        assert!(all().all(|claim| catalogue.iter().any(|scenario| scenario.id == claim.scenario)));
    }

    #[test]
    fn the_table_marks_agreement() {
        let recording = swinging();
        let mut table = Table::new(["euler"]);
        table.add(Some("4.3a"), "smallest rates", &[Quantity::FarthestRight, Quantity::TrackingError], &[&recording]);
        table.add(Some("4.3c-minimum-norm"), "swings", &[Quantity::LostAt], &[&recording]);
        assert_eq!(table.agreement(), (2, 1));
        let text = table.to_string();
        assert!(text.contains("110.0 mm ✓"), "{text}");
        assert!(text.contains("2.0 s ✗"), "{text}");
    }
}
