//! From what is asked of an interval to rates: the one place where the method is chosen.
//!
//! Whatever the discretization, it hands over the same linear [`Problem`]; each method stands in a file of its
//! own and answers with [`Resolved`].

mod counterweight;
mod gradient;
mod least_squares;
mod pseudo_inverse;
mod singular_start;
mod state;
mod weights;

use nalgebra::SVector;

pub(super) use state::MethodState;

pub use pseudo_inverse::{PATH_THRESHOLD, Problem, PseudoInverse, Task};

use weights::Weights;

use super::Status;
use super::limits::{Allowed, Limits};
use super::method::Traits;
use crate::control::qp::{self, MAX_VARIABLES, Outcome, Places, Rows};
use crate::mechanics::dynamics::Situation;
use crate::mechanics::planar::{Vec2, vec2};
use crate::mechanics::vehicle::Vehicle;
use crate::parameters::{MAX_COORDINATES, Parameters, PathAxes, Resolution, Structure};

/// The interval whose rates are chosen.
#[derive(Debug, Clone, Copy)]
pub(super) struct Interval<'a, const N: usize> {
    /// Where it begins.
    pub beginning: &'a Situation<N>,
    /// The rates of the interval before this one \[rad/s, m/s\].
    pub previous_rate: &'a SVector<f64, N>,
    /// How long those were held \[s\]: what the limits of acceleration allow grows with it.
    pub previous_duration: f64,
    /// How long the rates may be held \[s\]: that they must not lead past a stop in this time.
    pub hold: f64,
    /// What the method remembers of the previous plan.
    pub state: &'a MethodState,
    /// Which rates will probably be at their limits, if an iteration of this plan has told; else the previous plan tells.
    pub guess: Option<&'a Places>,
    /// What counts.
    pub aims: Aims,
}

/// What counts for the rates of an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Aims {
    /// The path, and the second task of the method.
    All,
    /// The path alone.
    Path,
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
    /// The angular momentum that they give to what the UAV carries \[N m s\].
    pub momentum: f64,
    /// Which of them are at their limits: a guess for the next problem.
    pub places: Places,
}

/// The chosen method with its settings.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resolver {
    kind: Resolution,
    traits: Traits,
    axes: PathAxes,
    links: usize,
    /// Whether there is something that balances the arm, and the method does not move it.
    pub holds_balancer: bool,
    /// Length of the stretched arm \[m\].
    pub reach: f64,
    weights: Weights,
    gradient_gain: f64,
    rate_penalty: f64,
    /// Time constant of the counterweight \[s\].
    balancing_time: f64,
    limits: [Limits; MAX_COORDINATES],
}

impl Resolver {
    /// The method in `parameters` for an arm that is stretched as long as `reach` \[m\].
    ///
    /// What balances the arm holds still with other methods than [`Balance::moved_by`]. Minimum norm would displace it
    /// without regard to the moment of its weight; and since a counterweight sits above the UAV's centre of mass, its
    /// acceleration turns the UAV the wrong way before its weight turns it the right way (thesis 3.8), so that rates
    /// which cancel the moment at every instant would grow without bound.
    ///
    /// [`Balance::moved_by`]: crate::parameters::Balance::moved_by
    pub fn new(structure: Structure, parameters: &Parameters, reach: f64) -> Self {
        let kind = parameters.ik.resolution;
        let mut resolver = Self {
            kind,
            traits: kind.traits(),
            axes: parameters.ik.path_axes,
            links: structure.links,
            holds_balancer: structure.balance.moved_by().is_some_and(|mover| mover != kind),
            reach,
            weights: Weights::EQUAL,
            gradient_gain: 0.0,
            rate_penalty: 0.0,
            balancing_time: 0.0,
            limits: [Limits::from(&parameters.counterweight); MAX_COORDINATES],
        };
        resolver.tune(parameters);
        resolver
    }

    /// Takes over what may change during a run.
    pub fn tune(&mut self, parameters: &Parameters) {
        let joints = &parameters.joints[..self.links];
        self.weights.tune(joints);
        self.limits.iter_mut().zip(joints).for_each(|(limits, joint)| *limits = joint.into());
        self.gradient_gain = parameters.ik.gradient_gain;
        if self.kind == Resolution::LeastSquares {
            self.rate_penalty = parameters.ik.rate_penalty;
            self.balancing_time = parameters.counterweight.time_constant;
            self.limits[self.links] = (&parameters.counterweight).into();
        }
    }

