//! Couples controller and plant through the `fmi` crate with a plain parallel master:
//!
//! ```text
//! cargo run -p fmi-host --example couple -- FOLDER STEP STOP TABLE
//! ```
//!
//! reads the FMUs in FOLDER, steps by STEP up to STOP \[s\], and writes TABLE (csv) with every output of the plant.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a part of the tests may fail like tests")]

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use fmi_host::{Coupling, Unit};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, step, stop, table] = arguments.as_slice() else {
        panic!("usage: couple FOLDER STEP STOP TABLE");
    };
    let unit = |name: &str| Unit::new(fmi::import::from_path(Path::new(folder).join(name)).unwrap());
    let coupling = Coupling::between(unit("uam_controller.fmu"), unit("uam_plant.fmu"));
    let (step, stop): (f64, f64) = (step.parse().unwrap(), stop.parse().unwrap());
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of steps")]
    let count = (stop / step).round() as u32;

    let mut file = BufWriter::new(File::create(table).unwrap());
    let names = coupling.plant.outputs();
    writeln!(file, "time,{}", names.join(",")).unwrap();
    coupling
        .observe(&[], fmi_host::steps(0.0, step, count), |time, _, plant| {
            let values = names.iter().map(|name| plant.get(name).to_string());
            writeln!(file, "{time},{}", values.collect::<Vec<_>>().join(",")).unwrap();
        })
        .unwrap();
    file.flush().unwrap();
}
