//! The report on how far the arm reaches.

use maud::html;
use uam::scenarios::Scenario;
use uam::variables::options::Choice;

use super::chart::{Across, Curve, Panel, Scale};
use super::panels::panels;
use super::{Error, Figure, Report, Topic, style};
use crate::formats::markdown;
use crate::study::claims::DISCRETIZATIONS;
use crate::study::claims::{Cell, Row, Table};
use crate::study::reach::{AGREEMENT, BALANCED, MOTIONS, Reach, comes_to_its_end};

/// The reaches of all motions beside those of the thesis. `results`: for each scenario those with each
/// discretization.
#[must_use]
pub fn table(scenarios: &[Scenario], results: &[Reach]) -> Table {
    let mut table = Table::new(DISCRETIZATIONS.map(|discretization| discretization.name()));
    let cell = |way: f64, agrees| Cell { text: format!("{:.0} mm", 1e3 * way), agrees };
    // No longer way was tried.
    let at_least = |cell: Cell, reach: &Reach| match reach.trials.last() {
        Some(last) if last.followed => Cell { text: format!("at least {}", cell.text), ..cell },
        _ => cell,
    };
    for ((motion, scenario), results) in MOTIONS.iter().zip(scenarios).zip(results.chunks(DISCRETIZATIONS.len())) {
        let agrees = |way: f64| Some((way / motion.thesis - 1.0).abs() <= AGREEMENT);
        let followed = Row {
            quantity: "follows the path up to".to_owned(),
            thesis: Some(motion.says),
            cells: results.iter().map(|reach| at_least(cell(reach.followed, agrees(reach.followed)), reach)).collect(),
            remark: None,
        };
        let balanced = Row {
            quantity: format!("with at most {BALANCED} N m on the UAV up to"),
            thesis: None,
            cells: results.iter().map(|reach| cell(reach.balanced, None)).collect(),
            remark: None,
        };
        table.add(format!("{} · {}", scenario.id, scenario.title), vec![followed, balanced]);
    }
    table
}

/// The reaches in Markdown: with each discretization, and how far the moment on the UAV stays small, too.
#[must_use]
pub fn markdown(results: &[Reach]) -> String {
    let names = DISCRETIZATIONS.map(|discretization| format!("`{}`", discretization.name()));
    let mut head = vec![String::new(), "thesis".to_owned()];
    head.extend(names.iter().cloned());
    head.extend(names.iter().map(|name| format!("{name}, at most {BALANCED} N m on the UAV")));
    let way = |way: f64| format!("{:.0} mm", 1e3 * way);
    let rows = MOTIONS.iter().zip(results.chunks(DISCRETIZATIONS.len())).map(|(motion, results)| {
        let mut row = vec![format!("{}, {}", motion.scenario, motion.about), motion.says.to_owned()];
        row.extend(results.iter().map(|reach| way(reach.followed)));
        row.extend(results.iter().map(|reach| way(reach.balanced)));
        row
    });
    markdown::table(&head, &rows.collect::<Vec<_>>())
}

/// Which motions do not come to their end while they are simulated, so that none counts as followed.
pub fn unfinished(scenarios: &[Scenario]) -> impl Iterator<Item = String> {
    scenarios.iter().filter(|scenario| !comes_to_its_end(scenario)).map(|scenario| {
        let Scenario { id, parameters, duration, .. } = scenario;
        let end = parameters.reference.end();
        format!("{id} follows nothing: its motion takes {end} s, of which {duration} s are simulated")
    })
}

/// The table, and the moment on the UAV over the way.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn report(scenarios: &[Scenario], results: &[Reach], changes: &str) -> Result<Report, Error> {
    let [.., last] = DISCRETIZATIONS;
    let exact: Vec<&Reach> = results.iter().skip(1).step_by(DISCRETIZATIONS.len()).collect();
    let panel = |first: usize| {
        let curves = [(first + 1, style::OTHER), (first, style::MAIN)];
        let curves = curves.into_iter().filter_map(|(i, paint)| {
            let points = exact.get(i)?.trials.iter().filter(|trial| trial.followed);
            let (ways, moments): (Vec<f64>, Vec<f64>) = points.map(|trial| (1e3 * trial.way, trial.moment)).unzip();
            Some(Curve::new(paint, &ways, moments.into_iter()))
        });
        let marks = [(first, "locked"), (first + 1, "moving")];
        Panel {
            across: Across { axis: "way to the right [mm]", scale: Scale::Linear },
            axis: "largest moment [N m]".to_owned(),
            scale: Scale::Linear,
            curves: curves.collect(),
            marks: marks.into_iter().filter_map(|(i, word)| Some((1e3 * MOTIONS.get(i)?.thesis, word))).collect(),
        }
    };
    let names = [(style::MAIN, "counterweight locked"), (style::OTHER, "counterweight moving")];
    let figure = Figure {
        topic: Topic::Reach,
        title: "What the way costs".to_owned(),
        body: panels(&names, &[panel(0), panel(2)])?,
        caption: format!(
            "Left: without payload (thesis 3.8); right: with payload (4.4). Largest moment on the UAV over the way, \
             up to where the path gives way; discretization {}. Dashed: how far the thesis gets.",
            last.name()
        ),
    };
    Ok(Report {
        title: "How far the arm reaches".to_owned(),
        introduction: html! {
            p {
                "Each motion is enlarged until limits or a singular configuration make the path give way ("
                code { "ik.status" } "). The moment on the UAV gives way earlier: the limits come first, then the "
                "path, then the moment."
            }
            @if !changes.is_empty() { p { "Changed: " code { (changes) } "." } }
            @for remark in unfinished(scenarios) { p { (remark) "." } }
        },
        table: table(scenarios, results),
        appendix: super::made_by(),
        figures: vec![figure],
    })
}

#[cfg(test)]
mod tests {
    use uam::scenarios::find;

    use super::*;
    use crate::study::reach::Trial;

    fn reached(ways: [f64; 2], follows: f64) -> Reach {
        let trials = ways.map(|way| Trial { way, followed: way <= follows, moment: 0.0 }).into();
        Reach { followed: follows, balanced: 0.0, trials }
    }

    /// Where the longest way that was tried was followed, nobody knows how far the arm reaches.
    #[test]
    fn a_reach_without_an_edge_is_called_so() {
        let scenarios = MOTIONS.map(|motion| find(motion.scenario).unwrap());
        let results = [reached([0.12, 0.14], 0.13), reached([0.48, 0.49], 0.49)];
        let text = table(&scenarios[..1], &results).to_string();
        assert!(text.contains("130 mm ✓") && !text.contains("at least 130 mm"), "{text}");
        assert!(text.contains("at least 490 mm ✗"), "{text}");
    }

    #[test]
    fn motions_that_do_not_end_are_called_so() {
        let mut scenarios = MOTIONS.map(|motion| find(motion.scenario).unwrap());
        assert_eq!(unfinished(&scenarios).count(), 0);
        scenarios[2].duration = 0.5;
        let remarks: Vec<String> = unfinished(&scenarios).collect();
        assert!(
            matches!(&remarks[..], [remark] if remark.starts_with("4.4a") && remark.contains("0.5 s")),
            "{remarks:?}"
        );
    }
}
