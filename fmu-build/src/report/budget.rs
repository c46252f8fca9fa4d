//! The report of the error budget: errors over the communication step, orders, and what that means for users.

use comfy_table::presets::UTF8_FULL_CONDENSED;
use maud::{Markup, html};
use uam::parameters::{Discretization, Hold};
use uam::scenarios::Scenario;

use super::chart::{self, Across, Panel, Scale};
use super::panels::panels;
use super::{Error, Paint, page};
use crate::formats::markdown;
use crate::host::coupling::Order;
use crate::study::budget::{Curve, EULER, EXACT, Errors, Pilot, STEPS, Variant, Watch, observed_order};

/// Errors that users may ask for \[m\].
const WANTED: [f64; 4] = [1e-3, 1e-4, 1e-6, 1e-9];

/// The steps that the documents show \[s\].
const SHOWN: [f64; 3] = [1e-3, 1e-2, 2e-2];
/// Errors below this are nothing but rounding \[m\].
const ROUNDING: f64 = 1e-11;
/// An error whose order is smaller does not depend on the step.
const NO_ORDER: f64 = 0.5;
/// The variants that the documents show, in the words of users.
const IN_WORDS: [(&str, Variant); 6] = [
    ("`exact`, at the communication points", EXACT),
    ("`exact`, between them, `ik.hold` = `zero_order`", Variant { watch: Watch::Between, ..EXACT }),
    (
        "`exact`, between them, `ik.hold` = `first_order`",
        Variant { hold: Hold::FirstOrder, watch: Watch::Between, ..EXACT },
    ),
    ("`euler` (the thesis)", EULER),
    ("`exact`, master steps the controller first", Variant { order: Order::ControllerFirst, ..EXACT }),
    ("`exact`, autopilot sampled at 10 ms, controller not told", Variant { pilot: Pilot::SampledUnknown, ..EXACT }),
];

/// What is measured.
struct Measure {
    title: &'static str,
    axis: &'static str,
    of: fn(&Errors) -> f64,
}

const MEASURES: [Measure; 2] = [
    Measure { title: "Error of the end effector", axis: "distance [m]", of: |errors| errors.end_effector },
    Measure { title: "Error of the predicted base", axis: "distance [m]", of: |errors| errors.base },
];

/// Colours that stay apart for colour-blind eyes (M. Okabe and K. Ito).
const COLOURS: [(u8, u8, u8); 7] = [
    (0x00, 0x72, 0xb2),
    (0xe6, 0x9f, 0x00),
    (0x00, 0x9e, 0x73),
    (0xcc, 0x79, 0xa7),
    (0xd5, 0x5e, 0x00),
    (0x56, 0xb4, 0xe9),
    (0x33, 0x3a, 0x45),
];

fn shown_error(error: f64) -> String {
    if error == 0.0 { "0".to_owned() } else { format!("{error:.0e}") }
}

fn step(seconds: f64) -> String {
    format!("{} ms", 1e3 * seconds)
}

/// One row per variant: name, error with each step, order.
fn rows(curves: &[Curve], measure: &Measure) -> Vec<Vec<String>> {
    let row = |curve: &Curve| {
        let points = curve.of(measure.of);
        let at = |step: f64| points.iter().find(|(tried, _)| *tried == step).map(|(_, error)| shown_error(*error));
        let order = observed_order(&points).map_or_else(String::new, |order| format!("{order:.1}"));
        let errors = STEPS.into_iter().map(|step| at(step).unwrap_or_default());
        std::iter::once(curve.variant.name()).chain(errors).chain([order]).collect()
    };
    curves.iter().map(row).collect()
}

fn head(title: &str) -> Vec<String> {
    let steps = STEPS.into_iter().map(step);
    std::iter::once(title.to_owned()).chain(steps).chain(["order".to_owned()]).collect()
}

/// The longest step for each wanted error.
fn advice(curves: &[Curve]) -> Vec<Vec<String>> {
    let row = |curve: &Curve| {
        let longest = WANTED.into_iter().map(|error| curve.longest_step_within(error));
        let words = longest.map(|found| found.map_or_else(|| "none".to_owned(), step));
        std::iter::once(curve.variant.name()).chain(words).collect()
    };
    curves.iter().map(row).collect()
}

fn advice_head() -> Vec<String> {
    let wanted = WANTED.into_iter().map(|error| format!("within {error:.0e} m"));
    std::iter::once("Longest step".to_owned()).chain(wanted).collect()
}

/// The tables for the terminal.
#[must_use]
pub fn text(curves: &[Curve]) -> String {
    let table = |head: Vec<String>, rows: Vec<Vec<String>>| {
        let mut table = comfy_table::Table::new();
        table.load_style(UTF8_FULL_CONDENSED).set_header(head);
        table.add_rows(rows);
        table.to_string()
    };
    let errors = MEASURES.iter().map(|measure| table(head(&format!("{} [m]", measure.title)), rows(curves, measure)));
    errors.chain([table(advice_head(), advice(curves))]).collect::<Vec<_>>().join("\n\n")
}

