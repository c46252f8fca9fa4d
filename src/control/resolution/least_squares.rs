//! As little moment on the UAV as the path and the limits leave possible (thesis 3.7, 3.8 and 4.4).
//!
//! One step of sequential quadratic programming: path and moment are linear in the rates. Limits come
//! first, then the path in the sense of least squares, then
//!
//! (mean moment on the UAV)^2 + `rate_penalty` * sum of |joint rates|   (3.27) and (4.3)
//!
//! with a square of the rates beside their price that keeps them steady ([`STEADINESS`]).
//!
//! What the extended Jacobian would do without limits is asked for; so the two agree where no limit
//! binds, and both keep calm near singular configurations.

use nalgebra::SVector;

use super::{Aims, Interval, Problem, Resolved, Resolver};
use crate::control::Status;
use crate::control::limits::Allowed;
use crate::control::qp::{self, MAX_VARIABLES, Outcome, Place, Rows};
use crate::mechanics::planar::Vec2;
use crate::mechanics::vehicle::Vehicle;

/// The ridge of the quadratic program without a price, as a share of the squared moment per rate: it decides between
/// rates that are equally good otherwise.
const RIDGE: f64 = 1e-14;

/// What a rate costs beyond its price, by its square: the price times this times the interval times the rate
/// \[1/rad\]. At a rate that turns a joint by 1/20 rad in one interval, it costs twice its price.
///
/// Without it, a price that outweighs the moment picks as few joints as the path needs, those that follow it with the
/// smallest sum of rates. Which they are changes at some postures, and as the motion that each choice leads to makes
/// the other one the better choice, the joints took turns: 2.5 rad/s from one millisecond to the next. From one
/// interval to the next the arm turns by rates times the interval, and the sums that are compared change by as much;
/// so the square has to grow with the interval to let the rates go from one choice to the other across several of
/// them. For short intervals it vanishes.
const STEADINESS: f64 = 20.0;

/// Mean moments below this are none \[N m\].
const NO_MOMENT: f64 = 1e-9;

impl Resolver {
    /// The rates of the joints; that of what balances the arm is given (3.29).
    pub(super) fn least_squares<const N: usize>(
        &self,
        vehicle: &Vehicle<N>,
        interval: &Interval<'_, N>,
        problem: &Problem<N>,
    ) -> Resolved<N> {
        let allowed = self.allowed(vehicle, interval);
        let Problem { mut path, mut velocity, mut moment, .. } = *problem;
        let mut rate = SVector::zeros();
        for i in self.links..N {
            rate[i] = allowed.least[i];
            velocity -= Vec2::from(path.column(i)) * rate[i];
            moment.value -= moment.row[i] * rate[i];
            path.column_mut(i).fill(0.0);
            moment.row[i] = 0.0;
        }
        let aims = interval.aims;
        let joints = Problem { path, velocity, moment, ..*problem };
        let mut wanted = self.along_path(&joints, aims == Aims::All);
        self.set_going(vehicle, interval.beginning, &joints, &mut wanted);
        let mut resolved = Resolved {
            rate: rate + wanted.rate,
            status: if allowed.returning && wanted.status() == Status::Ok {
                Status::TaskLimited
            } else {
                wanted.status()
            },
            min_singular_value: wanted.min_singular_value,
            momentum: problem.moment.row.dot(&(rate + wanted.rate)),
            places: qp::FREE,
        };
        let links = self.links;
        if self.rate_penalty == 0.0 && allowed.admit(&wanted.rate.as_slice()[..links]) {
            return resolved;
        }

        let mean = if aims == Aims::All { moment.row / problem.interval } else { SVector::zeros() };
        let wanted_rate = &wanted.rate.as_slice()[..links];
        let program =
            program(path.as_slice(), mean.as_slice(), wanted_rate, &allowed, [self.rate_penalty, problem.interval]);
        let found = qp::solve(&program, interval.guess.unwrap_or(&interval.state.places));
        rate.as_mut_slice()[..links].copy_from_slice(&found.x[..links]);
        resolved.momentum = problem.moment.row.dot(&rate);
        let moment = problem.moment.value - resolved.momentum;
        let held_back = found.places[..links].iter().any(|place| matches!(place, Place::Lower | Place::Upper));
        if found.outcome != Outcome::Solved {
            resolved.status = Status::PathLimited;
        } else if held_back && moment.abs() > NO_MOMENT * problem.interval && !wanted.path_damped {
            resolved.status = Status::TaskLimited;
        }
        Resolved { rate, places: found.places, ..resolved }
    }
}

/// The quadratic program for the rates of the joints: on the `path`, column by column, and with the `mean` moment
/// per rate as the `wanted` ones, as far as is `allowed` in an interval of length `interval` \[s\].
fn program(
    path: &[f64],
    mean: &[f64],
    wanted: &[f64],
    allowed: &Allowed,
    [rate_penalty, interval]: [f64; 2],
) -> qp::Problem {
    let squared: f64 = mean.iter().map(|moment| moment * moment).sum();
    let steadying = STEADINESS * interval * rate_penalty;
    let ridge = (RIDGE * squared + steadying).max(f64::MIN_POSITIVE);
    let mut program = qp::Problem::new(wanted.len(), ridge);
    let row = |coefficients: &mut dyn Iterator<Item = &f64>| {
        let mut row = [0.0; MAX_VARIABLES];
        row.iter_mut().zip(coefficients).for_each(|(place, coefficient)| *place = *coefficient);
        (row, row.iter().zip(wanted).map(|(row, rate)| row * rate).sum())
    };
    program.equalities = Rows::of([0, 1].map(|axis| row(&mut path.iter().skip(axis).step_by(2))));
    program.objective = Rows::of([row(&mut mean.iter())]);
    for i in 0..wanted.len() {
        (program.lower[i], program.upper[i]) = (allowed.least[i], allowed.most[i]);
        program.penalty[i] = rate_penalty;
    }
    program
}
