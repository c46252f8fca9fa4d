//! The two units as the host sees them: their variables, and the glue between these and the mechanics.

pub mod controller;
pub mod plant;

use crate::unit;
use crate::variables::{Bounds, Causality, Table, Variability};

/// Version of names, meanings and order of the variables; part of every unit's identity.
pub const INTERFACE_VERSION: u32 = 1;

/// Declares the independent variable.
fn declare_time<D>(table: &mut Table<D>, at: fn(&mut D, usize) -> &mut f64) {
    table.group(Causality::Independent, Variability::Continuous).real(
        "time",
        &unit::SECOND,
        Bounds::ANY,
        "Simulation time",
        at,
    );
}
