//! Mean forces and torques over a communication step, from changes of momentum.
//!
//! Whatever jumps at the beginning of a step, rates or a payload that is taken over, gives an impulse;
//! means over the step contain it, instantaneous values would not. Newton's law for the UAV alone gives
//! what the rest exerts on it, that for everything outboard of a joint the torque of its motor.

use nalgebra::{SVector, Vector3};

use super::Outputs;
use crate::autopilot::AutopilotMode;
use crate::dynamics::{Account, Dynamics, Impulse, Load, Situation};
use crate::memory;
use crate::momentum;
use crate::planar::{Vec2, vec2};
use crate::vehicle::Vehicle;

/// A step shorter than this keeps the previous means and adds its impulse to the next ones \[s\].
const SHORTEST: f64 = 1e-9;

/// Mean forces and torques.
#[derive(Debug, Clone, Copy)]
struct Values<const N: usize> {
    /// Thrust \[N\] and torque \[N m\] of the rotors.
    control: Vec2,
    /// Force on the UAV of all that it carries \[N\].
    force: Vec2,
    /// Moment of that about the UAV's centre of mass \[N m\].
    moment: f64,
    /// Torques and forces of the motors \[N m, N\].
    effort: SVector<f64, N>,
    /// Force of the held payload on the arm \[N\].
    payload: Vec2,
}

memory!(Values<N> { control, force, moment, effort, payload });

/// The last means, impulses since then, and the motion at that time.
#[derive(Debug, Clone)]
pub(super) struct Means<const N: usize> {
    values: Values<N>,
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

memory!(Means<N> { values, impulse, outboard_impulse, time, velocity, outboard, payload });

impl<const N: usize> Means<N> {
    /// Everything is at rest in `situation`, without payload, and the means are what keeps it so.
    pub(super) fn at_rest(dynamics: &Dynamics<N>, situation: &Situation<N>) -> Self {
        let (vehicle, node) = (&dynamics.vehicle, &situation.node);
        let weight = vec2(0.0, -node.matrix.mass * vehicle.gravity);
        let moment = -node.matrix.first.x * vehicle.gravity;
        let values = Values {
            control: match dynamics.autopilot.mode {
                AutopilotMode::Ideal => vec2(-weight.y, -moment),
                AutopilotMode::Pid => vec2(-weight.y, 0.0),
                AutopilotMode::External => Vec2::zeros(),
            },
            force: vec2(0.0, -vehicle.carried_mass() * vehicle.gravity),
            moment,
            effort: SVector::from_fn(|i, _| node.matrix.outboard_first[i].x * vehicle.gravity),
            payload: Vec2::zeros(),
        };
        Self {
            values,
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

    /// Takes the means up to `situation`, and begins new ones; `load`: mean over the step.
    pub(super) fn close(&mut self, dynamics: &Dynamics<N>, situation: &Situation<N>, load: &Load) {
        if self.time < SHORTEST {
            return;
        }
        let (vehicle, state, per_time) = (&dynamics.vehicle, &situation.state, 1.0 / self.time);
        let change = (state.velocity - self.velocity) * per_time;
        let (impulse, values) = (&self.impulse, &mut self.values);
        values.force = change.xy() * vehicle.uav_mass - impulse.thrust * per_time - load.base_force
            + vec2(0.0, vehicle.uav_mass * vehicle.gravity);
        values.moment = change.z * vehicle.uav_inertia - impulse.torque * per_time - load.base_torque;
        values.control = vec2(impulse.thrust.y, impulse.torque) * per_time;

        let momentum = outboard_momentum(vehicle, situation, state.held);
        values.effort = (momentum - self.outboard - self.outboard_impulse) * per_time;

        if state.held {
            let payload = payload_momentum(vehicle, situation);
            let weight = vec2(0.0, -vehicle.payload_mass * vehicle.gravity);
            values.payload = weight + (vec2(0.0, impulse.support) - (payload - self.payload)) * per_time;
            self.payload = payload;
        } else {
            (values.payload, self.payload) = (Vec2::zeros(), Vec2::zeros());
        }
        (self.velocity, self.outboard) = (state.velocity, momentum);
        (self.impulse, self.outboard_impulse, self.time) = (Impulse::NONE, SVector::zeros(), 0.0);
    }

    /// Writes the last means.
    pub(super) fn write(&self, outputs: &mut Outputs) {
        let values = &self.values;
        (outputs.thrust, outputs.torque) = (values.control.x, values.control.y);
        outputs.transmitted_force = values.force;
        outputs.transmitted_moment = values.moment;
        outputs.effort[..N].copy_from_slice(values.effort.as_slice());
        outputs.payload_force = values.payload;
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
