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
    let searched: Vec<PathBuf> = package.into_iter().chain(env::current_dir().ok()).collect();
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
}
