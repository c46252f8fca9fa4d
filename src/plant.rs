//! The multibody system from one communication point to the next.

mod means;
mod simulation;
mod slopes;

use nalgebra::Vector3;

pub use simulation::Plant;
pub use slopes::Slopes;

use crate::bytes::Memory;
use crate::error::{Error, Result};
use crate::for_coordinates;
use crate::mechanics::dynamics::Load;
use crate::mechanics::planar::Vec2;
use crate::parameters::{MAX_COORDINATES, Parameters, Structure};

/// What comes from outside at a communication point. Joints stand first, what
/// balances the arm after the last joint of the structure.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Inputs {
    /// Rates at the beginning of the step \[rad/s, m/s\].
    pub rate_command: [f64; MAX_COORDINATES],
    /// Slopes of the rates within the step \[rad/s2, m/s2\].
    pub acceleration_command: [f64; MAX_COORDINATES],
    /// Torques of the motors of joints that follow a torque \[N m\].
    pub joint_torque_command: [f64; MAX_COORDINATES],
    /// Whether the payload is to be held.
    pub grasp: bool,
    /// What acts from outside, and what is wanted of the autopilot.
    pub load: Load,
    /// How inputs change within the step, if that is given.
    pub slopes: Option<Slopes>,
}

/// What can be observed at a communication point: values at the end of the finished step, under the
/// rates held in it. Inertial frame; wrenches and torques are means over the step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Outputs {
    /// Pose of the UAV: x, y \[m\], roll \[rad\].
    pub pose: Vector3<f64>,
    /// Velocity of the UAV \[m/s, m/s, rad/s\].
    pub velocity: Vector3<f64>,
    /// Acceleration of the UAV \[m/s2, m/s2, rad/s2\].
    pub acceleration: Vector3<f64>,
    /// Positions of the coordinates \[rad, m\].
    pub position: [f64; MAX_COORDINATES],
    /// Rates of the coordinates \[rad/s, m/s\].
    pub rate: [f64; MAX_COORDINATES],
    /// Mean torques of the joints' motors on the outer links, of the balance element's motor on it \[N m\], or
    /// mean force of the counterweight's motor on it \[N\].
    pub effort: [f64; MAX_COORDINATES],
    /// Position of the end effector \[m\].
    pub end_effector: Vec2,
    /// Velocity of the end effector \[m/s\].
    pub end_effector_velocity: Vec2,
    /// Thrust along the UAV's own vertical axis \[N\].
    pub thrust: f64,
    /// Torque of the rotors on the UAV \[N m\].
    pub torque: f64,
    /// Mean force on the UAV of all that it carries \[N\].
    pub transmitted_force: Vec2,
    /// Mean moment of that about the UAV's centre of mass \[N m\].
    pub transmitted_moment: f64,
    /// Momentum of the whole system, and angular momentum about the UAV's centre of mass \[N s, N s, N m s\].
    pub momentum: Vector3<f64>,
    /// Centre of mass of the whole system \[m\].
    pub center_of_mass: Vec2,
    /// Whether the payload is held.
    pub attached: bool,
    /// Mean force of the held payload on the arm \[N\].
    pub payload_force: Vec2,
    /// Force of the support on the held payload, upwards \[N\].
    pub support_force: f64,
}

impl Outputs {
    /// Whether all that is computed from the state is finite, too: huge parameters and loads overflow there first.
    ///
    /// # Errors
    /// Names the first quantity that is not, at `time` \[s\].
    pub fn check(&self, time: f64) -> Result<()> {
        let quantities = [
            ("acceleration of the UAV", self.acceleration.sum()),
            ("effort of the joints", self.effort.iter().sum()),
            ("position of the end effector", self.end_effector.sum()),
            ("velocity of the end effector", self.end_effector_velocity.sum()),
            ("thrust or torque", self.thrust + self.torque),
            ("transmitted wrench", self.transmitted_force.sum() + self.transmitted_moment),
            ("momentum", self.momentum.sum()),
            ("centre of mass", self.center_of_mass.sum()),
            ("force of the payload", self.payload_force.sum() + self.support_force),
        ];
        match quantities.into_iter().find(|(_, value)| !value.is_finite()) {
            Some((quantity, value)) => Err(Error::NotFinite { quantity, value, time }),
            None => Ok(()),
        }
    }
}

/// How fast those observations change that are not means over the step and whose rate is no observation
/// itself: left limits, per second; 0 before the first step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OutputDerivatives {
    /// Accelerations of the coordinates \[rad/s2, m/s2\].
    pub coordinates: [f64; MAX_COORDINATES],
    /// Acceleration of the end effector \[m/s2\].
    pub end_effector_velocity: Vec2,
    /// Of the thrust \[N/s\]; 0 if it is a mean or held between samples.
    pub thrust: f64,
    /// Of the torque of the rotors \[N m/s\]; likewise.
    pub torque: f64,
    /// Of the momentum \[N, N, N m\].
    pub momentum: Vector3<f64>,
    /// Velocity of the centre of mass \[m/s\].
    pub center_of_mass: Vec2,
    /// Of the support force \[N/s\].
    pub support_force: f64,
}

/// A plant of any number of coordinates.
pub trait Simulation: Memory + Send {
    /// Writes all outputs before the first step.
    ///
    /// # Errors
    /// If one is not finite.
    fn initial_outputs(&self, outputs: &mut Outputs) -> Result<()> {
        self.write_state(outputs);
        self.observe(0.0, outputs)
    }

    /// Writes the part of the outputs that is the state.
    fn write_state(&self, outputs: &mut Outputs);

    /// Takes over those of the `parameters` that may change during a run.
    fn tune(&mut self, parameters: &Parameters);

    /// Advances from `t`, counted from the start, by `size` \[s\], and writes the part of the outputs that is the state.
    ///
    /// # Errors
    /// If the state is no longer finite.
    fn step(&mut self, inputs: &Inputs, t: f64, size: f64, outputs: &mut Outputs) -> Result<()>;

    /// Writes all other outputs at the end of the finished step, at `time`, or at the start.
    ///
    /// # Errors
    /// If one is not finite.
    fn observe(&self, time: f64, outputs: &mut Outputs) -> Result<()>;

    /// How fast the outputs of the finished step change at its end.
    fn output_derivatives(&self) -> OutputDerivatives;

    /// Whether what was taken off a tape can be the memory of a run.
    ///
    /// # Errors
    /// Names a quantity that cannot be.
    fn check_memory(&self) -> Result<()>;

    /// A copy that continues on its own.
    fn clone_box(&self) -> Box<dyn Simulation>;
}

impl Clone for Box<dyn Simulation> {
    fn clone(&self) -> Self {
        self.clone_box()
    }
}

/// A plant at the start, at rest, without payload.
///
/// # Errors
/// If a parameter is out of its bounds, or parameters do not go together.
pub fn new(structure: Structure, parameters: &Parameters) -> Result<Box<dyn Simulation>> {
    parameters.check(structure)?;
    for_coordinates!(structure, N => Ok(Box::new(Plant::<N>::new(structure, parameters)?)))
}
