//! The path first, then one more task in the rates that do not disturb the path.
//!
//! Away from singular configurations this is the thesis' solution, minimum norm without the second task
//! (1.8) and the extended Jacobian with it (3.26); but it says which of the two gives way where they
//! contradict each other, and stays bounded there (damped least squares, Y. Nakamura and H. Hanafusa,
//! J. Dyn. Sys. Meas. Control 108 (1986) 163-171, in the weak direction only: A. A. Maciejewski and
//! C. A. Klein, J. Robotic Systems 5 (1988) 527-552).

use nalgebra::{SMatrix, SVector};

use super::Task;
use crate::controller::Status;
use crate::planar::{Vec2, cross, perp};

/// Singular values of the path below this share of the arm's reach are damped.
pub const PATH_THRESHOLD: f64 = 2e-2;

/// The second task is damped where less than this share of its row is left beside the path.
const TASK_THRESHOLD: f64 = 1e-2;

/// Rates with what had to be given up for them.
#[derive(Debug, Clone, Copy)]
pub struct PseudoInverse<const N: usize> {
    /// Rates of the coordinates \[rad/s, m/s\].
    pub rate: SVector<f64, N>,
    /// Smallest singular value of the path's matrix \[m\].
    pub min_singular_value: f64,
    /// Whether the path is followed in part only.
    pub path_damped: bool,
    /// Whether the second task is met in part only.
    pub task_damped: bool,
}

impl<const N: usize> PseudoInverse<N> {
    /// What had to be given up.
    pub(super) fn status(&self) -> Status {
        match (self.path_damped, self.task_damped) {
            (true, _) => Status::PathDamped,
            (false, true) => Status::TaskDamped,
            (false, false) => Status::Ok,
        }
    }
}

/// The Gram matrix J J^T of a path by its eigenvalues and its first eigenvector.
pub(super) struct Spectrum {
    largest: f64,
    /// Square of the smallest singular value of J.
    pub smallest: f64,
    /// The direction in which the arm moves most easily.
    strong: Vec2,
}

impl Spectrum {
    pub fn new<const N: usize>(path: &SMatrix<f64, 2, N>) -> Self {
        let (x, y) = (path.row(0), path.row(1));
        let (xx, xy, yy) = (x.norm_squared(), x.dot(&y), y.norm_squared());
        // The determinant as a sum of squares (Cauchy-Binet) does not cancel.
        let mut determinant = 0.0;
        for i in 0..N {
            for j in 0..i {
                determinant += cross(path.column(i).into(), path.column(j).into()).powi(2);
            }
        }
        let largest = 0.5 * (xx + yy) + (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
        let smallest = if largest > 0.0 { determinant / largest } else { 0.0 };
        let strong = if xx > yy { Vec2::new(largest - yy, xy) } else { Vec2::new(xy, largest - xx) };
        Self { largest, smallest, strong: strong.try_normalize(f64::MIN_POSITIVE).unwrap_or_else(Vec2::x) }
    }
}

/// The rates nearest to the `preferred` ones with `path` * rate = `velocity` and, if possible beside it, with
/// `task`.
///
/// `path`: 2 x N \[m\], `velocity`: \[m/s\], `reach`: length of the stretched arm \[m\].
#[must_use]
pub fn resolve<const N: usize>(
    path: &SMatrix<f64, 2, N>,
    velocity: Vec2,
    preferred: &SVector<f64, N>,
    task: Option<&Task<N>>,
    reach: f64,
) -> PseudoInverse<N> {
    // The directions in which the arm moves easily and hardly: each is damped on its own.
    let Spectrum { largest, smallest, strong } = Spectrum::new(path);
    let weak = perp(strong);
    let threshold = PATH_THRESHOLD * reach;
    let min_singular_value = smallest.sqrt();
    let damping_weak = damping(min_singular_value, threshold);
    let (gain_strong, gain_weak) =
        (1.0 / (largest + damping(largest.sqrt(), threshold)), 1.0 / (smallest + damping_weak));
    // J^T (J J^T + damping)^-1 w.
    let lift =
        |w: Vec2| path.transpose() * (strong * (strong.dot(&w) * gain_strong) + weak * (weak.dot(&w) * gain_weak));

    let mut rate = preferred + lift(velocity - path * preferred);
    let mut task_damped = false;
    if let Some(task) = task {
        let free = task.row - lift(path * task.row);
        let size = task.row.norm();
        let share = free.norm() / size.max(f64::MIN_POSITIVE);
        let damping = damping(share, TASK_THRESHOLD) * size * size;
        task_damped = damping > 0.0;
        let missing = task.value - task.row.dot(&rate);
        rate += free * (missing / (free.norm_squared() + damping).max(f64::MIN_POSITIVE));
    }
    PseudoInverse { rate, min_singular_value, path_damped: damping_weak > 0.0, task_damped }
}

/// Square of the damping factor: grows smoothly from 0 at the threshold to its square at a singularity.
fn damping(singular_value: f64, threshold: f64) -> f64 {
    let share = singular_value / threshold;
    if share < 1.0 { threshold * threshold * (1.0 - share) * (1.0 - share) } else { 0.0 }
}
