//! The right-hand side: rates of pose, momentum and autopilot integrals.

use nalgebra::{SVector, Vector3};

use super::integrated_state::IntegratedState;
use super::{Dynamics, Load, Loads, Motion, in_inertial_frame};
use crate::autopilot::AutopilotMode;
use crate::mechanics::kinematics::{Displacement, Posture};
use crate::mechanics::momentum::{MomentumMatrix, Twist};
use crate::mechanics::planar::{Rotation, Vec2, cross, perp, vec2};
use crate::mechanics::vehicle::Vehicle;
use crate::memory;
use crate::parameters::BaseModel;

/// The arm at one instant, in the UAV frame.
#[derive(Debug, Clone, Copy)]
pub struct Node<const N: usize> {
    /// Where everything is.
    pub posture: Posture<N>,
    /// H_b and H_m.
    pub matrix: MomentumMatrix<N>,
    /// Rates of the coordinates \[rad/s, m/s\].
    pub rate: SVector<f64, N>,
    /// H_m q_dot.
    pub arm: Twist,
}

memory!(Node<N> { posture, matrix, rate, arm });

impl<const N: usize> Node<N> {
    /// The arm with the coordinates `q` \[rad, m\], moving at `rate`.
    #[must_use]
    pub fn new(vehicle: &Vehicle<N>, q: &SVector<f64, N>, held: bool, rate: &SVector<f64, N>) -> Self {
        let (posture, matrix) = (Posture::NOWHERE, MomentumMatrix::NOTHING);
        let mut node = Self { posture, matrix, rate: *rate, arm: Twist::ZERO };
        node.take(vehicle, q, held, rate);
        node
    }

    /// Becomes the arm with the coordinates `q` \[rad, m\], moving at `rate`.
    #[inline(never)]
    pub fn take(&mut self, vehicle: &Vehicle<N>, q: &SVector<f64, N>, held: bool, rate: &SVector<f64, N>) {
        self.posture.take(vehicle, q);
        self.matrix.sum_up(vehicle, &self.posture, held);
        self.move_at(rate);
    }

    /// Becomes the arm that is `way` from the node `from`, moving at `rate`.
    ///
    /// In place: returned by value, a node is copied as often as it is passed on, which takes longer than its sums.
    #[inline]
    pub fn follow(
        &mut self,
        vehicle: &Vehicle<N>,
        from: &Self,
        way: &Displacement<N>,
        held: bool,
        rate: &SVector<f64, N>,
    ) {
        self.posture.follow(vehicle, &from.posture, way);
        self.matrix.sum_up(vehicle, &self.posture, held);
        self.move_at(rate);
    }

    /// The same arm, moving at `rate`.
    #[inline(never)]
    pub fn move_at(&mut self, rate: &SVector<f64, N>) {
        self.arm = self.matrix.sum_of_rates(rate);
        self.rate = *rate;
    }

    /// Velocity of a point of the last link at `place`, while the base moves with `v`; UAV frame.
    #[must_use]
    pub fn velocity_at(&self, vehicle: &Vehicle<N>, place: Vec2, v: Twist) -> Vec2 {
        (0..N).fold(v.linear + perp(place) * v.angular, |velocity, i| {
            velocity + perp(place - self.posture.joint[i]) * (self.rate[i] * vehicle.revolute[i])
        })
    }
}

/// The UAV at one instant, as what it carries feels it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Carrier {
    /// The turn of the arm's frame.
    pub rotation: Rotation,
    /// Its motion, in the axes of that frame.
    pub motion: Twist,
    /// Force of the support on the payload, upwards \[N\].
    pub support: f64,
}

/// What stays the same during an internal step.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepContext<'a, const N: usize> {
    /// Loads from outside.
    pub loads: &'a Loads<'a>,
    /// When the internal step begins, from the beginning of these loads \[s\].
    pub elapsed: f64,
    /// Whether the payload is held.
    pub held: bool,
    /// Whether the support pushes on it.
    pub contact: bool,
    /// Thrust and torque of a sampled autopilot.
    pub sampled: Vec2,
    /// The imposed rates, from the beginning of the internal step on.
    pub motion: Motion<N>,
}

