//! How FMI 2.0 names machines and the binaries for them.

use std::env::consts::{ARCH, DLL_EXTENSION, OS};

use crate::error::{Error, Result};

/// A machine that an FMU has a binary for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Platform {
    /// Folder below `binaries/`.
    pub folder: &'static str,
    /// Ending of shared libraries, without dot.
    pub extension: &'static str,
}

impl Platform {
    /// The machine that runs this program.
    ///
    /// # Errors
    /// If there is no name for it.
    pub fn of_this_machine() -> Result<Self> {
        // The standard names x86 only; the names for other processors are those that importers agreed on.
        let folder = match (OS, ARCH) {
            ("linux", "x86_64") => "linux64",
            ("linux", "aarch64") => "aarch64-linux",
            ("windows", "x86_64") => "win64",
            ("windows", "aarch64") => "aarch64-windows",
            ("macos", "x86_64") => "darwin64",
            ("macos", "aarch64") => "aarch64-darwin",
            _ => return Err(Error::NoPlatform { os: OS, arch: ARCH }),
        };
        Ok(Self { folder, extension: DLL_EXTENSION })
    }

    /// Path of a unit's library inside its FMU.
    #[must_use]
    pub fn library(&self, identifier: &str) -> String {
        format!("binaries/{}/{identifier}.{}", self.folder, self.extension)
    }
}
