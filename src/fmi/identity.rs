//! The identity (GUID) of a unit: a name-based UUID of everything that host and library must agree on.
//!
//! Whoever writes a model description and whoever reads its GUID back compute it from the same table,
//! so a model description can never be used with a library that numbers its variables differently, or
//! begins with other values. A library recognises its own structures by their GUIDs alone. Any other unit
//! says in its [resources](super::start_file) what it is, and is believed if that gives its GUID.

use std::fmt::{self, Write};

use uuid::Uuid;

use super::model::Model;
use super::naming::Naming;
use super::start_file::{Place, StartFileError};
use crate::variables::unit::PhysicalUnit;
use crate::variables::{Bounds, Causality, Kind, Table, Variable};

/// The name space of all identities.
const NAMESPACE: Uuid = Uuid::from_u128(0x9c1f_2d6e_57a4_4b0b_8d3a_60e2_f1c7_85b9);

/// What was chosen when a unit was built.
#[derive(Debug, Clone)]
pub struct Identity<M: Model> {
    /// It decides which variables there are.
    pub structure: M::Structure,
    /// How the variables are called.
    pub naming: Naming,
    /// The values that the variables have before anybody sets one.
    pub start: M::Data,
}

impl<M: Model> Identity<M> {
    /// A structure with structured names and the library's own start values.
    #[must_use]
    pub fn of(structure: M::Structure) -> Self {
        Self { structure, naming: Naming::Structured, start: M::start(structure) }
    }

    /// The same without start values of its own, but for those that no variable names: whatever all saved states of the
    /// unit have in common.
    #[must_use]
    pub fn unset(&self) -> Self {
        let mut unset = Self::of(self.structure);
        let rows = M::rows(&self.start);
        if !rows.is_empty() {
            // They have been taken before.
            let _ = M::take_rows(&mut unset.start, &rows);
        }
        unset
    }

    /// All units that the library knows by itself, the default first.
    fn known() -> impl Iterator<Item = Self> {
        Naming::ALL.into_iter().flat_map(|naming| M::structures().map(move |of| Self { naming, ..Self::of(of) }))
    }

    /// The unit with this GUID; the default one is tried first, and its resources last, where the host says that
    /// they are (`location`) and then beside the library.
    ///
    /// # Errors
    /// If there is none; the library then belongs to another model description.
    pub fn find(guid: &str, location: Option<&str>) -> Result<Self, Box<UnknownGuid>> {
        let wanted = Guid::parse(guid);
        if let Some(known) = Self::known().find(|known| wanted == Some(known.guid())) {
            return Ok(known);
        }
        let places: [fn(Option<&str>) -> Place; 2] = [Place::said, |_| Place::beside_the_library()];
        let mut refused = Vec::new();
        for place in places.map(|place| place(location)) {
            match place.unit(wanted) {
                Ok(unit) => return Ok(unit),
                Err(reason) => refused.push((place.name, reason)),
            }
        }
        let default = Self::known().next();
        Err(Box::new(UnknownGuid {
            identifier: M::IDENTIFIER,
            expected: default.as_ref().map_or(Guid(Uuid::nil()), Self::guid),
            unit: default.map_or_else(String::new, |unit| unit.structure.to_string()),
            found: guid.to_owned(),
            refused,
        }))
    }

    /// The variables by the names they have in this unit.
    #[must_use]
    #[inline(never)]
    pub fn table(&self) -> Table<M::Data> {
        let mut table = M::table(self.structure);
        table.rename(|name| self.naming.of(name));
        table
    }

    /// The GUID.
    #[must_use]
    #[inline(never)]
    pub fn guid(&self) -> Guid {
        let naming = self.naming.name();
        let mut text = format!("{} {} {} {naming}\n", M::IDENTIFIER, M::INTERFACE_VERSION, self.structure);
        for variable in self.table().variables() {
            // Writing to a string cannot fail.
            let _ = describe(&mut text, variable, &self.start);
        }
        for row in M::rows(&self.start) {
            text.push_str(M::ROWS);
            for number in row {
                let _ = write!(text, " {:016x}", number.to_bits());
            }
            text.push('\n');
        }
        Guid(Uuid::new_v5(&NAMESPACE, text.as_bytes()))
    }
}

/// Identity of one unit, written with braces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Guid(Uuid);

