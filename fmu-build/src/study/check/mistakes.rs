//! What looks wrong, in sentences, and what to change.

use crate::study::check::hover::{Control, Remedy};
use crate::study::check::{Bend, Degrees, Finding, Inherited, Instability, Obstacle, Report, Source, Trap};
use crate::study::own_vehicle::three_digits;
use uam::autopilot::Gains;
use uam::scenarios::Scenario;
use uam::variables::options::Choice;

use super::facts;

/// A finding in words.
pub struct Sentence {
    /// What is wrong.
    pub what: String,
    /// Which parameter to set to which value.
    pub change: String,
}

/// A finding in words; `report` has the numbers that belong to it.
pub fn sentence(finding: &Finding, scenario: &Scenario, report: &Report) -> Sentence {
    match finding {
        Finding::Unbalanced => unbalanced(scenario, report),
        Finding::Singular(bend) => singular(bend),
        Finding::Degrees(degrees) => in_degrees(degrees),
        Finding::StopsIgnored(joints) => stops(joints, scenario),
        Finding::BeyondStop { name, found, nearest } => Sentence {
            what: format!(
                "The start {name} = {found} is beyond the stop at {nearest}: the first thing it does is to come back."
            ),
            change: format!("{} = {nearest:?} or further inside, or the stop.", quoted(name)),
        },
        Finding::TableIgnored(kind) => Sentence {
            what: format!(
                "`path` gives a table, but nobody follows it: reference.kind = \"{}\" says otherwise.",
                kind.name()
            ),
            change: "reference.kind = \"table\", or leave that line out.".to_owned(),
        },
        Finding::NeedsInput(source) => needs_input(*source),
        Finding::Inherited(inherited) => inherits(*inherited),
        Finding::Payload(trap) => payload(trap),
        Finding::Path(obstacle) => path(obstacle),
        Finding::Unstable(instability) => unstable(instability),
    }
}

/// A name as scenario files have it: brackets need quotes.
fn quoted(name: &str) -> String {
    if name.contains('[') { format!("\"{name}\"") } else { name.to_owned() }
}

fn unbalanced(scenario: &Scenario, report: &Report) -> Sentence {
    let imbalance = &report.imbalance;
    let what = format!(
        "The start is not balanced: what the UAV carries gives a moment of {:?} N m about the UAV's centre of mass{}. {}",
        three_digits(imbalance.moment),
        imbalance.roll.map_or_else(String::new, |roll| format!(
            ", which rolls the UAV by up to {:.1} degrees",
            roll.to_degrees()
        )),
        facts::drift(imbalance, scenario.parameters.ik.resolution),
    );
    let mut changes: Vec<String> = Vec::new();
    if let Some((place, true)) = imbalance.counterweight {
        changes.push(format!("counterweight.start = {place:.4} (m)"));
    }
    if let Some(angle) = imbalance.element {
        changes.push(format!("balance_element.start = {angle:.4} (rad)"));
    }
    changes.extend(imbalance.joints.iter().map(|(n, angle)| format!("\"joint[{n}].start\" = {angle:.4} (rad)")));
    let change = if changes.is_empty() {
        "no start of a single joint balances it: start from what `init` writes, or move the first joint with mount.x."
            .to_owned()
    } else {
        format!("one of these alone would balance it: {}.", changes.join(", or "))
    };
    Sentence { what, change }
}

fn singular(bend: &Bend) -> Sentence {
    let Bend { found, least, joint, start } = bend;
    Sentence {
        what: format!(
            "The arm starts as good as stretched or folded up: the smallest singular value of the end effector's Jacobian is \
             {found:.4} m, and should be {least:.4} m at least. Small motions of the hand along one direction take large joint rates."
        ),
        change: format!("\"joint[{joint}].start\" = {start:.4} (rad), for instance, and look at the balance again."),
    }
}

fn in_degrees(Degrees { name, found, radians }: &Degrees) -> Sentence {
    Sentence {
        what: format!("{name} = {found} is more than a turn: angles are in radians, this looks like degrees."),
        change: format!("{} = {radians:.4}, or \"{found} deg\", if degrees are meant.", quoted(name)),
    }
}

fn stops(joints: &[usize], scenario: &Scenario) -> Sentence {
    let names: Vec<String> = joints.iter().map(|n| format!("joint[{n}].lower or .upper")).collect();
    let method = scenario.parameters.ik.resolution.name();
    Sentence {
        what: format!("{} are given, but the resolution {method} knows no stops: joints pass them.", names.join(", ")),
        change: "ik.resolution = \"least_squares\", or leave the stops out.".to_owned(),
    }
}

fn needs_input(source: Source) -> Sentence {
    let [name, inputs, consequence, instead] = match source {
        Source::Reference => [
            "reference.kind",
            "external_reference.x, .y and their derivatives",
            "the hand follows values that stay 0",
            "\"path\" or \"circle\"",
        ],
        Source::Autopilot => [
            "autopilot.mode",
            "autopilot.thrust_command and .torque_command",
            "the UAV has no thrust and falls",
            "\"pid\"",
        ],
    };
    Sentence {
        what: format!(
            "{name} = \"external\" takes the inputs {inputs} from another unit; the commands of this program give none: {consequence}."
        ),
        change: format!("{name} = {instead} here, or connect these inputs in a host of your own."),
    }
}

