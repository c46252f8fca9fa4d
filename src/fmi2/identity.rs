//! The identity (GUID) of a unit: a name-based UUID of everything that host and library must agree on.
//!
//! Whoever writes a model description and whoever reads its GUID back compute it from the same table,
//! so a model description can never be used with a library that numbers its variables differently.

use std::fmt::{self, Write};

use uuid::Uuid;

use super::model::Model;
use crate::unit::Unit;
use crate::variables::{Bounds, Causality, Kind, Variable};

/// The name space of all identities.
const NAMESPACE: Uuid = Uuid::from_u128(0x9c1f_2d6e_57a4_4b0b_8d3a_60e2_f1c7_85b9);

/// Identity of one structure of one unit, written with braces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Guid(Uuid);

impl Guid {
    /// The identity of a structure with its start values.
    #[must_use]
    pub fn of<M: Model>(structure: M::Structure) -> Self {
        let mut start = M::start(structure);
        let mut text = format!("{} {} {structure}\n", M::IDENTIFIER, M::INTERFACE_VERSION);
        for variable in M::table(structure).variables() {
            // Writing to a string cannot fail.
            let _ = describe(&mut text, variable, &mut start);
        }
        Self(Uuid::new_v5(&NAMESPACE, text.as_bytes()))
    }

    /// Reads a GUID with or without braces; `None` if the text is none.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        Uuid::try_parse(text.trim()).ok().map(Self)
    }
}

impl fmt::Display for Guid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{{{}}}", self.0)
    }
}

/// Appends all of a variable's declaration that an importer relies on.
fn describe<D>(text: &mut String, variable: &Variable<D>, start: &mut D) -> fmt::Result {
    let Variable { name, causality, variability, kind, index, .. } = variable;
    write!(text, "{name} {causality:?} {variability:?} ")?;
    let settable = matches!(causality, Causality::Parameter | Causality::Input);
    match *kind {
        Kind::Real { unit, bounds, at } => {
            describe_unit(text, unit)?;
            describe_bounds(text, &bounds)?;
            if settable {
                write!(text, " {:016x}", at(start, *index).to_bits())?;
            }
        }
        Kind::Boolean { at } => {
            write!(text, "Boolean")?;
            if settable {
                write!(text, " {}", at(start, *index))?;
            }
        }
        Kind::Enumeration { at } => {
            let choice = at(start, *index);
            write!(text, "{}", choice.type_name())?;
            for item in choice.items() {
                write!(text, " {}", item.name)?;
            }
            if settable {
                write!(text, " {}", choice.number())?;
            }
        }
    }
    writeln!(text)
}

fn describe_unit(text: &mut String, unit: &Unit) -> fmt::Result {
    write!(text, "Real {} {} {} {} {}", unit.name, unit.kg, unit.m, unit.s, unit.rad)?;
    match &unit.display {
        Some(display) => write!(text, " {} {:016x}", display.name, display.factor.to_bits()),
        None => Ok(()),
    }
}

fn describe_bounds(text: &mut String, bounds: &Bounds) -> fmt::Result {
    let bits =
        |bound: Option<f64>| bound.map_or_else(|| "none".to_owned(), |value| format!("{:016x}", value.to_bits()));
    write!(text, " {} {} {}", bits(bounds.min), bounds.min_excluded, bits(bounds.max))
}

/// A GUID that belongs to no structure of a library.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the GUID must be {expected} ({structure}) or that of another structure of {identifier}, but is \"{found}\"")]
pub struct UnknownGuid {
    /// Model identifier of the library.
    pub identifier: &'static str,
    /// GUID of the default structure.
    pub expected: Guid,
    /// The default structure in words.
    pub structure: String,
    /// What was given.
    pub found: String,
}

/// The structure with this GUID; the default one is tried first.
///
/// # Errors
/// If there is none; the library then belongs to another model description.
pub fn structure_with<M: Model>(guid: &str) -> Result<M::Structure, UnknownGuid> {
    let wanted = Guid::parse(guid);
    let found = M::structures().find(|structure| wanted == Some(Guid::of::<M>(*structure)));
    found.ok_or_else(|| {
        let default = M::structures().next();
        UnknownGuid {
            identifier: M::IDENTIFIER,
            expected: default.map_or(Guid(Uuid::nil()), Guid::of::<M>),
            structure: default.map_or_else(String::new, |structure| structure.to_string()),
            found: guid.to_owned(),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi2::toy::{Size, Toy, vr};
    use crate::unit;

    fn description(change: impl FnOnce(&mut Variable<<Toy as Model>::Data>)) -> String {
        let table = Toy::table(Size::Small);
        let original = &table.variables()[vr::GAIN as usize];
        let mut variable = Variable { name: original.name.clone(), description: String::new(), ..*original };
        change(&mut variable);
        let mut text = String::new();
        describe(&mut text, &variable, &mut Toy::start(Size::Small)).unwrap();
        text
    }

    #[test]
    fn structures_are_told_apart_and_found_again() {
        let (small, large) = (Guid::of::<Toy>(Size::Small), Guid::of::<Toy>(Size::Large));
        assert_ne!(small, large);
        assert_eq!(small, Guid::of::<Toy>(Size::Small));
        assert_eq!(structure_with::<Toy>(&small.to_string()), Ok(Size::Small));
        assert_eq!(structure_with::<Toy>(&large.to_string()), Ok(Size::Large));
    }

    #[test]
    fn braces_are_written_and_not_needed() {
        let text = Guid::of::<Toy>(Size::Small).to_string();
        let bare = text.strip_prefix('{').unwrap().strip_suffix('}').unwrap();
        assert_eq!(structure_with::<Toy>(bare), Ok(Size::Small));
        assert_eq!(structure_with::<Toy>(&bare.to_uppercase()), Ok(Size::Small));
    }

    #[test]
    fn a_wrong_guid_is_answered_with_the_right_one() {
        let expected = Guid::of::<Toy>(Size::Small).to_string();
        for wrong in ["", "{8c4e810f-3df3-4a00-8276-176fa3c9f9e0}", "nonsense"] {
            let message = structure_with::<Toy>(wrong).unwrap_err().to_string();
            assert!(message.contains(&expected) && message.contains(&format!("\"{wrong}\"")), "{message}");
        }
    }

    #[test]
    fn every_part_of_a_declaration_counts() {
        let original = description(|_| {});
        let gain = |at| Kind::Real { unit: &unit::ONE, bounds: Bounds::POSITIVE, at };
        let changes: [fn(&mut Variable<_>); 4] = [
            |variable| variable.name = "amplification".to_owned(),
            |variable| variable.causality = Causality::Input,
            |variable| variable.variability = crate::variables::Variability::Tunable,
            |variable| variable.index = 1,
        ];
        for change in &changes[..3] {
            assert_ne!(description(change), original);
        }
        // How a variable is reached inside does not concern the host.
        assert_eq!(description(changes[3]), original);

        assert_eq!(description(|variable| variable.kind = gain(|d, _| &mut d.gain)), original);
        assert_ne!(description(|variable| variable.kind = gain(|d, _| &mut d.limit)), original, "start value");
        for (unit, bounds) in [(&unit::METRE, Bounds::POSITIVE), (&unit::ONE, Bounds::NON_NEGATIVE)] {
            let kind = Kind::Real { unit, bounds, at: |d: &mut <Toy as Model>::Data, _| &mut d.gain };
            assert_ne!(description(|variable| variable.kind = kind), original);
        }
    }
}
