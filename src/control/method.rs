//! What each resolution method asks for, and which arms and settings suit it: one row per method.

use crate::error::{Error, Result};
use crate::parameters::{Balance, Hold, Parameters, PathAxes, Resolution, Structure};
use crate::variables::options::Choice;

/// What the rest of the controller has to know of a method, whatever its law.
#[derive(Debug, Clone, Copy)]
pub(super) struct Traits {
    /// It asks for rates without moment on the UAV.
    pub cancels_moment: bool,
    /// Something beside the path decides about the rates of a redundant arm.
    pub has_second_task: bool,
    /// It knows limits of accelerations and positions.
    pub limits_accelerations: bool,
    /// It chooses accelerations: rates do not jump.
    pub accelerates: bool,
    /// The path may be followed along one axis alone.
    pub chooses_axes: bool,
    /// The arm must have as many links.
    fewest_links: usize,
    /// The only hold that suits it, and why.
    only_hold: Option<(Hold, &'static str)>,
}

/// Follows the path, with the smallest rates.
const PATH_ALONE: Traits = Traits {
    cancels_moment: false,
    has_second_task: false,
    limits_accelerations: false,
    accelerates: false,
    chooses_axes: false,
    fewest_links: 1,
    only_hold: None,
};

impl Resolution {
    /// The row of this method.
    pub(super) const fn traits(self) -> Traits {
        match self {
            Self::MinimumNorm => PATH_ALONE,
            Self::Gradient => Traits { has_second_task: true, ..PATH_ALONE },
            Self::ExtendedJacobian => {
                Traits { cancels_moment: true, has_second_task: true, fewest_links: 3, ..PATH_ALONE }
            }
            Self::LeastSquares => Traits {
                cancels_moment: true,
                has_second_task: true,
                limits_accelerations: true,
                only_hold: Some((Hold::ZeroOrder, "whose limits are those of constant rates")),
                ..PATH_ALONE
            },
            Self::AccelerationLevel => Traits {
                cancels_moment: true,
                has_second_task: true,
                accelerates: true,
                chooses_axes: true,
                only_hold: Some((Hold::FirstOrder, "whose rates do not jump")),
                ..PATH_ALONE
            },
        }
    }
}

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
    let (traits, method) = (ik.resolution.traits(), ik.resolution.name());
    let refused = |name: &str, expected: String, found: &str| {
        Err(Error::Inconsistent { name: name.to_owned(), expected, found: found.to_owned() })
    };
    if structure.links < traits.fewest_links {
        let fewest = traits.fewest_links;
        let expected =
            format!("an arm of {fewest} links or more is needed, this one has {structure}; use minimum_norm");
        return refused("ik.resolution", expected, method);
    }
    if let Some((hold, reason)) = traits.only_hold
        && ik.hold != hold
    {
        let expected = format!("{} with the resolution {method}, {reason}", hold.name());
        return refused("ik.hold", expected, ik.hold.name());
    }
    if !traits.chooses_axes {
        if ik.path_axes != PathAxes::Both {
            return refused("ik.path_axes", format!("both with the resolution {method}"), ik.path_axes.name());
        }
        return Ok(());
    }
    let coordinates = structure.links + usize::from(structure.balance == Balance::Element);
    if coordinates < ik.path_axes.number() + 1 {
        let expected = format!(
            "at most {} axes for the resolution {method} of {structure}: one joint or balance element fewer than it has",
            coordinates - 1
        );
        return refused("ik.path_axes", expected, ik.path_axes.name());
    }
    Ok(())
}
