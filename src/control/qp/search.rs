//! From one working set to the next, downhill.

use super::null_space::NullSpace;
use super::release::Level;
use super::rows::{Levels, MET, Rows, WEAK, satisfied};
use super::triangle::Triangle;
use super::{MAX_ROWS, MAX_VARIABLES, Outcome, Place, Places, Problem, Vector, largest, product};

/// Working sets at most; a few are enough, and arithmetic beyond its range alone leads here.
const STEPS: usize = 100;

/// What is below this share of its terms is rounding.
const ROUNDING: f64 = 1e-14;

/// Equalities that are settled are allowed this share of what their terms could be.
const KEPT: f64 = 1e-12;

/// Variables that move by less than this share of the largest motion are at rest.
const AT_REST: f64 = 2e-11;

/// So often an error that rounding has left of a long way is reduced.
pub(super) const REPEATS: usize = 5;

/// If the variables have been so many times as far away as the answer, the answer has lost digits on the way.
const LONG: f64 = 30.0;

/// Steps of less than this share of the variables have no length.
const STILL: f64 = 1e-10;

/// Degenerate problems need steps without length, but not so many: more mean that rounding leads round in a circle.
const PATIENCE: usize = 25;

/// The farthest step: with vanishing penalties the minimum lies beyond all numbers, and only its direction counts.
const FAR: f64 = 1e100;

/// The variables on their way.
pub(super) struct Search<'a> {
    pub(super) problem: &'a Problem,
    pub(super) equalities: &'a Rows,
    pub(super) levels: &'a Levels,
    /// So many equalities are at their least error, and so many are looked at.
    pub(super) settled: usize,
    pub(super) looked_at: usize,
    pub(super) missed: bool,
    /// Whether those that are settled are satisfied to the last digit.
    pub(super) exact: bool,
    pub(super) repeats: usize,
    /// Where they are, always within the bounds.
    pub x: Vector,
    /// Which are in motion; the others rest at an end or at a kink.
    pub(super) free: [bool; MAX_VARIABLES],
    /// Which may ever move.
    pub(super) movable: [bool; MAX_VARIABLES],
    /// Whether some of them are penalised.
    pub(super) penalised: bool,
    /// Sign of each penalised variable in motion: its penalty is linear up to 0.
    pub(super) side: Vector,
    /// What the left-hand sides of the equalities are to be.
    pub(super) wanted: [f64; MAX_ROWS],
    /// The directions in which the free variables may move.
    pub(super) space: NullSpace,
}

impl<'a> Search<'a> {
    /// Those at rest where `guess` has them, the free ones as near to 0 as their bounds allow.
    #[inline]
    pub fn new(problem: &'a Problem, equalities: &'a Rows, levels: &'a Levels, guess: &Places) -> Self {
        let Problem { variables, penalty, lower, upper, .. } = problem;
        let mut search = Self {
            problem,
            equalities,
            levels,
            settled: 0,
            missed: false,
            exact: false,
            repeats: 0,
            looked_at: levels.ends[0].min(equalities.count),
            x: [0.0; MAX_VARIABLES],
            free: [false; MAX_VARIABLES],
            movable: [false; MAX_VARIABLES],
            penalised: false,
            side: [1.0; MAX_VARIABLES],
            wanted: equalities.values,
            space: NullSpace::EMPTY,
        };
        for i in 0..*variables {
            let zero = problem.bounded(i, 0.0);
            search.penalised |= penalty[i] > 0.0;
            search.movable[i] = lower[i] < upper[i];
            let (rests, x) = match guess[i] {
                Place::Lower => (lower[i].is_finite(), lower[i]),
                Place::Upper => (upper[i].is_finite(), upper[i]),
                Place::Zero => (penalty[i] > 0.0 && zero == 0.0, 0.0),
                Place::Below | Place::Above => (false, 0.0),
            };
            search.free[i] = search.movable[i] && !rests;
            search.x[i] = if rests && search.movable[i] { x } else { zero };
            let below = guess[i] == Place::Below && lower[i] < 0.0 || upper[i] <= 0.0;
            if penalty[i] > 0.0 && (zero < 0.0 || zero == 0.0 && below) {
                search.side[i] = -1.0;
            }
        }
        search
    }

