//! Names that no parameter has: what was meant by them?

use super::Problem;
use super::error::near;
use super::reader::{KEYS, PARAMETERS};
use crate::fmi::Model;
use crate::parameters::{Parameters, Structure};
use crate::units::controller::ControllerUnit;
use crate::units::plant::PlantUnit;
use crate::variables::Causality;

/// Keys that may have been meant: for a parameter outside its table, that inside.
pub(super) fn near_keys(key: &str) -> Vec<String> {
    let table = Parameters::table(Structure::DEFAULT);
    if table.find(key).is_some() {
        return vec![format!("{PARAMETERS}.{key}")];
    }
    let mut keys = near(key, KEYS.iter().map(|(key, _)| *key).chain([PARAMETERS]));
    keys.truncate(1);
    keys
}

/// What a name stands for that is a variable of one of the units, but no parameter.
pub(super) fn no_parameter(structure: Structure, name: &str) -> Option<Problem> {
    let known = [causality::<PlantUnit>(structure, name), causality::<ControllerUnit>(structure, name)];
    let known = || known.into_iter().flatten();
    // Commands are outputs of one unit and inputs of the other.
    let (unit, causality) = known().find(|(_, causality)| *causality == Causality::Input).or(known().next())?;
    let (role, advice) = match causality {
        Causality::Input => {
            let acts = acting_with(name).map_or_else(String::new, |choice| format!("; it acts with {choice}"));
            ("an input", format!("hosts set it between steps, or connect an output of another unit to it{acts}"))
        }
        _ => ("an output", "it is computed".to_owned()),
    };
    Some(Problem::NoParameter { name: name.to_owned(), role, unit, advice })
}

/// The part that a variable plays in the unit `M`, unless it is a parameter.
fn causality<M: Model<Structure = Structure>>(structure: Structure, name: &str) -> Option<(&'static str, Causality)> {
    let causality = M::table(structure).find(name)?.causality;
    (causality != Causality::Parameter).then_some((M::IDENTIFIER, causality))
}

/// The choice with which an input acts, if there is one.
fn acting_with(name: &str) -> Option<String> {
    match name.rsplit_once('.')? {
        ("external_reference", _) => Some("reference.kind = \"external\"".to_owned()),
        ("autopilot", "thrust_command" | "torque_command") => Some("autopilot.mode = \"external\"".to_owned()),
        (joint, "torque_command") => Some(format!("\"{joint}.actuation\" = \"torque\"")),
        _ => None,
    }
}
