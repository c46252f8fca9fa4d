//! Saved states, in memory and as bytes.
//!
//! ```text
//! FMI 2.0 state, format 1, uam_plant 0.1.0 {299d1a1b-...}\n    what it belongs to
//! length of the content                       8 bytes, little endian
//! content
//! checksum of all that                        8 bytes, little endian
//! zeros, if the host has more room
//! ```

use super::{Instance, Situation};
use crate::bytes::{Memory, Tape};
use crate::fmi2::error::Error;
use crate::fmi2::hash::fnv1a;
use crate::fmi2::identity::Identity;
use crate::fmi2::model::Model;
use crate::fmi2::state::{Call, State};
use crate::variables::{Kind, Table};

/// Number of the layout of the bytes.
const FORMAT: u32 = 1;

/// Longest simulation that is believed \[s\]: centuries.
const LONGEST: f64 = 1e10;

/// A copy of all that influences the future of an instance.
pub struct Saved<M: Model> {
    structure: M::Structure,
    then: Situation<M>,
}

impl<M: Model> Instance<M> {
    /// The present state.
    ///
    /// # Errors
    /// If the state machine does not allow it.
    pub fn save(&self) -> Result<Saved<M>, Error> {
        self.permit(Call::GetFMUstate)?;
        Ok(Saved { structure: self.unit.structure, then: self.now.clone() })
    }

    /// Goes on from a saved state, also that of another instance.
    ///
    /// # Errors
    /// If it belongs to an instance of another structure.
    pub fn restore(&mut self, saved: &Saved<M>) -> Result<(), Error> {
        self.permit(Call::SetFMUstate)?;
        self.check_structure(saved)?;
        self.now.clone_from(&saved.then);
        Ok(())
    }

    /// The state that bytes describe, for this instance or another of its structure.
    ///
    /// # Errors
    /// If they are not what [`Saved::to_bytes`] gave for this unit and structure.
    pub fn read_saved(&self, bytes: &[u8]) -> Result<Saved<M>, Error> {
        self.permit(Call::DeSerializeFMUstate)?;
        let content = unwrap(self.title(), bytes)?;
        let then = self.read_situation(content).map_err(|reason| Error::Content { reason })?;
        Ok(Saved { structure: self.unit.structure, then })
    }

    /// A state as bytes that outlive the process.
    ///
    /// # Errors
    /// If it belongs to an instance of another structure.
    pub fn write_saved(&self, saved: &Saved<M>) -> Result<Vec<u8>, Error> {
        self.check_structure(saved)?;
        let mut content = Vec::new();
        let mut tape = Tape::recording(&mut content);
        let mut then = saved.then.clone();
        let mut has_model = then.model.is_some();
        then.pass(&self.table, &mut has_model, &mut tape);
        if let Some(model) = &mut then.model {
            model.pass(&mut tape);
        }
        let mut all = self.title().as_bytes().to_vec();
        all.extend((content.len() as u64).to_le_bytes());
        all.extend(content);
        all.extend(fnv1a(&all).to_le_bytes());
        Ok(all)
    }

    fn check_structure(&self, saved: &Saved<M>) -> Result<(), Error> {
        if saved.structure == self.unit.structure {
            return Ok(());
        }
        let (expected, found) = (self.unit.structure.to_string(), saved.structure.to_string());
        Err(Error::OtherStructure { expected, found })
    }

    /// What the bytes of every state of this structure begin with, whatever start values the unit has: a state has
    /// them all. The GUID in it takes longer than all the rest.
    fn title(&self) -> &str {
        self.title.get_or_init(|| {
            let guid = Identity::<M>::of(self.unit.structure).guid();
            format!("FMI 2.0 state, format {FORMAT}, {} {} {guid}\n", M::IDENTIFIER, env!("CARGO_PKG_VERSION"))
        })
    }

    fn read_situation(&self, content: &[u8]) -> Result<Situation<M>, String> {
        let mut tape = Tape::playing(content);
        let mut then = Situation::new(self.unit.start.clone());
        let mut has_model = false;
        then.pass(&self.table, &mut has_model, &mut tape);
        tape.check().map_err(|error| error.to_string())?;
        let Situation { data, start_time, stop_time, time, .. } = &mut then;
        let elapsed = *time - *start_time;
        if !(time.is_finite() && elapsed.abs() <= LONGEST) || stop_time.is_some_and(|stop| !stop.is_finite()) {
            return Err(format!("the times {start_time}, {time} and {stop_time:?} do not go together"));
        }
        for variable in self.table.variables() {
            if let Kind::Real { bounds, at, .. } = variable.kind {
                let found = *at(data, variable.index);
                if !bounds.admit(found) {
                    return Err(format!("{} must be {bounds}, but is {found}", variable.name));
                }
            }
        }
        if has_model {
            let model = M::restore(self.unit.structure, data, &mut tape).map_err(|error| error.to_string())?;
            then.model = Some(model);
        }
        if tape.is_at_its_end() { Ok(then) } else { Err("there are too many bytes".to_owned()) }
    }
}

impl<M: Model> Situation<M> {
    /// Passes all but the model by a tape.
    fn pass(&mut self, table: &Table<M::Data>, has_model: &mut bool, tape: &mut Tape<'_>) {
        // Without "..": whoever adds a field decides here how it is written.
        let Self { state, data, model: _, start_time, stop_time, time, observed, retuned } = self;
        tape.one_of(state, &State::ALL);
        start_time.pass(tape);
        stop_time.pass(tape);
        time.pass(tape);
        observed.pass(tape);
        retuned.pass(tape);
        for variable in table.variables() {
            match variable.kind {
                Kind::Real { at, .. } => at(data, variable.index).pass(tape),
                Kind::Boolean { at } => at(data, variable.index).pass(tape),
                Kind::Enumeration { at } => tape.choice(at(data, variable.index)),
            }
        }
        M::pass_unnamed(data, tape);
        has_model.pass(tape);
    }
}

/// The content of bytes that are complete and belong to `title`.
fn unwrap<'a>(title: &str, bytes: &'a [u8]) -> Result<&'a [u8], Error> {
    let Some(rest) = bytes.strip_prefix(title.as_bytes()) else {
        let beginning = bytes.get(..title.len()).unwrap_or(bytes);
        return Err(Error::ForeignBytes {
            expected: title.trim_end().to_owned(),
            found: String::from_utf8_lossy(beginning).trim_end().escape_debug().to_string(),
        });
    };
    let damaged = || Error::Damaged { count: bytes.len() };
    let (length, rest) = rest.split_first_chunk().ok_or_else(damaged)?;
    let length = usize::try_from(u64::from_le_bytes(*length)).map_err(|_| damaged())?;
    let (content, rest) = rest.split_at_checked(length).ok_or_else(damaged)?;
    let (checksum, rest) = rest.split_first_chunk().ok_or_else(damaged)?;
    let covered = &bytes[..bytes.len() - rest.len() - checksum.len()];
    let whole = u64::from_le_bytes(*checksum) == fnv1a(covered) && rest.iter().all(|byte| *byte == 0);
    if whole { Ok(content) } else { Err(damaged()) }
}
