//! An instance of which nothing is asked but good manners: fmi2OK, or fmi2Error with a message that names the call and
//! tells of no panic; and outputs that are finite.

use std::cell::Cell;
use std::ffi::{CStr, c_int};

use crate::functions::{Component, ERROR, Functions, OK};
use crate::outputs::Points;
use crate::unit::{Unit, Variable};
use crate::{host, outputs};

/// What became of inputs that somebody made up.
#[derive(Debug, Clone, Copy, Default)]
pub struct Fate {
    pub tried: u64,
    pub accepted: u64,
    /// After those that were accepted.
    pub points: Points,
}

impl Fate {
    /// Of both.
    pub fn and(self, other: Self) -> Self {
        Self {
            tried: self.tried + other.tried,
            accepted: self.accepted + other.accepted,
            points: self.points.and(other.points),
        }
    }
}

pub struct Guest<'a> {
    /// As far as they are known.
    pub variables: &'a [Variable],
    pub functions: &'a Functions,
    pub component: Component,
    /// After all steps so far.
    pub points: Cell<Points>,
}

impl Drop for Guest<'_> {
    fn drop(&mut self) {
        // SAFETY: not used again.
        unsafe { self.functions.free_instance(self.component) }
    }
}

// SAFETY, for all calls: the instance is alive, lists have the length that goes with them.
impl<'a> Guest<'a> {
    /// A new instance.
    ///
    /// # Errors
    /// If there is none.
    pub fn new(unit: &'a Unit) -> Result<Self, String> {
        Self::come(unit, &unit.variables, &unit.guid, c"file:///nowhere")
            .ok_or_else(|| format!("no instance: {}", host::said()))
    }

    /// A new instance of the unit with this GUID, and then these variables, unless that is refused.
    pub fn come(unit: &'a Unit, variables: &'a [Variable], guid: &CStr, resources: &CStr) -> Option<Self> {
        let (functions, callbacks) = (&unit.functions, host::callbacks());
        let (name, guid, resources) = (c"guest".as_ptr(), guid.as_ptr(), resources.as_ptr());
        // SAFETY: all texts end with a zero, the callbacks live as long as the call.
        let component = unsafe { functions.instantiate(name, 1, guid, resources, &raw const callbacks, 0, 0) };
        (!component.is_null()).then(|| Self { variables, functions, component, points: Cell::default() })
    }

    /// Whether a call went well; if not, it says why.
    ///
    /// # Errors
    /// If it says nothing, nothing of this call, or that it has panicked.
    pub fn well(&self, name: &str, status: c_int) -> Result<bool, String> {
        match status {
            OK => Ok(true),
            ERROR if host::said().contains(name) && !host::panicked() => Ok(false),
            _ => Err(format!("{name}: status {status}, {}", host::said())),
        }
    }

    /// For a call that nothing speaks against.
    ///
    /// # Errors
    /// If it did not go well.
    pub fn must(&self, name: &str, status: c_int) -> Result<(), String> {
        if self.well(name, status)? { Ok(()) } else { Err(format!("{name} is refused: {}", host::said())) }
    }

    /// Through initialization, as far as that is possible; whether it is.
    ///
    /// # Errors
    /// Like [`Guest::well`].
    pub fn initialize(&self) -> Result<bool, String> {
        unsafe {
            let entered = self.functions.enter_initialization(self.component);
            self.well("fmi2EnterInitializationMode", entered)?;
            let left = self.functions.exit_initialization(self.component);
            self.well("fmi2ExitInitializationMode", left)
        }
    }

    /// A step; whether it was done.
    ///
    /// # Errors
    /// Like [`Guest::well`] and [`outputs::read`].
    pub fn step(&self, from: f64, size: f64) -> Result<bool, String> {
        let done = self.well("fmi2DoStep", unsafe { self.functions.do_step(self.component, from, size, 1) })?;
        if done {
            let points = outputs::read(self.functions, self.component, self.reals(), true, |_| ())
                .map_err(|message| format!("{message} after the step from {from} by {size}"))?;
            self.points.set(self.points.get().and(points));
        }
        Ok(done)
    }

    /// Where the instance says it is.
    pub fn time(&self) -> f64 {
        // The independent variable is the first.
        let mut value = f64::NAN;
        unsafe { self.functions.get_real(self.component, &0, 1, &raw mut value) };
        value
    }

    /// Checks that every real variable is a number, as long as they can be read: outputs have no values while parameters
    /// do not go together, or after a failure.
    ///
    /// # Errors
    /// If one is not.
    pub fn finite(&self, when: &str) -> Result<(), String> {
        let status = outputs::values(self.functions, self.component, self.reals(), |_| ());
        self.well("fmi2GetReal", status.map_err(|message| format!("{message} {when}"))?).map(drop)
    }

    fn reals(&self) -> impl Iterator<Item = &Variable> + Clone {
        self.variables.iter().filter(|variable| variable.real)
    }

    /// The bits of all real variables; of those that cannot be read, of what was there before.
    pub fn bits(&self) -> Vec<u64> {
        let read = |reference: u32| {
            let mut value = f64::NAN;
            unsafe { self.functions.get_real(self.component, &raw const reference, 1, &raw mut value) };
            value.to_bits()
        };
        self.variables.iter().map(|variable| read(variable.reference)).collect()
    }
}