    /// Whether the method asks for rates without moment on the UAV.
    pub fn cancels_moment(&self) -> bool {
        self.traits.cancels_moment
    }

    /// Whether something beside the path decides about the rates of a redundant arm.
    pub fn has_second_task(&self) -> bool {
        self.traits.has_second_task
    }

    /// Whether the method knows limits of accelerations and positions.
    pub fn limits_accelerations(&self) -> bool {
        self.traits.limits_accelerations
    }

    /// Whether rates do not jump: accelerations are chosen.
    pub fn accelerates(&self) -> bool {
        self.traits.accelerates
    }

    /// The part of the vector `v` of the inertial frame that belongs to the path.
    pub fn followed(&self, v: Vec2) -> Vec2 {
        match self.axes {
            PathAxes::Both => v,
            PathAxes::Horizontal => vec2(v.x, 0.0),
        }
    }

    /// The rates that the method chooses.
    pub fn solve<const N: usize>(
        &self,
        vehicle: &Vehicle<N>,
        interval: &Interval<'_, N>,
        problem: &Problem<N>,
    ) -> Resolved<N> {
        let mut found = match self.kind {
            Resolution::LeastSquares => return self.least_squares(vehicle, interval, problem),
            Resolution::Gradient if interval.aims == Aims::All => {
                let preferred = gradient::preferred(vehicle, interval.beginning, self.gradient_gain);
                let found = self.nearest(problem, &preferred);
                if found.path_damped { self.near_singular(problem, &preferred) } else { found }
            }
            // The smallest rates: right pseudo-inverse of the generalized Jacobian (thesis 1.8), or one more row below it
            // (thesis 3.2, 3.3 and 3.6).
            _ => self.along_path(problem, interval.aims == Aims::All && self.cancels_moment()),
        };
        self.set_going(vehicle, interval.beginning, problem, &mut found);
        self.limited(problem, &found)
    }

    /// The smallest rates that follow the path and, if that is asked for, exert no moment beside it.
    #[inline]
    fn along_path<const N: usize>(&self, problem: &Problem<N>, without_moment: bool) -> PseudoInverse<N> {
        self.weights.resolve(problem, self.axes, without_moment, self.reach)
    }

    /// The rates nearest to `preferred` ones that follow the path.
    pub fn nearest<const N: usize>(&self, problem: &Problem<N>, preferred: &SVector<f64, N>) -> PseudoInverse<N> {
        let velocity = problem.velocity - problem.path * preferred;
        let added = self.along_path(&Problem { velocity, ..*problem }, false);
        PseudoInverse { rate: preferred + added.rate, ..added }
    }

    /// Near a singular configuration, where the path is damped: the smallest rates along it, and of the `preferred` ones
    /// what moves the end effector in no direction, the less the nearer.
    #[cold]
    fn near_singular<const N: usize>(&self, problem: &Problem<N>, preferred: &SVector<f64, N>) -> PseudoInverse<N> {
        let found = self.along_path(problem, false);
        let nearness = found.min_singular_value / (PATH_THRESHOLD * self.reach);
        let beside = problem.padded().beside_path(&preferred.fixed_resize::<MAX_COORDINATES, 1>(0.0), self.axes);
        PseudoInverse { rate: found.rate + beside.fixed_resize::<N, 1>(0.0) * (nearness * nearness), ..found }
    }

    /// What the limits allow. What balances the arm goes by a law of its own; its rate is fixed.
    fn allowed<const N: usize>(&self, vehicle: &Vehicle<N>, interval: &Interval<'_, N>) -> Allowed {
        let &Interval { beginning, previous_rate, previous_duration, hold, .. } = interval;
        let (position, previous_rate) = (beginning.state.position.as_slice(), previous_rate.as_slice());
        let mut allowed = Allowed::new(&self.limits[..self.links], position, previous_rate, [previous_duration, hold]);
        if let Some(target) = counterweight::balance(vehicle, beginning) {
            let i = N - 1;
            allowed.fix(
                i,
                self.limits[i].approach(
                    target,
                    position[i],
                    previous_rate[i],
                    [previous_duration, hold],
                    self.balancing_time,
                ),
            );
        }
        allowed
    }

