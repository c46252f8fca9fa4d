//! The functions of FMI 2.0 co-simulation that a fixed-step master calls, with their C types.

use std::ffi::{c_char, c_double, c_int, c_uint, c_void};

use super::Error;

/// `fmi2Component`.
pub type Component = *mut c_void;
/// `fmi2FMUstate`.
pub type State = *mut c_void;
/// `fmi2CoSimulation`, an item of `fmi2Type`.
pub const CO_SIMULATION: c_int = 1;

/// `fmi2CallbackFunctions`.
#[repr(C)]
pub struct Callbacks {
    pub logger: unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char, ...),
    pub allocate_memory: unsafe extern "C" fn(usize, usize) -> *mut c_void,
    pub free_memory: unsafe extern "C" fn(*mut c_void),
    pub step_finished: Option<unsafe extern "C" fn(*mut c_void, c_int)>,
    pub component_environment: *mut c_void,
}

/// Declares the table of functions, and how it is read from a library.
macro_rules! functions {
    ($($field:ident = $symbol:literal: fn($($argument:ty),*) -> $result:ty;)+) => {
        /// The functions of one library, which stays loaded as long as they live.
        #[derive(Debug)]
        pub struct Functions {
            $(pub $field: unsafe extern "C" fn($($argument),*) -> $result,)+
            _library: libloading::Library,
        }

        impl Functions {
            /// Loads the library and looks up all functions.
            pub fn load(path: &std::path::Path) -> Result<Self, Error> {
                let failed = |library: String| move |source| Error::Library { library, source };
                // SAFETY: running a library's initializers is what importing an FMU means.
                let library =
                    unsafe { libloading::Library::new(path) }.map_err(failed(path.display().to_string()))?;
                Ok(Self {
                    $($field: {
                        // SAFETY: FMI 2.0 fixes the signature of every function by its name.
                        let symbol = unsafe { library.get($symbol) };
                        *symbol.map_err(failed(format!("{} of {}", $symbol, path.display())))?
                    },)+
                    _library: library,
                })
            }
        }
    };
}

functions! {
    instantiate = "fmi2Instantiate":
        fn(*const c_char, c_int, *const c_char, *const c_char, *const Callbacks, c_int, c_int) -> Component;
    free_instance = "fmi2FreeInstance": fn(Component) -> ();
    setup_experiment = "fmi2SetupExperiment": fn(Component, c_int, c_double, c_double, c_int, c_double) -> c_int;
    enter_initialization = "fmi2EnterInitializationMode": fn(Component) -> c_int;
    exit_initialization = "fmi2ExitInitializationMode": fn(Component) -> c_int;
    terminate = "fmi2Terminate": fn(Component) -> c_int;
    reset = "fmi2Reset": fn(Component) -> c_int;
    do_step = "fmi2DoStep": fn(Component, c_double, c_double, c_int) -> c_int;
    get_real = "fmi2GetReal": fn(Component, *const c_uint, usize, *mut c_double) -> c_int;
    get_integer = "fmi2GetInteger": fn(Component, *const c_uint, usize, *mut c_int) -> c_int;
    get_boolean = "fmi2GetBoolean": fn(Component, *const c_uint, usize, *mut c_int) -> c_int;
    set_real = "fmi2SetReal": fn(Component, *const c_uint, usize, *const c_double) -> c_int;
    set_integer = "fmi2SetInteger": fn(Component, *const c_uint, usize, *const c_int) -> c_int;
    set_boolean = "fmi2SetBoolean": fn(Component, *const c_uint, usize, *const c_int) -> c_int;
    get_state = "fmi2GetFMUstate": fn(Component, *mut State) -> c_int;
    set_state = "fmi2SetFMUstate": fn(Component, State) -> c_int;
    free_state = "fmi2FreeFMUstate": fn(Component, *mut State) -> c_int;
    state_size = "fmi2SerializedFMUstateSize": fn(Component, State, *mut usize) -> c_int;
    serialize = "fmi2SerializeFMUstate": fn(Component, State, *mut c_char, usize) -> c_int;
    deserialize = "fmi2DeSerializeFMUstate": fn(Component, *const c_char, usize, *mut State) -> c_int;
}
