//! Units whose start values are not the library's own.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::ffi::{CStr, CString, c_char, c_double, c_int, c_uint, c_void};
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use fmu_build::host::coupling::{Coupling, Pair, Schedule, configure};
use fmu_build::host::fmu::{Fmu, Value};
use fmu_build::package::contents::fmu;
use fmu_build::package::units::Unit;
use fmu_build::platform::Platform;
use fmu_build::{BuildOptions, Built, Design, build};
use uam::fmi::Naming;
use uam::scenarios::find;
use zip::ZipArchive;

/// A scenario of another structure than the default, with its own gains, path and method.
fn design() -> Design {
    let mut design = Design::from(find("2.5a").unwrap());
    design.parameters.uav.mass = 4.0 + 1.0 / 3.0;
    design
}

fn built(design: Design, name: &str) -> Built {
    // A folder whose name a URI must encode.
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(env!("CARGO_CRATE_NAME")).join(name);
    build(&BuildOptions::new(design, folder), &|_| ()).unwrap()
}

/// Runs both units as they are; the pose of the UAV at the end.
fn end(coupling: &mut Coupling, names: [&str; 3]) -> [Value; 3] {
    let schedule = Schedule::new(0.0, 1.0, 1e-3).unwrap();
    coupling.run(&schedule, &mut |_, _, _| Ok(())).unwrap();
    names.map(|name| coupling.plant.value(name).unwrap())
}

const POSE: [&str; 3] = ["base.x", "base.y", "base.roll"];

fn library(path: &Path, identifier: &str) -> Vec<u8> {
    let mut content = Vec::new();
    let name = Platform::of_this_machine().unwrap().library(identifier);
    ZipArchive::new(File::open(path).unwrap()).unwrap().by_name(&name).unwrap().read_to_end(&mut content).unwrap();
    content
}

#[test]
fn nothing_needs_to_be_set_and_nothing_else_is_different() {
    let design = design();
    let own = built(design.clone(), "own vehicle");
    let known = built(Design::from(design.structure), "known vehicle");
    assert_eq!(library(&own.plant, "uam_plant"), library(&known.plant, "uam_plant"), "one binary serves all");

    let mut own = Pair::open(&own.controller, &own.plant).unwrap().couple().unwrap();
    assert_eq!(own.plant.value("uav.mass").unwrap(), Value::Real(4.0 + 1.0 / 3.0));
    let mut known = Pair::open(&known.controller, &known.plant).unwrap().couple().unwrap();
    configure(&mut known, design.structure, &design.parameters).unwrap();
    let pose = end(&mut own, POSE);
    assert_eq!(pose, end(&mut known, POSE));
    assert_ne!(pose, [Value::Real(0.0); 3], "it moves");

    // A reset unit begins with its own start values again.
    for _ in 0..2 {
        own.plant.reset().unwrap();
        own.controller.reset().unwrap();
        own.plant.set_value("autopilot.roll.kd", Value::Real(1.0)).unwrap();
    }
    own.plant.reset().unwrap();
    assert_eq!(end(&mut own, POSE), pose);
}

#[test]
fn flat_names_are_for_hosts_that_make_buses_of_structured_ones() {
    let flat = built(Design { naming: Naming::Flat, ..design() }, "flat names");
    let structured = built(design(), "structured names");
    let mut flat = Pair::open(&flat.controller, &flat.plant).unwrap().couple().unwrap();
    let mut structured = Pair::open(&structured.controller, &structured.plant).unwrap().couple().unwrap();
    assert_eq!(flat.connections(), structured.connections());
    let flat_end = end(&mut flat, ["base_x", "base_y", "base_roll"]);
    assert_eq!(flat_end, end(&mut structured, POSE));

    flat.plant.reset().unwrap();
    let refused = flat.plant.set_value("link_2_mass", Value::Real(-1.0)).unwrap_err().to_string();
    assert!(refused.contains("link_2_mass must be a finite number"), "{refused}");
}

#[test]
fn a_unit_whose_file_was_changed_is_refused_with_both_identities() {
    let own = built(design(), "own vehicle to be changed");
    let platform = Platform::of_this_machine().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let changed = |text: Option<String>| -> String {
        let mut unit = Unit::plant(design());
        unit.interface.start_file = text;
        let archive = fmu(&unit, &[(platform, library(&own.plant, "uam_plant"))]).unwrap();
        let path: PathBuf = folder.path().join("changed.fmu");
        fs::write(&path, archive.to_bytes("changed").unwrap()).unwrap();
        Fmu::open(&path).unwrap().instantiate("changed").unwrap_err().to_string()
    };
    let unit = Unit::plant(design());
    let text = unit.interface.start_file.unwrap();

    let mut lighter = design();
    lighter.parameters.uav.mass = 4.0;
    let lighter = Unit::plant(lighter).interface;
    let message = changed(lighter.start_file);
    assert!(message.contains(&lighter.guid) && message.contains(&unit.interface.guid), "{message}");

    let message = changed(Some(text.replace("\"uav.mass\" = 0x4", "\"uav.mass\" = 0xc")));
    assert!(message.contains("uav.mass must be the bits of a finite number, above 0, but is 0xc"), "{message}");
    let message = changed(None);
    assert!(message.contains("start.toml cannot be read") && message.contains(&unit.interface.guid), "{message}");
    let places = message.split("; ").filter(|part| part.contains("start.toml cannot be read")).count();
    assert!(places == 2 && message.contains("fmuResourceLocation") && message.contains("uam_plant"), "{message}");
}

