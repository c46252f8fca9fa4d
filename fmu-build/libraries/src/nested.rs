//! How a cargo is started that compiles what goes into the FMUs: the same way wherever it is started from, so that the
//! same sources give the same bytes.

use std::env;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Profile in the workspace's `Cargo.toml` for what goes into an FMU.
pub const PROFILE: &str = "fmu";
/// Where it is compiled, below the usual target folder: the cargo outside may hold the lock of that one.
pub const FOLDER: &str = "fmu";
/// Separates the flags in `CARGO_ENCODED_RUSTFLAGS`.
pub const FLAG_SEPARATOR: &str = "\u{1f}";

/// A cargo that compiles packages of the workspace into a folder of its own.
#[must_use]
pub fn cargo(
    program: impl AsRef<OsStr>,
    subcommand: &str,
    workspace: &Path,
    packages: &[&str],
    folder: &Path,
    flags: OsString,
) -> Command {
    let mut command = Command::new(program);
    command
        .current_dir(workspace)
        .arg(subcommand)
        .args(["--locked", "--profile", PROFILE])
        .args(packages.iter().flat_map(|package| ["--package", package]))
        .arg("--target-dir")
        .arg(folder)
        // A folder that the user's configuration names for all builds may be locked by the cargo that waits for this one.
        .env("CARGO_BUILD_BUILD_DIR", folder)
        .env("CARGO_ENCODED_RUSTFLAGS", flags)
        // Other machines are named as options.
        .env_remove("CARGO_BUILD_TARGET")
        // Those of the cargo outside: clippy, for instance, makes no libraries.
        .env_remove("RUSTC_WRAPPER")
        .env_remove("RUSTC_WORKSPACE_WRAPPER");
    command
}

/// The given compiler flags, and those that keep the building machine's paths out of the libraries.
#[must_use]
pub fn flags(workspace: &Path, sysroot: &Path, given: OsString) -> OsString {
    let mut flags = given;
    // Where several prefixes fit, the last one counts: a cargo home inside the workspace keeps its own name.
    let mut prefixes = vec![(workspace.to_owned(), "/uam")];
    if let Some(home) = cargo_home() {
        let registries = registries(&home);
        prefixes.push((home, "/cargo"));
        prefixes.extend(registries.into_iter().map(|registry| (registry, "/cargo")));
    }
    prefixes.push((sysroot.join("lib/rustlib/src/rust"), "/rust"));
    for (prefix, name) in prefixes {
        if !flags.is_empty() {
            flags.push(FLAG_SEPARATOR);
        }
        flags.push("--remap-path-prefix=");
        flags.push(prefix);
        flags.push("=");
        flags.push(name);
    }
    flags
}

fn cargo_home() -> Option<PathBuf> {
    env::var_os("CARGO_HOME").map(PathBuf::from).or_else(|| env::home_dir().map(|home| home.join(".cargo")))
}

/// Where cargo unpacks packages: a folder for each registry, so that a mirror gives it another name.
fn registries(home: &Path) -> Vec<PathBuf> {
    let folders = fs::read_dir(home.join("registry/src")).into_iter().flatten().flatten();
    let mut folders: Vec<_> = folders.map(|entry| entry.path()).collect();
    folders.sort();
    folders
}
