//! What can go wrong between this program and an FMU.

use std::path::PathBuf;

use super::{DataType, Description, Message, Status, Value};

/// An error that says which file or unit, what was expected, and what the unit itself had to say.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The file or a file in it cannot be read or written.
    #[error("cannot read {path}")]
    File {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file is no archive.
    #[error("{path} is no zip archive that can be unpacked, so no FMU")]
    Archive {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: zip::result::ZipError,
    },
    /// The model description is not what FMI 2.0 co-simulation asks for.
    #[error("modelDescription.xml of {path}: {reason}")]
    Description {
        /// Which FMU.
        path: PathBuf,
        /// What is wrong in it.
        reason: String,
    },
    /// FMI has no name for this machine.
    #[error(transparent)]
    Machine(#[from] crate::Error),
    /// There is no library for this machine.
    #[error("{path} has no {expected} for this machine; it offers {offered}")]
    Platform {
        /// Which FMU.
        path: PathBuf,
        /// Where the library should be.
        expected: String,
        /// What there is.
        offered: String,
    },
    /// The library cannot be loaded, or one of the functions is missing.
    #[error("cannot load {library}")]
    Library {
        /// Which library, or which function of it.
        library: String,
        /// Why.
        source: libloading::Error,
    },
    /// A name that cannot be handed to C.
    #[error("the instance name {name:?} contains a zero byte")]
    InstanceName {
        /// The name.
        name: String,
    },
    /// The unit did not start.
    #[error("{unit} does not start: {}", said(messages))]
    Instantiate {
        /// Name of the instance.
        unit: String,
        /// What it logged.
        messages: Vec<Message>,
    },
    /// A call failed.
    #[error("{unit}: {call} answers {status}: {}", said(messages))]
    Call {
        /// Name of the instance.
        unit: String,
        /// The C function.
        call: &'static str,
        /// Its answer.
        status: Status,
        /// What the unit logged during the call.
        messages: Vec<Message>,
    },
    /// A variable that the unit does not have.
    #[error("{unit} has no variable `{name}`{}", proposal(nearest.as_deref()))]
    Name {
        /// Name of the unit.
        unit: String,
        /// The name asked for.
        name: String,
        /// The most similar name that there is.
        nearest: Option<String>,
    },
    /// A value of the wrong type.
    #[error("`{name}` of {unit} is of type {expected}, not {found}")]
    Type {
        /// Name of the unit.
        unit: String,
        /// Name of the variable.
        name: String,
        /// Its type.
        expected: DataType,
        /// What was wanted.
        found: &'static str,
    },
}

impl Error {
    /// There is no variable of this name.
    pub(crate) fn unknown(description: &Description, name: &str) -> Self {
        let similarity = |other: &str| strsim::jaro_winkler(other, name);
        let names = description.variables.iter().map(|variable| variable.name.as_str());
        let nearest = names.max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
        Self::Name { unit: description.model_name.clone(), name: name.to_owned(), nearest: nearest.map(str::to_owned) }
    }

    /// The variable does not take values of this type.
    pub(crate) fn mismatch(description: &Description, name: &str, value: Value) -> Self {
        description.find(name).map_or_else(
            || Self::unknown(description, name),
            |variable| Self::Type {
                unit: description.model_name.clone(),
                name: name.to_owned(),
                expected: variable.data_type,
                found: value.type_name(),
            },
        )
    }
}

fn proposal(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |near| format!("; nearest is `{near}`"))
}

/// The unit's own words on one line.
fn said(messages: &[Message]) -> String {
    if messages.is_empty() {
        return "it gives no reason".to_owned();
    }
    messages.iter().map(|message| message.text.as_str()).collect::<Vec<_>>().join("; ")
}
