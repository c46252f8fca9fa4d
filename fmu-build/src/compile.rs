//! The units' shared libraries, compiled by a nested cargo.

pub mod cross;
mod universal;

use std::env;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;

use cargo_metadata::Message;

use crate::error::{Error, Result};
use crate::files;
use cross::{Target, Toolchain};

/// Profile in the workspace's `Cargo.toml` for what goes into an FMU.
const PROFILE: &str = "fmu";
/// Separates the flags in `CARGO_ENCODED_RUSTFLAGS`.
const FLAG_SEPARATOR: &str = "\u{1f}";

/// What came out of a compilation.
#[derive(Debug)]
pub struct Compiled {
    toolchain: Toolchain,
    /// What cargo says for programs: one JSON object per line.
    messages: Vec<u8>,
}

/// Compiles packages of the workspace; `progress` is told what cargo is doing, line by line.
///
/// # Errors
/// If cargo cannot be started or a package does not compile.
pub fn compile(workspace: &Path, packages: &[&str], toolchain: Toolchain, progress: &dyn Fn(&str)) -> Result<Compiled> {
    let mut command = cargo(workspace, packages, toolchain)?;
    let child = command.spawn().map_err(|reason| not_started(&command, "CARGO", reason))?;
    let messages = wait_for(child, &command, progress)?;
    Ok(Compiled { toolchain, messages })
}

impl Compiled {
    /// Where the program of a package is.
    ///
    /// # Errors
    /// If there is none.
    pub fn program(&self, package: &str) -> Result<PathBuf> {
        let mut artifacts = Message::parse_stream(self.messages.as_slice()).filter_map(std::result::Result::ok);
        let program = artifacts.find_map(|message| match message {
            Message::CompilerArtifact(artifact) if artifact.target.name == package => artifact.executable,
            _ => None,
        });
        program.map(PathBuf::from).ok_or_else(|| Error::NoProgram { package: package.to_owned() })
    }

    /// The shared library of a package.
    ///
    /// # Errors
    /// If there is none, or it cannot be read.
    pub fn library(&self, package: &str) -> Result<Vec<u8>> {
        let extension = self.toolchain.platform()?.extension;
        let reported: Vec<PathBuf> = Message::parse_stream(self.messages.as_slice())
            .filter_map(std::result::Result::ok)
            .filter_map(|message| match message {
                Message::CompilerArtifact(artifact) if artifact.target.name == package => Some(artifact.filenames),
                _ => None,
            })
            .flatten()
            .filter(|file| file.extension() == Some(extension))
            .map(PathBuf::from)
            .collect();
        let read = |file: Option<&PathBuf>| {
            files::read(file.ok_or_else(|| Error::NoLibrary { package: package.to_owned(), extension })?)
        };
        let Toolchain::Cross(Target { triples, .. }) = self.toolchain else { return read(reported.first()) };
        let of = |triple: &&str| read(reported.iter().find(|file| file.iter().any(|part| part == *triple)));
        universal::join(package, triples.iter().map(of).collect::<Result<_>>()?)
    }
}

fn cargo(workspace: &Path, packages: &[&str], toolchain: Toolchain) -> Result<Command> {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command
        .current_dir(workspace)
        .arg(match toolchain {
            Toolchain::Own => "build",
            Toolchain::Cross(target) => target.subcommand(),
        })
        .args(["--locked", "--profile", PROFILE, "--message-format", "json-render-diagnostics"])
        .args(packages.iter().flat_map(|package| ["--package", package]))
        .arg("--target-dir")
        .arg(target_folder(workspace))
        .env("CARGO_ENCODED_RUSTFLAGS", flags(workspace)?)
        .env("CARGO_TERM_COLOR", "never")
        .env("CARGO_TERM_PROGRESS_WHEN", "never")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    if let Toolchain::Cross(target) = toolchain {
        command.args(target.arguments().iter().flat_map(|triple| ["--target", triple])).envs(target.environment());
    }
    Ok(command)
}

/// Where the standard library of a target would be.
#[must_use]
pub fn target_libraries(triple: &str) -> Option<PathBuf> {
    let mut command = Command::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
    let output = command.args(["--print", "target-libdir", "--target", triple]).output().ok()?;
    output.status.success().then(|| PathBuf::from(String::from_utf8_lossy(&output.stdout).trim_end()))
}

/// A target folder of its own: the cargo that may be running this program holds the lock of the usual one.
fn target_folder(workspace: &Path) -> PathBuf {
    let usual = env::var_os("CARGO_TARGET_DIR")
        .map(PathBuf::from)
        .and_then(|folder| std::path::absolute(folder).ok())
        .unwrap_or_else(|| workspace.join("target"));
    usual.join("fmu")
}

