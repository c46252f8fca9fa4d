//! The figures of a report: what is drawn, and how to read it.

use maud::{Markup, html};
use uam::control::Status;
use uam::parameters::Balance;
use uam::variables::options::Choice;

use super::chart::{Curve, Panel, Scale, TIME};
use super::{Error, Series, arm, panels};
use crate::host::run::Run;
use crate::study::claims::Quantity;

/// What a figure is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topic {
    /// The vehicle at some instants.
    Vehicle,
    /// Pose of the UAV.
    Base,
    /// End effector against reference.
    Error,
    /// Joint angles and counterweight.
    Joints,
    /// Rates of joints and counterweight, and what limits them.
    Rates,
    /// Thrust and torque of the rotors.
    Controls,
    /// Moment of the arm on the UAV.
    Moment,
    /// Force of the support.
    Support,
    /// How far the arm reaches.
    Reach,
}

/// A figure with its heading and its caption.
#[derive(Debug)]
pub struct Figure {
    /// What it is about.
    pub topic: Topic,
    /// Heading.
    pub title: String,
    /// The drawing.
    pub body: Markup,
    /// How to read it, and what one sees.
    pub caption: String,
}

/// All figures that make sense for these runs of one vehicle.
///
/// # Errors
/// If a figure cannot be drawn.
pub fn all(series: &[Series<'_>]) -> Result<Vec<Figure>, Error> {
    let mut figures = vec![vehicle(series)?, base(series, None)?, error(series)?, joints(series)?, controls(series)?];
    figures.push(moment(series)?);
    let forces = series.iter().map(|series| series.run.recording.column("support.force"));
    if forces.collect::<Result<Vec<_>, _>>()?.concat().iter().any(|&force| force > 0.0) {
        figures.push(support(series)?);
    }
    Ok(figures)
}

fn vehicle(series: &[Series<'_>]) -> Result<Figure, Error> {
    let instants = series.first().map(arm::instants).unwrap_or_default();
    let body = html! { (arm::strips(series, &instants)?) };
    Ok(Figure {
        topic: Topic::Vehicle,
        title: "The vehicle at some instants".to_owned(),
        body,
        caption: "Inertial frame, to scale but for the sketched UAV, payload and spring. Grey: the path that the end \
                  effector is to follow; dashed: where the UAV's centre of mass was at the start."
            .to_owned(),
    })
}

/// Pose of the UAV up to `until`; a run whose arm has left its workspace ends there.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn base(series: &[Series<'_>], until: Option<f64>) -> Result<Figure, Error> {
    let panels = [
        panel(series, "x, to the right [mm]", "base.x", 1e3, until)?,
        panel(series, "y, upwards [mm]", "base.y", 1e3, until)?,
        panel(series, "roll, counter-clockwise [°]", "base.roll", 1f64.to_degrees(), until)?,
    ];
    Ok(Figure {
        topic: Topic::Base,
        title: "Motion of the UAV".to_owned(),
        body: grid(series, &panels)?,
        caption: "Position of the UAV's centre of mass and its roll.".to_owned(),
    })
}

/// Distance of the end effector from its reference.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn error(series: &[Series<'_>]) -> Result<Figure, Error> {
    let curves = series
        .iter()
        .rev()
        .map(|series| {
            let recording = &series.run.recording;
            Ok(Curve::of_peaks(series.paint, recording.times(), recording.tracking_error()?.into_iter()))
        })
        .collect::<Result<_, Error>>()?;
    let panels = [Panel {
        across: TIME,
        axis: "distance [m]".to_owned(),
        scale: Scale::Logarithmic,
        curves,
        marks: marks(series)?,
    }];
    Ok(Figure {
        topic: Topic::Error,
        title: "Error of the end effector".to_owned(),
        body: grid(series, &panels)?,
        caption: "Distance between the plant's end effector and the reference at the communication points, \
                  logarithmic; what is below 1e-16 m is drawn there."
            .to_owned(),
    })
}

