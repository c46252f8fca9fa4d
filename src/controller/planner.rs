//! When to plan, what to hold, and what to tell the host.
//!
//! At a communication point the controller plans the rates for the coming interval and holds them until
//! the next sample instant, while the prediction advances by the host's real steps with the rates sent.

use nalgebra::SVector;

use super::limits::Allowed;
use super::prediction::Prediction;
use super::resolution::Resolver;
use super::response::Response;
use super::{Inputs, Outputs, Planner, Rates, Status};
use crate::autopilot::AutopilotMode;
use crate::bytes::{Memory, Tape};
use crate::dynamics::{Account, Dynamics, Load, Loads, Motion, Situation};
use crate::error::{Error, Result};
use crate::options::Choice;
use crate::parameters::{Discretization, Hold, Parameters, Resolution, Structure};
use crate::planar::Vec2;
use crate::qp::{self, Place, Places};
use crate::reference::{Reference, ReferenceKind, Target};

/// Sample instants this share of a sample time ahead are reached.
const SAME_INSTANT: f64 = 1e-6;

/// Times this close are the same \[s\]: hosts add up their steps.
const SAME_TIME: f64 = 1e-9;

/// What a plan has left over, for instance beyond reach, is made good at this speed at most \[m/s\].
const CATCHING_UP: f64 = 0.2;

/// What an external reference moves beyond what was foreseen is followed at this speed at most \[m/s\].
const UNFORESEEN: f64 = 2.0;

/// A target nearer than this is not said to be out of what one interval may make good \[m\].
const SHORTENED: f64 = 1e-9;

/// Rates for one interval.
#[derive(Debug, Clone)]
pub(super) struct Plan<const N: usize> {
    pub motion: Motion<N>,
    pub status: Status,
    /// Which rates are at their limits.
    pub places: Places,
    pub min_singular_value: f64,
    pub velocity_residual: f64,
    pub moment_residual: f64,
    /// The prediction at the end of the interval.
    pub end: Prediction<N>,
}

impl<const N: usize> Plan<N> {
    /// A plan to be made: so far it is where `now` is, in this motion.
    pub fn moving(motion: Motion<N>, now: Prediction<N>) -> Self {
        Self {
            motion,
            status: Status::Ok,
            places: qp::FREE,
            min_singular_value: 0.0,
            velocity_residual: 0.0,
            moment_residual: 0.0,
            end: now,
        }
    }

    /// Whether all that the host will see of it is finite.
    fn check(&self, t: f64) -> Result<()> {
        let values = [self.velocity_residual, self.moment_residual, self.min_singular_value];
        let Motion { rate, slope } = &self.motion;
        if let Some(&value) = rate.iter().chain(slope).chain(&values).find(|value| !value.is_finite()) {
            return Err(Error::NotFinite { quantity: "planned rate or residual", value, time: t });
        }
        self.end.situation.state.check(t)
    }
}

/// Inverse kinematics of an aerial manipulator with `N` coordinates, with its prediction.
#[derive(Debug, Clone)]
pub struct Controller<const N: usize> {
    pub(super) dynamics: Dynamics<N>,
    pub(super) resolver: Resolver<N>,
    /// The prediction.
    pub(super) now: Prediction<N>,
    /// Rates and accelerations sent.
    pub(super) motion: Motion<N>,
    /// Accelerations sent at the communication point before.
    slope_before: SVector<f64, N>,
    /// Rates of the plan before.
    pub(super) rate_before: SVector<f64, N>,
    /// Which rates are at their limits.
    pub(super) places: Places,
    discretization: Discretization,
    pub(super) hold: Hold,
    sample_time: f64,
    grasp_time: f64,
    reference: Reference,
    /// Where the end effector starts.
    origin: Vec2,
    /// Where the reference was expected at the end of the planned interval.
    aim: Vec2,
    /// When the last plan was made, from the start, and for how long.
    planned_at: f64,
    horizon: f64,
    /// The prediction at the end of the planned interval.
    planned_end: Prediction<N>,
}

impl<const N: usize> Controller<N> {
    /// At the start, with the first interval planned and the outputs written.
    ///
    /// # Errors
    /// If the parameters do not go together.
    pub fn new(structure: Structure, parameters: &Parameters, outputs: &mut Outputs) -> Result<Self> {
        let mut controller = Self::without_plan(structure, parameters)?;
        // Measurements and external references act from the first step on.
        let here = Inputs { position: controller.origin, ..Inputs::default() };
        *outputs = Outputs::default();
        controller.grasp_in_time(0.0);
        // How long the host's steps are is not known yet: a ramp might be held far beyond its end.
        let hold = std::mem::replace(&mut controller.hold, Hold::ZeroOrder);
        controller.plan(0.0, &here, outputs)?;
        controller.hold = hold;
        controller.write_prediction(0.0, &here, outputs);
        Ok(controller)
    }

