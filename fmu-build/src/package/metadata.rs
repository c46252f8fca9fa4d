//! Who made the files, and when a simulation of them begins: written into every product.

/// Author and copyright holder.
pub const AUTHOR: &str = "The uam authors";
/// Copyright notice.
pub const COPYRIGHT: &str = "Copyright (c) the uam authors";
/// Licence of the units, as an SPDX expression.
pub const LICENSE: &str = "MIT OR Apache-2.0";
/// Version of the units: that of the workspace.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
/// What wrote the files.
pub const GENERATION_TOOL: &str = concat!("uam ", env!("CARGO_PKG_VERSION"));

/// Beginning of every experiment \[s\].
pub const START_TIME: f64 = 0.0;
