//! The whole way, from the sources to the files, with the real compiler.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::env;
use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use fmu_build::platform::Platform;
use fmu_build::{BuildOptions, Built, build, workspace};
use uam::Structure;
use zip::ZipArchive;

/// Largest admissible library \[B\].
const LARGEST_LIBRARY: usize = 1 << 20;

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

    let workspace = workspace::root().unwrap();
    let home = env::home_dir().unwrap();
    for fmu in [&built.controller, &built.plant] {
        let library = library(fmu);
        assert!(library.len() <= LARGEST_LIBRARY, "{}: {} B", fmu.display(), library.len());
        for folder in [&workspace, &home.join(".cargo"), &home.join(".rustup")] {
            let folder = folder.to_str().unwrap();
            assert!(!contains(&library, folder), "{} contains {folder}", fmu.display());
        }
    }
}
