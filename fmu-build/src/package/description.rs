//! `modelDescription.xml`: what hosts read of a unit before they load it.

use std::borrow::Cow;
use std::io;

use uam::fmi::v2::logger::CATEGORIES;
use uam::variables::unit::PhysicalUnit;
use uam::variables::{Causality, Variability};

use crate::error::Result;
use crate::formats::xml::{self, Ending, Xml, integer, number};
use crate::package::interface::{Enumeration, Interface, Value, Variable};
use crate::package::metadata;

/// The model description of a unit.
///
/// # Errors
/// If the document cannot be put together.
pub fn model_description(interface: &Interface) -> Result<String> {
    xml::document("modelDescription.xml", |xml| {
        let attributes = [
            ("fmiVersion", "2.0"),
            ("modelName", interface.identifier),
            ("guid", interface.guid.as_str()),
            ("description", interface.description),
            ("author", metadata::AUTHOR),
            ("version", metadata::VERSION),
            ("copyright", metadata::COPYRIGHT),
            ("license", metadata::LICENSE),
            ("generationTool", metadata::GENERATION_TOOL),
            ("variableNamingConvention", interface.naming.name()),
        ];
        xml::tall_element(xml, "fmiModelDescription", attributes).holding(|xml| {
            let identifier = [("modelIdentifier", interface.identifier)];
            xml::tall_element(xml, "CoSimulation", identifier.into_iter().chain(interface.capabilities.attributes()))
                .empty()?;
            write_units(xml, &interface.units())?;
            write_types(xml, &interface.enumerations())?;
            write_log_categories(xml)?;
            xml.create_element("DefaultExperiment")
                .with_attribute(("startTime", number(metadata::START_TIME)))
                .with_attribute(("stopTime", number(interface.experiment.stop_time)))
                .with_attribute(("stepSize", number(interface.experiment.step_size)))
                .empty()?;
            let variables = interface.variables.iter().enumerate();
            xml::list(xml, "ModelVariables", variables, |xml, (reference, variable)| {
                write_variable(xml, reference, variable)
            })?;
            write_structure(xml, interface)
        })
    })
}

fn write_units(xml: &mut Xml, units: &[&PhysicalUnit]) -> io::Result<()> {
    xml::list(xml, "UnitDefinitions", units, |xml, unit| {
        xml.create_element("Unit").with_attribute(("name", unit.name)).holding(|xml| {
            xml.create_element("BaseUnit").with_attributes(xml::base_exponents(unit)).empty()?;
            let Some(display) = &unit.display else { return Ok(()) };
            xml.create_element("DisplayUnit")
                .with_attribute(("name", display.name))
                .with_attribute(("factor", number(display.factor)))
                .empty()
        })
    })
}

fn write_types(xml: &mut Xml, enumerations: &[Enumeration]) -> io::Result<()> {
    if enumerations.is_empty() {
        return Ok(());
    }
    xml::list(xml, "TypeDefinitions", enumerations, write_enumeration)
}

fn write_enumeration(xml: &mut Xml, enumeration: &Enumeration) -> io::Result<()> {
    xml.create_element("SimpleType")
        .with_attribute(("name", enumeration.name))
        .with_attribute(("description", enumeration.description))
        .holding(|xml| {
            xml::list(xml, "Enumeration", (1..).zip(enumeration.items), |xml, (number, item)| {
                xml.create_element("Item")
                    .with_attribute(("name", item.name))
                    .with_attribute(("value", integer(number)))
                    .with_attribute(("description", item.description))
                    .empty()
            })
        })
}

fn write_log_categories(xml: &mut Xml) -> io::Result<()> {
    xml::list(xml, "LogCategories", CATEGORIES, |xml, (name, description)| {
        xml.create_element("Category").with_attributes([("name", name), ("description", description)]).empty()
    })
}

fn write_variable(xml: &mut Xml, reference: usize, variable: &Variable) -> io::Result<()> {
    let causality = match variable.causality {
        Causality::Parameter => "parameter",
        Causality::Input => "input",
        Causality::Output => "output",
        Causality::Independent => "independent",
    };
    let variability = match variable.variability {
        Variability::Fixed => "fixed",
        Variability::Tunable => "tunable",
        Variability::Discrete => "discrete",
        Variability::Continuous => "continuous",
    };
    // The standard forbids `initial` for inputs and for the independent variable.
    let initial = match variable.causality {
        Causality::Parameter => Some("exact"),
        Causality::Output => Some("calculated"),
        Causality::Input | Causality::Independent => None,
    };
    xml.create_element("ScalarVariable")
        .with_attribute(("name", variable.name.as_str()))
        .with_attribute(("valueReference", reference.to_string().as_str()))
        .with_attribute(("description", variable.description.as_str()))
        .with_attribute(("causality", causality))
        .with_attribute(("variability", variability))
        .with_attributes(initial.map(|initial| ("initial", initial)))
        .holding(|xml| write_value(xml, variable))
}

fn write_value(xml: &mut Xml, variable: &Variable) -> io::Result<()> {
    let started = variable.is_set_from_outside();
    match variable.value {
        Value::Real { unit, bounds, start } => xml
            .create_element("Real")
            .with_attribute(("unit", unit.name))
            .with_attributes(unit.display.as_ref().map(|display| ("displayUnit", display.name)))
            .with_attributes(bounds.min().map(|min| ("min", number(min))))
            .with_attributes(started.then(|| ("start", number(start))))
            .with_attributes(variable.derivative_of.map(|position| ("derivative", Cow::from(index(position))))),
        Value::Boolean { start } => {
            xml.create_element("Boolean").with_attributes(started.then(|| ("start", xml::truth(start))))
        }
        Value::Enumeration { options, start } => xml
            .create_element("Enumeration")
            .with_attribute(("declaredType", options.name))
            .with_attributes(started.then(|| ("start", integer(start)))),
    }
    .empty()
}

/// Which variables are outputs and unknowns of the initialization, and on what they depend.
///
/// No output depends on an input at a communication point, so every list of dependencies is given and
/// empty: leaving it out would mean "depends on everything" and give hosts algebraic loops to solve.
fn write_structure(xml: &mut Xml, interface: &Interface) -> io::Result<()> {
    xml.create_element("ModelStructure").holding(|xml| {
        let outputs = || interface.with(Causality::Output);
        xml::list(xml, "Outputs", outputs(), |xml, (position, _)| write_unknown(xml, position, &[]))?;
        xml::list(xml, "InitialUnknowns", outputs(), |xml, (position, output)| {
            write_unknown(xml, position, &output.initially_from)
        })
    })
}

fn write_unknown(xml: &mut Xml, position: usize, depends_on: &[usize]) -> io::Result<()> {
    let dependencies: Vec<String> = depends_on.iter().copied().map(index).collect();
    xml.create_element("Unknown")
        .with_attribute(("index", index(position).as_str()))
        .with_attribute(("dependencies", dependencies.join(" ").as_str()))
        .with_attribute(("dependenciesKind", vec!["dependent"; depends_on.len()].join(" ").as_str()))
        .empty()
}

/// Model structure and derivatives count variables from 1, in contrast to value references.
fn index(position: usize) -> String {
    (position + 1).to_string()
}
