//! How FMI 2.0 names machines and the binaries for them.

use std::env::consts::{ARCH, OS};

use crate::error::{Error, Result};

/// A machine that an FMU has a binary for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Platform {
    /// Name, and folder below `binaries/`.
    pub folder: &'static str,
    /// Another folder in which importers look for the same binary.
    pub also: Option<&'static str>,
    /// Ending of shared libraries, without dot.
    pub extension: &'static str,
}

const fn platform(folder: &'static str, also: Option<&'static str>, extension: &'static str) -> Platform {
    Platform { folder, also, extension }
}

// The standard names x86 only; the names for other processors are those that importers agreed on, but many look
// into the folder for x86 whatever they run on.

/// Linux on x86-64.
pub const LINUX64: Platform = platform("linux64", None, "so");
/// Linux on ARM.
pub const AARCH64_LINUX: Platform = platform("aarch64-linux", Some("linux64"), "so");
/// Windows on x86-64.
pub const WIN64: Platform = platform("win64", None, "dll");
/// Windows on ARM.
pub const AARCH64_WINDOWS: Platform = platform("aarch64-windows", Some("win64"), "dll");
/// macOS, on x86-64 or for both processors.
pub const DARWIN64: Platform = platform("darwin64", Some("aarch64-darwin"), "dylib");
/// macOS on ARM.
pub const AARCH64_DARWIN: Platform = platform("aarch64-darwin", Some("darwin64"), "dylib");

impl Platform {
    /// The machine that runs this program.
    ///
    /// # Errors
    /// If there is no name for it.
    pub fn of_this_machine() -> Result<Self> {
        match (OS, ARCH) {
            ("linux", "x86_64") => Ok(LINUX64),
            ("linux", "aarch64") => Ok(AARCH64_LINUX),
            ("windows", "x86_64") => Ok(WIN64),
            ("windows", "aarch64") => Ok(AARCH64_WINDOWS),
            ("macos", "x86_64") => Ok(Platform { also: None, ..DARWIN64 }),
            ("macos", "aarch64") => Ok(AARCH64_DARWIN),
            _ => Err(Error::NoPlatform { os: OS, arch: ARCH }),
        }
    }

    /// Path of a unit's library inside its FMU.
    #[must_use]
    pub fn library(&self, identifier: &str) -> String {
        self.library_in(self.folder, identifier)
    }

    /// All paths of a unit's library inside its FMU.
    pub fn libraries(&self, identifier: &str) -> impl Iterator<Item = String> {
        std::iter::once(self.folder).chain(self.also).map(move |folder| self.library_in(folder, identifier))
    }

    fn library_in(&self, folder: &str, identifier: &str) -> String {
        format!("binaries/{folder}/{identifier}.{}", self.extension)
    }
}
