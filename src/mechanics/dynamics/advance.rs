//! A step of any length: cut into internal steps at samples of the autopilot, at switching of contact, and
//! as short as the fastest rates ask for.

use nalgebra::{SVector, Vector3};

use super::integrated_state::IntegratedState;
use super::law::StepContext;
use super::runge_kutta::Internal;
use super::{Account, Dynamics, Impulse, Load, Loads, Motion, Node, Situation, State, in_inertial_frame};
use crate::autopilot::AutopilotMode;
use crate::error::Result;
use crate::mechanics::planar::{Rotation, Vec2, vec2};
use crate::mechanics::vehicle::Balancer;

/// Longest internal step \[s\]; a millisecond that is not quite one, by rounding, is not cut in two.
const LONGEST_INTERNAL_STEP: f64 = 1.05e-3;

/// Longest internal step times the fastest rate of control or turning: order 4 leaves 1e-12 of the
/// amplitude there.
pub(super) const RESOLUTION: f64 = 0.01;

/// The same while the system swings on the support with a speed of 1 m/s. There the error in metres counts, which adds
/// up bounce by bounce; slower swinging stands longer steps, by the order 4 of the method.
const SUPPORT_RESOLUTION: f64 = 0.005;

/// However slow that is.
const COARSEST_SUPPORT_RESOLUTION: f64 = 0.02;

/// A base that tumbles drags everything along and adds up errors over its turns: it counts so much more.
pub(super) const TUMBLING: f64 = 3.0;

/// Most internal steps in one step, which then takes a tenth of a second; more are taken for a mistake.
pub(super) const MOST_STEPS: f64 = 2e5;

/// So often the turns of links and UAV, sums of small turns, are made to agree with their angles \[1/s\].
const REFRESHED: f64 = 16.0;

/// An instant this close to a sample of the autopilot is the sample \[s\].
pub(super) const SAME_INSTANT: f64 = 1e-9;

impl<const N: usize> Dynamics<N> {
    /// Advances `situation` from time `t`, counted from the start, by `size` \[s\] under the imposed
    /// `motion` and `loads`, and adds up what `account` asks for.
    ///
    /// # Errors
    /// If the step needs more than 200000 internal steps.
    pub fn advance(
        &self,
        situation: &mut Situation<N>,
        motion: &Motion<N>,
        loads: &Loads,
        t: f64,
        size: f64,
        mut account: Account<'_, N>,
    ) -> Result<Impulse> {
        // A sample still sees the velocities before the jump of the rates.
        let mut until_sample = self.sample(&mut situation.state, loads.begin, t);
        let sample_time = if until_sample < f64::INFINITY { self.autopilot.sample_time } else { f64::INFINITY };
        let mut integrated = situation.integrated_state(self.base);
        let Situation { state, rotation, node } = situation;
        let (start, momentum) = (state.position, state.momentum);
        node.move_at(&motion.rate);
        state.contact = self.touches(&integrated, node, state.held);
        let mut context = StepContext {
            loads,
            elapsed: 0.0,
            held: state.held,
            contact: state.contact,
            sampled: state.sampled,
            motion: *motion,
        };
        let turning = self.fastest_turning(motion, size);
        let mut stuck = false;
        let mut room = None;
        while context.elapsed < size {
            let left = size - context.elapsed;
            let step = account.next(self, node, loads);
            (step.nodes[0], step.from) = (*node, integrated);
            self.law(&mut step.rates[0], &integrated, node, loads.present(context.elapsed, &mut room), &context);
            let longest = self.longest_internal_step(step, turning, context.contact);
            let most = MOST_STEPS * if sample_time < longest { sample_time } else { longest };
            if left > most {
                let turning = turning + TUMBLING * step.rates[0].pose.z.abs();
                return Err(self.too_long(size, most, turning, context.contact));
            }
            // A sample at the end belongs to the step that begins there.
            let piece = if until_sample < left - SAME_INSTANT { until_sample } else { left };
            let length = if piece > longest { piece / (piece / longest).ceil() } else { piece };
            let mut covered = length;
            self.internal_step(step, length, &context, (&mut integrated, node));
            // Right after switching, rounding must not switch back for ever.
            let within = if stuck { None } else { self.switches_within(step, (&integrated, node), &context) };
            if let Some(bracket) = within {
                covered = self.switching_instant(step, bracket, &context);
                self.internal_step(step, covered, &context, (&mut integrated, node));
                context.contact = !context.contact;
            }
            stuck = covered == 0.0;
            account.made(self, node, loads);
            // The last piece ends the step, whatever the sum of the pieces rounds to.
            if length == left && within.is_none() {
                break;
            }
            context.elapsed += covered;
            context.motion = motion.after(context.elapsed);
            until_sample -= covered;
            if until_sample <= 0.0 && context.elapsed < size {
                self.settle(state, &integrated, node);
                until_sample = self.sample(state, loads.present(context.elapsed, &mut room), t + context.elapsed);
                context.sampled = state.sampled;
                integrated.integrals = state.integrals;
            }
        }
        state.contact = context.contact;
        state.position = start + motion.way(size);
        if refreshed(t) != refreshed(t + size) {
            node.take(&self.vehicle, &state.position, state.held, &motion.rate_after(size));
            integrated.set_rotation(Rotation::by(integrated.pose.z));
        }
        *rotation = self.arm_rotation(&integrated);
        self.settle(state, &integrated, node);
        state.rate = motion.rate_after(size);
        let impulse = self.impulse(state, &momentum, &integrated, node, loads, size);
        if let Account::Carried(carried) = account
            && self.neglects_nothing()
        {
            carried.sum = state.momentum.z
                - momentum.z
                - impulse.torque
                - loads.present(0.5 * size, &mut room).base_torque * size;
        }
        Ok(impulse)
    }

