//! When to plan, what to hold, and what to tell the host.
//!
//! At a communication point the controller plans the rates for the coming interval and holds them until
//! the next sample instant, while the prediction advances by the host's real steps with the rates sent.

use nalgebra::SVector;

use super::clock::Clock;
use super::damping::MomentDamping;
use super::foreseen::Foreseen;
use super::plan::Plan;
use super::plan_context::PlanContext;
use super::prediction::Prediction;
use super::resolution::{MethodState, Resolver};
use super::{Inputs, OutputDerivatives, Outputs, Planner};
use crate::autopilot::AutopilotMode;
use crate::bytes::{Memory, Tape};
use crate::error::Result;
use crate::mechanics::dynamics::{Dynamics, Load, Motion};
use crate::mechanics::planar::Vec2;
use crate::parameters::{Discretization, Hold, Parameters, Structure};
use crate::pass;
use crate::reference::Target;

/// Times this close are the same \[s\]: hosts add up their steps.
const SAME_TIME: f64 = 1e-9;

/// Inverse kinematics of an aerial manipulator with `N` coordinates, with its prediction.
#[derive(Debug, Clone)]
pub struct Controller<const N: usize> {
    context: PlanContext<N>,
    /// Accelerations sent at the communication point before.
    previous_slope: SVector<f64, N>,
    discretization: Discretization,
    clock: Clock,
    grasp_time: f64,
    foreseen: Foreseen,
    /// Where the reference was expected at the end of the planned interval.
    planned_target: Target,
    /// How far the end of the planned interval was off the reference \[m\].
    planned_miss: Vec2,
    /// The mean moment of the present plan on the UAV, without what it gives back \[N m\]; none if it had to give up what
    /// was wanted of the moment.
    lasting_moment: Option<f64>,
    /// The prediction at the end of the planned interval, as long as that is untouched: nothing of it has passed,
    /// and the laws are those of the plan.
    planned_end: Box<Prediction<N>>,
    untouched: bool,
    /// When the planned interval begins, from the start \[s\].
    planned_at: f64,
}

impl<const N: usize> Controller<N> {
    /// At the start, with nothing planned.
    ///
    /// # Errors
    /// If the parameters do not go together.
    pub fn new(structure: Structure, parameters: &Parameters) -> Result<Self> {
        let ik = &parameters.ik;
        let mut dynamics = Dynamics::new(structure, parameters, ik.base_model)?;
        // Of an autopilot outside, the pid law with the same gains is the best guess.
        if dynamics.autopilot.mode == AutopilotMode::External {
            dynamics.set_mode(AutopilotMode::Pid);
        }
        let now = Box::new(Prediction::at_rest(dynamics.start(parameters)));
        let (origin, planned_end) = (now.end_effector(), now.clone());
        Ok(Self {
            context: PlanContext {
                resolver: Resolver::new(structure, parameters, dynamics.vehicle.reach()),
                hold: ik.hold,
                motion: Motion::constant(SVector::zeros()),
                earlier_motions: [Motion::constant(SVector::zeros()); 5],
                method_state: MethodState::START,
                dynamics,
                now,
                damping: MomentDamping::new(ik),
                owed: 0.0,
            },
            discretization: ik.discretization,
            clock: Clock::new(ik.sample_time),
            grasp_time: parameters.payload.grasp_time,
            foreseen: Foreseen::new(parameters.reference.clone(), origin),
            previous_slope: SVector::zeros(),
            planned_end,
            untouched: false,
            planned_at: 0.0,
            planned_target: Target { displacement: origin, ..Target::AT_REST },
            planned_miss: Vec2::zeros(),
            lasting_moment: None,
        })
    }

    /// Takes the payload over in the prediction if it is time: the host is told at the same instant.
    fn grasp_in_time(&mut self, t: f64) {
        let PlanContext { dynamics, now, .. } = &mut self.context;
        if t >= self.grasp_time - SAME_TIME && !now.situation.state.held {
            dynamics.grasp(&mut now.situation);
        }
    }

    /// Plans the interval from time `t` on, where the reference is at `wanted` and was foreseen at `expected` \[m\].
    fn plan(&mut self, t: f64, wanted: &Target, expected: Vec2, outputs: &mut Outputs) -> Result<()> {
        let Self { context, planned_end: end, clock, .. } = self;
        let horizon = clock.horizon;
        let target = self.foreseen.at(t + horizon);
        context.damping.prepare(horizon);
        let mut plan = match self.discretization {
            Discretization::Exact => context.plan_towards(t, clock, expected, wanted.displacement, target, end)?,
            Discretization::Euler if context.resolver.accelerates() => {
                context.accelerate_euler(t, clock, wanted.acceleration, end)
            }
            Discretization::Euler => context.plan_euler(t, clock, target.velocity, end),
        };
        plan.check(t)?;
        end.situation.state.check(t)?;
        self.planned_miss = context.resolver.followed(target.displacement - end.end_effector());
        self.planned_target = *target;
        context.damping.momentum = plan.momentum;
        if plan.moment_is_met() {
            self.lasting_moment = Some(plan.moment_residual + context.owed / horizon);
        } else {
            (self.lasting_moment, context.owed) = (None, 0.0);
        }
        plan.admit_miss(self.planned_miss.norm());
        if self.discretization == Discretization::Exact {
            context.earlier_motions.rotate_right(1);
            context.earlier_motions[0] = plan.motion;
        }
        context.motion = plan.motion;
        context.method_state.accept(plan.places);
        (self.planned_at, self.untouched) = (t, true);
        outputs.status = plan.status;
        outputs.min_singular_value = plan.min_singular_value;
        outputs.velocity_residual = plan.velocity_residual;
        outputs.moment_residual = plan.moment_residual;
        Ok(())
    }

