//! Results are the same bits on every platform: digests of all runs of the catalogue, as they are under version control.
//!
//! If results are meant to change: `UAM_REGENERATE=1 cargo test -p fmu-build --test digests`

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use digests::{Digest, EVERY};
use fmu_build::compile::cross::{TARGETS, Toolchain};
use fmu_build::compile::{compile, target_libraries};
use fmu_build::host::coupling::{Schedule, configure};
use fmu_build::host::fmu::{Causality, Instance, Selection};
use fmu_build::study::claims::DISCRETIZATIONS;
use fmu_build::study::on_all_cores;
use fmu_build::workspace;
use uam::coupling;
use uam::parameters::Discretization;
use uam::scenarios::{Scenario, catalogue};
use uam::variables::options::Choice;

mod common;

use common::emulators::{self, Emulator, full, wanted};

/// A line for each run: scenario, discretization, digest.
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/digests/digests.txt");
/// Set to anything, it makes the test on the FMUs rewrite the file.
const REGENERATE: &str = "UAM_REGENERATE";

fn assert_expected(found: &str, platform: &str) {
    let expected = fs::read_to_string(FILE).unwrap();
    let other: Vec<_> = expected.lines().zip(found.lines()).filter(|(expected, found)| expected != found).collect();
    assert!(
        other.is_empty() && expected.lines().count() == found.lines().count(),
        "{platform}: other bits than in tests/digests/digests.txt (there, now): {other:#?}\n\
         If the change is meant: {REGENERATE}=1 cargo test -p fmu-build --test digests"
    );
}

/// What the program prints, made by `toolchain` and run by `emulator`.
fn printed(toolchain: Toolchain, emulator: Option<Emulator>) -> String {
    let compiled = compile(&workspace::root().unwrap(), &["digests"], toolchain, &|_| ());
    let program = compiled.unwrap_or_else(|error| panic!("{error}")).program("digests").unwrap();
    let folder = tempfile::tempdir().unwrap();
    run(emulator.map_or_else(
        || Command::new(&program),
        |emulator| {
            let mut command = emulator(folder.path());
            command.arg(&program);
            command
        },
    ))
}

fn run(mut command: Command) -> String {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().replace('\r', "")
}

/// What runs on other platforms gives here what the FMUs give.
#[test]
fn the_program_gives_them() {
    if full() {
        assert_expected(&printed(Toolchain::Own, None), "this machine");
    } else {
        println!("skipped: the program for other platforms, on this one (only in the full set)");
    }
}

/// The line of a run on FMUs.
fn line(scenario: &Scenario, discretization: Discretization) -> String {
    let mut coupling = common::pair_of(scenario.structure).couple().unwrap();
    let mut parameters = scenario.parameters.clone();
    parameters.ik.discretization = discretization;
    configure(&mut coupling, scenario.structure, &parameters).unwrap();
    let schedule = Schedule::new(0.0, scenario.duration, scenario.step).unwrap();

    let outputs = |unit: &Instance| {
        let names = unit.description().with(Causality::Output).map(|variable| variable.name.as_str());
        Selection::new(unit.description(), names).unwrap()
    };
    let (controller, plant) = (outputs(&coupling.controller), outputs(&coupling.plant));
    let (mut digest, mut count) = (Digest::default(), 0);
    let outcome = coupling.run(&schedule, &mut |_, c, p| {
        if count % EVERY == 0 || count == schedule.steps() {
            for (unit, outputs) in [(c, &controller), (p, &plant)] {
                let mut values = outputs.values();
                unit.get(outputs, &mut values)?;
                digest.add(outputs.numbers(&values));
            }
        }
        count += 1;
        Ok(())
    });
    assert!(matches!(outcome, Ok(()) | Err(coupling::Error::Step { .. })), "{}: {outcome:?}", scenario.id);
    digest.line(&scenario.id, discretization.name())
}

/// Through the C functions of the libraries.
#[test]
fn the_fmus_give_the_digests_under_version_control() {
    let scenarios = catalogue().unwrap();
    let runs: Vec<_> = scenarios.iter().flat_map(|scenario| DISCRETIZATIONS.map(|with| (scenario, with))).collect();
    let lines = on_all_cores(&runs, |(scenario, discretization)| line(scenario, *discretization));
    let found = lines.join("\n") + "\n";
    if env::var_os(REGENERATE).is_some() {
        fs::write(FILE, &found).unwrap();
    }
    print!("{found}");
    assert_expected(&found, "FMUs");
}

/// The same instances without a C interface.
#[test]
fn units_in_this_process_give_them() {
    let scenarios = catalogue().unwrap();
    let runs: Vec<_> = scenarios.iter().flat_map(|scenario| DISCRETIZATIONS.map(|with| (scenario, with))).collect();
    let lines = on_all_cores(&runs, |(scenario, discretization)| {
        let mut variant = (*scenario).clone();
        variant.parameters.ik.discretization = *discretization;
        digests::in_process(&variant).unwrap().line(&scenario.id, discretization.name())
    });
    assert_expected(&(lines.join("\n") + "\n"), "in this process");
}

#[test]
fn windows_gives_them() {
    if wanted(&TARGETS[1])
        && let Some(wine) = emulators::wine()
    {
        assert_expected(&printed(Toolchain::Cross(&TARGETS[1]), Some(wine)), "win64");
    }
}

#[test]
fn linux_on_arm_gives_them() {
    if wanted(&TARGETS[3])
        && let Some(qemu) = emulators::qemu()
    {
        assert_expected(&printed(Toolchain::Cross(&TARGETS[3]), Some(qemu)), "aarch64-linux");
    }
}

/// What Node.js needs to run a program for WebAssembly's system interface.
const RUNNER: &str = "
import { readFileSync } from 'node:fs';
import { WASI } from 'node:wasi';
const wasi = new WASI({ version: 'preview1', args: ['digests'], env: {} });
const program = await WebAssembly.instantiate(readFileSync(process.argv[2]), wasi.getImportObject());
process.exitCode = wasi.start(program.instance);
";

#[test]
fn web_assembly_gives_them() {
    const TRIPLE: &str = "wasm32-wasip1";
    let is_there = target_libraries(TRIPLE).is_some_and(|folder| folder.is_dir());
    if !full() || !is_there && env::var_os("CARGO_UNSTABLE_BUILD_STD").is_none() {
        println!("skipped: WebAssembly (only in the full set, with rustup target add {TRIPLE})");
        return;
    }
    let Some(node) = emulators::program(&["node"]) else {
        println!("skipped: WebAssembly, there is no Node.js (Debian: apt-get install nodejs)");
        return;
    };
    let folder = workspace::root().unwrap().join("target/fmu");
    let mut cargo = Command::new(env::var_os("CARGO").unwrap());
    cargo.current_dir(workspace::root().unwrap()).args([
        "build",
        "--locked",
        "--profile",
        "fmu",
        "--package",
        "digests",
    ]);
    run({
        cargo.args(["--target", TRIPLE, "--target-dir"]).arg(&folder);
        cargo
    });
    let runner = tempfile::Builder::new().suffix(".mjs").tempfile().unwrap();
    fs::write(runner.path(), RUNNER).unwrap();
    let program: PathBuf = folder.join(TRIPLE).join("fmu/digests.wasm");
    let mut command = Command::new(node);
    command.arg("--no-warnings").arg(runner.path()).arg(Path::new(&program));
    assert_expected(&run(command), "WebAssembly");
}
