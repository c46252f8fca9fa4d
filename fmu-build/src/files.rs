//! Files and folders, with errors that name them.

use std::fs;
use std::path::Path;
use std::process;

use crate::error::{Error, Result};

/// Reads a whole file.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    fs::read(path).map_err(|reason| Error::File { action: "read", path: path.to_owned(), reason })
}

/// Creates a folder and those above it, unless they are there.
pub fn create_folder(path: &Path) -> Result<()> {
    fs::create_dir_all(path).map_err(|reason| Error::File { action: "create folder", path: path.to_owned(), reason })
}

/// Writes a file at once: whoever reads at the same time sees the old content or the new, never a part.
pub fn write(path: &Path, content: &[u8]) -> Result<()> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.partial", process::id()));
    let partial = path.with_file_name(name);
    fs::write(&partial, content).and_then(|()| fs::rename(&partial, path)).map_err(|reason| {
        // The first error is the one to report; the partial file may not even exist.
        let _ = fs::remove_file(&partial);
        Error::File { action: "write", path: path.to_owned(), reason }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_and_nothing_is_left_over() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        write(&path, b"old").unwrap();
        write(&path, b"new").unwrap();
        assert_eq!(read(&path).unwrap(), b"new");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn what_cannot_be_written_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("missing/file");
        let error = write(&path, b"").unwrap_err().to_string();
        assert!(error.contains("write") && error.contains("missing/file"), "{error}");
        let blocked = folder.path().join("blocked");
        write(&blocked, b"a file").unwrap();
        let error = create_folder(&blocked.join("below")).unwrap_err().to_string();
        assert!(error.contains("folder") && error.contains("blocked/below"), "{error}");
    }
}
