//! Times and velocities for waypoints that have none.
//!
//! The way along the straight lines between the waypoints is covered as a smooth leg covers its own. The direction at a
//! waypoint is that of the natural cubic spline over this way.

use super::TableError;
use crate::mechanics::planar::{Vec2, vec2};
use crate::reference::{Leg, Profile};

/// The ramps take at least this share of the time that the way takes without them.
const LEAST_RAMP: f64 = 0.25;

/// Halvings of an interval of time, after which nothing is left of it.
const HALVINGS: usize = 60;

/// Rows of time, x, y, vx and vy through these waypoints.
pub(super) fn timed(waypoints: &[[f64; 2]], speed: f64) -> Result<Vec<[f64; 5]>, TableError> {
    let points: Vec<Vec2> = waypoints.iter().map(|[x, y]| vec2(*x, *y)).collect();
    let ways = ways(&points)?;
    let length = ways.last().copied().unwrap_or_default();
    let alone = length / speed;
    if !(speed > 0.0 && alone > 0.0 && (2.0 * alone).is_finite()) {
        return Err(TableError::Speed { found: speed });
    }
    // It speeds up between the first two waypoints at least, and slows down between the last two: else the polynomials,
    // which know the motion at the waypoints alone, would overshoot.
    let outer = |i: usize| ways.windows(2).nth(i).map_or(0.0, |pair| pair[1] - pair[0]);
    let ends = outer(0).max(outer(ways.len() - 2));
    let ramp = (2.0 * ends / speed).max(LEAST_RAMP * alone).min(alone);
    let leg = Leg { duration: alone + ramp, ramp, profile: Profile::Smooth, ..Leg::NONE };
    let last = points.len() - 1;
    let row = |(i, (point, direction)): (usize, (&Vec2, Vec2))| {
        let (time, rate) = match i {
            0 => (0.0, 0.0),
            i if i == last => (leg.duration, 0.0),
            i => passing(&leg, ways[i] / length),
        };
        // Not minus 0, which would look odd in a file.
        let velocity = if rate > 0.0 { direction * (rate * length) } else { Vec2::zeros() };
        [time, point.x, point.y, velocity.x, velocity.y]
    };
    Ok(points.iter().zip(directions(&points, &ways)).enumerate().map(row).collect())
}

/// The way from the first waypoint to each \[m\].
fn ways(points: &[Vec2]) -> Result<Vec<f64>, TableError> {
    let mut ways = vec![0.0];
    for (number, pair) in (2..).zip(points.windows(2)) {
        let way = (pair[1] - pair[0]).norm();
        if !(way > 0.0 && way.is_finite()) {
            let found = format!("{:?}", [pair[1].x, pair[1].y]);
            let expected = format!("of finite numbers, and apart from that before, {:?}", [pair[0].x, pair[0].y]);
            return Err(TableError::Row { row: number, what: "the waypoint", expected, found });
        }
        ways.push(ways[number - 2] + way);
    }
    Ok(ways)
}

/// When the `leg` has covered a `share` of its way \[s\], and its rate then \[1/s\].
fn passing(leg: &Leg, share: f64) -> (f64, f64) {
    let [mut early, mut late] = [0.0, leg.duration];
    for _ in 0..HALVINGS {
        let middle = 0.5 * (early + late);
        if leg.progress(middle)[0] < share { early = middle } else { late = middle }
    }
    let [_, rate, _] = leg.progress(late);
    (late, rate)
}

/// Derivatives with respect to the way, at the waypoints, of the cubic spline that is not bent at both ends: for each two
/// neighbouring intervals the equation of `super::spline::write_velocities`, and 2 v + v(beside) = 3 d at the ends.
fn directions(points: &[Vec2], ways: &[f64]) -> Vec<Vec2> {
    let last = points.len() - 1;
    let interval = |i: usize| (ways[i + 1] - ways[i], (points[i + 1] - points[i]) / (ways[i + 1] - ways[i]));
    let mut factors = vec![0.0; points.len()];
    let mut directions = vec![Vec2::zeros(); points.len()];
    for i in 0..=last {
        let (before, after) = ((i > 0).then(|| interval(i - 1)), (i < last).then(|| interval(i)));
        let ([lower, diagonal, upper], right) = match (before, after) {
            (Some((g, c)), Some((h, d))) => ([h, 2.0 * (g + h), g], (c * h + d * g) * 3.0),
            (Some((_, c)), None) => ([1.0, 2.0, 0.0], c * 3.0),
            (None, Some((_, d))) => ([0.0, 2.0, 1.0], d * 3.0),
            (None, None) => ([0.0, 1.0, 0.0], Vec2::zeros()),
        };
        let (factor, direction) = if i > 0 { (factors[i - 1], directions[i - 1]) } else { (0.0, Vec2::zeros()) };
        let pivot = diagonal - lower * factor;
        factors[i] = upper / pivot;
        directions[i] = (right - direction * lower) / pivot;
    }
    for i in (0..last).rev() {
        let next = directions[i + 1];
        directions[i] -= next * factors[i];
    }
    directions
}
