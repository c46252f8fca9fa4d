//! Files and folders, with errors that name them.

use std::fmt;
use std::fs::{self, File};
use std::io::{self, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::process;

use crate::error::{Error, Result};

/// A file that has been written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// Where it is.
    pub path: PathBuf,
    /// Whether a file with other content had this name.
    pub replaced: bool,
}

impl fmt::Display for Written {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if self.replaced { write!(f, " (replaced a file of this name with other content)") } else { Ok(()) }
    }
}

/// Reads a whole file.
///
/// # Errors
/// If it cannot be read.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    fs::read(path).map_err(|reason| Error::File { action: "read", path: path.to_owned(), reason })
}

/// Creates a folder and those above it, unless they are there.
///
/// # Errors
/// If it cannot be created.
pub fn create_folder(path: &Path) -> Result<()> {
    fs::create_dir_all(path).map_err(|reason| Error::File { action: "create folder", path: path.to_owned(), reason })
}

/// Writes a file at once: whoever reads at the same time sees the old content or the new, never a part.
///
/// # Errors
/// If it cannot be written; what stood there before is untouched then.
pub fn write(path: &Path, content: &[u8]) -> Result<Written> {
    write_with(path, |file| file.write_all(content))
}

/// Writes a file at once, with the content that `write` gives piece by piece.
///
/// # Errors
/// As [`write`](fn@write).
pub fn write_with(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<Written> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.partial", process::id()));
    let partial = path.with_file_name(name);
    let replace = || {
        let mut file = BufWriter::new(File::create(&partial)?);
        write(&mut file)?;
        // Some file systems find out only now that there is no room.
        file.into_inner()?.sync_all()?;
        let replaced = path.exists() && !same_content(path, &partial)?;
        fs::rename(&partial, path).map(|()| replaced)
    };
    match replace() {
        Ok(replaced) => Ok(Written { path: path.to_owned(), replaced }),
        Err(reason) => {
            // The first error is the one to report; the partial file may not even exist.
            let _ = fs::remove_file(&partial);
            Err(Error::File { action: "write", path: path.to_owned(), reason })
        }
    }
}

fn same_content(one: &Path, other: &Path) -> io::Result<bool> {
    let [one, other] = [File::open(one)?, File::open(other)?];
    if one.metadata()?.len() != other.metadata()?.len() {
        return Ok(false);
    }
    let mut bytes = BufReader::new(one).bytes().zip(BufReader::new(other).bytes());
    bytes.try_fold(true, |same, (one, other)| Ok(same && one? == other?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_and_nothing_is_left_over() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        for (content, replaced) in [("old", false), ("old", false), ("new", true), ("newer", true)] {
            let written = write(&path, content.as_bytes()).unwrap();
            assert_eq!(written, Written { path: path.clone(), replaced }, "{content}");
            assert_eq!(read(&path).unwrap(), content.as_bytes());
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn what_breaks_off_leaves_the_old_file_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        write(&path, b"old").unwrap();
        let error = write_with(&path, |file| {
            file.write_all(b"half of the n")?;
            Err(io::Error::other("the pen is empty"))
        });
        let error = error.unwrap_err().to_string();
        assert!(error.contains("the pen is empty") && error.contains(&path.display().to_string()), "{error}");
        assert_eq!(read(&path).unwrap(), b"old");
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
