//! The two units as the host sees them: their variables, and the glue between these and the mechanics.

pub mod controller;
pub mod plant;
mod start;

use crate::parameters::{Balance, Resolution};
use crate::variables::unit::{self, PhysicalUnit};
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

/// How the variables of what balances the arm are called and measured.
struct Balancing {
    /// First part of their names.
    name: &'static str,
    /// In sentences.
    noun: &'static str,
    /// The resolution that moves it.
    moved_by: Resolution,
    /// What its position is.
    place: &'static str,
    /// What its motor exerts.
    exerted: &'static str,
    /// Last part of the name of that.
    effort: &'static str,
    /// Of position, rate, acceleration and effort.
    units: [&'static PhysicalUnit; 4],
}

impl Balancing {
    fn new(balance: Balance) -> Option<Self> {
        let (name, moved_by) = (balance.prefix()?, balance.moved_by()?);
        match balance {
            Balance::None => None,
            Balance::Counterweight => Some(Self {
                name,
                noun: "counterweight",
                moved_by,
                place: "Position of the counterweight along the UAV's x axis",
                exerted: "Force of the motor of the counterweight on it",
                effort: "force",
                units: [&unit::METRE, &unit::METRE_PER_SECOND, &unit::METRE_PER_SECOND2, &unit::NEWTON],
            }),
            Balance::Element => Some(Self {
                name,
                noun: "balance element",
                moved_by,
                place: "Angle of the balance element in the UAV frame",
                exerted: "Torque of the motor of the balance element on it",
                effort: "torque",
                units: [&unit::RADIAN, &unit::RADIAN_PER_SECOND, &unit::RADIAN_PER_SECOND2, &unit::NEWTON_METRE],
            }),
        }
    }
}
