//! An FMU: description, library, documentation, licences and picture in one archive.

use uam::fmi::start_file;

use crate::error::Result;
use crate::package::archive::Archive;
use crate::package::description::model_description;
use crate::package::documentation;
use crate::package::terminals;
use crate::package::units::Unit;
use crate::platform::Platform;

/// Texts of the licences, by name of the file.
const LICENSES: [(&str, &str); 3] = [
    ("LICENSE-MIT", include_str!("../../../LICENSE-MIT")),
    ("LICENSE-APACHE", include_str!("../../../LICENSE-APACHE")),
    ("THIRD-PARTY", THIRD_PARTY),
];
/// What in the libraries is by others, and under which licences.
pub const THIRD_PARTY: &str = include_str!("../../../modelDescription/THIRD-PARTY");

/// The FMU of a unit with its library for each of some platforms.
///
/// # Errors
/// If the model description cannot be put together.
pub fn fmu(unit: &Unit, libraries: &[(Platform, Vec<u8>)]) -> Result<Archive> {
    let mut archive = Archive::default();
    archive.add("modelDescription.xml", model_description(&unit.interface)?);
    for (platform, library) in libraries {
        for path in platform.libraries(unit.interface.identifier) {
            archive.add_executable(path, library.as_slice());
        }
    }
    archive.add("documentation/index.html", documentation::page(unit));
    for (name, text) in LICENSES {
        archive.add(format!("documentation/licenses/{name}"), text);
    }
    archive.add("model.png", unit.icon);
    if let Some(members) = &unit.terminal {
        archive.add(format!("{}/terminalsAndIcons.xml", terminals::FOLDER), terminals::terminals_and_icons(members)?);
        archive.add(format!("{}/icon.png", terminals::FOLDER), unit.icon);
    }
    if let Some(text) = &unit.interface.start_file {
        archive.add(format!("resources/{}", start_file::NAME), text.as_str());
    }
    Ok(archive)
}
