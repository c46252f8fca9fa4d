//! Whether the hover comes to rest: the closed loops of altitude and roll, linearized about hover.
//!
//! Below a balanced vehicle both loops are apart, each a mass or inertia J under a PID law:
//! J y'' = -kd y' - kp y - ki int(y). Thrust attacks in the line of the common centre of mass and gives no moment, whether
//! the arm hangs below or stands above: it makes no pendulum of the UAV. A sampled autopilot holds what it
//! has computed, and sees the integral over the samples before, by rectangles, as the mechanics have it.

use nalgebra::{DMatrix, Schur};
use uam::autopilot::{AutopilotMode, Gains};
use uam::parameters::{Parameters, Structure};

use super::grasps;
use super::statics::Statics;

/// Motions that die out more slowly than this count as lasting \[1/s\].
const LASTING: f64 = 1e-9;
/// Iterations for eigenvalues; a dozen is usual.
const ITERATIONS: usize = 1000;
/// Shortest sample time that is proposed \[s\].
const SHORTEST_SAMPLE: f64 = 1e-5;
/// Rate of the threefold pole of the altitude with the recommended gains \[1/s\].
const ALTITUDE_RATE: f64 = 2.0;
/// Rate of the threefold pole of the roll with the recommended gains \[1/s\].
const ROLL_RATE: f64 = 6.0;

/// What is controlled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Control {
    /// The altitude.
    Altitude,
    /// The roll.
    Roll,
}

impl Control {
    /// Gains with which a mass \[kg\] or an inertia \[kg m2\] comes to rest without swinging, by a threefold pole.
    #[must_use]
    pub fn recommended(self, inertia: f64) -> Gains {
        let rate = match self {
            Self::Altitude => ALTITUDE_RATE,
            Self::Roll => ROLL_RATE,
        };
        Gains { kp: 3.0 * rate * rate * inertia, ki: rate * rate * rate * inertia, kd: 3.0 * rate * inertia }
    }
}

/// A free motion exp(-decay t) cos(frequency t).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// How fast it dies out, negative if it grows \[1/s\].
    pub decay: f64,
    /// How fast it swings \[rad/s\].
    pub frequency: f64,
}

/// A mass or inertia under a PID law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loop {
    /// Mass \[kg\] or moment of inertia \[kg m2\].
    pub inertia: f64,
    /// Gains of the law.
    pub gains: Gains,
    /// Sample time of the law \[s\]; 0: continuous.
    pub sample_time: f64,
}

impl Loop {
    /// Its free motions, the slowest first; none if numbers are so large that they cannot be found.
    #[must_use]
    pub fn modes(&self) -> Vec<Mode> {
        let Self { inertia, gains: Gains { kp, ki, kd }, sample_time: h } = *self;
        let [p, i, d] = [kp / inertia, ki / inertia, kd / inertia];
        // Place, velocity, integral of the place.
        let rows = if h > 0.0 {
            let [way, push] = [0.5 * h * h, h];
            vec![1.0 - way * p, h - way * d, -way * i, -push * p, 1.0 - push * d, -push * i, h, 0.0, 1.0]
        } else {
            vec![0.0, 1.0, 0.0, -p, -d, -i, 1.0, 0.0, 0.0]
        };
        if rows.iter().any(|number| !number.is_finite()) {
            return Vec::new();
        }
        let mut matrix = DMatrix::from_row_slice(3, 3, &rows);
        if ki == 0.0 {
            // An integral that nobody uses says nothing about the motion.
            matrix = matrix.remove_row(2).remove_column(2);
        }
        let Some(found) = Schur::try_new(matrix, f64::EPSILON, ITERATIONS) else { return Vec::new() };
        let mode = |value: &nalgebra::Complex<f64>| {
            let (re, im) = if h > 0.0 {
                (value.re.hypot(value.im).ln() / h, value.im.atan2(value.re) / h)
            } else {
                (value.re, value.im)
            };
            Mode { decay: -re, frequency: im.abs() }
        };
        let mut modes: Vec<Mode> = found.complex_eigenvalues().iter().map(mode).collect();
        modes.sort_by(|a, b| a.decay.total_cmp(&b.decay));
        modes
    }

