//! Co-simulation units for any type that implements [`Model`]. Knows nothing of mechanics.
//!
//! Here stands what every version of the standard needs: identity (GUID) and names of a unit, its resources, and the
//! processor as calls want it. [`v2`] is the C interface of FMI 2.0.

pub mod environment;
pub mod hash;
pub mod identity;
mod location;
pub mod model;
pub mod naming;
pub mod panics;
pub mod start_file;
pub mod v2;

pub use identity::{Guid, Identity};
pub use model::{CommunicationStep, Model};
pub use naming::Naming;
