//! Plans that hold at the end of the interval, not only to first order.
//!
//! The coming interval is integrated under the rates in question; the end effector is then on the
//! reference at its end, and the mean moment on the UAV is zero if that is asked for. Each iteration
//! solves the whole resolution linearised at the present rates, not a correction to them: corrections of
//! minimum norm would let motion in the null space grow without bound. The first rates in question go on as
//! those of the plans before, so closely that mostly the first linearisation leaves nothing.

use nalgebra::SVector;

use super::Status;
use super::clock::Clock;
use super::plan::{ON_PATH, Plan};
use super::plan_context::PlanContext;
use super::prediction::Prediction;
use super::resolution::{Aims, Problem, Resolved, Task};
use crate::error::Result;
use crate::mechanics::dynamics::{Account, Loads, Motion, Situation};
use crate::mechanics::planar::Vec2;
use crate::parameters::Hold;
use crate::reference::Target;

/// Iterations of a plan at most; one does normally, two after a kink of the path, more where a stiff autopilot answers
/// within the interval.
const ITERATIONS: usize = 8;

/// End effector this close to the reference at the end of the interval is on it \[m\].
const ON_REFERENCE: f64 = 1e-12;

/// Moment impulses on the UAV below this are none \[N m s\].
const NO_IMPULSE: f64 = 1e-12;

/// What a plan has left over, for instance beyond reach, is made good at this speed at most \[m/s\].
const CATCHING_UP: f64 = 0.2;

/// What an external reference moves beyond what was foreseen is followed at this speed at most \[m/s\].
const UNFORESEEN: f64 = 2.0;

/// A target that one interval brings nearer than this counts as met, and the status does not say that it catches up: the
/// iteration ends with a distance of some 1e-12 m, and a nanometre is no matter to anybody \[m\].
const SHORTENED: f64 = 1e-9;

/// Plans of which a polynomial leaves at most this share of the change from the one before unforeseen follow a smooth path.
const SMOOTH: f64 = 0.1;

/// What one interval is to reach.
#[derive(Debug, Clone, Copy)]
struct Goal<'a> {
    /// When it begins, from the start \[s\].
    t: f64,
    clock: &'a Clock,
    /// Where and how fast the end effector is to be at its end.
    target: Target,
    aims: Aims,
}

impl<const N: usize> PlanContext<N> {
    /// A plan for the interval of the `clock` from time `t` that brings the end effector onto the `target`, or as near
    /// to it as it may come in one interval; the wanted place is `now` now, and was foreseen to be `expected` \[m\]. Writes
    /// the prediction at its `end`.
    ///
    /// # Errors
    /// If the interval cannot be integrated.
    pub fn plan_towards(
        &self,
        t: f64,
        clock: &Clock,
        expected: Vec2,
        now: Vec2,
        target: &Target,
        end: &mut Prediction<N>,
    ) -> Result<Plan<N>> {
        let (here, horizon) = (self.now.end_effector(), clock.horizon);
        let followed = |displacement: Vec2| self.resolver.followed(displacement);
        let behind = followed(expected - here);
        let left_over = shortened_to(behind, self.catching_up_speed(behind, horizon) * horizon);
        let unforeseen = shortened_to(followed(now - expected), UNFORESEEN * horizon);
        let nearer = Target {
            displacement: here + left_over + unforeseen + (target.displacement - now),
            velocity: target.velocity + (left_over + unforeseen) / horizon,
            ..*target
        };
        let mut plan = self.plan_path_first(Goal { t, clock, target: nearer, aims: Aims::All }, end)?;
        let missing = followed(target.displacement - end.end_effector());
        plan.velocity_residual = missing.norm() / horizon;
        let shortened = followed(now - here) - (left_over + unforeseen);
        // Rates that do not jump bring it onto the path by and by.
        let off = if self.resolver.accelerates() { ON_PATH } else { SHORTENED };
        let apart = shortened != Vec2::zeros() || self.resolver.accelerates();
        if plan.status.keeps_path() && apart && missing.norm() > off {
            plan.status = Status::CatchingUp;
        }
        Ok(plan)
    }

    /// How fast what is left over of the path, the way `behind` \[m\], is made good \[m/s\]. Where accelerations are
    /// limited, so slowly that the joints can brake in time: with 30 % of what the slowest joint is able to, for the rest of
    /// the motion needs acceleration, too.
    fn catching_up_speed(&self, behind: Vec2, horizon: f64) -> f64 {
        let distance = behind.norm();
        if !self.resolver.limits_accelerations() || distance <= SHORTENED {
            return CATCHING_UP;
        }
        let Situation { node, rotation, state } = &self.now.situation;
        let response = self.response(node, *rotation, state);
        let along = Problem {
            path: response.jacobian,
            velocity: rotation.undo(behind / distance),
            interval: horizon,
            caution: 0.0,
            moment: Task { row: response.carried, value: 0.0 },
        };
        let braking = 0.3 * self.resolver.acceleration_along(&along);
        let change = 0.5 * braking * horizon;
        CATCHING_UP.min((change * change + 2.0 * braking * distance).sqrt() - change)
    }

