//! The two units of a pair, with all that goes into their files beside the libraries.

use uam::Structure;
use uam::interface::controller::ControllerUnit;
use uam::interface::plant::PlantUnit;

use crate::design::Design;
use crate::interface::Interface;
use crate::text;

/// A unit with its picture and its text for users.
pub struct Unit {
    /// The vehicle.
    pub structure: Structure,
    /// Variables and identity.
    pub interface: Interface,
    /// Picture, as PNG.
    pub icon: &'static [u8],
    /// What users should know beside the variables, in Markdown.
    pub text: &'static str,
}

impl Unit {
    /// The controller of a design, for instance of a structure with the library's own start values.
    #[must_use]
    pub fn controller(design: impl Into<Design>) -> Self {
        let design = design.into();
        Self {
            structure: design.structure,
            interface: Interface::of::<ControllerUnit>(&design),
            icon: include_bytes!("../../modelDescription/uam_controller.png"),
            text: text::CONTROLLER,
        }
    }

    /// The plant of a design, for instance of a structure with the library's own start values.
    #[must_use]
    pub fn plant(design: impl Into<Design>) -> Self {
        let design = design.into();
        Self {
            structure: design.structure,
            interface: Interface::of::<PlantUnit>(&design),
            icon: include_bytes!("../../modelDescription/uam_plant.png"),
            text: text::PLANT,
        }
    }
}
