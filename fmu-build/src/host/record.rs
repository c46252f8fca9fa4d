//! What is kept of a run: named columns, one row per communication point.

use std::io::Write;
use std::path::Path;

use uam::Structure;

use crate::files::{self, Written};
use crate::host::fmu::{self, Causality, Description, Instance, Selection, Values};

/// Name of the column with the communication points.
pub const TIME: &str = "time";

/// Names of the variables to record.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Names {
    /// Of the controller.
    pub controller: Vec<String>,
    /// Of the plant.
    pub plant: Vec<String>,
}

impl Names {
    /// What reports and tables need.
    #[must_use]
    pub fn standard(structure: Structure) -> Self {
        let per_joint = |suffix: &'static str| (1..=structure.links).map(move |n| format!("joint[{n}].{suffix}"));
        let balance = |suffix: &'static str| structure.balance.prefix().map(|name| format!("{name}.{suffix}"));
        let list = |names: &'static [&'static str]| names.iter().map(|&name| name.to_owned());
        Self {
            controller: list(&["reference.x", "reference.y"])
                .chain(list(&["predicted.base.x", "predicted.base.y", "predicted.base.roll"]))
                .chain(per_joint("rate_command"))
                .chain(balance("rate_command"))
                .chain(balance("acceleration_command"))
                .chain(list(&["ik.status", "ik.min_singular_value"]))
                .collect(),
            plant: list(&["base.x", "base.y", "base.roll"])
                .chain(per_joint("position"))
                .chain(balance("position"))
                .chain(list(&[
                    "end_effector.x",
                    "end_effector.y",
                    "autopilot.thrust",
                    "autopilot.torque",
                    "transmitted.moment",
                    "center_of_mass.x",
                    "payload.attached",
                    "payload.force_y",
                    "support.force",
                ]))
                .collect(),
        }
    }

    /// Every output of both units.
    #[must_use]
    pub fn all_outputs(controller: &Description, plant: &Description) -> Self {
        let outputs = |unit: &Description| unit.with(Causality::Output).map(|output| output.name.clone()).collect();
        Self { controller: outputs(controller), plant: outputs(plant) }
    }
}

/// A column that a recording does not have.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{name}` was not recorded")]
pub struct NotRecorded {
    /// The name asked for.
    pub name: String,
}

/// Named columns of equal length.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Recording {
    columns: Vec<Column>,
}

#[derive(Debug, Clone, PartialEq)]
struct Column {
    name: String,
    values: Vec<f64>,
}

impl Recording {
    /// An empty recording of these columns, [`TIME`] first, with room for `rows`.
    #[must_use]
    pub fn new<'a>(names: impl IntoIterator<Item = &'a str>, rows: usize) -> Self {
        let column = |name: &str| Column { name: name.to_owned(), values: Vec::with_capacity(rows) };
        Self { columns: std::iter::once(TIME).chain(names).map(column).collect() }
    }

    /// Appends a row: time and the values in the order of the names.
    pub fn push(&mut self, time: f64, values: impl IntoIterator<Item = f64>) {
        for (column, value) in self.columns.iter_mut().zip(std::iter::once(time).chain(values)) {
            column.values.push(value);
        }
    }

    /// Names of the columns.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|column| column.name.as_str())
    }

    /// A column.
    ///
    /// # Errors
    /// If there is none of this name.
    pub fn column(&self, name: &str) -> Result<&[f64], NotRecorded> {
        let column = self.columns.iter().find(|column| column.name == name);
        column.map(|column| &column.values[..]).ok_or_else(|| NotRecorded { name: name.to_owned() })
    }

    /// Communication points \[s\].
    #[must_use]
    pub fn times(&self) -> &[f64] {
        self.columns.first().map_or(&[], |time| &time.values)
    }

    /// How many rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.times().len()
    }

    /// Whether there are no rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The last row at or before `time`, if there is one.
    #[must_use]
    pub fn row_at(&self, time: f64) -> Option<usize> {
        // Half a microsecond: a communication point that is meant to be `time` may round to either side.
        self.times().partition_point(|&t| t <= time + 5e-7).checked_sub(1)
    }

    /// Distance between end effector and reference at every communication point \[m\].
    ///
    /// # Errors
    /// If one of them was not recorded.
    pub fn tracking_error(&self) -> Result<Vec<f64>, NotRecorded> {
        self.distance("end_effector", "reference")
    }

    /// Distance between two points, each named by what stands before `.x` and `.y`, in every row \[m\].
    ///
    /// # Errors
    /// If one of them was not recorded.
    pub fn distance(&self, found: &str, wanted: &str) -> Result<Vec<f64>, NotRecorded> {
        let along = |axis: &str| self.difference(&format!("{found}.{axis}"), &format!("{wanted}.{axis}"));
        Ok(along("x")?.into_iter().zip(along("y")?).map(|(dx, dy)| dx.hypot(dy)).collect())
    }

    /// By how much one column is above another, in every row.
    ///
    /// # Errors
    /// If one of them was not recorded.
    pub fn difference(&self, found: &str, wanted: &str) -> Result<Vec<f64>, NotRecorded> {
        let [found, wanted] = [self.column(found)?, self.column(wanted)?];
        Ok(found.iter().zip(wanted).map(|(found, wanted)| found - wanted).collect())
    }
}

/// Reads the same variables of both units again and again.
#[derive(Debug)]
pub struct Recorder {
    controller: (Selection, Values),
    plant: (Selection, Values),
    recording: Recording,
}

