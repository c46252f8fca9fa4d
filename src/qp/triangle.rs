//! Least squares with a ridge, row by row.

use super::MAX_ROWS;

/// One number for each coordinate in which rows of the objective lie.
pub(super) type Short = [f64; MAX_ROWS];

/// The triangular factor R of all rows so far, ridge included, and the right-hand side turned likewise.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Triangle {
    dimension: usize,
    factor: [Short; MAX_ROWS],
    right: Short,
}

impl Triangle {
    /// One more coordinate z, with a ridge: `weight`^2 |z - `center`|^2.
    pub fn grow(&mut self, weight: f64, center: f64) {
        self.factor[self.dimension][self.dimension] = weight;
        self.right[self.dimension] = weight * center;
        self.dimension += 1;
    }

    /// One more equation `row` * z = `value` (Givens rotations: W. Givens, J. SIAM 6 (1958) 26-50).
    pub fn add(&mut self, mut row: Short, mut value: f64) {
        for i in 0..self.dimension {
            let upper = &mut self.factor[i];
            let size = (upper[i] * upper[i] + row[i] * row[i]).sqrt();
            let (cosine, sine) = (upper[i] / size, row[i] / size);
            for (upper, rest) in upper[i..].iter_mut().zip(&mut row[i..]) {
                (*upper, *rest) = (cosine * *upper + sine * *rest, cosine * *rest - sine * *upper);
            }
            (self.right[i], value) = (cosine * self.right[i] + sine * value, cosine * value - sine * self.right[i]);
        }
    }

    /// The z with the smallest sum of squares.
    pub fn minimum(&self) -> Short {
        let mut z = [0.0; MAX_ROWS];
        for i in (0..self.dimension).rev() {
            let after: f64 = (i + 1..self.dimension).map(|k| self.factor[i][k] * z[k]).sum();
            z[i] = (self.right[i] - after) / self.factor[i][i];
        }
        z
    }
}
