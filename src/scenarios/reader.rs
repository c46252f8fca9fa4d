//! Reads scenario files: every key is known and of the right type, or refused with its line.

use std::sync::Arc;

use toml::de::{DeTable, DeValue};

use super::error::near;
use super::path::{self, Files, PATH, SPEED, WAYPOINTS};
use super::quantity;
use super::syntax::{self, printable};
use super::unknown::{near_keys, no_parameter};
use super::{Error, Problem, Scenario, THESIS_STEP, default_parameters};
use crate::control;
use crate::parameters::{Balance, Parameters, Structure};
use crate::reference::ReferenceKind;
use crate::variables::unit::{self, PhysicalUnit};
use crate::variables::{Kind, Table, Variable};

/// Keys beside the parameters, with what each must be.
const ID: (&str, &str) = ("id", "a short name of letters, digits, `.`, `-` and `_`, in quotes");
const TITLE: (&str, &str) = ("title", "one line on what happens, in quotes, without control characters");
const BASED_ON: (&str, &str) = ("based_on", "the name of another scenario, in quotes");
pub(super) const DURATION: (&str, &str) = ("duration", "a number of seconds above 0");
pub(super) const STEP: (&str, &str) = ("step", "a number of seconds above 0, at most the duration");
const LINKS: (&str, &str) = ("structure.links", "a whole number from 1 to 6");
const BALANCE: (&str, &str) = ("structure.balance", "\"none\", \"counterweight\" or \"balance_element\"");
pub(super) const KEYS: [(&str, &str); 10] =
    [ID, TITLE, BASED_ON, DURATION, STEP, LINKS, BALANCE, PATH, WAYPOINTS, SPEED];
/// The table of all parameters.
pub(super) const PARAMETERS: &str = "parameters";

/// A value with its whole name and its line.
pub(super) struct Entry<'a> {
    pub(super) key: String,
    pub(super) line: usize,
    pub(super) value: &'a DeValue<'a>,
}

/// All entries of a file, in its order.
struct Document<'a> {
    entries: Vec<Entry<'a>>,
    files: Files<'a>,
}

/// For texts of our own, which name none.
pub(super) fn no_files(name: &str) -> Result<String, String> {
    Err(format!("there is no file {name}"))
}

/// Reads a scenario that may be based on one of those that are known.
pub(super) fn read(text: &str, known: &[Scenario], files: Files<'_>) -> Result<Scenario, Error> {
    let line_of = |position: usize| text.bytes().take(position).filter(|&byte| byte == b'\n').count() + 1;
    let (table, mistakes) = DeTable::parse_recoverable(text);
    let mut entries = Vec::new();
    flatten("", table.get_ref(), &line_of, &mut entries);
    entries.sort_by_key(|entry| entry.line);
    if let Some(mistake) = mistakes.first() {
        let span = mistake.span().unwrap_or(text.len()..text.len());
        let line = line_of(span.start);
        let whole = text.lines().nth(line - 1).unwrap_or_default();
        let problem = syntax::problem(mistake.message(), text.get(span).unwrap_or_default(), whole, line, &entries);
        return Err(Error::Line { line, problem });
    }
    let document = Document { entries, files };
    document.check_keys()?;
    document.scenario(known)
}

/// Collects the values of nested tables under their whole names: `parameters.autopilot.roll.kd`.
fn flatten<'a>(before: &str, table: &'a DeTable<'a>, line_of: &impl Fn(usize) -> usize, entries: &mut Vec<Entry<'a>>) {
    for (key, value) in table {
        let name = if before.is_empty() { key.get_ref().to_string() } else { format!("{before}.{}", key.get_ref()) };
        match value.get_ref() {
            DeValue::Table(table) if !table.is_empty() => flatten(&name, table, line_of, entries),
            value => entries.push(Entry { key: name, line: line_of(key.span().start), value }),
        }
    }
}

