//! Collects what a unit says through the logger callback.

use std::ffi::{CStr, c_char, c_int, c_void};
use std::sync::{Mutex, PoisonError};

use super::Status;

/// One call of the logger.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// How serious.
    pub status: Status,
    /// Log category of the model description.
    pub category: String,
    /// The text, with its arguments filled in.
    pub text: String,
}

impl Message {
    /// Whether this is about something that did not work.
    #[must_use]
    pub fn is_failure(&self) -> bool {
        matches!(self.status, Status::Discard | Status::Error | Status::Fatal)
    }
}

/// Most messages kept of a talkative unit; the oldest go.
const CAPACITY: usize = 100;

/// Where the logger callback puts messages. Its address is the callbacks' `componentEnvironment`.
#[repr(C)]
pub struct Log {
    /// Called by logger.c, which knows this field only.
    take: unsafe extern "C" fn(*mut Self, c_int, *const c_char, *const c_char),
    /// A unit may log from threads of its own.
    messages: Mutex<Vec<Message>>,
}

unsafe extern "C" {
    /// The callback itself: variadic, hence in C.
    pub fn fmu_build_log(
        environment: *mut c_void,
        instance: *const c_char,
        status: c_int,
        category: *const c_char,
        message: *const c_char,
        ...
    );
}

impl Log {
    pub fn new() -> Self {
        Self { take, messages: Mutex::new(Vec::new()) }
    }

    /// The messages since the last call.
    pub fn drain(&self) -> Vec<Message> {
        std::mem::take(&mut *self.messages.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// # Safety
/// `log` points to a living `Log`; the strings are null or end with a zero byte.
unsafe extern "C" fn take(log: *mut Log, status: c_int, category: *const c_char, text: *const c_char) {
    // SAFETY: logger.c hands over the environment it was given, which `Instance` keeps alive.
    let log = unsafe { &*log };
    let owned = |text: *const c_char| {
        if text.is_null() {
            return String::new();
        }
        // SAFETY: not null, and ends with a zero byte by contract.
        unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned()
    };
    let message = Message { status: Status::from(status), category: owned(category), text: owned(text) };
    let mut messages = log.messages.lock().unwrap_or_else(PoisonError::into_inner);
    if messages.len() == CAPACITY {
        messages.remove(0);
    }
    messages.push(message);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_formatted_and_null_is_harmless() {
        let log = Log::new();
        let environment = (&raw const log).cast_mut().cast();
        unsafe {
            fmu_build_log(
                environment,
                c"unit".as_ptr(),
                3,
                c"logStatusError".as_ptr(),
                c"%s = %d".as_ptr(),
                c"a".as_ptr(),
                7,
            );
            fmu_build_log(environment, std::ptr::null(), 0, std::ptr::null(), c"plain".as_ptr());
            fmu_build_log(environment, std::ptr::null(), 0, std::ptr::null(), std::ptr::null());
            fmu_build_log(std::ptr::null_mut(), std::ptr::null(), 0, std::ptr::null(), c"nowhere".as_ptr());
        }
        let messages = log.drain();
        assert_eq!(messages.len(), 2);
        assert_eq!(messages[0].text, "a = 7");
        assert_eq!(messages[0].category, "logStatusError");
        assert_eq!(messages[0].status, Status::Error);
        assert_eq!(messages[1].text, "plain");
        assert!(log.drain().is_empty());
    }
}
