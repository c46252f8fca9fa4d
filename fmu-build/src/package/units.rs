//! The two units of a pair, with all that goes into their files beside the libraries.

use uam::Structure;
use uam::units::controller::ControllerUnit;
use uam::units::plant::PlantUnit;

use crate::package::design::Design;
use crate::package::interface::Interface;
use crate::package::text;

/// A unit with its picture and its text for users.
pub struct Unit {
    /// The vehicle.
    pub structure: Structure,
    /// Variables and identity.
    pub interface: Interface,
    /// What goes from the controller to the plant, if the FMU is to say that it belongs together.
    pub terminal: Option<Vec<String>>,
    /// Picture, as PNG.
    pub icon: &'static [u8],
    /// What users should know beside the variables, in Markdown.
    pub text: &'static str,
}

impl Unit {
    /// Controller and plant of a design, for instance of a structure with the library's own start values.
    #[must_use]
    pub fn pair(design: impl Into<Design>) -> [Self; 2] {
        let design = design.into();
        let (controller, plant) = (Interface::of::<ControllerUnit>(&design), Interface::of::<PlantUnit>(&design));
        let commands = || controller.outputs_for(&plant).map(|output| output.name.clone()).collect();
        let terminal: Option<Vec<String>> = design.terminals.then(commands);
        let unit = |interface, icon, text| Self {
            structure: design.structure,
            interface,
            terminal: terminal.clone(),
            icon,
            text,
        };
        [
            unit(controller, include_bytes!("../../../modelDescription/uam_controller.png"), text::CONTROLLER),
            unit(plant, include_bytes!("../../../modelDescription/uam_plant.png"), text::PLANT),
        ]
    }

    /// The controller of a design.
    #[must_use]
    pub fn controller(design: impl Into<Design>) -> Self {
        let [controller, _] = Self::pair(design);
        controller
    }

    /// The plant of a design.
    #[must_use]
    pub fn plant(design: impl Into<Design>) -> Self {
        let [_, plant] = Self::pair(design);
        plant
    }
}
