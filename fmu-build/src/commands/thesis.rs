//! Every simulation of the thesis, beside what it says.

use std::path::Path;

use anyhow::Result;
use fmu_build::coupling::Pair;
use fmu_build::run::Run;
use fmu_build::study::{self, Case, DISCRETIZATIONS};
use uam::Structure;
use uam::scenarios::catalogue;

use super::{Progress, build, folder, speed};

pub fn execute(out: &Path) -> Result<()> {
    let scenarios = catalogue()?;
    let mut pairs: Vec<(Structure, Pair)> = Vec::new();
    let mut cases = Vec::with_capacity(scenarios.len());
    let points: f64 = scenarios.iter().map(|scenario| scenario.duration / scenario.step).sum();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "only for the progress bar")]
    let points = points as u64 * DISCRETIZATIONS.len() as u64;
    let progress = Progress::new(points, "Simulating")?;
    for scenario in scenarios {
        let pair = pair(&mut pairs, scenario.structure, out)?;
        cases.push(Case::run(&pair, scenario, &|| progress.point())?);
    }
    progress.finish();

    let table = study::table(&cases);
    let (statements, agreeing) = table.agreement();
    println!("{table}\n\n{agreeing} of {statements} numbers agree with the thesis.");
    let runs: Vec<&Run> = cases.iter().flat_map(|case| &case.runs).collect();
    for run in &runs {
        if let Some(complaint) = run.complaint() {
            println!("{}: {complaint}", run.scenario.id);
        }
    }
    println!("{}", speed(&runs));
    Ok(())
}

/// The FMUs of a structure, built when they are needed for the first time.
fn pair(pairs: &mut Vec<(Structure, Pair)>, structure: Structure, out: &Path) -> Result<Pair> {
    if let Some((_, pair)) = pairs.iter().find(|(built, _)| *built == structure) {
        return Ok(pair.clone());
    }
    let built = build(structure, &folder(out, structure))?;
    let pair = Pair::open(&built.controller, &built.plant)?;
    pairs.push((structure, pair.clone()));
    Ok(pair)
}
