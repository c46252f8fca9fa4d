//! `SystemStructure.ssd`: components, their connectors and the connections between them.

use std::io;

use uam::variables::Causality;

use super::{Component, Connection, common, connections, parameters};
use crate::error::Result;
use crate::formats::xml::{self, Ending, Xml, number};
use crate::package::design::Experiment;
use crate::package::interface::{Value, Variable, units_of};
use crate::package::metadata;

/// Name space of OMSimulator's annotations.
const OMS: &str = "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd";
/// Name space of the Open Simulation Platform's annotations.
const OSP: &str = "http://opensimulationplatform.com/SSP/OSPAnnotations";

/// The system structure.
pub fn system_structure(components: &[Component<'_>; 2]) -> Result<String> {
    let connections: Vec<_> = connections(components).collect();
    let experiment = components[0].interface.experiment;
    let units = units_of(components.iter().flat_map(|component| connectors(component, &connections)).map(|(_, v)| v));
    xml::document("SystemStructure.ssd", |xml| {
        let attributes = [
            ("xmlns:ssc", common::SSC),
            ("xmlns:ssd", common::SSD),
            ("xmlns:ssv", common::SSV),
            ("xmlns:oms", OMS),
            ("xmlns:osp", OSP),
            ("version", "1.0"),
            ("name", "uam"),
            ("author", metadata::AUTHOR),
            ("fileversion", metadata::VERSION),
            ("copyright", metadata::COPYRIGHT),
            ("license", metadata::LICENSE),
            ("generationTool", metadata::GENERATION_TOOL),
        ];
        xml::tall_element(xml, "ssd:SystemStructureDescription", attributes).holding(|xml| {
            write_system(xml, components, &connections, experiment)?;
            common::write_units(xml, "ssd:Units", &units)?;
            write_default_experiment(xml, experiment)
        })
    })
}

fn write_system(
    xml: &mut Xml,
    components: &[Component<'_>; 2],
    connections: &[Connection<'_>],
    experiment: Experiment,
) -> io::Result<()> {
    xml.create_element("ssd:System")
        .with_attribute(("name", "uam"))
        .with_attribute(("description", "Aerial manipulator: inverse kinematics and plant"))
        .holding(|xml| {
            xml::list(xml, "ssd:Elements", components, |xml, component| write_component(xml, component, connections))?;
            xml::list(xml, "ssd:Connections", connections, write_connection)?;
            // OMSimulator ends abruptly when it finds a system without a master.
            write_annotation(xml, "org.openmodelica", |xml| {
                xml.create_element("oms:Annotations").holding(|xml| {
                    xml.create_element("oms:SimulationInformation").holding(|xml| {
                        xml.create_element("oms:FixedStepMaster")
                            .with_attribute(("description", "oms-ma"))
                            .with_attribute(("stepSize", number(experiment.step_size)))
                            .with_attribute(("absoluteTolerance", "0.0001"))
                            .with_attribute(("relativeTolerance", "0.0001"))
                            .empty()
                    })
                })
            })
        })
}

fn write_component(xml: &mut Xml, component: &Component<'_>, connections: &[Connection<'_>]) -> io::Result<()> {
    xml.create_element("ssd:Component")
        .with_attribute(("name", component.name))
        .with_attribute(("description", component.interface.description))
        .with_attribute(("type", "application/x-fmu-sharedlibrary"))
        .with_attribute(("source", component.source().as_str()))
        .with_attribute(("implementation", "CoSimulation"))
        .holding(|xml| {
            let connectors = connectors(component, connections);
            xml::list(xml, "ssd:Connectors", connectors, |xml, (kind, variable)| write_connector(xml, kind, variable))?;
            xml.create_element("ssd:ParameterBindings").holding(|xml| {
                xml.create_element("ssd:ParameterBinding").with_attribute(("source", parameters::SOURCE)).empty()
            })
        })
}

/// The connectors of a component with their kinds.
///
/// An input that nothing is connected to is left out and keeps its start value: some importers drive every
/// input that is listed, connected or not.
fn connectors<'a>(
    component: &'a Component<'_>,
    connections: &'a [Connection<'_>],
) -> impl Iterator<Item = (&'static str, &'a Variable)> {
    let is_connected = |name: &str| connections.iter().any(|other| other.to == component.name && other.name == name);
    component.interface.variables.iter().filter_map(move |variable| {
        let kind = match (variable.causality, variable.value) {
            (Causality::Independent, _) | (_, Value::Enumeration { .. }) => None,
            (Causality::Parameter, _) => Some("parameter"),
            (Causality::Input, _) => is_connected(&variable.name).then_some("input"),
            (Causality::Output, _) => Some("output"),
        };
        kind.map(|kind| (kind, variable))
    })
}

fn write_connector(xml: &mut Xml, kind: &str, variable: &Variable) -> io::Result<()> {
    xml.create_element("ssd:Connector")
        .with_attribute(("name", variable.name.as_str()))
        .with_attribute(("kind", kind))
        .with_attribute(("description", variable.description.as_str()))
        .holding(|xml| {
            match variable.value {
                Value::Real { unit, .. } => {
                    xml.create_element("ssc:Real").with_attribute(("unit", unit.name)).empty()?;
                }
                Value::Boolean { .. } => {
                    xml.create_element("ssc:Boolean").empty()?;
                }
                Value::Enumeration { .. } => {}
            }
            Ok(())
        })
}

fn write_connection(xml: &mut Xml, connection: &Connection<'_>) -> io::Result<()> {
    xml.create_element("ssd:Connection")
        .with_attributes([
            ("startElement", connection.from),
            ("startConnector", connection.name),
            ("endElement", connection.to),
            ("endConnector", connection.name),
        ])
        .empty()
}

fn write_default_experiment(xml: &mut Xml, experiment: Experiment) -> io::Result<()> {
    xml.create_element("ssd:DefaultExperiment")
        .with_attribute(("startTime", number(metadata::START_TIME)))
        .with_attribute(("stopTime", number(experiment.stop_time)))
        .holding(|xml| {
            write_annotation(xml, "com.opensimulationplatform", |xml| {
                xml.create_element("osp:Algorithm").holding(|xml| {
                    xml.create_element("osp:FixedStepAlgorithm")
                        .with_attribute(("baseStepSize", number(experiment.step_size)))
                        .empty()
                })
            })
        })
}

/// What is meant for one importer only.
fn write_annotation(xml: &mut Xml, importer: &str, content: impl FnOnce(&mut Xml) -> io::Result<()>) -> io::Result<()> {
    xml.create_element("ssd:Annotations")
        .holding(|xml| xml.create_element("ssc:Annotation").with_attribute(("type", importer)).holding(content))
}
