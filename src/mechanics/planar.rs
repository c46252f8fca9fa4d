//! Vectors and rotations in the plane.

use nalgebra::SVector;

use crate::memory;

/// A vector in the plane: right, up.
pub type Vec2 = SVector<f64, 2>;

/// The vector (x, y).
#[must_use]
pub const fn vec2(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

/// The component out of the plane of `a` x `b`.
#[must_use]
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// `a` turned by +90 degrees: the velocity of a point at `a` per angular velocity.
#[must_use]
pub fn perp(a: Vec2) -> Vec2 {
    vec2(-a.y, a.x)
}

/// A rotation in the plane, counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rotation {
    cos: f64,
    sin: f64,
}

memory!(Rotation { cos, sin });

impl Rotation {
    /// By no angle.
    pub const NONE: Self = Self { cos: 1.0, sin: 0.0 };

    /// By `angle` \[rad\].
    #[must_use]
    pub fn by(angle: f64) -> Self {
        let (sin, cos) = libm::sincos(angle);
        Self { cos, sin }
    }

    /// By the angle with this cosine and sine.
    #[must_use]
    pub const fn with(cos: f64, sin: f64) -> Self {
        Self { cos, sin }
    }

    /// Cosine and sine of the angle.
    #[must_use]
    pub const fn cos_sin(self) -> [f64; 2] {
        [self.cos, self.sin]
    }

    /// By `angle` \[rad\] that is usually small: short polynomials, exact to rounding below 0.03 rad, take
    /// half the time of a general turn.
    #[inline]
    #[must_use]
    pub fn from_small_angle(angle: f64) -> Self {
        if angle.abs() > 0.03 {
            return Self::by(angle);
        }
        let x = angle * angle;
        let sin = angle - angle * x * (1.0 / 6.0 - x * (1.0 / 120.0 - x * (1.0 / 5040.0)));
        let cos = 1.0 - x * (0.5 - x * (1.0 / 24.0 - x * (1.0 / 720.0)));
        Self { cos, sin }
    }

    /// By `angle` \[rad\] so small that its square is nothing.
    #[inline]
    #[must_use]
    pub const fn by_tiny(angle: f64) -> Self {
        Self { cos: 1.0, sin: angle }
    }

    /// This turn and then `other`.
    #[inline]
    #[must_use]
    pub fn then(self, other: Self) -> Self {
        Self { cos: self.cos * other.cos - self.sin * other.sin, sin: self.sin * other.cos + self.cos * other.sin }
    }

    /// `v` turned.
    #[inline]
    #[must_use]
    pub fn apply(self, v: Vec2) -> Vec2 {
        vec2(self.cos * v.x - self.sin * v.y, self.sin * v.x + self.cos * v.y)
    }

    /// `v` turned back.
    #[inline]
    #[must_use]
    pub fn undo(self, v: Vec2) -> Vec2 {
        vec2(self.cos * v.x + self.sin * v.y, -self.sin * v.x + self.cos * v.y)
    }

    /// The direction straight down, turned: where a link with this absolute angle points, (sin, -cos).
    #[inline]
    #[must_use]
    pub fn down(self) -> Vec2 {
        vec2(self.sin, -self.cos)
    }

    /// The direction straight up, turned: where the thrust of a UAV with this roll points, (-sin, cos).
    #[inline]
    #[must_use]
    pub fn up(self) -> Vec2 {
        vec2(-self.sin, self.cos)
    }
}