    /// At the start, with nothing planned.
    ///
    /// # Errors
    /// If the parameters do not go together.
    pub fn without_plan(structure: Structure, parameters: &Parameters) -> Result<Self> {
        let ik = &parameters.ik;
        check_method(structure, parameters)?;
        let mut dynamics = Dynamics::new(structure, parameters, ik.base_model)?;
        // Of an autopilot outside, the pid law with the same gains is the best guess.
        if dynamics.autopilot.mode == AutopilotMode::External {
            dynamics.set_mode(AutopilotMode::Pid);
        }
        let now = Prediction::at_rest(dynamics.start(parameters));
        let origin = now.end_effector();
        Ok(Self {
            resolver: Resolver::new(&dynamics.vehicle, parameters),
            discretization: ik.discretization,
            hold: ik.hold,
            sample_time: ik.sample_time,
            grasp_time: parameters.payload.grasp_time,
            reference: parameters.reference.clone(),
            motion: Motion::constant(SVector::zeros()),
            slope_before: SVector::zeros(),
            rate_before: SVector::zeros(),
            places: qp::FREE,
            planned_at: 0.0,
            horizon: ik.sample_time,
            planned_end: now,
            dynamics,
            now,
            origin,
            aim: origin,
        })
    }

    fn tune(&mut self, parameters: &Parameters) {
        self.dynamics.tune(&parameters.autopilot);
        self.resolver = Resolver::new(&self.dynamics.vehicle, parameters);
    }

    /// Takes the payload over in the prediction if it is time: the host is told at the same instant.
    fn grasp_in_time(&mut self, t: f64) {
        if t >= self.grasp_time - SAME_TIME && !self.now.situation.state.held {
            self.dynamics.grasp(&mut self.now.situation);
        }
    }

    /// How the end effector moves, just before any jump of the rates now.
    fn end_effector_velocity(&self) -> Vec2 {
        let situation = &self.now.situation;
        let Situation { turn, node, .. } = situation;
        turn.apply(node.velocity_at(&self.dynamics.vehicle, node.posture.end_effector, situation.base()))
    }

    /// Plans the interval from time `t` on.
    fn plan(&mut self, t: f64, inputs: &Inputs, outputs: &mut Outputs) -> Result<()> {
        let target = self.target(t, self.horizon, inputs);
        let plan = match self.discretization {
            Discretization::Exact => self.plan_towards(t, &target, inputs)?,
            Discretization::Euler => self.plan_euler(t, self.horizon, target.velocity),
        };
        plan.check(t)?;
        self.aim = target.displacement;
        self.rate_before = std::mem::replace(&mut self.motion, plan.motion).rate;
        self.places = plan.places;
        self.planned_at = t;
        self.planned_end = plan.end;
        outputs.status = plan.status;
        outputs.min_singular_value = plan.min_singular_value;
        outputs.velocity_residual = plan.velocity_residual;
        outputs.moment_residual = plan.moment_residual;
        Ok(())
    }

    /// A plan that brings the end effector onto the `target`, or as near to it as it may come in one interval.
    fn plan_towards(&self, t: f64, target: &Target, inputs: &Inputs) -> Result<Plan<N>> {
        let (here, now) = (self.now.end_effector(), self.target(t, 0.0, inputs).displacement);
        let left_over = (self.aim - here).cap_magnitude(CATCHING_UP * self.horizon);
        let unforeseen = (now - self.aim).cap_magnitude(UNFORESEEN * self.horizon);
        let nearer = Target {
            displacement: here + left_over + unforeseen + (target.displacement - now),
            velocity: target.velocity + (left_over + unforeseen) / self.horizon,
            ..*target
        };
        let mut plan = self.plan_exact(t, self.horizon, &nearer)?;
        let missing = target.displacement - plan.end.end_effector();
        plan.velocity_residual = missing.norm() / self.horizon;
        let shortened = (now - here) - (left_over + unforeseen);
        if plan.status == Status::Ok && shortened != Vec2::zeros() && missing.norm() > SHORTENED {
            plan.status = Status::CatchingUp;
        }
        Ok(plan)
    }

    /// The wanted motion `ahead` \[s\] after time `t`, its displacement from the origin of the inertial frame.
    fn target(&self, t: f64, ahead: f64, inputs: &Inputs) -> Target {
        if self.reference.kind == ReferenceKind::External {
            let (v, a) = (inputs.velocity, inputs.acceleration);
            return Target {
                displacement: inputs.position + (v + a * (0.5 * ahead)) * ahead,
                velocity: v + a * ahead,
                acceleration: a,
            };
        }
        let mut target = self.reference.at(t + ahead);
        target.displacement += self.origin;
        target
    }

    /// What the limits allow in an interval of length `horizon` that begins now.
    pub(super) fn allowed(&self, horizon: f64) -> Allowed {
        self.resolver.allowed(&self.dynamics.vehicle, &self.now.situation, &self.motion.rate, horizon)
    }

    /// How the system answers to the rates that the resolution may use.
    pub(super) fn response(&self, situation: &Situation<N>) -> Response<N> {
        let vehicle = &self.dynamics.vehicle;
        let response = Response::new(&self.dynamics, situation);
        let held = vehicle.balancer.is_some() && !self.resolver.moves_balancer(vehicle);
        if held { response.holding(N - 1) } else { response }
    }

