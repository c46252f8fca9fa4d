//! FMUs and SSPs as archives: complete, reproducible, and free of traces of the building machine.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::collections::HashSet;
use std::io::{Cursor, Read};

use fmu_build::Design;
use fmu_build::package::contents::fmu;
use fmu_build::package::documentation::page;
use fmu_build::package::ssp::{Component, ssp};
use fmu_build::package::units::Unit;
use fmu_build::platform::{AARCH64_LINUX, DARWIN64, LINUX64, Platform, WIN64};
use roxmltree::Document;
use uam::Structure;
use uam::parameters::Balance;
use zip::ZipArchive;

fn pack(unit: &Unit) -> Vec<u8> {
    fmu(unit, &[(LINUX64, b"library".to_vec())]).unwrap().to_bytes("test").unwrap()
}

fn pack_system(plant: &Unit, controller: &Unit) -> Vec<u8> {
    let components = [
        Component { name: "plant", interface: &plant.interface, fmu: &pack(plant) },
        Component { name: "controller", interface: &controller.interface, fmu: &pack(controller) },
    ];
    ssp(&components).unwrap().to_bytes("test").unwrap()
}

fn system(structure: Structure) -> Vec<u8> {
    let [controller, plant] = Unit::pair(structure);
    pack_system(&plant, &controller)
}

fn names(archive: &[u8]) -> Vec<String> {
    let zip = ZipArchive::new(Cursor::new(archive)).unwrap();
    zip.file_names().map(|name| name.unwrap().into_owned()).collect()
}

fn entry(archive: &[u8], name: &str) -> Vec<u8> {
    let mut zip = ZipArchive::new(Cursor::new(archive)).unwrap();
    let mut content = Vec::new();
    zip.by_name(name).unwrap().read_to_end(&mut content).unwrap();
    content
}

fn text(archive: &[u8], name: &str) -> String {
    String::from_utf8(entry(archive, name)).unwrap()
}

#[test]
fn an_fmu_holds_what_the_standard_names() {
    let unit = Unit::plant(Structure::DEFAULT);
    let archive = pack(&unit);
    assert_eq!(
        names(&archive),
        [
            "binaries/linux64/uam_plant.so",
            "documentation/index.html",
            "documentation/licenses/LICENSE-APACHE",
            "documentation/licenses/LICENSE-MIT",
            "documentation/licenses/THIRD-PARTY",
            "model.png",
            "modelDescription.xml",
        ]
    );
    assert_eq!(entry(&archive, "binaries/linux64/uam_plant.so"), b"library");
    assert!(text(&archive, "documentation/index.html") == page(&unit));
    assert_eq!(entry(&archive, "model.png"), unit.icon);
}

#[test]
fn every_platform_has_its_library_where_importers_look() {
    let unit = Unit::plant(Structure::DEFAULT);
    let binaries = |platforms: &[Platform]| {
        let libraries: Vec<_> = platforms.iter().map(|platform| (*platform, b"library".to_vec())).collect();
        let archive = fmu(&unit, &libraries).unwrap().to_bytes("test").unwrap();
        names(&archive).into_iter().filter(|name| name.starts_with("binaries/")).collect::<Vec<_>>()
    };
    assert_eq!(
        binaries(&[LINUX64, WIN64, DARWIN64]),
        [
            "binaries/aarch64-darwin/uam_plant.dylib",
            "binaries/darwin64/uam_plant.dylib",
            "binaries/linux64/uam_plant.so",
            "binaries/win64/uam_plant.dll",
        ]
    );
    assert_eq!(binaries(&[AARCH64_LINUX]), ["binaries/aarch64-linux/uam_plant.so", "binaries/linux64/uam_plant.so"]);
}

#[test]
fn the_picture_is_a_png_of_100_by_100() {
    for unit in Unit::pair(Structure::DEFAULT) {
        assert_eq!(unit.icon[..8], *b"\x89PNG\r\n\x1a\n");
        assert_eq!(unit.icon[12..24], *b"IHDR\0\0\0\x64\0\0\0\x64");
    }
}

