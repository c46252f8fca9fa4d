//! Binaries for other machines, as far as this one can make and run them.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::env;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;

use fmu_build::compile::target_libraries;
use fmu_build::coupling::Pair;
use fmu_build::cross::{TARGETS, Target, Toolchain};
use fmu_build::fmu::Value;
use fmu_build::units::Unit;
use fmu_build::{BuildOptions, Built, build};
use uam::Structure;
use zip::ZipArchive;

/// Cross-compiling takes minutes: only in the full set.
fn wanted(target: &Target) -> bool {
    let name = target.platform.folder;
    if env::var_os("UAM_FULL").is_none_or(|value| value.is_empty()) {
        println!("skipped: {name} (only in the full set)");
        return false;
    }
    let missing = target.lacks(target_libraries);
    if !missing.is_empty() {
        println!("skipped: {name}, for this is missing: {}", missing.join("; "));
    }
    missing.is_empty()
}

fn built(target: &'static Target) -> Built {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("platforms").join(target.platform.folder);
    let options =
        BuildOptions { toolchains: vec![Toolchain::Cross(target)], ..BuildOptions::new(Structure::DEFAULT, folder) };
    build(&options, &|_| ()).unwrap_or_else(|error| panic!("{error}"))
}

fn library(fmu: &Path, target: &Target) -> Vec<u8> {
    let name = target.platform.library(fmu.file_stem().unwrap().to_str().unwrap());
    let mut content = Vec::new();
    ZipArchive::new(File::open(fmu).unwrap()).unwrap().by_name(&name).unwrap().read_to_end(&mut content).unwrap();
    content
}

/// Every `GLIBC_2.n` in a library: n.
fn glibc_versions(library: &[u8]) -> Vec<u32> {
    let prefix = b"GLIBC_2.";
    let found = library.windows(prefix.len()).enumerate().filter(|(_, window)| window == prefix);
    found
        .map(|(position, _)| {
            let digits = library[position + prefix.len()..].iter().take_while(|byte| byte.is_ascii_digit());
            digits.fold(0, |number, digit| 10 * number + u32::from(digit - b'0'))
        })
        .collect()
}

/// Where the UAV is after a second with its first joint moving.
const OUTPUTS: [&str; 4] = ["base.x", "base.y", "base.roll", "autopilot.thrust"];

fn end(plant: &fmu_build::fmu::Fmu) -> Vec<f64> {
    let mut plant = plant.instantiate("plant").unwrap();
    plant.enter_initialization(0.0, 2.0).unwrap();
    plant.exit_initialization().unwrap();
    plant.set_value("joint[1].rate_command", Value::Real(0.5)).unwrap();
    (0..1000).for_each(|n| plant.do_step(f64::from(n) * 1e-3, 1e-3).unwrap());
    let values = OUTPUTS.map(|name| plant.value(name).unwrap());
    values.map(|value| if let Value::Real(value) = value { value } else { panic!("no number") }).to_vec()
}

#[test]
fn linux64_runs_with_old_systems() {
    let target = &TARGETS[0];
    if !wanted(target) {
        return;
    }
    let built = built(target);
    for fmu in [&built.controller, &built.plant] {
        let versions = glibc_versions(&library(fmu, target));
        assert!(versions.contains(&2) && versions.iter().all(|version| *version <= 17), "{versions:?}");
    }
    if cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        let own = build(&BuildOptions::new(Structure::DEFAULT, built.plant.with_file_name("own")), &|_| ()).unwrap();
        let [built, own] = [built, own].map(|built| Pair::open(&built.controller, &built.plant).unwrap());
        assert_eq!(end(&built.plant), end(&own.plant));
    }
}

/// Debian has the program in the package `wine64` or `wine`.
fn wine() -> Option<PathBuf> {
    let folders = env::split_paths(&env::var_os("PATH").unwrap_or_default()).collect::<Vec<_>>();
    let programs = folders.into_iter().chain([PathBuf::from("/usr/lib/wine")]);
    programs.flat_map(|folder| [folder.join("wine"), folder.join("wine64")]).find(|program| program.is_file())
}

#[test]
fn win64_runs_under_wine_and_agrees() {
    let target = &TARGETS[1];
    if !wanted(target) {
        return;
    }
    let built_for_windows = built(target);
    let Some(wine) = wine() else {
        println!("skipped: running win64, there is no wine");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/windows/host.c");
    let compiler = ["-std=c11", "-Wall", "-Wextra", "-Wno-cast-function-type", "-Werror", "-o"];
    let compiled =
        Command::new("x86_64-w64-mingw32-gcc").args(compiler).args([path("host.exe"), source]).status().unwrap();
    assert!(compiled.success());
    fs::write(path("plant.dll"), library(&built_for_windows.plant, target)).unwrap();

    let interface = Unit::plant(Structure::DEFAULT).interface;
    let reference =
        |name: &str| interface.variables.iter().position(|variable| variable.name == name).unwrap().to_string();
    let output = Command::new(wine)
        .arg(path("host.exe"))
        .arg(path("plant.dll"))
        .args([&interface.guid, &reference("joint[1].rate_command")])
        .args(OUTPUTS.map(reference))
        .env("WINEPREFIX", path("wine"))
        .env("WINEDEBUG", "-all")
        .output()
        .unwrap();
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{out}{err}");
    assert!(err.contains("joint[1].rate_command must be a finite number, but is NaN"), "{err}");

    let there: Vec<f64> = out.lines().map(|line| line.trim().parse().unwrap()).collect();
    let own = build(&BuildOptions::new(Structure::DEFAULT, path("own")), &|_| ()).unwrap();
    let here = end(&Pair::open(&own.controller, &own.plant).unwrap().plant);
    assert_eq!(there.len(), here.len());
    assert!(here.iter().any(|value| value.abs() > 1e-3), "it moves: {here:?}");
    for ((name, here), there) in OUTPUTS.iter().zip(&here).zip(&there) {
        // The mathematical functions of another system round differently.
        assert!((here - there).abs() < 1e-9, "{name}: {here} here, {there} on Windows");
    }
}

#[test]
fn other_platforms_are_what_they_say() {
    for (target, magic) in [(&TARGETS[2], [0xca, 0xfe, 0xba, 0xbe]), (&TARGETS[3], *b"\x7fELF")] {
        if !wanted(target) {
            continue;
        }
        let built = built(target);
        for fmu in [&built.controller, &built.plant] {
            assert_eq!(library(fmu, target)[..4], magic, "{}", target.platform.folder);
        }
    }
}
