//! One random sequence of calls on one instance, and what must hold whatever the calls are.
//!
//! The sequence follows from its seed alone, and so must every answer: statuses, values, messages.

use std::ffi::{c_char, c_int};
use std::ptr;

use fastrand::Rng;

use crate::digest::Digest;
use crate::functions::{Component, State};
use crate::hostile::{damage, integer, length, one_in, pointer, pointer_mut, real, text};
use crate::unit::Unit;
use crate::{host, reference};

/// Room for lists of values. No list is longer, but for lengths that no memory has.
pub const ROOM: usize = 64;
/// Room for the bytes of a state.
const BYTES: usize = 1 << 14;

const OK: c_int = 0;
const ERROR: c_int = 3;

/// Where an instance stands: figure 11 of the standard, without asynchronous steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Stage {
    Instantiated,
    Initialization,
    Running,
    Terminated,
    /// A step failed.
    Failed,
}

/// What sequences came to.
#[derive(Debug, Clone, Copy, Default)]
pub struct Outcome {
    /// Fingerprint of all answers.
    pub digest: u64,
    pub calls: u64,
    pub refused: u64,
    /// Communication steps that were done.
    pub steps: u64,
}

impl Outcome {
    /// Of both, in any order.
    pub fn and(self, other: Self) -> Self {
        Self {
            digest: self.digest ^ other.digest,
            calls: self.calls + other.calls,
            refused: self.refused + other.refused,
            steps: self.steps + other.steps,
        }
    }
}

/// Plays the sequence of this seed.
///
/// # Errors
/// What a unit did that it must not do.
pub fn play(unit: &Unit, stranger: Component, expected: &[u64], seed: u64) -> Result<Outcome, String> {
    let mut player = Player::new(unit, stranger, seed);
    player.instantiate()?;
    for _ in 0..player.rng.u32(1..40) {
        if player.rng.bool() { player.next_as_usual() } else { player.anything() }?;
    }
    player.end(expected)?;
    let Player { digest, calls, refused, steps, .. } = player;
    Ok(Outcome { digest: digest.value(), calls, refused, steps })
}

struct Player<'a> {
    unit: &'a Unit,
    /// An instance of another unit: no handle of this one.
    stranger: Component,
    rng: Rng,
    digest: Digest,
    calls: u64,
    refused: u64,
    steps: u64,
    component: Component,
    stage: Stage,
    start: f64,
    time: f64,
    /// Whether errors must come with a message: there is a logger, and nobody has switched it.
    told: bool,
    /// Saved states with what was saved.
    states: Vec<(State, Stage, f64, f64)>,
    /// The last serialized state, and its length.
    bytes: Vec<u8>,
    references: [u32; ROOM],
    reals: [f64; ROOM],
    integers: [c_int; ROOM],
    orders: [c_int; ROOM],
    texts: [*const c_char; ROOM],
}

impl<'a> Player<'a> {
    fn new(unit: &'a Unit, stranger: Component, seed: u64) -> Self {
        Self {
            unit,
            stranger,
            rng: Rng::with_seed(seed),
            digest: Digest::EMPTY,
            calls: 0,
            refused: 0,
            steps: 0,
            component: ptr::null_mut(),
            stage: Stage::Instantiated,
            start: 0.0,
            time: 0.0,
            told: false,
            states: Vec::new(),
            bytes: Vec::new(),
            references: [0; ROOM],
            reals: [0.0; ROOM],
            integers: [0; ROOM],
            orders: [1; ROOM],
            texts: [ptr::null(); ROOM],
        }
    }

