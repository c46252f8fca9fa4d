//! Which of the variables at rest is to move.

use super::null_space::NullSpace;
use super::rows::{MET, satisfied};
use super::search::{REPEATS, Search};
use super::{MAX_ROWS, MAX_VARIABLES, Problem, Vector, largest, product};

/// Equalities off by less than this share of their terms cannot come nearer.
const TIGHT: f64 = 1e-15;

/// Slopes below this share of their terms are none.
const FLAT: f64 = 1e-12;

/// The equalities' multipliers, and slopes with them, are off by this share of the slopes without.
const BLUR: f64 = 2e-15;

/// A bound holds a variable back if the equalities pull at it with more than this share of their error.
const PULL: f64 = 2e-14;

/// What the equalities say at the minimum over the free variables.
pub(super) enum Level {
    /// This variable is to move, on the side of this number.
    Released(usize, f64),
    /// Other equalities are looked at.
    Next,
    /// All are at their least error.
    Last,
}

impl Search<'_> {
    /// Unless the equalities are satisfied: the variable at rest that brings them nearer most steeply, and a number on
    /// the side where it moves. If there is none, their error is the least one; it is kept, and the bounds against
    /// which they press hold.
    pub fn nearer(&mut self, tired: bool) -> Level {
        if self.settled == self.equalities.count {
            return Level::Last;
        }
        let off = |share: f64| {
            (self.settled..self.looked_at).any(|k| {
                let share = share * self.levels.blur[k];
                !satisfied(&self.equalities.coefficients[k], self.wanted[k], &self.x, share)
            })
        };
        if off(TIGHT) {
            let (pull, weak, reducible) = self.pull();
            if reducible && !tired && self.repeats < REPEATS {
                self.repeats += 1;
                return Level::Next;
            }
            self.repeats = 0;
            let mut best: Option<(f64, usize)> = None;
            for i in (0..self.problem.variables).filter(|i| self.movable[*i] && !self.free[*i]) {
                let room =
                    if pull[i] > 0.0 { self.x[i] < self.problem.upper[i] } else { self.x[i] > self.problem.lower[i] };
                if room && pull[i].abs() > best.map_or(weak, |(most, _)| most) {
                    best = Some((pull[i].abs(), i));
                }
            }
            if let (Some((_, i)), false) = (best, tired) {
                return Level::Released(i, if self.x[i] == 0.0 { pull[i] } else { self.x[i] });
            }
            if off(MET) {
                self.missed = true;
                for (i, movable) in self.movable.iter_mut().enumerate() {
                    *movable &= self.free[i] || pull[i].abs() <= weak;
                }
            }
            let missing = self.missing();
            self.wanted.iter_mut().zip(missing).take(self.looked_at).for_each(|(wanted, missing)| *wanted -= missing);
        }
        self.settled = self.looked_at;
        if self.settled == self.equalities.count {
            return Level::Last;
        }
        self.looked_at = self.levels.ends[self.settled].min(self.equalities.count);
        Level::Next
    }

    /// How strongly the error of the equalities looked at pulls at each variable while those that are settled stay;
    /// what is too weak to count; and whether the variables in motion could reduce most of the error themselves.
    fn pull(&self) -> (Vector, f64, bool) {
        let mut errors = [0.0; MAX_ROWS];
        for (k, error) in errors.iter_mut().enumerate().take(self.looked_at).skip(self.settled) {
            *error = self.wanted[k] - product(&self.equalities.coefficients[k], &self.x);
        }
        let weighted = |errors: &[f64; MAX_ROWS]| {
            let mut sum = [0.0; MAX_VARIABLES];
            for (error, (row, _)) in errors.iter().zip(self.equalities.iter()) {
                sum.iter_mut().zip(row).for_each(|(sum, coefficient)| *sum += coefficient * error);
            }
            sum
        };
        if self.settled > 0 {
            let mut space = NullSpace::EMPTY;
            space.span(self.equalities, self.levels, self.settled, &self.free);
            let multipliers = space.multipliers(&space.basis.forth(&weighted(&errors)));
            errors[..self.settled].iter_mut().zip(multipliers).for_each(|(error, multiplier)| *error = -multiplier);
        }
        let all = errors;
        self.space.keep_irreducible(&mut errors);
        let terms = errors.iter().zip(&self.levels.blur).zip(self.equalities.iter());
        let weak = terms.map(|((error, blur), (row, _))| PULL * blur * (error * largest(row)).abs()).sum();
        let square = |errors: &[f64; MAX_ROWS]| errors.iter().map(|error| error * error).sum::<f64>();
        (weighted(&errors), weak, square(&errors) < 0.25 * square(&all))
    }

    /// The variable at rest that is to move, and the side on which: the steepest one, or that of the least
    /// index.
    pub fn entering(&self, least_index: bool) -> Option<(usize, f64)> {
        if self.free == self.movable {
            return None;
        }
        let Problem { variables, objective, ridge, penalty, lower, upper, .. } = self.problem;
        // Half the gradient without penalties.
        let mut gradient = self.x.map(|x| ridge * x);
        for (row, value) in objective.iter() {
            let error = product(row, &self.x) - value;
            gradient.iter_mut().zip(row).for_each(|(gradient, coefficient)| *gradient += coefficient * error);
        }
        let mut total = gradient;
        if self.penalised {
            total.iter_mut().zip(self.slopes()).for_each(|(total, slope)| *total += slope);
        }
        let multipliers = self.space.multipliers(&self.space.basis.forth(&total));
        for (multiplier, (row, _)) in multipliers.iter().zip(self.equalities.iter()) {
            gradient.iter_mut().zip(row).for_each(|(gradient, coefficient)| *gradient -= coefficient * multiplier);
        }

        let mut best: Option<(f64, usize, f64)> = None;
        for i in (0..*variables).filter(|i| self.movable[*i] && !self.free[*i]) {
            let (x, weight) = (self.x[i], 0.5 * penalty[i]);
            let (upwards, downwards) = (if x < 0.0 { -weight } else { weight }, if x > 0.0 { weight } else { -weight });
            let (mut gain, mut side) = (0.0, 1.0);
            if x < upper[i] && -(gradient[i] + upwards) > gain {
                (gain, side) = (-(gradient[i] + upwards), if x < 0.0 { -1.0 } else { 1.0 });
            }
            if x > lower[i] && gradient[i] + downwards > gain {
                (gain, side) = (gradient[i] + downwards, if x > 0.0 { 1.0 } else { -1.0 });
            }
            if gain > 0.0
                && gain > FLAT * (self.terms(i, &multipliers) + weight) + BLUR * largest(&total)
                && best.is_none_or(|(most, ..)| gain > most)
            {
                best = Some((gain, i, side));
                if least_index {
                    break;
                }
            }
        }
        best.map(|(_, i, side)| (i, side))
    }

    /// Size of the terms in the gradient of variable `i`, for these `multipliers` of the equalities.
    fn terms(&self, i: usize, multipliers: &[f64; MAX_ROWS]) -> f64 {
        let x = self.x.map(f64::abs);
        let objective = self.problem.objective.iter();
        let objective = objective.map(|(row, value)| row[i].abs() * (product(&row.map(f64::abs), &x) + value.abs()));
        let equalities =
            self.equalities.iter().zip(multipliers).map(|((row, _), multiplier)| (row[i] * multiplier).abs());
        self.problem.ridge * x[i] + objective.sum::<f64>() + equalities.sum::<f64>()
    }
}
