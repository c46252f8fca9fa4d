//! Importer of FMI 2.0 co-simulation units: opens .fmu files as any master would, through nothing but the
//! model description and the C interface of the library inside.
//!
//! [`Fmu::open`] unpacks and loads; [`Fmu::instantiate`] starts an [`Instance`], of which there may be
//! several. Many variables are read or written at once through a [`Selection`], which looks names up only once.

use std::path::{Path, PathBuf};
use std::sync::Arc;

mod archive;
mod c;
mod description;
mod error;
mod instance;
mod log;
mod selection;

pub use description::{Causality, DataType, Description, Variable};
pub use error::Error;
pub use instance::Instance;
pub use log::Message;
pub use selection::{Selection, Values};

/// What the C interface answers to a call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// All well.
    Ok,
    /// Done, but there is something to say.
    Warning,
    /// The step was not finished, or the information is not there.
    Discard,
    /// The instance cannot go on from here.
    Error,
    /// Nothing of this unit can be used any more.
    Fatal,
    /// Not finished yet; for asynchronous calls, which are not used here.
    Pending,
    /// A number that the standard does not know.
    Unknown(i32),
}

impl From<i32> for Status {
    #[inline]
    fn from(number: i32) -> Self {
        match number {
            0 => Self::Ok,
            1 => Self::Warning,
            2 => Self::Discard,
            3 => Self::Error,
            4 => Self::Fatal,
            5 => Self::Pending,
            other => Self::Unknown(other),
        }
    }
}

impl std::fmt::Display for Status {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Ok => write!(f, "fmi2OK"),
            Self::Warning => write!(f, "fmi2Warning"),
            Self::Discard => write!(f, "fmi2Discard"),
            Self::Error => write!(f, "fmi2Error"),
            Self::Fatal => write!(f, "fmi2Fatal"),
            Self::Pending => write!(f, "fmi2Pending"),
            Self::Unknown(number) => write!(f, "the unknown status {number}"),
        }
    }
}

/// Value of one variable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// A real number in the unit of the model description.
    Real(f64),
    /// A whole number, or the number of an enumeration's item.
    Integer(i32),
    /// A truth value.
    Boolean(bool),
}

impl Value {
    /// The type in words.
    #[must_use]
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Real(_) => "a real number",
            Self::Integer(_) => "a whole number",
            Self::Boolean(_) => "a truth value",
        }
    }
}

/// An opened .fmu file: its description, and its library in memory.
#[derive(Debug, Clone)]
pub struct Fmu {
    loaded: Arc<Loaded>,
}

/// What instances need to stay alive. The library stands before the folder: it is unloaded before its
/// file goes.
#[derive(Debug)]
struct Loaded {
    path: PathBuf,
    description: Description,
    functions: c::Functions,
    folder: archive::Unpacked,
}

impl Fmu {
    /// Unpacks the file into a temporary folder, which goes with the last instance, and loads its library.
    ///
    /// # Errors
    /// If the file is no FMI 2.0 co-simulation unit, or has no library for this platform.
    pub fn open(path: &Path) -> Result<Self, Error> {
        let folder = archive::Unpacked::from(path)?;
        let text = folder.model_description()?;
        let description = Description::parse(&text)
            .map_err(|reason| Error::Description { path: path.to_owned(), reason: reason.to_string() })?;
        let library = folder.library(&description.model_identifier)?;
        let functions = c::Functions::load(&library)?;
        Ok(Self { loaded: Arc::new(Loaded { path: path.to_owned(), description, functions, folder }) })
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.loaded.path
    }

    /// What the model description says.
    #[must_use]
    pub fn description(&self) -> &Description {
        &self.loaded.description
    }

    /// Starts an instance.
    ///
    /// # Errors
    /// If the unit refuses; its own messages say why.
    pub fn instantiate(&self, name: &str) -> Result<Instance, Error> {
        Instance::new(Arc::clone(&self.loaded), name)
    }
}
