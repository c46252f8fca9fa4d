//! Saved states, in memory and as bytes.
//!
//! ```text
//! FMI 2.0 state, layout 5c3e8a01d2f4b697, uam_plant 0.1.0 {299d1a1b-...}\n    what it belongs to
//! length of the content                       8 bytes, little endian
//! content
//! checksum of all that                        8 bytes, little endian
//! zeros, if the host has more room
//! ```
//!
//! The number of the layout is a hash of the names and kinds of all that the content consists of, taken down while it
//! passes by a tape: who changes what is remembered changes the number and need not think of it.

use super::{Instance, Snapshot};
use crate::bytes::{Memory, Tape};
use crate::fmi::hash::fnv1a;
use crate::fmi::identity::Identity;
use crate::fmi::model::Model;
use crate::fmi::v2::error::Error;
use crate::fmi::v2::phase::{Call, Phase};
use crate::pass;
use crate::variables::{Kind, Table};

/// What the bytes of states of all units like these begin with.
const PREFIX: &str = "FMI 2.0 state, ";

/// Longest simulation that is believed \[s\]: centuries.
const LONGEST_RUN: f64 = 1e10;

/// A copy of all that influences the future of an instance.
pub struct Saved<M: Model> {
    structure: M::Structure,
    then: Snapshot<M>,
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
    /// If it belongs to an instance of another structure, or with other rows.
    pub fn restore(&mut self, saved: &Saved<M>) -> Result<(), Error> {
        self.permit(Call::SetFMUstate)?;
        self.check_unit(saved)?;
        self.now.clone_from(&saved.then);
        Ok(())
    }

    /// The state that bytes describe, for this instance or another of its structure.
    ///
    /// # Errors
    /// If they are not what a saved state had as its bytes for this unit and structure.
    pub fn read_saved(&self, bytes: &[u8]) -> Result<Saved<M>, Error> {
        self.permit(Call::DeSerializeFMUstate)?;
        let Some(rest) = bytes.strip_prefix(self.title().as_bytes()) else { return Err(self.foreign(bytes)) };
        let content = unwrap(bytes, rest)?;
        let then = self.read_snapshot(content).map_err(|reason| Error::Content { reason })?;
        Ok(Saved { structure: self.unit.structure, then })
    }

