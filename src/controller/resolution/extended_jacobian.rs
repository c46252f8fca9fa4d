//! The moment on the UAV is zero: one more row below the generalized Jacobian (thesis 3.2, 3.3 and 3.6).

use super::{Problem, PseudoInverse, resolve};

pub(super) fn solve<const N: usize>(problem: &Problem<N>, reach: f64) -> PseudoInverse<N> {
    resolve(&problem.path, problem.velocity, Some(&problem.moment), reach)
}
