//! The error budget of the coupling: a run for each way of running both units, and for each step.

use std::path::Path;

use anyhow::Result;
use fmu_build::study::budget::{Curve, Errors, VARIANTS, Variant};
use fmu_build::study::on_all_cores;
use fmu_build::{files, report};
use uam::scenarios::find;

use super::{Pairs, Progress};
use crate::cli::PrintArguments;
use crate::terminal::{say, wrote};

/// The pick-up with the extended Jacobian.
const SCENARIO: &str = "4.3b";

pub fn execute(arguments: &PrintArguments, out: &Path) -> Result<()> {
    let scenario = find(SCENARIO)?;
    files::create_folder(out)?;
    let pairs = Pairs::build([&scenario])?;
    let pair = pairs.of(&scenario)?;
    let mut jobs: Vec<(Variant, f64)> =
        VARIANTS.into_iter().flat_map(|variant| variant.steps().map(move |step| (variant, step))).collect();
    // Those that take longest begin.
    jobs.sort_by(|a, b| a.1.total_cmp(&b.1));
    let points = |(variant, step): &(Variant, f64)| Ok(variant.schedule(&scenario, *step)?.steps() as u64);
    let progress = Progress::new(jobs.iter().map(points).sum::<Result<u64>>()?, "Simulating")?;
    let errors = on_all_cores(&jobs, |(variant, step)| variant.run(pair, &scenario, *step, &|| progress.point()));
    progress.finish();
    let results = jobs.iter().zip(errors).map(|(&(variant, step), errors)| Ok((variant, step, errors?)));
    let results: Vec<(Variant, f64, Errors)> = results.collect::<Result<_>>()?;
    let curves = VARIANTS.map(|variant| {
        let of_this = results.iter().filter(|(found, ..)| *found == variant);
        Curve { variant, points: of_this.map(|&(_, step, errors)| (step, errors)).collect() }
    });

    if arguments.markdown {
        return say(report::budget::markdown(&curves).trim_end());
    }
    let page = files::write(&out.join("budget.html"), report::budget::html(&scenario, &curves)?.as_bytes())?;
    say(report::budget::text(&curves))?;
    wrote(&[page])
}
