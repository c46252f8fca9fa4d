//! Where the variables are: a guess that is tried and mended, and what came out.

use super::search::Search;
use super::{FREE, MAX_VARIABLES, Place, Places, Problem};

impl Search<'_> {
    /// Puts the variables where `guess` has them, the free ones at their minimum with the equalities; true if
    /// the bounds and the equalities then hold.
    pub fn take(&mut self, guess: &Places) -> bool {
        let Problem { variables: n, lower, upper, .. } = self.problem;
        for i in 0..*n {
            let (rest, x, side) = match guess[i] {
                Place::Lower => (lower[i].is_finite(), lower[i], 1.0),
                Place::Upper => (upper[i].is_finite(), upper[i], 1.0),
                Place::Zero => (self.penalty[i] > 0.0 && lower[i] <= 0.0 && upper[i] >= 0.0, 0.0, 1.0),
                Place::Below => (false, 0.0, -1.0),
                Place::Above => (false, 0.0, 1.0),
            };
            self.free[i] = self.movable[i] && !rest;
            self.side[i] = if self.penalty[i] == 0.0 { 1.0 } else { side };
            if self.movable[i] {
                self.x[i] = if rest { x } else { 0.0 };
            }
        }
        self.span();
        let step = self.step();
        self.advance(&step, 1.0);
        let within = (0..*n).all(|i| self.x[i].is_finite() && self.x[i] == self.problem.bounded(i, self.x[i]));
        if !(within && self.equalities_met()) {
            return false;
        }
        let side = self.side;
        self.take_sides();
        self.settled = self.side == side;
        true
    }

    /// Whether the equalities hold after a step to their values.
    fn equalities_met(&self) -> bool {
        self.space.rank() == self.equalities.count || self.equalities.met_by(&self.x, &self.x)
    }

    /// Lets `guess` hold at their bounds those that were taken farthest beyond them: so many that a direction to
    /// move in is left, but one at least. False if there is none, or if the equalities do not hold anyway.
    pub fn hold(&self, guess: &mut Places) -> bool {
        let directions = self.space.dimension();
        if directions == 0 || !self.equalities_met() {
            return false;
        }
        // The distance counts for more where the equalities hardly let a variable go back.
        let shares = self.space.shares();
        let mut beyond = [0.0; MAX_VARIABLES];
        for i in (0..self.problem.variables).filter(|i| self.free[*i]) {
            let distance = self.x[i] - self.problem.bounded(i, self.x[i]);
            beyond[i] = distance * distance / shares[i];
        }
        let mut held = false;
        for _ in 1..directions.max(2) {
            let (mut farthest, mut most) = (0, 0.0);
            for (i, beyond) in beyond.iter().enumerate().take(self.problem.variables) {
                if *beyond > most {
                    (farthest, most) = (i, *beyond);
                }
            }
            if most == 0.0 {
                break;
            }
            beyond[farthest] = 0.0;
            let above = self.x[farthest] > self.problem.upper[farthest];
            guess[farthest] = if above { Place::Upper } else { Place::Lower };
            held = true;
        }
        held
    }

    /// Where the variables are.
    pub fn places(&self) -> Places {
        let mut places = FREE;
        for (i, place) in places.iter_mut().enumerate().take(self.problem.variables) {
            let x = self.x[i];
            *place = if self.free[i] {
                if self.side[i] > 0.0 { Place::Above } else { Place::Below }
            } else if x <= self.problem.lower[i] {
                Place::Lower
            } else if x >= self.problem.upper[i] {
                Place::Upper
            } else {
                Place::Zero
            };
        }
        places
    }
}