impl Recorder {
    /// Prepares to record these variables, with room for `rows`.
    ///
    /// # Errors
    /// If a unit has no such variable.
    pub fn new(names: &Names, controller: &Description, plant: &Description, rows: usize) -> Result<Self, fmu::Error> {
        let select = |unit: &Description, names: &[String]| {
            let selection = Selection::new(unit, names.iter().map(String::as_str))?;
            let values = selection.values();
            Ok::<_, fmu::Error>((selection, values))
        };
        Ok(Self {
            controller: select(controller, &names.controller)?,
            plant: select(plant, &names.plant)?,
            recording: Recording::new(names.plant.iter().chain(&names.controller).map(String::as_str), rows),
        })
    }

    /// Appends a row.
    ///
    /// # Errors
    /// If a unit refuses.
    pub fn record(&mut self, time: f64, controller: &mut Instance, plant: &mut Instance) -> Result<(), fmu::Error> {
        controller.get(&self.controller.0, &mut self.controller.1)?;
        plant.get(&self.plant.0, &mut self.plant.1)?;
        self.recording
            .push(time, self.plant.0.numbers(&self.plant.1).chain(self.controller.0.numbers(&self.controller.1)));
        Ok(())
    }

    /// What was recorded.
    #[must_use]
    pub fn finish(self) -> Recording {
        self.recording
    }
}

/// Writes recordings side by side as comma-separated values: the time once, then the columns of each
/// with its prefix, at every `stride`-th communication point and the last.
///
/// # Errors
/// If the file cannot be written.
pub fn write_csv(path: &Path, recordings: &[(&str, &Recording)], stride: usize) -> crate::Result<Written> {
    files::write_with(path, |file| Ok(write_rows(csv::Writer::from_writer(file), recordings, stride)?))
}

fn write_rows(
    mut writer: csv::Writer<&mut dyn Write>,
    recordings: &[(&str, &Recording)],
    stride: usize,
) -> Result<(), csv::Error> {
    let columns: Vec<(String, &[f64])> = recordings
        .iter()
        .flat_map(|(prefix, recording)| {
            recording.columns.iter().skip(1).map(move |column| (format!("{prefix}{}", column.name), &column.values[..]))
        })
        .collect();
    let Some(times) = recordings.iter().map(|(_, recording)| recording.times()).max_by_key(|times| times.len()) else {
        return Ok(());
    };
    writer.write_record(std::iter::once(TIME).chain(columns.iter().map(|(name, _)| name.as_str())))?;
    let mut row: Vec<Option<f64>> = Vec::with_capacity(columns.len() + 1);
    for (i, &time) in times.iter().enumerate() {
        if i % stride.max(1) == 0 || i + 1 == times.len() {
            row.clear();
            row.push(Some(time));
            row.extend(columns.iter().map(|(_, values)| values.get(i).copied()));
            writer.serialize(&row)?;
        }
    }
    writer.flush()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recording() -> Recording {
        let mut recording = Recording::new(["end_effector.x", "end_effector.y", "reference.x", "reference.y"], 3);
        recording.push(0.0, [0.0, 0.0, 0.0, 0.0]);
        recording.push(0.1, [3.0, 4.0, 0.0, 0.0]);
        recording.push(0.2, [1.0, 1.0, 1.0, 0.5]);
        recording
    }

    #[test]
    fn columns_and_rows() {
        let recording = recording();
        assert_eq!(recording.len(), 3);
        assert_eq!(recording.column("end_effector.y").unwrap(), [0.0, 4.0, 1.0]);
        assert_eq!(recording.tracking_error().unwrap(), [0.0, 5.0, 0.5]);
        assert_eq!(recording.row_at(0.15), Some(1));
        assert_eq!(recording.row_at(0.1 - 1e-9), Some(1));
        assert_eq!(recording.row_at(-1.0), None);
    }

    /// A name that is not there, or not any more, must not pass for a vehicle without such a thing.
    #[test]
    fn columns_that_do_not_exist_are_errors_that_name_them() {
        let recording = recording();
        let refused = |result: Result<Vec<f64>, NotRecorded>| result.unwrap_err().to_string();
        assert_eq!(
            refused(recording.column("end_effector.z").map(<[f64]>::to_vec)),
            "`end_effector.z` was not recorded"
        );
        assert_eq!(refused(recording.distance("base", "reference")), "`base.x` was not recorded");
        assert_eq!(refused(recording.difference("reference.x", "base.x")), "`base.x` was not recorded");
        assert_eq!(refused(Recording::default().tracking_error()), "`end_effector.x` was not recorded");
    }

    #[test]
    fn csv_of_two_recordings_side_by_side() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("both.csv");
        let long = recording();
        let mut short = Recording::new(["base.x"], 1);
        short.push(0.0, [1e-17]);
        write_csv(&path, &[("a.", &long), ("b.", &short)], 2).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "time,a.end_effector.x,a.end_effector.y,a.reference.x,a.reference.y,b.base.x");
        assert_eq!(lines[1], "0.0,0.0,0.0,0.0,0.0,1e-17");
        assert_eq!(lines[2], "0.2,1.0,1.0,1.0,0.5,");
        assert_eq!(lines.len(), 3);
    }

    #[test]
    fn standard_names_are_outputs_of_the_units() {
        use uam::fmi::Model;
        use uam::units::{controller::ControllerUnit, plant::PlantUnit};
        for structure in Structure::all() {
            let names = Names::standard(structure);
            let (controller, plant) = (ControllerUnit::table(structure), PlantUnit::table(structure));
            assert!(names.controller.iter().all(|name| controller.find(name).is_some()));
            assert!(names.plant.iter().all(|name| plant.find(name).is_some()));
        }
    }
}
