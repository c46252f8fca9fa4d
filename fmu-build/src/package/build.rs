//! From the libraries to `uam_controller.fmu`, `uam_plant.fmu` and `uam.ssp`.

use std::path::{Path, PathBuf};

use uam::Structure;

use crate::compile;
use crate::compile::cross::Toolchain;
use crate::error::{Error, Result};
use crate::files::Written;
use crate::package::contents::fmu;
use crate::package::description::model_description;
use crate::package::design::Design;
use crate::package::ssp::{Component, ssp};
use crate::package::units::Unit;
use crate::{files, workspace};

const SSP_NAME: &str = "uam.ssp";

/// What to build, and where to put it.
#[derive(Debug, Clone)]
pub struct BuildOptions {
    /// The pair.
    pub design: Design,
    /// What compiles the libraries, one for each platform that the FMUs are for.
    pub toolchains: Vec<Toolchain>,
    /// A folder in the sources to compile; without one, what is not inside the program is compiled from those around
    /// the current folder.
    pub sources: Option<PathBuf>,
    /// Folder for the files; created if it is missing.
    pub folder: PathBuf,
}

impl BuildOptions {
    /// To build this, there, for this machine.
    pub fn new(design: impl Into<Design>, folder: impl Into<PathBuf>) -> Self {
        Self { design: design.into(), toolchains: vec![Toolchain::Own], sources: None, folder: folder.into() }
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

/// Writes the two FMUs with the libraries of both units, and the SSP.
///
/// `progress` is told, line by line, what is being done.
///
/// # Errors
/// If the start values do not go together, the sources are not found, do not compile, or a file cannot be written.
pub fn build(options: &BuildOptions, progress: &dyn Fn(&str)) -> Result<Built> {
    options.design.check()?;
    let [controller, plant] = Unit::pair(options.design.clone());
    let is_compiled = |toolchain: &Toolchain| options.sources.is_some() || *toolchain != Toolchain::Own;
    // Where the program holds no libraries, it is run from the sources that it was made of.
    if unit_libraries::held(plant.interface.identifier).is_some() && options.toolchains.iter().any(is_compiled) {
        check_sources(&workspace::find(options.sources.as_deref())?)?;
    }
    let mut libraries = [Vec::new(), Vec::new()];
    for toolchain in &options.toolchains {
        let platform = toolchain.platform()?;
        let units = [controller.interface.identifier, plant.interface.identifier];
        let made = compile::libraries(&units, *toolchain, options.sources.as_deref(), progress)?;
        libraries.iter_mut().zip(made).for_each(|(of_unit, library)| of_unit.push((platform, library)));
    }

    let pack = |unit: &Unit, libraries: &[_]| fmu(unit, libraries)?.to_bytes(&unit.interface.file_name());
    let [controller_fmu, plant_fmu] = [pack(&controller, &libraries[0])?, pack(&plant, &libraries[1])?];
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

/// Whether units compiled from the sources have the variables that this program knows.
fn check_sources(sources: &Path) -> Result<()> {
    for unit in Unit::pair(Structure::DEFAULT) {
        let file = format!("modelDescription/{}.xml", unit.interface.identifier);
        let there = files::read(&sources.join(&file))?;
        // Git may have changed the ends of lines.
        if !String::from_utf8_lossy(&there).lines().eq(model_description(&unit.interface)?.lines()) {
            return Err(Error::OtherSources { sources: sources.to_owned(), file });
        }
    }
    Ok(())
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sources_of_another_version_are_refused() {
        check_sources(&workspace::root().unwrap()).unwrap();

        let other = tempfile::tempdir().unwrap();
        write_descriptions(&other.path().join("modelDescription")).unwrap();
        check_sources(other.path()).unwrap();
        let file = other.path().join("modelDescription/uam_plant.xml");
        let text = String::from_utf8(files::read(&file).unwrap()).unwrap();
        files::write(&file, text.replace("joint[1]", "joint[one]").as_bytes()).unwrap();
        let error = check_sources(other.path()).unwrap_err().to_string();
        assert!(error.contains("uam_plant.xml") && error.contains("cargo install"), "{error}");
    }
}