fn joints(series: &[Series<'_>]) -> Result<Figure, Error> {
    let Some(structure) = series.first().map(|series| series.run.scenario.structure) else {
        return Err(Error::Empty);
    };
    let degrees = 1f64.to_degrees();
    let mut panels: Vec<Panel> = (1..=structure.links)
        .map(|n| panel(series, &format!("joint {n} [°]"), &format!("joint[{n}].position"), degrees, None))
        .collect::<Result<_, _>>()?;
    match structure.balance {
        Balance::None => {}
        Balance::Counterweight => {
            panels.push(panel(series, "counterweight [mm]", "counterweight.position", 1e3, None)?);
        }
        Balance::Element => {
            panels.push(panel(series, "balance element [°]", "balance_element.position", degrees, None)?);
        }
    }
    Ok(Figure {
        topic: Topic::Joints,
        title: "Joint angles".to_owned(),
        body: grid(series, &panels)?,
        caption: "Angle of each link against the previous one, of the first against the UAV's downward axis."
            .to_owned(),
    })
}

/// Commanded rates, and how they came about where something stands in the way of the path or of the moment.
///
/// # Errors
/// If the figure cannot be drawn.
pub fn rates(series: &[Series<'_>]) -> Result<Figure, Error> {
    let Some(Series { run, .. }) = series.first() else { return Err(Error::Empty) };
    let structure = run.scenario.structure;
    let joint = |n| panel(series, &format!("joint {n} [rad/s]"), &format!("joint[{n}].rate_command"), 1.0, None);
    let mut panels: Vec<Panel> = (1..=structure.links).map(joint).collect::<Result<_, _>>()?;
    if let Some(name) = structure.balance.prefix() {
        let (axis, factor) = match structure.balance {
            Balance::Counterweight => ("counterweight [mm/s]", 1e3),
            _ => ("balance element [rad/s]", 1.0),
        };
        panels.push(panel(series, axis, &format!("{name}.rate_command"), factor, None)?);
    }
    let status = run.recording.column("ik.status")?;
    let met: Vec<String> = Status::Ok
        .items()
        .iter()
        .zip(1..)
        .filter(|(_, number)| status.contains(&f64::from(*number)))
        .map(|(item, number)| format!("{number} {}: {}", item.name, item.description))
        .collect();
    if met.len() > 1 {
        panels.push(panel(series, "ik.status", "ik.status", 1.0, None)?);
    }
    Ok(Figure {
        topic: Topic::Rates,
        title: "Rates and what limits them".to_owned(),
        body: grid(series, &panels)?,
        caption: format!("What the controller sends. Its status in this run: {}", met.join(" ")),
    })
}

fn controls(series: &[Series<'_>]) -> Result<Figure, Error> {
    let panels = [
        panel(series, "thrust U1 [N]", "autopilot.thrust", 1.0, None)?,
        panel(series, "torque U2 [N m]", "autopilot.torque", 1.0, None)?,
    ];
    Ok(Figure {
        topic: Topic::Controls,
        title: "Thrust and torque of the autopilot".to_owned(),
        body: grid(series, &panels)?,
        caption: "What the hover control asks of the rotors.".to_owned(),
    })
}

fn moment(series: &[Series<'_>]) -> Result<Figure, Error> {
    let panels = [panel(series, "moment [N m]", "transmitted.moment", 1.0, None)?];
    Ok(Figure {
        topic: Topic::Moment,
        title: "Moment of the arm on the UAV".to_owned(),
        body: grid(series, &panels)?,
        caption: "Moment about the UAV's centre of mass of all that it carries, mean over each communication step."
            .to_owned(),
    })
}

fn support(series: &[Series<'_>]) -> Result<Figure, Error> {
    let panels = [panel(series, "force [N]", "support.force", 1.0, None)?];
    Ok(Figure {
        topic: Topic::Support,
        title: "Force of the support on the payload".to_owned(),
        body: grid(series, &panels)?,
        caption: "From the grasp on, the arm takes over what the elastic support carries.".to_owned(),
    })
}

/// One variable of every series.
fn panel(series: &[Series<'_>], axis: &str, column: &str, factor: f64, until: Option<f64>) -> Result<Panel, Error> {
    let curve = |series: &Series<'_>| {
        let recording = &series.run.recording;
        let end = match until {
            None => recording.len(),
            Some(until) => {
                let lost = Quantity::LostAt.measure(recording)?;
                recording.row_at(until.min(lost)).map_or(0, |row| row + 1)
            }
        };
        let values = recording.column(column)?.iter().take(end).map(|value| factor * value);
        Ok(Curve::new(series.paint, recording.times(), values))
    };
    Ok(Panel {
        across: TIME,
        axis: axis.to_owned(),
        scale: Scale::Linear,
        // The first series is the one to look at: it is drawn last, on top.
        curves: series.iter().rev().map(curve).collect::<Result<_, Error>>()?,
        marks: marks(series)?,
    })
}

fn marks(series: &[Series<'_>]) -> Result<Vec<(f64, &'static str)>, Error> {
    let Some(Series { run: Run { recording, .. }, .. }) = series.first() else { return Err(Error::Empty) };
    let grasp = recording.column("payload.attached")?.iter().position(|&attached| attached > 0.5);
    Ok(grasp.filter(|row| *row > 0).map(|row| (recording.times()[row], "grasp")).into_iter().collect())
}

fn grid(series: &[Series<'_>], panels: &[Panel]) -> Result<Markup, Error> {
    let names: Vec<_> = series.iter().map(|series| (series.paint, series.label)).collect();
    panels::panels(&names, panels)
}