impl Document<'_> {
    /// Refuses repeated keys, and those that mean nothing whatever the structure.
    fn check_keys(&self) -> Result<(), Error> {
        for (i, entry) in self.entries.iter().enumerate() {
            if let Some(first) = self.entries[..i].iter().find(|other| other.key == entry.key) {
                return Err(entry.refused(Problem::Repeated { key: entry.key.clone(), first: first.line }));
            }
            let empty_table =
                matches!(entry.value, DeValue::Table(_)) && ["structure", PARAMETERS].contains(&&*entry.key);
            let known = KEYS.iter().any(|(key, _)| *key == entry.key);
            if !(known || empty_table || entry.parameter().is_some()) {
                let unknown = || Problem::UnknownKey { key: printable(&entry.key), near: near_keys(&entry.key) };
                return Err(entry.refused(no_parameter(Structure::DEFAULT, &entry.key).unwrap_or_else(unknown)));
            }
        }
        Ok(())
    }

    fn field(&self, (key, expected): (&'static str, &'static str)) -> Option<Field<'_>> {
        self.entries.iter().find(|entry| entry.key == key).map(|entry| Field { entry, expected })
    }

    fn scenario(&self, known: &[Scenario]) -> Result<Scenario, Error> {
        let missing = |(key, expected): (&'static str, &'static str)| Error::Missing { key, expected };
        let base = match self.field(BASED_ON) {
            None => None,
            Some(field) => {
                let id = field.text()?;
                let base = known.iter().find(|scenario| scenario.id == id);
                Some(base.ok_or_else(|| {
                    let ids = || known.iter().map(|scenario| scenario.id.as_str());
                    let near = Some(near(id, ids())).filter(|near| !near.is_empty());
                    let near = near.unwrap_or_else(|| ids().map(str::to_owned).collect());
                    field.entry.refused(Problem::NoScenario { id: printable(id), near })
                })?)
            }
        };

        let id = self.field(ID).ok_or_else(|| missing(ID))?;
        let id = id.if_ok(id.text()?.to_owned(), |text: &String| is_name(text))?;
        let title = self.field(TITLE).map(|field| field.if_ok(field.text()?, |text| is_line(text))).transpose()?;
        let title = title.or(base.map(|base| base.title.as_str())).ok_or_else(|| missing(TITLE))?.to_owned();
        let seconds = |key, inherited: Option<f64>| match self.field(key) {
            Some(field) => field.if_ok(field.quantity(&unit::SECOND)?, |&value| value.is_finite() && value > 0.0),
            None => inherited.ok_or_else(|| missing(key)),
        };
        let duration = seconds(DURATION, base.map(|base| base.duration))?;
        let step = seconds(STEP, Some(base.map_or(THESIS_STEP, |base| base.step)))?;
        if step > duration {
            let field = self.field(STEP).or(self.field(DURATION)).ok_or_else(|| missing(DURATION))?;
            return Err(field.wrong());
        }
        let structure = self.structure(base)?;

        let mut parameters = default_parameters(structure);
        if let Some(base) = base.filter(|base| base.structure == structure) {
            parameters.clone_from(&base.parameters);
        }
        let entry = |key| self.field(key).map(|field| field.entry);
        if let Some(table) = path::read(entry(PATH), [entry(WAYPOINTS), entry(SPEED)], self.files)? {
            parameters.reference.table = Some(Arc::new(table));
            parameters.reference.kind = ReferenceKind::Table;
        }
        self.set_parameters(structure, &mut parameters)?;
        Ok(Scenario { id, title, structure, parameters, duration, step })
    }

    fn structure(&self, base: Option<&Scenario>) -> Result<Structure, Error> {
        let inherited = base.map(|base| base.structure);
        let links = match self.field(LINKS) {
            None => inherited.ok_or(Error::Missing { key: LINKS.0, expected: LINKS.1 })?.links,
            Some(field) => field.if_ok(field.count()?, |&links| Structure::new(links, Balance::None).is_ok())?,
        };
        let balance = match self.field(BALANCE) {
            None => inherited.map_or(Balance::None, |structure| structure.balance),
            Some(field) => {
                let name = field.text()?;
                Balance::ALL.into_iter().find(|balance| balance.name() == name).ok_or_else(|| field.wrong())?
            }
        };
        let structure = Structure { links, balance };
        // The numbers of one vehicle mean nothing for another one.
        match (inherited, self.field(LINKS).or(self.field(BALANCE))) {
            (Some(inherited), Some(field)) if inherited != structure => Err(field.entry.refused(Problem::Value {
                key: field.entry.key.clone(),
                expected: format!("that of the scenario this one is based on ({inherited})"),
                found: structure.to_string(),
            })),
            _ => Ok(structure),
        }
    }

    fn set_parameters(&self, structure: Structure, parameters: &mut Parameters) -> Result<(), Error> {
        let table = Parameters::table(structure);
        // Those that stand for every member of a family first: a line of its own counts more.
        let (every, single): (Vec<_>, Vec<_>) = self.entries.iter().partition(|entry| entry.key.contains(EVERY));
        for entry in every.into_iter().chain(single) {
            let Some(name) = entry.parameter() else { continue };
            let mut variables = members(&table, name).peekable();
            if variables.peek().is_none() {
                return Err(entry.refused(unknown_parameter(structure, &table, name)));
            }
            variables.try_for_each(|variable| entry.put(variable, parameters))?;
        }
        control::check(structure, parameters).map_err(|error| {
            let name = error.parameter().unwrap_or_default();
            match self.entries.iter().find(|entry| entry.parameter() == Some(name)) {
                Some(entry) => entry.refused(Problem::Parameter(error)),
                None => Error::Parameters(error),
            }
        })
    }
}

