//! A scenario as parameter sets for other hosts.

use std::path::Path;

use anyhow::{Context, Result};
use fmu_build::interface::Variable;
use fmu_build::settings::changes;
use fmu_build::ssp::parameters;
use uam::interface::controller::ControllerUnit;
use uam::interface::plant::PlantUnit;
use uam::scenarios::{Extent, Scenario};

use super::wrote;

pub fn execute(scenario: &Scenario, out: &Path) -> Result<()> {
    let Scenario { id, title, structure, parameters, .. } = scenario;
    std::fs::create_dir_all(out).with_context(|| format!("cannot make the folder {}", out.display()))?;
    let set = |changes: Vec<Variable>| parameters::set(id, title, &changes.iter().collect::<Vec<_>>());
    let files = [
        (format!("{id}.toml"), scenario.write(Extent::Changes)),
        (format!("{id}.controller.ssv"), set(changes::<ControllerUnit>(*structure, parameters))?),
        (format!("{id}.plant.ssv"), set(changes::<PlantUnit>(*structure, parameters))?),
    ];
    let write = |(name, text): &(String, String)| {
        let path = out.join(name);
        std::fs::write(&path, text).with_context(|| format!("cannot write {}", path.display()))?;
        Ok(path)
    };
    wrote(&files.iter().map(write).collect::<Result<Vec<_>>>()?);
    Ok(())
}
