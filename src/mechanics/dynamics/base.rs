//! Models of the base: which of its velocities answer to the rates, and which follow from forces alone.
//!
//! All of them share one right-hand side. With p and K integrated from the loads as in `law`, and
//! (a_x, a_y, a_K) = `H_m q_dot` the momentum of the arm relative to the base, they differ in the motion of
//! the base alone (thesis chapter 2; M is the mass of the whole system, I the inertia of the UAV):
//!
//! | model               | thesis | `v_x`          | `v_y`          | roll rate       | neglects                     |
//! |---------------------|--------|--------------|--------------|-----------------|------------------------------|
//! | `ideal`             | 2.1    | (`p_x` - `a_x`)/M | 0            | 0               | thrust is vertical, p is kept |
//! | `horizontal_thrust` | 2.2    | (`p_x` - `a_x`)/M | 0            | (K - `a_K`)/I     | all vertical motion          |
//! | `vertical_thrust`   | 2.3    | (`p_x` - `a_x`)/M | `p_y`/M        | (K - `a_K`)/I     | `a_y` in the altitude          |
//! | `translating`       | 2.4    | (`p_x` - `a_x`)/M | (`p_y` - `a_y`)/M | (K - `a_K`)/I     | what turns with the UAV      |
//! | `full`              | 2.5    | `H_b`^-1 (h - `H_m q_dot`) | | | nothing                      |
//!
//! In the three models between `ideal` and `full` the roll tilts the thrust and is controlled, but the arm does
//! not turn with it, and the moment of the arm is that of an arm on a base at rest: (2.13) to (2.15), with
//! the difference of rates written as a change of angular momentum.

use crate::mechanics::momentum::{MomentumMatrix, Twist};
use crate::mechanics::planar::{Rotation, Vec2, cross, vec2};
use crate::parameters::BaseModel;

impl BaseModel {
    /// Motion of the base with the momentum `h` of the whole system and `arm` = `H_m q_dot` of it; linear in
    /// both. `inertia`: that of the UAV alone \[kg m2\]. Axes of the UAV frame.
    #[inline]
    pub(super) fn velocity<const N: usize>(
        self,
        matrix: &MomentumMatrix<N>,
        inertia: f64,
        h: Twist,
        arm: Twist,
    ) -> Twist {
        match self {
            Self::Full => matrix.base_response(h - arm),
            _ => self.reduced_velocity(matrix.mass, inertia, h, h - arm),
        }
    }

    /// The same for the models that neglect something; `left` = `h` - `arm`. One copy for all numbers of coordinates,
    /// and out of the way of the full model.
    #[inline(never)]
    pub(super) fn reduced_velocity(self, mass: f64, inertia: f64, h: Twist, left: Twist) -> Twist {
        let y = match self {
            Self::Ideal => return Twist { linear: vec2(left.linear.x / mass, 0.0), angular: 0.0 },
            Self::HorizontalThrust => 0.0,
            Self::VerticalThrust => h.linear.y,
            Self::Translating | Self::Full => left.linear.y,
        };
        Twist { linear: vec2(left.linear.x, y) / mass, angular: left.angular / inertia }
    }

    /// Whether the arm turns with the UAV.
    pub(super) fn turns_arm(self) -> bool {
        self == Self::Full
    }

    /// The part of the motion `v` of the base in which the arm takes part.
    pub(crate) fn carried(self, v: Twist) -> Twist {
        if self.turns_arm() { v } else { Twist { angular: 0.0, ..v } }
    }

    /// The turn of the arm's frame at the angle `roll` of the UAV \[rad\].
    pub(super) fn rotation(self, roll: f64) -> Rotation {
        if self.turns_arm() { Rotation::by(roll) } else { Rotation::NONE }
    }

    /// Whether the thrust is as large as all vertical loads, whatever the altitude control says (2.16).
    pub(super) fn thrust_carries_all(self) -> bool {
        self == Self::HorizontalThrust
    }

    /// How fast angular momentum about the UAV's centre of mass falls because that point moves, `v` x p;
    /// inertial frame. On a carriage p_y is that of the arm alone; (2.13) takes the base to be at rest.
    pub(super) fn transport(self, v: Vec2, p: Vec2, arm: Twist) -> f64 {
        match self {
            Self::Ideal => cross(v, vec2(p.x, arm.linear.y)),
            Self::HorizontalThrust | Self::VerticalThrust | Self::Translating => 0.0,
            Self::Full => cross(v, p),
        }
    }
}
