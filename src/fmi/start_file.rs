//! The file in a unit's resources that says what the unit is, if its start values are not the library's own.
//!
//! ```toml
//! structure = "3 links"
//! naming = "structured"
//! "uav.mass" = 0x400c000000000000 # 3.5
//! "ik.resolution" = "minimum_norm"
//! ```
//!
//! One value a line: of TOML this is all that is needed, and all that is understood. Numbers are given by their
//! bits, also those of rows, `"path[1]" = [0x0000000000000000, 0x3ff0000000000000]`: reading decimal digits exactly would
//! take 15 kB of code. The file may come from anywhere; what it says counts only if it gives the GUID of the unit.

use std::fmt::Write;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::identity::{Guid, Identity};
use super::location;
use super::model::Model;
use super::naming::Naming;
use crate::variables::options::Choice;
use crate::variables::{Causality, Kind, Variable};

/// Name of the file.
pub const NAME: &str = "start.toml";

/// Most bytes of it; with all its parameters, a unit needs some thousands, and with the longest path some millions.
const LARGEST: u64 = 1 << 24;

const STRUCTURE: &str = "structure";
const NAMING: &str = "naming";

/// Why the resources do not say what a unit is.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum StartFileError {
    /// There is no folder.
    #[error("there is no folder")]
    NoFolder,
    /// The file is not there, or is no text of a sane length.
    #[error("{NAME} cannot be read: {reason}")]
    Unreadable {
        /// What is wrong.
        reason: String,
    },
    /// The file of another unit.
    #[error("the GUID must be {guid} for the start values in the resources")]
    OtherUnit {
        /// Its GUID.
        guid: Guid,
    },
    /// A line that says nothing.
    #[error("{NAME}, line {line}: {key} must be {expected}, but is {found}")]
    Line {
        /// Number of the line, from 1.
        line: usize,
        /// What is on the left.
        key: String,
        /// What would be right.
        expected: String,
        /// What is there.
        found: String,
    },
    /// Rows that do not go together.
    #[error("{NAME}, {rows}: {reason}")]
    Rows {
        /// What they are called.
        rows: &'static str,
        /// What is wrong.
        reason: String,
    },
    /// No line says which variables there are.
    #[error("{NAME} must have {STRUCTURE} first")]
    NoStructure,
}

/// The text of the file for a unit; `None` for one that the library knows without it.
#[must_use]
pub fn write<M: Model>(unit: &Identity<M>) -> Option<String> {
    let known = M::start(unit.structure);
    let mut changes = String::new();
    for variable in unit.table().variables().iter().filter(|variable| is_set_from_outside(variable)) {
        let value = spelled(variable, &unit.start);
        if value != spelled(variable, &known) {
            // Writing to a string cannot fail.
            let _ = writeln!(changes, "\"{}\" = {value}", variable.name);
        }
    }
    for (number, row) in (1..).zip(M::rows(&unit.start)) {
        let bits: Vec<String> = row.iter().map(|number| format!("{:#018x}", number.to_bits())).collect();
        let _ = writeln!(changes, "\"{}[{number}]\" = [{}]", M::ROWS, bits.join(", "));
    }
    let head = format!("{STRUCTURE} = \"{}\"\n{NAMING} = \"{}\"\n", unit.structure, unit.naming.name());
    (!changes.is_empty()).then(|| format!("# The start values that differ from those of the library.\n{head}{changes}"))
}

/// A place where the resources may be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// What it is, for messages.
    pub name: String,
    folders: Vec<PathBuf>,
}

impl Place {
    /// Where the host says that they are.
    #[must_use]
    pub fn said(location: Option<&str>) -> Self {
        let location = location.unwrap_or_default();
        Self { name: format!("fmuResourceLocation \"{location}\""), folders: location::folders(location) }
    }

    /// Beside the library, as the loader knows it.
    #[must_use]
    pub fn beside_the_library() -> Self {
        Self::beside(location::library().as_deref())
    }

    fn beside(library: Option<&Path>) -> Self {
        let name = library.map_or("unknown".to_owned(), |library| format!("\"{}\"", library.display()));
        let folders = library.map_or_else(Vec::new, location::beside);
        Self { name: format!("beside the library {name}"), folders }
    }