    /// A plan for the `goal`. Where its iteration leaves the path, that may be for the sake of the second task: it is made
    /// once more without it. Writes the prediction at its `end`.
    fn plan_path_first(&self, goal: Goal<'_>, end: &mut Prediction<N>) -> Result<Plan<N>> {
        let plan = self.plan_exact(goal, end)?;
        let left = self.missing(&goal.target, goal.clock.horizon, &end.situation);
        if left.norm_squared() <= ON_PATH * ON_PATH || !self.resolver.has_second_task() {
            return Ok(plan);
        }
        self.plan_path_alone(goal, end, (plan, left.norm()))
    }

    /// The better one of the plan without second task and of another one, which leaves the end effector as far off the
    /// path as is said with it \[m\].
    #[cold]
    fn plan_path_alone(
        &self,
        goal: Goal<'_>,
        end: &mut Prediction<N>,
        (with_task, left): (Plan<N>, f64),
    ) -> Result<Plan<N>> {
        let mut other = *end;
        let mut plan = self.plan_exact(Goal { aims: Aims::Path, ..goal }, &mut other)?;
        let left_alone = self.missing(&goal.target, goal.clock.horizon, &other.situation).norm();
        if left_alone >= 0.5 * left {
            return Ok(with_task);
        }
        *end = other;
        if plan.status == Status::Ok {
            plan.status = Status::TaskLimited;
        }
        Ok(plan)
    }

    /// The motion in the interval of the `goal` at whose end the end effector is on the target, as
    /// near as the iteration gets: at its place, with a hold of first order with its velocity, too, and if
    /// accelerations are chosen with its velocity alone. Writes the prediction at its `end`.
    ///
    /// # Errors
    /// If the interval cannot be integrated.
    fn plan_exact(&self, Goal { t, clock, target, aims }: Goal<'_>, end: &mut Prediction<N>) -> Result<Plan<N>> {
        let horizon = clock.horizon;
        let accelerates = self.resolver.accelerates();
        let cancels = aims == Aims::All && self.resolver.cancels_moment();
        let mut plan = Plan { places: self.method_state.places, ..Plan::moving(self.extrapolated_motion(horizon)) };
        // The impulse that the rates in question should exert on the UAV, as far as all is linear.
        let mut linear = 0.0;
        let mut nearest: Option<(f64, Plan<N>)> = None;
        for iteration in 0..=ITERATIONS {
            let impulse = self.carry_out(&mut plan, t, horizon, end)?;
            let missing = self.missing(&target, horizon, &end.situation);
            let miss = missing.norm();
            let moment_free = !cancels || (plan.moment_residual * horizon - linear).abs() <= NO_IMPULSE;
            if iteration > 0 {
                if (miss <= ON_REFERENCE && moment_free) || (iteration == ITERATIONS && miss <= ON_PATH) {
                    return Ok(plan);
                }
                if plan.status.keeps_path() && nearest.as_ref().is_none_or(|(least, _)| miss < *least) {
                    nearest = Some((miss, plan));
                }
            }
            if iteration == ITERATIONS {
                break;
            }

            let Situation { node, rotation, state } = &end.situation;
            let response = self.response(node, *rotation, state);
            let carried = self.now.carried + impulse;
            let moment = self.moment_task(&response, carried);
            let mean = Problem {
                path: response.jacobian,
                velocity: response.jacobian * plan.motion.rate_after(0.5 * horizon) + rotation.undo(missing / horizon),
                interval: horizon,
                caution: self.damping.caution(),
                moment,
            };
            let at_end = || self.at_end(&response, *rotation, target.velocity, moment, horizon);
            let solve = |asked: &Problem<N>| self.solve(asked, clock, Some(&plan.places), aims);
            let (resolved, motion) = if accelerates {
                let resolved = solve(&at_end());
                (resolved, self.accelerating_to(&resolved.rate, clock))
            } else if self.hold == Hold::FirstOrder
                && let resolved = solve(&at_end())
                && let Some(ramp) = self.ramp(&mean, &resolved, clock)
            {
                (resolved, ramp)
            } else {
                let resolved = solve(&mean);
                (resolved, Motion::constant(resolved.rate))
            };
            let change = motion - plan.motion;
            plan = Plan::of(&resolved, motion);
            linear = carried - response.carried_momentum(&resolved.rate);
            if extent(&change, horizon) * self.resolver.reach <= ON_REFERENCE {
                // So little is linear. Where the path is given up in part, it also says when nothing changes any more.
                self.dynamics.displace(&mut end.situation, &change.way(horizon), &motion.rate_after(horizon));
                self.write_moment(&mut plan, impulse, horizon, end);
                return Ok(plan);
            }
        }
        if let Some((_, nearest)) = nearest
            && plan.status.keeps_path()
        {
            plan = nearest;
            self.carry_out(&mut plan, t, horizon, end)?;
        }
        Ok(plan)
    }

