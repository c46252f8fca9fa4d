//! Binaries for other machines, as far as this one can make and run them.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;

use fmu_build::compile::cross::{TARGETS, Target, Toolchain};
use fmu_build::host::coupling::Pair;
use fmu_build::host::fmu::{Fmu, Value};
use fmu_build::package::units::Unit;
use fmu_build::platform::DARWIN64;
use fmu_build::{BuildOptions, Built, Design, build};
use object::macho::{CPU_TYPE_ARM64, DylibCommand, LC_CODE_SIGNATURE, LC_ID_DYLIB, MachHeader64};
use object::read::macho::{FatArch, MachHeader, MachOFatFile32};
use object::read::{NameOrOrdinal, Object};
use object::{Architecture, Endianness};
use uam::Structure;
use uam::fmi::start_file;
use zip::ZipArchive;

mod common;

use common::emulators::{self, wanted};

/// Largest admissible library for one processor \[B\].
const LARGEST: usize = 3_000_000;
/// How many functions FMI 2.0 has.
const FUNCTIONS: usize = 44;
/// Endings of what Zig's linker exports for macOS whatever it is told; names are sought in each library by itself
/// there.
const ON_MACOS: &[&str] = &["mh_dylib_header", "dso_handle", "rust_eh_personality", "EMPTY_PANIC"];

/// Libraries that every system of a platform has.
const OF_LINUX: &[&str] =
    &["libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"];
const OF_WINDOWS: &[&str] = &["KERNEL32.dll", "msvcrt.dll", "ntdll.dll", "api-ms-win-core-synch-l1-2-0.dll"];
const OF_MACOS: &[&str] = &["/usr/lib/libSystem.B.dylib", "/usr/lib/libiconv.2.dylib", "/usr/lib/libcharset.1.dylib"];

/// A vehicle with a start value of its own: its units need their resources.
fn design() -> Design {
    let mut design = Design::from(Structure::DEFAULT);
    design.parameters.uav.mass = 4.0 + 1.0 / 3.0;
    design
}

fn built(target: &'static Target) -> Built {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("platforms").join(target.platform.folder);
    let options = BuildOptions { toolchains: vec![Toolchain::Cross(target)], ..BuildOptions::new(design(), folder) };
    build(&options, &|_| ()).unwrap_or_else(|error| panic!("{error}"))
}

fn library(fmu: &Path, target: &Target) -> Vec<u8> {
    let name = target.platform.library(fmu.file_stem().unwrap().to_str().unwrap());
    let mut content = Vec::new();
    ZipArchive::new(File::open(fmu).unwrap()).unwrap().by_name(&name).unwrap().read_to_end(&mut content).unwrap();
    content
}

/// The libraries in an FMU, one for each processor.
fn libraries(fmu: &Path, target: &Target) -> Vec<Vec<u8>> {
    let library = library(fmu, target);
    let Ok(universal) = MachOFatFile32::parse(library.as_slice()) else { return vec![library] };
    universal.arches().iter().map(|arch| arch.data(library.as_slice()).unwrap().to_owned()).collect()
}

