//! Cosine and sine of any angle: the nearest of 128 turns that are known, and a small one from there.
//!
//! Exact to 4e-16, and in a third of the time of the general functions, which matters where postures are worked out
//! from joint angles: with them it is a third of an inverse kinematics.

use super::Turn;

/// Known turns in a circle.
const COUNT: usize = 128;
/// Known turns in a quarter.
const QUARTER: usize = COUNT / 4;
/// Angle from one to the next \[rad\], and its inverse.
const STEP: f64 = std::f64::consts::TAU / COUNT as f64;
const PER_STEP: f64 = 1.0 / STEP;
/// The upper half of [`STEP`], of which a million still is a number without rounding, and the rest.
const STEP_UPPER: f64 = f64::from_bits(STEP.to_bits() & !0xffff_ffff);
const STEP_LOWER: f64 = (STEP - STEP_UPPER) + TAU_REST / COUNT as f64;
/// What the full turn has beyond the number that stands for it \[rad\].
const TAU_REST: f64 = 2.449_293_598_294_706_4e-16;
/// Angles beyond this are left to the general functions \[rad\].
const FARTHEST: f64 = 5e4;
/// A number this large, added and taken away again, rounds to whole numbers, and shows them in its last bits.
const ROUND: f64 = 1.5 * (1_u64 << 52) as f64;

static KNOWN: [Turn; COUNT] = known();

/// The turn by `angle` \[rad\].
pub(super) fn turn(angle: f64) -> Turn {
    if angle.abs() < FARTHEST {
        let shifted = angle * PER_STEP + ROUND;
        let steps = shifted - ROUND;
        #[allow(clippy::cast_possible_truncation)] // the last bits are wanted
        let place = shifted.to_bits() as usize % COUNT;
        return KNOWN[place].then(Turn::by_series((angle - steps * STEP_UPPER) - steps * STEP_LOWER));
    }
    let (sin, cos) = libm::sincos(angle);
    Turn { cos, sin }
}

const fn known() -> [Turn; COUNT] {
    let mut known = [Turn::NONE; COUNT];
    let mut i = 0;
    while i < QUARTER {
        let Turn { cos, sin } = by_long_series(i as f64 * STEP);
        known[i] = Turn { cos, sin };
        known[i + QUARTER] = Turn { cos: -sin, sin: cos };
        known[i + 2 * QUARTER] = Turn { cos: -cos, sin: -sin };
        known[i + 3 * QUARTER] = Turn { cos: sin, sin: -cos };
        i += 1;
    }
    known
}

/// The turn by an angle of at most a quarter \[rad\]: the power series, summed up from their last terms.
const fn by_long_series(angle: f64) -> Turn {
    let square = angle * angle;
    let (mut cos, mut sin) = (0.0, 0.0);
    let mut n = 26.0;
    while n > 0.0 {
        cos = 1.0 - square / (n * (n - 1.0)) * cos;
        sin = 1.0 - square / (n * (n + 1.0)) * sin;
        n -= 2.0;
    }
    Turn { cos, sin: angle * sin }
}
