//! From one working set to the next, downhill.

use super::null_space::NullSpace;
use super::triangle::Triangle;
use super::{MAX_ROWS, MAX_VARIABLES, Problem, ROUNDING, Rows, Vector, largest, product};

/// Working sets at most; a few are enough, and arithmetic beyond its range alone leads here.
const STEPS: usize = 100;

/// Slopes below this share of their terms are none.
const FLAT: f64 = 1e-12;

/// The equalities' multipliers, and slopes with them, are off by this share of the slopes without.
const BLUR: f64 = 2e-15;

/// Variables that move by less than this share of the largest motion are at rest.
const AT_REST: f64 = 1e-12;

/// Minimises |A x - b|^2 + ridge |x|^2 + sum of penalties within the bounds while E x keeps its value.
pub(super) struct Search<'a> {
    pub(super) objective: &'a Rows,
    pub(super) equalities: &'a Rows,
    pub(super) problem: &'a Problem,
    pub(super) ridge: f64,
    pub(super) penalty: &'a Vector,
    /// What the left-hand sides of the equalities are to be.
    pub(super) wanted: [f64; MAX_ROWS],
    /// Largest coefficient of the equalities.
    pub(super) size: f64,
    /// Where it is.
    pub(super) x: Vector,
    /// Which variables are in motion; the others rest at an end or at a kink.
    pub(super) free: [bool; MAX_VARIABLES],
    /// Which may ever move.
    pub(super) movable: [bool; MAX_VARIABLES],
    /// Sign of each penalised variable in motion: its penalty is linear up to 0.
    pub(super) side: Vector,
    /// The directions in which the free variables may move.
    pub(super) space: NullSpace,
    /// Whether they are at their minimum already.
    pub(super) settled: bool,
}

impl<'a> Search<'a> {
    /// At the point nearest to 0, with every variable at rest.
    #[inline]
    pub fn new(
        objective: &'a Rows,
        equalities: &'a Rows,
        problem: &'a Problem,
        ridge: f64,
        penalty: &'a Vector,
    ) -> Self {
        let (mut x, mut movable) = ([0.0; MAX_VARIABLES], [false; MAX_VARIABLES]);
        for i in 0..problem.variables {
            x[i] = problem.bounded(i, 0.0);
            movable[i] = problem.lower[i] < problem.upper[i];
        }
        Self {
            objective,
            equalities,
            problem,
            ridge,
            penalty,
            wanted: equalities.values,
            size: equalities.size(),
            x,
            free: [false; MAX_VARIABLES],
            movable,
            side: [1.0; MAX_VARIABLES],
            space: NullSpace::EMPTY,
            settled: false,
        }
    }

    /// Puts the variables at `x`, or as near as the bounds allow; those at an end or at a kink rest. What is no
    /// number is forgotten.
    pub fn start(&mut self, x: &Vector) {
        self.settled = false;
        for i in 0..self.problem.variables {
            let x = self.problem.bounded(i, if x[i].is_finite() { x[i] } else { 0.0 });
            let inside = x > self.problem.lower[i] && x < self.problem.upper[i];
            self.x[i] = x;
            self.free[i] = self.movable[i] && inside && !(self.penalty[i] > 0.0 && x == 0.0);
        }
        self.take_sides();
    }

    pub(super) fn take_sides(&mut self) {
        for i in 0..self.problem.variables {
            let positive = self.x[i] > 0.0 || (self.x[i] == 0.0 && self.problem.upper[i] > 0.0);
            self.side[i] = if positive || self.penalty[i] == 0.0 { 1.0 } else { -1.0 };
        }
    }

    /// Sets variables free until the equalities have all the rank that they can have: their multipliers are
    /// unique then, and remain so.
    pub fn complete(&mut self) {
        let mut present = self.rank(self.free);
        if present == self.equalities.count {
            return;
        }
        self.settled = false;
        let full = self.rank(self.movable);
        for i in 0..self.problem.variables {
            if present == full {
                return;
            }
            if self.movable[i] && !self.free[i] {
                self.free[i] = true;
                let with = self.rank(self.free);
                self.free[i] = with > present;
                present = present.max(with);
            }
        }
    }

