//! The two units of a pair, with all that goes into their files beside the libraries.

use maud::Markup;
use uam::Structure;
use uam::interface::controller::ControllerUnit;
use uam::interface::plant::PlantUnit;

use crate::documentation::guide;
use crate::interface::Interface;

/// A unit with its picture and its guide for users.
pub struct Unit {
    /// Variables and identity.
    pub interface: Interface,
    /// Picture, as PNG.
    pub icon: &'static [u8],
    /// What users should know beside the variables.
    pub guide: Markup,
}

impl Unit {
    /// The controller of this structure.
    #[must_use]
    pub fn controller(structure: Structure) -> Self {
        Self {
            interface: Interface::of::<ControllerUnit>(structure),
            icon: include_bytes!("../../modelDescription/uam_controller.png"),
            guide: guide::controller(),
        }
    }

    /// The plant of this structure.
    #[must_use]
    pub fn plant(structure: Structure) -> Self {
        Self {
            interface: Interface::of::<PlantUnit>(structure),
            icon: include_bytes!("../../modelDescription/uam_plant.png"),
            guide: guide::plant(),
        }
    }
}
