//! Every simulation of the thesis, beside what it says.

use std::path::Path;
use std::time::Instant;

use anyhow::Result;
use fmu_build::study;
use uam::scenarios::{PICK_UP, catalogue};

use super::{Pairs, Progress, complain};
use crate::cli::PrintArguments;

pub fn execute(arguments: &PrintArguments, out: &Path) -> Result<()> {
    let mut scenarios = catalogue()?;
    scenarios.retain(|scenario| scenario.id != PICK_UP);
    let pairs = Pairs::build(out, scenarios.iter().map(|scenario| scenario.structure))?;
    let progress = Progress::of(&scenarios, "Simulating")?;
    let begin = Instant::now();
    let summaries = study::run_all(scenarios, &|structure| pairs.of(structure), &|| progress.point());
    let elapsed = begin.elapsed().as_secs_f64();
    progress.finish();
    let summaries = summaries?;

    let table = study::table(&summaries);
    if arguments.markdown {
        print!("{}", table.markdown_with_remarks());
        return Ok(());
    }
    let (statements, agreeing) = table.agreement();
    println!("{table}\n\n{agreeing} of {statements} numbers agree with the thesis.");
    for remark in table.remarks() {
        println!("  ✗ {remark}");
    }
    let outcomes = || summaries.iter().flat_map(|summary| &summary.outcomes);
    complain(&summaries);
    let simulated: f64 = outcomes().map(|outcome| outcome.simulated).sum();
    println!("{} runs, {simulated:.0} s simulated in {elapsed:.1} s.", outcomes().count());
    Ok(())
}
