//! Joints that are to move less than others: the norm of the rates that is minimised is weighted
//! (thesis 1.8 and 3.3).

use nalgebra::SVector;

use super::pseudo_inverse::{Gram, Problem, PseudoInverse};
use crate::parameters::{Joint, MAX_COORDINATES, PathAxes};

/// The weights of the joints' rates; what balances the arm has none.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weights {
    /// Rates per rate of equal weight, about 1: only ratios of weights count. None: all weights are equal.
    scale: Option<SVector<f64, MAX_COORDINATES>>,
}

impl Weights {
    /// All weights are equal.
    pub const EQUAL: Self = Self { scale: None };

    /// Takes over the weights of `joints`.
    pub fn tune(&mut self, joints: &[Joint]) {
        self.scale =
            if joints.iter().all(|joint| joint.weight == joints[0].weight) { None } else { Some(scale(joints)) };
    }

    /// [`Problem::resolve`] in the weighted norm.
    #[inline]
    pub fn resolve<const N: usize>(
        &self,
        problem: &Problem<N>,
        axes: PathAxes,
        without_moment: bool,
        reach: f64,
    ) -> PseudoInverse<N> {
        match &self.scale {
            None => problem.resolve(axes, without_moment, reach),
            Some(scale) => weighted(scale, problem.padded(), axes, without_moment, reach).of_the_first(),
        }
    }
}

#[cold]
#[inline(never)]
fn scale(joints: &[Joint]) -> SVector<f64, MAX_COORDINATES> {
    #[allow(clippy::cast_precision_loss)] // a few links
    let mean = joints.iter().map(|joint| 1.0 / joint.weight).sum::<f64>() / joints.len() as f64;
    SVector::from_fn(|i, _| joints.get(i).map_or(1.0, |joint| (1.0 / (joint.weight * mean)).sqrt()))
}

/// For the largest number of coordinates: the library holds one copy.
#[inline(never)]
fn weighted(
    scale: &SVector<f64, MAX_COORDINATES>,
    mut problem: Problem<MAX_COORDINATES>,
    axes: PathAxes,
    without_moment: bool,
    reach: f64,
) -> PseudoInverse<MAX_COORDINATES> {
    let min_singular_value = Gram::new(&problem.path, axes).smallest.sqrt();
    for (mut column, scale) in problem.path.column_iter_mut().zip(scale) {
        column *= *scale;
    }
    problem.moment.row.component_mul_assign(scale);
    let found = problem.resolve(axes, without_moment, reach);
    PseudoInverse { rate: found.rate.component_mul(scale), min_singular_value, ..found }
}
