//! One running unit: safe calls that turn statuses into errors with the unit's own words.

use std::ffi::{CString, c_int, c_void};
use std::fmt;
use std::ptr::NonNull;
use std::rc::Rc;
use std::sync::Arc;

use super::log::{self, Log};
use super::{Description, Error, Loaded, Message, Selection, Status, Value, Values, c};

const FALSE: c_int = 0;
const TRUE: c_int = 1;
const INVISIBLE: c_int = FALSE;
/// Some units do not even say why a call failed without this.
const LOGGING_ON: c_int = TRUE;

/// A unit between `fmi2Instantiate` and `fmi2FreeInstance`.
///
/// Which call is allowed when is the unit's own business: calls out of order come back as errors.
pub struct Instance {
    name: String,
    component: NonNull<c_void>,
    loaded: Arc<Loaded>,
    /// Shared, not boxed: units write to it while this structure moves.
    log: Rc<Log>,
    /// The standard lets units keep the pointer to this.
    _callbacks: Rc<c::Callbacks>,
    /// What was saved last, or null.
    saved: c::State,
    /// After `fmi2Fatal` nothing may be called any more, not even to free.
    dead: bool,
}

impl fmt::Debug for Instance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Instance").field("name", &self.name).field("unit", &self.loaded.path).finish_non_exhaustive()
    }
}

/// Zeroed memory from C, as the standard wants it.
unsafe extern "C" fn allocate(count: usize, size: usize) -> *mut c_void {
    // SAFETY: calloc takes any numbers.
    unsafe { libc::calloc(count, size) }
}

/// # Safety
/// `memory` comes from [`allocate`] or is null.
unsafe extern "C" fn release(memory: *mut c_void) {
    // SAFETY: by the contract of this function.
    unsafe { libc::free(memory) }
}

impl Instance {
    pub(super) fn new(loaded: Arc<Loaded>, name: &str) -> Result<Self, Error> {
        let text = |text: &str| CString::new(text).map_err(|_| Error::InstanceName { name: text.to_owned() });
        let (c_name, guid) = (text(name)?, text(&loaded.description.guid)?);
        let resources = text(&loaded.folder.resources())?;
        let log = Rc::new(Log::new());
        let callbacks = Rc::new(c::Callbacks {
            logger: log::fmu_build_log,
            allocate_memory: allocate,
            free_memory: release,
            step_finished: None,
            component_environment: Rc::as_ptr(&log).cast_mut().cast(),
        });
        // SAFETY: the strings end with zero bytes, and live through the call; the callbacks and the log
        // they point to live as long as the instance.
        let component = unsafe {
            (loaded.functions.instantiate)(
                c_name.as_ptr(),
                c::CO_SIMULATION,
                guid.as_ptr(),
                resources.as_ptr(),
                Rc::as_ptr(&callbacks),
                INVISIBLE,
                LOGGING_ON,
            )
        };
        let name = name.to_owned();
        match NonNull::new(component) {
            Some(component) => Ok(Self {
                name,
                component,
                loaded,
                log,
                _callbacks: callbacks,
                saved: std::ptr::null_mut(),
                dead: false,
            }),
            None => Err(Error::Instantiate { unit: name, messages: log.drain() }),
        }
    }

    /// Name of the instance.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What the model description says.
    #[must_use]
    pub fn description(&self) -> &Description {
        &self.loaded.description
    }

    /// What the unit logged since this was last asked, warnings for instance.
    #[must_use]
    pub fn messages(&self) -> Vec<Message> {
        self.log.drain()
    }

    /// Tells the time of the run and enters initialization mode.
    ///
    /// # Errors
    /// If the unit refuses.
    pub fn enter_initialization(&mut self, start: f64, stop: f64) -> Result<(), Error> {
        self.call("fmi2SetupExperiment", |f, c| unsafe { (f.setup_experiment)(c, FALSE, 0.0, start, TRUE, stop) })?;
        self.call("fmi2EnterInitializationMode", |f, c| unsafe { (f.enter_initialization)(c) })
    }

