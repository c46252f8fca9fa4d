//! Model descriptions of every structure, read back as a host reads them.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::collections::{BTreeMap, BTreeSet};

use fmu_build::Design;
use fmu_build::package::description::model_description;
use fmu_build::package::interface::{Interface, Value, Variable};
use fmu_build::package::units::Unit;
use roxmltree::{Document, Node};
use uam::Structure;
use uam::fmi::Naming;
use uam::variables::Causality;

/// Runs `check` on every unit of every structure with its parsed model description.
fn for_every_unit(check: impl Fn(&Interface, Node<'_, '_>)) {
    for structure in Structure::all() {
        for unit in Unit::pair(structure) {
            let text = model_description(&unit.interface).unwrap();
            let document = Document::parse(&text).unwrap();
            check(&unit.interface, document.root_element());
        }
    }
}

fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Node<'a, 'i> {
    node.children().find(|child| child.has_tag_name(name)).unwrap_or_else(|| panic!("no element {name}"))
}

fn elements<'a, 'i>(node: Node<'a, 'i>) -> Vec<Node<'a, 'i>> {
    node.children().filter(Node::is_element).collect()
}

fn attribute<'a>(node: Node<'a, '_>, name: &str) -> &'a str {
    node.attribute(name).unwrap_or_else(|| panic!("no attribute {name} in {node:?}"))
}

fn indexes(text: &str) -> Vec<usize> {
    text.split_whitespace().map(|index| index.parse().unwrap()).collect()
}

#[test]
fn every_variable_stands_once_at_its_value_reference() {
    for_every_unit(|interface, root| {
        let scalars = elements(child(root, "ModelVariables"));
        assert_eq!(scalars.len(), interface.variables.len());
        for (position, (scalar, variable)) in scalars.iter().zip(&interface.variables).enumerate() {
            assert_eq!(attribute(*scalar, "name"), variable.name);
            assert_eq!(attribute(*scalar, "valueReference"), position.to_string());
            assert_eq!(attribute(*scalar, "description"), variable.description);
        }
        let names: BTreeSet<_> = interface.variables.iter().map(|variable| &variable.name).collect();
        assert_eq!(names.len(), interface.variables.len(), "names are unique");
    });
}

#[test]
fn no_variable_is_also_a_record() {
    for_every_unit(|interface, _| {
        for Variable { name, .. } in &interface.variables {
            let record = format!("{name}.");
            assert!(!interface.variables.iter().any(|other| other.name.starts_with(&record)), "{name}");
        }
    });
}

#[test]
fn start_values_come_back_bit_by_bit_and_are_admissible() {
    for_every_unit(|interface, root| {
        for (scalar, variable) in elements(child(root, "ModelVariables")).into_iter().zip(&interface.variables) {
            let [value] = elements(scalar)[..] else { panic!("one type per variable") };
            if !variable.is_set_from_outside() {
                assert_eq!(value.attribute("start"), None, "{}", variable.name);
                continue;
            }
            let text = attribute(value, "start");
            match variable.value {
                Value::Real { start, bounds, .. } => {
                    assert_eq!(text.parse::<f64>().unwrap().to_bits(), start.to_bits(), "{}", variable.name);
                    assert!(bounds.admit(start), "{} = {start} must be {bounds}", variable.name);
                    assert_eq!(value.attribute("min").map(|text| text.parse().unwrap()), bounds.min());
                    assert_eq!(value.attribute("max"), None);
                }
                Value::Boolean { start } => assert_eq!(text, start.to_string()),
                Value::Enumeration { start, options } => {
                    assert_eq!(text, start.to_string());
                    assert!((1..=options.items.len()).contains(&usize::try_from(start).unwrap()));
                }
            }
        }
    });
}

#[test]
fn initial_is_given_exactly_where_the_standard_wants_it() {
    for_every_unit(|interface, root| {
        for (scalar, variable) in elements(child(root, "ModelVariables")).into_iter().zip(&interface.variables) {
            let expected = match variable.causality {
                Causality::Parameter => Some("exact"),
                Causality::Output => Some("calculated"),
                Causality::Input | Causality::Independent => None,
            };
            assert_eq!(scalar.attribute("initial"), expected, "{}", variable.name);
        }
        assert_eq!(interface.with(Causality::Independent).count(), 1);
    });
}

