//! One simulation with its csv and its report.

use std::path::Path;

use anyhow::{Result, anyhow, bail};
use fmu_build::host::coupling::Schedule;
use fmu_build::host::record::{Names, write_csv};
use fmu_build::host::run::run;
use fmu_build::study::verdict::Verdict;
use fmu_build::{files, report};

use super::{Pairs, Progress, speed};
use crate::cli::SimulateArguments;
use crate::terminal::{say, wrote};

pub fn execute(arguments: &SimulateArguments, out: &Path) -> Result<()> {
    let mut scenario = super::scenario(&arguments.scenario)?;
    if let Some(discretization) = arguments.discretization {
        scenario.parameters.ik.discretization = discretization;
    }
    let schedule =
        Schedule::new(0.0, arguments.stop.unwrap_or(scenario.duration), arguments.step.unwrap_or(scenario.step))?;
    files::create_folder(out)?;

    let pairs = Pairs::build([&scenario])?;
    let pair = pairs.of(&scenario)?;
    let names = if arguments.all_outputs {
        Names::all_outputs(pair.controller.description(), pair.plant.description())
    } else {
        Names::standard(scenario.structure)
    };
    let progress = Progress::new(schedule.steps() as u64 + 1, "Simulating")?;
    let run = run(pair, &scenario, &schedule, &names, &|| progress.point());
    progress.finish();
    let run = run?;

    let verdict = Verdict::of(&run)?;
    let report = report::single::report(&run, &verdict, &schedule)?;
    let (csv, page) = (out.join(format!("{}.csv", scenario.id)), out.join(format!("{}.html", scenario.id)));
    let files = [write_csv(&csv, &[("", &run.recording)], 1)?, report.write(&page)?];
    say(format_args!("{verdict}\n\n{}: {}\n\n{}\n", scenario.id, scenario.title, report.table))?;
    say(format_args!("{}\n", speed(&[&run])))?;
    wrote(&files)?;
    match run.stopped {
        None if arguments.strict && !verdict.is_good() => bail!("--strict: {}", verdict.summary()),
        None => Ok(()),
        Some(stopped) => Err(anyhow!(stopped).context("the files hold what came out until then")),
    }
}
