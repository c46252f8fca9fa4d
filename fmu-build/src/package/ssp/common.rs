//! What the documents of an SSP share.

use std::io;

use uam::variables::unit::PhysicalUnit;

use crate::formats::xml::{self, Ending, Xml};

/// Name space of what all documents of the SSP standard share.
pub const SSC: &str = "http://ssp-standard.org/SSP1/SystemStructureCommon";
/// Name space of system structures.
pub const SSD: &str = "http://ssp-standard.org/SSP1/SystemStructureDescription";
/// Name space of parameter sets.
pub const SSV: &str = "http://ssp-standard.org/SSP1/SystemStructureParameterValues";

/// Definitions of units, inside the element `name`, which must not be empty: without units there is none.
pub fn write_units(xml: &mut Xml, name: &str, units: &[&PhysicalUnit]) -> io::Result<()> {
    if units.is_empty() {
        return Ok(());
    }
    xml::list(xml, name, units, |xml, unit| {
        xml.create_element("ssc:Unit")
            .with_attribute(("name", unit.name))
            .holding(|xml| xml.create_element("ssc:BaseUnit").with_attributes(xml::base_exponents(unit)).empty())
    })
}
