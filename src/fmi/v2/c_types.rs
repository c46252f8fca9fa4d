//! The C types of the FMI 2.0 co-simulation interface.
//!
//! Enumerations that come *from* the host are plain integers here: a value outside of a Rust
//! enumeration would be undefined behaviour before it could be refused.

use core::ffi::{c_char, c_int, c_uint, c_void};

/// `fmi2Component`: what the host holds of an instance.
pub type Component = *mut c_void;
/// `fmi2ComponentEnvironment`: what an instance hands back to the host with every message.
pub type ComponentEnvironment = *mut c_void;
/// `fmi2FMUstate`: what the host holds of a saved state.
pub type FmuState = *mut c_void;
/// `fmi2ValueReference`: number of a variable.
pub type ValueReference = c_uint;
/// `fmi2Real`.
pub type Real = f64;
/// `fmi2Integer`; enumerations travel as integers.
pub type Integer = c_int;
/// `fmi2String`: text in UTF-8 with a zero at the end.
pub type Text = *const c_char;
/// `fmi2Byte`.
pub type Byte = c_char;
/// `size_t`.
pub type Size = usize;
/// `fmi2Type`: 0 for model exchange, 1 for co-simulation.
pub type FmuType = c_int;
/// `fmi2StatusKind`; see [`status_kind`].
pub type StatusKind = c_int;

/// The [`FmuType`] that is served.
pub const CO_SIMULATION: FmuType = 1;

/// The values of [`StatusKind`].
pub mod status_kind {
    use super::StatusKind;

    /// Result of a step that was pending.
    pub const DO_STEP_STATUS: StatusKind = 0;
    /// What a pending step is doing.
    pub const PENDING_STATUS: StatusKind = 1;
    /// Up to when the simulation went well.
    pub const LAST_SUCCESSFUL_TIME: StatusKind = 2;
    /// Whether the unit wants to end the simulation.
    pub const TERMINATED: StatusKind = 3;
}

/// `fmi2EventInfo` of model exchange, which is never read nor written.
pub type EventInfo = c_void;

/// `fmi2Boolean`: zero is false, everything else is true.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(transparent)]
pub struct Boolean(pub c_int);

impl Boolean {
    /// Zero.
    pub const FALSE: Self = Self(0);
    /// One.
    pub const TRUE: Self = Self(1);

    /// As a truth value.
    #[must_use]
    pub fn holds(self) -> bool {
        self.0 != 0
    }
}

impl From<bool> for Boolean {
    fn from(truth: bool) -> Self {
        Self(c_int::from(truth))
    }
}

/// `fmi2Status`: how a call went. Only `Ok` and `Error` are ever returned: hosts abort on `Warning`,
/// some repeat a `Discard` for ever, and `Fatal` would condemn the other instances as well.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C)]
pub enum Status {
    /// All well.
    Ok = 0,
    /// Not quite right, but the simulation can go on.
    Warning = 1,
    /// The step was not done; a smaller one might succeed.
    Discard = 2,
    /// The call failed.
    Error = 3,
    /// All instances are lost.
    Fatal = 4,
    /// The step goes on in the background.
    Pending = 5,
}

/// `fmi2CallbackLogger`: environment, instance name, status, category, format, arguments of the format.
pub type LoggerCallback = unsafe extern "C" fn(ComponentEnvironment, Text, Status, Text, Text, ...);

/// `fmi2CallbackFunctions`: what the host offers to an instance. Only the logger is used: memory comes
/// from Rust's own allocator, and no step goes on in the background.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct CallbackFunctions {
    /// Takes messages.
    pub logger: Option<LoggerCallback>,
    /// Allocates memory, like `calloc`.
    pub allocate_memory: Option<unsafe extern "C" fn(Size, Size) -> *mut c_void>,
    /// Frees what `allocate_memory` gave.
    pub free_memory: Option<unsafe extern "C" fn(*mut c_void)>,
    /// Hears of the end of a step that was pending.
    pub step_finished: Option<unsafe extern "C" fn(ComponentEnvironment, Status)>,
    /// Handed back with every message.
    pub component_environment: ComponentEnvironment,
}