    /// Whether the variables in motion alone keep the equalities well apart.
    pub fn sees_all(&mut self) -> bool {
        self.space.span(self.equalities, self.levels, self.looked_at, &self.free);
        self.space.rank() == self.looked_at && self.space.least() > 3.0 * WEAK * self.space.size
    }

    /// Walks to the minimum.
    pub fn descend(&mut self) -> Outcome {
        let (mut stalls, mut farthest) = (0, 0.0_f64);
        for _ in 0..STEPS {
            self.space.span(self.equalities, self.levels, self.looked_at, &self.free);
            let step = self.step();
            let (before, fastest) = (self.x, largest(&step));
            farthest = farthest.max(largest(&before));
            if !before.iter().zip(&step).all(|(x, step)| (x + step).is_finite()) {
                break;
            }
            if let Some((share, i, end)) = self.first_stop(&step, fastest) {
                self.advance(&step, share, fastest);
                self.x[i] = end;
                self.free[i] = false;
                stalls = if self.rests_at(&before) { stalls + 1 } else { 0 };
                continue;
            }
            self.advance(&step, 1.0, fastest);
            if stalls > 0 && !self.rests_at(&before) {
                stalls = 0;
            }
            let tired = stalls > PATIENCE;
            let next = match self.nearer(tired) {
                Level::Released(i, side) => Some((i, side)),
                Level::Next => continue,
                Level::Last if tired => None,
                Level::Last => self.entering(stalls > 0),
            };
            let Some((i, side)) = next else {
                // No multiplier asks for a release. Before the problem counts as solved the equalities are looked at themselves,
                // and digits that were lost on a long way here are won back.
                let equalities = &self.problem.equalities;
                if equalities.satisfied_by(&self.x, ROUNDING) {
                    return Outcome::Solved;
                }
                let far = largest(&self.x);
                if !self.missed && farthest > LONG * far {
                    (farthest, self.exact, self.wanted) = (far, true, self.equalities.values);
                    continue;
                }
                return if equalities.satisfied_by(&self.x, MET) { Outcome::Solved } else { Outcome::Missed };
            };
            self.free[i] = true;
            self.side[i] = if self.problem.penalty[i] > 0.0 { side.signum() } else { 1.0 };
        }
        Outcome::Unfinished
    }

    /// Whether it has moved from `before` by no more than rounding.
    fn rests_at(&self, before: &Vector) -> bool {
        let size = largest(&self.x);
        self.x.iter().zip(before).all(|(x, before)| (x - before).abs() <= STILL * size)
    }

    /// Goes this `share` of the `step`.
    #[inline]
    fn advance(&mut self, step: &Vector, share: f64, fastest: f64) {
        // What is left of numbers that cancel is nothing.
        let nothing = ROUNDING * share * fastest;
        for (i, step) in step.iter().enumerate().take(self.problem.variables) {
            let to = self.x[i] + share * step;
            let to = if to.abs() <= nothing { 0.0 } else { to };
            self.x[i] = self.problem.bounded(i, to);
        }
    }

