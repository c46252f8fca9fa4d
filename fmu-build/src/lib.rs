//! Turns the two units into files, loads these back, couples them, and reports what happened.
//!
//! Rooms know only what stands above them in this list:
//!
//! ```text
//! error, files, workspace, platform, formats     what all others need
//! compile    the units' libraries: for this machine from inside the program, for others out of sources
//! package    FMUs and SSPs: descriptions, pages, archives
//! host       FMUs loaded, coupled, run and recorded
//! study      many runs: beside the thesis, with other numbers, with other steps; vehicles before they run
//! report     what came out, as a page
//! ```
//!
//! [`build`] writes FMUs, and an SSP that holds both.

pub mod compile;
pub mod error;
pub mod files;
mod formats;
pub mod host;
pub mod package;
pub mod platform;
pub mod report;
pub mod study;
pub mod workspace;

pub use error::{Error, Result};
pub use package::build::{BuildOptions, Built, build, write_descriptions};
pub use package::design::Design;
