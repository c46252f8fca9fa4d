//! One simulation with its csv and its report.

use std::path::Path;

use anyhow::{Result, anyhow, bail};
use fmu_build::host::coupling::Schedule;
use fmu_build::host::record::{Names, write_csv};
use fmu_build::host::run::run;
use fmu_build::study::particulars::Particulars;
use fmu_build::study::verdict::Verdict;
use fmu_build::{files, report};

use super::{Pairs, Progress, speed};
use crate::cli::SimulateArguments;
use crate::terminal::{remark, say, wrote};

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
    let file = |ending: &str| format!("{}.{ending}", scenario.id);
    let particulars = Particulars::of(&run, &verdict, &schedule, &file("csv"));
    let report = report::single::report(&run, &particulars)?;
    let files = [
        write_csv(&out.join(file("csv")), &[("", &run.recording)], 1)?,
        files::write(&out.join(file("json")), particulars.to_json()?.as_bytes())?,
        report.write(&out.join(file("html")))?,
    ];
    say(format_args!("{verdict}\n\n{}: {}\n\n{}\n", scenario.id, scenario.title, report.table))?;
    remark(format_args!("{}\n", speed(&[&run])))?;
    wrote(&files)?;
    match run.stopped {
        None if arguments.strict && !verdict.is_good() => bail!("--strict: {}", verdict.summary()),
        None => Ok(()),
        Some(stopped) => Err(anyhow!(stopped).context("the files hold what came out until then")),
    }
}
