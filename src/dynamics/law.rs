//! The right-hand side: rates of pose, momentum and autopilot integrals.

use nalgebra::{SVector, Vector3};

use super::{Dynamics, Impulse, Load, Loads, Motion, State, in_inertial_frame};
use crate::autopilot::AutopilotMode;
use crate::kinematics::{Configuration, Posture};
use crate::memory;
use crate::momentum::{MomentumMatrix, Twist, outboard};
use crate::planar::{Turn, Vec2, cross, perp, vec2};
use crate::vehicle::{Balancer, Vehicle};

/// x, y, roll, p_x, p_y, K, integral of the altitude error, integral of the roll error.
///
/// On an ideal carriage p_y and K are no states: they follow from the rates. There these entries collect
/// the impulses of all but the carriage, so that p_y and K less the entries is what the carriage gave.
pub(super) type Flow = SVector<f64, 8>;

/// The arm at one instant, in the UAV frame.
#[derive(Debug, Clone, Copy)]
pub struct Node<const N: usize> {
    /// Joint angles in trigonometric form.
    pub configuration: Configuration<N>,
    /// Where everything is.
    pub posture: Posture<N>,
    /// H_b and H_m.
    pub matrix: MomentumMatrix<N>,
    /// Rates of the coordinates \[rad/s, m/s\].
    pub rate: SVector<f64, N>,
    /// H_m q_dot.
    pub arm: Twist,
}

memory!(Node<N> { configuration, posture, matrix, rate, arm });

impl<const N: usize> Node<N> {
    /// The arm in `configuration`, moving at `rate`.
    #[must_use]
    pub fn new(vehicle: &Vehicle<N>, configuration: Configuration<N>, held: bool, rate: SVector<f64, N>) -> Self {
        let posture = Posture::new(vehicle, &configuration);
        let matrix = MomentumMatrix::new(vehicle, &posture, held);
        let arm = matrix.of_rates(&rate);
        Self { configuration, posture, matrix, rate, arm }
    }

    /// The same arm, moving at `rate`.
    pub fn move_at(&mut self, rate: SVector<f64, N>) {
        self.rate = rate;
        self.arm = self.matrix.of_rates(&rate);
    }

    /// Velocity of a point of the last link at `place`, while the base moves with `v`; UAV frame.
    #[must_use]
    pub fn velocity_at(&self, vehicle: &Vehicle<N>, place: Vec2, v: Twist) -> Vec2 {
        (0..N).fold(v.linear + perp(place) * v.angular, |velocity, i| {
            velocity + perp(place - self.posture.joint[i]) * (self.rate[i] * vehicle.revolute[i])
        })
    }
}

/// What stays the same during an internal step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scene<'a, const N: usize> {
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
    /// A roll close to the present one \[rad\], and the turn by it.
    pub near: (f64, Turn),
    /// The imposed rates, from the beginning of the internal step on.
    pub motion: Motion<N>,
}

impl<const N: usize> Scene<'_, N> {
    /// On which side of the unloaded support the payload stays while contact does not switch: +1 above.
    pub fn side(&self) -> f64 {
        if self.contact { -1.0 } else { 1.0 }
    }

    /// Where the arm is after the time `t` from `node` on.
    pub fn configuration_after(&self, vehicle: &Vehicle<N>, node: &Node<N>, t: f64) -> Configuration<N> {
        node.configuration.displaced(vehicle, &self.motion.way(t))
    }
}

impl<const N: usize> Dynamics<N> {
    /// The turn from the UAV frame into the inertial frame.
    #[inline]
    pub(super) fn turn(&self, y: &Flow, scene: &Scene<'_, N>) -> Turn {
        let (roll, turn) = scene.near;
        if self.base.turns_arm() { turn.then(Turn::by_small(y[2] - roll)) } else { turn }
    }

    /// Motion of the base with the momentum `h`, of which `arm` is the arm's; axes of the UAV frame.
    #[inline]
    #[must_use]
    pub fn base_motion(&self, node: &Node<N>, h: Twist, arm: Twist) -> Twist {
        self.base.velocity(&node.matrix, self.vehicle.uav_inertia, h, arm)
    }

    /// Motion of the base in the axes of the UAV frame: what momentum the arm leaves, divided by inertia.
    #[inline]
    pub(super) fn base_velocity(&self, y: &Flow, turn: Turn, node: &Node<N>) -> Twist {
        let h = Twist { linear: turn.undo(vec2(y[3], y[4])), angular: y[5] };
        self.base_motion(node, h, node.arm)
    }

    /// Thrust \[N\] and torque \[N m\] by the hover law, from pose and velocity in the inertial frame.
    #[inline]
    pub(super) fn hover_law(&self, pose: &Vector3<f64>, velocity: &Vector3<f64>, integrals: Vec2, load: &Load) -> Vec2 {
        let (altitude, roll) = (&self.autopilot.altitude, &self.autopilot.roll);
        let feed_forward = vec2(self.hover_thrust + load.thrust_feedforward, 0.0);
        feed_forward
            - vec2(
                altitude.kp * (pose.y - load.altitude) + altitude.kd * velocity.y + altitude.ki * integrals.x,
                roll.kp * (pose.z - load.roll) + roll.kd * velocity.z + roll.ki * integrals.y,
            )
    }

