//! The path first, then one more task in the rates that do not disturb the path.
//!
//! Away from singular configurations this is the thesis' solution, minimum norm without the second task
//! (1.8) and the extended Jacobian with it (3.26); but it says which of the two gives way where they
//! contradict each other, and stays bounded there (damped least squares, Y. Nakamura and H. Hanafusa,
//! J. Dyn. Sys. Meas. Control 108 (1986) 163-171, in the weak direction only: A. A. Maciejewski and
//! C. A. Klein, J. Robotic Systems 5 (1988) 527-552).

use nalgebra::{SMatrix, SVector};

use crate::control::Status;
use crate::mechanics::planar::{Vec2, cross, perp, vec2};
use crate::parameters::{MAX_COORDINATES, PathAxes};

/// Singular values of the path below this share of the arm's reach are damped.
pub const PATH_THRESHOLD: f64 = 2e-2;

/// The second task is damped where less than this share of its row is left beside the path.
const TASK_THRESHOLD: f64 = 1e-2;

/// What is below this share of a row is rounding.
const ROUNDING: f64 = 1e-12;

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
pub struct Problem<const N: usize> {
    /// Generalized Jacobian, velocity of the end effector per rate \[m\].
    pub path: SMatrix<f64, 2, N>,
    /// `path` * rate = `velocity` follows the path \[m/s\].
    pub velocity: Vec2,
    /// Length of the interval \[s\].
    pub interval: f64,
    /// How carefully the second task is met, 0 to 1: it is, after it has contradicted the path.
    pub caution: f64,
    /// The rates that meet it exert no moment on the UAV in the mean: an impulse \[N m s\].
    pub moment: Task<N>,
}

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

impl PseudoInverse<MAX_COORDINATES> {
    /// Of the first `N` coordinates, where the others have been added by [`Problem::padded`].
    pub(super) fn of_the_first<const N: usize>(&self) -> PseudoInverse<N> {
        let Self { rate, min_singular_value, path_damped, task_damped } = *self;
        PseudoInverse { rate: rate.fixed_resize::<N, 1>(0.0), min_singular_value, path_damped, task_damped }
    }
}

/// The Gram matrix J J^T of a path: its entries, its determinant and its eigenvalues.
pub(super) struct Gram {
    xx: f64,
    xy: f64,
    yy: f64,
    determinant: f64,
    largest: f64,
    /// Square of the smallest singular value of J.
    pub smallest: f64,
}

impl Gram {
    pub fn new<const N: usize>(path: &SMatrix<f64, 2, N>, axes: PathAxes) -> Self {
        let (x, y) = (path.row(0), path.row(1));
        let xx = x.norm_squared();
        if axes == PathAxes::Horizontal {
            // As if something apart moved the end effector as easily along the axis that does not count.
            return Self { xx, xy: 0.0, yy: xx, determinant: xx * xx, largest: xx, smallest: xx };
        }
        let (xy, yy) = (x.dot(&y), y.norm_squared());
        // The determinant as a sum of squares (Cauchy-Binet) does not cancel.
        let mut determinant = 0.0;
        for i in 0..N {
            for j in 0..i {
                let part = cross(path.column(i).into(), path.column(j).into());
                determinant += part * part;
            }
        }
        let largest = 0.5 * (xx + yy) + (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
        let smallest = if largest > 0.0 { determinant / largest } else { 0.0 };
        Self { xx, xy, yy, determinant, largest, smallest }
    }

    /// The direction in which the arm moves most easily.
    fn strong(&self) -> Vec2 {
        let &Self { xx, xy, yy, largest, .. } = self;
        let strong = if xx > yy { Vec2::new(largest - yy, xy) } else { Vec2::new(xy, largest - xx) };
        strong.try_normalize(f64::MIN_POSITIVE).unwrap_or_else(Vec2::x)
    }
}

impl<const N: usize> Problem<N> {
    /// The smallest rates that follow the path and, if that is asked for, exert as little moment beside it as possible.
    ///
    /// `axes`: those along which the path counts; the row of the other one is zero. `reach`: length of the stretched
    /// arm \[m\].
    #[must_use]
    pub fn resolve(&self, axes: PathAxes, without_moment: bool, reach: f64) -> PseudoInverse<N> {
        self.resolve_to(axes, without_moment, &Thresholds::of(reach))
    }

    /// The same with other thresholds.
    #[inline]
    pub(super) fn resolve_to(&self, axes: PathAxes, without_moment: bool, thresholds: &Thresholds) -> PseudoInverse<N> {
        let gram = Gram::new(&self.path, axes);
        // Where nothing is damped, without directions and their square roots: a third of the time.
        if gram.smallest >= thresholds.path * thresholds.path
            && let Some(rate) = self.undamped(&gram, without_moment, thresholds.task)
        {
            let min_singular_value = gram.smallest.sqrt();
            return PseudoInverse { rate, min_singular_value, path_damped: false, task_damped: false };
        }
        self.padded().damped(&gram, without_moment, thresholds).of_the_first()
    }

    /// The same with more coordinates, which move nothing.
    pub(super) fn padded(&self) -> Problem<MAX_COORDINATES> {
        let Self { path, velocity, interval, caution, moment: Task { row, value } } = *self;
        let row = row.fixed_resize::<MAX_COORDINATES, 1>(0.0);
        let path = path.fixed_resize::<2, MAX_COORDINATES>(0.0);
        Problem { path, velocity, interval, caution, moment: Task { row, value } }
    }

