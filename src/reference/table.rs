//! A path as a table: where the end effector is to be at which times, smooth between them.
//!
//! Every knot has a place, a velocity and an acceleration, and between two of them runs the polynomial of order 5 that has
//! those of both. So all three are continuous, whatever the velocities and accelerations are:
//!
//! - Where the table has no velocities, they are those of the cubic spline that is at rest at both ends. It is a polynomial
//!   of order 3 between knots, and one of order 5 with its accelerations is the same.
//! - Where the table has velocities, cubic polynomials would let the acceleration jump at each knot. The accelerations are
//!   those of the polynomial of order 5 through a knot and both beside it: exact for polynomials up to that order, and
//!   decided by neighbours alone. At the ends they are those of the cubic polynomial; at an end at rest they are 0, as outside.

use super::Target;
use crate::mechanics::planar::{Vec2, vec2};

mod spline;
mod waypoints;

/// Most knots of a table.
pub const MOST_KNOTS: usize = 100_000;

/// Numbers of a row with velocity: time, x, y, vx, vy.
const WITH_VELOCITY: usize = 5;

/// Why rows are no path. Rows count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TableError {
    /// Less than a beginning and an end.
    #[error("a path needs at least 2 rows, but has {found}")]
    TooFew {
        /// Number of rows.
        found: usize,
    },
    /// More than fit into a unit.
    #[error("a path has at most {MOST_KNOTS} rows, not {found}")]
    TooMany {
        /// Number of rows.
        found: usize,
    },
    /// A row that does not go on with the path.
    #[error("row {row}: {what} must be {expected}, but is {found}")]
    Row {
        /// Its number.
        row: usize,
        /// What of it.
        what: &'static str,
        /// What would be right.
        expected: String,
        /// What is there.
        found: String,
    },
    /// A speed at which nothing gets anywhere.
    #[error(
        "the speed must be a number of m/s above 0, with which the path takes a time that can be counted, but is {found}"
    )]
    Speed {
        /// The speed \[m/s\].
        found: f64,
    },
}

/// A point of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Knot {
    /// From the start of the run \[s\].
    time: f64,
    /// In any frame that does not move \[m\]: only differences count.
    position: Vec2,
    /// \[m/s\]
    velocity: Vec2,
    /// \[m/s2\]
    acceleration: Vec2,
}

/// A path through knots, at rest before the first one and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct PathTable {
    knots: Box<[Knot]>,
    /// Whether the velocities stand in the table.
    has_velocities: bool,
}

/// All of it is finite.
impl Eq for PathTable {}

impl PathTable {
    /// A path from rows of time \[s\], x and y \[m\], and in all of them or in none the velocities along both \[m/s\]. Times
    /// count from the start of the run and increase.
    ///
    /// # Errors
    /// Names the first row that does not go on with the path, with what is expected and found.
    pub fn new<R: AsRef<[f64]>>(rows: &[R]) -> Result<Self, TableError> {
        check_number(rows.len())?;
        let width = rows.first().map_or(0, |row| row.as_ref().len());
        let mut knots = Vec::with_capacity(rows.len());
        for (number, row) in (1..).zip(rows) {
            knots.push(read(number, row.as_ref(), width, knots.last())?);
        }
        let has_velocities = width == WITH_VELOCITY;
        if !has_velocities {
            spline::write_velocities(&mut knots);
        }
        spline::write_accelerations(&mut knots, has_velocities);
        for (row, knot) in (1..).zip(&knots) {
            let all = [knot.velocity, knot.acceleration];
            if !all.iter().flatten().all(|number| number.is_finite()) {
                let (what, expected) = ("the motion there", "of finite velocity and acceleration".to_owned());
                return Err(TableError::Row { row, what, expected, found: format!("{:?}", all.map(|v| [v.x, v.y])) });
            }
        }
        Ok(Self { knots: knots.into(), has_velocities })
    }

    /// A path through waypoints, each x and y \[m\], at a speed \[m/s\]: it speeds up from rest, cruises and slows down to
    /// rest. Between waypoints, which it passes without stopping, it is smooth.
    ///
    /// # Errors
    /// Names the first waypoint that is none, or where the one before is.
    pub fn through(waypoints: &[[f64; 2]], speed: f64) -> Result<Self, TableError> {
        check_number(waypoints.len())?;
        Self::new(&waypoints::timed(waypoints, speed)?)
    }

