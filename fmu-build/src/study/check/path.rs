//! What the wanted path asks of the arm, with the UAV where it starts.

use uam::mechanics::planar::{Vec2, vec2};
use uam::parameters::{Parameters, PathAxes, Structure};
use uam::reference::{Reference, ReferenceKind};

use super::statics::Statics;

/// Instants at which the path is looked at.
const INSTANTS: u32 = 4000;
/// The share of its length to which an arm may be stretched.
const STRETCHED: f64 = 0.98;
/// How far a path may leave the circle of a single link \[m\].
const ON_CIRCLE: f64 = 1e-3;
/// Paths shorter than this are none \[m\].
const NO_WAY: f64 = 1e-9;

/// A place on the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// Distance from the first joint \[m\].
    pub distance: f64,
    /// When \[s\].
    pub time: f64,
}

/// Something on the path that the arm cannot do.
#[derive(Debug, Clone, PartialEq)]
pub enum Obstacle {
    /// It is too far away, or too near to the first joint, for the arm.
    OutOfReach {
        /// Where.
        place: Place,
        /// Smallest and largest distance that the arm reaches without being stretched or folded up \[m\].
        within: [f64; 2],
        /// By what to multiply the ways of the path so that it is in reach; none if its beginning is not.
        factor: Option<f64>,
    },
    /// A single link moves its end on a circle only.
    OffCircle {
        /// How far the path leaves it \[m\].
        distance: f64,
        /// When \[s\].
        time: f64,
    },
    /// It is faster than the arm with all joints at their limits.
    TooFast {
        /// Largest speed \[m/s\].
        speed: f64,
        /// Largest speed that the limits allow, with a stretched arm \[m/s\].
        allowed: f64,
    },
}

/// What the path asks for.
#[derive(Debug, Clone, PartialEq)]
pub struct Demand {
    /// Place farthest from the first joint.
    pub farthest: Place,
    /// Place nearest to the first joint.
    pub nearest: Place,
    /// Largest speed \[m/s\].
    pub speed: f64,
    /// Largest acceleration \[m/s2\].
    pub acceleration: f64,
    /// What the arm cannot do.
    pub obstacles: Vec<Obstacle>,
}

impl Demand {
    /// Of the path in a run of this `duration` \[s\]; none if the end effector is to rest, or somebody else decides.
    #[must_use]
    pub fn of(structure: Structure, parameters: &Parameters, start: &Statics, duration: f64) -> Option<Self> {
        let reference = &parameters.reference;
        if reference.kind == ReferenceKind::External {
            return None;
        }
        let end = reference.end().min(duration);
        let instants = || (0..=INSTANTS).map(|n| end * f64::from(n) / f64::from(INSTANTS));
        let moves = instants().any(|t| reference.at(t).displacement.norm() > NO_WAY);
        if !moves {
            return None;
        }
        let mount = vec2(parameters.mount.x, parameters.mount.y);
        let from_mount = start.end_effector - mount;
        let place = |time: f64| Place { distance: (from_mount + reference.at(time).displacement).norm(), time };
        let largest = |of: &dyn Fn(f64) -> f64| instants().map(of).fold(0.0, f64::max);
        let speed = largest(&|t| reference.at(t).velocity.norm());
        let (mut farthest, mut nearest) = (place(0.0), place(0.0));
        for place in instants().map(place) {
            farthest = if place.distance > farthest.distance { place } else { farthest };
            nearest = if place.distance < nearest.distance { place } else { nearest };
        }
        let mut obstacles = Vec::new();
        if parameters.ik.path_axes == PathAxes::Both {
            let in_the_way = if structure.links == 1 {
                off_circle(reference, from_mount, &mut instants())
            } else {
                out_of_reach(structure, parameters, from_mount, [nearest, farthest], &mut instants())
            };
            obstacles.extend(in_the_way);
        }
        obstacles.extend(too_fast(structure, parameters, speed));
        let acceleration = largest(&|t| reference.at(t).acceleration.norm());
        Some(Self { farthest, nearest, speed, acceleration, obstacles })
    }
}

/// Distances from the first joint that an arm reaches without being stretched or folded up \[m\].
#[must_use]
pub fn workspace(lengths: &[f64]) -> [f64; 2] {
    let (sum, longest) = lengths.iter().fold((0.0, 0.0_f64), |(sum, most), &l| (sum + l, most.max(l)));
    let inner = 2.0 * longest - sum;
    [if inner > 0.0 { inner + (1.0 - STRETCHED) * sum } else { 0.0 }, STRETCHED * sum]
}

fn out_of_reach(
    structure: Structure,
    parameters: &Parameters,
    from_mount: Vec2,
    [nearest, farthest]: [Place; 2],
    instants: &mut dyn Iterator<Item = f64>,
) -> Option<Obstacle> {
    let lengths: Vec<f64> = parameters.links[..structure.links].iter().map(|link| link.length).collect();
    let within = workspace(&lengths);
    let inside = |distance: f64| within[0] <= distance && distance <= within[1];
    let place = [farthest, nearest].into_iter().find(|place| !inside(place.distance))?;
    let ways: Vec<Vec2> = instants.map(|t| parameters.reference.at(t).displacement).collect();
    let fits = |factor: f64| ways.iter().all(|way| inside((from_mount + *way * factor).norm()));
    let factor = (1..100).rev().map(|percent| 0.01 * f64::from(percent)).find(|&factor| fits(factor));
    Some(Obstacle::OutOfReach { place, within, factor })
}