    /// Whether every free motion dies out.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.modes().first().is_some_and(|slowest| slowest.decay > LASTING)
    }

    /// What to change if it is not stable.
    fn remedy(&self, control: Control) -> Remedy {
        let largest = |of: Self| {
            let halves = (0..60).map(|n| 0.5 * self.sample_time / f64::from(1 << n.min(30)));
            halves
                .take_while(|time| *time > SHORTEST_SAMPLE)
                .find(|&sample_time| Self { sample_time, ..of }.is_stable())
        };
        if (Self { sample_time: 0.0, ..*self }).is_stable() {
            return Remedy::SampleTime(largest(*self).unwrap_or(0.0));
        }
        let gains = control.recommended(self.inertia);
        let better = Self { gains, ..*self };
        let sample_time = (!better.is_stable()).then(|| largest(better).unwrap_or(0.0));
        Remedy::Gains { gains, sample_time }
    }
}

/// What makes a hover stable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Remedy {
    /// Another sample time of the autopilot \[s\].
    SampleTime(f64),
    /// Other gains.
    Gains {
        /// The gains.
        gains: Gains,
        /// Another sample time \[s\], if these gains need one.
        sample_time: Option<f64>,
    },
}

/// A loop that does not come to rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Instability {
    /// Which.
    pub control: Control,
    /// Only once the payload is held.
    pub held: bool,
    /// The motion that dies out last, or grows; none if the numbers are too large to tell.
    pub mode: Option<Mode>,
    /// What to change.
    pub remedy: Remedy,
}

/// The closed loops of the vehicle at its start, without payload.
#[derive(Debug, Clone, PartialEq)]
pub struct Hover {
    /// Free motions of the altitude, the slowest first.
    pub altitude: Vec<Mode>,
    /// Free motions of the roll, the slowest first.
    pub roll: Vec<Mode>,
    /// What does not come to rest, without or with payload.
    pub instabilities: Vec<Instability>,
}

impl Hover {
    /// The loops of a vehicle; none if nothing is left to the gains of an autopilot.
    ///
    /// # Errors
    /// If the parameters do not go together.
    pub fn of(structure: Structure, parameters: &Parameters, duration: f64) -> uam::Result<Option<Self>> {
        let autopilot = &parameters.autopilot;
        if autopilot.mode != AutopilotMode::Pid {
            return Ok(None);
        }
        let both = |held| {
            let vehicle = Statics::at_start(structure, parameters, held)?;
            let sample_time = autopilot.sample_time;
            Ok::<_, uam::Error>([
                (Control::Altitude, Loop { inertia: vehicle.mass, gains: autopilot.altitude, sample_time }),
                (Control::Roll, Loop { inertia: vehicle.inertia, gains: autopilot.roll, sample_time }),
            ])
        };
        let empty = both(false)?;
        let loaded = if grasps(parameters, duration) { Some(both(true)?) } else { None };
        let unstable = |held: bool| {
            move |(control, of): (Control, Loop)| {
                let unstable =
                    || Instability { control, held, mode: of.modes().first().copied(), remedy: of.remedy(control) };
                (!of.is_stable()).then(unstable)
            }
        };
        let mut instabilities: Vec<_> = empty.into_iter().filter_map(unstable(false)).collect();
        for found in loaded.into_iter().flatten().filter_map(unstable(true)) {
            if instabilities.iter().all(|known| known.control != found.control) {
                instabilities.push(found);
            }
        }
        let [(_, altitude), (_, roll)] = empty;
        Ok(Some(Self { altitude: altitude.modes(), roll: roll.modes(), instabilities }))
    }
}

