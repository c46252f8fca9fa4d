//! Joints that are to move less than others: the norm of the rates that is minimised is weighted
//! (thesis 1.8 and 3.3).

use nalgebra::{SMatrix, SVector};

use super::pseudo_inverse::{Spectrum, resolve};
use super::{PseudoInverse, Task};
use crate::parameters::Parameters;
use crate::planar::Vec2;

/// The weights of the joints' rates.
#[derive(Debug, Clone)]
pub(super) struct Weights<const N: usize> {
    /// Rates per rate of equal weight, about 1: only ratios of weights count. None: all weights are equal.
    scale: Option<SVector<f64, N>>,
}

impl<const N: usize> Weights<N> {
    /// The weights of the first `links` coordinates; the others have none.
    pub fn new(parameters: &Parameters, links: usize) -> Self {
        let weights = || parameters.joints.iter().take(links).map(|joint| joint.weight);
        if weights().all(|weight| weight == parameters.joints[0].weight) {
            return Self { scale: None };
        }
        #[allow(clippy::cast_precision_loss)] // a few links
        let mean = weights().map(|weight| 1.0 / weight).sum::<f64>() / links as f64;
        let scale = |i: usize| if i < links { (1.0 / (parameters.joints[i].weight * mean)).sqrt() } else { 1.0 };
        Self { scale: Some(SVector::from_fn(|i, _| scale(i))) }
    }

    /// [`resolve`] in the weighted norm.
    pub fn resolve(
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
        let mut scaled = *path;
        for (mut column, scale) in scaled.column_iter_mut().zip(scale.iter()) {
            column *= *scale;
        }
        let task = task.map(|task| Task { row: task.row.component_mul(scale), ..*task });
        let found = resolve(&scaled, velocity, &preferred.component_div(scale), task.as_ref(), reach);
        PseudoInverse {
            rate: found.rate.component_mul(scale),
            min_singular_value: Spectrum::new(path).smallest.sqrt(),
            ..found
        }
    }
}
