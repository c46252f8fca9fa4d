//! Every simulation of the thesis, beside what it says.

use std::time::Instant;

use anyhow::Result;
use fmu_build::study;
use uam::scenarios::of_the_thesis;

use super::{Pairs, Progress, complain};
use crate::cli::PrintArguments;
use crate::terminal::{remark, say};

pub fn execute(arguments: &PrintArguments) -> Result<()> {
    let scenarios = of_the_thesis()?;
    let pairs = Pairs::build(&scenarios)?;
    let progress = Progress::of(&scenarios, "Simulating")?;
    let begin = Instant::now();
    let summaries = study::run_all(scenarios, &|scenario| pairs.of(scenario), &|| progress.point());
    let elapsed = begin.elapsed().as_secs_f64();
    progress.finish();
    let summaries = summaries?;

    let table = study::table(&summaries);
    if arguments.markdown {
        return say(table.markdown_with_remarks().trim_end());
    }
    let counts = table.columns.iter().zip(table.agreement_by_column());
    let counts: Vec<String> =
        counts.map(|(name, (all, agreeing))| format!("{agreeing} of {all} with {name}")).collect();
    say(format_args!(
        "Statements of the thesis that agree with what came out: {}. euler is the thesis' own step.\n\
         ✓: the number is what the statement says, or within what it leaves open; ✗: it is not, for the reasons below the table.\n\
         (kind): the statement is about the kind of motion, not about a number. No mark: both numbers are nothing but rounding.\n",
        counts.join(", ")
    ))?;
    let (statements, agreeing) = table.agreement();
    say(format_args!("{table}\n\n{agreeing} of {statements} numbers agree with the thesis."))?;
    table.remarks().try_for_each(|remark| say(format_args!("  ✗ {remark}")))?;
    let outcomes = || summaries.iter().flat_map(|summary| &summary.outcomes);
    complain(&summaries)?;
    let simulated: f64 = outcomes().map(|outcome| outcome.simulated).sum();
    remark(format_args!("{} runs, {simulated:.0} s simulated in {elapsed:.1} s.", outcomes().count()))
}