    /// The unit with this GUID that the resources here describe.
    ///
    /// # Errors
    /// If there are none, or they do not.
    pub fn unit<M: Model>(&self, wanted: Option<Guid>) -> Result<Identity<M>, StartFileError> {
        let mut refused: Option<StartFileError> = None;
        for file in self.folders.iter().flat_map(|folder| location::candidates(folder, NAME)) {
            let reason = match load(&file).and_then(|text| read::<M>(&text)) {
                Ok(unit) if wanted == Some(unit.guid()) => return Ok(unit),
                Ok(unit) => StartFileError::OtherUnit { guid: unit.guid() },
                Err(reason) => reason,
            };
            // What a file says is more to the point than that another is not there.
            let says_nothing = |reason: &StartFileError| matches!(reason, StartFileError::Unreadable { .. });
            if refused.as_ref().is_none_or(|first| says_nothing(first) && !says_nothing(&reason)) {
                refused = Some(reason);
            }
        }
        Err(refused.unwrap_or(StartFileError::NoFolder))
    }
}

fn load(path: &Path) -> Result<String, StartFileError> {
    let unreadable = |reason: String| StartFileError::Unreadable { reason };
    let failed = |error: io::Error| unreadable(error.to_string());
    // Opening what is no file, a pipe for instance, could wait for ever.
    if !fs::metadata(path).map_err(failed)?.is_file() {
        return Err(unreadable("it is no file".to_owned()));
    }
    let mut text = String::new();
    File::open(path).map_err(failed)?.take(LARGEST + 1).read_to_string(&mut text).map_err(failed)?;
    if text.len() as u64 > LARGEST { Err(unreadable(format!("it has more than {LARGEST} bytes"))) } else { Ok(text) }
}

/// The unit that a text describes.
fn read<M: Model>(text: &str) -> Result<Identity<M>, StartFileError> {
    let lines = (1..).zip(text.lines().map(str::trim)).filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let mut unit = None;
    let mut table = None;
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for (number, line) in lines {
        let wrong = |key: &str, expected: String, found: &str| StartFileError::Line {
            line: number,
            key: key.to_owned(),
            expected,
            found: found.to_owned(),
        };
        let Some((key, value)) = line.split_once('=').map(|(key, value)| (unquoted(key.trim()), value.trim())) else {
            return Err(wrong("it", "name = value".to_owned(), line));
        };
        match (key, &mut unit) {
            (STRUCTURE, _) => {
                let known = M::structures().find(|structure| structure.to_string() == unquoted(value));
                let known = known.ok_or_else(|| wrong(key, format!("one of {}", M::IDENTIFIER), value))?;
                unit = Some(Identity::<M>::of(known));
            }
            (NAMING, Some(unit)) => {
                let known = Naming::ALL.into_iter().find(|naming| naming.name() == unquoted(value));
                unit.naming = known.ok_or_else(|| wrong(key, Naming::ALL.map(Naming::name).join(" or "), value))?;
            }
            (name, Some(_)) if is_row::<M>(name) => {
                let next = format!("{}[{}]", M::ROWS, rows.len() + 1);
                if name != next {
                    return Err(wrong("the next row", next, name));
                }
                rows.push(row(value).ok_or_else(|| wrong(key, "[bits of numbers, ...]".to_owned(), value))?);
            }
            (name, Some(unit)) => {
                let table = table.get_or_insert_with(|| unit.table());
                let variable = table.find(name).filter(|variable| is_set_from_outside(variable));
                let expected = || "that of a parameter or input".to_owned();
                let variable = variable.ok_or_else(|| wrong("the name", expected(), name))?;
                assign(variable, &mut unit.start, value).map_err(|expected| wrong(key, expected, value))?;
            }
            (_, None) => return Err(StartFileError::NoStructure),
        }
    }
    let mut unit = unit.ok_or(StartFileError::NoStructure)?;
    let taken = if rows.is_empty() { Ok(()) } else { M::take_rows(&mut unit.start, &rows) };
    taken.map_err(|reason| StartFileError::Rows { rows: M::ROWS, reason })?;
    Ok(unit)
}

fn is_row<M: Model>(name: &str) -> bool {
    !M::ROWS.is_empty() && name.strip_prefix(M::ROWS).is_some_and(|index| index.starts_with('['))
}

