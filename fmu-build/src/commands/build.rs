//! The FMUs and the SSP, and nothing else.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use fmu_build::compile::cross::{TARGETS, Target, Toolchain};
use fmu_build::compile::target_libraries;
use fmu_build::files::Written;
use fmu_build::platform::Platform;
use fmu_build::{BuildOptions, Design, workspace};
use uam::fmi::Naming;

use super::{build_files, scenario};
use crate::cli::BuildArguments;
use crate::terminal::{say, wrote};

pub fn execute(arguments: &BuildArguments, out: &Path) -> Result<()> {
    let design = design(arguments)?;
    let mut files: Vec<Written> = Vec::new();
    for (toolchains, folder) in toolchains(arguments, out)? {
        let built = build_files(&BuildOptions {
            design: design.clone(),
            toolchains,
            sources: arguments.sources.clone(),
            folder,
        })?;
        files.extend(built.files);
    }
    wrote(&files)
}

/// The pair of units that is asked for.
fn design(arguments: &BuildArguments) -> Result<Design> {
    let naming = if arguments.flat { Naming::Flat } else { Naming::Structured };
    let design = match &arguments.scenario {
        Some(name_or_file) => Design::from(scenario(name_or_file)?),
        None => Design::from(arguments.structure()?),
    };
    Ok(Design { naming, terminals: arguments.terminals, ..design })
}

/// What compiles the libraries, for each folder of finished files.
fn toolchains(arguments: &BuildArguments, out: &Path) -> Result<Vec<(Vec<Toolchain>, PathBuf)>> {
    let targets = targets(arguments)?;
    let mut together: Vec<_> =
        targets.iter().filter(|target| !target.is_apart()).copied().map(Toolchain::Cross).collect();
    let this_machine = Platform::of_this_machine()?;
    if arguments.platforms.is_empty() && !targets.iter().any(|target| target.platform.folder == this_machine.folder) {
        together.insert(0, Toolchain::Own);
    }
    let apart = targets.iter().filter(|target| target.is_apart());
    let folders = apart.map(|target| (vec![Toolchain::Cross(target)], out.join(target.platform.folder)));
    let together = (!together.is_empty()).then(|| (together, out.to_owned()));
    Ok(together.into_iter().chain(folders).collect())
}

/// The platforms that are asked for: those that cannot be had are an error if they were named, and are left
/// out with a word if all were meant.
fn targets(arguments: &BuildArguments) -> Result<Vec<&'static Target>> {
    let is_named = |target: &Target| arguments.platforms.iter().any(|name| name == target.platform.folder);
    let asked = TARGETS.iter().filter(|target| arguments.all_platforms || is_named(target)).collect::<Vec<_>>();
    match workspace::find(arguments.sources.as_deref()) {
        Err(absent) if arguments.all_platforms && arguments.sources.is_none() => {
            say(format_args!("skipped: all platforms but this machine, for {absent}"))?;
            return Ok(Vec::new());
        }
        Err(absent) if !asked.is_empty() => return Err(absent).context("the platforms named cannot be built"),
        _ => {}
    }
    let mut targets = Vec::new();
    for target in asked {
        let missing = target.lacks(target_libraries).join("; ");
        match (missing.as_str(), arguments.all_platforms) {
            ("", _) => targets.push(target),
            (missing, true) => {
                say(format_args!("skipped: {}, for this is missing: {missing}", target.platform.folder))?
            }
            (missing, false) => bail!("{} cannot be built, for this is missing: {missing}", target.platform.folder),
        }
    }
    Ok(targets)
}
