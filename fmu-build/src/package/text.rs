//! What users should know of the units beside their variables: the texts of the folder `text`.

use uam::Structure;
use uam::parameters::Balance;

/// The text on the controller.
pub const CONTROLLER: &str = include_str!("text/controller.md");
/// The text on the plant.
pub const PLANT: &str = include_str!("text/plant.md");

const CONVENTIONS: &str = include_str!("text/conventions.md");
const COUNTERWEIGHT: &str = include_str!("text/counterweight.md");
const COUNTERWEIGHT_LAW: &str = include_str!("text/counterweight_law.md");
const ELEMENT: &str = include_str!("text/balance_element.md");
/// The table that `budget --markdown` prints; it is written by `tests/python/test_documents.py`.
const WHICH_STEP: &str = include_str!("text/which_step.md");
const ELEMENT_LAW: &str = include_str!("text/balance_element_law.md");

/// Where the conventions go.
const PLACE_OF_CONVENTIONS: &str = "<!-- conventions -->";
/// Where the text goes on what balances the arm, if something does.
const PLACE_OF_BALANCE: &str = "<!-- balance -->";
/// Where it goes that says how the controller moves that.
const PLACE_OF_LAW: &str = "<!-- law of the balance -->";
/// Where the errors go that a communication step leaves.
const PLACE_OF_STEPS: &str = "<!-- which step -->";

/// A unit's text with what both have in common, and with what belongs to its structure.
#[must_use]
pub fn complete(text: &str, structure: Structure) -> String {
    let (body, law) = match structure.balance {
        Balance::None => ("", ""),
        Balance::Counterweight => (COUNTERWEIGHT, COUNTERWEIGHT_LAW),
        Balance::Element => (ELEMENT, ELEMENT_LAW),
    };
    let parts = [
        (PLACE_OF_CONVENTIONS, CONVENTIONS),
        (PLACE_OF_BALANCE, body),
        (PLACE_OF_LAW, law),
        (PLACE_OF_STEPS, WHICH_STEP),
    ];
    parts.into_iter().fold(text.to_owned(), |text, (place, part)| text.replace(place, part))
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use pulldown_cmark::{Event, Parser};

    use super::*;
    use crate::package::units::Unit;

    /// Every name that users can find in the units of a structure.
    fn names(structure: Structure) -> HashSet<String> {
        let mut names = HashSet::new();
        for interface in Unit::pair(structure).map(|unit| unit.interface) {
            names.insert(interface.identifier.to_owned());
            let items = interface.enumerations().into_iter().flat_map(|enumeration| enumeration.items);
            names.extend(items.map(|item| item.name.to_owned()));
            names.extend(interface.variables.into_iter().map(|variable| variable.name));
        }
        names
    }

    #[test]
    fn every_name_in_the_texts_is_there() {
        let mut seen = 0;
        for structure in Structure::all() {
            let names = names(structure);
            for text in [CONTROLLER, PLANT] {
                let text = complete(text, structure);
                assert!(!text.contains("<!--"), "{text}");
                for event in Parser::new_ext(&text, pulldown_cmark::Options::ENABLE_TABLES) {
                    if let Event::Code(name) = event {
                        let first = name.replace("[i]", "[1]").replace("[j]", "[1]");
                        assert!(names.contains(&first), "{structure}: `{name}`");
                        seen += 1;
                    }
                }
            }
        }
        assert!(seen > 1000);
    }
}