    /// Leaves initialization mode: the unit is ready for its first step.
    ///
    /// # Errors
    /// If the unit refuses, for instance because its parameters do not go together.
    pub fn exit_initialization(&mut self) -> Result<(), Error> {
        self.call("fmi2ExitInitializationMode", |f, c| unsafe { (f.exit_initialization)(c) })
    }

    /// Enters and leaves initialization mode: for units with nothing to be set in between.
    ///
    /// # Errors
    /// If the unit refuses.
    pub fn initialize(&mut self, start: f64, stop: f64) -> Result<(), Error> {
        self.enter_initialization(start, stop)?;
        self.exit_initialization()
    }

    /// Advances from `time` by `step`.
    ///
    /// # Errors
    /// If the unit cannot.
    #[inline]
    pub fn do_step(&mut self, time: f64, step: f64) -> Result<(), Error> {
        self.call("fmi2DoStep", |f, c| unsafe { (f.do_step)(c, time, step, TRUE) })
    }

    /// Ends the run.
    ///
    /// # Errors
    /// If the unit refuses.
    pub fn terminate(&mut self) -> Result<(), Error> {
        self.call("fmi2Terminate", |f, c| unsafe { (f.terminate)(c) })
    }

    /// Goes back to where the instance was when it was new.
    ///
    /// # Errors
    /// If the unit refuses.
    pub fn reset(&mut self) -> Result<(), Error> {
        self.call("fmi2Reset", |f, c| unsafe { (f.reset)(c) })
    }

    /// Reads the selected variables.
    ///
    /// # Errors
    /// If the unit refuses.
    #[inline]
    pub fn get(&mut self, selection: &Selection, values: &mut Values) -> Result<(), Error> {
        let (reals, integers, booleans) =
            (self.functions().get_real, self.functions().get_integer, self.functions().get_boolean);
        self.read("fmi2GetReal", reals, &selection.reals, &mut values.reals)?;
        self.read("fmi2GetInteger", integers, &selection.integers, &mut values.integers)?;
        self.read("fmi2GetBoolean", booleans, &selection.booleans, &mut values.booleans)
    }

    /// Sets the selected variables.
    ///
    /// # Errors
    /// If the unit refuses.
    #[inline]
    pub fn set(&mut self, selection: &Selection, values: &Values) -> Result<(), Error> {
        let (reals, integers, booleans) =
            (self.functions().set_real, self.functions().set_integer, self.functions().set_boolean);
        self.write("fmi2SetReal", reals, &selection.reals, &values.reals)?;
        self.write("fmi2SetInteger", integers, &selection.integers, &values.integers)?;
        self.write("fmi2SetBoolean", booleans, &selection.booleans, &values.booleans)
    }

    /// Reads one variable.
    ///
    /// # Errors
    /// If there is none of this name, or the unit refuses.
    pub fn value(&mut self, name: &str) -> Result<Value, Error> {
        let selection = Selection::new(self.description(), [name])?;
        let mut values = selection.values();
        self.get(&selection, &mut values)?;
        selection.value(&values, 0).ok_or_else(|| Error::unknown(self.description(), name))
    }

    /// Sets one variable.
    ///
    /// # Errors
    /// If there is none of this name, it has another type, or the unit refuses.
    pub fn set_value(&mut self, name: &str, value: Value) -> Result<(), Error> {
        self.set_values(&[(name.to_owned(), value)])
    }

    /// Sets variables by name, all at once.
    ///
    /// # Errors
    /// If there is none of one of these names, it has another type, or the unit refuses a value.
    pub fn set_values(&mut self, settings: &[(String, Value)]) -> Result<(), Error> {
        let selection = Selection::new(self.description(), settings.iter().map(|(name, _)| name.as_str()))?;
        let mut values = selection.values();
        for (index, (name, value)) in settings.iter().enumerate() {
            if !selection.put(&mut values, index, *value) {
                return Err(Error::mismatch(self.description(), name, *value));
            }
        }
        self.set(&selection, &values)
    }

    /// Saves the state in the instance; what was saved before is overwritten.
    ///
    /// # Errors
    /// If the unit refuses.
    pub fn save(&mut self) -> Result<(), Error> {
        let mut saved = self.saved;
        let result = self.call("fmi2GetFMUstate", |f, c| unsafe { (f.get_state)(c, &raw mut saved) });
        self.saved = saved;
        result
    }