    /// The way to the minimum over the free variables, regardless of their ends: first of the equalities' error,
    /// then of the objective.
    fn step(&mut self) -> Vector {
        let missing = self.missing();
        let Problem { objective, ridge, .. } = self.problem;
        let mut y = [0.0; MAX_VARIABLES];
        if self.space.dimension() == 0 {
            self.space.put(&mut y, &missing);
            return self.space.basis.back(y);
        }
        // Without rows, the objective is ridge |x + slopes / ridge|^2.
        y = self.space.basis.forth(&self.x.map(|x| -x));
        if self.penalised {
            let slopes = self.slopes();
            let steepest = largest(&slopes).max(f64::MIN_POSITIVE);
            // Slopes that cancel up to rounding do not drive anything away: the ridge decides.
            let far = (steepest / ridge).min(FAR);
            for (y, slope) in y.iter_mut().zip(self.space.basis.forth(&slopes)) {
                if slope.abs() > ROUNDING * steepest {
                    *y -= slope / steepest * far;
                }
            }
        }
        self.space.put(&mut y, &missing);
        // Each row of the objective adds one coordinate in which it lies, together with those before.
        let rank = self.space.rank();
        let mut triangle = Triangle::default();
        for (row, value) in objective.iter() {
            let coordinates = self.space.basis.forth(row);
            let error = value - product(row, &self.x) - self.space.seen(&coordinates, &y);
            let basis = &mut self.space.basis;
            let mut short = [0.0; MAX_ROWS];
            short.iter_mut().zip(&basis.pivots()[rank..]).for_each(|(short, pivot)| *short = coordinates[*pivot]);
            let left = basis.left(&coordinates);
            let squared = product(&left, &left);
            if squared > ROUNDING * ROUNDING * product(&coordinates, &coordinates) {
                let (pivot, coordinate) = basis.add(&left, squared.sqrt());
                basis.last(&mut y);
                short[triangle.dimension()] = coordinate;
                triangle.grow(*ridge, y[pivot]);
            }
            triangle.add(short, error, 1.0);
        }
        let basis = &mut self.space.basis;
        basis.pivots()[rank..].iter().zip(triangle.minimum()).for_each(|(pivot, z)| y[*pivot] = z);
        let step = basis.back(y);
        basis.truncate(rank);
        step
    }

    /// What the equalities' left-hand sides lack.
    pub(super) fn missing(&self) -> [f64; MAX_ROWS] {
        let mut missing = [0.0; MAX_ROWS];
        for (k, (row, _)) in self.equalities.iter().enumerate() {
            if k >= self.settled || self.exact || !satisfied(row, self.wanted[k], &self.x, KEPT * self.levels.blur[k]) {
                missing[k] = self.wanted[k] - product(row, &self.x);
            }
        }
        missing
    }

    /// Half the slopes of the penalties of variables in motion.
    pub(super) fn slopes(&self) -> Vector {
        let free = &self.space.basis.free;
        std::array::from_fn(|i| 0.5 * self.problem.penalty[i] * self.side[i] * free[i])
    }

    /// The first variable that `step` would carry past its end: share of the step, variable and end.
    fn first_stop(&self, step: &Vector, fastest: f64) -> Option<(f64, usize, f64)> {
        let Problem { variables, penalty, lower, upper, .. } = self.problem;
        let slow = AT_REST * fastest;
        let mut first: Option<(f64, usize, f64)> = None;
        for i in 0..*variables {
            // A variable in motion stops at the kink of its penalty, too.
            let (least, most) = match (penalty[i] > 0.0, self.side[i] > 0.0) {
                (false, _) => (lower[i], upper[i]),
                (true, true) => (lower[i].max(0.0), upper[i]),
                (true, false) => (lower[i], upper[i].min(0.0)),
            };
            let end = if step[i] > 0.0 { most } else { least };
            let beyond = if step[i] > 0.0 { self.x[i] + step[i] > end } else { self.x[i] + step[i] < end };
            if beyond && step[i].abs() > slow {
                let share = ((end - self.x[i]) / step[i]).max(0.0);
                if first.is_none_or(|(least, ..)| share < least) {
                    first = Some((share, i, end));
                }
            }
        }
        first
    }

    /// Where the variables are.
    pub fn places(&self) -> Places {
        let Problem { variables, lower, upper, .. } = self.problem;
        let mut places = super::FREE;
        for i in 0..*variables {
            places[i] = match (self.free[i], self.side[i] > 0.0) {
                (true, true) => Place::Above,
                (true, false) => Place::Below,
                _ if self.x[i] <= lower[i] => Place::Lower,
                _ if self.x[i] >= upper[i] => Place::Upper,
                _ => Place::Zero,
            };
        }
        places
    }
}
