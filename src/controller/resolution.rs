//! From what is asked of an interval to rates: the one place where the method is chosen.
//!
//! Whatever the discretization, it hands over the same linear [`Problem`]; each method stands in a file of its
//! own and answers with [`Resolved`].

mod gradient;
mod pseudo_inverse;
mod weights;

use nalgebra::{SMatrix, SVector};

pub use pseudo_inverse::{PATH_THRESHOLD, PseudoInverse, resolve};

use weights::Weights;

use super::Status;
use crate::dynamics::Situation;
use crate::parameters::{Parameters, Resolution};
use crate::planar::Vec2;
use crate::vehicle::Vehicle;

/// One scalar equation `row . q_dot = value`.
#[derive(Debug, Clone, Copy)]
pub struct Task<const N: usize> {
    /// Coefficients of the rates.
    pub row: SVector<f64, N>,
    /// Right-hand side.
    pub value: f64,
}

/// What is asked of the rates of one interval, linear in them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Problem<'a, const N: usize> {
    /// Where the interval begins.
    pub beginning: &'a Situation<N>,
    /// Generalized Jacobian \[m\].
    pub path: SMatrix<f64, 2, N>,
    /// `path` * rate = `velocity` follows the path \[m/s\].
    pub velocity: Vec2,
    /// The rates that meet it exert no moment on the UAV in the mean: an impulse \[N m s\].
    pub moment: Task<N>,
}

/// Rates with how they came about.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resolved<const N: usize> {
    /// Rates of the coordinates \[rad/s, m/s\].
    pub rate: SVector<f64, N>,
    /// What had to be given up for them.
    pub status: Status,
    /// Smallest singular value of the path's matrix \[m\].
    pub min_singular_value: f64,
}

/// The chosen method with its settings.
#[derive(Debug, Clone)]
pub(super) struct Resolver<const N: usize> {
    kind: Resolution,
    /// Length of the stretched arm \[m\].
    reach: f64,
    weights: Weights<N>,
    gradient_gain: f64,
    rate_limit: SVector<f64, N>,
}

impl<const N: usize> Resolver<N> {
    pub fn new(vehicle: &Vehicle<N>, parameters: &Parameters) -> Self {
        Self {
            kind: parameters.ik.resolution,
            reach: vehicle.reach(),
            weights: Weights::new(parameters, vehicle.links),
            gradient_gain: parameters.ik.gradient_gain,
            // The counterweight holds still and needs no limit.
            rate_limit: SVector::from_fn(|i, _| {
                if i < vehicle.links { parameters.joints[i].rate_limit } else { f64::INFINITY }
            }),
        }
    }

    /// Whether the method asks for rates without moment on the UAV.
    pub fn cancels_moment(&self) -> bool {
        self.kind == Resolution::ExtendedJacobian
    }

    /// The rates that the method chooses.
    pub fn solve(&self, vehicle: &Vehicle<N>, problem: &Problem<'_, N>) -> Resolved<N> {
        let Problem { beginning, path, velocity, moment } = problem;
        let (preferred, task) = match self.kind {
            // The smallest rates: right pseudo-inverse of the generalized Jacobian (thesis 1.8).
            Resolution::MinimumNorm => (SVector::zeros(), None),
            Resolution::Gradient => (gradient::preferred(vehicle, beginning, self.gradient_gain), None),
            // One more row below the generalized Jacobian (thesis 3.2, 3.3 and 3.6).
            Resolution::ExtendedJacobian => (SVector::zeros(), Some(moment)),
        };
        self.limited(&self.weights.resolve(path, *velocity, &preferred, task, self.reach))
    }

    /// Scales rates down so that none exceeds its limit, and sums up how they came about.
    fn limited(&self, found: &PseudoInverse<N>) -> Resolved<N> {
        let excess = found.rate.component_div(&self.rate_limit).amax();
        let status = match (excess > 1.0, found.path_damped, found.task_damped) {
            (true, ..) => Status::RateLimited,
            (false, true, _) => Status::PathDamped,
            (false, false, true) => Status::TaskDamped,
            (false, false, false) => Status::Ok,
        };
        Resolved { rate: found.rate / excess.max(1.0), status, min_singular_value: found.min_singular_value }
    }
}