    /// Mostly as it should be; else no instance may come out unless every argument is admissible.
    fn instantiate(&mut self) -> Result<(), String> {
        let callbacks = host::callbacks();
        let right = !one_in(&mut self.rng, 8);
        let rng = &mut self.rng;
        let name = if right { c"unit".as_ptr() } else { text(rng) };
        let kind = if right { 1 } else { rng.i32(-1..3) };
        let guid = if right || rng.bool() { self.unit.guid.as_ptr() } else { text(rng) };
        let resources = if right { c"file:///nowhere".as_ptr() } else { text(rng) };
        let silent = !right && rng.bool();
        let callbacks = if silent { ptr::null() } else { &raw const callbacks };
        let logging = integer(rng);
        let before = host::messages();
        // SAFETY: all texts end with a zero.
        self.component =
            unsafe { (self.unit.functions.instantiate)(name, kind, guid, resources, callbacks, integer(rng), logging) };
        self.calls += 1;
        self.told = !silent;
        let acceptable = !name.is_null() && kind == 1 && guid == self.unit.guid.as_ptr();
        if self.component.is_null() {
            self.refused += 1;
            self.listen(before);
            if acceptable {
                return Err(format!("no instance: {}", self.last()));
            }
            return self.require(silent || host::messages() > before, "fmi2Instantiate: null without a message");
        }
        self.require(acceptable, "fmi2Instantiate: an instance in spite of wrong arguments")
    }

    /// The call that a well-behaved host makes next.
    fn next_as_usual(&mut self) -> Result<(), String> {
        match self.stage {
            Stage::Instantiated if self.rng.bool() => self.set_real(true),
            Stage::Instantiated => self.enter_initialization(),
            Stage::Initialization if self.rng.bool() => self.set_real(true),
            Stage::Initialization => self.exit_initialization(),
            Stage::Running if one_in(&mut self.rng, 3) => self.set_real(true),
            Stage::Running => {
                let size = [1e-3, 1e-3, 1e-2, 2e-2][self.rng.usize(0..4)];
                self.do_step(self.time, size)
            }
            Stage::Terminated | Stage::Failed => self.reset(),
        }
    }

    /// Any call with any arguments.
    fn anything(&mut self) -> Result<(), String> {
        match self.rng.u32(0..34) {
            0 => self.set_debug_logging(),
            1 => self.setup_experiment(),
            2 => self.enter_initialization(),
            3 => self.exit_initialization(),
            4 => self.terminate(),
            5 => self.reset(),
            6 | 7 => self.get_real(),
            8 => self.get_integer(),
            9 => self.get_boolean(),
            10 | 11 => self.set_real(false),
            12 => self.set_integer(),
            13 => self.set_boolean(),
            14 => self.get_string(),
            15 => self.set_string(),
            16 | 17 => {
                let (from, size) = self.odd_step();
                self.do_step(from, size)
            }
            18 => self.call("fmi2CancelStep", |p, c| unsafe { (p.unit.functions.cancel_step)(c) }).map(drop),
            19 => self.statuses(),
            20 | 21 => self.set_input_derivatives(),
            22 => self.get_output_derivatives(),
            23 => self.get_directional_derivative(),
            24 | 25 => self.get_state(),
            26 | 27 => self.set_state(),
            28 => self.free_state(),
            29 => self.state_size(),
            30 | 31 => self.serialize_state(),
            _ => self.deserialize_state(),
        }
    }

    // SAFETY, for all calls below: every pointer is null, misaligned or good for ROOM elements, and every
    // length is at most ROOM or more than any memory has, which a unit must notice without reading.

    /// Calls a function with the instance, or now and then with a handle that is none; true if it went well.
    fn call(&mut self, name: &str, body: impl FnOnce(&mut Self, Component) -> c_int) -> Result<bool, String> {
        let component = match self.rng.u32(0..100) {
            0 => ptr::null_mut(),
            1 => self.stranger,
            _ => self.component,
        };
        let ours = component == self.component && !component.is_null();
        let before = host::messages();
        let status = body(self, component);
        self.calls += 1;
        self.digest.take(name.as_bytes());
        self.digest.take(&status.to_le_bytes());
        self.listen(before);
        match status {
            OK => {
                self.require(ours, &format!("{name}: fmi2OK for a handle that is none"))?;
                Ok(true)
            }
            ERROR => {
                self.refused += 1;
                if ours && self.told {
                    self.require(host::messages() > before, &format!("{name}: fmi2Error without a message"))?;
                    let named = host::last(|text| text.windows(name.len()).any(|part| part == name.as_bytes()));
                    self.require(named, &format!("{name}: the message names another function: {}", self.last()))?;
                }
                Ok(false)
            }
            other => Err(format!("{name}: status {other}")),
        }
    }

    /// Takes the last message into the fingerprint, if there is a new one.
    fn listen(&mut self, before: u64) {
        if host::messages() > before {
            host::last(|text| self.digest.take(text));
        }
    }

