//! Simulation and control of aerial manipulators as FMI 2.0 co-simulation units.
//!
//! A multicopter in hover carries an arm in a vertical plane. [`controller`](interface::controller)
//! plans joint rates by inverse kinematics that predicts how the base reacts; the
//! [`plant`](interface::plant) is the multibody system itself.
//!
//! Modules know only what stands above them in this list:
//! [`options`], [`bytes`], [`unit`], [`variables`] (named data), [`qp`], [`planar`], [`reference`], [`autopilot`],
//! [`parameters`], [`defaults`], [`vehicle`], [`kinematics`], [`momentum`], [`dynamics`], then [`plant`] and
//! [`controller`], and at the end [`fmi2`] and [`interface`], which make units of them. Named runs (`scenarios`) stand
//! beside the units.
//!
//! Results are the same bits on every platform: no mathematics of the platform is used but square roots, which are exact.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod autopilot;
pub mod bytes;
pub mod controller;
mod culprit;
pub mod defaults;
pub mod dynamics;
pub mod error;
pub mod fmi2;
pub mod interface;
pub mod kinematics;
pub mod momentum;
pub mod options;
pub mod parameters;
pub mod planar;
pub mod plant;
pub mod qp;
pub mod reference;
#[cfg(feature = "scenarios")]
pub mod scenarios;
pub mod unit;
pub mod variables;
pub mod vehicle;

pub use error::{Error, Result};
pub use parameters::{Parameters, Structure};
