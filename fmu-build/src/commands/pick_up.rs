//! The main run: builds the default pair and puts it through thesis 4.3 in all variants.

use std::path::Path;

use anyhow::Result;
use fmu_build::BuildOptions;
use fmu_build::host::coupling::Pair;
use fmu_build::host::record::{Recording, write_csv};
use fmu_build::host::run::Run;
use fmu_build::report;
use fmu_build::study::verdict::Verdict;
use fmu_build::study::{self, Case, Summary};
use uam::Structure;
use uam::scenarios::PICK_UP;

use super::{Progress, build_files, complain, speed};
use crate::terminal::{remark, say, wrote};

/// The csv holds every so many communication points: fine enough to plot, small enough for spreadsheets.
const CSV_STRIDE: usize = 10;

pub fn execute(out: &Path) -> Result<()> {
    remark(format_args!("Building both FMUs for {} ...", Structure::DEFAULT))?;
    let built = build_files(&BuildOptions::new(Structure::DEFAULT, out))?;
    let pair = Pair::open(&built.controller, &built.plant)?;

    let cases = run_all(&pair)?;
    let runs = || cases.iter().flat_map(|case| &case.runs);
    let (csv, page) = (out.join("pick-up.csv"), out.join("report.html"));
    let exact: Vec<(String, &Recording)> =
        cases.iter().map(|case| (prefix(case.exact()), &case.exact().recording)).collect();
    let columns: Vec<(&str, &Recording)> =
        exact.iter().map(|(prefix, recording)| (prefix.as_str(), *recording)).collect();
    let mut files = Vec::from(built.files);
    files.push(write_csv(&csv, &columns, CSV_STRIDE)?);
    files.push(report::pick_up::report(&cases)?.write(&page)?);

    if let Some(case) = cases.iter().find(|case| case.scenario.id == PICK_UP) {
        say(format_args!("\n{}", Verdict::of(case.exact())?))?;
    }
    say(format_args!("\nThe pick-up of thesis 4.3, {} coupled runs of both FMUs\n", runs().count()))?;
    let summaries = cases.iter().map(Case::summary).collect::<Result<Vec<Summary>, _>>()?;
    say(format_args!("{}\n", study::pick_up_table(&summaries)))?;
    complain(&summaries)?;
    remark(format_args!("{}\n", speed(&runs().collect::<Vec<_>>())))?;
    wrote(&files)
}

fn run_all(pair: &Pair) -> Result<Vec<Case>> {
    let scenarios = study::pick_up()?;
    let progress = Progress::of(&scenarios, "Simulating")?;
    let cases = scenarios.into_iter().map(|scenario| Case::run(pair, scenario, &|| progress.point()));
    let cases = cases.collect::<Result<_, _>>();
    progress.finish();
    Ok(cases?)
}

fn prefix(run: &Run) -> String {
    format!("{}.", run.scenario.id)
}
