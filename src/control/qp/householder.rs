//! An orthogonal change of coordinates, made of Householder reflections, that map rows to single coordinates.

use super::{MAX_VARIABLES, Vector, product};

/// Reflections 1 - `scale` v v^T, one after the other. Each maps what is left of a row to one coordinate, the pivot,
/// and lets the pivots before alone. Where one coordinate is left, it is the pivot without a reflection.
#[derive(Debug, Clone, Copy)]
pub(super) struct Householder {
    reflections: [(Vector, f64); MAX_VARIABLES],
    pivots: [usize; MAX_VARIABLES],
    count: usize,
    /// Number of coordinates that may still change.
    remaining: usize,
    /// 1 for the variables that it is about, otherwise 0.
    pub free: Vector,
    /// 1 for the coordinates that may still change, otherwise 0.
    left: Vector,
}

impl Householder {
    /// Of no variables.
    pub const EMPTY: Self = Self {
        reflections: [([0.0; MAX_VARIABLES], 0.0); MAX_VARIABLES],
        pivots: [0; MAX_VARIABLES],
        count: 0,
        remaining: 0,
        free: [0.0; MAX_VARIABLES],
        left: [0.0; MAX_VARIABLES],
    };

    /// Begins again with the variables that are `free`.
    pub fn restart(&mut self, free: &[bool; MAX_VARIABLES]) {
        self.free = free.map(|free| if free { 1.0 } else { 0.0 });
        self.left = self.free;
        self.count = 0;
        self.remaining = free.iter().map(|free| usize::from(*free)).sum();
    }

    /// Number of coordinates that no pivot has.
    #[inline]
    pub fn remaining(&self) -> usize {
        self.remaining
    }

    /// The pivots in their order.
    #[inline]
    pub fn pivots(&self) -> &[usize] {
        &self.pivots[..self.count]
    }

    /// What no pivot has of the reflected `row`.
    #[inline]
    pub fn left(&self, row: &Vector) -> Vector {
        std::array::from_fn(|i| row[i] * self.left[i])
    }

    /// One more reflection: what is left of the reflected `row`, of the length `norm`, becomes one coordinate. The pivot
    /// and what it is.
    pub fn add(&mut self, row: &Vector, norm: f64) -> (usize, f64) {
        let pivot = self.left.iter().position(|left| *left > 0.0).unwrap_or(0);
        let mut coordinate = row[pivot];
        if self.remaining > 1 {
            let mut v = self.left(row);
            v[pivot] += norm.copysign(coordinate);
            self.reflections[self.count] = (v, (norm * v[pivot].abs()).recip());
            coordinate = -norm.copysign(coordinate);
        }
        self.pivots[self.count] = pivot;
        self.left[pivot] = 0.0;
        self.count += 1;
        self.remaining -= 1;
        (pivot, coordinate)
    }

    /// Only the first `count` reflections remain.
    #[inline]
    pub fn truncate(&mut self, count: usize) {
        self.pivots[count..self.count].iter().for_each(|pivot| self.left[*pivot] = 1.0);
        self.remaining += self.count - count;
        self.count = count;
    }

    /// The reflections in their order.
    fn reflections(&self) -> &[(Vector, f64)] {
        &self.reflections[..if self.remaining == 0 { self.count.saturating_sub(1) } else { self.count }]
    }

    /// Applies the last reflection to `y` alone.
    pub fn last(&self, y: &mut Vector) {
        if self.remaining > 0 {
            self.reflections().last().into_iter().for_each(|reflection| reflect(reflection, y));
        }
    }

    /// What `x` becomes on the free variables.
    pub fn forth(&self, x: &Vector) -> Vector {
        let mut y = std::array::from_fn(|i| x[i] * self.free[i]);
        self.reflections().iter().for_each(|reflection| reflect(reflection, &mut y));
        y
    }

    /// What becomes `y`.
    pub fn back(&self, mut y: Vector) -> Vector {
        self.reflections().iter().rev().for_each(|reflection| reflect(reflection, &mut y));
        y
    }
}

/// `y` - scale v (v^T `y`).
fn reflect((v, scale): &(Vector, f64), y: &mut Vector) {
    let share = scale * product(v, y);
    y.iter_mut().zip(v).for_each(|(y, v)| *y -= v * share);
}