impl<const N: usize> StepContext<'_, N> {
    /// On which side of the unloaded support the payload stays while contact does not switch: +1 above.
    pub fn side(&self) -> f64 {
        if self.contact { -1.0 } else { 1.0 }
    }
}

impl<const N: usize> Dynamics<N> {
    /// The turn of the arm's frame.
    #[inline]
    pub(super) fn arm_rotation(&self, y: &IntegratedState) -> Rotation {
        if self.base.turns_arm() { y.uav_rotation() } else { Rotation::NONE }
    }

    /// Motion of the base with the momentum `h`, of which `arm` is the arm's; axes of the UAV frame.
    #[inline]
    #[must_use]
    pub fn base_motion(&self, node: &Node<N>, h: Twist, arm: Twist) -> Twist {
        self.base.velocity(&node.matrix, self.vehicle.uav_inertia, h, arm)
    }

    /// Motion of the base in the axes of the UAV frame: what momentum the arm leaves, divided by inertia.
    #[inline]
    pub(super) fn base_velocity(&self, y: &IntegratedState, rotation: Rotation, node: &Node<N>) -> Twist {
        let h = Twist { linear: rotation.undo(y.momentum.xy()), angular: y.momentum.z };
        self.base_motion(node, h, node.arm)
    }

    /// Thrust \[N\] and torque \[N m\] by the hover law, from errors of altitude and roll, their integrals, and the velocity
    /// in the inertial frame.
    #[inline]
    pub(super) fn hover_law(&self, error: Vec2, velocity: &Vector3<f64>, integrals: Vec2, load: &Load) -> Vec2 {
        let (altitude, roll) = (&self.autopilot.altitude, &self.autopilot.roll);
        let feed_forward = vec2(self.hover_thrust + load.thrust_feedforward, 0.0);
        feed_forward
            - vec2(
                altitude.kp * error.x + altitude.kd * velocity.y + altitude.ki * integrals.x,
                roll.kp * error.y + roll.kd * velocity.z + roll.ki * integrals.y,
            )
    }

    /// Thrust \[N\] and torque \[N m\], without what holds an ideal base, and the errors that a continuous autopilot
    /// integrates.
    #[inline]
    pub(super) fn control(
        &self,
        y: &IntegratedState,
        velocity: &Vector3<f64>,
        load: &Load,
        context: &StepContext<'_, N>,
    ) -> (Vec2, Vec2) {
        if self.continuous {
            let error = load.error(y.pose.y, y.pose.z);
            return (self.hover_law(error, velocity, y.integrals, load), error);
        }
        let control = match self.autopilot.mode {
            _ if self.on_carriage() => Vec2::zeros(),
            AutopilotMode::Pid => context.sampled,
            AutopilotMode::External => vec2(load.thrust, load.torque),
            AutopilotMode::Ideal => Vec2::zeros(),
        };
        (control, Vec2::zeros())
    }

    /// Rates of the integrated state, written to `k`.
    #[inline(never)]
    pub(super) fn law(
        &self,
        k: &mut IntegratedState,
        y: &IntegratedState,
        node: &Node<N>,
        load: &Load,
        context: &StepContext<'_, N>,
    ) {
        // The compiler writes it twice: with a model that it knows, it takes a fifth less instructions.
        if self.base == BaseModel::Full {
            self.written(k, y, node, self.base_velocity(y, y.uav_rotation(), node), load, context);
        } else {
            self.reduced_law(k, y, node, load, context);
        }
    }

    /// The same for a base that is not [`BaseModel::Full`]. Out of the way: without any other call, the full model
    /// needs no registers saved.
    #[inline(never)]
    fn reduced_law(
        &self,
        k: &mut IntegratedState,
        y: &IntegratedState,
        node: &Node<N>,
        load: &Load,
        context: &StepContext<'_, N>,
    ) {
        let h = Twist { linear: y.momentum.xy(), angular: y.momentum.z };
        let v = self.base.reduced_velocity(node.matrix.mass, self.vehicle.uav_inertia, h, h - node.arm);
        self.law_at(k, y, node, v, load, context);
    }

