//! How far the arm reaches, with the counterweight locked and moving, without and with payload.

use std::path::Path;

use anyhow::Result;
use fmu_build::study::reach::{FARTHEST, MOTIONS, Reach, STRIDE, Trial, enlarged, reach};
use fmu_build::study::variation::vary;
use fmu_build::study::{on_all_cores, with_each};
use fmu_build::{files, report};
use uam::scenarios::find;

use super::{Pairs, Progress};
use crate::cli::{Change, ReachArguments};
use crate::terminal::{say, wrote};

pub fn execute(arguments: &ReachArguments, out: &Path) -> Result<()> {
    let changes = arguments.changes.iter().map(Change::single).collect::<Result<Vec<_>>>()?;
    let changed = changes.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(" ");
    let scenario = |id: &str| anyhow::Ok(vary(&find(id)?, &changes)?);
    let scenarios = MOTIONS.iter().map(|motion| scenario(motion.scenario)).collect::<Result<Vec<_>>>()?;
    // Before anything is built.
    scenarios.iter().try_for_each(|scenario| enlarged(scenario, STRIDE).map(|_| ()))?;
    files::create_folder(out)?;
    let pairs = Pairs::build(&scenarios)?;
    let jobs = with_each(&scenarios);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "only for the progress bar")]
    let strides = (FARTHEST / STRIDE) as u64;
    let progress = Progress::new(strides * jobs.len() as u64, "Enlarging the motions")?;
    let results = on_all_cores(&jobs, |&(scenario, discretization)| {
        let pair = pairs.of(scenario)?;
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
        return say(report::reach::markdown(&results).trim_end());
    }
    let page = report::reach::report(&scenarios, &results, &changed)?.write(&out.join("reach.html"))?;
    say(format_args!("{}\n", report::reach::table(&scenarios, &results)))?;
    report::reach::unfinished(&scenarios).try_for_each(|remark| say(format_args!("{remark}.\n")))?;
    wrote(&[page])
}
