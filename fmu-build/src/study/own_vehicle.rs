//! A vehicle of one's own to begin with: level at the start, stable, and with a small motion that it can do.

use uam::autopilot::Gains;
use uam::parameters::{Balance, Link, MAX_LINKS, Parameters, Resolution, Structure};
use uam::reference::{Leg, Profile};
use uam::scenarios::{Scenario, default_parameters};

use crate::study::check::arm::{smallest_singular_value, smallest_singular_value_with_moment};
use crate::study::check::balance::balancing_turn;
use crate::study::check::hover::Control;
use crate::study::check::statics::Statics;

/// What of a vehicle is chosen; all else follows.
#[derive(Debug, Clone, PartialEq)]
pub struct Choices {
    /// Name of the scenario.
    pub id: String,
    /// Links and what balances them.
    pub structure: Structure,
    /// Mass of the UAV alone \[kg\].
    pub mass: f64,
    /// Roll inertia of the UAV alone \[kg m2\]; none: that of its mass at [`GYRATION`].
    pub inertia: Option<f64>,
    /// Length of every link \[m\].
    pub link_length: f64,
    /// Mass of every link \[kg\].
    pub link_mass: f64,
    /// Mass of the counterweight, if there is one \[kg\].
    pub counterweight_mass: f64,
}

impl Choices {
    /// The vehicle of this structure if nothing else is chosen.
    #[must_use]
    pub fn of(structure: Structure) -> Self {
        Self {
            id: "vehicle".to_owned(),
            structure,
            mass: 3.0,
            inertia: None,
            link_length: 0.2,
            link_mass: 0.2,
            counterweight_mass: 0.5,
        }
    }
}

/// Radius of gyration of a UAV of which only the mass is known \[m\].
pub const GYRATION: f64 = 0.2;
/// How long the simulation takes \[s\].
const DURATION: f64 = 10.0;
/// Duration of the way there and of the way back \[s\].
const LEG: f64 = 4.0;
/// Where the balanced arm is looked for: absolute angles of the links by turns to the right and to the left \[deg\].
const FOLDS: std::ops::RangeInclusive<u32> = 30..=100;

/// No start in balance was found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// Parameters that cannot be.
    #[error(transparent)]
    Parameters(#[from] uam::Error),
    /// The arm cannot be balanced.
    #[error(
        "no balanced start was found for {structure}: expected links that can hang to both sides of the first joint, \
         found links of {link_mass} kg and {link_length} m; choose others"
    )]
    NoBalance {
        /// The structure.
        structure: Structure,
        /// Mass of each link \[kg\].
        link_mass: f64,
        /// Length of each link \[m\].
        link_length: f64,
    },
}

/// The scenario of such a vehicle: no payload, no support, an arm in balance.
///
/// # Errors
/// If a number is out of its bounds, or no balanced start is found.
pub fn own_vehicle(choices: &Choices) -> Result<Scenario, Error> {
    let structure = choices.structure;
    let mut parameters = default_parameters(structure);
    set_bodies(choices, &mut parameters);
    // Before anything is divided by them.
    parameters.check(structure)?;
    // Neither payload nor support; the payload's place is that of the hand, should it get a mass.
    parameters.payload.mass = 0.0;
    parameters.payload.com = choices.link_length;
    parameters.payload.grasp_time = 1e9;
    parameters.support.stiffness = 0.0;
    parameters.support.height = 0.0;
    set_start(choices, &mut parameters)?;
    set_method(choices, &mut parameters);
    let start = Statics::at_start(structure, &parameters, false)?;
    parameters.autopilot.altitude = rounded(Control::Altitude, start.mass);
    parameters.autopilot.roll = rounded(Control::Roll, start.inertia);
    set_path(choices, &mut parameters);
    parameters.check(structure)?;
    let motion = if structure.links == 1 { "at rest" } else { "a small motion there and back" };
    let title = format!("Own vehicle: {structure}, no payload, {motion}");
    Ok(Scenario { id: choices.id.clone(), title, structure, parameters, duration: DURATION, step: 1e-3 })
}

fn set_bodies(choices: &Choices, parameters: &mut Parameters) {
    let &Choices { mass, inertia, link_length: length, link_mass, counterweight_mass, .. } = choices;
    parameters.uav.mass = mass;
    parameters.uav.inertia = inertia.unwrap_or(three_digits(mass * GYRATION * GYRATION));
    // Slender rods.
    let inertia = three_digits(link_mass * length * length / 12.0);
    let link = Link { mass: link_mass, length, com: 0.5 * length, inertia };
    parameters.links[..choices.structure.links].fill(link);
    if choices.structure.balance == Balance::Counterweight {
        let counterweight = &mut parameters.counterweight;
        counterweight.mass = counterweight_mass;
        counterweight.height = 0.03;
        counterweight.start = 0.0;
        counterweight.stroke = 0.12;
        counterweight.rate_limit = 0.5;
        counterweight.acceleration_limit = 5.0;
        // Short ones make it chatter.
        counterweight.time_constant = 0.2;
    }
}

/// The counterweight is moved by least squares alone; a moment can be kept off the UAV with three links or more.
fn set_method(choices: &Choices, parameters: &mut Parameters) {
    parameters.ik.resolution = match (choices.structure.balance, choices.structure.links) {
        (Balance::Counterweight, _) => Resolution::LeastSquares,
        (_, 1 | 2) => Resolution::MinimumNorm,
        _ => Resolution::ExtendedJacobian,
    };
    for joint in &mut parameters.joints[..choices.structure.links] {
        joint.rate_limit = 6.0;
        joint.acceleration_limit = 60.0;
    }
}

