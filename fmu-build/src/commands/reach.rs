//! How far the arm reaches, with the counterweight locked and moving, without and with payload.

use std::path::Path;

use anyhow::Result;
use fmu_build::reach::{FOLLOWS, MOTIONS, Motion, reach};
use fmu_build::study::{DISCRETIZATIONS, on_all_cores};
use uam::options::Choice;
use uam::parameters::Discretization;
use uam::scenarios::find;

use super::{Pairs, Progress};

pub fn execute(out: &Path) -> Result<()> {
    let scenarios = MOTIONS.map(|motion| find(motion.scenario)).into_iter().collect::<Result<Vec<_>, _>>()?;
    let pairs = Pairs::build(out, scenarios.iter().map(|scenario| scenario.structure))?;
    let jobs: Vec<(Motion, Discretization)> =
        MOTIONS.iter().flat_map(|&motion| DISCRETIZATIONS.map(|discretization| (motion, discretization))).collect();
    let progress = Progress::new(jobs.len() as u64, "Enlarging the motions")?;
    let results = on_all_cores(&jobs, &|&(motion, discretization)| {
        let scenario = find(motion.scenario)?;
        let pair = pairs.of(scenario.structure).ok_or_else(|| anyhow::anyhow!("no FMUs for {}", scenario.structure))?;
        let result = reach(pair, &scenario, discretization);
        progress.bar.inc(1);
        anyhow::Ok(result?)
    });
    progress.finish();

    println!(
        "How far to the right the end effector follows, within {} mm at every communication point:\n",
        1e3 * FOLLOWS
    );
    println!("{:<8}{:>12}{:>12}{:>12}", "", "thesis", DISCRETIZATIONS[0].name(), DISCRETIZATIONS[1].name());
    let mut results = results.into_iter();
    for (motion, scenario) in MOTIONS.iter().zip(&scenarios) {
        print!("{:<8}{:>9.1} mm", motion.scenario, 1e3 * motion.thesis);
        for result in results.by_ref().take(DISCRETIZATIONS.len()) {
            print!("{:>9.1} mm", 1e3 * result?.followed);
        }
        println!("   {}", scenario.title);
    }
    Ok(())
}
