//! The report of one run of any scenario.

use maud::html;
use uam::options::Choice;

use super::{Error, Report, Series, figures, style};
use crate::claims::{Quantity, Table};
use crate::coupling::Schedule;
use crate::run::Run;

/// Measured quantities and all figures of a run.
///
/// What the thesis says is left out unless the run has the length and the step of the thesis.
///
/// # Errors
/// If a figure cannot be drawn.
pub fn report(run: &Run, schedule: &Schedule) -> Result<Report, Error> {
    let scenario = &run.scenario;
    let discretization = scenario.parameters.ik.discretization.name();
    let as_in_thesis = schedule.stop() - schedule.start() == scenario.duration && schedule.step() == scenario.step;
    let mut table = Table::new([discretization]);
    let claims_of = if as_in_thesis { Some(scenario.id.as_str()) } else { None };
    table.add(claims_of, &scenario.id, &Quantity::ALL, &[&run.recording]);
    let series = [Series { label: &scenario.id, paint: style::MAIN, run }];
    Ok(Report {
        title: format!("{}: {}", scenario.id, scenario.title),
        introduction: html! {
            p {
                "Both FMUs (" (scenario.structure) "), coupled for " (schedule.stop() - schedule.start())
                " s in communication steps of " (schedule.step()) " s; discretization of the inverse kinematics: "
                code { (discretization) } "."
            }
            @if let Some(complaint) = run.complaint() { p { strong { "The run did not reach its end: " (complaint) } } }
        },
        table,
        figures: figures::all(&series)?,
    })
}
