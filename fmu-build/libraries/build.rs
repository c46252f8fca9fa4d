//! Compiles the libraries of both units, so that the program can hold them.
//!
//! In release builds only: whoever works on the project, with tests, clippy or an editor, does not pay for it.

#[path = "src/nested.rs"]
mod nested;

use std::env;
use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the libraries are made of, below the root of the workspace.
const SOURCES: [&str; 5] = ["src", "fmu-build/plant", "fmu-build/controller", "Cargo.toml", "Cargo.lock"];
/// The packages, which give the libraries their names.
const UNITS: [&str; 2] = ["uam_controller", "uam_plant"];

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/nested.rs");
    let libraries = if variable("PROFILE")? == "release" { compile()? } else { Vec::new() };
    let mut table = String::from("&[");
    for (unit, library) in libraries {
        write!(table, "({unit:?}, include_bytes!({library:?})),")?;
    }
    table.push(']');
    fs::write(Path::new(&variable("OUT_DIR")?).join("libraries.rs"), table)?;
    Ok(())
}

/// The names of the units, and where their libraries are.
fn compile() -> Result<Vec<(&'static str, PathBuf)>> {
    let package = PathBuf::from(variable("CARGO_MANIFEST_DIR")?);
    let workspace = package.ancestors().nth(2).ok_or("the package does not stand in its workspace")?;
    for source in SOURCES {
        println!("cargo::rerun-if-changed={}", workspace.join(source).display());
    }
    let out = PathBuf::from(variable("OUT_DIR")?);
    let folder = target_folder(&out).join(nested::FOLDER);
    let flags = nested::flags(workspace, &sysroot()?, variable("CARGO_ENCODED_RUSTFLAGS").unwrap_or_default().into());
    let mut cargo = nested::cargo(&variable("CARGO")?, "build", workspace, &UNITS, &folder, flags);
    // What is named as the target counts as another machine and gets other names inside: only where it is one.
    let target = variable("TARGET")?;
    if target != variable("HOST")? {
        cargo.args(["--target", &target]);
    }
    if !cargo.status()?.success() {
        return Err("the libraries of the units cannot be compiled; see above".into());
    }
    // Copies: builds with other flags may put theirs into the same place.
    let copy = |unit| {
        let name = file_name(unit)?;
        fs::copy(find(&folder, &target, &name)?, out.join(&name))?;
        Ok((unit, out.join(&name)))
    };
    UNITS.into_iter().map(copy).collect()
}

/// The folder that the cargo outside builds into, which it marks for those who make backups. Tests compile the same
/// libraries in it, and so they are compiled once.
fn target_folder(out: &Path) -> &Path {
    out.ancestors().find(|folder| folder.join("CACHEDIR.TAG").is_file()).unwrap_or(out)
}

fn variable(name: &str) -> Result<String> {
    env::var(name).map_err(|reason| format!("{name}: {reason}").into())
}

fn sysroot() -> Result<PathBuf> {
    let output = Command::new(variable("RUSTC")?).args(["--print", "sysroot"]).output()?;
    Ok(PathBuf::from(String::from_utf8(output.stdout)?.trim_end()))
}

fn file_name(unit: &str) -> Result<String> {
    Ok(match variable("CARGO_CFG_TARGET_OS")?.as_str() {
        "windows" => format!("{unit}.dll"),
        "macos" => format!("lib{unit}.dylib"),
        _ => format!("lib{unit}.so"),
    })
}

/// Cargo puts what is for another machine, or for one that its configuration names, one folder deeper.
fn find(folder: &Path, target: &str, name: &str) -> Result<PathBuf> {
    let places = [folder.to_owned(), folder.join(target)].map(|place| place.join(nested::PROFILE).join(name));
    let found = places.into_iter().find(|place| place.is_file());
    found.ok_or_else(|| format!("cargo made no {name} for {target}; programs for it cannot load units").into())
}
