//! ZIP archives whose bytes depend on nothing but their content: FMUs and SSPs are such archives.

use std::collections::BTreeMap;
use std::io::{Cursor, Write};

use zip::result::ZipResult;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, System, ZipWriter};

use crate::error::{Error, Result};

const READABLE: u32 = 0o644;
const EXECUTABLE: u32 = 0o755;

/// An archive in the making.
#[derive(Debug, Default)]
pub struct Archive {
    /// Content and permissions by path; sorted, so that the order of adding does not matter.
    entries: BTreeMap<String, (Vec<u8>, u32)>,
}

impl Archive {
    /// Adds a file; `path` is separated by `/`.
    pub fn add(&mut self, path: impl Into<String>, content: impl Into<Vec<u8>>) {
        self.entries.insert(path.into(), (content.into(), READABLE));
    }

    /// Adds a file that may be executed, for instance a shared library.
    pub fn add_executable(&mut self, path: impl Into<String>, content: impl Into<Vec<u8>>) {
        self.entries.insert(path.into(), (content.into(), EXECUTABLE));
    }

    /// The bytes of the archive; `name` is for errors.
    ///
    /// # Errors
    /// If it cannot be put together.
    pub fn to_bytes(&self, name: &str) -> Result<Vec<u8>> {
        self.compress().map_err(|reason| Error::Document { document: name.to_owned(), reason: reason.to_string() })
    }

    fn compress(&self) -> ZipResult<Vec<u8>> {
        // Time and system are stated, not taken from the building machine.
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .last_modified_time(DateTime::DEFAULT)
            .system(System::Unix);
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        for (path, (content, permissions)) in &self.entries {
            zip.start_file(path, options.unix_permissions(*permissions))?;
            zip.write_all(content)?;
        }
        Ok(zip.finish()?.into_inner())
    }
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use zip::ZipArchive;

    use super::*;

    fn sample(paths: [&str; 3]) -> Archive {
        let mut archive = Archive::default();
        for path in paths {
            archive.add(path, path.as_bytes());
        }
        archive.add_executable("binaries/linux64/unit.so", vec![0; 1000]);
        archive
    }

    #[test]
    fn bytes_do_not_depend_on_the_order_of_adding() {
        let bytes = |paths| sample(paths).to_bytes("sample").unwrap();
        assert_eq!(bytes(["a", "b/c", "d"]), bytes(["d", "a", "b/c"]));
    }

    #[test]
    fn content_and_permissions_come_back() {
        let bytes = sample(["a", "b/c", "d"]).to_bytes("sample").unwrap();
        let mut zip = ZipArchive::new(Cursor::new(bytes)).unwrap();
        let names: Vec<_> = zip.file_names().map(|name| name.unwrap().into_owned()).collect();
        assert_eq!(names, ["a", "b/c", "binaries/linux64/unit.so", "d"]);
        let mut file = zip.by_name("b/c").unwrap();
        let mut content = String::new();
        file.read_to_string(&mut content).unwrap();
        assert_eq!(content, "b/c");
        assert_eq!(file.unix_mode().map(|mode| mode & 0o777), Some(READABLE));
        drop(file);
        let library = zip.by_name("binaries/linux64/unit.so").unwrap();
        assert_eq!(library.unix_mode().map(|mode| mode & 0o777), Some(EXECUTABLE));
        assert_eq!(library.last_modified(), Some(DateTime::DEFAULT));
    }
}
