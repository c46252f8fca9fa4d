//! Least squares with a ridge, row by row.

use super::{MAX_VARIABLES, Vector};

/// The triangular factor R of all rows so far, ridge included, and the right-hand side turned likewise.
#[derive(Debug, Clone, Copy)]
pub(super) struct Triangle {
    dimension: usize,
    factor: [Vector; MAX_VARIABLES],
    right: Vector,
}

impl Triangle {
    /// The ridge alone: `weight` |z - `center`|^2.
    pub fn new(weight: f64, center: &[f64]) -> Self {
        let mut triangle = Self {
            dimension: center.len(),
            factor: [[0.0; MAX_VARIABLES]; MAX_VARIABLES],
            right: [0.0; MAX_VARIABLES],
        };
        let root = weight.sqrt();
        for (i, center) in center.iter().enumerate() {
            triangle.factor[i][i] = root;
            triangle.right[i] = root * center;
        }
        triangle
    }

    /// One more equation `row` * z = `value` (Givens rotations: W. Givens, J. SIAM 6 (1958) 26-50).
    pub fn add(&mut self, row: &[f64], mut value: f64) {
        let n = self.dimension;
        let mut rest = [0.0; MAX_VARIABLES];
        rest[..n].copy_from_slice(row);
        for i in 0..n {
            if rest[i] == 0.0 {
                continue;
            }
            let upper = &mut self.factor[i];
            let size = upper[i].hypot(rest[i]);
            let (cosine, sine) = (upper[i] / size, rest[i] / size);
            for (upper, rest) in upper[i..n].iter_mut().zip(&mut rest[i..n]) {
                (*upper, *rest) = (cosine * *upper + sine * *rest, cosine * *rest - sine * *upper);
            }
            (self.right[i], value) = (cosine * self.right[i] + sine * value, cosine * value - sine * self.right[i]);
        }
    }

    /// The z with the smallest sum of squares plus twice `slope` * z.
    pub fn minimum(&self, slope: &[f64]) -> Vector {
        let n = self.dimension;
        // R^T u = slope, then R z = right - u.
        let mut u = [0.0; MAX_VARIABLES];
        for i in 0..n {
            let before: f64 = (0..i).map(|k| self.factor[k][i] * u[k]).sum();
            u[i] = (slope[i] - before) / self.factor[i][i];
        }
        let mut z = [0.0; MAX_VARIABLES];
        for i in (0..n).rev() {
            let after: f64 = (i + 1..n).map(|k| self.factor[i][k] * z[k]).sum();
            z[i] = (self.right[i] - u[i] - after) / self.factor[i][i];
        }
        z
    }
}
