//! Velocities and accelerations at the knots of a path.

use super::Knot;
use crate::mechanics::planar::Vec2;

/// The velocities of the cubic spline through the knots that is at rest at both ends.
///
/// Continuous acceleration at knot i, between intervals of lengths g and h over which the mean velocities are c and d, says
/// h v(i-1) + 2 (g + h) v(i) + g v(i+1) = 3 (h c + g d): a tridiagonal system, solved from the first knot to the last and
/// back. Its diagonal is twice the rest of the row, so that nothing is lost.
pub(super) fn write_velocities(knots: &mut [Knot]) {
    let inner = 1..knots.len().saturating_sub(1);
    // What is left of the coefficient of the next velocity, after the one before has been eliminated.
    let mut factors = vec![0.0; knots.len()];
    for i in inner.clone() {
        let ([g, h], [c, d]) = around(knots, i);
        let pivot = 2.0 * (g + h) - h * factors[i - 1];
        factors[i] = g / pivot;
        knots[i].velocity = ((c * h + d * g) * 3.0 - knots[i - 1].velocity * h) / pivot;
    }
    for i in inner.rev() {
        knots[i].velocity -= knots[i + 1].velocity * factors[i];
    }
}

/// The accelerations at the knots, of which positions and velocities are known.
pub(super) fn write_accelerations(knots: &mut [Knot], has_velocities: bool) {
    let Some(last) = knots.len().checked_sub(1).filter(|&last| last > 0) else { return };
    for i in 1..last {
        knots[i].acceleration = if has_velocities { of_order_5(knots, i) } else { after(&knots[i], &knots[i + 1]) };
    }
    let rests = |knot: &Knot| has_velocities && knot.velocity == Vec2::zeros();
    if !rests(&knots[0]) {
        knots[0].acceleration = after(&knots[0], &knots[1]);
    }
    if !rests(&knots[last]) {
        knots[last].acceleration = before(&knots[last - 1], &knots[last]);
    }
}

/// Lengths of the intervals before and after knot `i` \[s\], and the mean velocities in them \[m/s\].
fn around(knots: &[Knot], i: usize) -> ([f64; 2], [Vec2; 2]) {
    let mean = |from: &Knot, to: &Knot| (to.position - from.position) / (to.time - from.time);
    let (before, here, after) = (&knots[i - 1], &knots[i], &knots[i + 1]);
    ([here.time - before.time, after.time - here.time], [mean(before, here), mean(here, after)])
}

/// The acceleration of the cubic polynomial between two knots at the first one.
fn after(from: &Knot, to: &Knot) -> Vec2 {
    let h = to.time - from.time;
    ((to.position - from.position) * (3.0 / h) - from.velocity * 2.0 - to.velocity) * (2.0 / h)
}

/// The acceleration of the cubic polynomial between two knots at the second one.
fn before(from: &Knot, to: &Knot) -> Vec2 {
    let h = to.time - from.time;
    (from.velocity + to.velocity * 2.0 - (to.position - from.position) * (3.0 / h)) * (2.0 / h)
}

/// The acceleration at knot `i` of the polynomial of order 5 that passes it and both beside it with their velocities.
///
/// With the mean velocities c and d, and u(-), u, u(+) the velocities, over the intervals g and h before and after it:
/// P = (d - u) / h, V = (u(+) - u) / h after it, Q = (u - c) / g, W = (u - u(-)) / g before it. Eliminating the coefficients
/// of orders 3 to 5 leaves (g + h)^3 a / 4 = g^3 (4 P - V) + h^3 (4 Q - W) - (g - h) (g^2 (5 P - V) - h^2 (5 Q - W)) / 2.
fn of_order_5(knots: &[Knot], i: usize) -> Vec2 {
    let ([g, h], [c, d]) = around(knots, i);
    let u = knots[i].velocity;
    let (p, v) = ((d - u) / h, (knots[i + 1].velocity - u) / h);
    let (q, w) = ((u - c) / g, (u - knots[i - 1].velocity) / g);
    // In shares of both intervals, whose powers do not overflow.
    let [g, h] = [g / (g + h), h / (g + h)];
    let sum = (p * 4.0 - v) * (g * g * g) + (q * 4.0 - w) * (h * h * h);
    (sum - ((p * 5.0 - v) * (g * g) - (q * 5.0 - w) * (h * h)) * (0.5 * (g - h))) * 4.0
}
