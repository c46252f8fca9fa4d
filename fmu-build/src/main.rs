//! The program `uam`: builds both FMUs, couples them, and shows what happened.

// They panic where nothing can be written.
#![deny(clippy::print_stdout, clippy::print_stderr)]

use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

use clap::Parser;

mod cli;
mod commands;
mod terminal;

/// What the program answers to a command line that it does not understand, as other programs do.
const USAGE: u8 = 2;

fn main() -> ExitCode {
    let arguments = match cli::Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(refusal) if refusal.use_stderr() => {
            // If it cannot be printed, there is nobody to tell.
            let _ = refusal.print();
            return ExitCode::from(USAGE);
        }
        // Help and version are answers, not mistakes.
        Err(answer) => return exit(terminal::say_styled(&answer.render())),
    };
    if arguments.quiet {
        terminal::be_quiet();
    }
    exit(commands::execute(&arguments))
}

/// What the program answers to whoever started it. Who reads no further, for instance `head`, gets no error.
fn exit(outcome: anyhow::Result<()>) -> ExitCode {
    let Err(error) = outcome else { return ExitCode::SUCCESS };
    let reads_no_further = |cause: &io::Error| cause.kind() == ErrorKind::BrokenPipe;
    if error.chain().filter_map(|cause| cause.downcast_ref()).any(reads_no_further) {
        return ExitCode::SUCCESS;
    }
    // Likewise.
    let _ = writeln!(io::stderr(), "error: {error:#}");
    ExitCode::FAILURE
}
