//! What looks wrong in a run, whether or not the path was followed.

use std::f64::consts::FRAC_PI_4;

use uam::parameters::Actuation;
use uam::reference::ReferenceKind;

use super::number;
use crate::host::record::NotRecorded;
use crate::host::run::Run;
use crate::study::check::mistakes::{Sentence, sentence};
use crate::study::check::{Finding, check};
use crate::study::claims::Quantity;

/// Beyond this roll a multicopter does not hover any more \[rad\].
const STEEP: f64 = FRAC_PI_4;

/// A hovering UAV that is farther than this from where it began is not held there \[m\].
const FAR: f64 = 1.0;

/// One that is faster than this along x in the last second has not come to rest \[m/s\].
const RESTLESS: f64 = 0.02;

/// Communication points are sums of many steps.
const ROUNDING: f64 = 1e-9;

/// A sentence for each thing that looks wrong: what could be known beforehand, then what happened.
pub(super) fn of(run: &Run) -> Result<Vec<String>, NotRecorded> {
    let mut doubts = foreseen(run);
    doubts.extend(free_joints(run));
    doubts.extend(cut_short(run));
    doubts.extend(flight(run)?);
    Ok(doubts)
}

/// What looks wrong before anything moves, as `check` says it.
fn foreseen(run: &Run) -> Vec<String> {
    let mut report = match check(&run.scenario) {
        Ok(report) => report,
        Err(error) => return vec![error.to_string()],
    };
    // What a vehicle has from the thesis' pick-up is no fault in itself: whoever has asked for it knows. What it does is said.
    report.findings.retain(|finding| !matches!(finding, Finding::Inherited(_)));
    // Beside angles in degrees, all else is about what was meant and not about what was run.
    if report.findings.iter().any(|finding| matches!(finding, Finding::Degrees(_))) {
        report.findings.retain(|finding| matches!(finding, Finding::Degrees(_)));
    }
    let spoken = report.findings.iter().map(|finding| sentence(finding, &run.scenario, &report));
    spoken.map(|Sentence { what, change }| format!("{what} Change: {change}")).collect()
}

/// Joints whose torque nobody gives.
fn free_joints(run: &Run) -> Vec<String> {
    let joints = (1..).zip(&run.scenario.parameters.joints).take(run.scenario.structure.links);
    joints
        .filter(|(_, joint)| joint.actuation == Actuation::Torque)
        .map(|(n, _)| {
            format!("Joint {n} turns freely: joint[{n}].actuation is torque, and the input joint[{n}].torque_command stays 0.")
        })
        .collect()
}

/// A path that goes on when the run ends.
fn cut_short(run: &Run) -> Option<String> {
    let reference = &run.scenario.parameters.reference;
    let (end, simulated) = (reference.end(), run.simulated());
    let goes_on = reference.kind != ReferenceKind::External && end > simulated * (1.0 + ROUNDING);
    goes_on
        .then(|| format!("The run ends after {} s, while the path goes on until {} s.", number(simulated), number(end)))
}

/// What no hovering multicopter does.
fn flight(run: &Run) -> Result<Vec<String>, NotRecorded> {
    let recording = &run.recording;
    let first = |name: &str, wrong: &dyn Fn(f64) -> bool| {
        let row = recording.column(name)?.iter().position(|value| wrong(*value));
        Ok::<_, NotRecorded>(row.map(|row| number(recording.times()[row])))
    };
    let last = |name: &str| Ok::<_, NotRecorded>(recording.column(name)?.last().copied().unwrap_or(f64::NAN));
    let mut doubts = Vec::new();
    if let Some(time) = first("autopilot.thrust", &|thrust| thrust < 0.0)? {
        doubts.push(format!("The thrust falls below zero at {time} s: rotors only push upwards."));
    }
    if let Some(time) = first("base.roll", &|roll| roll.abs() > STEEP)? {
        doubts.push(format!("The UAV rolls beyond 45 degrees at {time} s: it does not hover any more."));
    }
    if let Some(time) = first("base.y", &|y| y.abs() > FAR)? {
        let way = last("base.y")?;
        doubts.push(format!(
            "The UAV does not hold its altitude: it is {FAR} m from where it began at {time} s, and {} m {} it at the end.",
            number(way.abs()),
            if way < 0.0 { "below" } else { "above" },
        ));
    }
    if let Some(time) = first("base.x", &|x| x.abs() > FAR)? {
        doubts.push(format!(
            "The UAV drifts away sideways: it is {FAR} m from where it began at {time} s. Nothing holds it there: the autopilot \
             knows altitude and roll only, so what the arm does must leave no lasting moment.",
        ));
    }
    let speed = Quantity::DriftSpeed.measure(recording)?;
    if speed > RESTLESS {
        doubts.push(format!(
            "The UAV has not come to rest along x: in the last second it moves by {} m/s. A longer run (--stop) shows whether it \
             drifts, or swings more and more under the hand that it holds still.",
            number(speed)
        ));
    }
    Ok(doubts)
}