/// In the name of a parameter: that of every link, joint or leg.
const EVERY: &str = "[*]";

/// The variables that a name stands for.
fn members<'a>(table: &'a Table<Parameters>, name: &'a str) -> impl Iterator<Item = &'a Variable<Parameters>> {
    let is_meant = move |variable: &&Variable<Parameters>| match name.split_once(EVERY) {
        None => variable.name == name,
        Some((family, rest)) => {
            let member = variable.name.strip_prefix(family).and_then(|member| member.strip_suffix(rest));
            let number = member.and_then(|member| member.strip_prefix('[')).and_then(|member| member.strip_suffix(']'));
            number.is_some_and(|number| number.bytes().all(|digit| digit.is_ascii_digit()))
        }
    };
    table.variables().iter().filter(is_meant)
}

fn unknown_parameter(structure: Structure, table: &Table<Parameters>, name: &str) -> Problem {
    let first = name.replace(EVERY, "[1]");
    no_parameter(structure, &first).unwrap_or_else(|| {
        let near = near(&first, table.variables().iter().map(|variable| variable.name.as_str()));
        Problem::UnknownParameter { name: printable(name), structure: structure.to_string(), near }
    })
}

/// Whether this is one line, which every document can hold.
fn is_line(text: &str) -> bool {
    !text.contains(|c: char| c.is_control() || ('\u{FFFE}'..='\u{FFFF}').contains(&c))
}

/// Whether this can be part of the name of a file.
fn is_name(text: &str) -> bool {
    let allowed = |c: char| c.is_ascii_alphanumeric() || ".-_".contains(c);
    text.chars().all(allowed) && text.starts_with(|c: char| c.is_ascii_alphanumeric())
}

/// An entry with what its value must be.
struct Field<'a> {
    entry: &'a Entry<'a>,
    expected: &'static str,
}

