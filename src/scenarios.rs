//! Named runs: vehicle, gains, method, path, payload and schedule as data.
//!
//! A scenario is a small TOML file that says in what it differs from the start values of the units. Its
//! parameters have the names that they have in the units, and are checked against the same table.
//! The runs of the thesis are the files in the folder `scenarios`.

mod catalogue;
mod defaults;
mod error;
mod reader;
mod writer;

pub use catalogue::{catalogue, find};
pub use defaults::default_parameters;
pub use error::{Error, Problem};
pub use writer::Extent;

use crate::parameters::{Parameters, Structure};

/// Duration of the payload pick-up of thesis chapter 4 \[s\].
pub const PICK_UP_DURATION: f64 = 30.0;
/// Communication step of the thesis \[s\].
pub const THESIS_STEP: f64 = 1e-3;

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
    /// Names the line, and the key or value in it, that is not understood, with what is allowed.
    pub fn read(text: &str) -> Result<Self, Error> {
        reader::read(text, &catalogue()?)
    }

    /// The scenario as a TOML file, with unit and meaning of every parameter.
    #[must_use]
    pub fn write(&self, extent: Extent) -> String {
        writer::write(self, extent)
    }
}
