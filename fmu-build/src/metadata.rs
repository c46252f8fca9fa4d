//! Who made the files, and when a simulation of them begins and ends: written into every product.

use uam::scenarios;

/// Author and copyright holder.
pub const AUTHOR: &str = "The uam authors";
/// Copyright notice.
pub const COPYRIGHT: &str = "Copyright (c) the uam authors";
/// Licence of the units, as an SPDX expression.
pub const LICENSE: &str = "MIT OR Apache-2.0";
/// Version of the units: that of the workspace.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
/// What wrote the files.
pub const GENERATION_TOOL: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

/// Beginning of the default experiment \[s\].
pub const START_TIME: f64 = 0.0;
/// End of the default experiment \[s\].
pub const STOP_TIME: f64 = scenarios::PICK_UP_DURATION;
/// Communication step of the default experiment \[s\].
pub const STEP_SIZE: f64 = scenarios::THESIS_STEP;
