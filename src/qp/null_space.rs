//! The directions in which some of the variables may move without a change of the equalities.

use super::turn::Turn;
use super::{MAX_ROWS, MAX_VARIABLES, Rows, Vector, product};

/// A row of which less than this share of the largest coefficient is left depends on the rows before it.
const DEPENDENT: f64 = 1e-10;

/// The rows of the equalities on the free variables, transposed and decomposed: Q R with Householder
/// reflections, the largest remaining row first. Columns of Q that are no pivots span the null space.
///
/// Vectors have a place for each variable; it is zero for those that are not free.
#[derive(Debug, Clone, Copy)]
pub(super) struct NullSpace {
    /// The free variables.
    free: [bool; MAX_VARIABLES],
    /// Q^T; whoever adds reflections takes them away again.
    pub turn: Turn,
    /// Independent rows among the equalities, in the order of elimination, and how many.
    order: [usize; MAX_ROWS],
    rank: usize,
    /// R^T, one row for each equality.
    factor: [[f64; MAX_ROWS]; MAX_ROWS],
}

impl NullSpace {
    /// Where no variable is free.
    pub const EMPTY: Self = Self {
        free: [false; MAX_VARIABLES],
        turn: Turn::EMPTY,
        order: [0; MAX_ROWS],
        rank: 0,
        factor: [[0.0; MAX_ROWS]; MAX_ROWS],
    };

    /// Becomes that of the same `equalities`, with the largest coefficient `size`, as before for the variables that
    /// are `free`, at no cost if it is already.
    pub fn span(&mut self, equalities: &Rows, size: f64, free: &[bool; MAX_VARIABLES]) {
        if self.free == *free {
            return;
        }
        self.free = *free;
        self.turn.restart(free);
        let mut left = [[0.0; MAX_VARIABLES]; MAX_ROWS];
        for (row, (coefficients, _)) in equalities.iter().enumerate() {
            self.order[row] = row;
            left[row] = self.turn.left(coefficients);
        }
        self.rank = 0;
        while self.rank < equalities.count && self.eliminate(&mut left[..equalities.count], DEPENDENT * size) {}
    }

    /// The next reflection, for the largest of what is `left` of the rows; false if nothing is.
    fn eliminate(&mut self, left: &mut [Vector], negligible: f64) -> bool {
        let k = self.rank;
        let (mut best, mut largest) = (k, 0.0);
        for place in k..left.len() {
            let row = &left[self.order[place]];
            let size = product(row, row);
            if size > largest {
                (best, largest) = (place, size);
            }
        }
        let norm = largest.sqrt();
        if norm <= negligible {
            return false;
        }
        self.order.swap(k, best);
        let row = self.order[k];
        let (pivot, coordinate) = self.turn.add(&left[row], norm);
        self.factor[row][k] = coordinate;
        for &row in &self.order[k + 1..left.len()] {
            self.turn.last(&mut left[row]);
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

    /// Dimension of the null space.
    #[inline]
    pub fn dimension(&self) -> usize {
        self.turn.remaining()
    }

    /// The pivots of the independent equalities.
    fn pivots(&self) -> &[usize] {
        &self.turn.pivots()[..self.rank]
    }

    /// How much of each variable's axis, squared, lies in the null space.
    pub fn shares(&self) -> Vector {
        let mut shares = [1.0; MAX_VARIABLES];
        for pivot in self.pivots() {
            let mut y = [0.0; MAX_VARIABLES];
            y[*pivot] = 1.0;
            shares.iter_mut().zip(self.turn.back(y)).for_each(|(share, y)| *share -= y * y);
        }
        shares
    }

    /// Puts the coordinates `y` where the independent equalities have the values `values`.
    pub fn put(&self, y: &mut Vector, values: &[f64; MAX_ROWS]) {
        for (k, (row, pivot)) in self.order.iter().zip(self.pivots()).enumerate() {
            let factor = &self.factor[*row];
            let before: f64 = factor.iter().zip(self.pivots()).take(k).map(|(factor, pivot)| factor * y[*pivot]).sum();
            y[*pivot] = (values[*row] - before) / factor[k];
        }
    }

    /// What the row with these turned `coefficients` has at `y` because of the equalities.
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
