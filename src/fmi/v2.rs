//! FMI 2.0 co-simulation: the C interface, the standard's state machine, logging.
//!
//! ```text
//! export      names in C, by the macro export_fmi2!
//! calls       pointers in, status out            (unsafe)
//! component   handle, panics, error messages     (unsafe)
//! instance    semantics of each call             (safe)
//! ```

pub mod arguments;
pub mod c_types;
pub mod calls;
pub mod capabilities;
pub mod component;
pub mod error;
mod export;
pub mod instance;
pub mod logger;
pub mod phase;
pub mod states;

pub use capabilities::Capabilities;
pub use error::Error;
pub use instance::Instance;

#[cfg(test)]
pub(super) mod toy;
