//! A simulation with some numbers changed.

use anyhow::{Result, ensure};
use fmu_build::study::claims::{self, Claim, DISCRETIZATIONS, Quantity, Row, Table};
use fmu_build::study::variation::vary;
use fmu_build::study::{self, Summary};
use uam::scenarios::{Scenario, find};
use uam::variables::options::Choice;

use super::{Pairs, Progress, complain};
use crate::cli::VaryArguments;
use crate::terminal::say;

pub fn execute(arguments: &VaryArguments) -> Result<()> {
    let scenario = super::scenario(&arguments.scenario)?;
    ensure!(
        arguments.changes.iter().all(|change| change.name != "ik.discretization"),
        "ik.discretization cannot be varied: each variant runs with both, in a block of its own"
    );
    let variants = variants(arguments)?;
    let claims: Vec<&Claim> = claims::about(&scenario.id).collect();
    // Those with which claims compare are changed alike.
    let mut scenarios = vec![scenario];
    for other in claims.iter().filter_map(|claim| claim.compared_with) {
        if scenarios.iter().all(|scenario| scenario.id != other) {
            scenarios.push(find(other)?);
        }
    }
    let varied: Vec<Scenario> = variants
        .iter()
        .flat_map(|(_, changes)| scenarios.iter().map(|scenario| vary(scenario, changes)))
        .collect::<Result<_, _>>()?;
    let pairs = Pairs::build(&varied)?;
    let progress = Progress::of(&varied, "Simulating")?;
    let summaries = study::run_all(varied, &|scenario| pairs.of(scenario), &|| progress.point());
    progress.finish();
    let summaries = summaries?;

    let columns: Vec<&[Summary]> = summaries.chunks(scenarios.len()).collect();
    let names: Vec<&str> = arguments.changes.iter().map(|change| change.name.as_str()).collect();
    let mut table = Table::new(variants.iter().map(|(label, _)| label.as_str()));
    for (i, discretization) in DISCRETIZATIONS.iter().enumerate() {
        let mut rows = Vec::new();
        for claim in &claims {
            let values = columns
                .iter()
                .map(|summaries| study::values(summaries, claim).map_or(Some(f64::NAN), |values| values[i]));
            rows.push(Row::of(claim, values));
        }
        let wanted = |quantity: &Quantity| {
            (arguments.all || claims.is_empty()) && claims::of(&scenarios[0].id, *quantity).is_none()
        };
        for quantity in Quantity::ALL.into_iter().filter(wanted) {
            let values: Vec<f64> =
                columns.iter().map(|summaries| summaries[0].outcomes[i].numbers.get(quantity)).collect();
            // Not a number: the vehicle has nothing of this kind.
            if values.iter().any(|value| !value.is_nan()) {
                rows.push(Row::plain(quantity, values.into_iter().map(|value| quantity.show(value).to_string())));
            }
        }
        table.add(format!("{} · {} · by {}", scenarios[0].id, discretization.name(), names.join(", ")), rows);
    }
    if arguments.print.markdown {
        say(table.markdown().trim_end())?
    } else {
        say(table)?;
        for ((label, _), summaries) in variants.iter().zip(&columns) {
            warn(label, &summaries[0])?;
        }
    }
    complain(&summaries)
}

/// Says of which runs the numbers mean little, since the path was not followed.
fn warn(label: &str, summary: &Summary) -> Result<()> {
    for (outcome, discretization) in summary.outcomes.iter().zip(DISCRETIZATIONS) {
        if !outcome.verdict.followed {
            say(format_args!("{label}, {}: {}", discretization.name(), outcome.verdict.sentence))?;
        }
    }
    Ok(())
}

/// A heading, and names with their values.
type Variant<'a> = (String, Vec<(&'a str, &'a str)>);

/// The scenario as it is, and one variant for each value.
fn variants(arguments: &VaryArguments) -> Result<Vec<Variant<'_>>> {
    let number = arguments.changes.iter().map(|change| change.values.len()).max().unwrap_or_default();
    let mut variants: Vec<Variant<'_>> = vec![("unchanged".to_owned(), Vec::new())];
    for i in 0..number {
        let mut changes = Vec::new();
        for change in &arguments.changes {
            let values = &change.values;
            ensure!(
                values.len() == number || values.len() == 1,
                "{} must have {number} values or one, but has {}",
                change.name,
                values.len()
            );
            changes.push((change.name.as_str(), values[if values.len() == 1 { 0 } else { i }].as_str()));
        }
        let label = changes.iter().map(|(_, value)| *value).collect::<Vec<_>>().join(", ");
        variants.push((label, changes));
    }
    Ok(variants)
}