fn text(name: NameOrOrdinal<impl AsRef<[u8]>>) -> String {
    match name {
        NameOrOrdinal::Name(name) => String::from_utf8(name.as_ref().to_owned()).unwrap(),
        NameOrOrdinal::Ordinal(number) => format!("number {number}"),
    }
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

/// Checks both libraries of a platform: small, for these processors, with the functions of FMI, and with nothing to
/// load that its systems do not have.
fn check(built: &Built, target: &Target, processors: &[Architecture], systems: &[&str]) {
    for fmu in [&built.controller, &built.plant] {
        let libraries = libraries(fmu, target);
        let files: Vec<_> = libraries.iter().map(|library| object::File::parse(library.as_slice()).unwrap()).collect();
        let found: Vec<_> = files.iter().map(Object::architecture).collect();
        assert_eq!(found, processors, "{}", fmu.display());
        for (library, file) in libraries.iter().zip(&files) {
            let what = format!("{} for {:?}", fmu.display(), file.architecture());
            assert!(library.len() <= LARGEST, "{what}: {} B", library.len());
            println!("{what}: {} B", library.len());

            // Names in C begin with an underscore on macOS, where Zig's linker exports a few of its own.
            let (prefix, others) = if target.platform == DARWIN64 { ("_fmi2", ON_MACOS) } else { ("fmi2", &[] as _) };
            let exports: Vec<_> = file.exports().unwrap().map(|export| text(export.unwrap().name())).collect();
            let (functions, rest): (Vec<_>, Vec<_>) = exports.iter().partition(|name| name.starts_with(prefix));
            assert_eq!(functions.len(), FUNCTIONS, "{what}: {functions:?}");
            let stray = rest.iter().find(|name| !others.iter().any(|other| name.ends_with(other)));
            assert_eq!(stray, None, "{what}");

            // What Linux says of symbols names versions of the C library, not files: these stand on their own.
            let loaded = file.import_libraries().unwrap().map(|library| library.unwrap().name());
            let foreign: Vec<_> = loaded
                .map(|name| String::from_utf8_lossy(name).into_owned())
                .filter(|name| !systems.contains(&name.as_str()))
                .collect();
            assert!(foreign.is_empty(), "{what} loads {foreign:?}");

            let versions = glibc_versions(library);
            assert!(versions.iter().all(|version| *version <= 17), "{what}: glibc {versions:?}");
        }
    }
}

/// A second of a unit with one input set, and where it ends.
struct Trial {
    unit: fn(Design) -> Unit,
    file: fn(&Built) -> &PathBuf,
    fmu: fn(&Pair) -> &Fmu,
    input: &'static str,
    outputs: [&'static str; 4],
}

const TRIALS: [Trial; 2] = [
    Trial {
        unit: Unit::plant,
        file: |built| &built.plant,
        fmu: |pair| &pair.plant,
        input: "joint[1].rate_command",
        outputs: ["base.x", "base.y", "base.roll", "autopilot.thrust"],
    },
    // It follows its own path, whatever comes from outside.
    Trial {
        unit: Unit::controller,
        file: |built| &built.controller,
        fmu: |pair| &pair.controller,
        input: "external_reference.x",
        outputs: ["joint[1].rate_command", "joint[3].rate_command", "predicted.base.y", "reference.y"],
    },
];

impl Trial {
    fn end(&self, pair: &Pair) -> Vec<f64> {
        let mut unit = (self.fmu)(pair).instantiate("unit").unwrap();
        unit.initialize(0.0, 2.0).unwrap();
        unit.set_value(self.input, Value::Real(0.5)).unwrap();
        (0..1000).for_each(|n| unit.do_step(f64::from(n) * 1e-3, 1e-3).unwrap());
        let values = self.outputs.map(|name| unit.value(name).unwrap());
        values.map(|value| if let Value::Real(value) = value { value } else { panic!("no number") }).to_vec()
    }
}

#[test]
fn linux64_runs_with_old_systems() {
    let target = &TARGETS[0];
    if !wanted(target) {
        return;
    }
    let built = built(target);
    check(&built, target, &[Architecture::X86_64], OF_LINUX);
    assert!(glibc_versions(&library(&built.plant, target)).contains(&2), "it uses the C library");
    if cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        let own = build(&BuildOptions::new(design(), built.plant.with_file_name("own")), &|_| ()).unwrap();
        let [built, own] = [built, own].map(|built| Pair::open(&built.controller, &built.plant).unwrap());
        for trial in &TRIALS {
            assert_eq!(trial.end(&built), trial.end(&own));
        }
    }
}

/// Runs both units in a host for their platform, and compares where they end with where this machine's own do.
///
/// `compiler` makes programs for the platform; `emulator` gives the start of a command that runs one here, and may
/// store what it needs in the folder that it is told.
fn assert_agrees(built: &Built, target: &Target, mut compiler: Command, emulator: impl Fn(&Path) -> Command) {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    // The host says nothing of the resources: units must find them in the folders that an unpacked FMU has.
    let binaries = path("binaries").join(target.platform.folder);
    let unit = binaries.join("unit").with_extension(target.platform.extension);
    let resources = path("resources");
    for folder in [&binaries, &resources] {
        fs::create_dir_all(folder).unwrap();
    }
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/platforms/host.c");
    let warnings = ["-std=c11", "-Wall", "-Wextra", "-Wno-cast-function-type", "-Werror"];
    let compiled = compiler.args(warnings).arg(source).arg("-o").arg(path("host.exe")).status().unwrap();
    assert!(compiled.success());
    let own = build(&BuildOptions::new(design(), path("own")), &|_| ()).unwrap();
    let own = Pair::open(&own.controller, &own.plant).unwrap();

    for trial in &TRIALS {
        let interface = (trial.unit)(design()).interface;
        fs::write(resources.join(start_file::NAME), interface.start_file.as_ref().unwrap()).unwrap();
        let reference =
            |name: &str| interface.variables.iter().position(|variable| variable.name == name).unwrap().to_string();
        fs::write(&unit, library((trial.file)(built), target)).unwrap();
        let output = emulator(folder.path())
            .arg(path("host.exe"))
            .arg(&unit)
            .args([&interface.guid, &reference(trial.input)])
            .args(trial.outputs.map(reference))
            .output()
            .unwrap();
        let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert!(output.status.success(), "{out}{err}");
        assert!(err.contains(&format!("{} must be a finite number, but is NaN", trial.input)), "{err}");

        let there: Vec<f64> = out.lines().map(|line| line.trim().parse().unwrap()).collect();
        let here = trial.end(&own);
        assert_eq!(there.len(), here.len());
        assert!(here.iter().any(|value| value.abs() > 1e-3), "it moves: {here:?}");
        for ((name, here), there) in trial.outputs.iter().zip(&here).zip(&there) {
            let platform = target.platform.folder;
            assert_eq!(here.to_bits(), there.to_bits(), "{name}: {here} here, {there} on {platform}");
        }
    }
}

#[test]
fn win64_runs_under_wine_and_agrees() {
    let target = &TARGETS[1];
    if !wanted(target) {
        return;
    }
    let built = built(target);
    check(&built, target, &[Architecture::X86_64], OF_WINDOWS);
    let Some(wine) = emulators::wine() else { return };
    assert_agrees(&built, target, Command::new("x86_64-w64-mingw32-gcc"), wine);
}

#[test]
fn darwin64_holds_both_processors() {
    let target = &TARGETS[2];
    if !wanted(target) {
        return;
    }
    let built = built(target);
    check(&built, target, &[Architecture::X86_64, Architecture::Aarch64], OF_MACOS);
    for (fmu, name) in [(&built.controller, "uam_controller"), (&built.plant, "uam_plant")] {
        for library in libraries(fmu, target) {
            let header = MachHeader64::<Endianness>::parse(library.as_slice(), 0).unwrap();
            let endian = header.endian().unwrap();
            let mut commands = header.load_commands(endian, library.as_slice(), 0).unwrap();
            let mut kinds = Vec::new();
            while let Some(command) = commands.next().unwrap() {
                kinds.push(command.cmd());
                if command.cmd() == LC_ID_DYLIB {
                    let itself = command.data::<DylibCommand<Endianness>>().unwrap().dylib.name;
                    let itself = String::from_utf8_lossy(command.string(endian, itself).unwrap()).into_owned();
                    assert_eq!(itself, format!("@rpath/{name}.dylib"), "the library of one unit in the other's place");
                }
            }
            assert!(kinds.contains(&LC_ID_DYLIB));
            // Macs with ARM processors load nothing that is not signed, if only by itself.
            let is_arm = header.cputype(endian) == CPU_TYPE_ARM64;
            assert!(!is_arm || kinds.contains(&LC_CODE_SIGNATURE), "{name}");
        }
    }
}

#[test]
fn aarch64_linux_runs_under_qemu_and_agrees() {
    let target = &TARGETS[3];
    if !wanted(target) {
        return;
    }
    let built = built(target);
    check(&built, target, &[Architecture::Aarch64], OF_LINUX);
    let Some(qemu) = emulators::qemu() else { return };
    let mut compiler = Command::new("cargo-zigbuild");
    compiler.args(["zig", "cc", "--", "-target", "aarch64-linux-gnu.2.17", "-ldl", "-lm"]);
    assert_agrees(&built, target, compiler, qemu);
}