fn inherits(inherited: Inherited) -> Sentence {
    match inherited {
        Inherited::Payload { mass, grasp_time } => Sentence {
            what: format!(
                "The vehicle is not that of the thesis, but it grasps the payload of the thesis' pick-up, {mass} kg after \
                 {grasp_time} s, for no line says otherwise: payload.mass and payload.grasp_time have the start values of the units."
            ),
            change: format!(
                "payload.mass = 0.0 and support.stiffness = 0.0 for none; payload.mass = {mass:?} as a line of its own if it is meant."
            ),
        },
        Inherited::Path => Sentence {
            what: "The vehicle is not that of the thesis, but it follows the path of the thesis' pick-up, for no line says \
                   otherwise: reference.leg[1] to [3] have the start values of the units."
                .to_owned(),
            change: "\"reference.leg[1].dx\", .dy, .duration and those of [2] and [3], with duration = 0.0 for a leg that is not wanted."
                .to_owned(),
        },
    }
}

fn payload(trap: &Trap) -> Sentence {
    match trap {
        Trap::AwayFromHand { com, length, link } => Sentence {
            what: format!(
                "The payload is held {:.0} mm away from the hand: payload.com = {com} m from the last joint, where the last link is {length} m long.",
                1000.0 * (com - length).abs()
            ),
            change: format!("payload.com = {length:?}, the length of link {link} (m)."),
        },
        Trap::Pushes { force, weight, height } => Sentence {
            what: format!(
                "The support pushes the payload with {force:.1} N as soon as it is grasped, which weighs {weight:.1} N: \
                 support.height is too high, and the UAV is catapulted."
            ),
            change: format!(
                "support.height = {height:.5} (m), where it carries the weight, or support.stiffness = 0.0 for none."
            ),
        },
        Trap::DoesNotTouch { gap, height } => Sentence {
            what: format!(
                "The support ends {:.0} mm below the payload when it is grasped: it carries nothing, and the whole weight comes at once.",
                1000.0 * gap
            ),
            change: format!(
                "support.height = {height:.5} (m), where it carries the weight, or support.stiffness = 0.0 for none."
            ),
        },
        Trap::GraspedInMotion { speed, time, rest } => Sentence {
            what: format!(
                "The hand moves at {speed:.3} m/s when it grasps the resting payload at {time} s: velocities jump."
            ),
            change: rest.map_or_else(
                || "reference.leg[*] so that the hand rests at payload.grasp_time.".to_owned(),
                |rest| format!("payload.grasp_time = {:.2} (s), when the hand rests.", (100.0 * rest).ceil() / 100.0),
            ),
        },
    }
}

fn path(obstacle: &Obstacle) -> Sentence {
    match obstacle {
        Obstacle::OutOfReach { place, within: [inner, outer], factor } => Sentence {
            what: format!(
                "The path leads {:.3} m away from the first joint at {:.2} s; without being stretched or folded up the arm \
                 reaches {inner:.3} to {outer:.3} m.",
                place.distance, place.time
            ),
            change: factor.map_or_else(
                || "\"joint[...].start\" first: the path begins out of reach, or nearly so.".to_owned(),
                |factor| format!(
                    "reference.leg[*].dx and .dy (or reference.circle.diameter, or the places in path) to {factor:.2} of what \
                     they are, or longer links."
                ),
            ),
        },
        Obstacle::OffCircle { distance, time } => Sentence {
            what: format!(
                "A single link moves its end on a circle; the path leaves that by {:.1} mm at {time:.2} s.",
                1000.0 * distance
            ),
            change: "reference.leg[*].duration = 0.0 for rest, or more links.".to_owned(),
        },
        Obstacle::TooFast { speed, allowed } => Sentence {
            what: format!("The path takes {speed:.2} m/s; with all joints at joint[*].rate_limit the hand reaches {allowed:.2} m/s at most."),
            change: format!("durations of the path at least {:.1} times as long, or higher rate limits.", speed / allowed),
        },
    }
}

fn unstable(instability: &Instability) -> Sentence {
    let Instability { control, held, mode, remedy } = instability;
    let name = match control {
        Control::Altitude => "altitude",
        Control::Roll => "roll",
    };
    let when = if *held { " once the payload is held" } else { "" };
    let how = match mode {
        Some(mode) if mode.decay < -1e-9 => {
            format!("a motion at {:.2} rad/s grows with the time constant {:.2} s", mode.frequency, -1.0 / mode.decay)
        }
        Some(_) => "there is a motion that does not die out".to_owned(),
        None => "its gains are too large to tell".to_owned(),
    };
    let sampled = |time: f64| format!("autopilot.sample_time = {:?} (s)", three_digits(time));
    let change = match remedy {
        Remedy::SampleTime(time) => format!("{} or less.", sampled(*time)),
        Remedy::Gains { gains: Gains { kp, ki, kd }, sample_time } => format!(
            "autopilot.{name}.kp = {:?}, autopilot.{name}.ki = {:?}, autopilot.{name}.kd = {:?}{}.",
            three_digits(*kp),
            three_digits(*ki),
            three_digits(*kd),
            sample_time.map_or_else(String::new, |time| format!(", with {}", sampled(time)))
        ),
    };
    Sentence { what: format!("The {name} does not come to rest{when}: {how}."), change }
}
