//! Models of the moment on the UAV: which of the base's motion the arm is taken to feel.
//!
//! For all that the UAV carries, of momentum `p_c` and angular momentum `K_c` about the UAV's centre of mass,
//! which moves with `v_0` (thesis 3.23):
//!
//! > `K_c`' = moments of weight and outer loads - `v_0` x `p_c` - moment on the UAV
//!
//! The models differ in the motion of the base that enters `K_c`, `p_c` and `v_0`:
//!
//! | model          | thesis        | motion of the base                              |
//! |----------------|---------------|-------------------------------------------------|
//! | `fixed_base`   | 3.2, (3.9)    | none                                            |
//! | `sliding_base` | 3.3, (3.13)   | the horizontal velocity                         |
//! | `free_base`    | 3.6, (3.23)   | all in which the arm takes part by the base model |

use super::law::Carrier;
use super::{Dynamics, Load, Node};
use crate::mechanics::momentum::Twist;
use crate::mechanics::planar::{Rotation, cross, perp, vec2};
use crate::parameters::{BaseModel, MomentModel};

impl<const N: usize> Dynamics<N> {
    /// What the arm feels of the base's motion `v`; axes of the UAV frame, which is turned by `rotation`.
    #[inline]
    fn felt(&self, v: Twist, rotation: Rotation) -> Twist {
        match self.moment_model {
            MomentModel::FixedBase => Twist::ZERO,
            MomentModel::SlidingBase => {
                Twist { linear: rotation.undo(vec2(rotation.apply(v.linear).x, 0.0)), angular: 0.0 }
            }
            MomentModel::FreeBase => self.base.carried(v),
        }
    }

    /// The right-hand side of the law above without the moment on the UAV \[N m\].
    #[inline]
    pub(super) fn carried_load(&self, node: &Node<N>, carrier: &Carrier, load: &Load) -> f64 {
        let Carrier { rotation, motion: v, support } = *carrier;
        let v = self.felt(v, rotation);
        // What moves along with the UAV has a momentum along v_0.
        let across = node.arm.linear + perp(node.matrix.first) * v.angular;
        self.carried_moment(rotation, node, load, support) - cross(v.linear, across)
    }

    /// Angular momentum of all that the UAV carries, from the base's motion `v`, of which it feels what the model says,
    /// from the momentum `arm` of the arm's own motion relative to the base, and from the angular momentum `system` of
    /// the whole system; linear in all three \[N m s\].
    #[inline]
    #[must_use]
    pub fn carried_angular(&self, node: &Node<N>, rotation: Rotation, v: Twist, arm: Twist, system: f64) -> f64 {
        let uav = |v: Twist| self.vehicle.uav_inertia * v.angular;
        if self.neglects_nothing() {
            return system - uav(v);
        }
        let felt = self.felt(v, rotation);
        node.matrix.of_base(felt).angular - uav(felt) + arm.angular
    }

    /// Whether neither the model of the base nor that of the moment neglects anything: the arm feels all that the base
    /// does, and the integral of the carried load follows from changes of momentum.
    #[must_use]
    pub fn neglects_nothing(&self) -> bool {
        self.base == BaseModel::Full && self.moment_model == MomentModel::FreeBase
    }
}