    /// Advances the prediction by `size` \[s\] at the rates sent.
    fn predict(&mut self, t: f64, size: f64) -> Result<()> {
        let Self { context, planned_end: end, .. } = self;
        // The plan has already been there, if the host makes the step that it was made for; samples of the autopilot are
        // taken by the clock, which may have been rounded.
        if !self.untouched || size != self.clock.horizon || (t != self.planned_at && context.dynamics.is_sampled()) {
            let mut step = Plan::moving(context.motion);
            if self.discretization == Discretization::Euler {
                step.moment_residual = context.predict_euler(t, size, end) / size;
            } else {
                context.carry_out(&mut step, t, size, end)?;
            }
            end.situation.state.check(t + size)?;
            if let Some(lasting) = self.lasting_moment {
                context.owed += (step.moment_residual - lasting) * size;
            }
        } else if self.lasting_moment.is_some() {
            context.owed = 0.0;
        }
        std::mem::swap(&mut context.now, end);
        context.damping.advance(size, self.lasting_moment.is_some());
        self.clock.advance(size);
        self.untouched = false;
        self.previous_slope = context.motion.slope;
        context.motion = context.motion.after(size);
        Ok(())
    }

    fn write_prediction(&self, wanted: &Target, outputs: &mut Outputs) {
        let PlanContext { now, motion, .. } = &self.context;
        let state = &now.situation.state;
        outputs.rate_command[..N].copy_from_slice(motion.rate.as_slice());
        outputs.acceleration_command[..N].copy_from_slice(motion.slope.as_slice());
        outputs.grasp = state.held;
        outputs.reference = wanted.displacement;
        outputs.reference_velocity = wanted.velocity;
        outputs.predicted_pose = state.pose;
        outputs.predicted_velocity = state.velocity;
        outputs.predicted_position[..N].copy_from_slice(state.position.as_slice());
        outputs.predicted_end_effector = now.end_effector();
    }
}

impl<const N: usize> Memory for Controller<N> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        // Without "..": whoever adds a field decides here whether it follows from the parameters.
        let Self {
            context,
            previous_slope,
            discretization: _,
            clock,
            grasp_time: _,
            foreseen,
            planned_target,
            planned_miss,
            lasting_moment,
            planned_end,
            untouched,
            planned_at,
        } = self;
        pass!(tape: context, previous_slope, clock, foreseen, planned_target, planned_miss, lasting_moment);
        pass!(tape: planned_end, untouched, planned_at);
    }
}

impl<const N: usize> Planner for Controller<N> {
    fn begin(&mut self, outputs: &mut Outputs) -> Result<()> {
        *outputs = Outputs::default();
        self.grasp_in_time(0.0);
        // How long the host's steps are is not known yet: a ramp might be held far beyond its end.
        let hold = std::mem::replace(&mut self.context.hold, Hold::ZeroOrder);
        let wanted = *self.foreseen.at(0.0);
        self.plan(0.0, &wanted, wanted.displacement, outputs)?;
        self.context.hold = hold;
        self.write_prediction(&wanted, outputs);
        Ok(())
    }

    fn tune(&mut self, parameters: &Parameters) {
        let others = self.context.dynamics.tune(&parameters.autopilot);
        self.context.resolver.tune(parameters);
        self.context.damping.tune(&parameters.ik);
        // What was planned with was predicted by other laws.
        self.untouched &= !others;
    }

    fn step(&mut self, inputs: &Inputs, t: f64, size: f64, outputs: &mut Outputs) -> Result<()> {
        self.predict(t, size)?;
        let now = t + size;
        self.grasp_in_time(now);
        self.foreseen.take(inputs, t, size);
        let wanted = *self.foreseen.at(now);
        if self.clock.is_due() || self.context.must_brake(&self.clock) {
            let expected = self.planned_target.after(self.clock.since_plan - self.clock.horizon).displacement;
            let miss = self.context.resolver.followed(wanted.displacement - self.context.now.end_effector());
            outputs.late_miss = (miss - self.planned_miss).norm();
            self.clock.begin_interval(size);
            self.plan(now, &wanted, expected, outputs)?;
        }
        self.write_prediction(&wanted, outputs);
        Ok(())
    }

    fn output_derivatives(&self, t: f64) -> OutputDerivatives {
        let PlanContext { dynamics, now, .. } = &self.context;
        let now = &now.situation;
        let mut derivatives = OutputDerivatives {
            reference_velocity: self.foreseen.acceleration(t),
            predicted_end_effector: self.context.end_effector_velocity(now, now.base()),
            predicted_velocity: dynamics.at_end(now, &self.previous_slope, &Load::NONE).acceleration,
            ..OutputDerivatives::default()
        };
        derivatives.predicted_position[..N].copy_from_slice(now.state.rate.as_slice());
        derivatives
    }

    fn check_memory(&self) -> Result<()> {
        self.context.dynamics.check_gains()?;
        self.context.now.check_memory()?;
        self.planned_end.check_memory()?;
        self.context.damping.check_memory()?;
        self.clock.check_memory()
    }

    fn clone_box(&self) -> Box<dyn Planner> {
        Box::new(self.clone())
    }
}
