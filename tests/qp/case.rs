//! Problems with their matrices in the open, and random ones of every kind.

use nalgebra::{DMatrix, DVector};
use uam::control::qp::{MAX_ROWS, Place, Places, Problem, Solution};

use crate::common::random::Random;

/// A problem with its matrices in the open.
pub struct Case {
    pub problem: Problem,
    pub equalities: (DMatrix<f64>, DVector<f64>),
    pub objective: (DMatrix<f64>, DVector<f64>),
}

pub fn case(
    lower: &[f64],
    upper: &[f64],
    penalty: &[f64],
    ridge: f64,
    equalities: (DMatrix<f64>, DVector<f64>),
    objective: (DMatrix<f64>, DVector<f64>),
) -> Case {
    let n = lower.len();
    let mut problem = Problem::new(n, ridge);
    for i in 0..n {
        (problem.lower[i], problem.upper[i], problem.penalty[i]) = (lower[i], upper[i], penalty[i]);
    }
    for (rows, (matrix, right)) in [(&mut problem.equalities, &equalities), (&mut problem.objective, &objective)] {
        for (row, value) in matrix.row_iter().zip(right.iter()) {
            rows.push(&row.iter().copied().collect::<Vec<_>>(), *value).unwrap();
        }
    }
    Case { problem, equalities, objective }
}

impl Case {
    pub fn n(&self) -> usize {
        self.problem.variables
    }

    pub fn x(&self, solution: &Solution) -> DVector<f64> {
        DVector::from_column_slice(&solution.x[..self.n()])
    }

    pub fn equality_error(&self, x: &DVector<f64>) -> f64 {
        (&self.equalities.0 * x - &self.equalities.1).norm()
    }

    pub fn cost(&self, x: &DVector<f64>) -> f64 {
        let penalty: f64 = x.iter().zip(&self.problem.penalty).map(|(x, weight)| weight * x.abs()).sum();
        (&self.objective.0 * x - &self.objective.1).norm_squared() + self.problem.ridge * x.norm_squared() + penalty
    }

    /// Whether `x` is within the bounds but for this much.
    pub fn admits(&self, x: &DVector<f64>, tolerance: f64) -> bool {
        let Problem { lower, upper, .. } = &self.problem;
        x.iter().enumerate().all(|(i, x)| (lower[i] - tolerance..=upper[i] + tolerance).contains(x))
    }

    pub fn assert_within(&self, x: &DVector<f64>) {
        for (i, x) in x.iter().enumerate() {
            assert!(
                (self.problem.lower[i]..=self.problem.upper[i]).contains(x),
                "x{i} = {x} is not within {} and {}",
                self.problem.lower[i],
                self.problem.upper[i]
            );
        }
    }
}

/// Problems in which everything goes wrong that can: dependent and contradictory rows, fixed variables, bounds
/// on one side, at zero and far from the equalities, whole numbers, so that ties and degenerate corners
/// are common.
pub fn nasty(random: &mut Random) -> Case {
    let n = random.between(2.0, 8.999) as usize;
    let whole = random.coin();
    let number = |random: &mut Random| {
        let number = random.about_zero(2.5);
        if whole { number.round() } else { number }
    };
    let rows = |random: &mut Random, most: f64| {
        let count = random.between(0.0, most + 0.999) as usize;
        let mut matrix = DMatrix::from_fn(count, n, |_, _| number(random));
        let mut right = DVector::from_fn(count, |_, _| number(random));
        if count > 1 && random.unit() < 0.3 {
            // One row again, doubled, with the same or with another right-hand side.
            let again = matrix.row(0) * 2.0;
            matrix.set_row(count - 1, &again);
            if random.coin() {
                right[count - 1] = 2.0 * right[0];
            }
        }
        if n > 2 && random.unit() < 0.2 {
            let again = matrix.column(0).clone_owned();
            matrix.set_column(1, &again);
        }
        (matrix, right)
    };
    let equalities = rows(random, (MAX_ROWS.min(n) - 1) as f64);
    let objective = rows(random, MAX_ROWS as f64);
    let mut bounds = Vec::new();
    for _ in 0..n {
        let (a, b) = (random.about_zero(2.0), random.about_zero(2.0));
        let (a, b) = if whole { (a.round(), b.round()) } else { (a, b) };
        bounds.push(match random.between(0.0, 6.0) as usize {
            0 => (f64::NEG_INFINITY, f64::INFINITY),
            1 => (a, f64::INFINITY),
            2 => (a, a),
            _ => (a.min(b), a.max(b)),
        });
    }
    let penalised = random.coin();
    let penalty: Vec<f64> =
        (0..n).map(|_| if penalised && random.coin() { random.between(0.01, 2.0) } else { 0.0 }).collect();
    let ridge = 10.0_f64.powf(random.between(-4.0, 0.0));
    let (lower, upper): (Vec<f64>, Vec<f64>) = bounds.into_iter().unzip();
    case(&lower, &upper, &penalty, ridge, equalities, objective)
}

/// Guesses that have nothing to do with the problem.
pub fn any_guess(random: &mut Random) -> Places {
    std::array::from_fn(|_| Place::ALL[random.between(0.0, 4.999) as usize])
}