    fn last(&self) -> String {
        host::last(|text| String::from_utf8_lossy(text).into_owned())
    }

    fn require(&self, condition: bool, message: &str) -> Result<(), String> {
        if condition { Ok(()) } else { Err(message.to_owned()) }
    }

    fn require_stage(&self, name: &str, stages: &[Stage]) -> Result<(), String> {
        self.require(stages.contains(&self.stage), &format!("{name}: fmi2OK while {:?}", self.stage))
    }

    /// Fills the list of references: known ones, mostly; returns its length.
    fn choose_references(&mut self, hostile: bool) -> usize {
        let count = self.rng.usize(1..5);
        let known = &self.unit.variables;
        for place in &mut self.references[..count] {
            *place = match self.rng.u32(0..40) {
                0 if hostile => self.rng.u32(..),
                1 if hostile => u32::try_from(known.len()).unwrap_or(u32::MAX),
                _ => known[self.rng.usize(0..known.len())].reference,
            };
        }
        count
    }

    fn set_debug_logging(&mut self) -> Result<(), String> {
        self.call("fmi2SetDebugLogging", |p, c| {
            p.told = false;
            let count = p.rng.usize(0..4);
            p.texts[..count].fill_with(|| text(&mut p.rng));
            let (on, count) = (integer(&mut p.rng), length(&mut p.rng, count));
            let list = pointer(&mut p.rng, p.texts.as_ptr());
            unsafe { (p.unit.functions.set_debug_logging)(c, on, count, list) }
        })
        .map(drop)
    }

    fn setup_experiment(&mut self) -> Result<(), String> {
        let name = "fmi2SetupExperiment";
        let start = if self.rng.bool() { 0.0 } else { real(&mut self.rng) };
        let done = self.call(name, |p, c| {
            let (defined, tolerance) = (integer(&mut p.rng), real(&mut p.rng));
            let (has_stop, stop) = (p.rng.i32(0..2), 10.0 * real(&mut p.rng));
            unsafe { (p.unit.functions.setup_experiment)(c, defined, tolerance, start, has_stop, stop) }
        })?;
        if done {
            self.require_stage(name, &[Stage::Instantiated])?;
            (self.start, self.time) = (start, start);
        }
        Ok(())
    }

    fn enter_initialization(&mut self) -> Result<(), String> {
        let name = "fmi2EnterInitializationMode";
        if self.call(name, |p, c| unsafe { (p.unit.functions.enter_initialization)(c) })? {
            self.require_stage(name, &[Stage::Instantiated])?;
            self.stage = Stage::Initialization;
        }
        Ok(())
    }

    fn exit_initialization(&mut self) -> Result<(), String> {
        let name = "fmi2ExitInitializationMode";
        if self.call(name, |p, c| unsafe { (p.unit.functions.exit_initialization)(c) })? {
            self.require_stage(name, &[Stage::Initialization])?;
            (self.stage, self.time) = (Stage::Running, self.start);
            self.all_finite("after initialization")?;
        }
        Ok(())
    }

    fn terminate(&mut self) -> Result<(), String> {
        let name = "fmi2Terminate";
        if self.call(name, |p, c| unsafe { (p.unit.functions.terminate)(c) })? {
            self.require_stage(name, &[Stage::Running, Stage::Terminated, Stage::Failed])?;
            self.stage = Stage::Terminated;
        }
        Ok(())
    }

    fn reset(&mut self) -> Result<(), String> {
        if self.call("fmi2Reset", |p, c| unsafe { (p.unit.functions.reset)(c) })? {
            (self.stage, self.start, self.time) = (Stage::Instantiated, 0.0, 0.0);
        }
        Ok(())
    }

