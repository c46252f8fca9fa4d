//! `documentation/index.html`: what a unit is and computes, how to connect it, and all its variables.

use maud::{Markup, html};
use uam::fmi::Naming;

use crate::formats::html::document;
use crate::package::units::Unit;
use crate::package::{metadata, text};

mod figure;
mod markdown;
mod tables;

const STYLE: &str = include_str!("documentation/style.css");

/// The page on a unit.
#[must_use]
pub fn page(unit: &Unit) -> String {
    let chapters = markdown::chapters(&text::complete(unit.text, unit.structure));
    let tables = tables::all(&unit.interface);
    let body = html! {
        (head(unit))
        nav {
            @for chapter in &chapters { a href={ "#" (anchor(&chapter.title)) } { (chapter.title) } }
            @for (heading, _) in &tables { a href={ "#" (anchor(heading)) } { (heading) } }
        }
        main {
            @for (place, chapter) in chapters.iter().enumerate() {
                section {
                    h2 id=(anchor(&chapter.title)) { (chapter.title) }
                    (chapter.content)
                    @if place == 0 { (figure::vehicle(unit.structure)) }
                }
            }
            @for (heading, table) in &tables {
                section { h2 id=(anchor(heading)) { (heading) } (table) }
            }
        }
        footer {
            p { (metadata::COPYRIGHT) ". " (metadata::LICENSE) ": see the folder " code { "licenses" } "." }
        }
    };
    document(unit.interface.identifier, STYLE, &body)
}

/// The name by which links find a heading.
fn anchor(heading: &str) -> String {
    heading.to_lowercase().replace(' ', "-")
}

fn head(unit: &Unit) -> Markup {
    let interface = &unit.interface;
    html! {
        header {
            img src="../model.png" width="100" height="100" alt="";
            div {
                h1 { (interface.identifier) }
                p { (interface.description) "." }
            }
        }
        dl {
            dt { "Interface" } dd { "FMI 2.0 for co-simulation" }
            dt { "Structure" }
            dd { (interface.structure) ", chosen when the unit was built; all numbers are parameters" }
            dt { "Experiment" }
            dd {
                (interface.experiment.stop_time) " s in steps of " (interface.experiment.step_size)
                " s, if nothing else is asked for"
            }
            dt { "Version" } dd { (metadata::VERSION) ", " code { (interface.guid) } }
            @if interface.naming == Naming::Flat {
                dt { "Names" }
                dd {
                    "flat: what the text calls " code { "joint[1].rate_command" } " is "
                    code { "joint_1_rate_command" }
                }
            }
        }
    }
}
