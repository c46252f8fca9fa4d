//! What belongs to the numbers of a run so that others can read, draw and repeat it years later.

use serde::{Deserialize, Serialize};
use uam::fmi::Model;
use uam::scenarios::Extent;
use uam::units::{controller::ControllerUnit, plant::PlantUnit};
use uam::variables::{Kind, Variable};
use uam::{Parameters, Structure};

use crate::host::coupling::Schedule;
use crate::host::record::TIME;
use crate::host::run::Run;
use crate::package::metadata::GENERATION_TOOL;
use crate::study::verdict::Verdict;

/// All that a file beside the csv of a run says. Quantities are in the SI units that stand with them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Particulars {
    /// Name and version of the program that made the run.
    pub program: String,
    /// The day on which it did, in UTC: year, month, day.
    pub date: String,
    /// Name of the file with the numbers, beside this one.
    pub csv: String,
    /// Short name of the scenario.
    pub id: String,
    /// What happens in it.
    pub title: String,
    /// The vehicle in words.
    pub structure: String,
    /// Start time, stop time and communication step \[s\].
    pub schedule: [f64; 3],
    /// Whether the path was followed.
    pub followed: bool,
    /// What became of the run, in sentences: the verdict, and what looks wrong.
    pub verdict: Vec<String>,
    /// The columns of the csv in their order.
    pub columns: Vec<Column>,
    /// Every parameter of both units.
    pub parameters: Vec<Parameter>,
    /// The scenario as a file that `simulate` takes, with all numbers.
    pub scenario: String,
}

/// A column of the csv.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// Its name: that of a variable of one of the units, or `time`.
    pub name: String,
    /// Its unit; empty for truth values and for the numbers of alternatives.
    pub unit: String,
    /// What it is.
    pub description: String,
}

/// A parameter with its value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// Its name in both units.
    pub name: String,
    /// Its value.
    pub value: Value,
    /// Its unit; empty for truth values and alternatives.
    pub unit: String,
    /// What it is.
    pub description: String,
}

/// The value of a parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// A truth value.
    Boolean(bool),
    /// A number in SI units.
    Real(f64),
    /// The name of an alternative.
    Choice(String),
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Boolean(value) => value.fmt(f),
            Self::Real(value) => value.fmt(f),
            Self::Choice(name) => name.fmt(f),
        }
    }
}

impl Particulars {
    /// Those of a run whose numbers stand in a file named `csv`.
    #[must_use]
    pub fn of(run: &Run, verdict: &Verdict, schedule: &Schedule, csv: &str) -> Self {
        let scenario = &run.scenario;
        Self {
            program: GENERATION_TOOL.to_owned(),
            date: today(),
            csv: csv.to_owned(),
            id: scenario.id.clone(),
            title: scenario.title.clone(),
            structure: scenario.structure.to_string(),
            schedule: [schedule.start(), schedule.stop(), schedule.step()],
            followed: verdict.followed,
            verdict: verdict.sentences(),
            columns: run.recording.names().map(|name| column(scenario.structure, name)).collect(),
            parameters: parameters(scenario.structure, &scenario.parameters),
            scenario: scenario.write(Extent::Everything),
        }
    }

    /// As JSON, to be read by people, too.
    ///
    /// # Errors
    /// If a number cannot be written: JSON has none that are not finite.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }
}

/// The present day in UTC: year, month, day.
#[must_use]
pub fn today() -> String {
    jiff::Timestamp::now().strftime("%Y-%m-%d").to_string()
}

fn parameters(structure: Structure, parameters: &Parameters) -> Vec<Parameter> {
    let parameter = |variable: &Variable<Parameters>| {
        let value = match variable.kind {
            Kind::Real { at, .. } => Value::Real(*at.get(parameters)),
            Kind::Boolean { at } => Value::Boolean(*at.get(parameters)),
            Kind::Enumeration { at } => Value::Choice(at.get(parameters).name().to_owned()),
        };
        Parameter {
            name: variable.name.clone(),
            value,
            unit: unit(variable),
            description: variable.description.clone(),
        }
    };
    Parameters::table(structure).variables().iter().map(parameter).collect()
}

/// The unit of a variable; empty if it is no number.
fn unit<D>(variable: &Variable<D>) -> String {
    match variable.kind {
        Kind::Real { unit, .. } => unit.name.to_owned(),
        Kind::Boolean { .. } | Kind::Enumeration { .. } => String::new(),
    }
}

/// What is in a column: of a variable that both units have, for instance `joint[1].rate_command`, an output is recorded.
fn column(structure: Structure, name: &str) -> Column {
    if name == TIME {
        return Column { name: TIME.to_owned(), unit: "s".to_owned(), description: "Communication point".to_owned() };
    }
    let found = output::<PlantUnit>(structure, name).or_else(|| output::<ControllerUnit>(structure, name));
    let (unit, description) = found.unwrap_or_default();
    Column { name: name.to_owned(), unit, description }
}

fn output<M: Model<Structure = Structure>>(structure: Structure, name: &str) -> Option<(String, String)> {
    let table = M::table(structure);
    let variable = table.find(name).filter(|variable| variable.causality == uam::variables::Causality::Output)?;
    Some((unit(variable), variable.description.clone()))
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use uam::scenarios::{Scenario, find};

    use super::*;
    use crate::host::record::Recording;

    fn particulars() -> (Run, Particulars) {
        let scenario = find("4.4b").unwrap();
        let mut recording =
            Recording::new(["base.roll", "ik.status", "joint[1].rate_command", "counterweight.position"], 1);
        recording.push(0.0, [0.0; 4]);
        let run = Run { scenario, recording, stopped: None, elapsed: Duration::ZERO };
        let verdict = Verdict { followed: false, sentence: "Not.".to_owned(), doubts: vec!["Why?".to_owned()] };
        let schedule = Schedule::new(0.0, 2.0, 1e-3).unwrap();
        let particulars = Particulars::of(&run, &verdict, &schedule, "4.4b.csv");
        (run, particulars)
    }

    #[test]
    fn every_column_has_its_unit_and_meaning() {
        let (_, Particulars { columns, verdict, schedule, .. }) = particulars();
        let units: Vec<_> = columns.iter().map(|column| (column.name.as_str(), column.unit.as_str())).collect();
        assert_eq!(
            units,
            [
                ("time", "s"),
                ("base.roll", "rad"),
                ("ik.status", ""),
                ("joint[1].rate_command", "rad/s"),
                ("counterweight.position", "m")
            ]
        );
        assert!(columns.iter().all(|column| !column.description.is_empty()));
        // That of the controller, who commands it.
        assert!(columns[3].description.starts_with("Rate for joint 1 now"));
        assert_eq!((verdict, schedule), (vec!["Not.".to_owned(), "Why?".to_owned()], [0.0, 2.0, 1e-3]));
    }

    /// The same simulation can be run again from the file alone, and every number is the same to the bit.
    #[test]
    fn a_run_can_be_repeated_from_what_is_written() {
        let (run, written) = particulars();
        let read: Particulars = serde_json::from_str(&written.to_json().unwrap()).unwrap();
        assert_eq!(read, written);
        assert_eq!(Scenario::read(&read.scenario).unwrap(), run.scenario);
        let mass = read.parameters.iter().find(|parameter| parameter.name == "uav.mass").unwrap();
        assert_eq!((&mass.value, mass.unit.as_str()), (&Value::Real(run.scenario.parameters.uav.mass), "kg"));
    }
}
