//! `terminalsAndIcons/terminalsAndIcons.xml`: which variables belong together, so that importers connect both units by
//! one line.
//!
//! FMI 2.0.4 takes this file over from FMI 3.0, whose schema wants `fmiVersion` to be 3.0. FMI Library 3.0.4 (PyFMI,
//! for instance) wants there what `modelDescription.xml` has, 2.0, and otherwise says that the unit is damaged, in two
//! lines of the level "fatal", before it goes on. No file pleases both: so there is one only where it is asked for.

use std::io;

use crate::error::Result;
use crate::formats::xml::{self, Ending, Xml};

/// Folder of the file and the icon inside the FMU.
pub const FOLDER: &str = "terminalsAndIcons";

/// Corners of the icon, in a drawing of 20 mm by 20 mm.
const CORNERS: [(&str, &str); 4] = [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];
const SCALE: (&str, &str) = ("suggestedScalingFactorTo_mm", "0.1");

/// The terminal with which the unit is plugged to the other one, with its `members`.
///
/// # Errors
/// If the document cannot be put together.
pub fn terminals_and_icons(members: &[String]) -> Result<String> {
    xml::document("terminalsAndIcons.xml", |xml| {
        xml.create_element("fmiTerminalsAndIcons").with_attribute(("fmiVersion", "3.0")).holding(|xml| {
            xml.create_element("GraphicalRepresentation").holding(|xml| {
                xml.create_element("CoordinateSystem").with_attributes(CORNERS).with_attribute(SCALE).empty()?;
                xml.create_element("Icon").with_attributes(CORNERS).empty()
            })?;
            xml.create_element("Terminals").holding(|xml| {
                xml.create_element("Terminal")
                    .with_attribute(("name", "commands"))
                    .with_attribute(("matchingRule", "plug"))
                    .with_attribute(("description", "From the controller to what moves the arm"))
                    .holding(|xml| members.iter().try_for_each(|name| write_member(xml, name)))
            })
        })
    })
}

fn write_member(xml: &mut Xml, name: &str) -> io::Result<()> {
    xml.create_element("TerminalMemberVariable")
        .with_attribute(("variableName", name))
        .with_attribute(("memberName", name))
        .with_attribute(("variableKind", "signal"))
        .empty()
}
