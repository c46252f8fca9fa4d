//! Which methods suit which arms and move what balances them, and which of their settings go together.

use crate::error::{Error, Result};
use crate::parameters::{Balance, Hold, Parameters, PathAxes, Resolution, Structure};
use crate::variables::options::Choice;

impl Balance {
    /// The resolution that moves it: a counterweight by its own law, a balance element together with the arm. With all
    /// others it holds still.
    #[must_use]
    pub fn moved_by(self) -> Option<Resolution> {
        match self {
            Self::None => None,
            Self::Counterweight => Some(Resolution::LeastSquares),
            Self::Element => Some(Resolution::AccelerationLevel),
        }
    }
}

/// Whether the method suits the arm, and its parts each other.
///
/// # Errors
/// Names the setting that does not, with what would.
pub(super) fn check(structure: Structure, parameters: &Parameters) -> Result<()> {
    let Parameters { ik, .. } = parameters;
    let refused = |name: &str, expected: String, found: &str| {
        Err(Error::Inconsistent { name: name.to_owned(), expected, found: found.to_owned() })
    };
    if ik.resolution == Resolution::ExtendedJacobian && structure.links < 3 {
        let expected = format!("an arm of 3 links or more is needed, this one has {structure}; use minimum_norm");
        return refused("ik.resolution", expected, ik.resolution.name());
    }
    if ik.resolution == Resolution::LeastSquares && ik.hold == Hold::FirstOrder {
        let expected = "zero_order with the resolution least_squares, whose limits are those of constant rates";
        return refused("ik.hold", expected.to_owned(), ik.hold.name());
    }
    if ik.resolution != Resolution::AccelerationLevel {
        if ik.path_axes != PathAxes::Both {
            let expected = format!("both with the resolution {}", ik.resolution.name());
            return refused("ik.path_axes", expected, ik.path_axes.name());
        }
        return Ok(());
    }
    if ik.hold != Hold::FirstOrder {
        let expected = "first_order with the resolution acceleration_level, whose rates do not jump";
        return refused("ik.hold", expected.to_owned(), ik.hold.name());
    }
    let coordinates = structure.links + usize::from(structure.balance == Balance::Element);
    if coordinates < ik.path_axes.number() + 1 {
        let expected = format!(
            "at most {} axes for the resolution acceleration_level of {structure}: one joint or balance element fewer \
             than it has",
            coordinates - 1
        );
        return refused("ik.path_axes", expected, ik.path_axes.name());
    }
    Ok(())
}