    /// Whether a coordinate at `position` that moves at `rate` could pass its stop if that were held for `hold` \[s\] and
    /// braking began then.
    pub fn must_brake(&self, position: &[f64], rate: &[f64], hold: f64) -> bool {
        let coordinates = || self.limits.iter().zip(position.iter().zip(rate));
        self.limits_accelerations()
            && coordinates().any(|(limits, (position, rate))| !limits.can_hold(*position, *rate, hold))
    }

    /// Acceleration of the end effector per velocity that the `problem` asks for: what the joint with the smallest
    /// share of its limit can do \[m/s2\].
    pub fn acceleration_along<const N: usize>(&self, problem: &Problem<N>) -> f64 {
        let rate = self.along_path(problem, true).rate;
        let able = rate.iter().zip(&self.limits[..self.links]).map(|(rate, limits)| limits.acceleration / rate.abs());
        able.fold(f64::MAX, f64::min)
    }

    /// Whether none of the rates exceeds its limit.
    pub fn admits<const N: usize>(&self, rate: &SVector<f64, N>) -> bool {
        self.excess(rate) <= 1.0
    }

    /// Rates each of which is at its limit where it would exceed it.
    pub fn clamped<const N: usize>(&self, mut rate: SVector<f64, N>) -> SVector<f64, N> {
        for (rate, limits) in rate.iter_mut().zip(&self.limits).take(self.links) {
            *rate = rate.clamp(-limits.rate, limits.rate);
        }
        rate
    }

    /// Rates scaled down so that none exceeds its limit.
    pub fn within_limits<const N: usize>(&self, rate: SVector<f64, N>) -> SVector<f64, N> {
        rate / self.excess(&rate)
    }

    /// The largest share of its limit that a rate has, if one exceeds it; 1 if none does.
    #[inline]
    fn excess<const N: usize>(&self, rate: &SVector<f64, N>) -> f64 {
        let limited = || rate.iter().zip(&self.limits).take(self.links);
        if limited().all(|(rate, limits)| rate.abs() <= limits.rate) {
            return 1.0;
        }
        limited().map(|(rate, limits)| rate.abs() / limits.rate).fold(1.0, f64::max)
    }

    /// Rates none of which exceeds its limit, with how they came about.
    fn limited<const N: usize>(&self, problem: &Problem<N>, found: &PseudoInverse<N>) -> Resolved<N> {
        let mut resolved = Resolved {
            rate: found.rate,
            status: found.status(),
            min_singular_value: found.min_singular_value,
            momentum: 0.0,
            places: qp::FREE,
        };
        if !self.admits(&found.rate) {
            (resolved.rate, resolved.status) = self.path_within_limits(problem, found);
        }
        resolved.momentum = problem.moment.row.dot(&resolved.rate);
        resolved
    }

    /// Rates within the limits where the `found` ones are not: of those that move the end effector alike the nearest ones,
    /// and if there are none, those that move it most nearly alike.
    #[cold]
    fn path_within_limits<const N: usize>(
        &self,
        problem: &Problem<N>,
        found: &PseudoInverse<N>,
    ) -> (SVector<f64, N>, Status) {
        // The unknowns are the differences from the rates found.
        let mut program = qp::Problem::new(self.links, 1.0);
        let row = |axis: usize| {
            let mut row = [0.0; MAX_VARIABLES];
            row.iter_mut().zip(&problem.path.row(axis)).take(self.links).for_each(|(place, path)| *place = *path);
            (row, 0.0)
        };
        program.equalities = Rows::of([row(0), row(1)]);
        for (i, limits) in self.limits[..self.links].iter().enumerate() {
            (program.lower[i], program.upper[i]) = (-limits.rate - found.rate[i], limits.rate - found.rate[i]);
        }
        let nearest = qp::solve(&program, &qp::FREE);
        let mut rate = found.rate;
        for (i, limits) in self.limits[..self.links].iter().enumerate() {
            rate[i] = (rate[i] + nearest.x[i]).clamp(-limits.rate, limits.rate);
        }
        let status = match (nearest.outcome, found.path_damped) {
            (Outcome::Solved, true) => Status::PathDamped,
            (Outcome::Solved, false) => Status::TaskLimited,
            _ => Status::RateLimited,
        };
        (rate, status)
    }
}
