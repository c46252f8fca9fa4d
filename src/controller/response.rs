//! How end effector, base and moment on the UAV answer to the rates: generalized and extended Jacobian.

use nalgebra::{SMatrix, SVector};

use crate::dynamics::{Dynamics, Node, State};
use crate::momentum::Twist;
use crate::planar::{Vec2, cross, perp};

/// Linear answers to the rates in one configuration, axes of the UAV frame:
/// v_b = base q_dot + base_free and v_ee = jacobian q_dot + end_effector_free (thesis 2.27 and 2.28).
#[derive(Debug, Clone, Copy)]
pub(super) struct Response<const N: usize> {
    /// Motion of the base per rate; -H_b^-1 H_m with the full model of it.
    pub base: [Twist; N],
    /// Motion of the base without rates; H_b^-1 h with the full model of it.
    pub base_free: Twist,
    /// Generalized Jacobian: velocity of the end effector per rate \[m\].
    pub jacobian: SMatrix<f64, 2, N>,
    /// Velocity of the end effector without rates \[m/s\].
    pub end_effector_free: Vec2,
    /// Moment impulse on the UAV per rate \[kg m2, kg m\]: the row that makes the Jacobian an extended one.
    pub moment: SVector<f64, N>,
}

impl<const N: usize> Response<N> {
    /// Answers of a system with the arm at `node` and the momentum `h`, axes of the UAV frame.
    pub fn new(dynamics: &Dynamics<N>, node: &Node<N>, h: Twist) -> Self {
        let (vehicle, matrix, tip) = (&dynamics.vehicle, &node.matrix, node.posture.end_effector);
        let base = matrix.columns.map(|column| dynamics.base_motion(node, Twist::ZERO, column));
        let base_free = dynamics.base_motion(node, h, Twist::ZERO);
        let at_tip = |v: Twist| {
            let v = dynamics.base.carried(v);
            v.linear + perp(tip) * v.angular
        };
        let own = |i: usize| {
            if i < vehicle.links { perp(tip - node.posture.joint[i]) } else { Vec2::zeros() }
        };
        let jacobian = SMatrix::from_fn(|row, i| (at_tip(base[i]) + own(i))[row]);
        let moment = if dynamics.on_carriage() {
            // The carriage takes up what is missing from K: -(K per rate).
            SVector::from_fn(|i, _| -(matrix.columns[i].angular + cross(matrix.first, base[i].linear)))
        } else {
            // What turns the UAV comes from the rotors or from what it carries.
            SVector::from_fn(|i, _| vehicle.uav_inertia * base[i].angular)
        };
        Self { base, base_free, jacobian, end_effector_free: at_tip(base_free), moment }
    }

    /// The same, with the coordinate `held` at rest.
    pub fn holding(mut self, held: usize) -> Self {
        self.base[held] = Twist::ZERO;
        self.jacobian.column_mut(held).fill(0.0);
        self.moment[held] = 0.0;
        self
    }

    /// Motion of the base at the rates `rate`, axes of the UAV frame.
    pub fn base_velocity(&self, rate: &SVector<f64, N>) -> Twist {
        self.base.iter().zip(rate.iter()).fold(self.base_free, |v, (reaction, rate)| v + *reaction * *rate)
    }
}

/// Moment impulse \[N m s\] that arm, payload and counterweight exert on the UAV, from the change of the
/// UAV's angular velocity and the impulse of the rotors' torque.
pub(super) fn moment_impulse<const N: usize>(
    dynamics: &Dynamics<N>,
    before: &State<N>,
    after: &State<N>,
    torque_impulse: f64,
) -> f64 {
    dynamics.vehicle.uav_inertia * (after.velocity.z - before.velocity.z) - torque_impulse
}
