//! Turns the two units into files, loads these back, couples them, and reports what happened.
//!
//! [`build`] writes FMUs, and an SSP that holds both; the modules are its steps. [`interface`] takes a
//! unit's table of variables as plain data; [`description`], [`documentation`] and [`ssp`] write what hosts
//! and people read of it; [`compile`] makes the libraries; [`package`] puts all together.
//!
//! [`fmu`] loads units as any master would; [`coupling`] is such a master; [`run`] puts a scenario through
//! it; [`claims`] sets the results beside the thesis, and [`report`] draws them; [`budget`] varies the step.

pub mod archive;
pub mod budget;
mod build;
pub mod claims;
pub mod compile;
pub mod coupling;
pub mod cross;
pub mod description;
pub mod design;
pub mod documentation;
pub mod error;
pub mod files;
pub mod fmu;
mod html;
pub mod interface;
mod markdown;
pub mod metadata;
pub mod package;
pub mod platform;
pub mod reach;
pub mod record;
pub mod report;
pub mod run;
pub mod settings;
pub mod ssp;
pub mod study;
mod terminals;
pub mod text;
pub mod units;
mod universal;
pub mod variation;
pub mod workspace;
mod xml;

pub use build::{BuildOptions, Built, build, write_descriptions};
pub use design::Design;
pub use error::{Error, Result};
