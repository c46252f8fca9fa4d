//! Joints that are to move less than others: the norm of the rates that is minimised is weighted
//! (thesis 1.8 and 3.3).

use nalgebra::{SMatrix, SVector};

use super::pseudo_inverse::{Gram, padded, padded_task, padded_vector, resolve};
use super::{PseudoInverse, Task};
use crate::parameters::{Joint, MAX_COORDINATES};
use crate::planar::Vec2;

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

    /// [`resolve`] in the weighted norm.
    pub fn resolve<const N: usize>(
        &self,
        path: &SMatrix<f64, 2, N>,
        velocity: Vec2,
        preferred: &SVector<f64, N>,
        task: Option<&Task<N>>,
        reach: f64,
    ) -> PseudoInverse<N> {
        let Some(scale) = &self.scale else {
            return resolve(path, velocity, preferred, task, reach);
        };
        let task = task.map(padded_task);
        weighted(scale, &padded(path), velocity, &padded_vector(preferred), task.as_ref(), reach).of_the_first()
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
    path: &SMatrix<f64, 2, MAX_COORDINATES>,
    velocity: Vec2,
    preferred: &SVector<f64, MAX_COORDINATES>,
    task: Option<&Task<MAX_COORDINATES>>,
    reach: f64,
) -> PseudoInverse<MAX_COORDINATES> {
    let mut scaled = *path;
    for (mut column, scale) in scaled.column_iter_mut().zip(scale.iter()) {
        column *= *scale;
    }
    let task = task.map(|task| Task { row: task.row.component_mul(scale), ..*task });
    let found = resolve(&scaled, velocity, &preferred.component_div(scale), task.as_ref(), reach);
    PseudoInverse {
        rate: found.rate.component_mul(scale),
        min_singular_value: Gram::new(path).smallest.sqrt(),
        ..found
    }
}
