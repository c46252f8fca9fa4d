//! The parameter set of the system.

use std::io;

use super::{Component, common, shared_parameters};
use crate::error::Result;
use crate::formats::xml::{self, Ending, Xml, integer, number};
use crate::package::interface::{Value, Variable, units_of};
use crate::package::metadata;

/// Path of the parameter set inside the SSP.
pub const SOURCE: &str = "resources/uam.ssv";
/// The name under which importers that know several sets look for the one to begin with.
const NAME: &str = "initialValues";

/// The parameters that all components have, with their start values.
pub fn shared(components: &[Component<'_>; 2]) -> Result<String> {
    let parameters: Vec<&Variable> = shared_parameters(components).collect();
    set(NAME, "Vehicle, autopilot and payload: what both units must agree on", &parameters)
}

/// A parameter set with these values.
///
/// Enumerations stand there as integers, which is what hosts hand to FMUs anyway: importers that refuse
/// the word take the number.
///
/// # Errors
/// If the document cannot be put together.
pub fn set(name: &str, description: &str, parameters: &[&Variable]) -> Result<String> {
    xml::document(SOURCE, |xml| {
        let attributes = [
            ("xmlns:ssc", common::SSC),
            ("xmlns:ssv", common::SSV),
            ("version", "1.0"),
            ("name", name),
            ("description", description),
            ("generationTool", metadata::GENERATION_TOOL),
        ];
        xml::tall_element(xml, "ssv:ParameterSet", attributes).holding(|xml| {
            xml::list(xml, "ssv:Parameters", parameters, |xml, parameter| write_parameter(xml, parameter))?;
            common::write_units(xml, "ssv:Units", &units_of(parameters.iter().copied()))
        })
    })
}

fn write_parameter(xml: &mut Xml, parameter: &Variable) -> io::Result<()> {
    let element = xml
        .create_element("ssv:Parameter")
        .with_attribute(("name", parameter.name.as_str()))
        .with_attribute(("description", parameter.description.as_str()));
    element.holding(|xml| {
        match parameter.value {
            Value::Real { unit, start, .. } => xml
                .create_element("ssv:Real")
                .with_attribute(("value", number(start)))
                .with_attribute(("unit", unit.name)),
            Value::Boolean { start } => xml.create_element("ssv:Boolean").with_attribute(("value", xml::truth(start))),
            Value::Enumeration { start, .. } => {
                xml.create_element("ssv:Integer").with_attribute(("value", integer(start)))
            }
        }
        .empty()
    })
}