    /// Number of independent equalities among the `free` variables.
    fn rank(&mut self, free: [bool; MAX_VARIABLES]) -> usize {
        self.space.span(self.equalities, self.size, &free);
        self.space.rank()
    }

    /// Brings the null space up to date.
    #[inline]
    pub(super) fn span(&mut self) {
        self.space.span(self.equalities, self.size, &self.free);
    }

    /// Walks to the minimum; false if it was not reached.
    pub fn descend(&mut self) -> bool {
        let mut stalled = false;
        for _ in 0..STEPS {
            self.span();
            if !std::mem::take(&mut self.settled) {
                let step = self.step();
                let before = self.x;
                if !before.iter().zip(&step).all(|(x, step)| (x + step).is_finite()) {
                    return false;
                }
                if let Some((share, i, end)) = self.first_stop(&step) {
                    self.advance(&step, share);
                    self.x[i] = end;
                    self.free[i] = false;
                    stalled = self.rests_at(&before);
                    continue;
                }
                self.advance(&step, 1.0);
                stalled = stalled && self.rests_at(&before);
            }
            let Some((i, side)) = self.entering(stalled) else { return true };
            self.free[i] = true;
            self.side[i] = side;
        }
        false
    }

    /// Whether it has moved from `before` by no more than rounding.
    fn rests_at(&self, before: &Vector) -> bool {
        let size = largest(&self.x);
        self.x.iter().zip(before).all(|(x, before)| (x - before).abs() <= ROUNDING * size)
    }

    /// Goes this `share` of the `step`.
    #[inline]
    pub(super) fn advance(&mut self, step: &Vector, share: f64) {
        self.x.iter_mut().zip(step).for_each(|(x, step)| *x += share * step);
    }

    /// The way to the minimum over the free variables with the equalities, regardless of their ends.
    pub(super) fn step(&mut self) -> Vector {
        let missing = self.missing();
        let mut y = [0.0; MAX_VARIABLES];
        if self.space.dimension() == 0 {
            self.space.put(&mut y, &missing);
            return self.space.turn.back(y);
        }
        // Without objective: the ridge and the penalties are ridge |x + slopes / ridge|^2.
        let slopes = self.slopes();
        y = self.space.turn.forth(&std::array::from_fn(|i| -(self.x[i] + slopes[i] / self.ridge)));
        self.space.put(&mut y, &missing);
        // Each row of the objective adds one coordinate in which it lies, together with those before.
        let rank = self.space.rank();
        let mut triangle = Triangle::default();
        for (row, value) in self.objective.iter() {
            let coordinates = self.space.turn.forth(row);
            let error = value - product(row, &self.x) - self.space.seen(&coordinates, &y);
            let turn = &mut self.space.turn;
            let mut short = [0.0; MAX_ROWS];
            short.iter_mut().zip(&turn.pivots()[rank..]).for_each(|(short, pivot)| *short = coordinates[*pivot]);
            let left = turn.left(&coordinates);
            let squared = product(&left, &left);
            if squared > ROUNDING * ROUNDING * product(&coordinates, &coordinates) {
                let (pivot, coordinate) = turn.add(&left, squared.sqrt());
                turn.last(&mut y);
                short[triangle.dimension()] = coordinate;
                triangle.grow(self.ridge, y[pivot]);
            }
            triangle.add(short, error);
        }
        let turn = &mut self.space.turn;
        turn.pivots()[rank..].iter().zip(triangle.minimum()).for_each(|(pivot, z)| y[*pivot] = z);
        let step = turn.back(y);
        turn.truncate(rank);
        step
    }

    /// What the equalities' left-hand sides lack.
    fn missing(&self) -> [f64; MAX_ROWS] {
        let mut missing = [0.0; MAX_ROWS];
        for ((missing, wanted), (row, _)) in missing.iter_mut().zip(&self.wanted).zip(self.equalities.iter()) {
            *missing = wanted - product(row, &self.x);
            if missing.abs() <= ROUNDING * (wanted.abs() + self.size * largest(&self.x)) {
                *missing = 0.0;
            }
        }
        missing
    }

