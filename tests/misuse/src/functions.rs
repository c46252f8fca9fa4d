//! All functions of FMI 2.0 co-simulation with their C types, as the standard's header declares them.

use std::ffi::{c_char, c_double, c_int, c_uint, c_void};
use std::path::Path;

use libloading::Library;

use crate::environment;

/// `fmi2Component`.
pub type Component = *mut c_void;
/// `fmi2FMUstate`.
pub type State = *mut c_void;
/// `fmi2String`.
pub type Text = *const c_char;

/// `fmi2OK`.
pub const OK: c_int = 0;
/// `fmi2Error`.
pub const ERROR: c_int = 3;

/// `fmi2CallbackFunctions`. The logger is variadic in C; see [`crate::host`].
#[repr(C)]
pub struct Callbacks {
    /// Takes messages.
    pub logger: *const c_void,
    /// Allocation, release, and the end of a step.
    pub memory_and_step: [*const c_void; 3],
    /// Handed back to all of them.
    pub environment: *mut c_void,
}

/// Opens a library so that its symbols are visible to whatever is loaded later, as some hosts do.
#[cfg(unix)]
fn open(path: &Path) -> Result<Library, libloading::Error> {
    use libloading::os::unix::{Library, RTLD_GLOBAL, RTLD_NOW};
    // SAFETY: the library does nothing when it is loaded.
    unsafe { Library::open(Some(path), RTLD_NOW | RTLD_GLOBAL) }.map(Into::into)
}

#[cfg(not(unix))]
fn open(path: &Path) -> Result<Library, libloading::Error> {
    // SAFETY: the library does nothing when it is loaded.
    unsafe { Library::new(path) }
}

macro_rules! functions {
    ($($function:ident = $symbol:literal($($argument:ident: $type:ty),*) $(-> $result:ty)?;)+) => {
        /// The functions of one library.
        pub struct Functions {
            $($function: unsafe extern "C" fn($($type),*) $(-> $result)?,)+
            _library: Library,
        }

        // SAFETY, for all functions: what the standard asks of hosts is what they ask of their callers.
        #[allow(clippy::missing_safety_doc, clippy::too_many_arguments, reason = "as the standard has them")]
        impl Functions {
            /// Loads a library and looks all functions up.
            ///
            /// # Errors
            /// If it cannot be loaded, or a function is missing.
            pub fn load(path: &Path) -> Result<Self, libloading::Error> {
                let library = open(path)?;
                Ok(Self {
                    // SAFETY: the standard fixes the type of every function by its name.
                    $($function: *unsafe { library.get($symbol) }?,)+
                    _library: library,
                })
            }

            $(
                #[doc = concat!("Calls `", $symbol, "` in the floating-point environment of the host.")]
                pub unsafe fn $function(&self, $($argument: $type),*) $(-> $result)? {
                    environment::call($symbol, || unsafe { (self.$function)($($argument),*) })
                }
            )+
        }
    };
}

functions! {
    instantiate = "fmi2Instantiate"(a: Text, b: c_int, c: Text, d: Text, e: *const Callbacks, f: c_int, g: c_int) -> Component;
    free_instance = "fmi2FreeInstance"(a: Component);
    set_debug_logging = "fmi2SetDebugLogging"(a: Component, b: c_int, c: usize, d: *const Text) -> c_int;
    setup_experiment = "fmi2SetupExperiment"(a: Component, b: c_int, c: c_double, d: c_double, e: c_int, f: c_double) -> c_int;
    enter_initialization = "fmi2EnterInitializationMode"(a: Component) -> c_int;
    exit_initialization = "fmi2ExitInitializationMode"(a: Component) -> c_int;
    terminate = "fmi2Terminate"(a: Component) -> c_int;
    reset = "fmi2Reset"(a: Component) -> c_int;
    get_real = "fmi2GetReal"(a: Component, b: *const c_uint, c: usize, d: *mut c_double) -> c_int;
    get_integer = "fmi2GetInteger"(a: Component, b: *const c_uint, c: usize, d: *mut c_int) -> c_int;
    get_boolean = "fmi2GetBoolean"(a: Component, b: *const c_uint, c: usize, d: *mut c_int) -> c_int;
    get_string = "fmi2GetString"(a: Component, b: *const c_uint, c: usize, d: *mut Text) -> c_int;
    set_real = "fmi2SetReal"(a: Component, b: *const c_uint, c: usize, d: *const c_double) -> c_int;
    set_integer = "fmi2SetInteger"(a: Component, b: *const c_uint, c: usize, d: *const c_int) -> c_int;
    set_boolean = "fmi2SetBoolean"(a: Component, b: *const c_uint, c: usize, d: *const c_int) -> c_int;
    set_string = "fmi2SetString"(a: Component, b: *const c_uint, c: usize, d: *const Text) -> c_int;
    do_step = "fmi2DoStep"(a: Component, b: c_double, c: c_double, d: c_int) -> c_int;
    cancel_step = "fmi2CancelStep"(a: Component) -> c_int;
    get_status = "fmi2GetStatus"(a: Component, b: c_int, c: *mut c_int) -> c_int;
    get_real_status = "fmi2GetRealStatus"(a: Component, b: c_int, c: *mut c_double) -> c_int;
    get_integer_status = "fmi2GetIntegerStatus"(a: Component, b: c_int, c: *mut c_int) -> c_int;
    get_boolean_status = "fmi2GetBooleanStatus"(a: Component, b: c_int, c: *mut c_int) -> c_int;
    get_string_status = "fmi2GetStringStatus"(a: Component, b: c_int, c: *mut Text) -> c_int;
    set_input_derivatives = "fmi2SetRealInputDerivatives"(a: Component, b: *const c_uint, c: usize, d: *const c_int, e: *const c_double) -> c_int;
    get_output_derivatives = "fmi2GetRealOutputDerivatives"(a: Component, b: *const c_uint, c: usize, d: *const c_int, e: *mut c_double) -> c_int;
    get_directional_derivative = "fmi2GetDirectionalDerivative"(a: Component, b: *const c_uint, c: usize, d: *const c_uint, e: usize, f: *const c_double, g: *mut c_double) -> c_int;
    get_state = "fmi2GetFMUstate"(a: Component, b: *mut State) -> c_int;
    set_state = "fmi2SetFMUstate"(a: Component, b: State) -> c_int;
    free_state = "fmi2FreeFMUstate"(a: Component, b: *mut State) -> c_int;
    state_size = "fmi2SerializedFMUstateSize"(a: Component, b: State, c: *mut usize) -> c_int;
    serialize_state = "fmi2SerializeFMUstate"(a: Component, b: State, c: *mut c_char, d: usize) -> c_int;
    deserialize_state = "fmi2DeSerializeFMUstate"(a: Component, b: *const c_char, c: usize, d: *mut State) -> c_int;
}
