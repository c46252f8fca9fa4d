//! Pointers from the host, checked as far as they can be, as Rust references.

use std::borrow::Cow;
use std::ffi::CStr;
use std::slice;

use super::c_types::{Byte, Text};
use super::error::Error;

/// Most elements of a list. Hosts may name a variable more than once, and give more room than is needed; a
/// length beyond this is a mistake, and believing it would mean to read whatever lies there.
pub const MOST_ELEMENTS: usize = 1 << 16;

/// Most bytes of a state, for which hosts may keep as much room as they like: a length beyond this is a mistake.
pub const MOST_BYTES: usize = 1 << 30;

/// The `count` elements at `data`. Nothing is read if `count` is 0.
///
/// # Errors
/// If there are more than [`MOST_ELEMENTS`], or the pointer is null or not aligned.
///
/// # Safety
/// A pointer that is neither null nor misaligned must be good for `count` elements.
#[inline]
pub unsafe fn list<'a, T>(argument: &'static str, data: *const T, count: usize) -> Result<&'a [T], Error> {
    if count == 0 {
        return Ok(&[]);
    }
    check(argument, data, count, MOST_ELEMENTS)?;
    // SAFETY: promised by the caller; [`MOST_ELEMENTS`] is far below what a slice may span.
    Ok(unsafe { slice::from_raw_parts(data, count) })
}

/// The `count` elements at `data`, to be written; otherwise like [`list`].
///
/// # Errors
/// Like [`list`].
///
/// # Safety
/// Like [`list`], and nothing else may use the elements during the call.
#[inline]
pub unsafe fn list_mut<'a, T>(argument: &'static str, data: *mut T, count: usize) -> Result<&'a mut [T], Error> {
    if count == 0 {
        return Ok(&mut []);
    }
    check(argument, data, count, MOST_ELEMENTS)?;
    // SAFETY: promised by the caller; [`MOST_ELEMENTS`] is far below what a slice may span.
    Ok(unsafe { slice::from_raw_parts_mut(data, count) })
}

/// The `count` bytes at `data`; otherwise like [`list`].
///
/// # Errors
/// Like [`list`], with [`MOST_BYTES`].
///
/// # Safety
/// Like [`list`].
pub unsafe fn bytes<'a>(argument: &'static str, data: *const Byte, count: usize) -> Result<&'a [u8], Error> {
    if count == 0 {
        return Ok(&[]);
    }
    check(argument, data, count, MOST_BYTES)?;
    // SAFETY: promised by the caller; [`MOST_BYTES`] is below what a slice may span.
    Ok(unsafe { slice::from_raw_parts(data.cast(), count) })
}

/// The `count` bytes at `data`, to be written; otherwise like [`bytes`].
///
/// # Errors
/// Like [`bytes`].
///
/// # Safety
/// Like [`list_mut`].
pub unsafe fn bytes_mut<'a>(argument: &'static str, data: *mut Byte, count: usize) -> Result<&'a mut [u8], Error> {
    if count == 0 {
        return Ok(&mut []);
    }
    check(argument, data, count, MOST_BYTES)?;
    // SAFETY: promised by the caller; [`MOST_BYTES`] is below what a slice may span.
    Ok(unsafe { slice::from_raw_parts_mut(data.cast(), count) })
}

#[inline]
fn check<T>(argument: &'static str, data: *const T, count: usize, most: usize) -> Result<(), Error> {
    if count <= most && !data.is_null() && data.is_aligned() { Ok(()) } else { Err(no_list(argument, count, most)) }
}

/// Why that is no list.
#[cold]
fn no_list(argument: &'static str, count: usize, most: usize) -> Error {
    if count <= most {
        return Error::Pointer { argument };
    }
    Error::Argument {
        argument,
        expected: format!("a list of at most {most} elements"),
        found: format!("one of {count}"),
    }
}

/// The place at which the host wants an answer.
///
/// # Errors
/// If the pointer is null or not aligned.
///
/// # Safety
/// Otherwise it must be good for writing.
pub unsafe fn place<'a, T>(argument: &'static str, data: *mut T) -> Result<&'a mut T, Error> {
    if data.is_null() || !data.is_aligned() {
        return Err(Error::Pointer { argument });
    }
    // SAFETY: promised by the caller.
    Ok(unsafe { &mut *data })
}

/// A copy of a structure of the host.
///
/// # Errors
/// If the pointer is null or not aligned.
///
/// # Safety
/// Otherwise it must be good for reading.
pub unsafe fn copy<T: Copy>(argument: &'static str, data: *const T) -> Result<T, Error> {
    if data.is_null() || !data.is_aligned() {
        return Err(Error::Pointer { argument });
    }
    // SAFETY: promised by the caller.
    Ok(unsafe { *data })
}

/// A text of the host; what is no UTF-8 in it is replaced.
///
/// # Errors
/// If the pointer is null.
///
/// # Safety
/// Otherwise it must point to a text with a zero at its end.
pub unsafe fn text<'a>(argument: &'static str, data: Text) -> Result<Cow<'a, str>, Error> {
    if data.is_null() {
        return Err(Error::Pointer { argument });
    }
    // SAFETY: promised by the caller.
    Ok(unsafe { CStr::from_ptr(data) }.to_string_lossy())
}
