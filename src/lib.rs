//! Simulation and control of aerial manipulators as FMI 2.0 co-simulation units.
//!
//! A multicopter in hover carries an arm in a vertical plane. [`controller`](units::controller)
//! plans joint rates by inverse kinematics that predicts how the base reacts; the
//! [`plant`](units::plant) is the multibody system itself.
//!
//! Modules know only what stands above them in this list:
//!
//! ```text
//! bytes        what a snapshot of a simulation holds
//! variables    named data: options, units of measure, tables
//! reference    wanted motions
//! autopilot    hover control
//! parameters   all that a user sets, with start values
//! mechanics    vehicle, kinematics, momentum, laws of motion
//! plant        the multibody system        control      the inverse kinematics, with its quadratic program
//! fmi          co-simulation units of any model, by version of the standard
//! units        plant and controller as such units: their variables
//! coupling     both of them, or any others, in the hands of a master
//! scenarios    named runs, and the files that hold them
//! ```
//!
//! Results are the same bits on every platform: no mathematics of the platform is used but square roots, which are exact.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod autopilot;
pub mod bytes;
pub mod control;
pub mod coupling;
pub mod error;
pub mod fmi;
pub mod mechanics;
pub mod parameters;
pub mod plant;
pub mod reference;
#[cfg(feature = "scenarios")]
pub mod scenarios;
pub mod units;
pub mod variables;

pub use error::{Error, Result};
pub use parameters::{Parameters, Structure};
