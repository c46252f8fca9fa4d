//! The directions in which some of the variables may move without a change of the equalities.

use super::{MAX_ROWS, MAX_VARIABLES, Rows, Vector, dot};

/// A row of which less than this share of the largest coefficient is left depends on the rows before it.
const DEPENDENT: f64 = 1e-10;

/// The rows of the equalities on the free variables, transposed and decomposed: Q R with Householder
/// reflections, the largest remaining row first. Columns of Q beyond the rank span the null space.
#[derive(Debug, Clone, Copy)]
pub(super) struct NullSpace {
    /// The free variables that it is for; none: it is for nothing yet.
    of: Option<[bool; MAX_VARIABLES]>,
    /// Indices of the free variables, and how many.
    index: [usize; MAX_VARIABLES],
    free: usize,
    /// Independent rows among the equalities, in the order of elimination, and how many.
    order: [usize; MAX_ROWS],
    rank: usize,
    /// Reflections 1 - v v^T; R^T, one row for each equality.
    reflections: [Vector; MAX_ROWS],
    factor: [Vector; MAX_ROWS],
}

impl NullSpace {
    /// For nothing yet.
    pub const EMPTY: Self = Self {
        of: None,
        index: [0; MAX_VARIABLES],
        free: 0,
        order: [0; MAX_ROWS],
        rank: 0,
        reflections: [[0.0; MAX_VARIABLES]; MAX_ROWS],
        factor: [[0.0; MAX_VARIABLES]; MAX_ROWS],
    };

    /// Becomes that of the same `equalities` as before for the variables that are `free`, at no cost if it is
    /// already.
    pub fn span(&mut self, equalities: &Rows, free: &[bool; MAX_VARIABLES]) {
        if self.of.as_ref() == Some(free) {
            return;
        }
        self.of = Some(*free);
        (self.free, self.rank) = (0, 0);
        for (i, _) in free.iter().enumerate().filter(|(_, free)| **free) {
            self.index[self.free] = i;
            self.free += 1;
        }
        for (row, (coefficients, _)) in equalities.iter().enumerate() {
            self.order[row] = row;
            self.factor[row] = self.part(coefficients);
        }
        let negligible = DEPENDENT * equalities.size();
        while self.rank < equalities.count.min(self.free) && self.eliminate(equalities.count, negligible) {}
    }

    /// The next reflection; false if no row is left.
    fn eliminate(&mut self, rows: usize, negligible: f64) -> bool {
        let (k, f) = (self.rank, self.free);
        let rest = |row: usize| dot(&self.factor[row][k..f], &self.factor[row][k..f]);
        let (mut best, mut largest) = (k, 0.0);
        for place in k..rows {
            let size = rest(self.order[place]);
            if size > largest {
                (best, largest) = (place, size);
            }
        }
        let norm = largest.sqrt();
        if norm <= negligible {
            return false;
        }
        self.order.swap(k, best);
        let pivot = self.order[k];
        let mut v = [0.0; MAX_VARIABLES];
        v[k..f].copy_from_slice(&self.factor[pivot][k..f]);
        let sign = if v[k] < 0.0 { -1.0 } else { 1.0 };
        v[k] += sign * norm;
        let scale = (norm * v[k].abs()).sqrt().recip();
        v[k..f].iter_mut().for_each(|v| *v *= scale);
        for &row in &self.order[k + 1..rows] {
            reflect(&v[k..f], &mut self.factor[row][k..f]);
        }
        self.factor[pivot][k] = -sign * norm;
        self.reflections[k] = v;
        self.rank += 1;
        true
    }

    /// Number of independent equalities.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// Dimension of the null space.
    pub fn dimension(&self) -> usize {
        self.free - self.rank
    }

    /// Indices of the free variables.
    pub fn indices(&self) -> &[usize] {
        &self.index[..self.free]
    }

    /// The free ones of the numbers `all`, closed up.
    pub fn part(&self, all: &Vector) -> Vector {
        let mut part = [0.0; MAX_VARIABLES];
        part.iter_mut().zip(self.indices()).for_each(|(part, i)| *part = all[*i]);
        part
    }

    /// Q^T `y` for `y` on the free variables: what the equalities see, then coordinates of the null space.
    pub fn coordinates(&self, mut y: Vector) -> Vector {
        for (k, v) in self.reflections.iter().enumerate().take(self.rank) {
            reflect(&v[k..self.free], &mut y[k..self.free]);
        }
        y
    }

    /// The coordinates of the null space out of [`NullSpace::coordinates`].
    pub fn inner<'a>(&self, coordinates: &'a Vector) -> &'a [f64] {
        &coordinates[self.rank..self.free]
    }

    /// Free variables with the coordinates `z` in the null space.
    pub fn direction(&self, z: &[f64]) -> Vector {
        let mut y = [0.0; MAX_VARIABLES];
        y[self.rank..self.free].iter_mut().zip(z).for_each(|(y, z)| *y = *z);
        self.turned_back(y)
    }

    fn turned_back(&self, mut y: Vector) -> Vector {
        for (k, v) in self.reflections.iter().enumerate().take(self.rank).rev() {
            reflect(&v[k..self.free], &mut y[k..self.free]);
        }
        y
    }

    /// The smallest free variables with which the independent equalities have the values `values`.
    pub fn particular(&self, values: &[f64; MAX_ROWS]) -> Vector {
        let mut y = [0.0; MAX_VARIABLES];
        for (k, &row) in self.order.iter().enumerate().take(self.rank) {
            let factor = &self.factor[row];
            y[k] = (values[row] - dot(&factor[..k], &y[..k])) / factor[k];
        }
        self.turned_back(y)
    }

    /// Multipliers of the equalities that balance the gradient with these `coordinates` on the free variables.
    pub fn multipliers(&self, coordinates: &Vector) -> [f64; MAX_ROWS] {
        let mut multipliers = [0.0; MAX_ROWS];
        for k in (0..self.rank).rev() {
            let later = self.order[k + 1..self.rank].iter().map(|row| self.factor[*row][k] * multipliers[*row]);
            let rest = coordinates[k] - later.sum::<f64>();
            multipliers[self.order[k]] = rest / self.factor[self.order[k]][k];
        }
        multipliers
    }
}

/// `y` - v (v^T `y`).
fn reflect(v: &[f64], y: &mut [f64]) {
    let share = dot(v, y);
    y.iter_mut().zip(v).for_each(|(y, v)| *y -= v * share);
}