/// What users need to know of the errors of the end effector, in Markdown.
#[must_use]
pub fn markdown(curves: &[Curve]) -> String {
    let mut head = vec!["largest error of the end effector".to_owned()];
    head.extend(SHOWN.map(step));
    head.push("order".to_owned());
    head.extend([1e-4, 1e-6].map(|error| format!("longest step for {error:.0e} m")));
    let row = |(words, variant): &(&str, Variant)| {
        let curve = curves.iter().find(|curve| curve.variant == *variant)?;
        let points = curve.of(|errors| errors.end_effector);
        let at = |step: f64| points.iter().find(|(tried, _)| *tried == step).map_or(f64::NAN, |(_, error)| *error);
        let errors = SHOWN.map(at);
        let order = match observed_order(&points) {
            _ if errors.iter().all(|error| *error < ROUNDING) => "rounding".to_owned(),
            Some(order) if order.abs() >= NO_ORDER => format!("{order:.1}"),
            _ => "none".to_owned(),
        };
        let longest = [1e-4, 1e-6].map(|error| curve.longest_step_within(error).map_or("none".to_owned(), step));
        let shown = |error: f64| {
            if error < ROUNDING { format!("< {ROUNDING:.0e} m") } else { format!("{error:.0e} m") }
        };
        let cells = errors.map(shown).into_iter().chain([order]).chain(longest);
        Some(std::iter::once((*words).to_owned()).chain(cells).collect())
    };
    markdown::table(&head, &IN_WORDS.iter().filter_map(row).collect::<Vec<_>>())
}

/// The page.
///
/// # Errors
/// If a figure cannot be drawn.
pub fn html(scenario: &Scenario, curves: &[Curve]) -> Result<String, Error> {
    let figures = MEASURES.iter().map(|measure| figure(curves, measure)).collect::<Result<Vec<_>, _>>()?;
    Ok(page(
        "Error budget of the coupling",
        &html! {
            p {
                "Largest errors over the " (scenario.duration) " s of " (scenario.id) " (" (scenario.title) "), with "
                code { "ik.sample_time" } " equal to the communication step. The controller measures nothing: "
                "its own prediction is all that it knows."
            }
            @for figure in figures { (figure) }
            section {
                h2 { "Which step for which error" }
                (table(&advice_head(), &advice(curves)))
                p {
                    "With " code { "exact" } " the step decides what happens between the communication points, not at "
                    "them: with constant rates the end effector cuts the corners of the path by an amount of second "
                    "order, with " code { "first_order" } " holds by much less. With " code { "euler" } " the error is "
                    "in proportion to the step everywhere. A master that steps the controller before the plant moves "
                    "everything ahead by one step: the error is the way that the reference covers in it. The sample "
                    "time of an autopilot costs nothing as long as the controller is told of it "
                    "(" code { "autopilot.sample_time" } ")."
                }
            }
        },
    ))
}

fn figure(curves: &[Curve], measure: &Measure) -> Result<Markup, Error> {
    // What coincides with another curve would hide it.
    let apart = |&curve: &&Curve| {
        let Variant { discretization, pilot, .. } = curve.variant;
        curve.variant == EULER || (discretization == Discretization::Exact && pilot != Pilot::Sampled)
    };
    // The colours come again where there are more curves.
    let paints = COLOURS.into_iter().cycle().map(|rgb| Paint { rgb, width: 4 });
    let shown: Vec<(&Curve, Paint)> = curves.iter().filter(apart).zip(paints).collect();
    let line = |(curve, paint): &(&Curve, Paint)| chart::Curve { paint: *paint, points: curve.of(measure.of) };
    let panel = Panel {
        across: Across { axis: "communication step [s]", scale: Scale::Logarithmic },
        axis: measure.axis.to_owned(),
        scale: Scale::Logarithmic,
        curves: shown.iter().rev().map(line).collect(),
        marks: Vec::new(),
    };
    let names: Vec<String> = shown.iter().map(|(curve, _)| curve.variant.name()).collect();
    let legend: Vec<_> = shown.iter().zip(&names).map(|((_, paint), name)| (*paint, name.as_str())).collect();
    Ok(html! {
        section {
            figure {
                h2 { (measure.title) }
                (panels(&legend, &[panel])?)
                (table(&head("largest error [m]"), &rows(curves, measure)))
                figcaption {
                    "Both axes are logarithmic. The order is the power of the step with which the error grows, where "
                    "it is neither rounding nor out of all proportion."
                }
            }
        }
    })
}

fn table(head: &[String], rows: &[Vec<String>]) -> Markup {
    html! {
        div.wide {
            table.numbers {
                thead { tr { @for cell in head { th { (cell) } } } }
                tbody { @for row in rows { tr { @for cell in row { td { (cell) } } } } }
            }
        }
    }
}
