//! Where the sources of the units are.

use std::env;
use std::path::{Path, PathBuf};

use crate::error::{Error, Result};

/// A file that only the root of the workspace has below it.
const LANDMARK: &str = "fmu-build/plant/Cargo.toml";

/// The root of the workspace: above the package that cargo runs, or above the current folder.
///
/// # Errors
/// If neither is inside the project.
pub fn root() -> Result<PathBuf> {
    let package = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    first_above(package.into_iter().chain(env::current_dir().ok()).collect())
}

/// The root of the workspace that a folder is in; without one, as [`root`].
///
/// # Errors
/// If it is in none.
pub fn find(folder: Option<&Path>) -> Result<PathBuf> {
    let Some(folder) = folder else { return root() };
    // Paths that are kept out of the libraries must be those that the compiler sees, without symbolic links. On Windows,
    // what has none of them is of a form that few programs understand.
    let straight = if cfg!(windows) { std::path::absolute(folder) } else { folder.canonicalize() };
    let refused = |reason| Error::File { action: "look for the sources in", path: folder.to_owned(), reason };
    first_above(vec![straight.map_err(refused)?])
}

fn first_above(searched: Vec<PathBuf>) -> Result<PathBuf> {
    let found = searched.iter().find_map(|start| above(start)).map(Path::to_owned);
    found.ok_or(Error::NoWorkspace { searched })
}

fn above(start: &Path) -> Option<&Path> {
    start.ancestors().find(|folder| folder.join(LANDMARK).is_file())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_is_found_from_anywhere_inside() {
        let package = Path::new(env!("CARGO_MANIFEST_DIR"));
        let root = package.parent();
        assert_eq!(above(&package.join("src")), root);
        assert_eq!(above(Path::new("/")), None);
    }

    #[test]
    fn a_folder_that_is_named_is_the_only_one_to_be_searched() {
        let package = Path::new(env!("CARGO_MANIFEST_DIR"));
        let root = package.parent().unwrap().canonicalize().unwrap();
        assert_eq!(find(Some(&package.join("src/../tests"))).unwrap(), root);
        let elsewhere = tempfile::tempdir().unwrap();
        let error = find(Some(elsewhere.path())).unwrap_err().to_string();
        assert!(error.contains("--sources") && !error.contains(env!("CARGO_MANIFEST_DIR")), "{error}");
        let error = find(Some(&elsewhere.path().join("missing"))).unwrap_err().to_string();
        assert!(error.contains("missing"), "{error}");
    }
}
