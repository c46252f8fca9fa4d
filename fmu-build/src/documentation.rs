//! `documentation/index.html`: what a unit is, how to connect it, and all its variables.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use uam::variables::{Bounds, Causality, Variability};

use crate::interface::{Enumeration, Interface, Value, Variable};
use crate::metadata;
use crate::units::Unit;

pub mod guide;

const STYLE: &str = include_str!("documentation/style.css");

/// Headings of the tables of variables, in the order of the page.
const GROUPS: [(Causality, &str); 4] = [
    (Causality::Input, "Inputs"),
    (Causality::Output, "Outputs"),
    (Causality::Parameter, "Parameters"),
    (Causality::Independent, "Independent variable"),
];

/// The page on a unit.
#[must_use]
pub fn page(unit: &Unit) -> String {
    let interface = &unit.interface;
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (interface.identifier) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    img src="../model.png" width="100" height="100" alt="";
                    div {
                        h1 { (interface.identifier) }
                        p { (interface.description) "." }
                    }
                }
                p {
                    "FMI 2.0 for co-simulation; structure: " strong { (interface.structure) } "; version "
                    (metadata::VERSION) ". The structure was chosen when the unit was built and fixes the variables "
                    "below; all numbers are parameters."
                }
                (unit.guide)
                (guide::conventions())
                @for (causality, heading) in GROUPS {
                    (group(interface, causality, heading))
                }
                h2 { "Enumerations" }
                @for enumeration in interface.enumerations() {
                    (alternatives(&enumeration))
                }
                footer {
                    p { (metadata::COPYRIGHT) ". " (metadata::LICENSE) ": see the folder " code { "licenses" } "." }
                }
            }
        }
    };
    markup.into_string()
}

fn group(interface: &Interface, causality: Causality, heading: &str) -> Markup {
    let variables: Vec<&Variable> = interface.with(causality).map(|(_, variable)| variable).collect();
    let tunable = variables.iter().any(|variable| variable.variability == Variability::Tunable);
    let started = variables.iter().any(|variable| variable.is_set_from_outside());
    html! {
        @if !variables.is_empty() {
            h2 { (heading) }
            @if tunable {
                p { "Those marked " em { "tunable" } " may be changed between steps, the others before the first." }
            }
            table {
                thead {
                    tr {
                        th { "Name" }
                        th { "Unit" }
                        @if started { th { "Start" } th { "Allowed" } }
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
                td { (allowed(&variable.value)) }
            }
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
            let index = usize::try_from(start - 1).unwrap_or_default();
            options.items.get(index).map_or_else(String::new, |item| item.name.to_owned())
        }
    }
}

fn allowed(value: &Value) -> String {
    let Value::Real { bounds, .. } = value else { return String::new() };
    let Bounds { min, max, min_excluded } = *bounds;
    let lower = min.map(|min| format!("{} {min}", if min_excluded { ">" } else { "≥" }));
    let upper = max.map(|max| format!("≤ {max}"));
    lower.into_iter().chain(upper).collect::<Vec<_>>().join(", ")
}

fn alternatives(enumeration: &Enumeration) -> Markup {
    html! {
        h3 id=(enumeration.name) { (enumeration.name) }
        p { (enumeration.description) }
        table {
            thead { tr { th { "Value" } th { "Name" } th { "Meaning" } } }
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
