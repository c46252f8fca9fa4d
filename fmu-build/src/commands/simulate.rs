//! One simulation with its csv and its report.

use std::path::Path;

use anyhow::{Context, Result, anyhow};
use fmu_build::coupling::{Order, Pair, Schedule};
use fmu_build::record::{Names, write_csv};
use fmu_build::report;
use fmu_build::run::run;

use super::{Progress, build_here, folder, speed, wrote};
use crate::cli::SimulateArguments;

pub fn execute(arguments: &SimulateArguments, out: &Path) -> Result<()> {
    let mut scenario = super::scenario(&arguments.scenario)?;
    if let Some(discretization) = arguments.discretization {
        scenario.parameters.ik.discretization = discretization;
    }
    let schedule =
        Schedule::new(0.0, arguments.stop.unwrap_or(scenario.duration), arguments.step.unwrap_or(scenario.step))?;
    let order = if arguments.sequential { Order::PlantFirst } else { Order::Parallel };

    let built = build_here(scenario.structure, &folder(out, scenario.structure))?;
    let pair = Pair::open(&built.controller, &built.plant)?;
    let names = if arguments.all_outputs {
        Names::all_outputs(pair.controller.description(), pair.plant.description())
    } else {
        Names::standard(scenario.structure)
    };
    let progress = Progress::new(schedule.steps() as u64 + 1, "Simulating")?;
    let run = run(&pair, &scenario, &schedule, order, &names, &|| progress.point());
    progress.finish();
    let run = run?;

    let report = report::single::report(&run, &schedule)?;
    println!("{}: {}\n\n{}\n", scenario.id, scenario.title, report.table);
    println!("{}\n", speed(&[&run]));
    let (csv, page) = (out.join(format!("{}.csv", scenario.id)), out.join(format!("{}.html", scenario.id)));
    write_csv(&csv, &[("", &run.recording)], 1).with_context(|| format!("cannot write {}", csv.display()))?;
    report.write(&page).with_context(|| format!("cannot write {}", page.display()))?;
    wrote(&[csv, page]);
    match run.stopped {
        None => Ok(()),
        Some(stopped) => Err(anyhow!(stopped).context("the files hold what came out until then")),
    }
}
