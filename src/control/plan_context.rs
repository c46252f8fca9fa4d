//! What a plan starts from, and what its methods share.

use nalgebra::SVector;

use super::clock::Clock;
use super::damping::MomentDamping;
use super::prediction::Prediction;
use super::resolution::{Aims, Interval, MethodState, Problem, Resolved, Resolver, Task};
use super::response::Response;
use crate::bytes::{Memory, Tape};
use crate::control::qp::Places;
use crate::mechanics::dynamics::{Dynamics, Motion, Node, Situation, State};
use crate::mechanics::momentum::Twist;
use crate::mechanics::planar::{Rotation, Vec2};
use crate::parameters::Hold;
use crate::pass;

/// The laws, the method and the present.
#[derive(Debug, Clone)]
pub(super) struct PlanContext<const N: usize> {
    pub dynamics: Dynamics<N>,
    pub resolver: Resolver,
    pub hold: Hold,
    /// The prediction; in a box, to be exchanged for another one without copying.
    pub now: Box<Prediction<N>>,
    /// Rates and accelerations sent.
    pub motion: Motion<N>,
    /// Motions of the five plans before, the last one first.
    pub earlier_motions: [Motion<N>; 5],
    /// What the method remembers.
    pub method_state: MethodState,
    /// Damping of the free motion.
    pub damping: MomentDamping,
    /// The impulse that the UAV has got beyond what was wanted: plans held for other times than they were made for
    /// leave one, and the next plan gives it back \[N m s\].
    pub owed: f64,
}

impl<const N: usize> PlanContext<N> {
    /// How the system answers to the rates that the resolution may use, where the arm is at `node` and turned by
    /// `rotation`, with the momentum of `state`.
    #[inline]
    pub fn response(&self, node: &Node<N>, rotation: Rotation, state: &State<N>) -> Response<N> {
        Response::new(&self.dynamics, node, rotation, state.momentum_in(rotation), self.resolver.holds_balancer)
    }

    /// What is asked of the moment where the system answers with `response`, so that at the end of the interval what the
    /// UAV carries has the angular momentum `carried` if no moment is exerted on the UAV \[N m s\].
    pub fn moment_task(&self, response: &Response<N>, carried: f64) -> Task<N> {
        let undamped = carried + self.owed - response.carried_free;
        Task { row: response.carried, value: self.damping.damped(undamped) }
    }

    /// The rates that the method chooses for the interval of the `clock`, which begins now. `guess`: which of them will
    /// probably be at their limits, if an iteration has told; `aims`: whether more counts than the path.
    pub fn solve(&self, problem: &Problem<N>, clock: &Clock, guess: Option<&Places>, aims: Aims) -> Resolved<N> {
        let interval = Interval {
            beginning: &self.now.situation,
            previous_rate: &self.motion.rate,
            previous_duration: clock.previous_duration,
            hold: clock.longest_hold(),
            state: &self.method_state,
            guess,
            aims,
        };
        self.resolver.solve(&self.dynamics.vehicle, &interval, problem)
    }

    /// Whether a coordinate could pass its stop if the present rates were held as long as the `clock` makes possible.
    pub fn must_brake(&self, clock: &Clock) -> bool {
        let position = &self.now.situation.state.position;
        self.resolver.must_brake(position.as_slice(), self.motion.rate.as_slice(), clock.longest_hold())
    }

    /// From the present rates to the rates `last` in the interval of the `clock`, linearly; less far where they would exceed
    /// their limits if that went on for as long as is possible.
    pub fn accelerating_to(&self, last: &SVector<f64, N>, clock: &Clock) -> Motion<N> {
        let first = self.resolver.within_limits(self.motion.rate);
        let (mut motion, hold) = (Motion { rate: first, slope: (last - first) / clock.horizon }, clock.longest_hold());
        let farthest = motion.rate_after(hold);
        if !self.resolver.admits(&farthest) {
            motion.slope = (self.resolver.clamped(farthest) - first) / hold;
        }
        motion
    }

    /// Velocity of the end effector in the `situation`, where the base moves with `base` (axes of the UAV frame);
    /// inertial frame \[m/s\].
    pub fn end_effector_velocity(&self, Situation { node, rotation, .. }: &Situation<N>, base: Twist) -> Vec2 {
        self.dynamics.velocity_at(node, *rotation, node.posture.end_effector, base)
    }

    /// Brings `end`, which has begun an explicit step in `here`, to its end at the rates `rate`, to which the system
    /// answers with `response`, over this `displacement` of the coordinates; the step takes `size` from time `t`.
    pub fn end_explicit(
        &self,
        here: &Situation<N>,
        response: &Response<N>,
        rate: &SVector<f64, N>,
        displacement: &SVector<f64, N>,
        [t, size]: [f64; 2],
        end: &mut Prediction<N>,
    ) {
        self.dynamics.end_explicit(here, rate, displacement, [t, size], &mut end.situation);
        end.carried = response.carried_momentum(rate);
    }
}

impl<const N: usize> Memory for PlanContext<N> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        // Without "..": whoever adds a field decides here whether it follows from the parameters.
        let Self { dynamics, resolver: _, hold: _, now, motion, earlier_motions, method_state, damping, owed } = self;
        dynamics.pass_gains(tape);
        pass!(tape: now, motion, earlier_motions, method_state, damping, owed);
    }
}
