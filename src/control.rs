//! Inverse kinematics from one communication point to the next.
//!
//! A joint rate on its way, in the order in which the files hand it on:
//!
//! 1. `foreseen` says where and how fast the end effector is to be at an instant: from `crate::reference`, or by
//!    `external`, from what the host gives.
//! 2. `clock` says whether a plan is due and how long the interval is for which it is made.
//! 3. `planner` makes a plan then, by the chosen discretization: `exact` integrates the interval and iterates until the
//!    end effector is on the reference at its end; `euler` makes the explicit step of the thesis; `acceleration` does so
//!    for accelerations.
//! 4. These start from the `plan_context`: the laws, the predicted present (`prediction`), the motion sent so far, and the
//!    damping of the free motion (`damping`). `response` gives the generalized and the extended Jacobian there, and from
//!    it follows a linear [`Problem`]: the wanted velocity of the end effector, and the wanted moment.
//! 5. `resolution` chooses rates that solve it; each method stands in a file of its own below it, and `method` has one row
//!    for each with what the other files must know of it. Where limits bind (`limits`), a quadratic program decides ([`qp`]).
//! 6. The rates become a `plan` for the interval, with what had to give way. The planner writes it to the [`Outputs`], and
//!    predicts with it where the system is at the next communication point.
//!
//! A plan is a function of the plan context. State that lasts from one plan to the next is held by the planner and the
//! plan context; what a method remembers is its `MethodState`. All of it is passed as [`Memory`].

mod acceleration;
mod clock;
mod damping;
mod euler;
mod exact;
mod external;
mod foreseen;
mod limits;
mod method;
mod plan;
mod plan_context;
mod planner;
mod prediction;
pub mod qp;
mod resolution;
mod response;

use nalgebra::Vector3;

pub use planner::Controller;
pub use resolution::{PATH_THRESHOLD, Problem, PseudoInverse, Task};
pub use response::Response;

use crate::bytes::Memory;
use crate::error::Result;
use crate::for_coordinates;
use crate::mechanics::dynamics::check_finite;
use crate::mechanics::planar::Vec2;
use crate::options;
use crate::parameters::{MAX_COORDINATES, Parameters, Structure};

options! {
    #[doc = " How the present rates came about."]
    pub enum Status {
        #[doc = " All that was asked for is met: the interval ends within 1e-6 m of the reference."]
        Ok = "ok",
        #[doc = " The second task of the redundant arm is given up in part, for it contradicts the path here; the interval ends \
                 within 1e-6 m of the reference."]
        TaskDamped = "task_damped",
        #[doc = " The arm is close to a singular configuration, and the path may be given up in part."]
        PathDamped = "path_damped",
        #[doc = " Rates are scaled down to the limit, and the path may be given up in part."]
        RateLimited = "rate_limited",
        #[doc = " An error left over, or a jump of the reference, is being made good at a bounded speed; the path may be given \
                 up in part."]
        CatchingUp = "catching_up",
        #[doc = " Limits bind, or bring a joint back from past its stop, and the second task gives way; the interval ends \
                 within 1e-6 m of the reference."]
        TaskLimited = "task_limited",
        #[doc = " Limits bind, or bring a joint back from past its stop, and the path may be given up in part: they allow \
                 nothing nearer to it (least_squares)."]
        PathLimited = "path_limited",
        #[doc = " The interval ends more than 1e-6 m off the reference: it is too long for the motion in it, or the \
                 discretization is euler, which makes nothing good."]
        Inexact = "inexact",
    }
}

impl Status {
    /// Whether it says that the end effector is on the reference at the end of the interval.
    #[must_use]
    pub fn keeps_path(self) -> bool {
        matches!(self, Self::Ok | Self::TaskDamped | Self::TaskLimited)
    }
}

/// The wanted motion of the end effector, if the reference is external; inertial frame. Which instant of the communication
/// step the values belong to is a parameter. What is 0 throughout is taken from differences of the others.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Inputs {
    /// Position \[m\].
    pub position: Vec2,
    /// Velocity \[m/s\].
    pub velocity: Vec2,
    /// Acceleration \[m/s2\].
    pub acceleration: Vec2,
}

/// Commands for the coming interval and what the prediction says. Joints stand first,
/// what balances the arm after the last joint of the structure.
#[derive(Debug, Clone, PartialEq)]
pub struct Outputs {
    /// Rates \[rad/s, m/s\].
    pub rate_command: [f64; MAX_COORDINATES],
    /// Accelerations of the coordinates in the coming interval \[rad/s2, m/s2\].
    pub acceleration_command: [f64; MAX_COORDINATES],
    /// Whether the payload is to be held.
    pub grasp: bool,
    /// Wanted position of the end effector now \[m\].
    pub reference: Vec2,
    /// Wanted velocity of the end effector now \[m/s\].
    pub reference_velocity: Vec2,
    /// Predicted pose of the UAV now \[m, m, rad\].
    pub predicted_pose: Vector3<f64>,
    /// Predicted velocity of the UAV now \[m/s, m/s, rad/s\].
    pub predicted_velocity: Vector3<f64>,
    /// Predicted position of the end effector now \[m\].
    pub predicted_end_effector: Vec2,
    /// Predicted positions of the coordinates now \[rad, m\].
    pub predicted_position: [f64; MAX_COORDINATES],
    /// How the rates came about.
    pub status: Status,
    /// Smallest singular value of the generalized Jacobian \[m\].
    pub min_singular_value: f64,
    /// How far the rates miss the wanted mean velocity \[m/s\].
    pub velocity_residual: f64,
    /// Predicted mean moment on the UAV under these rates \[N m\].
    pub moment_residual: f64,
    /// How far the finished plan ended off where it said that it would, relative to the reference \[m\].
    pub late_miss: f64,
}

