//! Binaries for other machines than this one, and for older systems than this one has.

use std::env;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use crate::platform::{AARCH64_LINUX, DARWIN64, LINUX64, Platform, WIN64};

/// Oldest C library of Linux on which the binaries run, as suffix of a triple: that of 2012, which is in every
/// distribution since.
const GLIBC: &str = ".2.17";
/// Oldest macOS: the first one for both processors.
const MACOS: &str = "11.0";

/// What compiles a unit's library.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Toolchain {
    /// The compiler of this machine, for this machine.
    Own,
    /// A cross-compiler.
    Cross(&'static Target),
}

/// A platform with the way to compile for it.
#[derive(Debug, PartialEq, Eq)]
pub struct Target {
    /// The platform.
    pub platform: Platform,
    /// Rust's names of it, one for each processor.
    pub(crate) triples: &'static [&'static str],
    linker: Linker,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Linker {
    /// Zig brings the C libraries of many systems; cargo-zigbuild uses it with cargo.
    Zig,
    MinGw,
}

/// A program that a linker needs.
struct Tool {
    name: &'static str,
    /// How to get it.
    origin: &'static str,
    /// It is there if one of these succeeds.
    commands: &'static [&'static [&'static str]],
}

impl Linker {
    fn tools(self) -> &'static [Tool] {
        match self {
            Self::Zig => &[
                Tool {
                    name: "cargo-zigbuild",
                    origin: "pip install cargo-zigbuild",
                    commands: &[&["cargo-zigbuild", "--version"]],
                },
                Tool {
                    name: "Zig",
                    origin: "pip install ziglang",
                    commands: &[
                        &["zig", "version"],
                        &["python3", "-m", "ziglang", "version"],
                        &["python", "-m", "ziglang", "version"],
                    ],
                },
            ],
            Self::MinGw => &[Tool {
                name: "mingw-w64",
                origin: "Debian: apt-get install gcc-mingw-w64-x86-64",
                commands: &[&["x86_64-w64-mingw32-gcc", "--version"]],
            }],
        }
    }
}

/// Every platform that can be compiled for.
pub static TARGETS: [Target; 4] = [
    Target { platform: LINUX64, triples: &["x86_64-unknown-linux-gnu"], linker: Linker::Zig },
    Target { platform: WIN64, triples: &["x86_64-pc-windows-gnu"], linker: Linker::MinGw },
    Target { platform: DARWIN64, triples: &["x86_64-apple-darwin", "aarch64-apple-darwin"], linker: Linker::Zig },
    Target { platform: AARCH64_LINUX, triples: &["aarch64-unknown-linux-gnu"], linker: Linker::Zig },
];

impl Target {
    /// Whether its FMUs must be files of their own: its binary stands where that of another platform would.
    #[must_use]
    pub fn is_apart(&self) -> bool {
        TARGETS.iter().any(|other| Some(other.platform.folder) == self.platform.also)
    }

    /// What is missing on this machine to compile for the platform, and how to get it.
    ///
    /// `libraries` tells where Rust's standard library for a triple would be.
    #[must_use]
    pub fn lacks(&self, libraries: impl Fn(&str) -> Option<PathBuf>) -> Vec<String> {
        let mut missing = Vec::new();
        let is_there = |triple: &str| libraries(triple).is_some_and(|folder| folder.is_dir());
        // Whoever has the sources of the standard library may tell cargo by this to compile it as well.
        if env::var_os("CARGO_UNSTABLE_BUILD_STD").is_none() {
            let absent = self.triples.iter().filter(|triple| !is_there(triple));
            missing.extend(absent.map(|triple| format!("Rust's standard library (rustup target add {triple})")));
        }
        let tools = self.linker.tools().iter().filter(|tool| !tool.commands.iter().any(|command| runs(command)));
        missing.extend(tools.map(|tool| format!("{} ({})", tool.name, tool.origin)));
        missing
    }

    /// The subcommand of cargo that builds for the platform.
    pub(crate) fn subcommand(&self) -> &'static str {
        match self.linker {
            Linker::Zig => "zigbuild",
            Linker::MinGw => "build",
        }
    }

    /// What to hand over as `--target`, once for each processor.
    ///
    /// cargo-zigbuild knows macOS on both processors as one target, but may then put the library of one package into
    /// that of another; asked for each processor, it does not.
    pub(crate) fn arguments(&self) -> Vec<String> {
        let version = if self.linker == Linker::Zig && self.platform.extension == "so" { GLIBC } else { "" };
        self.triples.iter().map(|triple| format!("{triple}{version}")).collect()
    }

    /// What must be in the environment.
    pub(crate) fn environment(&self) -> Option<(&'static str, &'static str)> {
        (self.platform == DARWIN64).then_some(("MACOSX_DEPLOYMENT_TARGET", MACOS))
    }
}

impl Toolchain {
    /// The platform that it compiles for.
    ///
    /// # Errors
    /// If this machine is none that FMI knows.
    pub fn platform(self) -> crate::error::Result<Platform> {
        match self {
            Self::Own => Platform::of_this_machine(),
            Self::Cross(target) => Ok(target.platform),
        }
    }
}

/// Whether a command succeeds.
fn runs(command: &[&str]) -> bool {
    let Some((program, arguments)) = command.split_first() else { return false };
    let quiet =
        Command::new(program).args(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status();
    quiet.is_ok_and(|status| status.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_platforms_that_share_a_folder_are_apart() {
        let apart: Vec<_> =
            TARGETS.iter().filter(|target| target.is_apart()).map(|target| target.platform.folder).collect();
        assert_eq!(apart, ["aarch64-linux"]);
    }

    #[test]
    fn targets_are_named_as_the_tools_want_them() {
        let arguments: Vec<_> = TARGETS.iter().flat_map(Target::arguments).collect();
        assert_eq!(
            arguments,
            [
                "x86_64-unknown-linux-gnu.2.17",
                "x86_64-pc-windows-gnu",
                "x86_64-apple-darwin",
                "aarch64-apple-darwin",
                "aarch64-unknown-linux-gnu.2.17"
            ]
        );
    }

    #[test]
    fn a_program_is_there_if_it_runs() {
        assert!(runs(&["rustc", "--version"]));
        assert!(!runs(&["rustc", "--no-such-option"]));
        assert!(!runs(&["no-such-program"]) && !runs(&[]));
    }

    #[test]
    fn what_is_missing_is_said_with_the_way_to_get_it() {
        let missing = TARGETS[2].lacks(|_| None).join("; ");
        if env::var_os("CARGO_UNSTABLE_BUILD_STD").is_none() {
            for triple in TARGETS[2].triples {
                assert!(missing.contains(&format!("rustup target add {triple}")), "{missing}");
            }
        }
    }
}
