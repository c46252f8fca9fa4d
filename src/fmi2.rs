//! FMI 2.0 co-simulation for any type that implements [`Model`]: the C interface, the standard's state
//! machine, logging, and the identity (GUID) of a unit. Knows nothing of mechanics.
//!
//! ```text
//! export      names in C, by the macro export_fmi2!
//! calls       pointers in, status out            (unsafe)
//! component   handle, panics, error messages     (unsafe)
//! environment the processor as calls want it      (unsafe)
//! instance    semantics of each call             (safe)
//! model       what a simulation must offer
//! ```

pub mod arguments;
pub mod c_types;
pub mod calls;
pub mod capabilities;
pub mod component;
pub mod environment;
pub mod error;
mod export;
pub mod hash;
pub mod identity;
pub mod instance;
mod location;
pub mod logger;
pub mod model;
pub mod naming;
pub mod panics;
pub mod start_file;
pub mod state;
pub mod states;

pub use capabilities::Capabilities;
pub use error::Error;
pub use identity::{Guid, Identity};
pub use instance::Instance;
pub use model::{CommunicationStep, Model};
pub use naming::Naming;

#[cfg(test)]
mod toy;
