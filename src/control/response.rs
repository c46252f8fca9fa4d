//! How end effector and angular momentum answer to the rates: generalized and extended Jacobian.

use nalgebra::{SMatrix, SVector};

use crate::mechanics::dynamics::{Dynamics, Node};
use crate::mechanics::momentum::Twist;
use crate::mechanics::planar::{Rotation, Vec2, perp};

/// Linear answers to the rates in one configuration, axes of the UAV frame:
/// v_ee = jacobian q_dot + end_effector_free (thesis 2.28).
#[derive(Debug, Clone, Copy)]
pub struct Response<const N: usize> {
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
    /// Answers of a system whose arm is at `node`, turned by `rotation`, with this momentum in the axes of the UAV frame;
    /// `held`: of an arm whose last coordinate is kept at rest.
    #[must_use]
    pub fn new(dynamics: &Dynamics<N>, node: &Node<N>, rotation: Rotation, momentum: Twist, held: bool) -> Self {
        // Two copies: where the compiler knows the models, it needs two thirds of the instructions. A step of
        // `minimum_norm` with `euler` takes 5 % fewer.
        if dynamics.neglects_nothing() {
            Self::written(dynamics, node, rotation, momentum, held)
        } else {
            Self::by_models(dynamics, node, rotation, momentum, held)
        }
    }

    #[cold]
    #[inline(never)]
    fn by_models(dynamics: &Dynamics<N>, node: &Node<N>, rotation: Rotation, momentum: Twist, held: bool) -> Self {
        Self::written(dynamics, node, rotation, momentum, held)
    }

    #[inline(always)]
    fn written(dynamics: &Dynamics<N>, node: &Node<N>, rotation: Rotation, momentum: Twist, held: bool) -> Self {
        let (posture, tip) = (&node.posture, node.posture.end_effector);
        let at_tip = |v: Twist| {
            let v = dynamics.base.carried(v);
            v.linear + perp(tip) * v.angular
        };
        let free = dynamics.base_motion(node, momentum, Twist::ZERO);
        let mut response = Self {
            jacobian: SMatrix::zeros(),
            end_effector_free: at_tip(free),
            carried: SVector::zeros(),
            carried_free: dynamics.carried_angular(node, rotation, free, Twist::ZERO, momentum.angular),
        };
        for (i, column) in node.matrix.columns.iter().enumerate() {
            if held && i == N - 1 {
                break;
            }
            // Rates alone give the system no momentum: the base reacts with that of the arm.
            let base = dynamics.base_motion(node, Twist::ZERO, *column);
            let own = perp(tip - posture.joint[i]) * dynamics.vehicle.revolute[i];
            response.jacobian.set_column(i, &(at_tip(base) + own));
            response.carried[i] = dynamics.carried_angular(node, rotation, base, *column, 0.0);
        }
        response
    }

    /// Angular momentum of what the UAV carries at the rates `rate` \[N m s\].
    #[must_use]
    pub fn carried_momentum(&self, rate: &SVector<f64, N>) -> f64 {
        self.carried_free + self.carried.dot(rate)
    }
}