/// Largest roll per moment that sets in at once and stays \[rad/(N m)\]; none if the roll does not come to rest.
#[must_use]
pub fn peak_roll(gains: &Gains, inertia: f64) -> Option<f64> {
    /// Steps within the time in which the law answers.
    const FINE: f64 = 0.02;
    /// Most steps; the first peak comes after a few hundred, unless gains are very different.
    const MOST: usize = 200_000;
    let continuous = Loop { inertia, gains: *gains, sample_time: 0.0 };
    if !continuous.is_stable() {
        return None;
    }
    let h = FINE / gains.rate_on(inertia);
    let (mut roll, mut rate, mut integral) = (0.0_f64, 0.0, 0.0);
    // The roll rises until its rate changes sign; later peaks are lower, as long as it is stable.
    for _ in 0..MOST {
        let torque = 1.0 - gains.kd * rate - gains.kp * roll - gains.ki * integral;
        // Half steps of the velocity about whole ones of the place: of second order.
        rate += h * torque / (inertia + 0.5 * h * gains.kd);
        if rate <= 0.0 {
            break;
        }
        roll += h * rate;
        integral += h * roll;
    }
    Some(roll)
}

#[cfg(test)]
mod tests {
    use uam::parameters::Balance;
    use uam::scenarios::default_parameters;

    use super::*;

    fn law(kp: f64, ki: f64, kd: f64) -> Loop {
        Loop { inertia: 2.0, gains: Gains { kp, ki, kd }, sample_time: 0.0 }
    }

    /// s^2 + 2 s + 5 = 0 has the roots -1 +- 2 i.
    #[test]
    fn a_pd_loop_has_the_roots_of_its_polynomial() {
        for mode in law(10.0, 0.0, 4.0).modes() {
            assert!((mode.decay - 1.0).abs() < 1e-12 && (mode.frequency - 2.0).abs() < 1e-12, "{mode:?}");
        }
        assert_eq!(law(10.0, 0.0, 4.0).modes().len(), 2);
        assert!(law(10.0, 0.0, 4.0).is_stable() && !law(10.0, 0.0, 0.0).is_stable());
    }

    /// Routh: kd kp > J ki.
    #[test]
    fn a_pid_loop_obeys_routh() {
        assert!(law(10.0, 19.9, 4.0).is_stable());
        assert!(!law(10.0, 20.1, 4.0).is_stable());
        let [a, b, c] = Loop { gains: Control::Roll.recommended(2.0), ..law(0.0, 0.0, 0.0) }.modes()[..] else {
            panic!("not three")
        };
        // A threefold root is found to the third root of rounding.
        assert!([a, b, c].iter().all(|mode| (mode.decay - ROLL_RATE).abs() < 1e-3), "{a:?} {b:?} {c:?}");
    }

    /// With x' = v and v' = -d v held for h: z = 1 and z = 1 - d h, so stable for d h < 2 beside a small kp.
    #[test]
    fn slow_samples_make_a_stable_loop_unstable() {
        let sampled = |sample_time| Loop { sample_time, ..law(0.02, 0.0, 8.0) };
        assert!(sampled(0.0).is_stable() && sampled(0.49).is_stable() && !sampled(0.51).is_stable());
        let Remedy::SampleTime(time) = sampled(0.51).remedy(Control::Roll) else { panic!("gains") };
        assert!(sampled(time).is_stable() && time > 0.2);
    }

    /// Fast samples are as good as none.
    #[test]
    fn fast_samples_have_the_continuous_eigenvalues() {
        let (continuous, sampled) = (law(10.0, 3.0, 4.0), Loop { sample_time: 1e-4, ..law(10.0, 3.0, 4.0) });
        for (a, b) in continuous.modes().iter().zip(sampled.modes()) {
            assert!((a.decay - b.decay).abs() < 2e-3 && (a.frequency - b.frequency).abs() < 2e-3, "{a:?} {b:?}");
        }
    }