/// The numbers of a row, by their bits.
fn row(value: &str) -> Option<Vec<f64>> {
    value.strip_prefix('[')?.strip_suffix(']')?.split(',').map(|number| from_bits(number.trim())).collect()
}

fn from_bits(text: &str) -> Option<f64> {
    text.strip_prefix("0x").and_then(|bits| u64::from_str_radix(bits, 16).ok()).map(f64::from_bits)
}

fn is_set_from_outside<D>(variable: &Variable<D>) -> bool {
    matches!(variable.causality, Causality::Parameter | Causality::Input)
}

/// The value of a variable, so that it is read back bit by bit.
fn spelled<D>(variable: &Variable<D>, data: &D) -> String {
    match variable.kind {
        Kind::Real { at, .. } => {
            let number = *at.get(data);
            format!("{:#018x} # {number:?}", number.to_bits())
        }
        Kind::Boolean { at } => at.get(data).to_string(),
        Kind::Enumeration { at } => format!("\"{}\"", at.get(data).name()),
    }
}

/// Gives a variable the value that is spelled so; otherwise says what it must be.
fn assign<D>(variable: &Variable<D>, data: &mut D, value: &str) -> Result<(), String> {
    match variable.kind {
        Kind::Real { bounds, at, .. } => {
            let number = value.split_whitespace().next().and_then(from_bits);
            let number = number.filter(|number| bounds.admit(*number));
            *at.get_mut(data) = number.ok_or_else(|| format!("the bits of {bounds}"))?;
        }
        Kind::Boolean { at } => {
            *at.get_mut(data) = value.parse().map_err(|_| "true or false".to_owned())?;
        }
        Kind::Enumeration { at } => {
            let choice: &mut dyn Choice = at.get_mut(data);
            let items = choice.items();
            let number = (1..).zip(items).find(|(_, item)| item.name == unquoted(value)).map(|(number, _)| number);
            let names = || items.iter().map(|item| item.name).collect::<Vec<_>>().join(" or ");
            choice.choose(number.ok_or_else(names)?);
        }
    }
    Ok(())
}