#[test]
fn units_and_types_are_defined_and_used() {
    for_every_unit(|interface, root| {
        let units: BTreeMap<_, _> = elements(child(root, "UnitDefinitions"))
            .into_iter()
            .map(|unit| {
                let display = unit.children().filter(|child| child.has_tag_name("DisplayUnit"));
                (attribute(unit, "name"), display.map(|display| attribute(display, "name")).collect::<Vec<_>>())
            })
            .collect();
        let types: BTreeSet<_> = root
            .descendants()
            .filter(|node| node.has_tag_name("SimpleType"))
            .map(|simple| attribute(simple, "name"))
            .collect();
        let mut unused: BTreeSet<_> = units.keys().copied().chain(types.iter().copied()).collect();
        for scalar in elements(child(root, "ModelVariables")) {
            let value = elements(scalar)[0];
            if let Some(unit) = value.attribute("unit") {
                let display = value.attribute("displayUnit").into_iter().collect::<Vec<_>>();
                assert_eq!(units[unit], display, "{}", attribute(scalar, "name"));
                unused.remove(unit);
            }
            if value.has_tag_name("Enumeration") {
                let declared = attribute(value, "declaredType");
                assert!(types.contains(declared), "{declared}");
                unused.remove(declared);
            }
        }
        assert!(unused.is_empty(), "{unused:?}");
        // The standard keeps names of types and of variables apart.
        assert!(interface.variables.iter().all(|variable| !types.contains(variable.name.as_str())));
    });
}

/// Some hosts keep the types of all units in one name space, each as a class of its own.
#[test]
fn types_have_names_of_our_own_which_mean_the_same_in_both_units() {
    let mut meanings: BTreeMap<String, Vec<(i32, String)>> = BTreeMap::new();
    for structure in Structure::all() {
        for unit in Unit::pair(structure) {
            let text = model_description(&unit.interface).unwrap();
            let document = Document::parse(&text).unwrap();
            for simple in document.descendants().filter(|node| node.has_tag_name("SimpleType")) {
                let name = attribute(simple, "name");
                assert!(name.strip_prefix("Uam").is_some_and(|rest| rest.starts_with(char::is_uppercase)), "{name}");
                let items = simple.descendants().filter(|node| node.has_tag_name("Item"));
                let number = |item: Node<'_, '_>| attribute(item, "value").parse::<i32>().unwrap();
                let items: Vec<_> = items.map(|item| (number(item), attribute(item, "name").to_owned())).collect();
                assert!(!items.is_empty(), "{name}");
                assert_eq!(meanings.entry(name.to_owned()).or_insert_with(|| items.clone()), &items, "{name}");
            }
        }
    }
    assert!(meanings.len() > 8, "{meanings:?}");
}

#[test]
fn no_output_depends_on_an_input_and_initial_unknowns_depend_on_parameters() {
    for_every_unit(|interface, root| {
        let outputs: Vec<usize> = interface.with(Causality::Output).map(|(position, _)| position + 1).collect();
        let structure = child(root, "ModelStructure");
        for list in ["Outputs", "InitialUnknowns"] {
            let unknowns = elements(child(structure, list));
            let listed: Vec<usize> = unknowns.iter().flat_map(|node| indexes(attribute(*node, "index"))).collect();
            assert_eq!(listed, outputs, "{list}");
            for unknown in unknowns {
                let dependencies = indexes(attribute(unknown, "dependencies"));
                let kinds = attribute(unknown, "dependenciesKind");
                assert_eq!(kinds.split_whitespace().count(), dependencies.len());
                assert!(dependencies.is_sorted_by(|one, other| one < other));
                assert!(list == "InitialUnknowns" || dependencies.is_empty());
                for index in dependencies {
                    assert_eq!(interface.variables[index - 1].causality, Causality::Parameter);
                }
            }
        }
    });
}

#[test]
fn flat_names_are_identifiers_and_unique() {
    for structure in Structure::all() {
        let flat = Design { naming: Naming::Flat, ..structure.into() };
        for unit in Unit::pair(flat) {
            let text = model_description(&unit.interface).unwrap();
            let document = Document::parse(&text).unwrap();
            assert_eq!(document.root_element().attribute("variableNamingConvention"), Some("flat"));
            let variables = elements(child(document.root_element(), "ModelVariables"));
            let names: BTreeSet<_> = variables.iter().map(|variable| attribute(*variable, "name")).collect();
            assert_eq!(names.len(), variables.len(), "{structure}");
            for name in names {
                assert!(name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_'), "{name}");
            }
        }
    }
}

#[test]
fn every_structure_of_every_unit_has_its_own_identity() {
    let mut seen = BTreeSet::new();
    for structure in Structure::all() {
        let flat = Design { naming: Naming::Flat, ..structure.into() };
        for unit in [structure.into(), flat].into_iter().flat_map(Unit::pair) {
            assert!(seen.insert(unit.interface.guid.clone()), "{} {structure}", unit.interface.identifier);
        }
    }
}
