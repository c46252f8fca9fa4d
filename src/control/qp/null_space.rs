//! The directions in which some of the variables may move without a change of the equalities.

use super::householder::Householder;
use super::rows::{Levels, Rows};
use super::triangle::Triangle;
use super::{MAX_ROWS, MAX_VARIABLES, Vector, largest, product};

/// A row of which less than this share of the largest coefficient is left depends on the rows before it.
pub(super) const DEPENDENT: f64 = 1e-14;

/// The rows of the equalities on the free variables, transposed and decomposed: Q R with Householder
/// reflections, the largest remaining row first. Columns of Q that are no pivots span the null space.
///
/// Vectors have a place for each variable; it is zero for those that are not free.
#[derive(Debug, Clone, Copy)]
pub(super) struct NullSpace {
    /// The free variables.
    free: [bool; MAX_VARIABLES],
    /// Q^T; whoever adds reflections takes them away again.
    pub basis: Householder,
    /// Independent rows among the equalities, in the order of elimination, and how many.
    order: [usize; MAX_ROWS],
    rank: usize,
    /// Largest coefficient.
    pub size: f64,
    count: usize,
    weights: [f64; MAX_ROWS],
    /// R^T, one row for each equality.
    factor: [[f64; MAX_ROWS]; MAX_ROWS],
}

impl NullSpace {
    /// Where no variable is free.
    pub const EMPTY: Self = Self {
        free: [false; MAX_VARIABLES],
        basis: Householder::EMPTY,
        order: [0; MAX_ROWS],
        rank: 0,
        size: 0.0,
        count: 0,
        weights: [1.0; MAX_ROWS],
        factor: [[0.0; MAX_ROWS]; MAX_ROWS],
    };

    /// Becomes that of the same `equalities` as before for the variables that are `free`, at no cost if it is already.
    pub fn span(&mut self, rows: &Rows, levels: &Levels, count: usize, free: &[bool; MAX_VARIABLES]) {
        if self.free == *free && self.count == count {
            return;
        }
        self.free = *free;
        self.basis.restart(free);
        let mut left = [[0.0; MAX_VARIABLES]; MAX_ROWS];
        for (row, (coefficients, _)) in rows.iter().take(count).enumerate() {
            self.order[row] = row;
            left[row] = self.basis.left(coefficients);
        }
        (self.rank, self.count) = (0, count);
        self.weights = levels.weights;
        self.factor = [[0.0; MAX_ROWS]; MAX_ROWS];
        self.size = rows.coefficients.iter().take(count).map(largest).fold(0.0, f64::max);
        let negligible = levels.blur.map(|blur| {
            let size = DEPENDENT * blur * self.size;
            size * size
        });
        while self.rank < count && self.eliminate(&mut left[..count], &negligible) {}
    }

    /// The next reflection, for the largest of what is `left` of the rows; false if all of it is negligible.
    fn eliminate(&mut self, left: &mut [Vector], negligible: &[f64; MAX_ROWS]) -> bool {
        let k = self.rank;
        let (mut best, mut largest) = (k, 0.0);
        for place in k..left.len() {
            let row = self.order[place];
            let square = product(&left[row], &left[row]);
            if square > largest && square > negligible[row] {
                (best, largest) = (place, square);
            }
        }
        if largest == 0.0 {
            return false;
        }
        let norm = largest.sqrt();
        self.order.swap(k, best);
        let row = self.order[k];
        let (pivot, coordinate) = self.basis.add(&left[row], norm);
        self.factor[row][k] = coordinate;
        for &row in &self.order[k + 1..left.len()] {
            self.basis.last(&mut left[row]);
            self.factor[row][k] = std::mem::take(&mut left[row][pivot]);
        }
        self.rank += 1;
        true
    }

    /// Number of independent equalities.
    #[inline]
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// The smallest length that was left of an independent one.
    pub fn least(&self) -> f64 {
        self.order[..self.rank]
            .iter()
            .enumerate()
            .fold(f64::INFINITY, |least, (k, row)| least.min(self.factor[*row][k].abs()))
    }

    /// Dimension of the null space.
    #[inline]
    pub fn dimension(&self) -> usize {
        self.basis.remaining()
    }

    /// The pivots of the independent equalities.
    fn pivots(&self) -> &[usize] {
        &self.basis.pivots()[..self.rank]
    }

    /// Puts the coordinates `y` where the equalities are nearest to the values `values`.
    pub fn put(&self, y: &mut Vector, values: &[f64; MAX_ROWS]) {
        if self.rank < self.count {
            let mut triangle = Triangle::default();
            (0..self.rank).for_each(|_| triangle.grow(0.0, 0.0));
            for ((row, value), weight) in self.factor.iter().zip(values).zip(self.weights).take(self.count) {
                triangle.add(*row, *value, weight);
            }
            self.pivots().iter().zip(triangle.minimum()).for_each(|(pivot, z)| y[*pivot] = z);
            return;
        }
        for (k, (row, pivot)) in self.order.iter().zip(self.pivots()).enumerate() {
            let factor = &self.factor[*row];
            let before: f64 = factor.iter().zip(self.pivots()).take(k).map(|(factor, pivot)| factor * y[*pivot]).sum();
            y[*pivot] = (values[*row] - before) / factor[k];
        }
    }

    /// Of `errors` of the equalities, keeps the part that the free variables cannot reduce.
    pub fn keep_irreducible(&self, errors: &mut [f64; MAX_ROWS]) {
        let dot = |a: &[f64; MAX_ROWS], b: &[f64; MAX_ROWS]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let mut reducible = [[0.0; MAX_ROWS]; MAX_ROWS];
        for k in 0..self.rank {
            let mut column = self.factor.map(|row| row[k]);
            for before in &reducible[..k] {
                let share = dot(before, &column);
                column.iter_mut().zip(before).for_each(|(column, before)| *column -= share * before);
            }
            let length = dot(&column, &column).sqrt();
            reducible[k] = column.map(|column| column / length);
            let share = dot(&reducible[k], errors);
            errors.iter_mut().zip(&reducible[k]).for_each(|(error, part)| *error -= share * part);
        }
    }

    /// What the row with these reflected `coefficients` has at `y` because of the equalities.
    #[inline]
    pub fn seen(&self, coefficients: &Vector, y: &Vector) -> f64 {
        self.pivots().iter().map(|pivot| coefficients[*pivot] * y[*pivot]).sum()
    }

    /// Multipliers of the equalities that balance the gradient with these `coordinates` on the free variables.
    pub fn multipliers(&self, coordinates: &Vector) -> [f64; MAX_ROWS] {
        let mut multipliers = [0.0; MAX_ROWS];
        for (k, pivot) in self.pivots().iter().enumerate().rev() {
            let later = self.order[k + 1..self.rank].iter().map(|row| self.factor[*row][k] * multipliers[*row]);
            let rest = coordinates[*pivot] - later.sum::<f64>();
            multipliers[self.order[k]] = rest / self.factor[self.order[k]][k];
        }
        multipliers
    }
}
