//! Whether what the UAV carries hangs below its centre of mass, and what happens if it does not.
//!
//! In hover, thrust and weights act on the vehicle. Its roll answers to the moment m of the weights about the UAV's centre of
//! mass as to a torque: I roll'' = m - kd roll' - kp roll - ki int(roll). The tilted thrust accelerates the
//! vehicle by -g roll, and nobody holds its horizontal position. With an integral gain the roll comes back to 0 and has
//! then had the integral m / ki: what is left is the speed -g m / ki. Without, the roll stays at m / kp.
//!
//! That is so while the joints rest. A controller that keeps the hand in place leans the arm below a UAV that drifts, and
//! one that keeps moments away swings the arm into balance: both usually bring the UAV to rest, away from where it was.
//! Roll and speed are how it begins, and bounds.

use std::f64::consts::PI;

use uam::autopilot::{AutopilotMode, Gains};
use uam::parameters::{Balance, Parameters, Structure};

use super::arm::{SINGULAR, smallest_singular_value};
use super::hover::peak_roll;
use super::statics::Statics;

/// A roll that counts \[rad\]: a third of a degree.
const LARGE_ROLL: f64 = PI / 540.0;
/// A drift that counts \[m/s\].
const FAST_DRIFT: f64 = 0.02;
/// The same, where the roll stays \[m/s2\].
const STEEP_DRIFT: f64 = 0.002;

/// What the UAV does in the end if its joints rest, linearized about hover.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drift {
    /// An autopilot that holds the roll whatever comes.
    Held,
    /// It goes on at this speed, positive to the right \[m/s\].
    Speed(f64),
    /// It goes on with this acceleration, positive to the right \[m/s2\].
    Acceleration(f64),
    /// It tumbles: there is nothing that brings the roll back.
    Tumbles,
    /// Somebody else controls it.
    Unknown,
}

/// How far what the UAV carries is from balance at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Imbalance {
    /// Moment of its weight about the UAV's centre of mass, counter-clockwise \[N m\].
    pub moment: f64,
    /// How far its centre of mass, if anything is carried, is to the right of the UAV's, times its mass \[kg m\].
    pub first_moment: f64,
    /// Largest roll that follows \[rad\], if the hover is stable.
    pub roll: Option<f64>,
    /// What follows in the end.
    pub drift: Drift,
    /// Starts of single joints that would balance it, all others as they are: number of the joint from 1, angle \[rad\].
    pub joints: Vec<(usize, f64)>,
    /// Start of the counterweight that would balance it \[m\], and whether its stroke allows for that.
    pub counterweight: Option<(f64, bool)>,
    /// Start of the balance element that would balance it \[rad\].
    pub element: Option<f64>,
}

impl Imbalance {
    /// At the start.
    #[must_use]
    pub fn of(structure: Structure, parameters: &Parameters, start: &Statics) -> Self {
        let moment = -parameters.gravity * start.first.x;
        let gains = &parameters.autopilot.roll;
        let (roll, drift) = match parameters.autopilot.mode {
            AutopilotMode::Ideal => (Some(0.0), Drift::Held),
            AutopilotMode::External => (None, Drift::Unknown),
            AutopilotMode::Pid => {
                let roll = peak_roll(gains, start.inertia).map(|peak| peak * moment.abs());
                (roll, drift(gains, moment, parameters.gravity))
            }
        };
        Self {
            moment,
            first_moment: start.first.x,
            roll,
            drift,
            joints: balanced_joints(structure, parameters, start),
            counterweight: balanced_counterweight(structure, parameters, start),
            element: balanced_element(structure, parameters, start),
        }
    }

    /// Whether it moves the UAV noticeably.
    #[must_use]
    pub fn matters(&self) -> bool {
        match self.drift {
            Drift::Held | Drift::Unknown => false,
            Drift::Tumbles => self.moment != 0.0,
            Drift::Speed(v) => v.abs() > FAST_DRIFT || self.roll.is_some_and(|roll| roll > LARGE_ROLL),
            Drift::Acceleration(a) => a.abs() > STEEP_DRIFT || self.roll.is_some_and(|roll| roll > LARGE_ROLL),
        }
    }
}

