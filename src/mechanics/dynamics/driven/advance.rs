//! A step of any length where joints are driven, as `dynamics::advance` makes it where all rates are imposed.

use super::butcher::DrivenState;
use super::{Driven, Torques};
use crate::error::Result;
use crate::mechanics::dynamics::advance::{MOST_STEPS, SAME_INSTANT, TUMBLING};
use crate::mechanics::dynamics::contact::{NO_GAP, lowest, switching_instant};
use crate::mechanics::dynamics::law::StepContext;
use crate::mechanics::dynamics::{Account, Dynamics, Impulse, Loads, Motion, Node, Situation, in_inertial_frame};
use crate::mechanics::planar::{Rotation, vec2};

/// Longest internal step \[s\]: light links that start to swing are faster than their rates tell.
const LONGEST_INTERNAL_STEP: f64 = 0.53e-3;

/// Longest internal step times the fastest rate of control, support or turning.
const RESOLUTION: f64 = 0.02;

impl<const N: usize> Dynamics<N> {
    /// Advances `situation` and the momenta about the `driven` joints from time `t`, counted from the start, by
    /// `size` \[s\]; `motion` has no part of the driven joints.
    ///
    /// # Errors
    /// If the step needs more than 200000 internal steps.
    #[allow(clippy::too_many_arguments)] // as many things act
    #[inline(never)]
    pub fn advance_driven(
        &self,
        situation: &mut Situation<N>,
        driven: &mut Driven<N>,
        motion: &Motion<N>,
        torques: &Torques<N>,
        loads: &Loads,
        t: f64,
        size: f64,
        account: Account<'_, N>,
    ) -> Result<Impulse> {
        let mut until_sample = self.sample(&mut situation.state, loads.begin, t);
        let sample_time = if until_sample.is_finite() { self.autopilot.sample_time } else { f64::INFINITY };
        let mut driven_state = DrivenState::new(situation.integrated_state(self.base));
        let Situation { state, rotation, node } = situation;
        let (start, before) = (state.position, state.momentum);
        // Momenta stay where imposed rates and masses jump: the rates of the driven joints jump along.
        node.move_at(&motion.rate);
        self.move_driven(node, driven, self.momentum_in_uav(&driven_state.integrated), &driven.momentum);
        state.contact = self.touches(&driven_state.integrated, node, state.held);
        let mut elapsed = 0.0;
        let mut stuck = false;
        let mut room = None;
        while elapsed < size {
            let left = size - elapsed;
            let context = StepContext {
                loads,
                elapsed,
                held: state.held,
                contact: state.contact,
                sampled: state.sampled,
                motion: motion.after(elapsed),
            };
            let longest = self.longest_driven_step(&driven_state, node, driven, state.contact);
            let most = MOST_STEPS * longest.min(sample_time);
            if left > most {
                return Err(self.too_long(size, most, self.turning(&node.rate), state.contact));
            }
            let piece = if until_sample < left - SAME_INSTANT { until_sample } else { left };
            let length = if piece > longest { piece / (piece / longest).ceil() } else { piece };
            let after = |length: f64| self.driven_step(&driven_state, node, length, &context, (driven, torques));
            let margin = |(driven_state, node): &(DrivenState<N>, Node<N>)| {
                self.margin(&driven_state.integrated, node, &context)
            };
            let mut covered = length;
            let mut step = after(length);
            let within =
                if stuck { None } else { self.switches(&(driven_state, *node), &step, length, &context, &after) };
            if let Some(bracket) = within {
                let begin = self.margin(&driven_state.integrated, node, &context);
                covered = switching_instant(begin, bracket, &|length| margin(&after(length)));
                step = after(covered);
                state.contact = !state.contact;
            }
            stuck = covered == 0.0;
            elapsed = if length == left && within.is_none() { size } else { elapsed + covered };
            until_sample -= covered;
            (driven_state, *node) = step;
            if until_sample <= 0.0 && elapsed < size {
                self.settle(state, &driven_state.integrated, node);
                until_sample = self.sample(state, loads.present(elapsed, &mut room), t + elapsed);
                driven_state.integrated.integrals = state.integrals;
            }
        }
        state.position = start + motion.way(size) + driven_state.way;
        let rate = node.rate;
        node.take(&self.vehicle, &state.position, state.held, &rate);
        driven_state.integrated.set_rotation(Rotation::by(driven_state.integrated.pose.z));
        *rotation = self.arm_rotation(&driven_state.integrated);
        self.settle(state, &driven_state.integrated, node);
        driven.momentum += driven.part(&(driven_state.outboard + torques.impulse(size)));
        if let Account::Outboard(outboard) = account {
            outboard.add(&driven_state.outboard);
        }
        Ok(self.impulse(state, &before, &driven_state.integrated, node, loads, size))
    }

    /// Length of an internal step within which contact switches, if it does; as for imposed rates.
    fn switches(
        &self,
        begin: &(DrivenState<N>, Node<N>),
        end: &(DrivenState<N>, Node<N>),
        size: f64,
        context: &StepContext<'_, N>,
        after: &dyn Fn(f64) -> (DrivenState<N>, Node<N>),
    ) -> Option<f64> {
        if !context.held || self.support.stiffness == 0.0 {
            return None;
        }
        let margin =
            |(driven_state, node): &(DrivenState<N>, Node<N>)| self.margin(&driven_state.integrated, node, context);
        let rate = |(driven_state, node): &(DrivenState<N>, Node<N>)| {
            let rotation = self.arm_rotation(&driven_state.integrated);
            let velocity = in_inertial_frame(rotation, self.base_velocity(&driven_state.integrated, rotation, node));
            context.side() * self.gap_rate(rotation, node, &velocity)
        };
        if margin(end) < -NO_GAP {
            return Some(size);
        }
        let dip = lowest([margin(begin).max(0.0), margin(end)], [rate(begin), rate(end)], size)?;
        (margin(&after(dip)) < -NO_GAP).then_some(dip)
    }

    /// The longest internal step that resolves autopilot, support and turning.
    fn longest_driven_step(
        &self,
        driven_state: &DrivenState<N>,
        node: &Node<N>,
        driven: &Driven<N>,
        contact: bool,
    ) -> f64 {
        let rotation = self.arm_rotation(&driven_state.integrated);
        let roll_rate = self.base_velocity(&driven_state.integrated, rotation, node).angular;
        let turning = self.turning(&node.rate) + TUMBLING * roll_rate.abs();
        let mut fastest = turning.max(self.control_rate);
        if contact {
            let mobility = self.payload_mobility(node, driven, rotation.undo(vec2(0.0, 1.0)));
            fastest = fastest.max((self.support.stiffness * mobility).sqrt());
        }
        LONGEST_INTERNAL_STEP.min(RESOLUTION / fastest)
    }
}
