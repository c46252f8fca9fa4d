//! A scenario file for a vehicle of one's own.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use clap::Args;
use fmu_build::files;
use fmu_build::study::own_file;
use fmu_build::study::own_vehicle::{Choices, own_vehicle};
use uam::Structure;
use uam::parameters::Balance;
use uam::scenarios::Scenario;

use crate::terminal::{remark, wrote};

/// Which vehicle, and where to write it.
#[derive(Debug, Args)]
pub struct InitArguments {
    /// The file to write
    #[arg(value_name = "FILE", default_value = "vehicle.toml")]
    pub file: PathBuf,
    /// Revolute links of the arm, 1 to 6
    #[arg(long, value_name = "NUMBER", value_parser = crate::cli::links, allow_hyphen_values = true)]
    #[arg(default_value_t = Structure::DEFAULT.links)]
    pub links: usize,
    /// A counterweight that slides along the UAV balances the arm
    #[arg(long)]
    pub counterweight: bool,
    /// Short name of the simulation, after which its results are called [default: that of the file]
    #[arg(long)]
    pub name: Option<String>,
    /// Mass of the UAV alone, in kg
    #[arg(long, value_name = "KG", default_value_t = 3.0, allow_hyphen_values = true)]
    pub mass: f64,
    /// Roll inertia of the UAV alone, in kg m2 [default: its mass times (0.2 m)^2]
    #[arg(long, value_name = "KG_M2", allow_hyphen_values = true)]
    pub inertia: Option<f64>,
    /// Length of each link, in m
    #[arg(long, value_name = "M", default_value_t = 0.2, allow_hyphen_values = true)]
    pub link_length: f64,
    /// Mass of each link, in kg
    #[arg(long, value_name = "KG", default_value_t = 0.2, allow_hyphen_values = true)]
    pub link_mass: f64,
    /// Mass of the counterweight, in kg
    #[arg(long, value_name = "KG", default_value_t = 0.5, allow_hyphen_values = true, requires = "counterweight")]
    pub counterweight_mass: f64,
    /// Write over a file that is there
    #[arg(long)]
    pub force: bool,
}

pub fn execute(arguments: &InitArguments) -> Result<()> {
    let file = &arguments.file;
    let is_toml = file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    ensure!(is_toml, "{} must end in .toml, by which the other commands know a file of your own", file.display());
    ensure!(
        arguments.force || !file.exists(),
        "{} is there already, and stays as it is; name another file, or write over it with --force",
        file.display()
    );
    let text = text(arguments)?;
    if let Some(folder) = file.parent().filter(|folder| *folder != Path::new("")) {
        files::create_folder(folder)?;
    }
    wrote(&[files::write(file, text.as_bytes())?])?;
    let file = file.display();
    remark(format_args!("\nNext: put your own numbers in, then `check {file}` and `simulate {file}`."))
}

/// The text of the file; it reads.
fn text(arguments: &InitArguments) -> Result<String> {
    let balance = if arguments.counterweight { Balance::Counterweight } else { Balance::None };
    let stem = arguments.file.file_stem().unwrap_or_default().to_string_lossy();
    let choices = Choices {
        id: arguments.name.clone().unwrap_or_else(|| name(&stem)),
        structure: Structure::new(arguments.links, balance)?,
        mass: arguments.mass,
        inertia: arguments.inertia,
        link_length: arguments.link_length,
        link_mass: arguments.link_mass,
        counterweight_mass: arguments.counterweight_mass,
    };
    let scenario = own_vehicle(&choices)?;
    // Quotes in a name would end it.
    let id = choices.id.replace(['"', '\\', '\n'], "?");
    let text = own_file::text(&Scenario { id, ..scenario }, &arguments.file.display().to_string().replace('\n', "?"));
    let asked = || format!("cannot write a file for the name `{}`; choose another one with --name", choices.id);
    Scenario::read(&text).with_context(asked)?;
    Ok(text)
}

/// A name that results can have, after a file.
fn name(stem: &str) -> String {
    let allowed = |c: char| if c.is_ascii_alphanumeric() || ".-_".contains(c) { c } else { '-' };
    let name: String = stem.chars().map(allowed).collect();
    let name = name.trim_start_matches(|c: char| !c.is_ascii_alphanumeric());
    if name.is_empty() { "vehicle".to_owned() } else { name.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_give_names_that_are_allowed() {
        for (stem, expected) in [("mine", "mine"), ("my drone", "my-drone"), ("-x", "x"), ("ü", "vehicle")] {
            assert_eq!(name(stem), expected);
        }
    }
}
