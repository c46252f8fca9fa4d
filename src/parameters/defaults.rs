//! The start values of the units: the payload pick-up of thesis chapter 4.

use std::f64::consts::PI;

use crate::autopilot::{Autopilot, AutopilotMode, Gains};
use crate::parameters::{
    Actuation, Balance, BalanceElement, BaseModel, Counterweight, Discretization, Hold, InverseKinematics, Joint, Link,
    MAX_LINKS, MomentModel, Mount, Parameters, PathAxes, Payload, Resolution, Structure, Support, Uav,
};
use crate::reference::{Circle, Leg, Profile, Reference, ReferenceInstant, ReferenceKind};

/// Duration of the payload pick-up of thesis chapter 4 \[s\].
pub const PICK_UP_DURATION: f64 = 30.0;
/// Communication step of the thesis \[s\].
pub const THESIS_STEP: f64 = 1e-3;

/// Gains "pick" of the thesis (table 4.1): altitude.
const PICK_ALTITUDE: Gains = Gains { kp: 37.0, ki: 8.0, kd: 18.0 };
/// Gains "pick" of the thesis (table 4.1): roll.
const PICK_ROLL: Gains = Gains { kp: 40.0, ki: 35.0, kd: 3.0 };

/// Length of every link of the thesis \[m\].
const LINK_LENGTH: f64 = 0.13;

/// The start values of the units: the payload pick-up of thesis 4.3 with the extended Jacobian.
///
/// An arm of two links cannot follow the path and keep moments off the UAV as well: it does the pick-up of
/// thesis 4.2, with the smallest rates. A single link only swings to the side.
#[must_use]
pub fn default_parameters(structure: Structure) -> Parameters {
    let links = structure.links;
    let (dx, dy) = match links {
        1 => (0.02, 0.0),
        2 => (0.02, -0.12),
        _ => (0.08, -0.12),
    };
    let (gravity, payload_mass, stiffness) = (9.81, 0.5, 1000.0);
    let uav_mass = match structure.balance {
        Balance::None => 4.2,
        Balance::Counterweight => 2.0,
        Balance::Element => 4.0,
    };
    let angles = start_angles(links);
    // Where the payload is taken over, its weight is carried by the support, and stays so for an instant.
    let grasp_height = dy - LINK_LENGTH * absolute(&angles[..links]).map(libm::cos).sum::<f64>();
    Parameters {
        gravity,
        uav: Uav { mass: uav_mass, inertia: 0.4097 },
        mount: Mount { x: 0.0, y: 0.0 },
        links: std::array::from_fn(|_| Link { mass: 1.0, length: LINK_LENGTH, com: 0.065, inertia: 6e-4 }),
        joints: angles.map(|start| Joint {
            start,
            rate_limit: 10.0 * PI,
            weight: 1.0,
            acceleration_limit: 1e6,
            lower: -100.0,
            upper: 100.0,
            actuation: Actuation::Rate,
        }),
        counterweight: Counterweight {
            mass: 2.2,
            inertia: 1e-4,
            height: 0.03,
            start: 0.0,
            stroke: 0.125,
            rate_limit: 5.0,
            acceleration_limit: 5.0,
            time_constant: 0.02,
        },
        balance_element: BalanceElement { mass: 0.0, com: 0.1, inertia: 0.01, start: 0.0 },
        autopilot: Autopilot { mode: AutopilotMode::Pid, altitude: PICK_ALTITUDE, roll: PICK_ROLL, sample_time: 0.0 },
        payload: Payload { mass: payload_mass, com: LINK_LENGTH, grasp_time: 1.6 },
        support: Support { stiffness, height: grasp_height + payload_mass * gravity / stiffness },
        ik: InverseKinematics {
            sample_time: THESIS_STEP,
            base_model: BaseModel::Full,
            resolution: if links > 2 { Resolution::ExtendedJacobian } else { Resolution::MinimumNorm },
            path_axes: PathAxes::Both,
            gradient_gain: -392.0,
            moment_model: MomentModel::FreeBase,
            rate_penalty: 0.0,
            moment_damping: 3.0,
            moment_washout: 0.4,
            discretization: Discretization::Exact,
            hold: Hold::ZeroOrder,
        },
        reference: Reference {
            kind: ReferenceKind::Path,
            legs: pick_up_path(dx, dy),
            circle: Circle { diameter: 0.06, duration: 4.0, start_angle: PI },
            instant: ReferenceInstant::StepStart,
            table: None,
        },
    }
}

/// There in 1.5 s; back by one fifth from 2 s to 18 s, while the support still carries, and by the other
/// four fifths from 9 s to 18 s (thesis 4.2 and appendix A.1).
fn pick_up_path(dx: f64, dy: f64) -> [Leg; 4] {
    let leg = |start, duration, ramp, share: f64| Leg {
        start,
        duration,
        ramp,
        dx: share * dx,
        dy: share * dy,
        profile: Profile::Smooth,
    };
    [leg(0.0, 1.5, 0.55, 1.0), leg(2.0, 16.0, 0.4, -0.2), leg(9.0, 9.0, 0.4, -0.8), Leg::NONE]
}

/// Joint angles in balance, with the arm's centre of mass below the first joint, and away from singular
/// configurations: those of the thesis for two and three links, a zigzag for more.
fn start_angles(links: usize) -> [f64; MAX_LINKS] {
    let mut angles = [0.0; MAX_LINKS];
    match links {
        0 | 1 => {}
        2 => angles[..2].copy_from_slice(&[-0.32, 2.228]),
        3 => angles[..3].copy_from_slice(&[-PI / 6.0, 2.0 * PI / 3.0, -2.0 * PI / 3.0]),
        _ => {
            // Absolute angles +fold, -fold, ... after the first link. Moments of equal links about the first
            // joint: (n - 1/2) sin(first) + (n - 3/2 - (n - 5/2) + ... ) sin(fold) = 0.
            let fold = 0.4 * PI;
            #[allow(clippy::cast_precision_loss)] // a few links
            let n = links as f64;
            let first = libm::asin(-libm::sin(fold) * (n - 1.0) / (2.0 * n - 1.0));
            angles[0] = first;
            angles[1] = fold - first;
            for (i, angle) in angles.iter_mut().enumerate().take(links).skip(2) {
                *angle = if i % 2 == 0 { -2.0 * fold } else { 2.0 * fold };
            }
        }
    }
    angles
}

/// Absolute angles of the links from the joint angles.
fn absolute(angles: &[f64]) -> impl Iterator<Item = f64> {
    angles.iter().scan(0.0, |sum, angle| {
        *sum += angle;
        Some(*sum)
    })
}
