//! What the program says on its standard output.

use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result};
use clap::builder::StyledStr;
use fmu_build::files::Written;

/// Whether only results are wanted. The user says so once, for all that the program does.
static IS_QUIET: AtomicBool = AtomicBool::new(false);

/// From now on, only results are said.
pub fn be_quiet() {
    IS_QUIET.store(true, Ordering::Relaxed);
}

/// Whether only results are wanted.
pub fn is_quiet() -> bool {
    IS_QUIET.load(Ordering::Relaxed)
}

/// Writes a line, or several, to the standard output.
///
/// # Errors
/// If it takes nothing: a full disk, or a reader that has gone.
pub fn say(text: impl Display) -> Result<()> {
    let mut out = io::stdout().lock();
    writeln!(out, "{text}").and_then(|()| out.flush()).context("cannot write to the standard output")
}

/// As [`say`], in bold where that is shown and not written into a file.
///
/// # Errors
/// As [`say`].
pub fn say_styled(text: &StyledStr) -> Result<()> {
    let shown = if io::stdout().is_terminal() { text.ansi().to_string() } else { text.to_string() };
    say(shown.trim_end())
}

/// Says what is no result: what is being done, and how it went.
///
/// # Errors
/// As [`say`].
pub fn remark(text: impl Display) -> Result<()> {
    if is_quiet() { Ok(()) } else { say(text) }
}

/// Says where files are, and which of them took the place of others.
///
/// # Errors
/// As [`say`].
pub fn wrote(files: &[Written]) -> Result<()> {
    remark("Written:")?;
    files.iter().try_for_each(|file| remark(format_args!("  {file}")))
}
