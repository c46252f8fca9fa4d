//! As little moment on the UAV as the path and the limits leave possible (thesis 3.7, 3.8 and 4.4).
//!
//! One step of sequential quadratic programming: path and moment are linear in the rates. Limits come
//! first, then the path in the sense of least squares, then
//!
//! (mean moment on the UAV)^2 + `rate_penalty` * sum of |joint rates|   (3.27) and (4.3)
//!
//! What the extended Jacobian would do without limits is asked for; so the two agree where no limit
//! binds, and both keep calm near singular configurations.

use nalgebra::SVector;

use super::{Problem, Resolved, Resolver};
use crate::controller::Status;
use crate::planar::Vec2;
use crate::qp::{self, Outcome, Place};

/// The ridge of the quadratic program, as a share of the squared moment per rate: it decides between rates
/// that are equally good otherwise.
const RIDGE: f64 = 1e-14;

/// Mean moments below this are none \[N m\].
const NO_MOMENT: f64 = 1e-9;

impl<const N: usize> Resolver<N> {
    /// The rates of the joints; that of what balances the arm is given (3.29).
    pub(super) fn least_squares(&self, problem: &Problem<'_, N>) -> Resolved<N> {
        let &Problem { mut path, mut velocity, mut moment, allowed, .. } = problem;
        let mut rate = SVector::zeros();
        for i in self.links..N {
            rate[i] = allowed.least[i];
            velocity -= Vec2::from(path.column(i)) * rate[i];
            moment.value -= moment.row[i] * rate[i];
            path.column_mut(i).fill(0.0);
            moment.row[i] = 0.0;
        }
        let wanted = self.weights.resolve(&path, velocity, &SVector::zeros(), Some(&moment), self.reach);
        let within = (0..self.links).all(|i| (allowed.least[i]..=allowed.most[i]).contains(&wanted.rate[i]));
        let mut resolved = Resolved {
            rate: rate + wanted.rate,
            status: wanted.status(),
            min_singular_value: wanted.min_singular_value,
            moment: moment.value - moment.row.dot(&wanted.rate),
            places: qp::FREE,
        };
        if within && self.rate_penalty == 0.0 {
            return resolved;
        }

        let mean = moment.row / allowed.size;
        let smallest = f64::MIN_POSITIVE / RIDGE;
        let mut program = qp::Problem::new(self.links, RIDGE * mean.norm_squared().max(smallest));
        for (row, value) in path.row_iter().zip(&(path * wanted.rate)) {
            program.equalities.push(SVector::from(row.transpose()).as_slice(), *value);
        }
        program.objective.push(mean.as_slice(), mean.dot(&wanted.rate));
        for i in 0..self.links {
            (program.lower[i], program.upper[i]) = (allowed.least[i], allowed.most[i]);
            program.penalty[i] = self.rate_penalty;
        }
        let found = qp::solve(&program, problem.guess);

        rate.as_mut_slice()[..self.links].copy_from_slice(&found.x[..self.links]);
        resolved.moment = problem.moment.value - problem.moment.row.dot(&rate);
        let held_back = found.places[..self.links].iter().any(|place| matches!(place, Place::Lower | Place::Upper));
        if found.outcome != Outcome::Solved {
            resolved.status = Status::PathLimited;
        } else if held_back && resolved.moment.abs() > NO_MOMENT * allowed.size && !wanted.path_damped {
            resolved.status = Status::TaskLimited;
        }
        Resolved { rate, places: found.places, ..resolved }
    }
}
