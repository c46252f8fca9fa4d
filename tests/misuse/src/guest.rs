//! An instance of which nothing is asked but good manners: fmi2OK, or fmi2Error with a message that names the call and
//! tells of no panic; and outputs that are finite.

use std::ffi::{CStr, c_int};

use crate::functions::{Component, Functions};
use crate::host;
use crate::player::{ERROR, OK};
use crate::unit::Unit;

/// What became of inputs that somebody made up.
#[derive(Debug, Clone, Copy, Default)]
pub struct Fate {
    pub tried: u64,
    pub accepted: u64,
}

impl Fate {
    /// Of both.
    pub fn and(self, other: Self) -> Self {
        Self { tried: self.tried + other.tried, accepted: self.accepted + other.accepted }
    }
}

pub struct Guest<'a> {
    pub unit: &'a Unit,
    pub functions: &'a Functions,
    pub component: Component,
}

impl Drop for Guest<'_> {
    fn drop(&mut self) {
        // SAFETY: not used again.
        unsafe { (self.functions.free_instance)(self.component) }
    }
}

// SAFETY, for all calls: the instance is alive, lists have the length that goes with them.
impl<'a> Guest<'a> {
    /// A new instance.
    ///
    /// # Errors
    /// If there is none.
    pub fn new(unit: &'a Unit) -> Result<Self, String> {
        Self::come(unit, &unit.guid, c"file:///nowhere").ok_or_else(|| format!("no instance: {}", said()))
    }

    /// A new instance of the unit with this GUID, unless that is refused.
    pub fn come(unit: &'a Unit, guid: &CStr, resources: &CStr) -> Option<Self> {
        let (functions, callbacks) = (&unit.functions, host::callbacks());
        let (name, guid, resources) = (c"guest".as_ptr(), guid.as_ptr(), resources.as_ptr());
        // SAFETY: all texts end with a zero, the callbacks live as long as the call.
        let component = unsafe { (functions.instantiate)(name, 1, guid, resources, &raw const callbacks, 0, 0) };
        (!component.is_null()).then_some(Self { unit, functions, component })
    }

    /// Whether a call went well; if not, it says why.
    ///
    /// # Errors
    /// If it says nothing, nothing of this call, or that it has panicked.
    pub fn well(&self, name: &str, status: c_int) -> Result<bool, String> {
        match status {
            OK => Ok(true),
            ERROR if said().contains(name) && !said().contains("internal error") => Ok(false),
            _ => Err(format!("{name}: status {status}, {}", said())),
        }
    }

    /// For a call that nothing speaks against.
    ///
    /// # Errors
    /// If it did not go well.
    pub fn must(&self, name: &str, status: c_int) -> Result<(), String> {
        if self.well(name, status)? { Ok(()) } else { Err(format!("{name} is refused: {}", said())) }
    }

    /// Through initialization, as far as that is possible; whether it is.
    ///
    /// # Errors
    /// Like [`Guest::well`].
    pub fn initialize(&self) -> Result<bool, String> {
        unsafe {
            let entered = (self.functions.enter_initialization)(self.component);
            self.well("fmi2EnterInitializationMode", entered)?;
            let left = (self.functions.exit_initialization)(self.component);
            self.well("fmi2ExitInitializationMode", left)
        }
    }

    /// A step; whether it was done.
    ///
    /// # Errors
    /// Like [`Guest::well`]; if an output is then not finite.
    pub fn step(&self, from: f64, size: f64) -> Result<bool, String> {
        let done = self.well("fmi2DoStep", unsafe { (self.functions.do_step)(self.component, from, size, 1) })?;
        if done {
            self.finite(&format!("after the step from {from} by {size}"))?;
        }
        Ok(done)
    }

    /// Where the instance says it is.
    pub fn time(&self) -> f64 {
        let (time, mut value) = (self.unit.reference("time").unwrap_or_default(), f64::NAN);
        unsafe { (self.functions.get_real)(self.component, &raw const time, 1, &raw mut value) };
        value
    }

    /// Checks that every real variable, as long as they can be read, is a number.
    ///
    /// # Errors
    /// If one is not.
    pub fn finite(&self, when: &str) -> Result<(), String> {
        for variable in self.unit.variables.iter().filter(|variable| variable.real) {
            let mut value = f64::NAN;
            let get = self.functions.get_real;
            let status = unsafe { get(self.component, &raw const variable.reference, 1, &raw mut value) };
            if !self.well("fmi2GetReal", status)? {
                // Before the simulation, parameters do not go together; in it, the instance has failed.
                return Ok(());
            }
            if !value.is_finite() {
                return Err(format!("{} is {value} {when}", variable.name));
            }
        }
        Ok(())
    }

    /// The bits of all real variables; of those that cannot be read, of what was there before.
    pub fn bits(&self) -> Vec<u64> {
        let read = |reference: u32| {
            let mut value = f64::NAN;
            unsafe { (self.functions.get_real)(self.component, &raw const reference, 1, &raw mut value) };
            value.to_bits()
        };
        self.unit.variables.iter().map(|variable| read(variable.reference)).collect()
    }
}

/// The last message.
pub fn said() -> String {
    host::last(|text| String::from_utf8_lossy(text).into_owned())
}
