//! The file of a vehicle of one's own: every value with its unit, in an order to be read.

use std::fmt::Write;

use uam::parameters::{Parameters, Structure};
use uam::scenarios::{Scenario, default_parameters};
use uam::variables::{Kind, Variable};

/// Beginnings of the names of parameters, under a heading.
const GROUPS: [(&str, &[&str]); 8] = [
    ("The UAV alone.", &["uav."]),
    (
        "The arm, from the UAV outwards. Joint 1 is at the mount; at the angle 0 link 1 hangs down, and every other link\n\
         # continues the one before. These starts are in balance: the centre of mass of what the UAV carries is below that of\n\
         # the UAV. After a change of masses or lengths, `check` says with which start it is so again.",
        &["mount.", "link[", "joint[*].start"],
    ),
    ("The counterweight, which slides along the UAV's x axis and balances the arm.", &["counterweight."]),
    (
        "Hover control of altitude and roll; nobody holds the horizontal position. These gains let both come to rest without\n\
         # swinging, at about 2 /s and 6 /s. They grow with mass and inertia of the vehicle.",
        &["autopilot."],
    ),
    (
        "How joint rates are chosen.",
        &[
            "ik.resolution",
            "ik.moment_damping",
            "ik.moment_washout",
            "joint[*].rate_limit",
            "joint[*].acceleration_limit",
        ],
    ),
    (
        "The path of the hand, from where it starts: legs that add up. A duration of 0 is no leg. A table may take their\n\
         # place: `path` above.",
        &["reference.leg["],
    ),
    (
        "No payload: set its mass and when it is grasped to have one, at a negative time if the hand holds it from the start.\n\
         # Until then it rests on the support, whose height is that of the hand then, plus mass * gravity / stiffness.",
        &["payload.", "support."],
    ),
    ("What else differs from the start values of the units.", &[]),
];

/// The text of a file that reads as this scenario.
#[must_use]
pub fn text(scenario: &Scenario, file: &str) -> String {
    let Scenario { id, title, structure, parameters, duration, step } = scenario;
    let (links, balance) = (structure.links, structure.balance.name());
    let mut text = format!(
        "\
# {title}.
# SI units, angles in radians; a number may stand with its unit, in quotes: \"30 deg\", \"5 cm\".
#   check {file}       says whether it is balanced and stable, and what looks like a mistake
#   simulate {file}    runs it
id = \"{id}\"
title = \"{title}\"
duration = {duration:?} # of the simulation [s]
step = {step:?} # between two communication points [s]
# path = \"path.csv\" # instead of the legs below, a file beside this one: time,x,y or time,x,y,vx,vy [s, m, m/s], named so in its
# first line. The hand starts at the first row, wherever that is, and runs smoothly through all.

[structure]
links = {links} # revolute, 1 to 6
balance = \"{balance}\" # none, counterweight or balance_element

[parameters]
"
    );
    let table = Parameters::table(*structure);
    let mut written = vec![false; table.variables().len()];
    for (heading, beginnings) in GROUPS {
        let mut lines = String::new();
        for beginning in beginnings {
            for (variable, written) in table.variables().iter().zip(&mut written) {
                if !*written && is_meant(&variable.name, beginning) && !is_idle_leg(&variable.name, parameters) {
                    *written = true;
                    lines += &line(variable, parameters);
                }
            }
        }
        if beginnings.is_empty() {
            lines = others(*structure, parameters, &written);
        }
        if !lines.is_empty() {
            // Writing to a text cannot fail.
            let _ = write!(text, "\n# {heading}\n{lines}");
        }
    }
    text.truncate(text.trim_end().len());
    text + "\n"
}

/// Whether a name begins like this; `[*]` stands for every index.
fn is_meant(name: &str, beginning: &str) -> bool {
    match beginning.split_once("[*]") {
        None => name.starts_with(beginning),
        Some((family, rest)) => {
            let member = name.strip_prefix(family).and_then(|name| name.strip_prefix('['));
            member.and_then(|member| member.split_once(']')).is_some_and(|(_, end)| end == rest)
        }
    }
}

