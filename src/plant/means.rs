//! Mean forces and torques over a communication step, from changes of momentum.
//!
//! Whatever jumps at the beginning of a step, rates or a payload that is taken over, gives an impulse;
//! means over the step contain it, instantaneous values would not. Newton's law for the UAV alone gives
//! what the rest exerts on it, that for everything outboard of a joint the torque of its motor.
//!
//! They are worked out when a host asks for them: until then an [`Interval`] keeps what they follow from.

use nalgebra::SVector;

use super::Outputs;
use crate::autopilot::AutopilotMode;
use crate::bytes::Tape;
use crate::mechanics::dynamics::{Account, Dynamics, Impulse, Load, Loads, Outboard, Situation};
use crate::mechanics::momentum::outboard_momentum;
use crate::mechanics::planar::{Vec2, vec2};
use crate::mechanics::vehicle::Vehicle;
use crate::memory;
use crate::pass;

/// A step shorter than this keeps the previous means and adds its impulse to the next ones \[s\].
const SHORTEST: f64 = 1e-9;

/// Mean forces and torques.
#[derive(Debug, Clone, Copy)]
pub(super) struct Means<const N: usize> {
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

memory!(Means<N> { control, force, moment, effort, payload });

impl<const N: usize> Means<N> {
    /// Everything is at rest in `situation`, without payload, and the means are what keeps it so.
    fn at_rest(dynamics: &Dynamics<N>, situation: &Situation<N>) -> Self {
        let (vehicle, node) = (&dynamics.vehicle, &situation.node);
        let weight = vec2(0.0, -node.matrix.mass * vehicle.gravity);
        let moment = -node.matrix.first.x * vehicle.gravity;
        Self {
            control: match dynamics.autopilot.mode {
                AutopilotMode::Ideal => vec2(-weight.y, -moment),
                AutopilotMode::Pid => vec2(-weight.y, 0.0),
                AutopilotMode::External => Vec2::zeros(),
            },
            force: vec2(0.0, -vehicle.carried_mass() * vehicle.gravity),
            moment,
            effort: SVector::from_fn(|i, _| node.matrix.outboard_first(i).x * vehicle.gravity),
            payload: Vec2::zeros(),
        }
    }

    /// Writes them.
    pub(super) fn write(&self, outputs: &mut Outputs) {
        (outputs.thrust, outputs.torque) = (self.control.x, self.control.y);
        outputs.transmitted_force = self.force;
        outputs.transmitted_moment = self.moment;
        outputs.effort[..N].copy_from_slice(self.effort.as_slice());
        outputs.payload_force = self.payload;
    }
}

/// What has happened since the last means were complete.
#[derive(Debug, Clone)]
pub(super) struct Interval<const N: usize> {
    /// The means before it, if they have been asked for.
    previous: Means<N>,
    /// Its length so far \[s\].
    time: f64,
    /// Its beginning, with the motion just before.
    before: Situation<N>,
    impulse: Impulse,
    outboard: Outboard<N>,
}

impl<const N: usize> Interval<N> {
    /// At the start.
    pub(super) fn at_rest(dynamics: &Dynamics<N>, situation: &Situation<N>) -> Self {
        Self {
            previous: Means::at_rest(dynamics, situation),
            time: 0.0,
            before: *situation,
            impulse: Impulse::NONE,
            outboard: Outboard::none(&situation.node),
        }
    }

    /// A step of length `size` begins in `situation`, where the one before, the previous step, has ended.
    #[inline]
    pub(super) fn begin(
        &mut self,
        dynamics: &Dynamics<N>,
        situation: &Situation<N>,
        previous_step: &PreviousStep,
        size: f64,
    ) {
        if self.goes_on() {
            let sum = self.outboard.total(dynamics, &situation.node, &previous_step.loads());
            self.outboard.restart(sum);
            return;
        }
        if size < SHORTEST {
            self.previous = self.means(dynamics, situation, previous_step);
        }
        self.restart(situation);
    }

    fn restart(&mut self, situation: &Situation<N>) {
        (self.before, self.impulse, self.time) = (*situation, Impulse::NONE, 0.0);
        self.outboard.restart(SVector::zeros());
    }

    /// Whether it is too short for means of its own, so that the next step belongs to it.
    fn goes_on(&self) -> bool {
        self.time < SHORTEST
    }

    /// Where the integrals of a step go that only means need.
    pub(super) fn account(&mut self) -> Account<'_, N> {
        Account::Outboard(&mut self.outboard)
    }

