//! `terminalsAndIcons/terminalsAndIcons.xml`: which variables belong together, so that importers connect both units by
//! one line.
//!
//! FMI 2.0 does not know this file; it is that of FMI 3.0, which importers of FMI 2.0 read or pass over.

use crate::error::Result;
use crate::units::Unit;
use crate::xml;

/// Folder of the file and the icon inside the FMU.
pub const FOLDER: &str = "terminalsAndIcons";

/// Corners of the icon, in a drawing of 20 mm by 20 mm.
const CORNERS: [(&str, &str); 4] = [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];
const SCALE: (&str, &str) = ("suggestedScalingFactorTo_mm", "0.1");

/// The terminal with which the unit is plugged to the other one.
///
/// # Errors
/// If the document cannot be put together.
pub fn terminals_and_icons(unit: &Unit) -> Result<String> {
    xml::document("terminalsAndIcons.xml", |xml| {
        xml.create_element("fmiTerminalsAndIcons").with_attribute(("fmiVersion", "3.0")).write_inner_content(
            |xml| {
                xml.create_element("GraphicalRepresentation").write_inner_content(|xml| {
                    xml.create_element("CoordinateSystem")
                        .with_attributes(CORNERS)
                        .with_attribute(SCALE)
                        .write_empty()?;
                    xml.create_element("Icon").with_attributes(CORNERS).write_empty()?;
                    Ok(())
                })?;
                xml.create_element("Terminals").write_inner_content(|xml| {
                    xml.create_element("Terminal")
                        .with_attribute(("name", "commands"))
                        .with_attribute(("matchingRule", "plug"))
                        .with_attribute(("description", "From the controller to what moves the arm"))
                        .write_inner_content(|xml| {
                            for name in &unit.commands {
                                xml.create_element("TerminalMemberVariable")
                                    .with_attribute(("variableName", name.as_str()))
                                    .with_attribute(("memberName", name.as_str()))
                                    .with_attribute(("variableKind", "signal"))
                                    .write_empty()?;
                            }
                            Ok(())
                        })?;
                    Ok(())
                })?;
                Ok(())
            },
        )?;
        Ok(())
    })
}
