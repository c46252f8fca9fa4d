//! The shared libraries in the FMUs.

#![allow(clippy::unwrap_used, reason = "helpers of tests may fail like tests")]

use std::collections::BTreeSet;
use std::fs;

use fmi::traits::FmiImport;
use fmi_host::Unit;
use object::read::{Export, NameOrOrdinal, Object, ObjectSymbol};
use uam::Structure;

/// Largest admissible library \[B\].
const LARGEST: usize = 3_000_000;

/// All functions of FMI 2.0, `fmi2Functions.h`. Those of co-simulation must be there, available or not; those
/// of model exchange need not, but some hosts look all of them up.
const FUNCTIONS: [&str; 44] = [
    "fmi2CancelStep",
    "fmi2CompletedIntegratorStep",
    "fmi2DeSerializeFMUstate",
    "fmi2DoStep",
    "fmi2EnterContinuousTimeMode",
    "fmi2EnterEventMode",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2FreeFMUstate",
    "fmi2FreeInstance",
    "fmi2GetBoolean",
    "fmi2GetBooleanStatus",
    "fmi2GetContinuousStates",
    "fmi2GetDerivatives",
    "fmi2GetDirectionalDerivative",
    "fmi2GetEventIndicators",
    "fmi2GetFMUstate",
    "fmi2GetInteger",
    "fmi2GetIntegerStatus",
    "fmi2GetNominalsOfContinuousStates",
    "fmi2GetReal",
    "fmi2GetRealOutputDerivatives",
    "fmi2GetRealStatus",
    "fmi2GetStatus",
    "fmi2GetString",
    "fmi2GetStringStatus",
    "fmi2GetTypesPlatform",
    "fmi2GetVersion",
    "fmi2Instantiate",
    "fmi2NewDiscreteStates",
    "fmi2Reset",
    "fmi2SerializeFMUstate",
    "fmi2SerializedFMUstateSize",
    "fmi2SetBoolean",
    "fmi2SetContinuousStates",
    "fmi2SetDebugLogging",
    "fmi2SetFMUstate",
    "fmi2SetInteger",
    "fmi2SetReal",
    "fmi2SetRealInputDerivatives",
    "fmi2SetString",
    "fmi2SetTime",
    "fmi2SetupExperiment",
    "fmi2Terminate",
];

/// Functions of C's `math.h` whose results differ from platform to platform, as they are not rounded exactly everywhere;
/// also with `f` or `l` at the end, for other types.
const INEXACT: [&str; 27] = [
    "acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "cos", "cosh", "erf", "exp", "exp10", "exp2",
    "expm1", "hypot", "lgamma", "log", "log10", "log1p", "log2", "pow", "sin", "sincos", "sinh", "tan", "tanh",
];

fn library(unit: &Unit) -> Vec<u8> {
    let import = unit.import();
    let name = &import.model_description().model_name;
    fs::read(import.archive_path().join(import.shared_lib_path(name).unwrap())).unwrap()
}

fn name(export: &Export) -> String {
    match export.name() {
        NameOrOrdinal::Name(name) => String::from_utf8(name.to_owned()).unwrap(),
        NameOrOrdinal::Ordinal(number) => format!("number {number}"),
    }
}

#[test]
fn they_export_the_functions_of_the_standard_and_nothing_else() {
    for unit in [Unit::controller(Structure::DEFAULT), Unit::plant(Structure::DEFAULT)] {
        let library = library(&unit);
        let file = object::File::parse(library.as_slice()).unwrap();
        let exports = file.exports().unwrap();
        let names: BTreeSet<String> = exports.map(|export| name(&export.unwrap())).collect();
        assert_eq!(names, FUNCTIONS.map(str::to_owned).into());
    }
}

#[test]
fn they_are_small() {
    for unit in [Unit::controller(Structure::DEFAULT), Unit::plant(Structure::DEFAULT)] {
        let size = library(&unit).len();
        assert!(size <= LARGEST, "{}: {size} B", unit.import().model_description().model_name);
    }
}

/// Results are the same bits everywhere: nothing that rounds differently elsewhere is taken from the system.
#[test]
fn they_use_no_mathematics_of_the_platform() {
    for unit in [Unit::controller(Structure::DEFAULT), Unit::plant(Structure::DEFAULT)] {
        let library = library(&unit);
        let file = object::File::parse(library.as_slice()).unwrap();
        let undefined = file.dynamic_symbols().filter(ObjectSymbol::is_undefined);
        let names: Vec<&str> = undefined.map(|symbol| symbol.name().unwrap()).collect();
        assert!(!cfg!(target_os = "linux") || names.contains(&"memcpy"), "what is taken from the system: {names:?}");
        for function in INEXACT {
            let found = ["", "f", "l"].map(|kind| format!("{function}{kind}"));
            let found = names.iter().find(|name| found.contains(&(**name).to_owned()));
            assert_eq!(found, None, "{}", unit.import().model_description().model_name);
        }
    }
}