    /// What a step of length `size` that began with the momentum `before` gave; on a carriage, writes momentum into
    /// `state`.
    pub(super) fn impulse(
        &self,
        state: &mut State<N>,
        before: &Vector3<f64>,
        integrated: &IntegratedState,
        node: &Node<N>,
        loads: &Loads,
        size: f64,
    ) -> Impulse {
        let mut impulse =
            Impulse { thrust: Vec2::zeros(), torque: integrated.torque_impulse, support: integrated.support_impulse };
        if self.on_carriage() {
            let h = node.matrix.of_base(self.base_velocity(integrated, Rotation::NONE, node)) + node.arm;
            impulse.thrust = vec2(0.0, h.linear.y - integrated.momentum.y);
            impulse.torque = h.angular - integrated.momentum.z;
            (state.momentum.y, state.momentum.z) = (h.linear.y, h.angular);
        } else {
            // What the momentum has gained, and no other force gave.
            let mut room = None;
            let load = loads.present(0.5 * size, &mut room);
            let others = load.base_force + load.tip_force + vec2(0.0, -node.matrix.mass * self.vehicle.gravity);
            impulse.thrust = (state.momentum - before).xy() - others * size - vec2(0.0, impulse.support);
        }
        impulse
    }

    /// Writes pose, momentum, integrals and velocities into `state`.
    pub(super) fn settle(&self, state: &mut State<N>, integrated: &IntegratedState, node: &Node<N>) {
        let rotation = self.arm_rotation(integrated);
        state.pose = integrated.pose;
        state.momentum = integrated.momentum;
        state.integrals = integrated.integrals;
        state.velocity = in_inertial_frame(rotation, self.base_velocity(integrated, rotation, node));
        state.rate = node.rate;
    }

