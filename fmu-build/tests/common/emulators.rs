//! Programs for other machines, run here, as far as this one can.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use fmu_build::compile::cross::Target;
use fmu_build::compile::target_libraries;

/// The start of a command that runs a program for another machine; it may store what it needs in the folder it is told.
pub type Emulator = Box<dyn Fn(&Path) -> Command>;

/// Whether the large set of tests is asked for.
pub fn full() -> bool {
    env::var_os("UAM_FULL").is_some_and(|value| !value.is_empty())
}

/// Cross-compiling takes minutes: only in the full set.
pub fn wanted(target: &Target) -> bool {
    let name = target.platform.folder;
    if !full() {
        println!("skipped: {name} (only in the full set)");
        return false;
    }
    let missing = target.lacks(target_libraries);
    if !missing.is_empty() {
        println!("skipped: {name}, for this is missing: {}", missing.join("; "));
    }
    missing.is_empty()
}

/// Where the first of some programs that is there stands; Debian's `wine64` is in a folder of its own.
pub fn program(names: &[&str]) -> Option<PathBuf> {
    let folders = env::split_paths(&env::var_os("PATH").unwrap_or_default()).collect::<Vec<_>>();
    let folders = folders.into_iter().chain([PathBuf::from("/usr/lib/wine")]);
    folders.flat_map(|folder| names.iter().map(move |name| folder.join(name))).find(|program| program.is_file())
}

/// Debian has it in the package `wine64` or `wine`.
pub fn wine() -> Option<Emulator> {
    let Some(wine) = program(&["wine", "wine64"]) else {
        println!("skipped: running win64, there is no wine");
        return None;
    };
    Some(Box::new(move |folder| {
        let mut command = Command::new(&wine);
        command.env("WINEPREFIX", folder.join("wine")).env("WINEDEBUG", "-all");
        command
    }))
}

/// Debian has it in the package `qemu-user`, and the libraries in `libc6-arm64-cross`.
pub fn qemu() -> Option<Emulator> {
    let system = Path::new("/usr/aarch64-linux-gnu");
    let Some(qemu) = program(&["qemu-aarch64"]).filter(|_| system.is_dir()) else {
        println!("skipped: running aarch64-linux, there is no qemu-aarch64 or no {}", system.display());
        return None;
    };
    Some(Box::new(move |_| {
        let mut command = Command::new(&qemu);
        command.arg("-L").arg(system);
        command
    }))
}
