//! The program behind `cargo run`: builds both FMUs, couples them, and shows what happened.

use std::process::ExitCode;

use clap::Parser;

mod cli;
mod commands;

fn main() -> ExitCode {
    #[cfg(unix)]
    end_with_the_reader();
    let arguments = match cli::Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(refusal) => {
            // Help and version are answers, not mistakes. If they cannot be printed, nobody is listening.
            let _ = refusal.print();
            return if refusal.use_stderr() { ExitCode::FAILURE } else { ExitCode::SUCCESS };
        }
    };
    match commands::execute(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Whoever reads no further, for instance `head`, ends the program without an error.
#[cfg(unix)]
fn end_with_the_reader() {
    // SAFETY: no thread runs yet, and nothing in this program handles the signal.
    unsafe { libc::signal(libc::SIGPIPE, libc::SIG_DFL) };
}
