//! The report of the main run: the pick-up of thesis 4.3, minimum norm beside extended Jacobian.

use maud::html;

use super::{Error, Figure, Report, Series, Topic, figures, style};
use uam::scenarios::PICK_UP;

use crate::host::record::NotRecorded;
use crate::host::run::Run;
use crate::study::claims::Quantity;
use crate::study::verdict::Verdict;
use crate::study::{self, Case};

/// How long the figure of the growing swings goes on after the arm has left its workspace \[s\].
const AFTERWARDS: f64 = 1.0;

/// The table of all cases, and the figures of those with the discretization `exact`.
///
/// # Errors
/// If a case is missing or a figure cannot be drawn.
pub fn report(cases: &[Case]) -> Result<Report, Error> {
    let find = |scenario: &'static str| {
        cases.iter().find(|case| case.scenario.id == scenario).ok_or(Error::Missing { scenario })
    };
    let (extended, minimum) = (find(PICK_UP)?, find("4.3a")?);
    let pick_up = both(extended.exact(), minimum.exact());
    let mut figures = figures::all(&pick_up)?;
    for figure in &mut figures {
        if figure.topic == Topic::Error {
            figure.body = figures::error(&with_euler(pick_up, extended, minimum))?.body;
        }
        figure.caption = format!("{} {}", figure.caption, remark(figure.topic, &pick_up)?);
    }
    let (extended, minimum) = (find("4.3c-extended-jacobian")?, find("4.3c-minimum-norm")?);
    figures.push(growing_swings(&both(extended.exact(), minimum.exact()))?);
    let scenario = &pick_up[0].run.scenario;
    Ok(Report {
        title: "Picking up a payload from an elastic support".to_owned(),
        introduction: html! {
            (super::verdict(&Verdict::of(pick_up[0].run)?.sentences()))
            p {
                "A hovering multicopter reaches down with an arm of three links, grasps "
                (scenario.parameters.payload.mass) " kg that rest on a spring, and lifts them. The arm has one joint "
                "more than the path needs. The controller uses it either for the smallest joint rates (minimum norm), "
                "or to keep the moment of the arm off the UAV (extended Jacobian). This is the simulation of thesis "
                "section 4.3, with the free motion of the arm damped beside the extended Jacobian; without damping, as in "
                "the thesis, it is called 4.3b in the table."
            }
            p {
                code { "uam_controller.fmu" } " and " code { "uam_plant.fmu" } ", loaded through their C interface and "
                "coupled by a parallel master for " (scenario.duration) " s in steps of " (1e3 * scenario.step) " ms. "
                "The thesis' own step of the inverse kinematics is " code { "euler" } "; the FMUs' default is "
                code { "exact" } ", and so are the figures."
            }
        },
        table: study::pick_up_table(&cases.iter().map(Case::summary).collect::<Result<Vec<_>, _>>()?),
        figures,
        appendix: html! {
            (super::made_by())
            p { "The numbers of these curves are in " a href="pick-up.csv" { "pick-up.csv" } "." }
        },
    })
}

fn both<'a>(extended: &'a Run, minimum: &'a Run) -> [Series<'a>; 2] {
    [
        Series { label: "extended Jacobian", paint: style::MAIN, run: extended },
        Series { label: "minimum norm", paint: style::OTHER, run: minimum },
    ]
}

fn with_euler<'a>(
    [extended, minimum]: [Series<'a>; 2],
    extended_case: &'a Case,
    minimum_case: &'a Case,
) -> [Series<'a>; 4] {
    let pale =
        |label, series: Series<'a>, case: &'a Case| Series { label, paint: series.paint.pale(), run: case.euler() };
    [
        Series { label: "extended Jacobian, exact", ..extended },
        Series { label: "minimum norm, exact", ..minimum },
        pale("extended Jacobian, euler", extended, extended_case),
        pale("minimum norm, euler", minimum, minimum_case),
    ]
}

/// What one sees, with the numbers of these runs.
fn remark(topic: Topic, [extended, minimum]: &[Series<'_>; 2]) -> Result<String, NotRecorded> {
    let shown = |series: &Series<'_>, quantity: Quantity| {
        Ok(quantity.show(quantity.measure(&series.run.recording)?).to_string())
    };
    Ok(match topic {
        Topic::Vehicle => {
            "With the extended Jacobian the inner links fold back while the last one reaches out, so that what the UAV \
             carries stays balanced below it."
                .to_owned()
        }
        Topic::Base => format!(
            "With minimum norm the reaching arm tilts the UAV by up to {}, and it is carried {} to the right; with the \
             extended Jacobian it rolls by no more than {} and ends {} to the right, so that it hangs again where the \
             common centre of mass of vehicle and payload was. Either way it sinks by {} and more while the load comes \
             off the support, for the autopilot does not know of the payload.",
            shown(minimum, Quantity::Roll)?,
            shown(minimum, Quantity::FarthestRight)?,
            shown(extended, Quantity::Roll)?,
            shown(extended, Quantity::FinalX)?,
            shown(extended, Quantity::Sinking)?,
        ),
        Topic::Error => format!(
            "The controller knows nothing but its own prediction, and yet the end effector is never farther from its \
             reference than {} (extended Jacobian) and {} (minimum norm). The pale curves are the thesis' own step.",
            shown(extended, Quantity::TrackingError)?,
            shown(minimum, Quantity::TrackingError)?,
        ),
        Topic::Joints => "Both follow the same path of the end effector with different joint motions.".to_owned(),
        Topic::Rates | Topic::Reach => String::new(),
        Topic::Controls => format!(
            "The torque needed to hold the roll is {} at most with minimum norm, {} with the extended Jacobian. The \
             thrust rises by the weight of the payload.",
            shown(minimum, Quantity::Torque)?,
            shown(extended, Quantity::Torque)?,
        ),
        Topic::Moment => format!(
            "Up to {} with minimum norm; {} with the extended Jacobian, which is what it is for.",
            shown(minimum, Quantity::Moment)?,
            shown(extended, Quantity::Moment)?,
        ),
        Topic::Support => "It falls to zero as the path rises and the spring is relieved.".to_owned(),
    })
}

/// The same motion with a roll control that is unstable together with the arm.
fn growing_swings(series: &[Series<'_>; 2]) -> Result<Figure, Error> {
    let [extended, minimum] = series;
    let lost = Quantity::LostAt.measure(&minimum.run.recording)?;
    let until = if lost.is_finite() { lost + AFTERWARDS } else { minimum.run.scenario.duration };
    let mut figure = figures::base(series, Some(until))?;
    figure.title = format!("Motion of the UAV with roll kd = {}", minimum.run.scenario.parameters.autopilot.roll.kd);
    figure.caption = format!(
        "With these gains the UAV swings more and more under the minimum norm, until at {} the reference is out of the \
         arm's reach (the curve ends there). The extended Jacobian gives the roll control nothing to do: it rolls by \
         {} at most.",
        Quantity::LostAt.show(lost),
        Quantity::Roll.show(Quantity::Roll.measure(&extended.run.recording)?),
    );
    Ok(figure)
}
