//! The two units as the host sees them: their variables, and the glue between these and the mechanics.

pub mod controller;
mod decisive;
pub mod plant;

/// Version of names, meanings and order of the variables; part of every unit's identity.
pub const INTERFACE_VERSION: u32 = 1;
