//! All functions of FMI 2.0 co-simulation with their C types, as the standard's header declares them.

use std::ffi::{c_char, c_double, c_int, c_uint, c_void};
use std::path::Path;

use libloading::Library;

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
    ($($field:ident = $symbol:literal($($argument:ty),*) $(-> $result:ty)?;)+) => {
        /// The functions of one library.
        pub struct Functions {
            $(#[doc = concat!("`", stringify!($symbol), "`")] pub $field: unsafe extern "C" fn($($argument),*) $(-> $result)?,)+
            _library: Library,
        }

        impl Functions {
            /// Loads a library and looks all functions up.
            ///
            /// # Errors
            /// If it cannot be loaded, or a function is missing.
            pub fn load(path: &Path) -> Result<Self, libloading::Error> {
                let library = open(path)?;
                Ok(Self {
                    // SAFETY: the standard fixes the type of every function by its name.
                    $($field: *unsafe { library.get($symbol) }?,)+
                    _library: library,
                })
            }
        }
    };
}

functions! {
    instantiate = "fmi2Instantiate"(Text, c_int, Text, Text, *const Callbacks, c_int, c_int) -> Component;
    free_instance = "fmi2FreeInstance"(Component);
    set_debug_logging = "fmi2SetDebugLogging"(Component, c_int, usize, *const Text) -> c_int;
    setup_experiment = "fmi2SetupExperiment"(Component, c_int, c_double, c_double, c_int, c_double) -> c_int;
    enter_initialization = "fmi2EnterInitializationMode"(Component) -> c_int;
    exit_initialization = "fmi2ExitInitializationMode"(Component) -> c_int;
    terminate = "fmi2Terminate"(Component) -> c_int;
    reset = "fmi2Reset"(Component) -> c_int;
    get_real = "fmi2GetReal"(Component, *const c_uint, usize, *mut c_double) -> c_int;
    get_integer = "fmi2GetInteger"(Component, *const c_uint, usize, *mut c_int) -> c_int;
    get_boolean = "fmi2GetBoolean"(Component, *const c_uint, usize, *mut c_int) -> c_int;
    get_string = "fmi2GetString"(Component, *const c_uint, usize, *mut Text) -> c_int;
    set_real = "fmi2SetReal"(Component, *const c_uint, usize, *const c_double) -> c_int;
    set_integer = "fmi2SetInteger"(Component, *const c_uint, usize, *const c_int) -> c_int;
    set_boolean = "fmi2SetBoolean"(Component, *const c_uint, usize, *const c_int) -> c_int;
    set_string = "fmi2SetString"(Component, *const c_uint, usize, *const Text) -> c_int;
    do_step = "fmi2DoStep"(Component, c_double, c_double, c_int) -> c_int;
    cancel_step = "fmi2CancelStep"(Component) -> c_int;
    get_status = "fmi2GetStatus"(Component, c_int, *mut c_int) -> c_int;
    get_real_status = "fmi2GetRealStatus"(Component, c_int, *mut c_double) -> c_int;
    get_integer_status = "fmi2GetIntegerStatus"(Component, c_int, *mut c_int) -> c_int;
    get_boolean_status = "fmi2GetBooleanStatus"(Component, c_int, *mut c_int) -> c_int;
    get_string_status = "fmi2GetStringStatus"(Component, c_int, *mut Text) -> c_int;
    set_input_derivatives = "fmi2SetRealInputDerivatives"(Component, *const c_uint, usize, *const c_int, *const c_double) -> c_int;
    get_output_derivatives = "fmi2GetRealOutputDerivatives"(Component, *const c_uint, usize, *const c_int, *mut c_double) -> c_int;
    get_directional_derivative = "fmi2GetDirectionalDerivative"(Component, *const c_uint, usize, *const c_uint, usize, *const c_double, *mut c_double) -> c_int;
    get_state = "fmi2GetFMUstate"(Component, *mut State) -> c_int;
    set_state = "fmi2SetFMUstate"(Component, State) -> c_int;
    free_state = "fmi2FreeFMUstate"(Component, *mut State) -> c_int;
    state_size = "fmi2SerializedFMUstateSize"(Component, State, *mut usize) -> c_int;
    serialize_state = "fmi2SerializeFMUstate"(Component, State, *mut c_char, usize) -> c_int;
    deserialize_state = "fmi2DeSerializeFMUstate"(Component, *const c_char, usize, *mut State) -> c_int;
}
