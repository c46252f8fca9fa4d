//! Named runs: vehicle, gains, method, path, payload and schedule as data.
//!
//! A scenario is a small TOML file that says in what it differs from the start values of the units. Its
//! parameters have the names that they have in the units, and are checked against the same table. `[*]` in a name stands for
//! every link, joint or leg, except for those that have a line of their own; a number may stand with its unit, in quotes: `"30 deg"`.
//! The runs of the thesis are the files in the folder `scenarios`.

mod catalogue;
mod error;
mod path;
mod quantity;
mod reader;
mod syntax;
mod unknown;
mod writer;

pub use catalogue::{catalogue, find, of_the_thesis};
pub use error::{Error, Problem};
pub use path::Files;
pub use writer::Extent;

pub use crate::parameters::defaults::{PICK_UP_DURATION, THESIS_STEP, default_parameters};

/// Name of the scenario that the start values of the units are.
pub const PICK_UP: &str = "pick-up";

use crate::parameters::{Parameters, Structure};

/// A run that everybody can start by its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    /// Short name, for instance `4.3b`.
    pub id: String,
    /// One line on what happens.
    pub title: String,
    /// What the vehicle consists of.
    pub structure: Structure,
    /// All numbers.
    pub parameters: Parameters,
    /// How long it takes \[s\].
    pub duration: f64,
    /// Communication step \[s\].
    pub step: f64,
}

impl Scenario {
    /// Reads a scenario from the text of a TOML file.
    ///
    /// # Errors
    /// Names the line, and the key or value in it, that is not understood, with what is allowed; a path in a file of its own
    /// is not: see [`Self::read_with`].
    pub fn read(text: &str) -> Result<Self, Error> {
        let none =
            "only the text of the scenario is read here, no other file; its rows may stand in the scenario itself";
        Self::read_with(text, &|_| Err(none.to_owned()))
    }

    /// As [`Self::read`], with `files` to give the text of the csv file that may hold the path.
    ///
    /// # Errors
    /// As [`Self::read`].
    pub fn read_with(text: &str, files: Files<'_>) -> Result<Self, Error> {
        reader::read(text, &catalogue()?, files)
    }

    /// The scenario with other values of parameters, `duration` or `step`, each written as in a file; a word needs
    /// no quotes.
    ///
    /// # Errors
    /// Names the key or value that is not understood, with what is allowed.
    pub fn with<'a>(&self, changes: impl IntoIterator<Item = (&'a str, &'a str)>) -> Result<Self, Error> {
        let mut text = writer::based_on(self);
        changes.into_iter().for_each(|(name, value)| writer::change(&mut text, name, value));
        reader::read(&text, std::slice::from_ref(self), &reader::no_files).map_err(|error| match error {
            // The lines are ours.
            Error::Line { problem, .. } => Error::Change(problem),
            error => error,
        })
    }

    /// The scenario as a TOML file, with unit and meaning of every parameter.
    #[must_use]
    pub fn write(&self, extent: Extent) -> String {
        writer::write(self, extent)
    }
}