    /// Lets the equalities keep what they have.
    pub fn keep(&mut self) {
        for (wanted, (row, _)) in self.wanted.iter_mut().zip(self.equalities.iter()) {
            *wanted = product(row, &self.x);
        }
    }

    /// Half the slopes of the penalties of variables in motion.
    fn slopes(&self) -> Vector {
        let free = &self.space.turn.free;
        std::array::from_fn(|i| 0.5 * self.penalty[i] * self.side[i] * free[i])
    }

    /// Where a variable in motion has to stop.
    fn ends(&self, i: usize) -> (f64, f64) {
        let (lower, upper) = (self.problem.lower[i], self.problem.upper[i]);
        match (self.penalty[i] > 0.0, self.side[i] > 0.0) {
            (false, _) => (lower, upper),
            (true, true) => (lower.max(0.0), upper),
            (true, false) => (lower, upper.min(0.0)),
        }
    }

    /// The first variable that `step` would carry past its end: share of the step, variable and end.
    fn first_stop(&self, step: &Vector) -> Option<(f64, usize, f64)> {
        let fastest = largest(step);
        let mut first: Option<(f64, usize, f64)> = None;
        for (i, &step) in step.iter().enumerate().take(self.problem.variables) {
            if step.abs() <= AT_REST * fastest {
                continue;
            }
            let (lower, upper) = self.ends(i);
            let end = if step > 0.0 { upper } else { lower };
            let share = ((end - self.x[i]) / step).max(0.0);
            if share < first.map_or(1.0, |(least, ..)| least) {
                first = Some((share, i, end));
            }
        }
        first
    }

    /// The variable at rest that is to move, and the side on which: the steepest one, or that of the least
    /// index.
    fn entering(&self, least_index: bool) -> Option<(usize, f64)> {
        if self.free == self.movable {
            return None;
        }
        // Half the gradient without penalties.
        let mut gradient = self.x.map(|x| self.ridge * x);
        for (row, value) in self.objective.iter() {
            let error = product(row, &self.x) - value;
            gradient.iter_mut().zip(row).for_each(|(gradient, coefficient)| *gradient += coefficient * error);
        }
        let slopes = self.slopes();
        let total: Vector = std::array::from_fn(|i| gradient[i] + slopes[i]);
        let multipliers = self.space.multipliers(&self.space.turn.forth(&total));
        for (multiplier, (row, _)) in multipliers.iter().zip(self.equalities.iter()) {
            gradient.iter_mut().zip(row).for_each(|(gradient, coefficient)| *gradient -= coefficient * multiplier);
        }

        let mut best: Option<(f64, usize, f64)> = None;
        for i in (0..self.problem.variables).filter(|i| self.movable[*i] && !self.free[*i]) {
            let (x, weight) = (self.x[i], 0.5 * self.penalty[i]);
            let upwards = if x < 0.0 { -weight } else { weight };
            let downwards = if x > 0.0 { weight } else { -weight };
            let (mut gain, mut side) = (0.0, 1.0);
            if x < self.problem.upper[i] && -(gradient[i] + upwards) > gain {
                (gain, side) = (-(gradient[i] + upwards), if x < 0.0 { -1.0 } else { 1.0 });
            }
            if x > self.problem.lower[i] && gradient[i] + downwards > gain {
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
        best.map(|(_, i, side)| (i, if self.penalty[i] > 0.0 { side } else { 1.0 }))
    }

    /// Size of the terms in the gradient of variable `i`, for these `multipliers` of the equalities.
    fn terms(&self, i: usize, multipliers: &[f64; MAX_ROWS]) -> f64 {
        let objective = self.objective.iter().map(|(row, value)| {
            let size = row.iter().zip(&self.x).map(|(a, x)| (a * x).abs()).sum::<f64>() + value.abs();
            row[i].abs() * size
        });
        let equalities =
            self.equalities.iter().zip(multipliers).map(|((row, _), multiplier)| (row[i] * multiplier).abs());
        (self.ridge * self.x[i]).abs() + objective.sum::<f64>() + equalities.sum::<f64>()
    }
}
