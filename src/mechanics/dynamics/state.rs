//! State of an aerial manipulator, and what follows from it.

use nalgebra::{SVector, Vector3};

use super::check_finite;
use super::law::Node;
use crate::error::{Error, Result};
use crate::mechanics::momentum::Twist;
use crate::mechanics::planar::{Rotation, Vec2};
use crate::memory;

/// More samples are taken for a mistake.
const MOST_SAMPLES: f64 = 1e15;

/// State of an aerial manipulator with `N` coordinates, inertial frame.
///
/// Velocities and rates are those just before the present instant; they may jump at it.
#[derive(Debug, Clone, Copy)]
pub struct State<const N: usize> {
    /// Pose of the UAV: x, y \[m\], roll \[rad\].
    pub pose: Vector3<f64>,
    /// Momentum of the whole system, and angular momentum about the UAV's centre of mass \[N s, N s, N m s\].
    pub momentum: Vector3<f64>,
    /// Integrals of altitude error \[m s\] and roll error \[rad s\].
    pub integrals: Vec2,
    /// Joint angles and position of what balances the arm \[rad, m\].
    pub position: SVector<f64, N>,
    /// Velocity of the UAV \[m/s, m/s, rad/s\].
    pub velocity: Vector3<f64>,
    /// Rates of the coordinates \[rad/s, m/s\].
    pub rate: SVector<f64, N>,
    /// Whether the payload is held.
    pub held: bool,
    /// Whether the held payload touches its support.
    pub contact: bool,
    /// Thrust \[N\] and torque \[N m\] that a sampled autopilot holds.
    pub sampled: Vec2,
    /// Number of samples that the autopilot has taken.
    pub samples: u64,
}

memory!(State<N> { pose, momentum, integrals, position, velocity, rate, held, contact, sampled, samples });

impl<const N: usize> State<N> {
    /// At rest at the origin, with the coordinates `position`.
    #[must_use]
    pub fn at_rest(position: SVector<f64, N>) -> Self {
        Self {
            pose: Vector3::zeros(),
            momentum: Vector3::zeros(),
            integrals: Vec2::zeros(),
            position,
            velocity: Vector3::zeros(),
            rate: SVector::zeros(),
            held: false,
            contact: false,
            sampled: Vec2::zeros(),
            samples: 0,
        }
    }

    /// Momentum, and angular momentum about the UAV's centre of mass, in the axes of a frame turned by `rotation`.
    #[must_use]
    pub fn momentum_in(&self, rotation: Rotation) -> Twist {
        Twist { linear: rotation.undo(self.momentum.xy()), angular: self.momentum.z }
    }

    /// Whether a simulation can be in this state.
    ///
    /// # Errors
    /// Names the first quantity that is not finite, or a number of samples that takes centuries.
    pub fn check_memory(&self) -> Result<()> {
        #[allow(clippy::cast_precision_loss)] // near the bound
        let samples = self.samples as f64;
        match self.check(0.0) {
            Err(Error::NotFinite { quantity, value, .. }) => Err(Error::Impossible { quantity, value }),
            Ok(()) if samples > MOST_SAMPLES => {
                Err(Error::Impossible { quantity: "number of samples", value: samples })
            }
            result => result,
        }
    }

    /// Whether every number in it is finite.
    ///
    /// # Errors
    /// Names the first quantity that is not, at `time` \[s\].
    pub fn check(&self, time: f64) -> Result<()> {
        let Self { pose, momentum, integrals, position, velocity, .. } = self;
        let sum = pose.sum() + momentum.sum() + integrals.sum() + position.sum() + velocity.sum();
        if sum.is_finite() {
            return Ok(());
        }
        check_finite(
            &[
                ("base position", pose.as_slice()),
                ("momentum", momentum.as_slice()),
                ("integral of the autopilot", integrals.as_slice()),
                ("joint position", position.as_slice()),
                ("base velocity", velocity.as_slice()),
            ],
            time,
        )
    }
}

/// A state with what follows from it and is worth keeping: attitude and the sums over the arm.
#[derive(Debug, Clone, Copy)]
pub struct Situation<const N: usize> {
    /// The state.
    pub state: State<N>,
    /// The turn of the arm's frame: by the roll, if the arm turns with the UAV.
    pub rotation: Rotation,
    /// The arm, moving at the rates of the state.
    pub node: Node<N>,
}

memory!(Situation<N> { state, rotation, node });

impl<const N: usize> Situation<N> {
    /// Motion of the base in the axes of the UAV frame.
    #[must_use]
    pub fn base(&self) -> Twist {
        Twist { linear: self.rotation.undo(self.state.velocity.xy()), angular: self.state.velocity.z }
    }

    /// A place in the UAV frame \[m\], in the inertial frame \[m\].
    #[must_use]
    pub fn place(&self, place: Vec2) -> Vec2 {
        self.state.pose.xy() + self.rotation.apply(place)
    }
}