    /// Goes back to the state that was saved last.
    ///
    /// # Errors
    /// If the unit refuses, as it does when nothing was saved.
    pub fn restore(&mut self) -> Result<(), Error> {
        let saved = self.saved;
        self.call("fmi2SetFMUstate", |f, c| unsafe { (f.set_state)(c, saved) })
    }

    /// The state that was saved last, as bytes.
    ///
    /// # Errors
    /// If the unit refuses, as it does when nothing was saved.
    pub fn saved_bytes(&mut self) -> Result<Vec<u8>, Error> {
        let (saved, mut size) = (self.saved, 0);
        self.call("fmi2SerializedFMUstateSize", |f, c| unsafe { (f.state_size)(c, saved, &raw mut size) })?;
        let mut bytes = vec![0_u8; size];
        let place = bytes.as_mut_ptr().cast();
        self.call("fmi2SerializeFMUstate", |f, c| unsafe { (f.serialize)(c, saved, place, size) })?;
        Ok(bytes)
    }

    /// Takes a state from bytes for the saved one.
    ///
    /// # Errors
    /// If the unit refuses, for instance because the bytes are not a state of it.
    pub fn save_bytes(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let (mut saved, from) = (self.saved, bytes.as_ptr().cast());
        let result = self
            .call("fmi2DeSerializeFMUstate", |f, c| unsafe { (f.deserialize)(c, from, bytes.len(), &raw mut saved) });
        self.saved = saved;
        result
    }

    fn functions(&self) -> &c::Functions {
        &self.loaded.functions
    }

    #[inline]
    fn read<T>(
        &mut self,
        call: &'static str,
        function: unsafe extern "C" fn(c::Component, *const u32, usize, *mut T) -> c_int,
        references: &[u32],
        values: &mut [T],
    ) -> Result<(), Error> {
        let count = references.len().min(values.len());
        if count == 0 {
            return Ok(());
        }
        // SAFETY: both arrays hold at least `count` elements.
        self.call(call, |_, component| unsafe { function(component, references.as_ptr(), count, values.as_mut_ptr()) })
    }

    #[inline]
    fn write<T>(
        &mut self,
        call: &'static str,
        function: unsafe extern "C" fn(c::Component, *const u32, usize, *const T) -> c_int,
        references: &[u32],
        values: &[T],
    ) -> Result<(), Error> {
        let count = references.len().min(values.len());
        if count == 0 {
            return Ok(());
        }
        // SAFETY: both arrays hold at least `count` elements.
        self.call(call, |_, component| unsafe { function(component, references.as_ptr(), count, values.as_ptr()) })
    }

    /// Calls a function of the library with the component, which is alive: it is freed on drop only. So
    /// calls that take nothing but numbers are safe.
    #[inline]
    fn call(
        &mut self,
        call: &'static str,
        function: impl FnOnce(&c::Functions, c::Component) -> c_int,
    ) -> Result<(), Error> {
        let status =
            if self.dead { Status::Fatal } else { function(&self.loaded.functions, self.component.as_ptr()).into() };
        if matches!(status, Status::Ok | Status::Warning) { Ok(()) } else { Err(self.failure(call, status)) }
    }

    /// What the unit has to say about a call that went wrong.
    #[cold]
    fn failure(&mut self, call: &'static str, status: Status) -> Error {
        self.dead = status == Status::Fatal;
        let mut messages = self.log.drain();
        if messages.iter().any(Message::is_failure) {
            messages.retain(Message::is_failure);
        }
        Error::Call { unit: self.name.clone(), call, status, messages }
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        if !self.dead {
            // SAFETY: the component is alive, the state is one of its own or null, and nobody can use either after
            // this.
            unsafe {
                if !self.saved.is_null() {
                    (self.loaded.functions.free_state)(self.component.as_ptr(), &raw mut self.saved);
                }
                (self.loaded.functions.free_instance)(self.component.as_ptr());
            }
        }
    }
}
