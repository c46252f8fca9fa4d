//! Joints that are to move less than others: the norm of the rates that is minimised is weighted
//! (thesis 1.8 and 3.3).

use nalgebra::SVector;

use super::pseudo_inverse::{Gram, Problem, PseudoInverse, Thresholds};
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

/// Singular values \[m\] and shares below this are rounding.
const NOTHING: f64 = 1e-10;

#[cold]
fn scale(joints: &[Joint]) -> SVector<f64, MAX_COORDINATES> {
    #[allow(clippy::cast_precision_loss)] // a few links
    let mean = joints.iter().map(|joint| 1.0 / joint.weight).sum::<f64>() / joints.len() as f64;
    SVector::from_fn(|i, _| joints.get(i).map_or(1.0, |joint| (1.0 / (joint.weight * mean)).sqrt()))
}

/// For the largest number of coordinates: the library holds one copy.
fn weighted(
    scale: &SVector<f64, MAX_COORDINATES>,
    mut problem: Problem<MAX_COORDINATES>,
    axes: PathAxes,
    without_moment: bool,
    reach: f64,
) -> PseudoInverse<MAX_COORDINATES> {
    let plain = Thresholds::of(reach);
    let unweighted = Gram::new(&problem.path, axes);
    let share = problem.share_beside_path(axes);
    for (mut column, scale) in problem.path.column_iter_mut().zip(scale) {
        column *= *scale;
    }
    problem.moment.row.component_mul_assign(scale);
    let gram = Gram::new(&problem.path, axes);
    // Weights do not bring a configuration nearer to a singular one: rates are damped where equal weights would damp them.
    let ratio = |weighted: f64, plain: f64| if plain > NOTHING { weighted / plain } else { 1.0 };
    let stretch = ratio(gram.smallest.sqrt(), unweighted.smallest.sqrt());
    let thresholds = Thresholds {
        path: plain.path * stretch,
        task: plain.task * ratio(problem.share_beside_path(axes), share),
        reach: plain.reach * stretch * stretch,
    };
    let found = problem.resolve_to(axes, without_moment, &thresholds);
    PseudoInverse { rate: found.rate.component_mul(scale), min_singular_value: unweighted.smallest.sqrt(), ..found }
}
