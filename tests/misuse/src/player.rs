//! An instance in the hands of a host that makes mistakes: what that host knows, and how it listens.
//!
//! Arguments follow from the seed alone, and so must every answer: statuses, values, messages.

use std::ffi::{c_char, c_int};
use std::ptr;

use fastrand::Rng;

use crate::digest::Digest;
use crate::functions::{Component, ERROR, OK, State};
use crate::host;
use crate::outputs::Points;
use crate::unit::Unit;

mod derivatives;
mod life;
mod states;
mod step;
mod values;

/// Room for lists of values. No list is longer, but for lengths that no memory has.
pub const ROOM: usize = 64;

/// Where an instance stands: figure 11 of the standard, without asynchronous steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    Instantiated,
    Initialization,
    Running,
    Terminated,
    /// A step failed.
    Failed,
}

/// What has been asked and answered.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tally {
    pub calls: u64,
    pub refused: u64,
    pub points: Points,
}

impl Tally {
    /// Of both.
    pub fn and(self, other: Self) -> Self {
        Self {
            calls: self.calls + other.calls,
            refused: self.refused + other.refused,
            points: self.points.and(other.points),
        }
    }
}

/// A state that was saved, and what of.
#[derive(Clone, Copy)]
struct Saved {
    state: State,
    stage: Stage,
    start: f64,
    time: f64,
}

pub struct Player<'a> {
    unit: &'a Unit,
    /// An instance of another unit: no handle of this one.
    stranger: Component,
    pub rng: Rng,
    /// Fingerprint of all answers.
    pub digest: Digest,
    pub tally: Tally,
    component: Component,
    pub stage: Stage,
    start: f64,
    pub time: f64,
    /// Whether errors must come with a message: there is a logger, and nobody has switched it.
    told: bool,
    states: Vec<Saved>,
    /// The last serialized state, and room behind it.
    bytes: Vec<u8>,
    references: [u32; ROOM],
    reals: [f64; ROOM],
    integers: [c_int; ROOM],
    orders: [c_int; ROOM],
    texts: [*const c_char; ROOM],
}

impl<'a> Player<'a> {
    pub fn new(unit: &'a Unit, stranger: Component, seed: u64) -> Self {
        Self {
            unit,
            stranger,
            rng: Rng::with_seed(seed),
            digest: Digest::EMPTY,
            tally: Tally::default(),
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

    /// Calls a function with the instance, or now and then with a handle that is none; true if it went well.
    pub fn call(&mut self, name: &str, body: impl FnOnce(&mut Self, Component) -> c_int) -> Result<bool, String> {
        let component = match self.rng.u32(0..100) {
            0 => ptr::null_mut(),
            1 => self.stranger,
            _ => self.component,
        };
        let ours = component == self.component && !component.is_null();
        let before = host::messages();
        let status = body(self, component);
        self.tally.calls += 1;
        self.digest.take(name.as_bytes());
        self.digest.take(&status.to_le_bytes());
        self.listen(before);
        match status {
            OK => {
                self.require(ours, &format!("{name}: fmi2OK for a handle that is none"))?;
                Ok(true)
            }
            ERROR => {
                self.tally.refused += 1;
                let panicked = host::messages() > before && host::panicked();
                self.require(!panicked, &format!("{name}: {}", host::said()))?;
                if ours && self.told {
                    self.require(host::messages() > before, &format!("{name}: fmi2Error without a message"))?;
                    let named = host::said().contains(name);
                    self.require(named, &format!("{name}: the message names another function: {}", host::said()))?;
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

    fn require(&self, condition: bool, message: &str) -> Result<(), String> {
        if condition { Ok(()) } else { Err(message.to_owned()) }
    }

    fn require_stage(&self, name: &str, stages: &[Stage]) -> Result<(), String> {
        self.require(stages.contains(&self.stage), &format!("{name}: fmi2OK while {:?}", self.stage))
    }
}
