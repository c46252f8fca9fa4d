//! What looks wrong in a run, whether or not the path was followed.

use std::f64::consts::{FRAC_PI_4, TAU};

use uam::autopilot::AutopilotMode;
use uam::parameters::Actuation;
use uam::reference::ReferenceKind;

use super::number;
use crate::host::record::NotRecorded;
use crate::host::run::Run;

/// Beyond this roll a multicopter does not hover any more \[rad\].
const STEEP: f64 = FRAC_PI_4;

/// A hovering UAV that is farther than this from where it began is not held there \[m\].
const FAR: f64 = 1.0;

/// A support that pushes with more than this many times the payload's weight does not carry it, but throws it up.
const PUSH: f64 = 2.0;

/// A sentence for each thing that looks wrong, the gravest first.
pub(super) fn of(run: &Run) -> Result<Vec<String>, NotRecorded> {
    let mut doubts = undriven(run);
    doubts.extend(degrees(run));
    doubts.extend(support(run)?);
    doubts.extend(flight(run)?);
    Ok(doubts)
}

/// Inputs that a scenario expects somebody to drive: here nobody does.
fn undriven(run: &Run) -> Vec<String> {
    let (structure, parameters) = (run.scenario.structure, &run.scenario.parameters);
    let mut doubts = Vec::new();
    if parameters.autopilot.mode == AutopilotMode::External {
        doubts.push(
            "Nobody flies the UAV: autopilot.mode is external, and the inputs autopilot.thrust_command and .torque_command \
             stay 0. Choose pid or ideal, or couple an autopilot to the plant in a host."
                .to_owned(),
        );
    }
    if parameters.reference.kind == ReferenceKind::External {
        doubts.push(
            "Nobody gives a path: reference.kind is external, and the inputs external_reference.* stay 0. Choose path or \
             circle, or drive them in a host."
                .to_owned(),
        );
    }
    for (i, joint) in parameters.joints.iter().enumerate().take(structure.links) {
        if joint.actuation == Actuation::Torque {
            let n = i + 1;
            doubts.push(format!(
                "Joint {n} turns freely: joint[{n}].actuation is torque, and the input joint[{n}].torque_command stays 0."
            ));
        }
    }
    doubts
}

/// Angles that look like degrees.
fn degrees(run: &Run) -> Vec<String> {
    let (structure, parameters) = (run.scenario.structure, &run.scenario.parameters);
    let joints = parameters.joints.iter().enumerate().take(structure.links);
    joints
        .filter(|(_, joint)| joint.start.abs() > TAU)
        .map(|(i, joint)| {
            let (n, start) = (i + 1, joint.start);
            format!(
                "Joint {n} starts at {start} rad, more than a full turn. If these are degrees: joint[{n}].start = {:.6}.",
                start.to_radians()
            )
        })
        .collect()
}

/// A payload that is grasped where the support does not carry it.
fn support(run: &Run) -> Result<Option<String>, NotRecorded> {
    let (payload, support) = (&run.scenario.parameters.payload, &run.scenario.parameters.support);
    let weight = payload.mass * run.scenario.parameters.gravity;
    if weight == 0.0 || support.stiffness == 0.0 {
        return Ok(None);
    }
    let attached = run.recording.column("payload.attached")?;
    let Some(grasp) = attached.iter().position(|attached| *attached != 0.0).filter(|grasp| *grasp > 0) else {
        return Ok(None);
    };
    let force = run.recording.column("support.force")?[grasp];
    let time = number(run.recording.times()[grasp]);
    let says = if force > PUSH * weight {
        format!("the support pushes it up with {} N", number(force))
    } else if force == 0.0 {
        "the support is below it and carries nothing".to_owned()
    } else {
        return Ok(None);
    };
    Ok(Some(format!(
        "At {time} s a payload of {} N is grasped while {says}: support.height does not go together with where the hand \
         grasps. For a vehicle without payload set payload.mass and support.stiffness to 0.",
        number(weight)
    )))
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
    Ok(doubts)
}
