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
        let (vehicle, Autopilot { altitude, roll, sample_time, .. }) = (&self.vehicle, &self.autopilot);
        let [mass, inertia] = [vehicle.mass(), vehicle.uav_inertia];
        let gains = |name: &str, Gains { kp, ki, kd }: &Gains, load: String| {
            format!("{name}.kp = {kp:?}, {name}.ki = {ki:?} and {name}.kd = {kd:?} act on {load}")
        };
        let controlled = |rate: f64| if self.continuous { rate } else { 0.0 };
        let swinging = if contact { (self.support.stiffness * (1.0 / mass + 1.0 / inertia)).sqrt() } else { 0.0 };
        let fast = [
            (turning, format!("links and UAV turn at {turning:.1e} rad/s")),
            (controlled(altitude.rate_on(mass)), gains("autopilot.altitude", altitude, format!("{mass:?} kg"))),
            (controlled(roll.rate_on(inertia)), gains("autopilot.roll", roll, format!("uav.inertia = {inertia:?}"))),
            (
                swinging,
                format!(
                    "support.stiffness = {:?} acts on {mass:?} kg and uav.inertia = {inertia:?}",
                    self.support.stiffness
                ),
            ),
            // An internal step ends at every sample.
            (
                if *sample_time > 0.0 { 1.0 / sample_time } else { 0.0 },
                format!("autopilot.sample_time = {sample_time:?}"),
            ),
        ];
        let fastest = fast.into_iter().max_by(|(a, _), (b, _)| a.total_cmp(b)).filter(|(rate, _)| *rate > SLOW);
        let cause = fastest.map_or_else(|| "internal steps take no more than 1 ms".to_owned(), |(_, cause)| cause);
        Error::StepTooLong { size, most, cause }
    }
}
