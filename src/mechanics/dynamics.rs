//! The laws of motion of an aerial manipulator whose joint rates are imposed.
//!
//! The state is base pose and momentum, so that it stays continuous where rates jump: the base velocity
//! follows from momentum and rates at every instant (thesis 2.5 and 3.6). Plant and controller advance
//! the same [`State`] by the same [`Dynamics::advance`].

mod account;
mod advance;
mod base;
mod contact;
mod driven;
mod explicit;
mod instant;
mod integrated_state;
mod law;
mod loads;
mod moment;
mod motion;
mod outboard;
mod rates;
mod runge_kutta;
mod state;
mod too_long;

use std::ops::Add;

use nalgebra::{SVector, Vector3};

pub use account::{Account, Carried, Outboard};
pub use driven::{Driven, Torques};
pub use instant::Instant;
pub use law::Node;
pub use loads::{Load, Loads};
pub use motion::Motion;
pub use rates::EndRates;
pub use state::{Situation, State};

use crate::autopilot::{Autopilot, AutopilotMode};
use crate::bytes::Tape;
use crate::error::{Error, Result};
use crate::mechanics::momentum::Twist;
use crate::mechanics::planar::{Rotation, Vec2, vec2};
use crate::mechanics::vehicle::{Balancer, Vehicle};
use crate::parameters::{BaseModel, MomentModel, Parameters, Structure, Support};
use crate::variables::Bounds;
use crate::{memory, pass};

/// Shortest sample time of an autopilot that is not continuous \[s\].
pub const SHORTEST_SAMPLE: f64 = 1e-6;

/// Whether every number of these quantities is finite.
///
/// # Errors
/// Names the first one that is not, at `time` \[s\].
#[cold]
#[inline(never)]
pub fn check_finite(quantities: &[(&'static str, &[f64])], time: f64) -> Result<()> {
    for &(quantity, values) in quantities {
        if let Some(&value) = values.iter().find(|value| !value.is_finite()) {
            return Err(Error::NotFinite { quantity, value, time });
        }
    }
    Ok(())
}

/// Impulses during a step, from which mean forces and torques follow.
#[derive(Debug, Clone, Copy)]
pub struct Impulse {
    /// Of the rotors' force on the UAV \[N s\].
    pub thrust: Vec2,
    /// Of the rotors' torque on the UAV \[N m s\].
    pub torque: f64,
    /// Of the support force on the payload \[N s\].
    pub support: f64,
}

memory!(Impulse { thrust, torque, support });

impl Impulse {
    /// No impulse.
    pub const NONE: Self = Self { thrust: vec2(0.0, 0.0), torque: 0.0, support: 0.0 };
}

impl Add for Impulse {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            thrust: self.thrust + other.thrust,
            torque: self.torque + other.torque,
            support: self.support + other.support,
        }
    }
}

/// The laws of motion with all their constants.
#[derive(Debug, Clone, Copy)]
pub struct Dynamics<const N: usize> {
    /// Mass properties.
    pub vehicle: Vehicle<N>,
    /// How the base moves.
    pub base: BaseModel,
    /// What the arm feels of it.
    pub moment_model: MomentModel,
    /// Hover control.
    pub autopilot: Autopilot,
    /// Support of the payload.
    pub support: Support,
    /// Thrust that carries all but the payload \[N\].
    hover_thrust: f64,
    /// Whether the hover law is evaluated inside the integrator.
    continuous: bool,
    /// Upper estimate of the fastest rate at which a continuous autopilot answers \[1/s\].
    control_rate: f64,
}

impl<const N: usize> Dynamics<N> {
    /// The laws of motion for `parameters`, with a base that moves as `base` says. Under an ideal autopilot it
    /// can only slide.
    ///
    /// # Errors
    /// If the parameters do not go together.
    pub fn new(structure: Structure, parameters: &Parameters, base: BaseModel) -> Result<Self> {
        let vehicle = Vehicle::new(structure, parameters)?;
        let sample_time = parameters.autopilot.sample_time;
        if sample_time != 0.0 && sample_time < SHORTEST_SAMPLE {
            return Err(Error::Inconsistent {
                name: "autopilot.sample_time".to_owned(),
                expected: format!("0 for a continuous autopilot, or at least {SHORTEST_SAMPLE} s"),
                found: sample_time.to_string(),
            });
        }
        let hover_thrust = vehicle.mass() * vehicle.gravity;
        let mut dynamics = Self {
            vehicle,
            base: if parameters.autopilot.mode == AutopilotMode::Ideal { BaseModel::Ideal } else { base },
            moment_model: parameters.ik.moment_model,
            autopilot: parameters.autopilot,
            support: parameters.support,
            hover_thrust,
            continuous: false,
            control_rate: 0.0,
        };
        dynamics.heed_autopilot();
        Ok(dynamics)
    }

