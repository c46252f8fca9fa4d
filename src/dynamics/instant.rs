//! What can be said of one instant, at the end or at the beginning of a step: accelerations and loads.

use nalgebra::{SVector, Vector3};

use super::law::Scene;
use super::{Dynamics, Load, Loads, Motion, Situation, in_inertial_frame};
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

/// See [`Dynamics::at_beginning`].
#[derive(Debug, Clone, Copy)]
pub struct Trend {
    /// Rate of the momentum \[N, N, N m\].
    pub momentum: Vector3<f64>,
    /// Rates of the autopilot's integrals \[m, rad\].
    pub integrals: Vec2,
    /// Rate of the angular momentum of what the UAV carries if no moment is exerted on the UAV \[N m\].
    pub carried: f64,
}

impl<const N: usize> Dynamics<N> {
    pub(super) fn scene(situation: &Situation<N>) -> Scene<'static, N> {
        let state = &situation.state;
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
        let scene = Self::scene(situation);
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

    /// How momentum changes at time `t` at the beginning of a step, as seen with the velocities just before
    /// it: the explicit part of the thesis' Euler step. Takes a sample of the autopilot if it is due.
    pub fn at_beginning(&self, situation: &mut Situation<N>, loads: &Loads, t: f64) -> Trend {
        self.sample(&mut situation.state, &loads.begin, t);
        let flow = situation.flow(self.base);
        situation.state.contact = self.touches(&flow, &situation.node, situation.state.held);
        let scene = Self::scene(situation);
        let v = situation.base();
        let rate = self.law_at(&flow, &situation.node, v, &loads.begin, &scene);
        Trend {
            momentum: Vector3::new(rate[3], rate[4], rate[5]),
            integrals: vec2(rate[6], rate[7]),
            carried: self.carried_load(&situation.node, &self.carrier(&flow, &rate), &loads.begin),
        }
    }
}
