//! Small dense quadratic programs: least squares with bounds, where some equations come first.
//!
//! Of all x within `lower` <= x <= `upper`, which always holds, those with the smallest |E x - e|; of these the
//! one with the smallest
//!
//! |A x - b|^2 + `ridge` |x|^2 + sum of `penalty_i` |`x_i`|
//!
//! E, e: `equalities`; A, b: `objective`. So where bounds and equalities contradict each other, the equalities
//! give way, in the sense of least squares, and nothing else is bought with their error. The ridge makes the
//! answer unique, whatever the ranks of A and E: among equally good answers it is the one of smallest norm.
//!
//! The method is a primal active set with the equalities eliminated by an orthogonal basis of their null space
//! (J. Nocedal and S. J. Wright, Numerical Optimization, chapter 16). It starts where the variables are guessed to
//! be, and each step goes to the least error of the equalities and, among those points, to the least objective, up to
//! the first bound; the kink of a penalty at 0 is one more place where a variable can rest. Where the equalities
//! cannot be satisfied, the bounds against which they press hold from then on. Error and objective fall with each step
//! that has a length; while steps have none, the least index enters and leaves, with which no working set comes twice
//! (Y.-Y. Chang and R. W. Cottle, Mathematical Programming 18 (1980) 127-137), and after many of them, what they are
//! about is rounding.
//!
//! Equalities that nearly depend on each other (1e-7 of the longest row is left) are rotated until their rows are
//! orthogonal, and the weak rows come after the strong ones; what is left of 1e-11 and less is left out. An equality is
//! satisfied if it is off by less than 3e-10 of the sum of its terms' sizes. No memory is allocated.

mod householder;
mod null_space;
mod release;
mod rows;
mod search;
mod triangle;

use rows::{LITTLE, Levels, NOTHING};
pub use rows::{Rows, TooMany};
use search::Search;

/// Largest number of variables.
pub const MAX_VARIABLES: usize = 8;
/// Largest number of rows of the equalities and of the objective, each.
pub const MAX_ROWS: usize = 4;

/// One number for each variable.
pub type Vector = [f64; MAX_VARIABLES];

/// What is asked for. Variables beyond `variables` are ignored.
#[derive(Debug, Clone, Copy)]
pub struct Problem {
    /// Number of variables.
    pub variables: usize,
    /// Equations that are to hold before the objective counts.
    pub equalities: Rows,
    /// Equations whose squared error is to be small.
    pub objective: Rows,
    /// Weight of the squared variables in the objective, positive.
    pub ridge: f64,
    /// Weight of the variables' absolute values in the objective, not negative.
    pub penalty: Vector,
    /// Smallest values; minus infinity: none.
    pub lower: Vector,
    /// Largest values; infinity: none. Should one be below `lower`, it is the one that counts.
    pub upper: Vector,
}

impl Problem {
    /// A problem without equations, penalties and bounds.
    #[must_use]
    pub fn new(variables: usize, ridge: f64) -> Self {
        Self {
            variables: variables.min(MAX_VARIABLES),
            equalities: Rows::default(),
            objective: Rows::default(),
            ridge,
            penalty: [0.0; MAX_VARIABLES],
            lower: [f64::NEG_INFINITY; MAX_VARIABLES],
            upper: [f64::INFINITY; MAX_VARIABLES],
        }
    }

    /// `x` within the bounds.
    #[inline]
    fn bounded(&self, i: usize, x: f64) -> f64 {
        let x = if x < self.lower[i] { self.lower[i] } else { x };
        if x > self.upper[i] { self.upper[i] } else { x }
    }
}

/// Where a variable is: at rest at one of its ends or at the kink of its penalty, or free in between.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// At its smallest value.
    Lower,
    /// Free, and negative if it is penalised.
    Below,
    /// At zero, because of its penalty.
    Zero,
    /// Free, and not negative if it is penalised.
    Above,
    /// At its largest value.
    Upper,
}

impl Place {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Lower, Self::Below, Self::Zero, Self::Above, Self::Upper];
}

/// Where all variables are: a good guess where those of a similar problem are.
pub type Places = [Place; MAX_VARIABLES];

/// The guess where nothing is known of the answer: no variable is at a bound.
pub const FREE: Places = [Place::Above; MAX_VARIABLES];

/// What an answer is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It is the minimum, and the equalities hold.
    Solved,
    /// It is the minimum, but within the bounds the equalities do not hold.
    Missed,
    /// It is within the bounds, but numbers beyond the range of arithmetic prevented a minimum.
    Unfinished,
}

/// An answer.
#[derive(Debug, Clone, Copy)]
pub struct Solution {
    /// The variables.
    pub x: Vector,
    /// Where they are: the guess for the next problem.
    pub places: Places,
    /// What they are worth.
    pub outcome: Outcome,
}

/// Solves `problem`; `guess` where the variables will be saves time and changes nothing but rounding.
#[must_use]
pub fn solve(problem: &Problem, guess: &Places) -> Solution {
    let equalities = &problem.equalities;
    let mut search = Search::new(problem, equalities, &Levels::ONE, guess);
    let mut outcome = Outcome::Unfinished;
    if search.sees_all() || !equalities.nearly_depend() {
        outcome = search.descend();
    }
    let mut solution = Solution { x: search.x, places: search.places(), outcome };
    for nothing in [NOTHING, LITTLE] {
        if solution.outcome == Outcome::Unfinished {
            solution = solve_in_levels(problem, guess, nothing);
        }
    }
    solution
}

/// [`solve`] for equalities that nearly depend on each other; those of which less than the share `nothing` is left
/// beside the others are left out.
#[cold]
fn solve_in_levels(problem: &Problem, guess: &Places, nothing: f64) -> Solution {
    let (rotated, levels) = Levels::orthogonal(&problem.equalities, nothing);
    let mut search = Search::new(problem, &rotated, &levels, guess);
    let outcome = search.descend();
    Solution { x: search.x, places: search.places(), outcome }
}

/// Largest absolute value; what is no number does not count.
fn largest(x: &Vector) -> f64 {
    x.iter().fold(0.0, |largest, x| if x.abs() > largest { x.abs() } else { largest })
}

/// Scalar product; the sum of halves takes less time than one number after the other.
#[inline]
fn product(a: &Vector, b: &Vector) -> f64 {
    let terms: Vector = std::array::from_fn(|i| a[i] * b[i]);
    let fours: [f64; 4] = std::array::from_fn(|i| terms[i] + terms[i + 4]);
    let twos: [f64; 2] = std::array::from_fn(|i| fours[i] + fours[i + 2]);
    twos[0] + twos[1]
}
