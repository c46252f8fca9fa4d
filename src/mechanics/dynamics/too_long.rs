//! Why a step would take for ever, by the names of the parameters that make it so.

use super::Dynamics;
use crate::autopilot::{Autopilot, Gains};
use crate::error::Error;

/// What takes no shorter internal steps than this is slow \[1/s\].
const SLOW: f64 = 10.0;

impl<const N: usize> Dynamics<N> {
    /// A step of length `size` \[s\] takes too many internal ones: at most one of length `most` does not. Links and UAV
    /// turn at `turning` \[rad/s\]; `contact`: the payload is on its support.
    #[cold]
    #[inline(never)]
    pub(super) fn too_long(&self, size: f64, most: f64, turning: f64, contact: bool) -> Error {
        let what = What {
            mass: self.vehicle.mass(),
            inertia: self.vehicle.uav_inertia,
            autopilot: &self.autopilot,
            continuous: self.continuous,
            stiffness: if contact { self.support.stiffness } else { 0.0 },
            turning,
        };
        Error::StepTooLong { size, most, cause: what.is_fastest() }
    }
}

/// All that may be fast.
struct What<'a> {
    mass: f64,
    inertia: f64,
    autopilot: &'a Autopilot,
    continuous: bool,
    stiffness: f64,
    turning: f64,
}

impl What<'_> {
    /// The fastest of it, in words. One copy for all numbers of coordinates.
    #[inline(never)]
    fn is_fastest(&self) -> String {
        let Self {
            mass, inertia, autopilot: Autopilot { altitude, roll, sample_time, .. }, stiffness, turning, ..
        } = self;
        let controlled = |gains: &Gains, load: f64| if self.continuous { gains.rate_on(load) } else { 0.0 };
        let gains = |name: &str, Gains { kp, ki, kd }: &Gains, load: &str, value: f64| {
            format!("{name}.kp = {kp:?}, {name}.ki = {ki:?} and {name}.kd = {kd:?} act on {load} {value:?}")
        };
        let sampled = if *sample_time > 0.0 { 1.0 / sample_time } else { 0.0 };
        let swinging = (stiffness * (1.0 / mass + 1.0 / inertia)).sqrt();
        let rates = [*turning, controlled(altitude, *mass), controlled(roll, *inertia), swinging, sampled];
        let fastest = rates.into_iter().enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b));
        match fastest.filter(|(_, rate)| *rate > SLOW) {
            Some((0, _)) => format!("links and UAV turn at {turning:.1e} rad/s"),
            Some((1, _)) => gains("autopilot.altitude", altitude, "a mass of", *mass),
            Some((2, _)) => gains("autopilot.roll", roll, "uav.inertia =", *inertia),
            Some((3, _)) => {
                format!("support.stiffness = {stiffness:?} acts on a mass of {mass:?} and uav.inertia = {inertia:?}")
            }
            Some(_) => format!("autopilot.sample_time = {sample_time:?}"),
            None => "internal steps take no more than 1 ms".to_owned(),
        }
    }
}
