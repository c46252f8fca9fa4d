//! How fast velocities, momentum and forces change at the end of a step: what hosts ask for that extrapolate.

use nalgebra::{SVector, Vector3};

use super::{Dynamics, Loads, Situation, in_inertial_frame};
use crate::autopilot::AutopilotMode;
use crate::mechanics::momentum::{Twist, inertial_load, tip_acceleration};
use crate::mechanics::planar::{Vec2, cross, vec2};

/// See [`Dynamics::rates_at_end`]; inertial frame, left limits.
#[derive(Debug, Clone, Copy)]
pub struct EndRates {
    /// Acceleration of the end effector \[m/s2\].
    pub tip_velocity: Vec2,
    /// Rate of the momentum \[N, N, N m\].
    pub momentum: Vector3<f64>,
    /// Rate of the support force \[N/s\].
    pub support: f64,
}

impl<const N: usize> Dynamics<N> {
    /// What changes how fast at the end of a step that ended in `situation`, while the coordinates accelerate by
    /// `slope` \[rad/s2, m/s2\] and the base by `acceleration` \[m/s2, m/s2, rad/s2\].
    #[must_use]
    pub fn rates_at_end(
        &self,
        situation: &Situation<N>,
        slope: &SVector<f64, N>,
        acceleration: &Vector3<f64>,
    ) -> EndRates {
        let Situation { state, rotation, node } = situation;
        let base = Twist { linear: rotation.undo(acceleration.xy()), angular: acceleration.z };
        let posture = &node.posture;

        // Masses times accelerations.
        let kept = inertial_load(&self.vehicle, posture, state.held, state.velocity.z, &node.rate, slope);
        let mut momentum = in_inertial_frame(*rotation, kept + node.matrix.of_base(base));
        momentum.z -= cross(state.velocity.xy(), state.momentum.xy());

        let tip = tip_acceleration(&self.vehicle, posture, base, state.velocity.z, &node.rate, slope);
        let leaving = if state.contact { self.gap_rate(*rotation, node, &state.velocity) } else { 0.0 };
        EndRates { tip_velocity: rotation.apply(tip), momentum, support: -self.support.stiffness * leaving }
    }

    /// How fast the autopilot changes thrust \[N/s\] and torque \[N m/s\] at the end of a step of length
    /// `size`, while the base accelerates by `acceleration`.
    #[inline]
    pub fn control_rate(
        &self,
        Situation { state, .. }: &Situation<N>,
        acceleration: &Vector3<f64>,
        loads: &Loads,
        size: f64,
    ) -> Vec2 {
        match self.autopilot.mode {
            AutopilotMode::Pid if self.continuous => {
                let (altitude, roll) = (&self.autopilot.altitude, &self.autopilot.roll);
                let mut error = loads.begin.error(state.pose.y, state.pose.z);
                let mut error_rate = vec2(state.velocity.y, state.velocity.z);
                let mut rate = Vec2::zeros();
                if let Some(slope) = loads.slope {
                    let moving = vec2(slope.altitude, slope.roll);
                    error -= moving * size;
                    error_rate -= moving;
                    rate.x = slope.thrust_feedforward;
                }
                rate - vec2(
                    altitude.kp * error_rate.x + altitude.kd * acceleration.y + altitude.ki * error.x,
                    roll.kp * error_rate.y + roll.kd * acceleration.z + roll.ki * error.y,
                )
            }
            AutopilotMode::External => loads.slope.map_or_else(Vec2::zeros, |slope| vec2(slope.thrust, slope.torque)),
            AutopilotMode::Pid | AutopilotMode::Ideal => Vec2::zeros(),
        }
    }
}
