//! How far the arm reaches, with the counterweight locked and moving, without and with payload.

use std::path::Path;

use anyhow::{Context, Result, anyhow};
use fmu_build::reach::{LONGEST, MOTIONS, Reach, STRIDE, Trial, reach};
use fmu_build::report;
use fmu_build::study::{on_all_cores, with_each};
use fmu_build::variation::vary;
use uam::scenarios::find;

use super::{Pairs, Progress, wrote};
use crate::cli::{Change, ReachArguments};

pub fn execute(arguments: &ReachArguments, out: &Path) -> Result<()> {
    let changes = arguments.changes.iter().map(Change::single).collect::<Result<Vec<_>>>()?;
    let changed = changes.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(" ");
    let scenario = |id: &str| anyhow::Ok(vary(&find(id)?, &changes)?);
    let scenarios = MOTIONS.iter().map(|motion| scenario(motion.scenario)).collect::<Result<Vec<_>>>()?;
    let pairs = Pairs::build(out, scenarios.iter().map(|scenario| scenario.structure))?;
    let jobs = with_each(&scenarios);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "only for the progress bar")]
    let strides = (LONGEST / STRIDE) as u64;
    let progress = Progress::new(strides * jobs.len() as u64, "Enlarging the motions")?;
    let results = on_all_cores(&jobs, &|&(scenario, discretization)| {
        let pair = pairs.of(scenario.structure).ok_or_else(|| anyhow!("no FMUs for {}", scenario.structure))?;
        let mut tried = 0;
        let result = reach(|way| {
            tried += 1;
            progress.bar.inc(u64::from(tried <= strides));
            Trial::run(pair, scenario, discretization, way)
        });
        progress.bar.inc(strides.saturating_sub(tried));
        anyhow::Ok(result?)
    });
    progress.finish();
    let results = results.into_iter().collect::<Result<Vec<Reach>>>()?;

    if arguments.print.markdown {
        print!("{}", report::reach::markdown(&results));
        return Ok(());
    }
    println!("{}\n", report::reach::table(&scenarios, &results));
    let page = out.join("reach.html");
    report::reach::report(&scenarios, &results, &changed)?
        .write(&page)
        .with_context(|| format!("cannot write {}", page.display()))?;
    wrote(&[page]);
    Ok(())
}