impl Outputs {
    /// Whether what follows from a finite state and plan is finite, too: huge parameters and inputs overflow there first.
    ///
    /// # Errors
    /// Names the first quantity that is not, at `time` \[s\].
    pub fn check(&self, time: f64) -> Result<()> {
        let Self {
            rate_command,
            acceleration_command,
            reference,
            reference_velocity,
            predicted_end_effector,
            late_miss,
            ..
        } = self;
        let places = reference + reference_velocity + predicted_end_effector;
        let commands: f64 = rate_command.iter().zip(acceleration_command).map(|(rate, slope)| rate + slope).sum();
        if (places.sum() + commands + late_miss).is_finite() {
            return Ok(());
        }
        check_finite(
            &[
                ("rate command", rate_command),
                ("acceleration command", acceleration_command),
                ("reference", reference.as_slice()),
                ("velocity of the reference", reference_velocity.as_slice()),
                ("predicted position of the end effector", predicted_end_effector.as_slice()),
                ("late miss", &[*late_miss]),
            ],
            time,
        )
    }
}

/// How fast outputs change whose rate is no output itself; predictions: left limits.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OutputDerivatives {
    /// Wanted acceleration of the end effector now \[m/s2\].
    pub reference_velocity: Vec2,
    /// Predicted velocity of the end effector \[m/s\].
    pub predicted_end_effector: Vec2,
    /// Predicted acceleration of the UAV \[m/s2, m/s2, rad/s2\].
    pub predicted_velocity: Vector3<f64>,
    /// Rates of the coordinates in the finished interval \[rad/s, m/s\].
    pub predicted_position: [f64; MAX_COORDINATES],
}

impl Default for Outputs {
    fn default() -> Self {
        Self {
            rate_command: [0.0; MAX_COORDINATES],
            acceleration_command: [0.0; MAX_COORDINATES],
            grasp: false,
            reference: Vec2::zeros(),
            reference_velocity: Vec2::zeros(),
            predicted_pose: Vector3::zeros(),
            predicted_velocity: Vector3::zeros(),
            predicted_end_effector: Vec2::zeros(),
            predicted_position: [0.0; MAX_COORDINATES],
            status: Status::Ok,
            min_singular_value: 0.0,
            velocity_residual: 0.0,
            moment_residual: 0.0,
            late_miss: 0.0,
        }
    }
}

/// A controller of any number of coordinates.
pub trait Planner: Memory + Send {
    /// Plans the first interval and writes all outputs, at the start.
    ///
    /// # Errors
    /// If there is no plan of finite rates.
    fn begin(&mut self, outputs: &mut Outputs) -> Result<()>;

    /// Takes over those of the `parameters` that may change during a run.
    fn tune(&mut self, parameters: &Parameters);

    /// Advances the prediction from `t`, counted from the start, by `size` \[s\] and plans if it is time.
    ///
    /// # Errors
    /// If the prediction is no longer finite.
    fn step(&mut self, inputs: &Inputs, t: f64, size: f64, outputs: &mut Outputs) -> Result<()>;

    /// How fast the outputs at time `t`, the present one counted from the start, change.
    fn output_derivatives(&self, t: f64) -> OutputDerivatives;

    /// Whether what was taken off a tape can be the memory of a run.
    ///
    /// # Errors
    /// Names a quantity that cannot be.
    fn check_memory(&self) -> Result<()>;

    /// A copy that continues on its own.
    fn clone_box(&self) -> Box<dyn Planner>;
}

impl Clone for Box<dyn Planner> {
    fn clone(&self) -> Self {
        self.clone_box()
    }
}

/// Whether parameters are within their bounds, go together and are for methods that suit the arm and each other.
///
/// # Errors
/// Names the first parameter for which this is not so, with what would be right.
pub fn check(structure: Structure, parameters: &Parameters) -> Result<()> {
    parameters.check(structure)?;
    method::check(structure, parameters)
}

/// A controller with nothing planned, to begin or to be given the memory of another one; each of the `parameters` is
/// within its bounds ([`Parameters::check`]).
///
/// # Errors
/// If parameters do not go together.
pub fn without_plan(structure: Structure, parameters: &Parameters) -> Result<Box<dyn Planner>> {
    parameters.check_together(structure)?;
    method::check(structure, parameters)?;
    for_coordinates!(structure, N => Ok(Box::new(Controller::<N>::new(structure, parameters)?)))
}

/// A controller at the start, with the first interval planned and the outputs written.
///
/// # Errors
/// As [`check`], or if there is no first plan.
pub fn new(structure: Structure, parameters: &Parameters, outputs: &mut Outputs) -> Result<Box<dyn Planner>> {
    parameters.check(structure)?;
    let mut planner = without_plan(structure, parameters)?;
    planner.begin(outputs)?;
    Ok(planner)
}