    /// The first motion in question for an interval of length `horizon`. It goes on changing as it did, along a polynomial
    /// of order 4: so close that the interval need not be integrated again where the path is smooth.
    ///
    /// Where such a polynomial would not have foreseen the last plan, for the wanted motion jumps or intervals differ in
    /// length, it would be so far off that the iteration might not end: there the last motion goes on.
    fn extrapolated_motion(&self, horizon: f64) -> Motion<N> {
        let change = self.combined([1.0, -1.0, 0.0, 0.0, 0.0]);
        let unforeseen = self.combined([1.0, -4.0, 6.0, -4.0, 1.0]);
        if extent(&unforeseen, horizon) < SMOOTH * extent(&change, horizon) {
            self.combined([5.0, -10.0, 10.0, -5.0, 1.0])
        } else {
            self.motion
        }
    }

    /// The sum of the earlier motions with these weights, the last one first.
    fn combined(&self, weights: [f64; 5]) -> Motion<N> {
        let mut sum = Motion::constant(SVector::zeros());
        for (motion, weight) in self.earlier_motions.iter().zip(weights) {
            sum.rate += motion.rate * weight;
            sum.slope += motion.slope * weight;
        }
        sum
    }

    /// How far the end effector is from the `target` at the `end` of the interval of length `horizon`, or will be at
    /// the end of the next one if its velocity counts \[m\].
    fn missing(&self, target: &Target, horizon: f64, end: &Situation<N>) -> Vec2 {
        if self.resolver.accelerates() {
            self.resolver.followed(target.velocity - self.end_effector_velocity(end, end.base())) * horizon
        } else {
            target.displacement - end.place(end.node.posture.end_effector)
        }
    }

    /// Integrates the interval of length `horizon` from time `t` in the motion of the `plan`: where it ends, and the
    /// moment on the UAV. The result is the impulse of all other moments on what the UAV carries \[N m s\].
    ///
    /// # Errors
    /// If it cannot be integrated.
    pub fn carry_out(&self, plan: &mut Plan<N>, t: f64, horizon: f64, end: &mut Prediction<N>) -> Result<f64> {
        let Prediction { situation, integration, .. } = end;
        *situation = self.now.situation;
        integration.sum = 0.0;
        self.dynamics.advance(situation, &plan.motion, &Loads::CALM, t, horizon, Account::Carried(integration))?;
        let impulse = integration.sum;
        self.write_moment(plan, impulse, horizon, end);
        Ok(impulse)
    }

    /// Makes the angular momentum at the `end` follow from its situation, and the moment on the UAV that is left in the
    /// `plan` from that and from the `impulse` of all other moments on what the UAV carries \[N m s\].
    fn write_moment(&self, plan: &mut Plan<N>, impulse: f64, horizon: f64, end: &mut Prediction<N>) {
        end.end_step(&self.dynamics);
        plan.moment_residual = (self.now.carried + impulse - end.carried) / horizon;
    }

    /// The motion that ends at the rates `last` and follows the path of `problem` in the mean; none where the path has to
    /// give way, or where it would begin at rates beyond the limits.
    ///
    /// Where it has a choice it begins at the rates with which the interval before ended; in the direction of
    /// the path it cannot, for a ramp from given rates to a given place would ring for ever.
    fn ramp(&self, problem: &Problem<N>, last: &Resolved<N>, clock: &Clock) -> Option<Motion<N>> {
        let smooth = (self.motion.rate + last.rate) * 0.5;
        let mean = self.resolver.nearest(problem, &smooth);
        let first = mean.rate * 2.0 - last.rate;
        let ramp = Motion { rate: first, slope: (last.rate - first) / clock.horizon };
        // The host may go on with it for longer than it was made for.
        let farthest = ramp.rate_after(clock.longest_hold());
        let within = self.resolver.admits(&first) && self.resolver.admits(&farthest);
        (last.status.keeps_path() && !mean.path_damped && within).then_some(ramp)
    }
}

/// How much the `change` of a motion changes in an interval of length `horizon`: its way, and the last rates times the
/// interval \[rad, m\].
fn extent<const N: usize>(change: &Motion<N>, horizon: f64) -> f64 {
    change.way(horizon).norm() + change.rate_after(horizon).norm() * horizon
}

/// This `displacement`, shortened to `most` \[m\] where it is longer. Mostly it is not, and then it takes neither root nor
/// division. Nor is there ever a division by 0: raising its flag takes a processor 100 ns if the host has not raised it.
fn shortened_to(displacement: Vec2, most: f64) -> Vec2 {
    displacement * if displacement.norm_squared() <= most * most { 1.0 } else { most / displacement.norm() }
}
