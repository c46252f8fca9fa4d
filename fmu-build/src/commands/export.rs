//! A scenario as parameter sets for other hosts.

use std::path::Path;

use anyhow::{Result, ensure};
use fmu_build::files;
use fmu_build::host::settings::changes;
use fmu_build::package::interface::Variable;
use fmu_build::package::ssp::parameters;
use uam::scenarios::{Extent, Scenario};
use uam::units::controller::ControllerUnit;
use uam::units::plant::PlantUnit;

use crate::terminal::wrote;

pub fn execute(name_or_file: &str, out: &Path) -> Result<()> {
    let scenario = super::scenario(name_or_file)?;
    let Scenario { id, title, structure, parameters, .. } = &scenario;
    ensure!(
        parameters.reference.table.is_none(),
        "the path of {id} is a table, which no parameter set can hold: `build --scenario` makes FMUs that have it inside"
    );
    files::create_folder(out)?;
    let set = |changes: Vec<Variable>| parameters::set(id, title, &changes.iter().collect::<Vec<_>>());
    let texts = [
        (format!("{id}.toml"), scenario.write(Extent::Changes)),
        (format!("{id}.controller.ssv"), set(changes::<ControllerUnit>(*structure, parameters))?),
        (format!("{id}.plant.ssv"), set(changes::<PlantUnit>(*structure, parameters))?),
    ];
    let mut written = Vec::new();
    for (name, text) in texts {
        let path = out.join(name);
        ensure!(
            !is_same_file(&path, Path::new(name_or_file)),
            "{} is the file that the simulation is read from; name another folder with --out",
            path.display()
        );
        written.push(files::write(&path, text.as_bytes())?);
    }
    wrote(&written)
}

/// Whether both paths lead to one file.
fn is_same_file(one: &Path, other: &Path) -> bool {
    one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other))
}
