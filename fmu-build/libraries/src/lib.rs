//! The libraries of both units inside the program, and how they are compiled.
//!
//! A release build holds them for the machine that it is itself for, and so needs neither cargo nor sources to make FMUs
//! for it. Other builds hold none.

pub mod nested;

/// By the names of the units.
static LIBRARIES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/libraries.rs"));

/// The library of a unit, if this build holds it.
#[must_use]
pub fn held(unit: &str) -> Option<&'static [u8]> {
    LIBRARIES.iter().find(|(name, _)| *name == unit).map(|(_, library)| *library)
}