/// A tenth of a link's length down and back; a single link cannot, and rests.
fn set_path(choices: &Choices, parameters: &mut Parameters) {
    let way = if choices.structure.links == 1 { 0.0 } else { three_digits(0.1 * choices.link_length) };
    let leg = |start, dy| Leg { start, duration: LEG, ramp: 1.0, dx: 0.0, dy, profile: Profile::Smooth };
    parameters.reference.legs = [leg(0.0, 0.0 - way), leg(LEG, way), Leg::NONE, Leg::NONE];
}

/// A zigzag, of which the first link brings the balance: of all folds the one that is farthest from singular.
fn set_start(choices: &Choices, parameters: &mut Parameters) -> Result<(), Error> {
    let structure = choices.structure;
    let mut best: Option<(f64, [f64; MAX_LINKS])> = None;
    // A single link has nothing to fold.
    let folds = if structure.links == 1 { 0..=0 } else { FOLDS };
    for fold in folds {
        let mut angles = zigzag(structure.links, f64::from(fold).to_radians());
        take(&angles, parameters);
        let start = Statics::at_start(structure, parameters, false)?;
        // Only the first link turns, with all masses outboard at its end; the others keep their directions.
        let own = start.outboard[0] - start.outboard.get(1).copied().unwrap_or_default();
        let Some(turn) = balancing_turn([own.x, own.y], start.first.x - own.x) else { continue };
        angles[0] += turn;
        if structure.links > 1 {
            angles[1] -= turn;
        }
        let angles = angles.map(|angle| (1e6 * angle).round() / 1e6);
        take(&angles, parameters);
        let there = Statics::at_start(structure, parameters, false)?;
        // The hand below the UAV, not beside or above it.
        let hangs = there.end_effector.y < parameters.mount.y - 0.5 * choices.link_length;
        let margin = margin(&there);
        if hangs && best.is_none_or(|(most, _)| margin > most) {
            best = Some((margin, angles));
        }
    }
    let (link_mass, link_length) = (choices.link_mass, choices.link_length);
    let (_, angles) = best.ok_or(Error::NoBalance { structure, link_mass, link_length })?;
    take(&angles, parameters);
    Ok(())
}

/// How far from singular an arm is, with the moment on the UAV as a third task if it has joints enough \[m\].
fn margin(there: &Statics) -> f64 {
    let alone = smallest_singular_value(&there.jacobian);
    smallest_singular_value_with_moment(there).map_or(alone, |both| both.min(alone))
}

/// Joint angles of links at the absolute angles 0, `fold`, -`fold`, `fold` and so on \[rad\].
fn zigzag(links: usize, fold: f64) -> [f64; MAX_LINKS] {
    let mut angles = [0.0; MAX_LINKS];
    for (i, angle) in angles.iter_mut().enumerate().take(links).skip(1) {
        let step = if i == 1 { fold } else { 2.0 * fold };
        *angle = if i % 2 == 1 { step } else { -step };
    }
    angles
}

fn take(angles: &[f64; MAX_LINKS], parameters: &mut Parameters) {
    for (joint, angle) in parameters.joints.iter_mut().zip(angles) {
        joint.start = *angle;
    }
}

fn rounded(control: Control, inertia: f64) -> Gains {
    let Gains { kp, ki, kd } = control.recommended(inertia);
    Gains { kp: three_digits(kp), ki: three_digits(ki), kd: three_digits(kd) }
}

/// A number as people write it; 0 stays, and so does what is no number.
#[must_use]
pub fn three_digits(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::check::{Drift, check};

    /// Every vehicle that `init` writes without further wishes.
    fn all() -> impl Iterator<Item = Choices> {
        let structures = Structure::all().filter(|structure| structure.balance != Balance::Element);
        structures.map(Choices::of)
    }

    #[test]
    fn every_vehicle_begins_in_balance_and_without_findings() {
        for choices in all() {
            let scenario = own_vehicle(&choices).unwrap();
            let report = check(&scenario).unwrap();
            assert_eq!(report.findings, [], "{}", choices.structure);
            assert!(report.imbalance.moment.abs() < 1e-4, "{}: {:?}", choices.structure, report.imbalance);
            assert!(matches!(report.imbalance.drift, Drift::Speed(v) if v.abs() < 1e-3));
            let straight = report.smallest_singular_value < 0.2 * choices.link_length;
            assert!(!straight, "{}: {}", choices.structure, report.smallest_singular_value);
        }
    }

    #[test]
    fn a_single_link_hangs_down() {
        let choices = Choices::of(Structure::new(1, Balance::None).unwrap());
        assert_eq!(own_vehicle(&choices).unwrap().parameters.joints[0].start, 0.0);
    }

    #[test]
    fn numbers_that_cannot_be_are_refused_by_name() {
        for (choices, name) in [
            (Choices { mass: -1.0, ..Choices::of(Structure::DEFAULT) }, "uav.mass must be"),
            (Choices { link_length: 0.0, ..Choices::of(Structure::DEFAULT) }, "link[1].length must be"),
            (Choices { inertia: Some(f64::NAN), ..Choices::of(Structure::DEFAULT) }, "uav.inertia must be"),
        ] {
            let refused = own_vehicle(&choices).unwrap_err().to_string();
            assert!(refused.starts_with(name), "{refused}");
        }
    }

    #[test]
    fn three_digits_are_kept() {
        for (value, expected) in [(0.0123456, 0.0123), (98765.0, 98800.0), (0.0, 0.0), (-1.0 / 3.0, -0.333)] {
            assert_eq!(three_digits(value), expected);
        }
    }
}