    /// Takes a sample of a sampled autopilot if it is due at time `t`; how long until the next one \[s\].
    ///
    /// A sample sees the integral over the samples before it, by rectangles.
    pub(super) fn sample(&self, state: &mut State<N>, load: &Load, t: f64) -> f64 {
        let interval = self.autopilot.sample_time;
        if self.autopilot.mode != AutopilotMode::Pid || interval == 0.0 {
            return f64::INFINITY;
        }
        if t >= instant(state.samples, interval) - SAME_INSTANT {
            let error = load.error(state.pose.y, state.pose.z);
            state.sampled = self.hover_law(error, &state.velocity, state.integrals, load);
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // times are not negative
            let passed = ((t + SAME_INSTANT) / interval) as u64;
            let samples = passed.max(state.samples) + 1;
            // Samples that a long explicit step has left out count with this one.
            let covered = instant(samples, interval) - instant(state.samples, interval);
            state.integrals += error * covered;
            state.samples = samples;
        }
        instant(state.samples, interval) - t
    }

    /// Fastest turning at the rates `rate`, relative to the UAV \[rad/s\].
    pub(super) fn turning(&self, rate: &SVector<f64, N>) -> f64 {
        let vehicle = &self.vehicle;
        let arm = (0..N).map(|i| rate[i].abs() * vehicle.revolute[i]).sum::<f64>();
        match vehicle.balancer {
            // A balanced disc that turns changes nothing that is integrated.
            Some(Balancer::Element(body)) if body.first != 0.0 => arm.max(rate[N - 1].abs()),
            _ => arm,
        }
    }

    /// Fastest turning in a step of length `size` under the imposed `motion` \[rad/s\].
    #[inline(never)]
    fn fastest_turning(&self, motion: &Motion<N>, size: f64) -> f64 {
        let turning = self.turning(&motion.rate);
        if motion.is_steady() { turning } else { turning.max(self.turning(&motion.rate_after(size))) }
    }

    /// The longest internal step that resolves autopilot, support and the `turning` of the links.
    #[inline]
    fn longest_internal_step(&self, step: &Internal<N>, turning: f64, contact: bool) -> f64 {
        let turning = turning + TUMBLING * step.rates[0].pose.z.abs();
        let fastest = if turning > self.control_rate { turning } else { self.control_rate };
        let longest = LONGEST_INTERNAL_STEP.min(RESOLUTION / fastest);
        if contact { self.longest_on_support(step, longest) } else { longest }
    }

    /// The longest internal step, at most `longest`, that resolves how the system swings on the support.
    #[inline(never)]
    fn longest_on_support(&self, step: &Internal<N>, longest: f64) -> f64 {
        let (vehicle, Internal { nodes: [node, _], from: integrated, rates: [k_1, ..], .. }) = (&self.vehicle, step);
        let inverse_mass = vehicle.masses(true).inverse_mass;
        // The support feels the mass of the system and, at a lever, its inertia.
        let lever = node.posture.payload.x;
        let mobility = inverse_mass + lever * lever / vehicle.uav_inertia;
        let swinging = (self.support.stiffness * mobility).sqrt();
        let gap_rate = self.gap_rate(self.arm_rotation(integrated), node, &k_1.pose);
        let speed = gap_rate.abs() + k_1.momentum.y.abs() * inverse_mass / swinging;
        // Mostly the step is short enough: that is seen without the roots below, which take a tenth of a step.
        let resolved = longest * swinging;
        let square = resolved * resolved;
        let fine = SUPPORT_RESOLUTION * SUPPORT_RESOLUTION;
        if resolved <= COARSEST_SUPPORT_RESOLUTION && speed * (square * square) <= fine * fine {
            return longest;
        }
        let resolution = (SUPPORT_RESOLUTION / speed.sqrt().sqrt()).min(COARSEST_SUPPORT_RESOLUTION);
        longest.min(resolution / swinging)
    }
}

/// How often turns have been refreshed up to time `t` \[s\].
#[allow(clippy::cast_possible_truncation)] // saturates in late times that nobody reaches
pub(super) fn refreshed(t: f64) -> i64 {
    (t * REFRESHED) as i64
}

/// When the autopilot takes its sample with this number, counted from 0 \[s\].
#[allow(clippy::cast_precision_loss)] // 2^53 samples take centuries
fn instant(number: u64, interval: f64) -> f64 {
    number as f64 * interval
}