    /// What [`Self::new`] makes this path of, bit by bit.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = Vec<f64>> {
        self.knots.iter().map(|Knot { time, position, velocity, .. }| {
            let mut row = vec![*time, position.x, position.y];
            if self.has_velocities {
                row.extend([velocity.x, velocity.y]);
            }
            row
        })
    }

    /// When it comes to rest, from the start \[s\].
    #[must_use]
    pub fn end(&self) -> f64 {
        self.knots.last().map_or(0.0, |knot| knot.time)
    }

    /// The same path with all times divided by `pace`, and all ways multiplied by `size`.
    ///
    /// # Errors
    /// If the numbers become so large or small that it is none any more.
    pub fn scaled(&self, pace: f64, size: f64) -> Result<Self, TableError> {
        let factors = [1.0 / pace, size, size, pace * size, pace * size];
        let scale = |row: Vec<f64>| row.iter().zip(factors).map(|(number, factor)| number * factor).collect();
        Self::new(&self.rows().map(scale).collect::<Vec<Vec<f64>>>())
    }

    /// The motion at time `t` \[s\] from the start, its displacement from the first knot.
    #[must_use]
    pub fn at(&self, t: f64) -> Target {
        let ([first, ..], [.., last]) = (&*self.knots, &*self.knots) else { return Target::AT_REST };
        if t <= first.time {
            return Target::AT_REST;
        }
        // The knots before `t`, of which there is one.
        let before = self.knots.partition_point(|knot| knot.time <= t);
        let (Some(from), Some(to)) = (self.knots.get(before.wrapping_sub(1)), self.knots.get(before)) else {
            return Target { displacement: last.position - first.position, ..Target::AT_REST };
        };
        let mut target = between(from, to, t);
        target.displacement += from.position - first.position;
        target
    }
}

/// The polynomial of order 5 between two knots at time `t` \[s\], its displacement from the first of them.
fn between(from: &Knot, to: &Knot, t: f64) -> Target {
    let (v, a) = (from.velocity, from.acceleration);
    let (h, elapsed) = (to.time - from.time, t - from.time);
    let s = elapsed / h;
    // What the end misses if the first acceleration goes on, in units of length, and the coefficients that make it good.
    let way = to.position - from.position - (v + a * (0.5 * h)) * h;
    let rate = (to.velocity - v - a * h) * h;
    let bend = (to.acceleration - a) * (0.5 * h * h);
    let [c3, c4, c5] =
        [way * 10.0 - rate * 4.0 + bend, way * -15.0 + rate * 7.0 - bend * 2.0, way * 6.0 - rate * 3.0 + bend];
    Target {
        displacement: (v + a * (0.5 * elapsed)) * elapsed + (c3 + (c4 + c5 * s) * s) * (s * s * s),
        velocity: v + a * elapsed + (c3 * 3.0 + (c4 * 4.0 + c5 * (5.0 * s)) * s) * (s * s / h),
        acceleration: a + (c3 * 6.0 + (c4 * 12.0 + c5 * (20.0 * s)) * s) * (s / (h * h)),
    }
}

fn check_number(found: usize) -> Result<(), TableError> {
    match found {
        0 | 1 => Err(TableError::TooFew { found }),
        2..=MOST_KNOTS => Ok(()),
        _ => Err(TableError::TooMany { found }),
    }
}

/// A row as a knot, which follows on the one `before`; all rows have the same `width`.
fn read(number: usize, row: &[f64], width: usize, before: Option<&Knot>) -> Result<Knot, TableError> {
    let wrong = |what, expected: &str, found: String| {
        Err(TableError::Row { row: number, what, expected: expected.to_owned(), found })
    };
    let (time, x, y, velocity) = match *row {
        [time, x, y] if width == row.len() => (time, x, y, Vec2::zeros()),
        [time, x, y, vx, vy] if width == row.len() => (time, x, y, vec2(vx, vy)),
        _ => {
            let expected = "time, x, y or time, x, y, vx, vy, in all rows alike";
            return wrong("what it holds", expected, format!("{} numbers", row.len()));
        }
    };
    for (what, number) in ["time", "x", "y", "vx", "vy"].into_iter().zip(row) {
        if !number.is_finite() {
            return wrong(what, "a finite number", number.to_string());
        }
    }
    match before {
        None if time < 0.0 => wrong("time", "0 or later", format!("{time:?}")),
        Some(before) if time <= before.time => {
            wrong("time", &format!("after {:?}, that of the row before", before.time), format!("{time:?}"))
        }
        _ => Ok(Knot { time, position: vec2(x, y), velocity, acceleration: Vec2::zeros() }),
    }
}
