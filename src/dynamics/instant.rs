//! What can be said of the instant at the end of a step: accelerations and loads.

use nalgebra::{SVector, Vector3};

use super::law::Scene;
use super::{Dynamics, Load, Loads, Motion, Situation, State, in_inertial_frame};
use crate::momentum::{Twist, inertial_load};
use crate::planar::{Vec2, cross, vec2};

/// See [`Dynamics::at_end`].
#[derive(Debug, Clone, Copy)]
pub struct Instant {
    /// Acceleration of the base, inertial frame \[m/s2, m/s2, rad/s2\].
    pub acceleration: Vector3<f64>,
    /// Thrust \[N\] and torque \[N m\].
    pub control: Vec2,
    /// Support force \[N\].
    pub support: f64,
}

impl<const N: usize> Dynamics<N> {
    pub(super) fn scene(state: &State<N>) -> Scene<'static, N> {
        Scene {
            loads: &Loads::CALM,
            elapsed: 0.0,
            held: state.held,
            contact: state.contact,
            sampled: state.sampled,
            motion: Motion::constant(state.rate),
        }
    }

    /// Acceleration and forces at the end of a step that ended in `situation`, while the coordinates
    /// accelerate by `slope`.
    #[must_use]
    pub fn at_end(&self, situation: &Situation<N>, slope: &SVector<f64, N>, load: &Load) -> Instant {
        let Situation { state, turn, node } = situation;
        let flow = situation.flow(self.base);
        let scene = Self::scene(state);
        let rate = self.law_at(&flow, node, situation.base(), load, &scene);
        let thrust = self.control(&flow, &state.velocity, load, &scene).x;
        let load = Twist {
            linear: turn.undo(vec2(rate[3], rate[4])),
            angular: rate[5] + cross(state.velocity.xy(), state.momentum.xy()),
        };
        let kept = inertial_load(&self.vehicle, &node.posture, state.held, state.velocity.z, &node.rate, slope);
        let acceleration = if self.on_carriage() {
            Vector3::new((load - kept).linear.x / node.matrix.mass, 0.0, 0.0)
        } else {
            in_inertial_frame(*turn, node.matrix.base_response(load - kept))
        };
        Instant { acceleration, control: vec2(thrust, rate[10]), support: rate[11] }
    }
}