/// What a `moment` \[N m\] leads to under these `gains` of the roll control, if they are stable.
#[must_use]
pub fn drift(gains: &Gains, moment: f64, gravity: f64) -> Drift {
    if gains.ki > 0.0 {
        Drift::Speed(-gravity * moment / gains.ki)
    } else if gains.kp > 0.0 {
        Drift::Acceleration(-gravity * moment / gains.kp)
    } else {
        Drift::Tumbles
    }
}

/// The smaller of the two turns of a body about its joint \[rad\] with which its first moment `outboard` \[kg m\] points to the
/// left as far as `rest` \[kg m\] points to the right; none if the body is too light.
#[must_use]
pub fn balancing_turn(outboard: [f64; 2], rest: f64) -> Option<f64> {
    let [x, y] = outboard;
    let size = x.hypot(y);
    let share = -rest / size;
    // Without mass it is no number.
    if share.is_nan() || share.abs() > 1.0 {
        return None;
    }
    // The turned moment is size cos(turn + angle).
    let (angle, opening) = (y.atan2(x), share.acos());
    [opening - angle, -opening - angle].map(wrapped).into_iter().min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// An angle between -pi and pi \[rad\].
fn wrapped(angle: f64) -> f64 {
    let turned = angle.rem_euclid(2.0 * PI);
    if turned > PI { turned - 2.0 * PI } else { turned }
}

/// Joints that alone can bring balance without stretching the arm, the one that has to turn least first.
fn balanced_joints(structure: Structure, parameters: &Parameters, start: &Statics) -> Vec<(usize, f64)> {
    let reach: f64 = parameters.links[..structure.links].iter().map(|link| link.length).sum();
    let mut found = Vec::new();
    for (i, outboard) in start.outboard.iter().enumerate() {
        let Some(turn) = balancing_turn([outboard.x, outboard.y], start.first.x - outboard.x) else { continue };
        let mut balanced = parameters.clone();
        balanced.joints[i].start += turn;
        let held = parameters.payload.grasp_time <= 0.0;
        let bent = Statics::at_start(structure, &balanced, held)
            .is_ok_and(|there| smallest_singular_value(&there.jacobian) > SINGULAR * reach);
        if bent {
            found.push((turn.abs(), (i + 1, balanced.joints[i].start)));
        }
    }
    found.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    found.into_iter().map(|(_, joint)| joint).collect()
}

fn balanced_counterweight(structure: Structure, parameters: &Parameters, start: &Statics) -> Option<(f64, bool)> {
    let counterweight = &parameters.counterweight;
    if structure.balance != Balance::Counterweight || counterweight.mass <= 0.0 {
        return None;
    }
    let place = counterweight.start - start.first.x / counterweight.mass;
    Some((place, place.abs() <= counterweight.stroke))
}

fn balanced_element(structure: Structure, parameters: &Parameters, start: &Statics) -> Option<f64> {
    let element = &parameters.balance_element;
    if structure.balance != Balance::Element {
        return None;
    }
    let (sin, cos) = element.start.sin_cos();
    let first = [element.mass * element.com * sin, -element.mass * element.com * cos];
    balancing_turn(first, start.first.x - first[0]).map(|turn| element.start + turn)
}

#[cfg(test)]
mod tests {
    use super::*;
    use uam::scenarios::default_parameters;

    fn one_link(angle: f64) -> (Structure, Parameters) {
        let structure = Structure::new(1, Balance::None).unwrap();
        let mut parameters = default_parameters(structure);
        parameters.joints[0].start = angle;
        (structure, parameters)
    }

    fn imbalance((structure, parameters): &(Structure, Parameters)) -> Imbalance {
        Imbalance::of(*structure, parameters, &Statics::at_start(*structure, parameters, false).unwrap())
    }

    /// The moment of one link is -m g s sin q, and it hangs in balance straight below its joint.
    #[test]
    fn one_link_balances_where_it_hangs_down() {
        let vehicle = one_link(0.3);
        let found = imbalance(&vehicle);
        assert!((found.moment + 1.0 * 9.81 * 0.065 * 0.3_f64.sin()).abs() < 1e-12);
        let [(1, angle)] = found.joints[..] else { panic!("{:?}", found.joints) };
        assert!(angle.abs() < 1e-12);
    }

    /// With the mount b to the right, m (b + s sin q) = 0.
    #[test]
    fn one_link_leans_back_below_a_mount_that_is_not_in_the_middle() {
        let mut vehicle = one_link(0.0);
        vehicle.1.mount.x = 0.02;
        let [(1, angle)] = imbalance(&vehicle).joints[..] else { panic!("no start") };
        assert!((angle - (-0.02_f64 / 0.065).asin()).abs() < 1e-12);
        vehicle.1.mount.x = 0.2;
        assert_eq!(imbalance(&vehicle).joints, []);
    }

    /// m_c x_c = -m_1 s sin q.
    #[test]
    fn a_counterweight_balances_one_link() {
        let structure = Structure::new(1, Balance::Counterweight).unwrap();
        let mut parameters = default_parameters(structure);
        parameters.joints[0].start = 0.5;
        let vehicle = (structure, parameters);
        let (place, within) = imbalance(&vehicle).counterweight.unwrap();
        assert!((place + 1.0 * 0.065 * 0.5_f64.sin() / 2.2).abs() < 1e-12 && within);
    }

    #[test]
    fn each_start_that_is_proposed_balances() {
        let structure = Structure::DEFAULT;
        let mut parameters = default_parameters(structure);
        parameters.joints[1].start += 0.3;
        let joints = imbalance(&(structure, parameters.clone())).joints;
        assert!(joints.len() > 1);
        for (n, angle) in joints {
            let mut balanced = parameters.clone();
            balanced.joints[n - 1].start = angle;
            assert!(imbalance(&(structure, balanced)).moment.abs() < 1e-12, "{n}: {angle}");
        }
    }

    #[test]
    fn drift_follows_from_the_gains() {
        let gains = Gains { kp: 40.0, ki: 20.0, kd: 3.0 };
        assert_eq!(drift(&gains, 2.0, 10.0), Drift::Speed(-1.0));
        assert_eq!(drift(&Gains { ki: 0.0, ..gains }, 2.0, 10.0), Drift::Acceleration(-0.5));
        assert_eq!(drift(&Gains { kp: 0.0, ki: 0.0, kd: 3.0 }, 2.0, 10.0), Drift::Tumbles);
    }

    /// The drift of the plant with its joints at rest, once the roll has come back.
    #[test]
    fn the_plant_drifts_as_fast_as_foretold() {
        use uam::coupling::Unit;
        use uam::coupling::in_process::instance;
        use uam::units::plant::PlantUnit;

        let (structure, mut parameters) = one_link(0.1);
        parameters.autopilot.roll = Gains { kp: 40.0, ki: 100.0, kd: 10.0 };
        let found = imbalance(&(structure, parameters.clone()));
        let mut plant = instance::<PlantUnit>(structure, |data| data.parameters.clone_from(&parameters));
        plant.begin(0.0, 10.0).unwrap();
        plant.initialize().unwrap();
        let (selection, mut values) = plant.select(&["base.vx", "base.roll"]).unwrap();
        let mut largest: f64 = 0.0;
        for i in 0..1000 {
            plant.step(0.01 * f64::from(i), 0.01).unwrap();
            plant.read(&selection, &mut values).unwrap();
            largest = largest.max(values[1].abs());
        }
        let Drift::Speed(speed) = found.drift else { panic!("{:?}", found.drift) };
        assert!((values[0] - speed).abs() < 0.02 * speed.abs(), "{} {speed}", values[0]);
        let foretold = found.roll.unwrap();
        assert!((largest - foretold).abs() < 0.05 * foretold, "{largest} {foretold}");
    }
}
