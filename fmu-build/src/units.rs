//! The two units of a pair, with all that goes into their files beside the libraries.

use maud::Markup;
use uam::interface::controller::ControllerUnit;
use uam::interface::plant::PlantUnit;

use crate::design::Design;
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
    /// The controller of a design, for instance of a structure with the library's own start values.
    #[must_use]
    pub fn controller(design: impl Into<Design>) -> Self {
        Self {
            interface: Interface::of::<ControllerUnit>(&design.into()),
            icon: include_bytes!("../../modelDescription/uam_controller.png"),
            guide: guide::controller(),
        }
    }

    /// The plant of a design, for instance of a structure with the library's own start values.
    #[must_use]
    pub fn plant(design: impl Into<Design>) -> Self {
        Self {
            interface: Interface::of::<PlantUnit>(&design.into()),
            icon: include_bytes!("../../modelDescription/uam_plant.png"),
            guide: guide::plant(),
        }
    }
}
