//! The same problems for Clarabel (P. J. Goulart and Y. Chen), an interior-point method.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, SupportedConeT, ZeroConeT,
};
use nalgebra::{DMatrix, DVector};

use super::case::Case;

/// Rows of `matrix` x + slack = `right` with slacks in `cone`.
struct Constraints {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    cone: SupportedConeT<f64>,
}

fn sparse(matrix: &DMatrix<f64>, upper_triangle: bool) -> CscMatrix<f64> {
    let (rows, columns) = matrix.shape();
    let (mut starts, mut places, mut values) = (vec![0], Vec::new(), Vec::new());
    for column in 0..columns {
        for row in 0..rows {
            let value = matrix[(row, column)];
            if value != 0.0 && !(upper_triangle && row > column) {
                places.push(row);
                values.push(value);
            }
        }
        starts.push(places.len());
    }
    CscMatrix::new(rows, columns, starts, places, values)
}

/// The minimum of |`matrix` x - `right`|^2 + `linear` x; none if the method is not sure of it.
fn minimum(
    matrix: &DMatrix<f64>,
    right: &DVector<f64>,
    linear: &DVector<f64>,
    constraints: &[Constraints],
) -> Option<Vec<f64>> {
    let n = matrix.ncols();
    let hessian = matrix.transpose() * matrix * 2.0;
    let slope: Vec<f64> = (linear - matrix.transpose() * right * 2.0).iter().copied().collect();
    let rows: usize = constraints.iter().map(|part| part.matrix.nrows()).sum();
    let (mut all, mut limits, mut cones) = (DMatrix::zeros(rows, n), Vec::new(), Vec::new());
    for part in constraints {
        all.rows_mut(limits.len(), part.matrix.nrows()).copy_from(&part.matrix);
        limits.extend(part.right.iter());
        cones.push(part.cone.clone());
    }
    let settings = DefaultSettings {
        verbose: false,
        tol_gap_abs: 1e-10,
        tol_gap_rel: 1e-10,
        tol_feas: 1e-10,
        max_iter: 500,
        ..DefaultSettings::default()
    };
    let mut solver =
        DefaultSolver::new(&sparse(&hessian, true), &slope, &sparse(&all, false), &limits, &cones, settings).unwrap();
    solver.solve();
    (solver.solution.status == SolverStatus::Solved).then(|| solver.solution.x.clone())
}

/// Bounds on the first `n` of `columns` variables; infinite ones are none.
fn bounds(case: &Case, columns: usize) -> Constraints {
    let mut rows = Vec::new();
    for i in 0..case.n() {
        for (sign, bound) in [(1.0, case.problem.upper[i]), (-1.0, -case.problem.lower[i])] {
            if bound.is_finite() {
                rows.push((i, sign, bound));
            }
        }
    }
    let mut matrix = DMatrix::zeros(rows.len(), columns);
    for (row, (i, sign, _)) in rows.iter().enumerate() {
        matrix[(row, *i)] = *sign;
    }
    let right = DVector::from_iterator(rows.len(), rows.iter().map(|(_, _, bound)| *bound));
    Constraints { cone: NonnegativeConeT(rows.len()), matrix, right }
}

/// The least |E x - e| within the bounds.
pub fn least_equality_error(case: &Case) -> Option<f64> {
    let n = case.n();
    // A ridge of this size costs nothing that could be seen, and makes the problem strictly convex.
    let (matrix, right) = stacked(&case.equalities, 1e-14, n);
    let x = minimum(&matrix, &right, &DVector::zeros(n), &[bounds(case, n)]);
    x.map(|x| case.equality_error(&DVector::from_vec(x)))
}

/// The cheapest point within the bounds with the same E x as `like`.
pub fn least_cost(case: &Case, like: &DVector<f64>) -> Option<DVector<f64>> {
    let n = case.n();
    // Variables x and t >= |x|.
    let (matrix, right) = stacked(&case.objective, case.problem.ridge, n);
    let matrix = matrix.insert_columns(n, n, 0.0);
    let linear = DVector::from_fn(2 * n, |i, _| if i < n { 0.0 } else { case.problem.penalty[i - n] });
    let mut absolute = DMatrix::zeros(2 * n, 2 * n);
    for i in 0..n {
        (absolute[(2 * i, i)], absolute[(2 * i, n + i)]) = (1.0, -1.0);
        (absolute[(2 * i + 1, i)], absolute[(2 * i + 1, n + i)]) = (-1.0, -1.0);
    }
    let rows = case.equalities.0.nrows();
    let constraints = [
        Constraints {
            matrix: case.equalities.0.clone().insert_columns(n, n, 0.0),
            right: &case.equalities.0 * like,
            cone: ZeroConeT(rows),
        },
        Constraints { matrix: absolute, right: DVector::zeros(2 * n), cone: NonnegativeConeT(2 * n) },
        bounds(case, 2 * n),
    ];
    let x = minimum(&matrix, &right, &linear, &constraints);
    x.map(|x| DVector::from_column_slice(&x[..n]))
}

/// Rows with a ridge under them.
fn stacked((matrix, right): &(DMatrix<f64>, DVector<f64>), ridge: f64, n: usize) -> (DMatrix<f64>, DVector<f64>) {
    let rows = matrix.nrows();
    let all = DMatrix::from_fn(rows + n, n, |row, column| {
        if row < rows {
            matrix[(row, column)]
        } else if row - rows == column {
            ridge.sqrt()
        } else {
            0.0
        }
    });
    (all, DVector::from_fn(rows + n, |row, _| if row < rows { right[row] } else { 0.0 }))
}