/// Legs without duration need no more than that.
fn is_idle_leg(name: &str, parameters: &Parameters) -> bool {
    let legs = (1..).zip(&parameters.reference.legs);
    let mut idle = legs.filter(|(_, leg)| leg.duration == 0.0);
    idle.any(|(n, _)| name.starts_with(&format!("reference.leg[{n}].")) && !name.ends_with(".duration"))
}

/// What has another value than a file without it would have.
fn others(structure: Structure, parameters: &Parameters, written: &[bool]) -> String {
    let (table, known) = (Parameters::table(structure), default_parameters(structure));
    let left = table
        .variables()
        .iter()
        .zip(written)
        .filter(|(variable, written)| !**written && !is_idle_leg(&variable.name, parameters));
    left.filter(|(variable, _)| value(variable, parameters) != value(variable, &known))
        .map(|(variable, _)| line(variable, parameters))
        .collect()
}

fn value(variable: &Variable<Parameters>, parameters: &Parameters) -> String {
    match variable.kind {
        Kind::Real { at, .. } => format!("{:?}", at.get(parameters)),
        Kind::Boolean { at } => at.get(parameters).to_string(),
        Kind::Enumeration { at } => format!("\"{}\"", at.get(parameters).name()),
    }
}

fn line(variable: &Variable<Parameters>, parameters: &Parameters) -> String {
    // What comes after the first clause is for the pages of the FMUs.
    let (name, description) = (&variable.name, variable.description.split(';').next().unwrap_or_default());
    let meaning = match variable.kind {
        Kind::Real { unit, .. } => format!("{description} [{}]", unit.name),
        Kind::Boolean { .. } => description.to_owned(),
        Kind::Enumeration { at } => {
            let items = at.get(parameters).items().iter().map(|item| item.name);
            format!("{description}: {}", items.collect::<Vec<_>>().join(", "))
        }
    };
    // Brackets need quotes.
    let quote = if name.contains('[') { "\"" } else { "" };
    format!("{quote}{name}{quote} = {} # {meaning}\n", value(variable, parameters))
}

#[cfg(test)]
mod tests {
    use uam::parameters::Balance;

    use super::*;
    use crate::study::own_vehicle::{Choices, own_vehicle};

    /// But for legs without duration, of which nothing else counts.
    #[test]
    fn the_file_reads_as_the_vehicle() {
        for structure in Structure::all().filter(|structure| structure.balance != Balance::Element) {
            let scenario = own_vehicle(&Choices::of(structure)).unwrap();
            let mut read = Scenario::read(&text(&scenario, "vehicle.toml")).unwrap();
            let legs = read.parameters.reference.legs.iter_mut().zip(&scenario.parameters.reference.legs);
            legs.filter(|(leg, _)| leg.duration == 0.0).for_each(|(leg, own)| *leg = *own);
            assert_eq!(read, scenario, "{structure}");
        }
    }

    #[test]
    fn every_number_has_its_unit() {
        let scenario = own_vehicle(&Choices::of(Structure::new(2, Balance::Counterweight).unwrap())).unwrap();
        let text = text(&scenario, "vehicle.toml");
        let (_, parameters) = text.split_once("[parameters]").unwrap();
        for line in parameters.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
            let (_, comment) = line.split_once(" # ").unwrap();
            assert!(line.contains(" = \"") || comment.ends_with(']'), "{line}");
        }
        assert!(text.contains("payload.mass = 0.0 #") && text.contains("support.stiffness = 0.0 #"));
        assert!(text.contains("\"joint[2].start\" = ") && text.contains("counterweight.time_constant = 0.2"));
    }

    #[test]
    fn families_have_indices() {
        assert!(is_meant("joint[12].start", "joint[*].start") && is_meant("link[1].mass", "link["));
        assert!(!is_meant("joint[1].weight", "joint[*].start") && !is_meant("start", "joint[*].start"));
    }
}