/// Bounds about `known`: some on it, some infinite with this probability.
fn about(random: &mut Random, known: &DVector<f64>, infinite: f64) -> (Vec<f64>, Vec<f64>) {
    let mut bound = |x: f64, sign: f64| {
        let width = if random.unit() < 0.2 { 0.0 } else { random.unit() * 10.0_f64.powf(random.between(-3.0, 1.0)) };
        if random.unit() < infinite { sign * f64::INFINITY } else { x + sign * width }
    };
    known.iter().map(|&x| (bound(x, -1.0), bound(x, 1.0))).unzip()
}

/// A small number of any size.
fn small(random: &mut Random, digits: f64) -> f64 {
    10.0_f64.powf(-random.between(0.0, digits))
}

/// The path of an arm that is nearly folded or stretched, with rates that follow it within the bounds.
pub fn folded_arm(random: &mut Random) -> (Case, DVector<f64>) {
    let n = random.between(2.0, 6.999) as usize;
    let alike = random.coin().then(|| small(random, 16.0));
    let (mut angle, mut tips) = (random.about_zero(3.0), Vec::new());
    for _ in 0..n {
        let bend = random.about_zero(1.0) * alike.unwrap_or_else(|| small(random, 16.0));
        angle += bend + if random.coin() { std::f64::consts::PI } else { 0.0 };
        tips.push(random.between(0.05, 0.3) * DVector::from_vec(vec![-angle.sin(), angle.cos()]));
    }
    let path = DMatrix::from_fn(2, n, |row, joint| tips[joint..].iter().map(|tip| tip[row]).sum::<f64>());
    let known = DVector::from_fn(n, |_, _| random.about_zero(3.0));
    let infinite = if random.coin() { 0.0 } else { 0.3 };
    let (lower, upper) = about(random, &known, infinite);
    let moment = DMatrix::from_fn(1, n, |_, _| random.about_zero(100.0));
    let penalty = if random.coin() { 0.0 } else { 10.0_f64.powf(random.between(-3.0, 6.0)) };
    let ridge = 1e-14 * moment.norm_squared() + if random.coin() { 0.02 * penalty } else { 0.0 };
    let right = &path * &known;
    let value = DVector::from_element(1, random.about_zero(10.0));
    (case(&lower, &upper, &vec![penalty; n], ridge, (path, right), (moment, value)), known)
}

/// Penalties up to 10^`digits`, with a point that meets the equalities within the bounds.
pub fn penalised(random: &mut Random, digits: f64) -> (Case, DVector<f64>) {
    let n = random.between(2.0, 8.999) as usize;
    let rows = random.between(1.0, n.min(4) as f64) as usize;
    let known = DVector::from_fn(n, |_, _| if random.unit() < 0.2 { 0.0 } else { random.about_zero(2.0) });
    let infinite = [0.0, 0.5, 1.0][random.between(0.0, 2.999) as usize];
    let (lower, upper) = about(random, &known, infinite);
    let equalities = DMatrix::from_fn(rows, n, |_, _| random.about_zero(1.0));
    let right = &equalities * &known;
    let rows = random.between(0.0, 2.999) as usize;
    let objective = DMatrix::from_fn(rows, n, |_, _| random.about_zero(1.0));
    let aim = DVector::from_fn(rows, |_, _| random.about_zero(2.0));
    let any = |random: &mut Random| 10.0_f64.powf(random.between(-2.0, digits));
    let same = random.coin().then(|| any(random));
    let penalty: Vec<f64> =
        (0..n).map(|_| same.unwrap_or_else(|| if random.unit() < 0.3 { 0.0 } else { any(random) })).collect();
    let ridge = small(random, 14.0);
    (case(&lower, &upper, &penalty, ridge, (equalities, right), (objective, aim)), known)
}

/// [`nasty`] with one equality that nearly is another one, and sometimes two variables that nearly are the same.
pub fn dependent(random: &mut Random) -> Case {
    let Case { problem, equalities: (mut matrix, mut right), objective } = nasty(random);
    let n = problem.variables;
    let near = |random: &mut Random| 1e-4 * small(random, 13.0);
    if matrix.nrows() > 1 {
        let (factor, off) = (random.about_zero(2.0), near(random));
        let row = matrix.row(0).map(|a| factor * a + off * random.about_zero(1.0));
        matrix.set_row(1, &row);
        if random.coin() {
            right[1] = factor * right[0] + if random.coin() { off * random.about_zero(1.0) } else { 0.0 };
        }
    }
    if random.unit() < 0.3 {
        let off = near(random);
        let column = matrix.column(0).map(|a| a * (1.0 + off * random.about_zero(1.0)));
        matrix.set_column(1, &column);
    }
    let ridge = small(random, 12.0);
    // Where nearly nothing moves an equation, an infinite variable would move it all the same.
    let bounded = |bounds: &[f64]| bounds.iter().map(|bound| bound.clamp(-100.0, 100.0)).collect::<Vec<_>>();
    case(
        &bounded(&problem.lower[..n]),
        &bounded(&problem.upper[..n]),
        &problem.penalty[..n],
        ridge,
        (matrix, right),
        objective,
    )
}
