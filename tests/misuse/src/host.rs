//! The host's side of an instance: callbacks, and what the unit says through them.

use std::cell::RefCell;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::path::Path;
use std::ptr;
use std::sync::{PoisonError, RwLock};

use crate::environment;
use crate::functions::Callbacks;

thread_local! {
    /// Number of messages of this thread so far, and the last one.
    static SAID: RefCell<(u64, Vec<u8>)> = const { RefCell::new((0, Vec::new())) };
}

/// Folders whose names are by chance: they are not what a message says.
static FOLDERS: RwLock<Vec<Vec<u8>>> = RwLock::new(Vec::new());

/// From now on, messages that name `folder` count as if it were called FOLDER.
pub fn forget_name(folder: &Path) {
    let name = folder.to_string_lossy().into_owned().into_bytes();
    FOLDERS.write().unwrap_or_else(PoisonError::into_inner).push(name);
}

/// Adds a text to the last message, without names that are by chance.
fn add(last: &mut Vec<u8>, mut text: &[u8]) {
    let folders = FOLDERS.read().unwrap_or_else(PoisonError::into_inner);
    while let Some((&first, rest)) = text.split_first() {
        match folders.iter().find_map(|folder| text.strip_prefix(folder.as_slice())) {
            Some(after) => {
                last.extend(b"FOLDER");
                text = after;
            }
            None => {
                last.push(first);
                text = rest;
            }
        }
    }
    last.push(b'\n');
}

/// A variadic logger cannot be written in stable Rust. This one takes the first variable argument as a fixed
/// one, which the calling conventions of Linux and Windows on x86-64 and of Linux on arm64 pass alike.
extern "C" fn log(
    _: *mut c_void,
    instance: *const c_char,
    _: c_int,
    category: *const c_char,
    format: *const c_char,
    text: *const c_char,
) {
    environment::callback(|| {
        SAID.with_borrow_mut(|(count, last)| {
            *count += 1;
            last.clear();
            for text in [instance, category, format, text] {
                // SAFETY: all texts end with a zero.
                add(last, unsafe { CStr::from_ptr(text) }.to_bytes());
            }
        });
    });
}

/// Callbacks with a logger, and nothing else.
pub fn callbacks() -> Callbacks {
    Callbacks { logger: log as *const c_void, memory_and_step: [ptr::null(); 3], environment: ptr::null_mut() }
}

/// How many messages there have been in this thread.
pub fn messages() -> u64 {
    SAID.with_borrow(|(count, _)| *count)
}

/// The last message of this thread: instance, category, format and text, a line each.
pub fn said() -> String {
    last(|text| String::from_utf8_lossy(text).into_owned())
}

/// Whether it tells of a panic, which nothing may cause.
pub fn panicked() -> bool {
    said().contains("internal error")
}

/// Calls `look` with the bytes of the last message.
pub fn last<R>(look: impl FnOnce(&[u8]) -> R) -> R {
    SAID.with_borrow(|(_, last)| look(last))
}
