//! What the program says on its standard output.

use std::fmt::Display;
use std::io::{self, Write};

use anyhow::{Context, Result};
use fmu_build::files::Written;

/// Writes a line, or several, to the standard output.
///
/// # Errors
/// If it takes nothing: a full disk, or a reader that has gone.
pub fn say(text: impl Display) -> Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "{text}").and_then(|()| out.flush()).context("cannot write to the standard output")
}

/// Says where files are, and which of them took the place of others.
///
/// # Errors
/// As [`say`].
pub fn wrote(files: &[Written]) -> Result<()> {
    say("Written:")?;
    files.iter().try_for_each(|file| say(format_args!("  {file}")))
}