impl<'a> Field<'a> {
    fn text(&self) -> Result<&'a str, Error> {
        self.entry.text().ok_or_else(|| self.wrong())
    }

    fn quantity(&self, unit: &PhysicalUnit) -> Result<f64, Error> {
        self.entry.quantity(unit).ok_or_else(|| self.wrong())
    }

    fn count(&self) -> Result<usize, Error> {
        match self.entry.value {
            DeValue::Integer(value) => usize::from_str_radix(value.as_str(), value.radix()).map_err(|_| self.wrong()),
            _ => Err(self.wrong()),
        }
    }

    fn if_ok<T>(&self, value: T, ok: impl Fn(&T) -> bool) -> Result<T, Error> {
        if ok(&value) { Ok(value) } else { Err(self.wrong()) }
    }

    fn wrong(&self) -> Error {
        self.entry.wrong(self.expected)
    }
}

impl Entry<'_> {
    /// The name of the parameter, if it is one.
    fn parameter(&self) -> Option<&str> {
        self.key.strip_prefix(PARAMETERS)?.strip_prefix('.')
    }

    fn text(&self) -> Option<&str> {
        if let DeValue::String(text) = self.value { Some(text) } else { None }
    }

    /// The number in SI units: alone, or with a unit as a text.
    fn quantity(&self, unit: &PhysicalUnit) -> Option<f64> {
        number(self.value, unit)
    }

    /// Writes the value to where the variable is.
    fn put(&self, variable: &Variable<Parameters>, parameters: &mut Parameters) -> Result<(), Error> {
        match variable.kind {
            Kind::Real { bounds, at, unit } => {
                let number = self.quantity(unit).filter(|&number| bounds.admit(number));
                let with_unit = || match (self.value, &unit.display) {
                    (DeValue::String(_), Some(display)) => format!(", or with its unit as in \"2.5 {}\"", display.name),
                    (DeValue::String(_), None) => format!(", or with its unit as in \"2.5 {}\"", unit.name),
                    _ => String::new(),
                };
                let expected = || format!("{bounds} [{}]{}", unit.name, with_unit());
                *at.get_mut(parameters) = number.ok_or_else(|| self.wrong(&expected()))?;
            }
            Kind::Boolean { at } => match self.value {
                DeValue::Boolean(value) => *at.get_mut(parameters) = *value,
                _ => return Err(self.wrong("true or false")),
            },
            Kind::Enumeration { at } => {
                let choice = at.get_mut(parameters);
                let position = self.text().and_then(|text| choice.items().iter().position(|item| item.name == text));
                let number = position.and_then(|position| i32::try_from(position + 1).ok());
                if !number.is_some_and(|number| choice.choose(number)) {
                    let names: Vec<String> = choice.items().iter().map(|item| format!("\"{}\"", item.name)).collect();
                    return Err(self.wrong(&format!("one of {}", names.join(", "))));
                }
            }
        }
        Ok(())
    }

    pub(super) fn refused(&self, problem: Problem) -> Error {
        Error::Line { line: self.line, problem }
    }

    pub(super) fn wrong(&self, expected: &str) -> Error {
        self.with_found(expected, found(self.value))
    }

    /// The same where a part of the value is wrong.
    pub(super) fn with_found(&self, expected: &str, found: String) -> Error {
        let key = self.parameter().unwrap_or(&self.key).to_owned();
        self.refused(Problem::Value { key, expected: expected.to_owned(), found })
    }
}

/// A number in SI units: alone, or with a unit as a text.
pub(super) fn number(value: &DeValue<'_>, unit: &PhysicalUnit) -> Option<f64> {
    match value {
        DeValue::String(text) => quantity::read(text, unit),
        DeValue::Float(value) => value.as_str().parse().ok(),
        DeValue::Integer(value) if value.radix() == 10 => value.as_str().parse().ok(),
        _ => None,
    }
}

/// A value as it stands in the file, or what kind of value it is.
pub(super) fn found(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("{text:?}"),
        DeValue::Integer(number) => number.to_string(),
        DeValue::Float(number) => number.to_string(),
        DeValue::Boolean(value) => value.to_string(),
        DeValue::Datetime(time) => time.to_string(),
        DeValue::Array(_) => "a list".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    }
}
