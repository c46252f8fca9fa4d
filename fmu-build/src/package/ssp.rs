//! An SSP: both units, connected, with one set of parameters for both.
//!
//! Several importers refuse a whole file because of one enumeration, as type of a connector or as value of
//! a parameter. Enumerations are therefore left to the units, which start with the right values.

use uam::variables::Causality;

use crate::error::Result;
use crate::package::archive::Archive;
use crate::package::interface::{Interface, Value, Variable};

mod common;
pub mod parameters;
mod structure;

/// A unit inside the system.
pub struct Component<'a> {
    /// Name in the system, for instance `plant`.
    pub name: &'static str,
    /// Variables.
    pub interface: &'a Interface,
    /// Content of the `.fmu` file.
    pub fmu: &'a [u8],
}

impl Component<'_> {
    /// Path of the FMU inside the SSP.
    fn source(&self) -> String {
        format!("resources/{}", self.interface.file_name())
    }
}

/// The system of two components, connected wherever an output of one has the name and the type of an
/// input of the other.
///
/// # Errors
/// If a document cannot be put together.
pub fn ssp(components: &[Component<'_>; 2]) -> Result<Archive> {
    let mut archive = Archive::default();
    archive.add("SystemStructure.ssd", structure::system_structure(components)?);
    archive.add(parameters::SOURCE, parameters::shared(components)?);
    for component in components {
        archive.add(component.source(), component.fmu);
    }
    Ok(archive)
}

/// A connection: the output of one component and the input of the other, which have this name.
struct Connection<'a> {
    from: &'static str,
    to: &'static str,
    name: &'a str,
}

fn connections<'a>(components: &'a [Component<'_>; 2]) -> impl Iterator<Item = Connection<'a>> {
    let [first, second] = components;
    between(first, second).chain(between(second, first))
}

fn between<'a>(from: &'a Component<'_>, to: &'a Component<'_>) -> impl Iterator<Item = Connection<'a>> {
    let connection = |output: &'a Variable| Connection { from: from.name, to: to.name, name: &output.name };
    from.interface.outputs_for(to.interface).map(connection)
}

/// The parameters that all components have, in the order of the first.
fn shared_parameters<'a>(components: &'a [Component<'_>; 2]) -> impl Iterator<Item = &'a Variable> {
    let [first, second] = components;
    let shared = first.interface.in_common(Causality::Parameter, second.interface, Causality::Parameter);
    shared.filter(|parameter| !matches!(parameter.value, Value::Enumeration { .. }))
}