fn off_circle(reference: &Reference, from_mount: Vec2, instants: &mut dyn Iterator<Item = f64>) -> Option<Obstacle> {
    let off = |t: f64| (((from_mount + reference.at(t).displacement).norm() - from_mount.norm()).abs(), t);
    let (distance, time) = instants.map(off).max_by(|(a, _), (b, _)| a.total_cmp(b))?;
    (distance > ON_CIRCLE).then_some(Obstacle::OffCircle { distance, time })
}

/// The end effector cannot be faster than a stretched arm that turns in every joint as fast as it may.
fn too_fast(structure: Structure, parameters: &Parameters, speed: f64) -> Option<Obstacle> {
    let mut outboard = 0.0;
    let allowed: f64 = (0..structure.links)
        .rev()
        .map(|i| {
            outboard += parameters.links[i].length;
            parameters.joints[i].rate_limit * outboard
        })
        .sum();
    (speed > allowed).then_some(Obstacle::TooFast { speed, allowed })
}

#[cfg(test)]
mod tests {
    use uam::parameters::Balance;
    use uam::scenarios::default_parameters;

    use super::*;

    fn demand(links: usize, change: impl Fn(&mut Parameters)) -> Option<Demand> {
        let structure = Structure::new(links, Balance::None).unwrap();
        let mut parameters = default_parameters(structure);
        change(&mut parameters);
        Demand::of(structure, &parameters, &Statics::at_start(structure, &parameters, false).unwrap(), 30.0)
    }

    #[test]
    fn what_rests_asks_for_nothing() {
        assert_eq!(demand(3, |p| p.reference.legs.iter_mut().for_each(|leg| leg.duration = 0.0)), None);
    }

    /// A leg of duration T with ramps r cruises at its way / (T - r); its raised cosine accelerates at twice the mean.
    #[test]
    fn speed_and_acceleration_of_a_leg() {
        let found = demand(3, |_| ()).unwrap();
        let cruise = 0.08_f64.hypot(0.12) / (1.5 - 0.55);
        assert!((found.speed - cruise).abs() < 1e-12, "{}", found.speed);
        assert!((found.acceleration - 2.0 * cruise / 0.55).abs() < 1e-3, "{}", found.acceleration);
        assert_eq!(found.obstacles, []);
    }

    #[test]
    fn a_path_that_leaves_the_workspace_is_to_be_shorter() {
        let far = |size: f64| move |p: &mut Parameters| p.reference.legs.iter_mut().for_each(|leg| leg.dy *= size);
        let found = demand(3, far(3.0)).unwrap().obstacles;
        let [Obstacle::OutOfReach { place, within, factor: Some(factor) }] = found[..] else { panic!("{found:?}") };
        assert!(place.distance > within[1] && (within[1] - 0.98 * 0.39).abs() < 1e-12);
        let shorter = |p: &mut Parameters| {
            far(3.0)(p);
            p.reference.legs.iter_mut().for_each(|leg| (leg.dx, leg.dy) = (leg.dx * factor, leg.dy * factor));
        };
        assert_eq!(demand(3, shorter).unwrap().obstacles, []);
    }

    #[test]
    fn workspaces_are_rings() {
        assert_eq!(workspace(&[0.5, 0.5]), [0.0, 0.98]);
        let [inner, outer] = workspace(&[0.7, 0.3]);
        assert!((inner - 0.42).abs() < 1e-12 && (outer - 0.98).abs() < 1e-12);
    }

    /// 2 cm to the side of a link of 13 cm that hangs down: hypot(13, 2) - 13 cm.
    #[test]
    fn a_single_link_cannot_follow_a_straight_line() {
        let found = demand(1, |p| p.reference.legs[0].dx = 0.05).unwrap().obstacles;
        let [Obstacle::OffCircle { distance, .. }] = found[..] else { panic!("{found:?}") };
        let farthest = 0.13_f64.hypot(0.05) - 0.13;
        assert!((distance - farthest).abs() < 1e-3, "{distance} {farthest}");
    }

    #[test]
    fn limits_of_the_rates_limit_the_speed() {
        let slow = |p: &mut Parameters| {
            p.reference.legs[1..].iter_mut().for_each(|leg| leg.duration = 0.0);
            (p.joints[0].rate_limit, p.reference.legs[0].dx) = (0.01, 0.002);
        };
        let found = demand(1, slow).unwrap().obstacles;
        let [Obstacle::TooFast { allowed, .. }] = found[..] else { panic!("{found:?}") };
        assert!((allowed - 0.01 * 0.13).abs() < 1e-15);
    }
}
