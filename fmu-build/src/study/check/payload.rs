//! Whether payload and support are where the hand is when it grasps.

use uam::parameters::{Parameters, Structure};
use uam::reference::ReferenceKind;

use super::grasps;
use super::statics::Statics;

/// A payload farther than this from the end of the last link is not in the hand \[m\].
const AT_HAND: f64 = 0.02;
/// A hand slower than this rests \[m/s\].
const AT_REST: f64 = 0.02;
/// A support with less than this between it and the payload touches \[m\].
const TOUCHING: f64 = 1e-3;
/// Forces on the payload that do not count, as shares of its weight and of that of the whole vehicle.
const SMALL_FORCE: [f64; 2] = [0.25, 0.01];

/// A payload, or a support, that does something else than lie in the hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Trap {
    /// The payload is held away from the end of the last link.
    AwayFromHand {
        /// Its distance from the last joint \[m\].
        com: f64,
        /// Length of the last link \[m\].
        length: f64,
        /// Number of the last link, from 1.
        link: usize,
    },
    /// The support pushes with another force than the payload's weight as soon as it is grasped.
    Pushes {
        /// Force of the support \[N\].
        force: f64,
        /// Weight of the payload \[N\].
        weight: f64,
        /// Height of the support with which it carries the weight \[m\].
        height: f64,
    },
    /// The support is below the payload, whose weight comes all at once.
    DoesNotTouch {
        /// Distance \[m\].
        gap: f64,
        /// Height of the support with which it carries the weight \[m\].
        height: f64,
    },
    /// The hand moves while it grasps a payload at rest.
    GraspedInMotion {
        /// Speed of the hand \[m/s\].
        speed: f64,
        /// When it grasps \[s\].
        time: f64,
        /// When it rests next \[s\].
        rest: Option<f64>,
    },
}

/// What looks wrong with payload and support in a run of this `duration` \[s\]; nothing if nothing is grasped.
#[must_use]
pub fn traps(structure: Structure, parameters: &Parameters, start: &Statics, duration: f64) -> Vec<Trap> {
    let mut traps = Vec::new();
    if !grasps(parameters, duration) {
        return traps;
    }
    let payload = &parameters.payload;
    let length = parameters.links[structure.links - 1].length;
    let away = (payload.com - length).abs() > AT_HAND;
    traps.extend(away.then_some(Trap::AwayFromHand { com: payload.com, length, link: structure.links }));
    // Where an external reference leads is not known.
    if parameters.reference.kind == ReferenceKind::External {
        return traps;
    }
    let mut time = payload.grasp_time.max(0.0);
    if payload.mass > 0.0
        && let Some(motion) = in_motion(parameters, duration)
    {
        traps.push(motion);
        // The support is judged where the hand rests.
        if let Trap::GraspedInMotion { rest: Some(rest), .. } = motion {
            time = rest;
        }
    }
    if parameters.support.stiffness > 0.0 {
        // What is held elsewhere has its own finding: the support is judged by the hand.
        let height = start.end_effector.y + parameters.reference.at(time).displacement.y;
        traps.extend(support(parameters, height, start.mass));
    }
    traps
}

fn in_motion(parameters: &Parameters, duration: f64) -> Option<Trap> {
    const STEPS: u32 = 10_000;
    let time = parameters.payload.grasp_time.max(0.0);
    let speed = |t: f64| parameters.reference.at(t).velocity.norm();
    let later = |n: u32| time + (duration - time) * f64::from(n) / f64::from(STEPS);
    (speed(time) > AT_REST).then(|| Trap::GraspedInMotion {
        speed: speed(time),
        time,
        rest: (0..=STEPS).map(later).find(|&t| speed(t) < 0.01 * AT_REST),
    })
}

/// What the support does to a payload at this `height` \[m\] in the hand of a vehicle of this `mass` \[kg\].
fn support(parameters: &Parameters, height: f64, mass: f64) -> Option<Trap> {
    let (support, gravity) = (&parameters.support, parameters.gravity);
    let weight = parameters.payload.mass * gravity;
    let carrying = height + weight / support.stiffness;
    let gap = height - support.height;
    let force = support.stiffness * (-gap).max(0.0);
    let small = SMALL_FORCE[0] * weight + SMALL_FORCE[1] * mass * gravity;
    if gap > TOUCHING && weight > small {
        Some(Trap::DoesNotTouch { gap, height: carrying })
    } else if force - weight > small {
        Some(Trap::Pushes { force, weight, height: carrying })
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use uam::scenarios::default_parameters;

    use super::*;

    fn found(change: impl Fn(&mut Parameters)) -> Vec<Trap> {
        let mut parameters = default_parameters(Structure::DEFAULT);
        change(&mut parameters);
        let start = Statics::at_start(Structure::DEFAULT, &parameters, false).unwrap();
        traps(Structure::DEFAULT, &parameters, &start, 30.0)
    }

    #[test]
    fn the_pick_up_of_the_thesis_is_in_order() {
        assert_eq!(found(|_| ()), []);
    }

    #[test]
    fn nothing_is_wrong_with_what_is_not_there() {
        let nothing = |p: &mut Parameters| (p.payload.mass, p.payload.com, p.support.stiffness) = (0.0, 5.0, 0.0);
        assert_eq!(found(nothing), []);
        assert_eq!(found(|p| (p.payload.com, p.payload.grasp_time) = (5.0, 31.0)), []);
    }

    /// 10 cm more compress a spring of 1000 N/m by 100 N more.
    #[test]
    fn a_support_that_is_too_high_pushes() {
        let before = default_parameters(Structure::DEFAULT).support.height;
        let [Trap::Pushes { force, weight, height }] = found(|p| p.support.height += 0.1)[..] else { panic!("none") };
        assert!((force - weight - 100.0).abs() < 1e-9 && (weight - 4.905).abs() < 1e-12);
        assert!((height - before).abs() < 1e-12);
        let [Trap::DoesNotTouch { gap, .. }] = found(|p| p.support.height -= 0.1)[..] else { panic!("none") };
        assert!((gap - (0.1 - 4.905e-3)).abs() < 1e-9);
    }

    #[test]
    fn what_is_held_beside_the_hand_or_grasped_in_motion_is_found() {
        assert!(matches!(found(|p| p.payload.com = 0.3)[..], [Trap::AwayFromHand { com: 0.3, length: 0.13, link: 3 }]));
        let early = found(|p| p.payload.grasp_time = 0.75);
        let [Trap::GraspedInMotion { rest: Some(rest), .. }] = early[..] else { panic!("{early:?}") };
        // The first leg ends at 1.5 s.
        assert!((1.4..1.51).contains(&rest), "{rest}");
    }
}
