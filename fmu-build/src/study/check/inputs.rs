//! Numbers that mean something else than was meant, or nothing: degrees, ignored stops, missing inputs, and what the
//! thesis' pick-up leaves to vehicles of one's own.

use std::f64::consts::TAU;

use uam::autopilot::AutopilotMode;
use uam::parameters::{Balance, Parameters, Resolution, Structure};
use uam::reference::ReferenceKind;
use uam::scenarios::default_parameters;

use super::Finding;

/// An angle of more than a turn.
#[derive(Debug, Clone, PartialEq)]
pub struct Degrees {
    /// Name of the parameter.
    pub name: String,
    /// Its value, taken for radians \[rad\].
    pub found: f64,
    /// What it would be if degrees were meant \[rad\].
    pub radians: f64,
}

/// What is to come from outside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// The wanted motion.
    Reference,
    /// Thrust and torque.
    Autopilot,
}

/// What a scenario has from the thesis' pick-up, though the vehicle is another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Inherited {
    /// Payload, with its mass \[kg\], and when it is grasped \[s\].
    Payload {
        /// The mass.
        mass: f64,
        /// When it is grasped.
        grasp_time: f64,
    },
    /// The path.
    Path,
}

/// What looks wrong with single numbers.
#[must_use]
pub fn findings(structure: Structure, parameters: &Parameters) -> Vec<Finding> {
    let mut findings = Vec::new();
    findings.extend(inherited(structure, parameters).into_iter().map(Finding::Inherited));
    findings.extend(degrees(structure, parameters).into_iter().map(Finding::Degrees));
    let stops = ignored_stops(structure, parameters);
    findings.extend((!stops.is_empty()).then_some(Finding::StopsIgnored(stops)));
    let kind = parameters.reference.kind;
    let ignored = parameters.reference.table.is_some() && kind != ReferenceKind::Table;
    findings.extend(ignored.then_some(Finding::TableIgnored(kind)));
    let reference = parameters.reference.kind == ReferenceKind::External;
    findings.extend(reference.then_some(Finding::NeedsInput(Source::Reference)));
    let autopilot = parameters.autopilot.mode == AutopilotMode::External;
    findings.extend(autopilot.then_some(Finding::NeedsInput(Source::Autopilot)));
    findings
}

fn degrees(structure: Structure, parameters: &Parameters) -> Vec<Degrees> {
    let joints = parameters.joints[..structure.links].iter().enumerate();
    let mut angles: Vec<(String, f64)> =
        joints.map(|(i, joint)| (format!("joint[{}].start", i + 1), joint.start)).collect();
    let known = default_parameters(structure);
    for (i, (joint, known)) in parameters.joints[..structure.links].iter().zip(&known.joints).enumerate() {
        let stops = [("lower", joint.lower, known.lower), ("upper", joint.upper, known.upper)];
        let given = stops.into_iter().filter(|(_, stop, known)| stop != known);
        angles.extend(given.map(|(end, stop, _)| (format!("joint[{}].{end}", i + 1), stop)));
    }
    if structure.balance == Balance::Element {
        angles.push(("balance_element.start".to_owned(), parameters.balance_element.start));
    }
    if parameters.reference.kind == ReferenceKind::Circle {
        angles.push(("reference.circle.start_angle".to_owned(), parameters.reference.circle.start_angle));
    }
    let large = angles.into_iter().filter(|(_, angle)| angle.abs() > TAU);
    large.map(|(name, found)| Degrees { name, found, radians: found.to_radians() }).collect()
}

/// The same parameters with starts of joints and of a balance element in radians where they look like degrees.
#[must_use]
pub fn in_radians(structure: Structure, parameters: &Parameters) -> Parameters {
    let mut meant = parameters.clone();
    let joints = meant.joints[..structure.links].iter_mut().map(|joint| &mut joint.start);
    for angle in joints.chain([&mut meant.balance_element.start]).filter(|angle| angle.abs() > TAU) {
        *angle = angle.to_radians();
    }
    meant
}

fn ignored_stops(structure: Structure, parameters: &Parameters) -> Vec<usize> {
    if parameters.ik.resolution == Resolution::LeastSquares {
        return Vec::new();
    }
    let known = default_parameters(structure);
    let both = parameters.joints[..structure.links].iter().zip(&known.joints).enumerate();
    let given = both.filter(|(_, (joint, known))| (joint.lower, joint.upper) != (known.lower, known.upper));
    given.map(|(i, _)| i + 1).collect()
}

fn inherited(structure: Structure, parameters: &Parameters) -> Vec<Inherited> {
    let known = default_parameters(structure);
    let same_vehicle = parameters.uav == known.uav
        && parameters.mount == known.mount
        && parameters.links[..structure.links] == known.links[..structure.links];
    if same_vehicle {
        return Vec::new();
    }
    let payload = &parameters.payload;
    let same_payload = payload.mass == known.payload.mass && payload.grasp_time == known.payload.grasp_time;
    let same_path = parameters.reference.kind == ReferenceKind::Path && parameters.reference == known.reference;
    let mut inherited = Vec::new();
    inherited.extend(same_payload.then_some(Inherited::Payload { mass: payload.mass, grasp_time: payload.grasp_time }));
    inherited.extend(same_path.then_some(Inherited::Path));
    inherited
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(change: impl Fn(&mut Parameters)) -> Vec<Finding> {
        let mut parameters = default_parameters(Structure::DEFAULT);
        change(&mut parameters);
        findings(Structure::DEFAULT, &parameters)
    }

    #[test]
    fn the_vehicle_of_the_thesis_may_do_what_the_thesis_does() {
        assert_eq!(found(|_| ()), []);
    }

    #[test]
    fn another_vehicle_does_not_ask_for_the_payload_and_the_path_of_the_thesis() {
        let payload = Inherited::Payload { mass: 0.5, grasp_time: 1.6 };
        assert_eq!(found(|p| p.uav.mass = 3.0), [Finding::Inherited(payload), Finding::Inherited(Inherited::Path)]);
        let own = |p: &mut Parameters| (p.uav.mass, p.payload.mass, p.reference.legs[0].dx) = (3.0, 0.0, 0.05);
        assert_eq!(found(own), []);
    }

    #[test]
    fn angles_of_more_than_a_turn_are_degrees() {
        let [Finding::Degrees(degrees)] = &found(|p| p.joints[1].start = 120.0)[..] else { panic!("no degrees") };
        assert_eq!(degrees.name, "joint[2].start");
        assert!((degrees.radians - TAU / 3.0).abs() < 1e-15);
        let mut parameters = default_parameters(Structure::DEFAULT);
        parameters.joints[1].start = degrees.found;
        assert_eq!(in_radians(Structure::DEFAULT, &parameters).joints[1].start, degrees.radians);
    }

    #[test]
    fn stops_are_for_least_squares_and_inputs_for_hosts() {
        assert_eq!(found(|p| p.joints[2].upper = 2.0), [Finding::StopsIgnored(vec![3])]);
        let with_stops = |p: &mut Parameters| {
            p.joints[2].upper = 2.0;
            p.ik.resolution = Resolution::LeastSquares;
        };
        assert_eq!(found(with_stops), []);
        assert_eq!(found(|p| p.reference.kind = ReferenceKind::External), [Finding::NeedsInput(Source::Reference)]);
        assert_eq!(found(|p| p.autopilot.mode = AutopilotMode::External), [Finding::NeedsInput(Source::Autopilot)]);
    }
}