    /// [`Dynamics::law`] for a base that moves with `v`, axes of the UAV frame.
    #[inline(never)]
    pub(super) fn law_at(
        &self,
        k: &mut IntegratedState,
        y: &IntegratedState,
        node: &Node<N>,
        v: Twist,
        load: &Load,
        context: &StepContext<'_, N>,
    ) {
        self.written(k, y, node, v, load, context);
    }

    #[inline(always)]
    pub(super) fn written(
        &self,
        k: &mut IntegratedState,
        y: &IntegratedState,
        node: &Node<N>,
        v: Twist,
        load: &Load,
        context: &StepContext<'_, N>,
    ) {
        let rotation = self.arm_rotation(y);
        let velocity = in_inertial_frame(rotation, v);
        let (mut control, error) = self.control(y, &velocity, load, context);
        let support = self.support_force(y, rotation, node, context);

        let weight = vec2(0.0, -node.matrix.mass * self.vehicle.gravity);
        let others = load.base_force + load.tip_force + vec2(0.0, support) + weight;
        if self.base.thrust_carries_all() {
            control.x = -others.y;
        }
        let force = y.uav_rotation().up() * control.x + others;
        let moment = control.y + load.base_torque + self.carried_moment(rotation, node, load, support);
        let angular = moment - self.base.transport(velocity.xy(), y.momentum.xy(), node.arm);

        *k = IntegratedState {
            pose: velocity,
            momentum: Vector3::new(force.x, force.y, angular),
            integrals: error,
            rotation: perp(y.rotation) * velocity.z,
            torque_impulse: control.y,
            support_impulse: support,
        };
    }

    /// The UAV with the integrated state `y` and its rates `k`, as [`Dynamics::law`] gives them.
    #[inline]
    pub(super) fn carrier(&self, y: &IntegratedState, k: &IntegratedState) -> Carrier {
        let rotation = self.arm_rotation(y);
        Carrier {
            rotation,
            motion: Twist { linear: rotation.undo(k.pose.xy()), angular: k.pose.z },
            support: k.support_impulse,
        }
    }

    /// Moment of weight and outer loads on what the UAV carries, about the UAV's centre of mass \[N m\].
    #[inline]
    pub(super) fn carried_moment(&self, rotation: Rotation, node: &Node<N>, load: &Load, support: f64) -> f64 {
        let mut moment = -rotation.apply(node.matrix.first).x * self.vehicle.gravity;
        if load.pushes_arm() || support != 0.0 {
            let posture = &node.posture;
            moment += load.tip_torque
                + cross(rotation.apply(posture.end_effector), load.tip_force)
                + rotation.apply(posture.payload).x * support;
        }
        moment
    }

    /// Force of the support on the payload, upwards \[N\].
    #[inline]
    pub(super) fn support_force(
        &self,
        y: &IntegratedState,
        rotation: Rotation,
        node: &Node<N>,
        context: &StepContext<'_, N>,
    ) -> f64 {
        if context.contact { -self.support.stiffness * self.gap(y, rotation, node) } else { 0.0 }
    }

    /// Height of the payload above the unloaded support \[m\].
    pub(super) fn gap(&self, y: &IntegratedState, rotation: Rotation, node: &Node<N>) -> f64 {
        y.pose.y + rotation.apply(node.posture.payload).y - self.support.height
    }

    /// How fast the payload leaves the support while the UAV moves with `velocity`, inertial frame \[m/s\].
    pub(super) fn gap_rate(&self, rotation: Rotation, node: &Node<N>, velocity: &Vector3<f64>) -> f64 {
        let v = Twist { linear: rotation.undo(velocity.xy()), angular: velocity.z };
        self.velocity_at(node, rotation, node.posture.payload, v).y
    }

    /// Velocity of a point of the last link at `place` (UAV frame) \[m/s\], inertial frame, while the base moves with `v`,
    /// axes of the arm's frame, which is turned by `rotation`.
    #[must_use]
    pub fn velocity_at(&self, node: &Node<N>, rotation: Rotation, place: Vec2, v: Twist) -> Vec2 {
        rotation.apply(node.velocity_at(&self.vehicle, place, self.base.carried(v)))
    }
}
