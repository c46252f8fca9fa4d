//! Where the resources of a unit are, out of what hosts say of it and of where its library lies.
//!
//! The standard asks for a URI. Hosts write `file:///folder`, `file:/folder`, `file:////folder`,
//! `file://localhost/folder`, with or without a slash at the end, with special characters encoded or not, or
//! a mere path; for a Windows drive also `file://C:/folder`. Some give nothing, or another folder: but they have loaded
//! the library, which lies in `binaries/PLATFORM` of the same unit. Whatever is found is checked by its content, so
//! that trying several readings and places does no harm.

use std::path::{Path, PathBuf};

mod loaded;

pub use loaded::library;

/// The folders that `location` may stand for, the likeliest first; none for what is no file.
#[must_use]
pub fn folders(location: &str) -> Vec<PathBuf> {
    let Some(path) = path_in(location.trim()) else { return Vec::new() };
    let decoded = percent_decoded(&path);
    let readings = [decoded, Some(path)];
    let mut folders: Vec<PathBuf> = readings.into_iter().flatten().map(PathBuf::from).collect();
    folders.dedup();
    folders
}

/// The path in a URI for a file, or a path as it is.
fn path_in(location: &str) -> Option<String> {
    let is_file = location.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("file:"));
    if !is_file {
        return (!location.is_empty() && !location.contains("://")).then(|| location.to_owned());
    }
    let after = &location[5..];
    let rest = after.strip_prefix("//localhost/").unwrap_or(after).trim_start_matches('/');
    let is_drive = matches!(rest.as_bytes(), [letter, b':' | b'|', ..] if letter.is_ascii_alphabetic());
    Some(match rest.split_at_checked(2) {
        Some((drive, path)) if is_drive => format!("{}:{path}", &drive[..1]),
        _ => format!("/{rest}"),
    })
}

/// Text in which `%20` stands for a space; `None` if that gives no text.
fn percent_decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        let hexadecimal = after.get(..2).filter(|_| byte == b'%').and_then(|digits| std::str::from_utf8(digits).ok());
        // A sign is no digit, though numbers may begin with one.
        let code = hexadecimal.filter(|digits| !digits.starts_with('+')).and_then(|d| u8::from_str_radix(d, 16).ok());
        bytes.push(code.unwrap_or(byte));
        rest = if code.is_some() { &after[2..] } else { after };
    }
    String::from_utf8(bytes).ok()
}

/// The file `name` below a folder, or below the `resources` in it if the host means the unit as a whole.
pub fn candidates(folder: &Path, name: &str) -> [PathBuf; 2] {
    [folder.join(name), folder.join("resources").join(name)]
}

/// The folders with resources that may belong to a library, the likeliest first: it lies two folders below the unit's
/// own; where it is a link, that may hold for what it points to.
pub fn beside(library: &Path) -> Vec<PathBuf> {
    let resources = |library: PathBuf| library.ancestors().nth(3).map(|unit| unit.join("resources"));
    let paths = [std::path::absolute(library), library.canonicalize()];
    let mut folders: Vec<PathBuf> = paths.into_iter().flatten().filter_map(resources).collect();
    folders.dedup();
    folders
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first(location: &str) -> PathBuf {
        folders(location).swap_remove(0)
    }

    #[test]
    fn every_spelling_of_a_folder_is_understood() {
        for location in [
            "file:///tmp/a unit/resources",
            "file:///tmp/a%20unit/resources",
            "file:///tmp/a%20unit/resources/",
            "file:/tmp/a%20unit/resources",
            "file:////tmp/a%20unit/resources",
            "FILE:///tmp/a%20unit/resources",
            "file://localhost/tmp/a%20unit/resources",
            "file://tmp/a%20unit/resources",
            " /tmp/a unit/resources/ ",
            "/tmp/a unit//resources",
        ] {
            assert_eq!(first(location), Path::new("/tmp/a unit/resources"), "{location}");
        }
        for location in
            ["file:///C:/unit", "file://C:/unit", "file:/C:/unit", "file:C:/unit", "file:///C|/unit", "C:/unit"]
        {
            assert_eq!(first(location), Path::new("C:/unit"), "{location}");
        }
        assert_eq!(first("file:///tmp/%C3%A9"), Path::new("/tmp/é"));
    }

    #[test]
    fn a_percent_sign_may_also_be_meant() {
        for (location, expected) in [
            ("/tmp/100%", vec!["/tmp/100%"]),
            ("/tmp/%2", vec!["/tmp/%2"]),
            ("/tmp/%+1", vec!["/tmp/%+1"]),
            ("/tmp/%zz%é", vec!["/tmp/%zz%é"]),
            ("file:///tmp/%41", vec!["/tmp/A", "/tmp/%41"]),
            ("file:///tmp/%ff", vec!["/tmp/%ff"]),
        ] {
            assert_eq!(folders(location), expected.iter().map(PathBuf::from).collect::<Vec<_>>(), "{location}");
        }
    }

    #[test]
    fn resources_lie_beside_the_binaries() {
        for (library, expected) in [
            ("/tmp/a unit/binaries/linux64/toy.so", vec!["/tmp/a unit/resources"]),
            ("/tmp/deep/er/unit/binaries/aarch64-linux/toy.so", vec!["/tmp/deep/er/unit/resources"]),
            ("/toy.so", vec![]),
        ] {
            assert_eq!(beside(Path::new(library)), expected.iter().map(PathBuf::from).collect::<Vec<_>>(), "{library}");
        }
    }

    #[test]
    #[cfg(unix)]
    fn a_link_to_a_library_may_stand_anywhere() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path().canonicalize().unwrap();
        let (binaries, elsewhere) = (folder.join("unit/binaries/linux64"), folder.join("cache/of/libraries"));
        for folder in [&binaries, &elsewhere] {
            std::fs::create_dir_all(folder).unwrap();
        }
        std::fs::write(binaries.join("toy.so"), "").unwrap();
        std::os::unix::fs::symlink(binaries.join("toy.so"), elsewhere.join("toy.so")).unwrap();
        assert_eq!(
            beside(&elsewhere.join("toy.so")),
            ["cache/resources", "unit/resources"].map(|name| folder.join(name))
        );
    }

    /// The tests are linked into a program: its path stands for that of the library.
    #[test]
    #[cfg_attr(miri, ignore = "it asks the loader")]
    fn the_loader_knows_where_this_code_lies() {
        let found = library().unwrap().canonicalize().unwrap();
        assert_eq!(found, std::env::current_exe().unwrap().canonicalize().unwrap());
    }

    #[test]
    fn what_is_no_file_is_nowhere() {
        for location in ["", "  ", "http://example.org/resources", "ftp://x"] {
            assert_eq!(folders(location), Vec::<PathBuf>::new(), "{location}");
        }
    }
}
