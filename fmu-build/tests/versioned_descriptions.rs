//! The model descriptions under version control are those that the units have now.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may fail like tests")]

use std::path::Path;
use std::{env, fs};

use fmu_build::package::description::model_description;
use fmu_build::package::units::Unit;
use fmu_build::write_descriptions;
use uam::Structure;

/// Set to anything, it makes the test rewrite the files instead.
const REGENERATE: &str = "UAM_REGENERATE";

#[test]
fn versioned_model_descriptions_are_up_to_date() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../modelDescription");
    if env::var_os(REGENERATE).is_some() {
        write_descriptions(&folder).unwrap();
    }
    for unit in Unit::pair(Structure::DEFAULT) {
        let name = format!("{}.xml", unit.interface.identifier);
        let versioned = fs::read_to_string(folder.join(&name)).unwrap();
        let line = |text: &str, number: usize| text.lines().nth(number).unwrap_or("(nothing)").to_owned();
        let current = model_description(&unit.interface).unwrap();
        let differs = (0..current.lines().count().max(versioned.lines().count()))
            .find(|number| line(&current, *number) != line(&versioned, *number));
        if let Some(number) = differs {
            panic!(
                "modelDescription/{name} is out of date in line {}:\n  there:  {}\n  now:    {}\n\
                 If the change is meant: {REGENERATE}=1 cargo test -p fmu-build --test versioned_descriptions",
                number + 1,
                line(&versioned, number),
                line(&current, number),
            );
        }
        assert_eq!(current, versioned);
    }
}