impl Guid {
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
fn describe<D>(text: &mut String, variable: &Variable<D>, start: &D) -> fmt::Result {
    let Variable { name, causality, variability, kind, .. } = variable;
    write!(text, "{name} {causality:?} {variability:?} ")?;
    let settable = matches!(causality, Causality::Parameter | Causality::Input);
    match *kind {
        Kind::Real { unit, bounds, at } => {
            describe_unit(text, unit)?;
            describe_bounds(text, &bounds)?;
            if settable {
                write!(text, " {:016x}", at.get(start).to_bits())?;
            }
        }
        Kind::Boolean { at } => {
            write!(text, "Boolean")?;
            if settable {
                write!(text, " {}", at.get(start))?;
            }
        }
        Kind::Enumeration { at } => {
            let choice = at.get(start);
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

fn describe_unit(text: &mut String, unit: &PhysicalUnit) -> fmt::Result {
    write!(text, "Real {} {} {} {} {}", unit.name, unit.kg, unit.m, unit.s, unit.rad)?;
    match &unit.display {
        Some(display) => write!(text, " {} {:016x}", display.name, display.factor.to_bits()),
        None => Ok(()),
    }
}

fn describe_bounds(text: &mut String, bounds: &Bounds) -> fmt::Result {
    let bits =
        |bound: Option<f64>| bound.map_or_else(|| "none".to_owned(), |value| format!("{:016x}", value.to_bits()));
    write!(text, " {} {} none", bits(bounds.min()), bounds.min_excluded())
}

/// A GUID that belongs to no unit of a library.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownGuid {
    /// Model identifier of the library.
    pub identifier: &'static str,
    /// GUID of the default unit.
    pub expected: Guid,
    /// The structure of that in words.
    pub unit: String,
    /// What was given.
    pub found: String,
    /// Where start values were looked for, and why none are taken from there.
    pub refused: Vec<(String, StartFileError)>,
}

impl std::error::Error for UnknownGuid {}

impl fmt::Display for UnknownGuid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { identifier, expected, unit, found, refused } = self;
        write!(
            f,
            "no unit of {identifier} has the GUID \"{found}\" (that of {unit} has {expected}), and no start values have it"
        )?;
        refused.iter().try_for_each(|(place, reason)| write!(f, "; {place}: {reason}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi::v2::toy::{Size, Toy, vr};
    use crate::variables::{Access, unit};

    fn description(change: impl FnOnce(&mut Variable<<Toy as Model>::Data>)) -> String {
        let table = Toy::table(Size::Small);
        let original = &table.variables()[vr::GAIN as usize];
        let mut variable = Variable { name: original.name.clone(), description: String::new(), ..*original };
        change(&mut variable);
        let mut text = String::new();
        describe(&mut text, &variable, &Toy::start(Size::Small)).unwrap();
        text
    }

    fn structure_of(guid: &str) -> Result<Size, Box<UnknownGuid>> {
        Identity::<Toy>::find(guid, None).map(|unit| unit.structure)
    }

    #[test]
    fn structures_are_told_apart_and_found_again() {
        let (small, large) = (Identity::<Toy>::of(Size::Small).guid(), Identity::<Toy>::of(Size::Large).guid());
        assert_ne!(small, large);
        assert_eq!(small, Identity::<Toy>::of(Size::Small).guid());
        assert_eq!(structure_of(&small.to_string()), Ok(Size::Small));
        assert_eq!(structure_of(&large.to_string()), Ok(Size::Large));
    }

    #[test]
    fn braces_are_written_and_not_needed() {
        let text = Identity::<Toy>::of(Size::Small).guid().to_string();
        let bare = text.strip_prefix('{').unwrap().strip_suffix('}').unwrap();
        assert_eq!(structure_of(bare), Ok(Size::Small));
        assert_eq!(structure_of(&bare.to_uppercase()), Ok(Size::Small));
    }

    #[test]
    fn a_wrong_guid_is_answered_with_the_right_one() {
        let expected = Identity::<Toy>::of(Size::Small).guid().to_string();
        for wrong in ["", "{8c4e810f-3df3-4a00-8276-176fa3c9f9e0}", "nonsense"] {
            let message = structure_of(wrong).unwrap_err().to_string();
            assert!(message.contains(&expected) && message.contains(&format!("\"{wrong}\"")), "{message}");
        }
    }

    #[test]
    fn every_part_of_a_declaration_counts() {
        let original = description(|_| {});
        let gain = Access::new(|d: &<Toy as Model>::Data, _| &d.gain, |d, _| &mut d.gain, 0);
        let limit = Access::new(|d: &<Toy as Model>::Data, _| &d.limit, |d, _| &mut d.limit, 0);
        let kind = |unit, bounds, at| Kind::Real { unit, bounds, at };
        let changes: [fn(&mut Variable<_>); 3] = [
            |variable| variable.name = "amplification".to_owned(),
            |variable| variable.causality = Causality::Input,
            |variable| variable.variability = crate::variables::Variability::Tunable,
        ];
        for change in changes {
            assert_ne!(description(change), original);
        }
        let same = kind(&unit::ONE, Bounds::POSITIVE, gain);
        assert_eq!(description(|variable| variable.kind = same), original);
        let elsewhere = kind(&unit::ONE, Bounds::POSITIVE, limit);
        assert_ne!(description(|variable| variable.kind = elsewhere), original, "start value");
        for (unit, bounds) in [(&unit::METRE, Bounds::POSITIVE), (&unit::ONE, Bounds::NON_NEGATIVE)] {
            assert_ne!(description(|variable| variable.kind = kind(unit, bounds, gain)), original);
        }
    }
}
