//! What shells need to complete the program's commands, options and names.

use anyhow::Result;
use clap::CommandFactory;
use clap_complete::{Shell, generate};

use crate::cli::Arguments;
use crate::terminal::say;

pub fn execute(shell: Shell) -> Result<()> {
    let mut command = Arguments::command();
    let name = command.get_name().to_owned();
    // Into memory first: `generate` panics where nothing can be written.
    let mut script = Vec::new();
    generate(shell, &mut command, name, &mut script);
    say(String::from_utf8_lossy(&script).trim_end())
}