    /// [`Problem::resolve`] far from singular configurations; none if that of the task is not far.
    #[inline]
    fn undamped(&self, gram: &Gram, without_moment: bool, threshold: f64) -> Option<SVector<f64, N>> {
        let &Gram { xx, xy, yy, determinant, .. } = gram;
        let Self { path, velocity, moment: task, .. } = self;
        let inverse = 1.0 / determinant;
        // J^T (J J^T)^-1 w.
        let lift = |w: Vec2| path.transpose() * (vec2(yy * w.x - xy * w.y, xx * w.y - xy * w.x) * inverse);
        let mut rate = lift(*velocity);
        if without_moment {
            if self.caution > 0.0 {
                return None;
            }
            let free = task.row - lift(path * task.row);
            let left = free.norm_squared();
            if left < threshold * threshold * task.row.norm_squared() || left < f64::MIN_POSITIVE {
                return None;
            }
            rate += free * ((task.value - task.row.dot(&rate)) / left);
        }
        Some(rate)
    }
}

impl Problem<MAX_COORDINATES> {
    /// Velocities per rate in the directions in which the arm moves easily and hardly \[m\].
    fn directions(&self, gram: &Gram) -> [SVector<f64, MAX_COORDINATES>; 2] {
        let strong = gram.strong();
        [strong, perp(strong)].map(|direction| self.path.transpose() * direction)
    }

    /// What of the rates, or of the row, `v` moves the end effector in no direction, however hardly the arm moves in it.
    pub(super) fn beside_path(
        &self,
        v: &SVector<f64, MAX_COORDINATES>,
        axes: PathAxes,
    ) -> SVector<f64, MAX_COORDINATES> {
        beside(v, &self.directions(&Gram::new(&self.path, axes)))
    }

    /// The share of the row of the second task that is left beside the path.
    pub(super) fn share_beside_path(&self, axes: PathAxes) -> f64 {
        self.beside_path(&self.moment.row, axes).norm() / self.moment.row.norm().max(f64::MIN_POSITIVE)
    }

    /// [`Problem::resolve`] wherever the arm is.
    #[cold]
    fn damped(&self, gram: &Gram, without_moment: bool, thresholds: &Thresholds) -> PseudoInverse<MAX_COORDINATES> {
        let Self { velocity, interval, caution, moment: task, .. } = self;
        // The directions in which the arm moves easily and hardly: each is damped on its own.
        let strong = gram.strong();
        let weak = perp(strong);
        let sizes = [gram.largest.sqrt(), gram.smallest.sqrt()];
        let directions = self.directions(gram);
        let mut rate = SVector::zeros();
        for ((direction, row), size) in [strong, weak].iter().zip(&directions).zip(sizes) {
            let wanted = direction.dot(velocity);
            let damping = thresholds.damping(size, wanted * interval);
            rate += row * (wanted / (size * size + damping).max(f64::MIN_POSITIVE));
        }
        let min_singular_value = sizes[1];
        let nearness = (min_singular_value / thresholds.path).min(1.0);
        let mut task_damped = false;
        if without_moment {
            let free = beside(&task.row, &directions);
            let size = task.row.norm();
            let share = free.norm() / size.max(f64::MIN_POSITIVE);
            let missing = (task.value - task.row.dot(&rate)) * nearness * nearness;
            // Where path and task contradict each other, what is left of the row beside the path changes its sign with the
            // configuration. With less damping than this, one interval would lead across, and the next one back.
            let turning = caution * interval * missing.abs() / size.max(f64::MIN_POSITIVE);
            let damping = damping(share, (thresholds.task * thresholds.task + turning).sqrt()) * size * size;
            task_damped = damping > 0.0 || nearness < 1.0;
            rate += free * (missing / (free.norm_squared() + damping).max(f64::MIN_POSITIVE));
        }
        PseudoInverse { rate, min_singular_value, path_damped: nearness < 1.0, task_damped }
    }
}

/// What of `v` is orthogonal to both rows, of which the first one is the larger one.
fn beside(
    v: &SVector<f64, MAX_COORDINATES>,
    [easily, hardly]: &[SVector<f64, MAX_COORDINATES>; 2],
) -> SVector<f64, MAX_COORDINATES> {
    let Some(first) = easily.try_normalize(f64::MIN_POSITIVE) else { return *v };
    let free = v - first * first.dot(v);
    let hardly = hardly - first * first.dot(hardly);
    // In a singular configuration, what is left there is rounding.
    match hardly.try_normalize(ROUNDING * easily.norm()) {
        Some(second) => free - second * second.dot(&free),
        None => free,
    }
}

/// Below which singular values and shares rates are damped.
#[derive(Debug, Clone, Copy)]
pub(super) struct Thresholds {
    /// Singular value of the path \[m\].
    pub path: f64,
    /// Share of the row of the second task that is left beside the path.
    pub task: f64,
    /// Length of the stretched arm \[m\].
    pub reach: f64,
}

impl Thresholds {
    /// For an arm that is stretched as long as `reach` \[m\].
    pub fn of(reach: f64) -> Self {
        Self { path: PATH_THRESHOLD * reach, task: TASK_THRESHOLD, reach }
    }

    /// Square of the damping factor in a direction with this singular value, in which the end effector is to move by
    /// `way` in the interval \[m\].
    ///
    /// A reference beyond reach asks for the same way again in each interval. A stretched arm answers to
    /// it in proportion to the angle by which it is bent, and that angle changes by its rate times the interval: with less
    /// damping than way times reach it would swing to the other side.
    fn damping(&self, singular_value: f64, way: f64) -> f64 {
        let share = (singular_value / self.path).min(1.0);
        (self.path * self.path + way.abs() * self.reach) * (1.0 - share) * (1.0 - share)
    }
}

/// Square of the damping factor: grows smoothly from 0 at the threshold to its square at a singularity.
fn damping(singular_value: f64, threshold: f64) -> f64 {
    let share = singular_value / threshold;
    if share < 1.0 { threshold * threshold * (1.0 - share) * (1.0 - share) } else { 0.0 }
}
