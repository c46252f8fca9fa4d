//! Values as bytes and back, exactly: every bit of a number survives, whatever it stands for.
//!
//! What is written is not readable without knowing its type; who keeps bytes adds what tells them from
//! others.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::Result;

pub mod array;

/// Something that changes in the course of a run and whose future depends on more than its parameters.
pub trait Memory {
    /// Appends to `bytes` all that does not follow from the parameters.
    ///
    /// # Errors
    /// Never, for what this library remembers.
    fn save(&self, bytes: &mut Vec<u8>) -> Result<()>;

    /// Takes back what [`Memory::save`] of one with the same structure and parameters wrote, off the
    /// front of `bytes`; after an error it is not to be used.
    ///
    /// # Errors
    /// If the bytes are too few, or what they say cannot be.
    fn restore(&mut self, bytes: &mut &[u8]) -> Result<()>;
}

/// Appends a value.
///
/// # Errors
/// If the type cannot be written; those of this library can.
pub fn write<T: Serialize + ?Sized>(value: &T, bytes: &mut Vec<u8>) -> Result<()> {
    *bytes = postcard::to_extend(value, std::mem::take(bytes))?;
    Ok(())
}

/// Takes a value off the front of `bytes`.
///
/// # Errors
/// If they are too few or say something else.
pub fn read<T: DeserializeOwned>(bytes: &mut &[u8]) -> Result<T> {
    let (value, rest) = postcard::take_from_bytes(bytes)?;
    *bytes = rest;
    Ok(value)
}
