//! Least squares with a ridge, row by row.

use super::MAX_ROWS;

/// One number for each coordinate.
pub(super) type Short = [f64; MAX_ROWS];

/// All rows so far, ridge included, as a triangle R with ones on its diagonal, the weights of its rows, and the
/// right-hand side rotated likewise (W. M. Gentleman, J. Inst. Maths Applics 12 (1973) 329-336).
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Triangle {
    dimension: usize,
    weights: Short,
    factor: [Short; MAX_ROWS],
    right: Short,
}

impl Triangle {
    /// Number of coordinates.
    #[inline]
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// One more coordinate z, and its ridge `weight` (z - `center`)^2.
    #[inline]
    pub fn grow(&mut self, weight: f64, center: f64) {
        self.weights[self.dimension] = weight;
        self.right[self.dimension] = center;
        self.dimension += 1;
    }

    /// One more equation `row` * z = `value` of this `weight`, by Givens rotations without square roots.
    pub fn add(&mut self, mut row: Short, mut value: f64, mut weight: f64) {
        for i in 0..self.dimension {
            let first = row[i];
            if first == 0.0 || weight == 0.0 {
                continue;
            }
            let total = self.weights[i] + weight * first * first;
            let (old, new) = (self.weights[i] / total, weight * first / total);
            self.weights[i] = total;
            weight *= old;
            let rotate = |upper: &mut f64, rest: &mut f64| {
                (*upper, *rest) = (old * *upper + new * *rest, *rest - first * *upper);
            };
            self.factor[i].iter_mut().zip(&mut row).skip(i + 1).for_each(|(upper, rest)| rotate(upper, rest));
            rotate(&mut self.right[i], &mut value);
        }
    }

    /// The z with the smallest sum of weighted squares.
    pub fn minimum(&self) -> Short {
        let mut z = self.right;
        for i in (0..self.dimension).rev() {
            z[i] -= (i + 1..self.dimension).map(|k| self.factor[i][k] * z[k]).sum::<f64>();
        }
        z
    }
}
