//! From the sources to `uam_controller.fmu`, `uam_plant.fmu` and `uam.ssp`.

use std::path::{Path, PathBuf};

use uam::Structure;

use crate::compile::cross::Toolchain;
use crate::compile::{Compiled, compile};
use crate::error::Result;
use crate::files::Written;
use crate::package::contents::fmu;
use crate::package::description::model_description;
use crate::package::design::Design;
use crate::package::ssp::{Component, ssp};
use crate::package::units::Unit;
use crate::platform::Platform;
use crate::{files, workspace};

const SSP_NAME: &str = "uam.ssp";

/// What to build, and where to put it.
#[derive(Debug, Clone)]
pub struct BuildOptions {
    /// The pair.
    pub design: Design,
    /// What compiles the libraries, one for each platform that the FMUs are for.
    pub toolchains: Vec<Toolchain>,
    /// Folder for the files; created if it is missing.
    pub folder: PathBuf,
}

impl BuildOptions {
    /// To build this, there, for this machine.
    pub fn new(design: impl Into<Design>, folder: impl Into<PathBuf>) -> Self {
        Self { design: design.into(), toolchains: vec![Toolchain::Own], folder: folder.into() }
    }
}

/// The finished files.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Built {
    /// The controller's FMU.
    pub controller: PathBuf,
    /// The plant's FMU.
    pub plant: PathBuf,
    /// Both, connected.
    pub ssp: PathBuf,
    /// All three, in this order.
    pub files: [Written; 3],
}

/// Compiles both units and writes the two FMUs and the SSP.
///
/// `progress` is told, line by line, what is being done.
///
/// # Errors
/// If the start values do not go together, the sources are not found, do not compile, or a file cannot be written.
pub fn build(options: &BuildOptions, progress: &dyn Fn(&str)) -> Result<Built> {
    options.design.check()?;
    let [controller, plant] = Unit::pair(options.design.clone());
    let packages = [controller.interface.identifier, plant.interface.identifier];
    let root = workspace::root()?;
    let compile = |toolchain: &Toolchain| Ok((toolchain.platform()?, compile(&root, &packages, *toolchain, progress)?));
    let compiled: Vec<_> = options.toolchains.iter().map(compile).collect::<Result<_>>()?;

    let pack = |unit: &Unit| {
        let read =
            |(platform, compiled): &(Platform, Compiled)| Ok((*platform, compiled.library(unit.interface.identifier)?));
        let libraries = compiled.iter().map(read).collect::<Result<Vec<_>>>()?;
        fmu(unit, &libraries)?.to_bytes(&unit.interface.file_name())
    };
    let controller_fmu = pack(&controller)?;
    let plant_fmu = pack(&plant)?;
    // The plant stands first: importers that step one component after the other must begin with it.
    let system = ssp(&[
        Component { name: "plant", interface: &plant.interface, fmu: &plant_fmu },
        Component { name: "controller", interface: &controller.interface, fmu: &controller_fmu },
    ])?;

    files::create_folder(&options.folder)?;
    let write = |name: &str, content: &[u8]| {
        let path = options.folder.join(name);
        progress(&format!("Writing {}", path.display()));
        files::write(&path, content)
    };
    let files = [
        write(&controller.interface.file_name(), &controller_fmu)?,
        write(&plant.interface.file_name(), &plant_fmu)?,
        write(SSP_NAME, &system.to_bytes(SSP_NAME)?)?,
    ];
    let [controller, plant, ssp] = files.each_ref().map(|file| file.path.clone());
    Ok(Built { controller, plant, ssp, files })
}

/// Writes the model descriptions of the default structure, `uam_controller.xml` and `uam_plant.xml`.
///
/// # Errors
/// If a file cannot be written.
pub fn write_descriptions(folder: &Path) -> Result<Vec<Written>> {
    files::create_folder(folder)?;
    let write = |unit: Unit| {
        let path = folder.join(format!("{}.xml", unit.interface.identifier));
        files::write(&path, model_description(&unit.interface)?.as_bytes())
    };
    Unit::pair(Structure::DEFAULT).into_iter().map(write).collect()
}
