//! A host: its logger, and what it holds of an instance.

use std::sync::Mutex;

use super::*;

pub const OK: c_int = 0;
pub const ERROR: c_int = 3;
pub const TRUE: c_int = 1;

/// The host's callbacks as its own compiler lays them out.
#[repr(C)]
pub struct Callbacks {
    logger: *const c_void,
    others: [*const c_void; 3],
    environment: *mut c_void,
}

impl Callbacks {
    pub fn new(logger: *const c_void, environment: *mut c_void) -> Self {
        Self { logger, others: [null(); 3], environment }
    }
}

/// What a logger receives.
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    pub instance: String,
    pub status: c_int,
    pub category: String,
    pub format: String,
    pub text: String,
}

type Log = Mutex<Vec<Message>>;

/// A variadic logger cannot be written in Rust. This one takes the first variable argument as a fixed
/// one, which the calling conventions of the machines that run the tests pass in the same way.
extern "C" fn record(
    log: *mut c_void,
    instance: *const c_char,
    status: c_int,
    category: *const c_char,
    format: *const c_char,
    text: *const c_char,
) {
    // SAFETY: the environment is the log of a living host, all texts end with a zero.
    unsafe {
        let string = |text| CStr::from_ptr(text).to_str().unwrap().to_owned();
        (*log.cast::<Log>()).lock().unwrap().push(Message {
            instance: string(instance),
            status,
            category: string(category),
            format: string(format),
            text: string(text),
        });
    }
}

pub fn guid() -> CString {
    CString::new(Identity::<Toy>::of(Size::Small).guid().to_string()).unwrap()
}

pub struct Host {
    // In a place of its own: instances keep a pointer to it.
    log: Box<Log>,
}

impl Host {
    pub fn new() -> Self {
        Self { log: Box::default() }
    }

    /// Callbacks that live no longer than the call which gets them.
    pub fn callbacks(&self) -> Box<Callbacks> {
        Box::new(Callbacks::new(record as *const c_void, (&raw const *self.log).cast_mut().cast()))
    }

    pub fn instantiate(&self) -> Component {
        self.instantiate_with(&guid())
    }

    pub fn instantiate_with(&self, guid: &CStr) -> Component {
        let (name, callbacks) = (CString::new("toy instance").unwrap(), self.callbacks());
        // SAFETY: all texts outlive the call.
        let handle = unsafe {
            fmi2Instantiate(name.as_ptr(), 1, guid.as_ptr(), c"file:///nowhere".as_ptr(), &raw const *callbacks, 0, 0)
        };
        assert!(!handle.is_null(), "{:?}", self.messages());
        Component { handle }
    }

    pub fn running(&self) -> Component {
        let component = self.instantiate();
        component.initialize();
        component
    }

    /// An instance that has been brought to a state.
    pub fn at(&self, phase: Phase) -> Component {
        let component = self.instantiate();
        // SAFETY: the handle is good.
        unsafe {
            match phase {
                Phase::Instantiated => {}
                Phase::Initialization => assert_eq!(fmi2EnterInitializationMode(component.handle), OK),
                Phase::Running => component.initialize(),
                Phase::Terminated => {
                    component.initialize();
                    assert_eq!(fmi2Terminate(component.handle), OK);
                }
                Phase::Failed => {
                    component.initialize();
                    component.set_real(&[vr::FAULT], &[2.0]);
                    assert_eq!(component.step(0.0, 1.0), ERROR);
                }
            }
        }
        self.clear();
        component
    }

    pub fn messages(&self) -> Vec<Message> {
        self.log.lock().unwrap().clone()
    }

    pub fn last(&self) -> Message {
        self.messages().pop().expect("a message")
    }

    pub fn clear(&self) {
        self.log.lock().unwrap().clear();
    }
}

/// An instance that is freed in the end.
pub struct Component {
    pub handle: *mut c_void,
}

impl Drop for Component {
    fn drop(&mut self) {
        // SAFETY: the handle is good and not used again.
        unsafe { fmi2FreeInstance(self.handle) }
    }
}

// SAFETY, for all calls: the handle is good, lists have the length that goes with them.
impl Component {
    pub fn initialize(&self) {
        unsafe {
            assert_eq!(fmi2SetupExperiment(self.handle, 0, 0.0, 0.0, 0, 0.0), OK);
            assert_eq!(fmi2EnterInitializationMode(self.handle), OK);
            assert_eq!(fmi2ExitInitializationMode(self.handle), OK);
        }
    }

    pub fn step(&self, from: f64, size: f64) -> c_int {
        unsafe { fmi2DoStep(self.handle, from, size, TRUE) }
    }

    pub fn reset(&self) -> c_int {
        unsafe { fmi2Reset(self.handle) }
    }

    pub fn real(&self, reference: u32) -> f64 {
        let mut value = f64::NAN;
        unsafe { assert_eq!(fmi2GetReal(self.handle, &raw const reference, 1, &raw mut value), OK) };
        value
    }

    pub fn set_real(&self, references: &[u32], values: &[f64]) -> c_int {
        unsafe { fmi2SetReal(self.handle, references.as_ptr(), references.len(), values.as_ptr()) }
    }
}