type Instantiate = unsafe extern "C" fn(
    *const c_char,
    c_int,
    *const c_char,
    *const c_char,
    *const c_void,
    c_int,
    c_int,
) -> *mut c_void;
type GetReal = unsafe extern "C" fn(*mut c_void, *const c_uint, usize, *mut c_double) -> c_int;

/// What a library says the mass of the UAV is, if a host that gives this as the place of the resources gets an
/// instance of the plant.
fn mass(library: &Path, resources: Option<&CStr>) -> Option<f64> {
    let interface = Unit::plant(design()).interface;
    let reference = interface.variables.iter().position(|variable| variable.name == "uav.mass").unwrap();
    let (guid, reference) = (CString::new(interface.guid).unwrap(), c_uint::try_from(reference).unwrap());
    let resources = resources.map_or(std::ptr::null(), CStr::as_ptr);
    // SAFETY: the library is a unit by FMI 2.0, which fixes the signature of every function; all texts outlive the
    // calls, and there is a place for the number.
    unsafe {
        let library = libloading::Library::new(library).unwrap();
        let instantiate = library.get::<Instantiate>("fmi2Instantiate").unwrap();
        let unit = instantiate(c"unit".as_ptr(), 1, guid.as_ptr(), resources, std::ptr::null(), 0, 0);
        if unit.is_null() {
            return None;
        }
        let mut value = f64::NAN;
        library.get::<GetReal>("fmi2GetReal").unwrap()(unit, &raw const reference, 1, &raw mut value);
        library.get::<unsafe extern "C" fn(*mut c_void)>("fmi2FreeInstance").unwrap()(unit);
        Some(value)
    }
}

/// Hosts leave the place of the resources out, or give that of another unit; they have loaded the library, though.
#[test]
fn a_host_need_not_know_where_the_resources_are() {
    let own = built(design(), "own vehicle in a host that knows little");
    let unpacked = |design: Option<&str>| {
        let folder = tempfile::tempdir().unwrap();
        ZipArchive::new(File::open(&own.plant).unwrap()).unwrap().extract(folder.path()).unwrap();
        if let Some(text) = design {
            fs::write(folder.path().join("resources/start.toml"), text).unwrap();
        }
        folder
    };
    let mut heavier = design();
    heavier.parameters.uav.mass = 40.0;
    let heavier = Unit::plant(heavier).interface.start_file.unwrap();
    let (here, other) = (unpacked(None), unpacked(Some(&heavier)));
    let name = Platform::of_this_machine().unwrap().library("uam_plant");
    let (here_library, other_library) = (here.path().join(&name), other.path().join(&name));
    let location = |folder: &Path| CString::new(format!("file://{}/resources", folder.display())).unwrap();

    let expected = Some(4.0 + 1.0 / 3.0);
    assert_eq!(mass(&here_library, Some(&location(here.path()))), expected);
    assert_eq!(mass(&here_library, None), expected, "NULL");
    for wrong in [c"", c" ", c"file:///none/there", c"/", c"http://example.org/resources", c"nonsense", c"\xff"] {
        assert_eq!(mass(&here_library, Some(wrong)), expected, "{wrong:?}");
    }
    assert_eq!(mass(&here_library, Some(&location(other.path()))), expected, "the resources of another unit");
    // The URI goes first: there may be a library elsewhere.
    assert_eq!(mass(&other_library, Some(&location(here.path()))), expected);

    // Believed is only what gives the GUID.
    assert_eq!(mass(&other_library, None), None);
    fs::remove_file(here.path().join("resources/start.toml")).unwrap();
    assert_eq!(mass(&here_library, None), None);
}

#[test]
fn parameters_that_do_not_go_together_are_refused_before_anything_is_built() {
    let mut design = design();
    design.parameters.uav.mass = -1.0;
    let error = build(&BuildOptions::new(design, "nowhere"), &|_| ()).unwrap_err().to_string();
    assert!(error.contains("uav.mass must be") && !Path::new("nowhere").exists(), "{error}");
}