    /// Adds the impulse of a step.
    pub(super) fn add(&mut self, impulse: Impulse, size: f64) {
        self.impulse = self.impulse + impulse;
        self.time += size;
    }

    /// The payload is about to be let go: the momentum that it takes along is no impulse.
    pub(super) fn release(&mut self, vehicle: &Vehicle<N>, situation: &Situation<N>) {
        let momentum = |held| momentum_outboard(vehicle, situation, held);
        self.outboard.add(&(momentum(false) - momentum(true)));
    }

    /// The means up to `situation`, where the last step, the previous step, has ended.
    #[inline(never)]
    pub(super) fn means(
        &self,
        dynamics: &Dynamics<N>,
        situation: &Situation<N>,
        previous_step: &PreviousStep,
    ) -> Means<N> {
        if self.goes_on() {
            return self.previous;
        }
        let (vehicle, state, per_time) = (&dynamics.vehicle, &situation.state, 1.0 / self.time);
        let (before, impulse) = (&self.before, &self.impulse);
        let change = (state.velocity - before.state.velocity) * per_time;
        let mut room = None;
        let load = previous_step.loads().present(0.5 * previous_step.size, &mut room);

        let momentum = momentum_outboard(vehicle, situation, state.held);
        let momentum_before = momentum_outboard(vehicle, before, before.state.held);
        let outboard_impulse = self.outboard.total(dynamics, &situation.node, &previous_step.loads());

        let payload = |situation: &Situation<N>| {
            if situation.state.held { momentum_of_payload(dynamics, situation) } else { Vec2::zeros() }
        };
        let weight = vec2(0.0, -vehicle.payload_mass * vehicle.gravity);
        Means {
            control: vec2(impulse.thrust.y, impulse.torque) * per_time,
            force: change.xy() * vehicle.uav_mass - impulse.thrust * per_time - load.base_force
                + vec2(0.0, vehicle.uav_mass * vehicle.gravity),
            moment: change.z * vehicle.uav_inertia - impulse.torque * per_time - load.base_torque,
            effort: (momentum - momentum_before - outboard_impulse) * per_time,
            payload: if state.held {
                weight + (vec2(0.0, impulse.support) - (payload(situation) - payload(before))) * per_time
            } else {
                Vec2::zeros()
            },
        }
    }

    /// Works out what waits for somebody to ask, and passes all by a tape.
    pub(super) fn pass(
        &mut self,
        dynamics: &Dynamics<N>,
        situation: &Situation<N>,
        previous_step: &PreviousStep,
        tape: &mut Tape<'_>,
    ) {
        let mut sum = self.outboard.total(dynamics, &situation.node, &previous_step.loads());
        if !self.goes_on() {
            self.previous = self.means(dynamics, situation, previous_step);
            self.restart(situation);
            sum = SVector::zeros();
        }
        let Self { previous, time, before, impulse, outboard } = self;
        let outboard_impulse = &mut sum;
        pass!(tape: previous, time, before, impulse, outboard_impulse);
        outboard.restart(sum);
    }
}

/// What acted during the last step.
#[derive(Debug, Clone, Copy)]
pub(super) struct PreviousStep {
    /// Loads at its beginning.
    pub begin: Load,
    /// Change of the loads per second, if there was any.
    pub change: Option<Load>,
    /// Its length \[s\].
    pub size: f64,
}

memory!(PreviousStep { begin, change, size });

impl PreviousStep {
    /// Nothing has been yet.
    pub const NONE: Self = Self { begin: Load::NONE, change: None, size: 0.0 };

    /// The loads.
    pub fn loads(&self) -> Loads<'_> {
        Loads { begin: &self.begin, slope: self.change.as_ref() }
    }
}

/// Momentum of what each coordinate moves.
fn momentum_outboard<const N: usize>(vehicle: &Vehicle<N>, situation: &Situation<N>, held: bool) -> SVector<f64, N> {
    let node = &situation.node;
    outboard_momentum(vehicle, &node.posture, held, situation.base(), &node.rate)
}

fn momentum_of_payload<const N: usize>(dynamics: &Dynamics<N>, situation: &Situation<N>) -> Vec2 {
    let Situation { rotation, node, .. } = situation;
    dynamics.velocity_at(node, *rotation, node.posture.payload, situation.base()) * dynamics.vehicle.payload_mass
}