    /// Takes over the gains of `autopilot`; whether they are others than before.
    pub fn tune(&mut self, autopilot: &Autopilot) -> bool {
        let others = (self.autopilot.altitude, self.autopilot.roll) != (autopilot.altitude, autopilot.roll);
        if others {
            (self.autopilot.altitude, self.autopilot.roll) = (autopilot.altitude, autopilot.roll);
            self.heed_autopilot();
        }
        others
    }

    /// Passes the gains in force by a tape: those of the finished step, where the parameters may be ahead.
    pub fn pass_gains(&mut self, tape: &mut Tape<'_>) {
        let Autopilot { altitude, roll, .. } = &mut self.autopilot;
        pass!(tape: altitude, roll);
        self.heed_autopilot();
    }

    /// Whether the gains can be those of a run.
    ///
    /// # Errors
    /// Names one that is negative or not finite.
    pub fn check_gains(&self) -> Result<()> {
        let Autopilot { altitude, roll, .. } = &self.autopilot;
        let gains = [altitude.kp, altitude.ki, altitude.kd, roll.kp, roll.ki, roll.kd];
        match gains.into_iter().find(|gain| !Bounds::NON_NEGATIVE.admit(*gain)) {
            Some(value) => Err(Error::Impossible { quantity: "gain of the autopilot", value }),
            None => Ok(()),
        }
    }

    /// Changes the kind of hover control, before the start.
    pub fn set_mode(&mut self, mode: AutopilotMode) {
        self.autopilot.mode = mode;
        self.heed_autopilot();
    }

    /// At rest at the origin, with the coordinates at their start and without payload.
    #[must_use]
    pub fn start(&self, parameters: &Parameters) -> Situation<N> {
        let position = SVector::from_fn(|i, _| match self.vehicle.balancer {
            Some(Balancer::Counterweight(_)) if i == N - 1 => parameters.counterweight.start,
            Some(Balancer::Element(_)) if i == N - 1 => parameters.balance_element.start,
            _ => parameters.joints[i].start,
        });
        self.situation(State::at_rest(position))
    }

    /// What follows from a state.
    #[must_use]
    pub fn situation(&self, state: State<N>) -> Situation<N> {
        let node = Node::new(&self.vehicle, &state.position, state.held, &state.rate);
        Situation { rotation: self.base.rotation(state.pose.z), node, state }
    }

    /// Takes the payload over, at rest in the inertial frame: momentum is continuous, velocities jump.
    pub fn grasp(&self, situation: &mut Situation<N>) {
        *situation = self.situation(State { held: true, ..situation.state });
    }

    /// Lets the payload go with its own momentum: velocities are continuous.
    pub fn release(&self, situation: &mut Situation<N>) {
        let mut without = self.situation(State { held: false, contact: false, ..situation.state });
        let h = without.node.matrix.of_base(situation.base()) + without.node.arm;
        without.state.momentum = in_inertial_frame(situation.rotation, h);
        *situation = without;
    }

    /// Whether the autopilot takes samples, and time counts.
    #[must_use]
    pub fn is_sampled(&self) -> bool {
        self.autopilot.mode == AutopilotMode::Pid && self.autopilot.sample_time > 0.0
    }

    /// Whether the base slides along x only.
    #[must_use]
    pub fn on_carriage(&self) -> bool {
        self.base == BaseModel::Ideal
    }

    /// Works out what follows from the kind of hover control and its gains.
    fn heed_autopilot(&mut self) {
        let Autopilot { mode, altitude, roll, sample_time } = &self.autopilot;
        self.continuous = !self.on_carriage() && *mode == AutopilotMode::Pid && *sample_time == 0.0;
        self.control_rate = if self.continuous {
            altitude.rate_on(self.vehicle.mass()).max(roll.rate_on(self.vehicle.uav_inertia))
        } else {
            0.0
        };
    }
}

/// A twist of the UAV frame as (x, y, out of the plane) components of the inertial frame.
#[must_use]
pub fn in_inertial_frame(rotation: Rotation, twist: Twist) -> Vector3<f64> {
    let linear = rotation.apply(twist.linear);
    Vector3::new(linear.x, linear.y, twist.angular)
}