    fn get_real(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        let done = self.call("fmi2GetReal", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            let values = pointer_mut(&mut p.rng, p.reals.as_mut_ptr());
            unsafe { (p.unit.functions.get_real)(c, references, count, values) }
        })?;
        if done {
            self.reals.iter().for_each(|value| self.digest.take(&value.to_bits().to_le_bytes()));
        }
        Ok(())
    }

    fn get_integer(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.call("fmi2GetInteger", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            let values = pointer_mut(&mut p.rng, p.integers.as_mut_ptr());
            unsafe { (p.unit.functions.get_integer)(c, references, count, values) }
        })?;
        self.integers.iter().for_each(|value| self.digest.take(&value.to_le_bytes()));
        Ok(())
    }

    fn get_boolean(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.call("fmi2GetBoolean", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            let values = pointer_mut(&mut p.rng, p.integers.as_mut_ptr());
            unsafe { (p.unit.functions.get_boolean)(c, references, count, values) }
        })?;
        self.integers.iter().for_each(|value| self.digest.take(&value.to_le_bytes()));
        Ok(())
    }

    /// Sets any variable to any number; `usual`: to one that makes sense for most.
    fn set_real(&mut self, usual: bool) -> Result<(), String> {
        let count = self.choose_references(!usual);
        for value in &mut self.reals[..count] {
            *value = if usual { self.rng.f64() } else { real(&mut self.rng) };
        }
        self.call("fmi2SetReal", |p, c| {
            let (references, values) = (p.references.as_ptr(), p.reals.as_ptr());
            if usual {
                return unsafe { (p.unit.functions.set_real)(c, references, count, values) };
            }
            let (references, count) = (pointer(&mut p.rng, references), length(&mut p.rng, count));
            let values = pointer(&mut p.rng, values);
            unsafe { (p.unit.functions.set_real)(c, references, count, values) }
        })
        .map(drop)
    }

    fn set_integer(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.integers[..count].fill_with(|| integer(&mut self.rng));
        self.call("fmi2SetInteger", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            let values = pointer(&mut p.rng, p.integers.as_ptr());
            unsafe { (p.unit.functions.set_integer)(c, references, count, values) }
        })
        .map(drop)
    }

    fn set_boolean(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.integers[..count].fill_with(|| integer(&mut self.rng));
        self.call("fmi2SetBoolean", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            let values = pointer(&mut p.rng, p.integers.as_ptr());
            unsafe { (p.unit.functions.set_boolean)(c, references, count, values) }
        })
        .map(drop)
    }

    fn get_string(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.call("fmi2GetString", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            unsafe { (p.unit.functions.get_string)(c, references, count, p.texts.as_mut_ptr()) }
        })
        .map(drop)
    }

    fn set_string(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.texts.fill_with(|| text(&mut self.rng));
        self.call("fmi2SetString", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            unsafe { (p.unit.functions.set_string)(c, references, count, p.texts.as_ptr()) }
        })
        .map(drop)
    }

    /// Beginning and size of a step that no good host asks for, or of an odd one that some do.
    fn odd_step(&mut self) -> (f64, f64) {
        let size = match self.rng.u32(0..6) {
            0 => real(&mut self.rng),
            1 => 1e-13,
            2 => 0.0,
            3 => 0.009_999_999_999_998_455,
            4 => 1e3,
            _ => 0.05 * self.rng.f64(),
        };
        let from = match self.rng.u32(0..5) {
            0 => real(&mut self.rng),
            1 => self.time + 1e-9,
            _ => self.time,
        };
        (from, size)
    }

    fn do_step(&mut self, from: f64, size: f64) -> Result<(), String> {
        let name = "fmi2DoStep";
        let mut ours = false;
        let done = self.call(name, |p, c| {
            ours = c == p.component;
            let never_back = integer(&mut p.rng);
            unsafe { (p.unit.functions.do_step)(c, from, size, never_back) }
        })?;
        if done {
            self.require_stage(name, &[Stage::Running])?;
            self.steps += 1;
            if size != 0.0 {
                self.time = from + size;
            }
            let mut end = f64::NAN;
            let status = unsafe { (self.unit.functions.get_real_status)(self.component, 2, &raw mut end) };
            self.require(
                status == OK && end.to_bits() == self.time.to_bits(),
                &format!("{name}: ends at {end}, not at {} = {from} + {size}", self.time),
            )?;
            return self.all_finite(&format!("after the step from {from} by {size}"));
        }
        if ours && !self.component.is_null() && self.stage == Stage::Running {
            // Either the arguments were refused, or the instance has failed: then this is fmi2Error.
            let mut status = OK;
            unsafe { (self.unit.functions.get_status)(self.component, 0, &raw mut status) };
            if status == ERROR {
                self.stage = Stage::Failed;
            }
        }
        Ok(())
    }

    /// Every real output is a number, and all go into the fingerprint.
    fn all_finite(&mut self, when: &str) -> Result<(), String> {
        for variable in self.unit.variables.iter().filter(|variable| variable.output && variable.real) {
            let mut value = f64::NAN;
            let get = self.unit.functions.get_real;
            let status = unsafe { get(self.component, &raw const variable.reference, 1, &raw mut value) };
            self.require(status == OK && value.is_finite(), &format!("{} is {value} {when}", variable.name))?;
            self.digest.take(&value.to_bits().to_le_bytes());
        }
        Ok(())
    }

    fn statuses(&mut self) -> Result<(), String> {
        let (kind, which) = (integer(&mut self.rng), self.rng.u32(0..5));
        let name = [
            "fmi2GetStatus",
            "fmi2GetRealStatus",
            "fmi2GetIntegerStatus",
            "fmi2GetBooleanStatus",
            "fmi2GetStringStatus",
        ][which as usize];
        self.call(name, |p, c| {
            let (number, real) =
                (pointer_mut(&mut p.rng, p.integers.as_mut_ptr()), pointer_mut(&mut p.rng, p.reals.as_mut_ptr()));
            let text = pointer_mut(&mut p.rng, p.texts.as_mut_ptr());
            let functions = &p.unit.functions;
            unsafe {
                match which {
                    0 => (functions.get_status)(c, kind, number),
                    1 => (functions.get_real_status)(c, kind, real),
                    2 => (functions.get_integer_status)(c, kind, number),
                    3 => (functions.get_boolean_status)(c, kind, number),
                    _ => (functions.get_string_status)(c, kind, text),
                }
            }
        })
        .map(drop)
    }

    fn choose_derivatives(&mut self) -> usize {
        let count = self.choose_references(true);
        self.orders[..count].fill_with(|| if one_in(&mut self.rng, 3) { integer(&mut self.rng) } else { 1 });
        self.reals[..count].fill_with(|| real(&mut self.rng));
        count
    }

    fn set_input_derivatives(&mut self) -> Result<(), String> {
        let count = self.choose_derivatives();
        self.call("fmi2SetRealInputDerivatives", |p, c| {
            let (references, orders) =
                (pointer(&mut p.rng, p.references.as_ptr()), pointer(&mut p.rng, p.orders.as_ptr()));
            let (values, count) = (pointer(&mut p.rng, p.reals.as_ptr()), length(&mut p.rng, count));
            unsafe { (p.unit.functions.set_input_derivatives)(c, references, count, orders, values) }
        })
        .map(drop)
    }

    fn get_output_derivatives(&mut self) -> Result<(), String> {
        let count = self.choose_derivatives();
        self.call("fmi2GetRealOutputDerivatives", |p, c| {
            let (references, orders) =
                (pointer(&mut p.rng, p.references.as_ptr()), pointer(&mut p.rng, p.orders.as_ptr()));
            let (values, count) = (pointer_mut(&mut p.rng, p.reals.as_mut_ptr()), length(&mut p.rng, count));
            unsafe { (p.unit.functions.get_output_derivatives)(c, references, count, orders, values) }
        })
        .map(drop)
    }

    fn get_directional_derivative(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.call("fmi2GetDirectionalDerivative", |p, c| {
            let (list, values) = (pointer(&mut p.rng, p.references.as_ptr()), p.reals.as_mut_ptr());
            let (unknowns, knowns) = (length(&mut p.rng, count), length(&mut p.rng, count));
            unsafe { (p.unit.functions.get_directional_derivative)(c, list, unknowns, list, knowns, values, values) }
        })
        .map(drop)
    }

    /// A state of this sequence, or what is none: null, freed, or any address.
    fn any_state(&mut self) -> State {
        match self.rng.u32(0..12) {
            0 => ptr::null_mut(),
            1 => ptr::without_provenance_mut(self.rng.usize(..)),
            2 => self.component,
            _ if self.states.is_empty() => ptr::null_mut(),
            _ => self.states[self.rng.usize(0..self.states.len())].0,
        }
    }

    fn get_state(&mut self) -> Result<(), String> {
        // Into a new place, or over a state that is there.
        let old = (self.rng.bool() && !self.states.is_empty()).then(|| self.rng.usize(0..self.states.len()));
        let mut state = old.map_or(ptr::null_mut(), |old| self.states[old].0);
        let given = state;
        let done = self.call("fmi2GetFMUstate", |p, c| {
            let place = pointer_mut(&mut p.rng, &raw mut state);
            unsafe { (p.unit.functions.get_state)(c, place) }
        })?;
        if done {
            let saved = (state, self.stage, self.start, self.time);
            match old {
                Some(old) => {
                    self.require(state == given, "fmi2GetFMUstate: another place for a state that is there")?;
                    self.states[old] = saved;
                }
                None => self.states.push(saved),
            }
        }
        Ok(())
    }

    fn set_state(&mut self) -> Result<(), String> {
        let state = self.any_state();
        if self.call("fmi2SetFMUstate", |p, c| unsafe { (p.unit.functions.set_state)(c, state) })? {
            let saved = self.states.iter().find(|saved| saved.0 == state);
            let &(_, stage, start, time) = saved.ok_or("fmi2SetFMUstate: fmi2OK for what is no state")?;
            (self.stage, self.start, self.time) = (stage, start, time);
        }
        Ok(())
    }

    fn free_state(&mut self) -> Result<(), String> {
        let given = self.any_state();
        let mut state = given;
        let done = self.call("fmi2FreeFMUstate", |p, c| unsafe { (p.unit.functions.free_state)(c, &raw mut state) })?;
        if done {
            self.require(state.is_null(), "fmi2FreeFMUstate: the freed state is not null")?;
            self.states.retain(|saved| saved.0 != given);
        }
        Ok(())
    }

    fn state_size(&mut self) -> Result<(), String> {
        let state = self.any_state();
        let mut size = 0;
        let done = self.call("fmi2SerializedFMUstateSize", |p, c| {
            let place = pointer_mut(&mut p.rng, &raw mut size);
            unsafe { (p.unit.functions.state_size)(c, state, place) }
        })?;
        self.require(!done || (1..=BYTES).contains(&size), &format!("fmi2SerializedFMUstateSize: {size}"))
    }

    fn serialize_state(&mut self) -> Result<(), String> {
        let state = self.any_state();
        let size = if one_in(&mut self.rng, 4) { self.rng.usize(0..BYTES) } else { BYTES };
        let mut bytes = vec![0_u8; BYTES];
        let done = self.call("fmi2SerializeFMUstate", |p, c| {
            let (place, size) = (pointer_mut(&mut p.rng, bytes.as_mut_ptr()), length(&mut p.rng, size));
            unsafe { (p.unit.functions.serialize_state)(c, state, place.cast(), size) }
        })?;
        if done {
            self.digest.take(&bytes);
            self.bytes = bytes;
        }
        Ok(())
    }

    fn deserialize_state(&mut self) -> Result<(), String> {
        let mut bytes = self.bytes.clone();
        if bytes.is_empty() || one_in(&mut self.rng, 3) {
            damage(&mut self.rng, &mut bytes);
        }
        let mut state = ptr::null_mut();
        let done = self.call("fmi2DeSerializeFMUstate", |p, c| {
            let size = length(&mut p.rng, bytes.len());
            unsafe { (p.unit.functions.deserialize_state)(c, bytes.as_ptr().cast(), size, &raw mut state) }
        })?;
        if done {
            // Nobody knows of which instant these bytes were; the instance does not go there.
            let mut freed = state;
            let status = unsafe { (self.unit.functions.free_state)(self.component, &raw mut freed) };
            self.require(status == OK, "fmi2FreeFMUstate: a state from bytes cannot be freed")?;
        }
        Ok(())
    }

    /// Whatever happened: after a reset the instance is as new. Then it goes, some states with it.
    fn end(&mut self, expected: &[u64]) -> Result<(), String> {
        if self.component.is_null() {
            return Ok(());
        }
        unsafe {
            let status = (self.unit.functions.reset)(self.component);
            self.require(status == OK, "fmi2Reset: refused at the end")?;
            let found = reference::run(self.unit, self.component)?;
            self.require(found == expected, "after fmi2Reset the instance is not as new")?;
            (self.unit.functions.free_instance)(self.component);
        }
        Ok(())
    }
}
