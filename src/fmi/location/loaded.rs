//! The path from which the system's loader has loaded this library.

use std::path::PathBuf;

/// The file that holds this code: the library, or the program that it is linked into. `None` where the system does not
/// say, and where there is no loader (WebAssembly).
#[must_use]
pub fn library() -> Option<PathBuf> {
    path()
}

#[cfg(all(unix, not(target_family = "wasm")))]
fn path() -> Option<PathBuf> {
    use std::ffi::{CStr, OsStr};
    use std::mem::MaybeUninit;
    use std::os::unix::ffi::OsStrExt;

    let mut found = MaybeUninit::<libc::Dl_info>::uninit();
    // SAFETY: any address may be asked for, and there is a place for the answer.
    if unsafe { libc::dladdr((path as *const ()).cast(), found.as_mut_ptr()) } == 0 {
        return None;
    }
    // SAFETY: the loader has filled it.
    let name = unsafe { found.assume_init() }.dli_fname;
    if name.is_null() {
        return None;
    }
    // SAFETY: a name of the loader ends with a zero, and lives as long as the library, which is running.
    let name = unsafe { CStr::from_ptr(name) };
    Some(PathBuf::from(OsStr::from_bytes(name.to_bytes())))
}

#[cfg(windows)]
fn path() -> Option<PathBuf> {
    use std::ffi::{OsString, c_void};
    use std::os::windows::ffi::OsStringExt;
    use std::ptr;

    #[link(name = "kernel32")]
    unsafe extern "system" {
        fn GetModuleHandleExW(flags: u32, address: *const c_void, module: *mut *mut c_void) -> i32;
        fn GetModuleFileNameW(module: *mut c_void, name: *mut u16, size: u32) -> u32;
    }
    /// The module is named by an address in it.
    const FROM_ADDRESS: u32 = 4;
    /// And may be unloaded nevertheless.
    const UNCHANGED_REFCOUNT: u32 = 2;
    /// No path is longer.
    const LONGEST_PATH: u32 = 1 << 15;

    let mut module = ptr::null_mut();
    let flags = FROM_ADDRESS | UNCHANGED_REFCOUNT;
    // SAFETY: any address may be asked for, and there is a place for the answer.
    if unsafe { GetModuleHandleExW(flags, (path as *const ()).cast(), &raw mut module) } == 0 {
        return None;
    }
    let mut name = vec![0; LONGEST_PATH as usize];
    // SAFETY: there are so many places for the answer.
    let length = unsafe { GetModuleFileNameW(module, name.as_mut_ptr(), LONGEST_PATH) };
    name.truncate(length as usize);
    (length > 0).then(|| PathBuf::from(OsString::from_wide(&name)))
}

#[cfg(not(any(all(unix, not(target_family = "wasm")), windows)))]
fn path() -> Option<PathBuf> {
    None
}