    /// Advances the prediction by `size` \[s\] at the rates sent.
    fn predict(&mut self, t: f64, size: f64) -> Result<()> {
        // The plan has already been there, if the host makes the step that it was made for.
        self.now = if size == self.horizon && (t - self.planned_at).abs() < SAME_TIME {
            self.planned_end
        } else if self.discretization == Discretization::Euler {
            self.predict_euler(t, size)
        } else {
            let mut end = self.now.situation;
            self.dynamics.advance(&mut end, &self.motion, &Loads::CALM, t, size, Account::None)?;
            Prediction::at_end(&self.dynamics, end)
        };
        self.slope_before = self.motion.slope;
        self.motion = self.motion.after(size);
        self.now.situation.state.check(t + size)
    }

    fn write_prediction(&self, t: f64, inputs: &Inputs, outputs: &mut Outputs) {
        let state = &self.now.situation.state;
        let now = self.target(t, 0.0, inputs);
        outputs.rate_command[..N].copy_from_slice(self.motion.rate.as_slice());
        outputs.acceleration_command[..N].copy_from_slice(self.motion.slope.as_slice());
        outputs.grasp = state.held;
        outputs.reference = now.displacement;
        outputs.reference_velocity = now.velocity;
        outputs.predicted_pose = state.pose;
        outputs.predicted_velocity = state.velocity;
        outputs.predicted_position[..N].copy_from_slice(state.position.as_slice());
        outputs.predicted_end_effector = self.now.end_effector();
    }
}

impl<const N: usize> Memory for Controller<N> {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        // Without "..": whoever adds a field decides here whether it follows from the parameters.
        let Self {
            dynamics: _,
            resolver: _,
            now,
            motion,
            slope_before,
            rate_before,
            places,
            discretization: _,
            hold: _,
            sample_time: _,
            grasp_time: _,
            reference: _,
            origin: _,
            aim,
            planned_at,
            horizon,
            planned_end,
        } = self;
        now.pass(tape);
        motion.pass(tape);
        [slope_before, rate_before].into_iter().for_each(|values| values.pass(tape));
        places.iter_mut().for_each(|place| tape.one_of(place, &Place::ALL));
        aim.pass(tape);
        [planned_at, horizon].into_iter().for_each(|time| time.pass(tape));
        planned_end.pass(tape);
    }
}

impl<const N: usize> Planner for Controller<N> {
    fn step(
        &mut self,
        parameters: &Parameters,
        inputs: &Inputs,
        t: f64,
        size: f64,
        outputs: &mut Outputs,
    ) -> Result<()> {
        self.tune(parameters);
        self.predict(t, size)?;
        let now = t + size;
        self.grasp_in_time(now);
        if now - self.planned_at >= self.horizon - SAME_INSTANT * self.sample_time {
            self.horizon = size * (self.sample_time / size - SAME_INSTANT).ceil().max(1.0);
            self.plan(now, inputs, outputs)?;
        }
        self.write_prediction(now, inputs, outputs);
        Ok(())
    }

    fn rates(&self, inputs: &Inputs, t: f64) -> Rates {
        let mut rates = Rates {
            reference_velocity: self.target(t, 0.0, inputs).acceleration,
            predicted_end_effector: self.end_effector_velocity(),
            predicted_velocity: self.dynamics.at_end(&self.now.situation, &self.slope_before, &Load::NONE).acceleration,
            ..Rates::default()
        };
        rates.predicted_position[..N].copy_from_slice(self.now.situation.state.rate.as_slice());
        rates
    }

    fn check_memory(&self) -> Result<()> {
        self.now.check_memory()?;
        self.planned_end.check_memory()?;
        let times = [("time of the last plan", self.planned_at), ("length of the planned interval", self.horizon)];
        match times.into_iter().find(|(_, value)| !value.is_finite()) {
            Some((quantity, value)) => Err(Error::Impossible { quantity, value }),
            None => Ok(()),
        }
    }

    fn clone_box(&self) -> Box<dyn Planner> {
        Box::new(self.clone())
    }
}

/// Whether the method suits the arm, and its parts each other.
fn check_method(structure: Structure, parameters: &Parameters) -> Result<()> {
    let Parameters { ik, .. } = parameters;
    let refused = |name: &str, expected: String, found: &str| {
        Err(Error::Inconsistent { name: name.to_owned(), expected, found: found.to_owned() })
    };
    if ik.resolution == Resolution::ExtendedJacobian && structure.links < 3 {
        let expected = format!("an arm of 3 links or more is needed, this one has {structure}; use minimum_norm");
        return refused("ik.resolution", expected, ik.resolution.name());
    }
    if ik.resolution == Resolution::LeastSquares && ik.hold == Hold::FirstOrder {
        let expected = "zero_order with the resolution least_squares, whose limits are those of constant rates";
        return refused("ik.hold", expected.to_owned(), ik.hold.name());
    }
    Ok(())
}
