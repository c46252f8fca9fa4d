//! The whole way, from the sources to the files, with the real compiler.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::env;
use std::fs::{self, File};
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};
use std::process::Command;

use fmu_build::platform::Platform;
use fmu_build::{BuildOptions, Built, build, workspace};
use uam::Structure;
use zip::ZipArchive;

/// Largest admissible library \[B\].
const LARGEST_LIBRARY: usize = 3_000_000;

fn build_into(folder: &Path) -> Built {
    let options = BuildOptions::new(Structure::DEFAULT, folder);
    build(&options, &|_| ()).unwrap_or_else(|error| panic!("{error}"))
}

fn entry(archive: &Path, name: &str) -> Vec<u8> {
    let mut content = Vec::new();
    ZipArchive::new(File::open(archive).unwrap()).unwrap().by_name(name).unwrap().read_to_end(&mut content).unwrap();
    content
}

fn library(fmu: &Path) -> Vec<u8> {
    let identifier = fmu.file_stem().unwrap().to_str().unwrap();
    entry(fmu, &Platform::of_this_machine().unwrap().library(identifier))
}

fn contains(content: &[u8], text: &str) -> bool {
    content.windows(text.len()).any(|window| window == text.as_bytes())
}

#[test]
fn the_sources_become_two_fmus_and_a_system() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("a/folder that does not exist yet");
    let built = build_into(&out);

    let mut files: Vec<_> = fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    files.sort();
    assert_eq!(files, ["uam.ssp", "uam_controller.fmu", "uam_plant.fmu"], "nothing is left over");

    // Whoever builds again gets the same bytes.
    let again = build_into(folder.path());
    for (one, other) in [(&built.controller, &again.controller), (&built.plant, &again.plant), (&built.ssp, &again.ssp)]
    {
        assert!(fs::read(one).unwrap() == fs::read(other).unwrap(), "{}", one.display());
    }

    for fmu in [&built.controller, &built.plant] {
        let name = format!("resources/{}", fmu.file_name().unwrap().to_str().unwrap());
        assert!(entry(&built.ssp, &name) == fs::read(fmu).unwrap(), "the system holds {}", fmu.display());
    }

    for fmu in [&built.controller, &built.plant] {
        let size = library(fmu).len();
        assert!(size <= LARGEST_LIBRARY, "{}: {size} B", fmu.display());
    }
}

/// Every file in an archive, and in the archives in it, with its name.
fn files(name: &str, archive: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut zip = ZipArchive::new(Cursor::new(archive)).unwrap();
    let mut found = Vec::new();
    for index in 0..zip.len() {
        let mut file = zip.by_index(index).unwrap();
        let mut content = Vec::new();
        file.read_to_end(&mut content).unwrap();
        let name = format!("{name}/{}", file.name().unwrap());
        if name.ends_with(".fmu") {
            found.extend(files(&name, &content));
        } else {
            found.push((name, content));
        }
    }
    found
}

#[test]
fn the_files_do_not_know_where_they_were_built() {
    let folder = tempfile::tempdir().unwrap();
    let built = build_into(folder.path());
    let home = env::home_dir().unwrap();
    let variable = |name: &str, usual: &str| env::var_os(name).map_or_else(|| home.join(usual), PathBuf::from);
    let paths = [
        home.clone(),
        workspace::root().unwrap(),
        variable("CARGO_HOME", ".cargo"),
        variable("RUSTUP_HOME", ".rustup"),
        folder.path().to_owned(),
        env::temp_dir(),
    ];
    let everything = files("uam.ssp", &fs::read(built.ssp).unwrap());
    assert!(everything.iter().any(|(name, _)| name.ends_with("uam_plant.fmu/modelDescription.xml")));
    for (name, content) in everything {
        for path in &paths {
            let path = format!("{}/", path.to_str().unwrap().trim_end_matches('/'));
            assert!(!contains(&content, &path), "{name} contains {path}");
        }
    }
}

/// Copies a folder, without what versions or builds have left there.
fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap().map(Result::unwrap) {
        let name = entry.file_name();
        let target = to.join(&name);
        match name.to_str() {
            Some(".git" | "target" | "out") => {}
            _ if entry.file_type().unwrap().is_dir() => copy(&entry.path(), &target),
            _ => drop(fs::copy(entry.path(), target).unwrap()),
        }
    }
}

/// The same cargo home, elsewhere.
#[cfg(unix)]
fn other_cargo_home(folder: &Path) {
    let home = env::var_os("CARGO_HOME").map_or_else(|| env::home_dir().unwrap().join(".cargo"), PathBuf::from);
    fs::create_dir(folder).unwrap();
    for entry in fs::read_dir(home).unwrap().map(Result::unwrap) {
        std::os::unix::fs::symlink(entry.path(), folder.join(entry.file_name())).unwrap();
    }
}

/// Compiles everything anew, which takes minutes: only in the full set.
#[cfg(unix)]
#[test]
fn the_same_sources_give_the_same_bytes_in_another_place() {
    if env::var_os("UAM_FULL").is_none_or(|value| value.is_empty()) {
        println!("skipped: building in another place (only in the full set)");
        return;
    }
    let here = tempfile::tempdir().unwrap();
    let built = build_into(here.path());

    let there = tempfile::tempdir().unwrap();
    let path = |name: &str| there.path().join(name);
    copy(&workspace::root().unwrap(), &path("a folder with another name"));
    other_cargo_home(&path("cargo"));
    let run = Command::new(env!("CARGO_BIN_EXE_uam"))
        .args(["build", "--out"])
        .arg(path("files"))
        .current_dir(path("a folder with another name"))
        .env_remove("CARGO_MANIFEST_DIR")
        .env("CARGO_HOME", path("cargo"))
        .env("CARGO_TARGET_DIR", path("compiled"))
        .output()
        .unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    assert!(path("compiled/fmu").is_dir(), "it was compiled there");
    for file in [&built.controller, &built.plant, &built.ssp] {
        let name = file.file_name().unwrap();
        assert!(fs::read(file).unwrap() == fs::read(path("files").join(name)).unwrap(), "{}", name.display());
    }
}