fn unquoted(text: &str) -> &str {
    text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fmi::v2::toy::{Data, Direction, Size, Toy};

    fn unit(change: impl FnOnce(&mut Data)) -> Identity<Toy> {
        let mut unit = Identity::of(Size::Large);
        change(&mut unit.start);
        unit
    }

    fn file(text: &str) -> (tempfile::TempDir, String) {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(NAME), text).unwrap();
        let location = format!("file://{}", folder.path().display());
        (folder, location)
    }

    #[test]
    fn a_unit_with_own_start_values_is_found_by_its_guid_and_its_file() {
        for naming in Naming::ALL {
            let own = Identity {
                naming,
                ..unit(|data| (data.gain, data.direction, data.hold) = (0.1, Direction::Down, true))
            };
            let (_folder, location) = file(&write(&own).unwrap());
            let guid = own.guid().to_string();
            let found = Identity::<Toy>::find(&guid, Some(&location)).unwrap();
            assert_eq!((found.structure, found.naming, &found.start), (Size::Large, naming, &own.start));

            // Without the file, or with that of another unit, it is not.
            let message = |location| Identity::<Toy>::find(&guid, location).unwrap_err().to_string();
            assert!(message(None).contains("fmuResourceLocation \"\": there is no folder"), "{}", message(None));
            let nowhere = message(Some("file:///none/there"));
            assert!(
                nowhere.contains("fmuResourceLocation \"file:///none/there\": start.toml cannot be read"),
                "{nowhere}"
            );
            assert!(nowhere.contains("beside the library \""), "{nowhere}");
            let other = unit(|data| data.gain = 0.2);
            let (_folder, location) = file(&write(&other).unwrap());
            let message = message(Some(&location));
            assert!(message.contains(&other.guid().to_string()) && message.contains(&guid), "{message}");
        }
    }

    /// Hosts leave the location out, or give that of another unit; but they have loaded the library from its place.
    #[test]
    fn a_unit_is_found_beside_its_library_too() {
        let own = unit(|data| data.gain = 0.1);
        let wanted = Some(own.guid());
        let folder = tempfile::tempdir().unwrap();
        let library = folder.path().join("binaries/linux64/toy.so");
        let beside = Place::beside(Some(&library));
        assert!(matches!(beside.unit::<Toy>(wanted), Err(StartFileError::Unreadable { .. })));

        let resources = folder.path().join("resources");
        fs::create_dir(&resources).unwrap();
        fs::write(resources.join(NAME), write(&own).unwrap()).unwrap();
        assert_eq!(beside.unit::<Toy>(wanted).unwrap().start, own.start);
        assert!(beside.name.contains("toy.so"), "{}", beside.name);

        let other = unit(|data| data.gain = 0.2).guid();
        let refused = beside.unit::<Toy>(Some(other)).unwrap_err();
        assert_eq!(refused, StartFileError::OtherUnit { guid: own.guid() });
        assert_eq!(Place::beside(None).unit::<Toy>(wanted).unwrap_err(), StartFileError::NoFolder);
    }

    #[test]
    fn what_the_library_knows_needs_no_file() {
        for structure in Toy::structures() {
            for naming in Naming::ALL {
                let unit = Identity::<Toy> { naming, ..Identity::of(structure) };
                assert_eq!(write(&unit), None);
                let found = Identity::<Toy>::find(&unit.guid().to_string(), None).unwrap();
                assert_eq!((found.structure, found.naming), (structure, naming));
            }
        }
    }

    #[test]
    fn what_is_wrong_with_a_file_is_said_with_its_line() {
        for (text, expected) in [
            ("", "must have structure first"),
            ("gain = 1", "must have structure first"),
            ("structure = \"huge toy\"", "line 1: structure must be one of toy, but is \"huge toy\""),
            (
                "structure = \"small toy\"\nnaming = \"odd\"",
                "line 2: naming must be structured or flat, but is \"odd\"",
            ),
            ("structure = \"small toy\"\n\n# ...\ngain", "line 4: it must be name = value, but is gain"),
            ("structure = \"small toy\"\nextra = 1", "line 2: the name must be that of a parameter or input"),
            ("structure = \"small toy\"\nposition = 1", "line 2: the name must be that of a parameter or input"),
            (
                "structure = \"small toy\"\ngain = 0xbff0000000000000 # -1.0",
                "line 2: gain must be the bits of a finite number, above 0",
            ),
            ("structure = \"small toy\"\ngain = 1.0", "a finite number, above 0, but is 1.0"),
            ("structure = \"small toy\"\nhold = 1", "hold must be true or false, but is 1"),
            ("structure = \"small toy\"\ndirection = \"left\"", "direction must be up or down, but is \"left\""),
        ] {
            let message = read::<Toy>(text).unwrap_err().to_string();
            assert!(message.contains(expected), "{text:?}: {message}");
        }
    }

    #[test]
    fn only_a_file_of_sane_length_is_read() {
        let (folder, location) = file(&"#".repeat((1 << 24) + 1));
        let message = || Place::said(Some(&location)).unit::<Toy>(None).unwrap_err().to_string();
        assert!(message().contains("more than 16777216 bytes"), "{}", message());
        fs::write(folder.path().join(NAME), [0xff, 0xfe]).unwrap();
        assert!(message().contains("UTF-8"), "{}", message());
        fs::remove_file(folder.path().join(NAME)).unwrap();
        fs::create_dir(folder.path().join(NAME)).unwrap();
        assert!(message().contains("no file"), "{}", message());
    }

    proptest! {
        #[test]
        fn no_text_does_harm(text in "(structure|naming|gain|hold|\"|=|large toy|small toy|flat|[0-9.e-]|\\PC|\n){0,60}") {
            let _ = read::<Toy>(&text);
        }

        #[test]
        fn numbers_come_back_bit_by_bit(gain in prop::num::f64::POSITIVE, rate in prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL) {
            let own = unit(|data| (data.gain, data.rate) = (gain, rate));
            let text = write(&own).unwrap();
            let back = read::<Toy>(&text).unwrap();
            prop_assert_eq!(back.start.gain.to_bits(), gain.to_bits());
            prop_assert_eq!(back.start.rate.to_bits(), rate.to_bits());
        }
    }
}