    /// A state as bytes that outlive the process.
    ///
    /// # Errors
    /// If it belongs to an instance of another structure, or with other rows.
    pub fn write_saved(&self, saved: &Saved<M>) -> Result<Vec<u8>, Error> {
        self.check_unit(saved)?;
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

    fn check_unit(&self, saved: &Saved<M>) -> Result<(), Error> {
        if saved.structure == self.unit.structure {
            let same = M::has_same_rows(&saved.then.data, &self.unit.start);
            return if same { Ok(()) } else { Err(Error::OtherRows { rows: M::ROWS }) };
        }
        let (expected, found) = (self.unit.structure.to_string(), saved.structure.to_string());
        Err(Error::OtherStructure { expected, found })
    }

    /// What the bytes of every state of this structure begin with, whatever start values the unit has: a state has
    /// them all, but for the rows. The GUID in it takes longer than all the rest.
    fn title(&self) -> &str {
        self.title.get_or_init(|| {
            let (layout, guid) = (fnv1a(self.layout().as_bytes()), self.unit.unset().guid());
            format!("{PREFIX}layout {layout:016x}, {} {} {guid}\n", M::IDENTIFIER, env!("CARGO_PKG_VERSION"))
        })
    }

    /// Names and kinds of all that the content consists of.
    fn layout(&self) -> String {
        let structure = self.unit.structure;
        // The library's own start values, which no unit has to do without: they always go together.
        let mut then = Snapshot::<M>::new(M::start(structure));
        let mut model = M::initialize(structure, &mut then.data, 0.0).ok();
        let mut words = String::new();
        let mut tape = Tape::describing(&mut words);
        // However the variables are called in this unit, their states are the same.
        then.pass(&M::table(structure), &mut true, &mut tape);
        if let Some(model) = &mut model {
            model.pass(&mut tape);
        }
        words
    }

    /// Why bytes that do not begin with the title are refused: what they are, as far as they tell.
    #[cold]
    fn foreign(&self, bytes: &[u8]) -> Error {
        let line = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default();
        let line = String::from_utf8_lossy(&line[..line.len().min(2 * self.title().len())]);
        let what = match (read_title(&line), read_title(self.title().trim_end())) {
            (Some(theirs), Some(ours)) => self.difference(&theirs, &ours),
            _ => "no state of an FMU of this kind".to_owned(),
        };
        Error::ForeignBytes {
            what,
            expected: self.title().trim_end().to_owned(),
            found: line.escape_debug().to_string(),
        }
    }

    fn difference(&self, theirs: &Title<'_>, ours: &Title<'_>) -> String {
        if theirs.unit != ours.unit {
            return format!("a state of the unit {}, but this is {}", theirs.unit, ours.unit);
        }
        let others = M::structures().filter(|structure| *structure != self.unit.structure);
        let of = |structure: &M::Structure| theirs.guid == Identity::<M>::of(*structure).guid().to_string();
        match others.into_iter().find(of) {
            Some(structure) => format!("a state of {structure}, but this is {}", self.unit.structure),
            None if M::ROWS.is_empty() || theirs.guid == ours.guid => {
                "a state that another version of this unit wrote".to_owned()
            }
            None if of(&self.unit.structure) => format!("a state of a unit without {}, but this has its own", M::ROWS),
            None => format!("a state that another version of this unit wrote, or a unit with another {}", M::ROWS),
        }
    }

    fn read_snapshot(&self, content: &[u8]) -> Result<Snapshot<M>, String> {
        let mut tape = Tape::playing(content);
        let mut then = Snapshot::new(self.unit.start.clone());
        let mut has_model = false;
        then.pass(&self.table, &mut has_model, &mut tape);
        tape.check().map_err(|error| error.to_string())?;
        let Snapshot { data, start_time, stop_time, time, .. } = &mut then;
        let elapsed = *time - *start_time;
        if !(time.is_finite() && elapsed.abs() <= LONGEST_RUN) || stop_time.is_some_and(|stop| !stop.is_finite()) {
            return Err(format!("the times {start_time}, {time} and {stop_time:?} do not go together"));
        }
        for variable in self.table.variables() {
            if let Kind::Real { bounds, at, .. } = variable.kind {
                let found = *at.get(data);
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

impl<M: Model> Snapshot<M> {
    /// Passes all but the model by a tape.
    fn pass(&mut self, table: &Table<M::Data>, has_model: &mut bool, tape: &mut Tape<'_>) {
        // Without "..": whoever adds a field decides here how it is written.
        let Self { phase, data, model: _, start_time, stop_time, time, observed, retuned } = self;
        tape.one_of(phase, &Phase::ALL);
        pass!(tape: start_time, stop_time, time, observed, retuned);
        for variable in table.variables() {
            tape.name(&variable.name);
            match variable.kind {
                Kind::Real { at, .. } => at.get_mut(data).pass(tape),
                Kind::Boolean { at } => at.get_mut(data).pass(tape),
                Kind::Enumeration { at } => tape.choice(at.get_mut(data)),
            }
        }
        M::pass_unnamed(data, tape);
        pass!(tape: has_model);
    }
}

/// What a title says of the unit.
struct Title<'a> {
    unit: &'a str,
    guid: &'a str,
}

fn read_title(line: &str) -> Option<Title<'_>> {
    let words: Vec<&str> = line.strip_prefix(PREFIX)?.split(' ').collect();
    let [.., unit, _version, guid] = words[..] else { return None };
    Some(Title { unit, guid })
}

/// The content of bytes that are complete; `rest` is what follows their title.
fn unwrap<'a>(bytes: &[u8], rest: &'a [u8]) -> Result<&'a [u8], Error> {
    let damaged = || Error::Damaged { count: bytes.len() };
    let (length, rest) = rest.split_first_chunk().ok_or_else(damaged)?;
    let length = usize::try_from(u64::from_le_bytes(*length)).map_err(|_| damaged())?;
    let (content, rest) = rest.split_at_checked(length).ok_or_else(damaged)?;
    let (checksum, rest) = rest.split_first_chunk().ok_or_else(damaged)?;
    let covered = &bytes[..bytes.len() - rest.len() - checksum.len()];
    let whole = u64::from_le_bytes(*checksum) == fnv1a(covered) && rest.iter().all(|byte| *byte == 0);
    if whole { Ok(content) } else { Err(damaged()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi::v2::toy::{Size, Toy};

    fn layout(size: Size) -> String {
        Instance::<Toy>::new(Identity::of(size)).layout()
    }

    /// What the instance remembers itself, what its variables are, what else of the data counts, and the model.
    #[test]
    fn the_layout_names_all_that_a_state_consists_of() {
        let words = layout(Size::Small);
        for name in ["start_time", "stop_time", "gain", "up", "held", "push", "Toy", "position"] {
            assert!(words.contains(&format!(" {name} ")), "{name}: {words}");
        }
        assert!(words.contains("Terminated, Failed]"), "{words}");
        assert!(!words.contains("extra") && layout(Size::Large).contains(" extra "));
    }

    /// A state says the same of its layout, whatever has happened to the instance.
    #[test]
    fn the_layout_does_not_depend_on_the_state() {
        let mut toy = Instance::<Toy>::new(Identity::of(Size::Small));
        let new = toy.layout();
        toy.setup_experiment(1.0, Some(2.0)).unwrap();
        toy.enter_initialization().unwrap();
        toy.exit_initialization().unwrap();
        toy.do_step(1.0, 0.5).unwrap();
        assert_eq!(toy.layout(), new);
    }
}
