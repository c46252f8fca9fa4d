//! Writes scenario files.

use std::fmt::Write;

use super::reader::{DURATION, STEP};
use super::{Scenario, default_parameters};
use crate::parameters::Parameters;
use crate::reference::PathTable;
use crate::variables::Kind;

/// Which parameters a file holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Those that differ from the start values of the units.
    Changes,
    /// All.
    Everything,
}

/// The text of a file that reads as this scenario.
pub(super) fn write(scenario: &Scenario, extent: Extent) -> String {
    let Scenario { id, title, structure, duration, step, .. } = scenario;
    let [id, title] = [id, title].map(|text| quoted(text));
    let (links, balance) = (structure.links, structure.balance.name());
    let path = scenario.parameters.reference.table.as_deref().map_or_else(String::new, rows);
    let mut text = format!(
        "\
# Names, units and bounds of the parameters are those of the FMUs. What is not here has the start value that it
# has in the FMUs of this structure. A number may stand with its unit, in quotes: \"30 deg\", \"5 cm\"; \"joint[*].weight\" is
# the weight of every joint.
id = {id}
title = {title}
duration = {duration:?} # [s]
step = {step:?} # between two communication points [s]
{path}
[structure]
links = {links}
balance = \"{balance}\"

[parameters]
"
    );
    let (defaults, parameters) = (&default_parameters(*structure), &scenario.parameters);
    for variable in Parameters::table(*structure).variables() {
        let (value, default, meaning) = match variable.kind {
            Kind::Real { at, unit, .. } => {
                let value = |data| format!("{:?}", at.get(data));
                let meaning = format!("{} [{}]", variable.description, unit.name);
                (value(parameters), value(defaults), meaning)
            }
            Kind::Boolean { at } => {
                let value = |data| at.get(data).to_string();
                (value(parameters), value(defaults), variable.description.clone())
            }
            Kind::Enumeration { at } => {
                let value = |data| format!("\"{}\"", at.get(data).name());
                let items = at.get(parameters).items().iter().map(|item| item.name);
                let meaning = format!("{}: {}", variable.description, items.collect::<Vec<_>>().join(", "));
                (value(parameters), value(defaults), meaning)
            }
        };
        // A path is followed unless the file says otherwise.
        let must_be_said = !path.is_empty() && variable.name == "reference.kind";
        if extent == Extent::Everything || value != default || must_be_said {
            let name = &variable.name;
            // Brackets need quotes.
            let quote = if name.contains('[') { "\"" } else { "" };
            // Writing to a text cannot fail.
            let _ = writeln!(text, "{quote}{name}{quote} = {value} # {meaning}");
        }
    }
    text
}

/// The rows of a path.
fn rows(table: &PathTable) -> String {
    let mut text =
        "path = [ # each: time [s], x, y [m], and velocities along both [m/s] if they are given\n".to_owned();
    for row in table.rows() {
        // Writing to a text cannot fail.
        let _ = writeln!(text, "    {row:?},");
    }
    text + "]\n"
}

/// The beginning of a file that reads as this scenario with some changes.
pub(super) fn based_on(scenario: &Scenario) -> String {
    let id = quoted(&scenario.id);
    format!("id = {id}\nbased_on = {id}\n")
}

/// Appends a change to a file that is based on a scenario.
pub(super) fn change(text: &mut String, name: &str, value: &str) {
    let table = if [DURATION.0, STEP.0].contains(&name) { "" } else { "parameters." };
    let value = match (value.parse::<f64>(), value) {
        (Ok(number), _) if number.is_nan() => "nan".to_owned(),
        (Ok(number), _) => format!("{number:?}"),
        (_, "true" | "false") => value.to_owned(),
        _ => quoted(value),
    };
    // Writing to a text cannot fail.
    let _ = writeln!(text, "{table}{} = {value}", quoted(name));
}

/// A text as TOML writes it.
fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(quoted, "\\u{:04X}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted + "\""
}