    /// Thrust \[N\] and torque \[N m\], without what holds an ideal base.
    #[inline]
    fn control(&self, y: &Flow, velocity: &Vector3<f64>, load: &Load, scene: &Scene<'_, N>) -> Vec2 {
        if self.on_carriage() {
            return Vec2::zeros();
        }
        match self.autopilot.mode {
            AutopilotMode::Pid if self.continuous() => {
                self.hover_law(&Vector3::new(y[0], y[1], y[2]), velocity, vec2(y[6], y[7]), load)
            }
            AutopilotMode::Pid => scene.sampled,
            AutopilotMode::External => vec2(load.thrust, load.torque),
            AutopilotMode::Ideal => Vec2::zeros(),
        }
    }

    /// Rates of the flow, and of the impulses.
    pub(super) fn law<const TORQUES: bool>(
        &self,
        y: &Flow,
        node: &Node<N>,
        load: &Load,
        scene: &Scene<'_, N>,
    ) -> (Flow, Impulse<N>) {
        let turn = self.turn(y, scene);
        let v = self.base_velocity(y, turn, node);
        self.law_at::<TORQUES>(y, node, turn, v, load, scene)
    }

    /// [`Dynamics::law`] for a base that moves with `v`, axes of the UAV frame.
    pub(super) fn law_at<const TORQUES: bool>(
        &self,
        y: &Flow,
        node: &Node<N>,
        turn: Turn,
        v: Twist,
        load: &Load,
        scene: &Scene<'_, N>,
    ) -> (Flow, Impulse<N>) {
        let (vehicle, posture) = (&self.vehicle, &node.posture);
        let velocity = in_inertial_frame(turn, v);
        let mut control = self.control(y, &velocity, load, scene);
        let support = if scene.contact { -self.support.stiffness * self.gap(y, turn, node) } else { 0.0 };

        let push = load.tip_force + vec2(0.0, support);
        let carried = load.base_force + push + vec2(0.0, -node.matrix.mass * vehicle.gravity);
        if self.base.thrust_carries_all() {
            control.x = -carried.y;
        }
        let thrust = self.base.uav_turn(y[2], turn).up() * control.x;
        let force = thrust + carried;

        // Moments in the UAV frame; `push_moment` is that of tip load and support about the origin.
        let gravity = turn.undo(vec2(0.0, -vehicle.gravity));
        let (tip, lift) = (turn.undo(load.tip_force), turn.undo(vec2(0.0, support)));
        let push_moment = load.tip_torque + cross(posture.end_effector, tip) + cross(posture.payload, lift);
        let moment = control.y + load.base_torque + cross(node.matrix.first, gravity) + push_moment;

        let mut impulse = Impulse::zero();
        impulse.thrust = thrust;
        impulse.axial_thrust = control.x;
        impulse.torque = control.y;
        impulse.support = support;
        if TORQUES {
            let outboard = outboard(vehicle, posture, scene.held, v, &node.rate);
            for (i, outer) in outboard.iter().enumerate() {
                let pushed = push_moment - cross(posture.joint[i], tip + lift);
                let weighed = cross(node.matrix.outboard_first[i], gravity);
                impulse.outboard[i] = weighed + pushed + outer.drift;
            }
            if let Some(balancer) = vehicle.balancer {
                let weighed = match balancer {
                    Balancer::Counterweight(slider) => slider.mass * gravity.x,
                    Balancer::Element(_) => cross(node.matrix.outboard_first[N - 1], gravity),
                };
                impulse.outboard[N - 1] = weighed + outboard[N - 1].drift;
            }
        } else {
            let outer = moment - control.y - load.base_torque;
            impulse.carried = outer - self.carried_transport(node, turn, v);
        }

        let angular = moment - self.base.transport(velocity.xy(), vec2(y[3], y[4]), node.arm);
        let error = if self.continuous() { vec2(y[1] - load.altitude, y[2] - load.roll) } else { Vec2::zeros() };
        let rate = Flow::from([velocity.x, velocity.y, velocity.z, force.x, force.y, angular, error.x, error.y]);
        (rate, impulse)
    }

    /// Height of the payload above the unloaded support \[m\].
    pub(super) fn gap(&self, y: &Flow, turn: Turn, node: &Node<N>) -> f64 {
        y[1] + turn.apply(node.posture.payload).y - self.support.height
    }

    /// How fast the payload leaves the support \[m/s\].
    pub(super) fn gap_rate(&self, y: &Flow, turn: Turn, node: &Node<N>) -> f64 {
        let v = self.base.carried(self.base_velocity(y, turn, node));
        turn.apply(node.velocity_at(&self.vehicle, node.posture.payload, v)).y
    }
}

impl<const N: usize> State<N> {
    /// The part of the state that the laws of motion integrate.
    pub(super) fn flow(&self) -> Flow {
        let (pose, h) = (&self.pose, &self.momentum);
        Flow::from([pose.x, pose.y, pose.z, h.x, h.y, h.z, self.integrals.x, self.integrals.y])
    }
}
