//! The files of an FMU, unpacked into a temporary folder.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use super::Error;
use crate::platform::Platform;

/// An unpacked FMU; the folder is removed when this is dropped.
#[derive(Debug)]
pub struct Unpacked {
    /// The .fmu file, for messages.
    origin: PathBuf,
    folder: tempfile::TempDir,
}

impl Unpacked {
    pub fn from(path: &Path) -> Result<Self, Error> {
        let unreadable = |source| Error::File { path: path.to_owned(), source };
        let no_archive = |source| Error::Archive { path: path.to_owned(), source };
        let file = File::open(path).map_err(unreadable)?;
        let mut archive = zip::ZipArchive::new(file).map_err(no_archive)?;
        let folder = tempfile::Builder::new().prefix("fmu-").tempdir().map_err(unreadable)?;
        archive.extract(folder.path()).map_err(no_archive)?;
        Ok(Self { origin: path.to_owned(), folder })
    }

    pub fn model_description(&self) -> Result<String, Error> {
        fs::read_to_string(self.folder.path().join("modelDescription.xml"))
            .map_err(|source| Error::File { path: self.origin.join("modelDescription.xml"), source })
    }

    /// The library for this machine.
    pub fn library(&self, model_identifier: &str) -> Result<PathBuf, Error> {
        let expected = Platform::of_this_machine()?.library(model_identifier);
        let library = self.folder.path().join(&expected);
        if library.is_file() {
            return Ok(library);
        }
        let offered = names_in(&self.folder.path().join("binaries"));
        Err(Error::Platform { path: self.origin.clone(), expected, offered })
    }

    /// `file:` URI of the resources folder, percent-encoded.
    pub fn resources(&self) -> String {
        let path = self.folder.path().join("resources").to_string_lossy().replace('\\', "/");
        let root = if path.starts_with('/') { "file://" } else { "file:///" };
        let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"/:-._~".contains(&byte);
        let encode = |byte: u8| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") };
        std::iter::once(root.to_owned()).chain(path.bytes().map(encode)).collect()
    }
}

fn names_in(folder: &Path) -> String {
    let mut names: Vec<String> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}