/// The caller's compiler flags, and those that keep the building machine's paths out of
/// the libraries.
fn flags(workspace: &Path) -> Result<OsString> {
    let mut flags = given_flags();
    // Where several prefixes fit, the last one counts: a cargo home inside the workspace keeps its own name.
    let mut prefixes = vec![(workspace.to_owned(), "/uam")];
    if let Some(home) = cargo_home() {
        let registries = registries(&home);
        prefixes.push((home, "/cargo"));
        prefixes.extend(registries.into_iter().map(|registry| (registry, "/cargo")));
    }
    prefixes.push((sysroot(workspace)?.join("lib/rustlib/src/rust"), "/rust"));
    for (prefix, name) in prefixes {
        if !flags.is_empty() {
            flags.push(FLAG_SEPARATOR);
        }
        flags.push("--remap-path-prefix=");
        flags.push(prefix);
        flags.push("=");
        flags.push(name);
    }
    Ok(flags)
}

fn given_flags() -> OsString {
    env::var_os("CARGO_ENCODED_RUSTFLAGS").unwrap_or_else(|| {
        let flags = env::var("RUSTFLAGS").unwrap_or_default();
        flags.split_whitespace().collect::<Vec<_>>().join(FLAG_SEPARATOR).into()
    })
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

fn sysroot(workspace: &Path) -> Result<PathBuf> {
    let mut command = Command::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
    command.current_dir(workspace).args(["--print", "sysroot"]);
    let output = command.output().map_err(|reason| not_started(&command, "RUSTC", reason))?;
    if output.status.success() {
        Ok(PathBuf::from(String::from_utf8_lossy(&output.stdout).trim_end()))
    } else {
        Err(failure(&command, &output.status, &String::from_utf8_lossy(&output.stderr)))
    }
}

/// Hands on what cargo says until it has ended, and returns its messages for programs.
fn wait_for(mut child: Child, command: &Command, progress: &dyn Fn(&str)) -> Result<Vec<u8>> {
    let broken = |reason| Error::File { action: "read the messages of", path: command.get_program().into(), reason };
    // Both pipes are emptied at once: a full one would stop cargo.
    let stdout = child.stdout.take();
    let messages = thread::spawn(move || {
        let mut messages = Vec::new();
        stdout.map_or(Ok(0), |mut stdout| stdout.read_to_end(&mut messages)).map(|_| messages)
    });
    let mut said = String::new();
    for line in child.stderr.take().into_iter().flat_map(|stderr| BufReader::new(stderr).split(b'\n')) {
        let line = line.map_err(broken)?;
        let line = String::from_utf8_lossy(&line);
        if let Some(status) = status_in(&line) {
            progress(status);
        }
        said.push_str(&line);
        said.push('\n');
    }
    let status = child.wait().map_err(broken)?;
    let messages = messages.join().unwrap_or_else(|_| Err(io::Error::other("reader stopped"))).map_err(broken)?;
    if status.success() { Ok(messages) } else { Err(failure(command, &status, &said)) }
}

/// What cargo says of its own doing, for instance `Compiling uam v0.1.0`; `None` for diagnostics.
fn status_in(line: &str) -> Option<&str> {
    // Cargo sets its verbs flush right in a column.
    const VERB_WIDTH: usize = 12;
    let (verb, rest) = line.split_at_checked(VERB_WIDTH)?;
    let verb = verb.trim_start();
    let is_verb = verb.starts_with(char::is_uppercase) && verb.chars().all(char::is_alphabetic);
    (is_verb && rest.starts_with(' ')).then_some(line.trim())
}

fn not_started(command: &Command, variable: &'static str, reason: io::Error) -> Error {
    Error::NoTool { program: command.get_program().display().to_string(), variable, reason }
}

fn failure(command: &Command, status: &impl ToString, output: &str) -> Error {
    let words: Vec<_> = std::iter::once(command.get_program()).chain(command.get_args()).collect();
    Error::ToolFailed {
        command: words.join(OsStr::new(" ")).to_string_lossy().into_owned(),
        status: status.to_string(),
        output: output.trim_end().to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_is_what_cargo_says_of_its_own_doing() {
        assert_eq!(status_in("   Compiling uam v0.1.0 (/home/me/uam)"), Some("Compiling uam v0.1.0 (/home/me/uam)"));
        assert_eq!(
            status_in("    Finished `fmu` profile [optimized] target(s) in 0.06s"),
            Some("Finished `fmu` profile [optimized] target(s) in 0.06s")
        );
        for other in [
            "",
            "warning: unused variable: `x`",
            "   --> src/plant.rs:113:12",
            "113 | pub fn new()",
            "error[E0308]: mismatch",
        ] {
            assert_eq!(status_in(other), None);
        }
    }

    #[test]
    fn a_missing_library_is_named() {
        let toolchain = Toolchain::Cross(&crate::compile::cross::TARGETS[0]);
        let nothing = Compiled { toolchain, messages: Vec::new() };
        let error = nothing.library("uam_plant").unwrap_err().to_string();
        assert!(error.contains("uam_plant") && error.contains(".so"), "{error}");
    }

    #[test]
    fn a_package_that_is_not_there_is_an_error_with_cargos_own_words() {
        let workspace = crate::workspace::root().unwrap();
        let error = compile(&workspace, &["uam_nothing"], Toolchain::Own, &|_| ()).unwrap_err().to_string();
        assert!(error.contains("`uam_nothing`") && error.contains("cargo"), "{error}");
    }
}
