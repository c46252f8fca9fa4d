//! The report of one run of any scenario.

use maud::{Markup, html};
use uam::scenarios::{self, Scenario};
use uam::variables::options::Choice;

use super::{Error, Report, Series, Topic, figures, style};
use crate::host::run::Run;
use crate::study::claims::{self, Numbers, Quantity, Row, Table};
use crate::study::particulars::Particulars;

/// The verdict on a run, its measured quantities, and all figures.
///
/// What the thesis says is left out unless the run is of the thesis, with its length and step.
///
/// # Errors
/// If a figure cannot be drawn.
pub fn report(run: &Run, particulars: &Particulars) -> Result<Report, Error> {
    let scenario = &run.scenario;
    let discretization = scenario.parameters.ik.discretization.name();
    let [start, stop, step] = particulars.schedule;
    let as_in_thesis = stop - start == scenario.duration && step == scenario.step && is_of_the_catalogue(scenario);
    let mut table = Table::new([discretization]);
    let numbers = Numbers::of(&run.recording, scenario.structure)?;
    let row = |quantity: Quantity| {
        let value = numbers.get(quantity);
        match claims::of(&scenario.id, quantity).filter(|_| as_in_thesis) {
            Some(claim) => Some(Row::of(claim, [Some(value)])),
            // Not a number: the vehicle has nothing of this kind, or the run is too short for it.
            None => (!value.is_nan()).then(|| Row::plain(quantity, [quantity.show(value).to_string()])),
        }
    };
    table.add(&scenario.id, Quantity::ALL.into_iter().filter_map(row).collect());
    let series = [Series { label: &scenario.id, paint: style::MAIN, run }];
    let mut figures = figures::all(&series)?;
    let after_joints = figures.iter().position(|figure| figure.topic == Topic::Joints).map_or(0, |joints| joints + 1);
    figures.insert(after_joints, figures::rates(&series)?);
    Ok(Report {
        title: format!("{}: {}", scenario.id, scenario.title),
        introduction: html! {
            (super::verdict(&particulars.verdict))
            p {
                "Both FMUs (" (scenario.structure) "), coupled for " (stop - start)
                " s in communication steps of " (step) " s; discretization of the inverse kinematics: "
                code { (discretization) } "."
            }
        },
        table,
        figures,
        appendix: appendix(particulars),
    })
}

/// Whether a scenario is that of the catalogue with its name, whatever the discretization: what the thesis says is about no other.
fn is_of_the_catalogue(scenario: &Scenario) -> bool {
    scenarios::find(&scenario.id).is_ok_and(|mut known| {
        known.parameters.ik.discretization = scenario.parameters.ik.discretization;
        known == *scenario
    })
}

/// What was simulated, by what, and where the numbers are.
fn appendix(particulars: &Particulars) -> Markup {
    let Particulars { program, date, csv, id, parameters, scenario, .. } = particulars;
    let json = format!("{id}.json");
    html! {
        section {
            h2 { "What was simulated" }
            p {
                "Scenario " code { (id) } ", by " (program) " on " (date) ". The numbers are in " a href=(csv) { (csv) }
                "; their units, all parameters and the scenario in " a href=(json) { (json) } "."
            }
            details {
                summary { "All parameters" }
                div.wide {
                    table.numbers {
                        thead { tr { th { "parameter" } th { "value" } th { "unit" } th { "meaning" } } }
                        tbody {
                            @for parameter in parameters {
                                tr {
                                    td { code { (parameter.name) } }
                                    td { (parameter.value) }
                                    td { (parameter.unit) }
                                    td { (parameter.description) }
                                }
                            }
                        }
                    }
                }
            }
            details {
                summary { "The scenario as a file for " code { "simulate" } }
                pre { (scenario) }
            }
        }
    }
}