#[test]
fn the_page_shows_every_variable_and_every_alternative() {
    for structure in Structure::all() {
        for unit in Unit::pair(structure) {
            let html = page(&unit);
            for variable in &unit.interface.variables {
                assert!(html.contains(&format!("<code>{}</code>", variable.name)), "{}", variable.name);
            }
            for item in unit.interface.enumerations().iter().flat_map(|enumeration| enumeration.items) {
                assert!(html.contains(&format!("<code>{}</code>", item.name)), "{}", item.name);
            }
        }
    }
}

/// Many hosts know the values of enumerations by their numbers alone.
#[test]
fn the_row_of_a_variable_says_which_numbers_stand_for_which_names() {
    for structure in Structure::all() {
        for unit in Unit::pair(structure) {
            let html = page(&unit);
            for variable in &unit.interface.variables {
                let fmu_build::package::interface::Value::Enumeration { options, start } = variable.value else {
                    continue;
                };
                let name = format!("<td><code>{}</code></td>", variable.name);
                let row = html.split("<tr>").find(|row| row.starts_with(&name)).unwrap();
                for (number, item) in (1..).zip(options.items) {
                    let times = if variable.is_set_from_outside() && number == start { 2 } else { 1 };
                    let found = row.matches(&format!("{number} = {}", item.name)).count();
                    assert_eq!(found, times, "{}, {}", variable.name, item.name);
                }
            }
        }
    }
}

/// Hosts that go by the standard stop where the simulation ends.
#[test]
fn the_system_proposes_the_experiment_of_its_simulation() {
    for (id, start, stop) in [("4.3b", "0", "30"), ("2.5a", "0", "8"), ("3.8a", "0", "5")] {
        let scenario = uam::scenarios::find(id).unwrap();
        assert_eq!(scenario.duration.to_string(), stop, "{id}");
        let [controller, plant] = Unit::pair(Design::from(scenario));
        let ssd = text(&pack_system(&plant, &controller), "SystemStructure.ssd");
        let document = Document::parse(&ssd).unwrap();
        let experiments: Vec<_> =
            document.root_element().children().filter(|node| node.tag_name().name() == "DefaultExperiment").collect();
        let [experiment] = experiments[..] else { panic!("{id}: {experiments:?}") };
        assert_eq!(experiment.tag_name().namespace(), document.root_element().tag_name().namespace());
        assert_eq!((experiment.attribute("startTime"), experiment.attribute("stopTime")), (Some(start), Some(stop)));
    }
}

/// The file is that of FMI 3.0: its schema wants `fmiVersion` 3, and FMI Library the version of the model description.
#[test]
fn terminals_are_there_only_where_they_are_asked_for() {
    for (terminals, expected) in [(false, 0), (true, 2)] {
        for unit in Unit::pair(Design { terminals, ..Structure::DEFAULT.into() }) {
            let files = names(&pack(&unit)).into_iter().filter(|name| name.starts_with("terminalsAndIcons/"));
            assert_eq!(files.count(), expected, "{terminals}");
        }
    }
}

#[test]
fn the_page_has_picture_and_formulas_and_needs_nothing_from_elsewhere() {
    for structure in Structure::all() {
        for unit in Unit::pair(structure) {
            let html = page(&unit);
            assert!(html.contains("<svg") && html.matches("<math").count() > 30, "{structure}");
            assert!(!html.contains("merror"), "a formula cannot be read");
            for outside in ["http:", "https:", "@import", "url(\"", "<script", "<link"] {
                assert!(!html.contains(outside), "{outside}");
            }
            let values = |attribute: &str| -> Vec<&str> {
                html.split(attribute).skip(1).map(|rest| rest.split('"').next().unwrap()).collect()
            };
            assert_eq!(values(" src=\""), ["../model.png"]);
            let names = values(" id=\"");
            let different: HashSet<_> = names.iter().collect();
            assert_eq!(different.len(), names.len(), "two places of one name");
            for name in &names {
                assert!(!name.is_empty() && !name.contains(' '), "`{name}` is no name in HTML");
            }
            for anchor in values("href=\"#") {
                assert!(different.contains(&anchor), "{anchor}");
            }
        }
    }
}

