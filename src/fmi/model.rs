//! What a type must offer to be exported as a co-simulation unit.

use std::fmt::{Debug, Display};

use crate::bytes::{Memory, Tape};
use crate::variables::Table;

/// One call of doStep, in the host's time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CommunicationStep {
    /// Time at which the simulation started \[s\].
    pub start_time: f64,
    /// Time at the beginning of the step \[s\].
    pub from: f64,
    /// Length of the step, not negative \[s\].
    pub size: f64,
}

impl CommunicationStep {
    /// Time at the end of the step \[s\].
    #[must_use]
    pub fn to(&self) -> f64 {
        self.from + self.size
    }
}

/// A simulation that advances from one communication point to the next.
///
/// The host sees plain data, `Self::Data`: parameters, inputs and outputs, named by [`Model::table`].
/// Inputs and tunable parameters may change between steps; a step heeds them and writes the outputs.
/// Setting an input changes no output before the next step.
///
/// What the simulation remembers beside these data passes by a tape when its state is written or read.
pub trait Model: Memory + Clone + Send + Sized + 'static {
    /// Model identifier: name of the FMU and of the libraries in it.
    const IDENTIFIER: &'static str;
    /// One sentence on what the unit does.
    const DESCRIPTION: &'static str;
    /// Part of the unit's identity: counts changes of meaning that its table of variables does not show.
    const INTERFACE_VERSION: u32 = 1;

    /// What the rows of [`Model::rows`] are called in files, for instance `path`; nothing if there never are any.
    const ROWS: &'static str = "";

    /// What is chosen when an FMU is built and fixes its variables.
    type Structure: Copy + PartialEq + Debug + Display + Send + Sync + 'static;
    /// Parameters, inputs and outputs.
    type Data: Clone + Send + 'static;
    /// What can go wrong; the text goes to the host's logger.
    type Error: Display;

    /// All structures that the binary serves, the default first.
    fn structures() -> impl Iterator<Item = Self::Structure>;

    /// The variables of a structure, the independent variable first; a variable's position in the
    /// table is its value reference.
    fn table(structure: Self::Structure) -> Table<Self::Data>;

    /// The data with all start values.
    fn start(structure: Self::Structure) -> Self::Data;

    /// Sets up a simulation from the parameters in `data` and writes the initial outputs.
    ///
    /// # Errors
    /// If the parameters do not go together.
    fn initialize(structure: Self::Structure, data: &mut Self::Data, start_time: f64) -> Result<Self, Self::Error>;

    /// Takes over tunable parameters: called before a step if any has been set since the last one.
    fn tune(&mut self, data: &Self::Data) {
        let _ = data;
    }

    /// Advances by one communication step: reads inputs, writes the outputs that are not computed on demand.
    ///
    /// # Errors
    /// If the simulation cannot go on; it is not stepped again then.
    fn step(&mut self, data: &mut Self::Data, step: CommunicationStep) -> Result<(), Self::Error>;

    /// Writes the outputs on demand ([`crate::variables::Variable::on_demand`]) into `data`: called when the host asks
    /// for one of them for the first time after a step. Parameters and inputs may have changed since; outputs are
    /// those of the step.
    ///
    /// # Errors
    /// If an output has no value; the simulation is not stepped again then.
    fn observe(&self, data: &mut Self::Data) -> Result<(), Self::Error> {
        let _ = data;
        Ok(())
    }

    /// Writes those derivatives of outputs into `data` that the last step did not, for the present time,
    /// `elapsed` since the start \[s\].
    fn differentiate(&self, data: &mut Self::Data, elapsed: f64) {
        let _ = (data, elapsed);
    }

    /// The simulation that was recorded on `tape`, which may hold anything; `data` is what went with it,
    /// parameters and inputs within their bounds.
    ///
    /// # Errors
    /// If data and tape are not those of a simulation. None that comes back may panic or hang later.
    fn restore(structure: Self::Structure, data: &Self::Data, tape: &mut Tape<'_>) -> Result<Self, Self::Error>;

    /// Rows of numbers that belong to the start values of a unit although no variable names them: a host cannot change them.
    fn rows(data: &Self::Data) -> Vec<Vec<f64>> {
        let _ = data;
        Vec::new()
    }

    /// Takes over what [`Model::rows`] gave.
    ///
    /// # Errors
    /// If these cannot be the rows of this model.
    fn take_rows(data: &mut Self::Data, rows: &[Vec<f64>]) -> Result<(), String> {
        let _ = (data, rows);
        Err("this unit has none".to_owned())
    }

    /// Whether both have the same rows; saved states do not hold them.
    fn has_same_rows(one: &Self::Data, other: &Self::Data) -> bool {
        let _ = (one, other);
        true
    }

    /// Passes by a tape what of the data influences the future although no variable names it.
    fn pass_unnamed(data: &mut Self::Data, tape: &mut Tape<'_>) {
        let _ = (data, tape);
    }
}
