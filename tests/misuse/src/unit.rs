//! A unit as a host finds it: the .fmu file, unpacked, read and loaded.

use std::error::Error;
use std::ffi::CString;
use std::fs::{self, File};
use std::path::Path;

use fmu_build::platform::Platform;
use uam::Structure;
use uam::fmi::Model;
use uam::units::controller::ControllerUnit;
use uam::units::plant::PlantUnit;
use uam::variables::{Causality, Kind, Table};

use crate::functions::Functions;
use crate::host;

/// What the model description says of a variable.
pub struct Variable {
    /// Value reference.
    pub reference: u32,
    /// Whether it is an output.
    pub output: bool,
    /// Whether it is of type Real.
    pub real: bool,
    /// Name.
    pub name: String,
}

/// An unpacked and loaded FMU.
pub struct Unit {
    /// Model identifier.
    pub name: String,
    /// Identity of the unit that the file describes.
    pub guid: CString,
    /// Its variables.
    pub variables: Vec<Variable>,
    /// The functions of its library, which serves every structure.
    pub functions: Functions,
    /// Stays as long as the library is loaded.
    _folder: tempfile::TempDir,
}

impl Variable {
    /// Those of a unit of another structure, which the same library serves.
    pub fn of(identifier: &str, structure: Structure) -> Vec<Self> {
        fn list<D>(table: &Table<D>) -> Vec<Variable> {
            let variables = (0..).zip(table.variables());
            variables
                .map(|(reference, variable)| Variable {
                    reference,
                    output: variable.causality == Causality::Output,
                    real: matches!(variable.kind, Kind::Real { .. }),
                    name: variable.name.clone(),
                })
                .collect()
        }
        if identifier == PlantUnit::IDENTIFIER {
            list(&PlantUnit::table(structure))
        } else {
            list(&ControllerUnit::table(structure))
        }
    }

    /// Whether its value is a number that the unit computes.
    pub fn real_output(&self) -> bool {
        self.real && self.output
    }
}

impl Unit {
    /// Opens a .fmu file. Its library is loaded with global symbols.
    ///
    /// # Errors
    /// If it is no FMU for this machine.
    pub fn open(path: &Path) -> Result<Self, Box<dyn Error>> {
        let folder = tempfile::tempdir()?;
        host::forget_name(folder.path());
        zip::ZipArchive::new(File::open(path)?)?.extract(folder.path())?;
        let text = fs::read_to_string(folder.path().join("modelDescription.xml"))?;
        let description = roxmltree::Document::parse(&text)?;
        let root = description.root_element();
        let attribute = |name: &str| root.attribute(name).ok_or_else(|| format!("{name} is missing"));
        let name = attribute("modelName")?.to_owned();
        let variables = root.descendants().filter(|node| node.has_tag_name("ScalarVariable"));
        let variables: Result<Vec<_>, Box<dyn Error>> = variables
            .map(|node| {
                Ok(Variable {
                    reference: node.attribute("valueReference").ok_or("no value reference")?.parse()?,
                    output: node.attribute("causality") == Some("output"),
                    real: node.first_element_child().is_some_and(|kind| kind.has_tag_name("Real")),
                    name: node.attribute("name").ok_or("no name")?.to_owned(),
                })
            })
            .collect();
        let library = folder.path().join(Platform::of_this_machine()?.library(&name));
        Ok(Self {
            guid: CString::new(attribute("guid")?)?,
            variables: variables?,
            functions: Functions::load(&library)?,
            name,
            _folder: folder,
        })
    }

    /// Value reference of a variable.
    pub fn reference(&self, name: &str) -> Option<u32> {
        self.variables.iter().find(|variable| variable.name == name).map(|variable| variable.reference)
    }
}
