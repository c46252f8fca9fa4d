//! What can be said of the instant at the end of a step: accelerations and loads.

use nalgebra::{SVector, Vector3};

use super::integrated_state::IntegratedState;
use super::law::StepContext;
use super::{Dynamics, Load, Loads, Motion, Situation, State, in_inertial_frame};
use crate::mechanics::momentum::{Twist, inertial_load};
use crate::mechanics::planar::{Vec2, vec2};

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
    pub(super) fn context(state: &State<N>) -> StepContext<'static, N> {
        StepContext {
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
        let state = &situation.state;
        let integrated = situation.integrated_state(self.base);
        let context = Self::context(state);
        let mut rate = IntegratedState::ZERO;
        self.law_at(&mut rate, &integrated, &situation.node, situation.base(), load, &context);
        let (control, _) = self.control(&integrated, &state.velocity, load, &context);
        let base = self.base_acceleration(situation, self.loads_at_end(situation, &rate), slope);
        let acceleration = in_inertial_frame(situation.rotation, base);
        Instant { acceleration, control: vec2(control.x, rate.torque_impulse), support: rate.support_impulse }
    }

    /// Force on the whole system and moment about the UAV's centre of mass in `situation`, where `rate` is the rate of
    /// the integrated state; axes of the arm's frame.
    pub(super) fn loads_at_end(
        &self,
        Situation { state, rotation, node }: &Situation<N>,
        rate: &IntegratedState,
    ) -> Twist {
        let transport = self.base.transport(state.velocity.xy(), state.momentum.xy(), node.arm);
        Twist { linear: rotation.undo(rate.momentum.xy()), angular: rate.momentum.z + transport }
    }

    /// Acceleration of the base under these `loads`, while the coordinates accelerate by `slope`; axes of the arm's frame.
    ///
    /// As velocity follows from momentum by the model of the base, so does acceleration from loads.
    pub(super) fn base_acceleration(&self, situation: &Situation<N>, loads: Twist, slope: &SVector<f64, N>) -> Twist {
        let node = &situation.node;
        let roll_rate = self.base.carried(situation.base()).angular;
        let kept = inertial_load(&self.vehicle, &node.posture, situation.state.held, roll_rate, &node.rate, slope);
        self.base_motion(node, loads, kept)
    }
}