#[test]
fn packing_twice_gives_the_same_bytes() {
    for balance in Balance::ALL {
        let structure = Structure::new(2, balance).unwrap();
        assert!(system(structure) == system(structure), "{structure}");
    }
}

#[test]
fn archives_do_not_know_the_building_machine() {
    let archive = system(Structure::DEFAULT);
    let home = env!("CARGO_MANIFEST_DIR");
    for name in names(&archive) {
        if name.ends_with(".fmu") {
            continue;
        }
        assert!(!text(&archive, &name).contains(home), "{name}");
    }
}

#[test]
fn the_system_connects_rates_accelerations_and_grasp_and_nothing_else() {
    for structure in Structure::all() {
        let ssd = text(&system(structure), "SystemStructure.ssd");
        let document = Document::parse(&ssd).unwrap();
        let connections: Vec<_> = document
            .descendants()
            .filter(|node| node.tag_name().name() == "Connection")
            .map(|node| {
                assert_eq!(node.attribute("startElement"), Some("controller"));
                assert_eq!(node.attribute("endElement"), Some("plant"));
                assert_eq!(node.attribute("startConnector"), node.attribute("endConnector"));
                node.attribute("endConnector").unwrap().to_owned()
            })
            .collect();
        let inputs = document.descendants().filter(|node| node.attribute("kind") == Some("input"));
        let mut inputs: Vec<_> = inputs.map(|input| input.attribute("name").unwrap()).collect();
        inputs.sort_unstable();
        let mut expected = Vec::new();
        for command in ["rate_command", "acceleration_command"] {
            expected.extend((1..=structure.links).map(|n| format!("joint[{n}].{command}")));
            expected.extend(structure.balance.prefix().map(|name| format!("{name}.{command}")));
        }
        expected.push("grasp".to_owned());
        assert_eq!(connections, expected, "{structure}");
        expected.sort_unstable();
        assert_eq!(inputs, expected, "every input is listed once, and none without a connection");
    }
}

#[test]
fn the_sources_that_the_system_names_are_in_the_archive() {
    let archive = system(Structure::DEFAULT);
    let ssd = text(&archive, "SystemStructure.ssd");
    let document = Document::parse(&ssd).unwrap();
    let sources: Vec<_> = document.descendants().filter_map(|node| node.attribute("source")).collect();
    assert_eq!(
        sources,
        ["resources/uam_plant.fmu", "resources/uam.ssv", "resources/uam_controller.fmu", "resources/uam.ssv"]
    );
    for source in sources {
        assert!(!entry(&archive, source).is_empty());
    }
}

#[test]
fn the_parameter_set_serves_both_units_and_repeats_their_start_values() {
    let [controller, plant] = Unit::pair(Structure::DEFAULT);
    let ssv = text(&pack_system(&plant, &controller), "resources/uam.ssv");
    let document = Document::parse(&ssv).unwrap();
    let parameters: Vec<_> = document.descendants().filter(|node| node.tag_name().name() == "Parameter").collect();
    assert!(parameters.len() > 20);
    for parameter in parameters {
        let name = parameter.attribute("name").unwrap();
        let value: f64 = parameter.first_element_child().unwrap().attribute("value").unwrap().parse().unwrap();
        for unit in [&plant, &controller] {
            let variable = unit.interface.variables.iter().find(|variable| variable.name == name).unwrap();
            let fmu_build::package::interface::Value::Real { start, .. } = variable.value else { panic!("{name}") };
            assert_eq!(value.to_bits(), start.to_bits(), "{name}");
        }
    }
}
