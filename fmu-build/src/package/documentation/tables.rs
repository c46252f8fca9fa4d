//! The tables of a unit's variables and enumerations.

use maud::{Markup, html};
use uam::variables::{Causality, Variability};

use crate::package::interface::{Enumeration, Interface, Value, Variable};

/// Headings of the tables of variables, in the order of the page.
const GROUPS: [(Causality, &str); 4] = [
    (Causality::Input, "Inputs"),
    (Causality::Output, "Outputs"),
    (Causality::Parameter, "Parameters"),
    (Causality::Independent, "Independent variable"),
];

/// A table for each kind of variables, and one for each enumeration, with headings and names for links.
pub fn all(interface: &Interface) -> Vec<(&'static str, Markup)> {
    let mut tables: Vec<_> = GROUPS
        .into_iter()
        .map(|(causality, heading)| (heading, interface.with(causality).map(|(_, variable)| variable).collect()))
        .filter(|(_, variables): &(_, Vec<&Variable>)| !variables.is_empty())
        .map(|(heading, variables)| (heading, group(&variables)))
        .collect();
    tables.push(("Enumerations", html! { @for one in interface.enumerations() { (alternatives(&one)) } }));
    tables
}

fn group(variables: &[&Variable]) -> Markup {
    let tunable = variables.iter().any(|variable| variable.variability == Variability::Tunable);
    let started = variables.iter().any(|variable| variable.is_set_from_outside());
    html! {
        @if tunable {
            p { "Those marked " em { "tunable" } " may be changed between steps, the others before the first." }
        }
        div.wide {
            table.variables {
                thead {
                    tr {
                        th { "Name" }
                        th { "Unit" }
                        @if started { th.number { "Start" } }
                        th { "Allowed" }
                        th { "Meaning" }
                    }
                }
                tbody {
                    @for variable in variables { (row(variable, started)) }
                }
            }
        }
    }
}

fn row(variable: &Variable, started: bool) -> Markup {
    html! {
        tr {
            td { code { (variable.name) } }
            td { (unit_of(&variable.value)) }
            @if started {
                td.number { (start_of(&variable.value)) }
            }
            td { (allowed(&variable.value)) }
            td {
                (variable.description)
                @if variable.variability == Variability::Tunable { " " em { "(tunable)" } }
            }
        }
    }
}

fn unit_of(value: &Value) -> Markup {
    match value {
        Value::Real { unit, .. } => html! { (unit.name) },
        Value::Boolean { .. } => html! { "Boolean" },
        Value::Enumeration { options, .. } => html! { a href={ "#" (options.name) } { (options.name) } },
    }
}

fn start_of(value: &Value) -> String {
    match value {
        Value::Real { start, .. } => start.to_string(),
        Value::Boolean { start } => start.to_string(),
        Value::Enumeration { options, start } => {
            numbered(options).find(|(number, _)| number == start).map_or_else(String::new, |(_, text)| text)
        }
    }
}

fn allowed(value: &Value) -> String {
    match value {
        Value::Real { bounds, .. } => {
            let sign = if bounds.min_excluded() { ">" } else { "≥" };
            bounds.min().map_or_else(String::new, |min| format!("{sign} {min}"))
        }
        Value::Boolean { .. } => String::new(),
        Value::Enumeration { options, .. } => numbered(options).map(|(_, text)| text).collect::<Vec<_>>().join(", "),
    }
}

/// The alternatives with their numbers, which are all that many hosts understand.
fn numbered(enumeration: &Enumeration) -> impl Iterator<Item = (i32, String)> {
    (1..).zip(enumeration.items).map(|(number, item)| (number, format!("{number} = {}", item.name)))
}

fn alternatives(enumeration: &Enumeration) -> Markup {
    html! {
        h3 id=(enumeration.name) { (enumeration.name) }
        p { (enumeration.description) }
        table {
            thead { tr { th.number { "Value" } th { "Name" } th { "Meaning" } } }
            tbody {
                @for (number, item) in (1..).zip(enumeration.items) {
                    tr {
                        td.number { (number) }
                        td { code { (item.name) } }
                        td { (item.description) }
                    }
                }
            }
        }
    }
}
