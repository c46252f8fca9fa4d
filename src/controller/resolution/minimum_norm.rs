//! The smallest rates that follow the path: right pseudo-inverse of the generalized Jacobian (thesis 1.8).

use super::{Problem, PseudoInverse, resolve};

pub(super) fn solve<const N: usize>(problem: &Problem<N>, reach: f64) -> PseudoInverse<N> {
    resolve(&problem.path, problem.velocity, None, reach)
}
