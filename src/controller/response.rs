//! How end effector, base and angular momentum answer to the rates: generalized and extended Jacobian.

use nalgebra::{SMatrix, SVector};

use crate::dynamics::{Dynamics, Node};
use crate::momentum::Twist;
use crate::planar::{Turn, Vec2, perp};

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
    /// Angular momentum of what the UAV carries, about the UAV's centre of mass, per rate \[kg m2, kg m\]: the
    /// row that makes the Jacobian an extended one (thesis 3.12, 3.17 and 3.26).
    pub carried: SVector<f64, N>,
    /// The same without rates \[N m s\].
    pub carried_free: f64,
}

impl<const N: usize> Response<N> {
    /// Answers of a system whose arm is at `node`, turned by `turn`, with this momentum in the axes of the UAV frame.
    pub fn new(dynamics: &Dynamics<N>, node: &Node<N>, turn: Turn, momentum: Twist) -> Self {
        let vehicle = &dynamics.vehicle;
        let (matrix, tip) = (&node.matrix, node.posture.end_effector);
        let base = matrix.columns.map(|column| dynamics.base_motion(node, Twist::ZERO, column));
        let base_free = dynamics.base_motion(node, momentum, Twist::ZERO);
        let at_tip = |v: Twist| {
            let v = dynamics.base.carried(v);
            v.linear + perp(tip) * v.angular
        };
        let own = |i: usize| {
            if i < vehicle.links { perp(tip - node.posture.joint[i]) } else { Vec2::zeros() }
        };
        let carried = |v: Twist, arm: Twist, system: f64| dynamics.carried_angular(node, turn, v, arm, system);
        Self {
            base,
            base_free,
            jacobian: SMatrix::from_fn(|row, i| (at_tip(base[i]) + own(i))[row]),
            end_effector_free: at_tip(base_free),
            // Rates alone give the system no momentum.
            carried: SVector::from_fn(|i, _| carried(base[i], matrix.columns[i], 0.0)),
            carried_free: carried(base_free, Twist::ZERO, momentum.angular),
        }
    }

    /// The same, with the coordinate `held` at rest.
    pub fn holding(mut self, held: usize) -> Self {
        self.base[held] = Twist::ZERO;
        self.jacobian.column_mut(held).fill(0.0);
        self.carried[held] = 0.0;
        self
    }

    /// Way of the base over the short way `way` of the coordinates, axes of the UAV frame.
    pub fn base_way(&self, way: &SVector<f64, N>) -> Twist {
        self.base.iter().zip(way).fold(Twist::ZERO, |sum, (reaction, way)| sum + *reaction * *way)
    }

    /// Motion of the base at the rates `rate`, axes of the UAV frame.
    pub fn base_velocity(&self, rate: &SVector<f64, N>) -> Twist {
        self.base_free + self.base_way(rate)
    }

    /// Angular momentum of what the UAV carries at the rates `rate` \[N m s\].
    pub fn carried_momentum(&self, rate: &SVector<f64, N>) -> f64 {
        self.carried_free + self.carried.dot(rate)
    }
}
