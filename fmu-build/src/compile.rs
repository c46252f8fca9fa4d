//! The units' shared libraries: from inside the program, or compiled by a nested cargo.

pub mod cross;
mod universal;

use std::env;
use std::ffi::{OsStr, OsString};
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;

use cargo_metadata::Message;
use unit_libraries::nested::{self, FLAG_SEPARATOR};

use crate::error::{Error, Result};
use crate::{files, workspace};
use cross::{Target, Toolchain};

/// What came out of a compilation.
#[derive(Debug)]
pub struct Compiled {
    toolchain: Toolchain,
    /// What cargo says for programs: one JSON object per line.
    messages: Vec<u8>,
}

/// The libraries of units, in their order.
///
/// Those for this machine are inside the program, if it is a release build. Others are compiled from the sources that
/// are named, or else from those around the current folder; if sources are named, all are.
///
/// # Errors
/// If sources are needed and not found, or do not compile.
pub fn libraries(
    units: &[&str],
    toolchain: Toolchain,
    sources: Option<&Path>,
    progress: &dyn Fn(&str),
) -> Result<Vec<Vec<u8>>> {
    if (toolchain, sources) == (Toolchain::Own, None)
        && let Some(held) = units.iter().map(|unit| unit_libraries::held(unit).map(Vec::from)).collect()
    {
        return Ok(held);
    }
    let compiled = compile(&workspace::find(sources)?, units, toolchain, progress)?;
    units.iter().map(|unit| compiled.library(unit)).collect()
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
    let program = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let subcommand = match toolchain {
        Toolchain::Own => "build",
        Toolchain::Cross(target) => target.subcommand(),
    };
    let flags = nested::flags(workspace, &sysroot(workspace)?, given_flags());
    let mut command = nested::cargo(program, subcommand, workspace, packages, &target_folder(workspace), flags);
    command
        .args(["--message-format", "json-render-diagnostics"])
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

/// A target folder of its own, below the usual one.
fn target_folder(workspace: &Path) -> PathBuf {
    let usual = env::var_os("CARGO_TARGET_DIR")
        .map(PathBuf::from)
        .and_then(|folder| std::path::absolute(folder).ok())
        .unwrap_or_else(|| workspace.join("target"));
    usual.join(nested::FOLDER)
}

/// The caller's compiler flags.
fn given_flags() -> OsString {
    env::var_os("CARGO_ENCODED_RUSTFLAGS").unwrap_or_else(|| {
        let flags = env::var("RUSTFLAGS").unwrap_or_default();
        flags.split_whitespace().collect::<Vec<_>>().join(FLAG_SEPARATOR).into()
    })
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
