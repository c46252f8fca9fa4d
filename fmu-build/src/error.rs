//! What can go wrong between the variable tables and the finished files.

use std::io;
use std::path::PathBuf;

/// Result of the library's fallible functions.
pub type Result<T> = std::result::Result<T, Error>;

/// An error that says what was expected, what was found, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The sources of the units are not where the program looks.
    #[error(
        "what is not inside the program is compiled from the project's sources, and these were not found: neither {} \
         nor a folder above holds fmu-build/plant/Cargo.toml; run this inside the project's folder, or name that \
         folder with `build --sources`",
        list(searched)
    )]
    NoWorkspace {
        /// Where the search upwards began.
        searched: Vec<PathBuf>,
    },
    /// Sources of another version than the program: what it says of variables would not fit the libraries.
    #[error(
        "the sources in {} are not those of this program: {file} says otherwise there; \
         install the program from these sources (cargo install --locked --path fmu-build), or name its own",
        sources.display()
    )]
    OtherSources {
        /// Where they are.
        sources: PathBuf,
        /// The file that differs.
        file: String,
    },
    /// Start values with which no simulation can begin.
    #[error(transparent)]
    Parameters(#[from] uam::Error),
    /// A program that compiling needs cannot be started.
    #[error("`{program}` cannot be started: {reason}; install Rust, or name the program in the variable {variable}")]
    NoTool {
        /// The program.
        program: String,
        /// Environment variable that names another one.
        variable: &'static str,
        /// Why.
        reason: io::Error,
    },
    /// A program that compiling needs did not do its work.
    #[error("`{command}` failed ({status}):\n{output}")]
    ToolFailed {
        /// The command.
        command: String,
        /// How it ended.
        status: String,
        /// What it wrote.
        output: String,
    },
    /// A package without a program.
    #[error("the package {package} has no program")]
    NoProgram {
        /// The package.
        package: String,
    },
    /// The build went through, but a library is missing.
    #[error(
        "cargo built package {package} but reported no shared library with the ending .{extension}; \
         does its Cargo.toml say crate-type = [\"cdylib\"]?"
    )]
    NoLibrary {
        /// Package that was built.
        package: String,
        /// Ending of the file that was expected.
        extension: &'static str,
    },
    /// FMI 2.0 has no name for the machine.
    #[error("FMI has no folder for binaries of {arch} on {os}; units can be built on Linux, Windows and macOS")]
    NoPlatform {
        /// Operating system.
        os: &'static str,
        /// Processor.
        arch: &'static str,
    },
    /// A file or folder that cannot be read or written.
    #[error("cannot {action} {}: {reason}", path.display())]
    File {
        /// What was tried, for instance `write`.
        action: &'static str,
        /// Where.
        path: PathBuf,
        /// Why.
        reason: io::Error,
    },
    /// A document that cannot be put together.
    #[error("cannot put together {document}: {reason}")]
    Document {
        /// Name of the document, for instance `modelDescription.xml`.
        document: String,
        /// Why.
        reason: String,
    },
}

fn list(paths: &[PathBuf]) -> String {
    paths.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(" nor ")
}
