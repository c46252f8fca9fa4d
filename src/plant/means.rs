//! Mean forces and torques over a communication step, from changes of momentum.
//!
//! Whatever jumps at the beginning of a step, rates or a payload that is taken over, gives an impulse;
//! means over the step contain it, instantaneous values would not. Newton's law for the UAV alone gives
//! what the rest exerts on it, that for everything outboard of a joint the torque of its motor.

use nalgebra::{SVector, Vector3};

use super::Outputs;
use crate::dynamics::{Account, Dynamics, Impulse, Load, Situation};
use crate::memory;
use crate::momentum;
use crate::planar::{Vec2, vec2};
use crate::vehicle::Vehicle;

/// A step shorter than this keeps the previous means and adds its impulse to the next ones \[s\].
const SHORTEST: f64 = 1e-9;

/// Impulses since the last means, and the motion at that time.
#[derive(Debug, Clone)]
pub(super) struct Means<const N: usize> {
    impulse: Impulse,
    /// Of what each coordinate moves, its motor excepted \[N m s, N s\]; see [`Account`].
    outboard_impulse: SVector<f64, N>,
    /// Since then \[s\].
    time: f64,
    /// Velocity of the UAV \[m/s, m/s, rad/s\].
    velocity: Vector3<f64>,
    /// Of what each coordinate moves \[N m s, N s\].
    outboard: SVector<f64, N>,
    /// Momentum of the held payload \[N s\].
    payload: Vec2,
}

memory!(Means<N> { impulse, outboard_impulse, time, velocity, outboard, payload });

impl<const N: usize> Means<N> {
    /// Everything at rest.
    pub(super) fn at_rest() -> Self {
        Self {
            impulse: Impulse::NONE,
            outboard_impulse: SVector::zeros(),
            time: 0.0,
            velocity: Vector3::zeros(),
            outboard: SVector::zeros(),
            payload: Vec2::zeros(),
        }
    }

    /// Where the integrals of a step go that only means need.
    pub(super) fn account(&mut self) -> Account<'_, N> {
        Account::Outboard(&mut self.outboard_impulse)
    }

    /// Adds the impulse of a step.
    pub(super) fn add(&mut self, impulse: Impulse, size: f64) {
        self.impulse = self.impulse + impulse;
        self.time += size;
    }

    /// The payload is about to be let go: the momentum that it takes along is no impulse.
    pub(super) fn release(&mut self, vehicle: &Vehicle<N>, situation: &Situation<N>) {
        self.outboard += outboard_momentum(vehicle, situation, false) - outboard_momentum(vehicle, situation, true);
    }

    /// Writes the means up to `situation`, and begins new ones; `load`: mean over the step.
    pub(super) fn write(
        &mut self,
        dynamics: &Dynamics<N>,
        situation: &Situation<N>,
        load: &Load,
        outputs: &mut Outputs,
    ) {
        if self.time < SHORTEST {
            return;
        }
        let (vehicle, state, per_time) = (&dynamics.vehicle, &situation.state, 1.0 / self.time);
        let change = (state.velocity - self.velocity) * per_time;
        let impulse = &self.impulse;
        outputs.transmitted_force = change.xy() * vehicle.uav_mass - impulse.thrust * per_time - load.base_force
            + vec2(0.0, vehicle.uav_mass * vehicle.gravity);
        outputs.transmitted_moment = change.z * vehicle.uav_inertia - impulse.torque * per_time - load.base_torque;
        if dynamics.on_carriage() {
            (outputs.thrust, outputs.torque) = (impulse.thrust.y * per_time, impulse.torque * per_time);
        }

        let momentum = outboard_momentum(vehicle, situation, state.held);
        let effort = (momentum - self.outboard - self.outboard_impulse) * per_time;
        outputs.effort[..N].copy_from_slice(effort.as_slice());

        let payload = if state.held { payload_momentum(vehicle, situation) } else { Vec2::zeros() };
        outputs.payload_force = if state.held {
            let weight = vec2(0.0, -vehicle.payload_mass * vehicle.gravity);
            weight + (vec2(0.0, impulse.support) - (payload - self.payload)) * per_time
        } else {
            Vec2::zeros()
        };
        *self = Self { velocity: state.velocity, outboard: momentum, payload, ..Self::at_rest() };
    }
}

/// Momentum of what each coordinate moves.
fn outboard_momentum<const N: usize>(vehicle: &Vehicle<N>, situation: &Situation<N>, held: bool) -> SVector<f64, N> {
    let node = &situation.node;
    momentum::outboard_momentum(vehicle, &node.posture, held, situation.base(), &node.rate)
}

fn payload_momentum<const N: usize>(vehicle: &Vehicle<N>, situation: &Situation<N>) -> Vec2 {
    let node = &situation.node;
    situation.turn.apply(node.velocity_at(vehicle, node.posture.payload, situation.base())) * vehicle.payload_mass
}
