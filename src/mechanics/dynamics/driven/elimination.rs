//! Linear equations with a symmetric, positive definite matrix, of a size known at run time: one copy serves every
//! vehicle.

/// Replaces `x` by the solution of `matrix` * y = x and leaves the pivots, all positive, on the diagonal.
///
/// Where a pivot is 0 the solution is not finite.
pub(super) fn solve(matrix: &mut [f64], x: &mut [f64]) {
    let n = x.len();
    for k in 0..n {
        for i in k + 1..n {
            let share = matrix[i * n + k] / matrix[k * n + k];
            for j in k..n {
                matrix[i * n + j] -= share * matrix[k * n + j];
            }
            x[i] -= share * x[k];
        }
    }
    for i in (0..n).rev() {
        for j in i + 1..n {
            x[i] -= matrix[i * n + j] * x[j];
        }
        x[i] /= matrix[i * n + i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_equations_in_closed_form() {
        // Determinants of the leading blocks: 4, 11, 30.
        let mut matrix = [4.0, 1.0, 2.0, 1.0, 3.0, 0.0, 2.0, 0.0, 42.0 / 11.0];
        let mut x = [4.0 + 2.0 + 6.0, 1.0 + 6.0, 2.0 + 126.0 / 11.0];
        solve(&mut matrix, &mut x);
        for (found, expected) in x.iter().zip([1.0, 2.0, 3.0]) {
            assert!((found - expected).abs() < 1e-14, "{found}");
        }
        for (i, pivot) in [4.0, 11.0 / 4.0, 30.0 / 11.0].into_iter().enumerate() {
            assert!((matrix[4 * i] - pivot).abs() < 1e-14);
        }
    }
}