    /// J roll'' + kp roll = 1 swings to 2 / kp; with critical damping the roll creeps to 1 / kp.
    #[test]
    fn the_largest_roll_of_a_pd_loop() {
        let nearly_undamped = peak_roll(&Gains { kp: 8.0, ki: 0.0, kd: 1e-3 }, 2.0).unwrap();
        assert!((nearly_undamped - 0.25).abs() < 1e-3, "{nearly_undamped}");
        let critical = peak_roll(&Gains { kp: 8.0, ki: 0.0, kd: 8.0 }, 2.0).unwrap();
        assert!((critical - 0.125).abs() < 1e-3, "{critical}");
        assert_eq!(peak_roll(&Gains { kp: 8.0, ki: 0.0, kd: 0.0 }, 2.0), None);
    }

    #[test]
    fn gains_that_let_the_altitude_grow_are_found_with_better_ones() {
        let structure = Structure::DEFAULT;
        let mut parameters = default_parameters(structure);
        assert_eq!(Hover::of(structure, &parameters, 30.0).unwrap().unwrap().instabilities, []);
        parameters.autopilot.altitude.kd = 1.0;
        let found = Hover::of(structure, &parameters, 30.0).unwrap().unwrap().instabilities;
        let [Instability { control: Control::Altitude, remedy: Remedy::Gains { gains, .. }, .. }] = found[..] else {
            panic!("{found:?}")
        };
        parameters.autopilot.altitude = gains;
        assert_eq!(Hover::of(structure, &parameters, 30.0).unwrap().unwrap().instabilities, []);
    }

    /// Rates of altitude or roll of the plant late in a run, as multiples of those early in it: one link, a bit out of
    /// balance, whose joint rests.
    fn growth(parameters: &Parameters, name: &str) -> f64 {
        use uam::coupling::Unit;
        use uam::coupling::in_process::instance;
        use uam::units::plant::PlantUnit;

        let structure = Structure::new(1, Balance::None).unwrap();
        let mut plant = instance::<PlantUnit>(structure, |data| data.parameters.clone_from(parameters));
        plant.begin(0.0, 10.0).unwrap();
        plant.initialize().unwrap();
        let (selection, mut values) = plant.select(&[name]).unwrap();
        let mut largest = [0.0_f64; 2];
        for i in 0..1000 {
            plant.step(0.01 * f64::from(i), 0.01).unwrap();
            plant.read(&selection, &mut values).unwrap();
            match i {
                200..400 => largest[0] = largest[0].max(values[0].abs()),
                800.. => largest[1] = largest[1].max(values[0].abs()),
                _ => {}
            }
        }
        largest[1] / largest[0]
    }

    /// The sample time at which the loop becomes unstable is that of the plant, to 2 %.
    #[test]
    fn the_plant_becomes_unstable_at_the_same_sample_time() {
        let structure = Structure::new(1, Balance::None).unwrap();
        let mut parameters = default_parameters(structure);
        parameters.joints[0].start = 1e-6;
        parameters.autopilot.roll = Gains { kp: 40.0, ki: 35.0, kd: 9.0 };
        let inertia = Statics::at_start(structure, &parameters, false).unwrap().inertia;
        let stable = |sample_time| Loop { inertia, gains: parameters.autopilot.roll, sample_time }.is_stable();
        let (mut low, mut high) = (1e-3, 1.0);
        assert!(stable(low) && !stable(high));
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if stable(middle) { low = middle } else { high = middle }
        }
        for (factor, grows) in [(0.98, false), (1.02, true)] {
            let mut sampled = parameters.clone();
            sampled.autopilot.sample_time = factor * low;
            let found = growth(&sampled, "base.roll_rate");
            assert_eq!(found > 1.0, grows, "{factor}: {found}");
        }
    }
}
