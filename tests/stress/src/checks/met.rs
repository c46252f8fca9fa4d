//! A path within a generous reach of the arm is met: where nothing was in its way during the whole run (no limit, no
//! dependent rows), the end effector is within 1e-6 m of it at the end of the last plan, 1e-4 m on a clock that is not
//! even; and wherever it was before, it ends within 1e-6 m of a reference that has come to rest, unless narrow limits are
//! in its way.

use uam::control::PATH_THRESHOLD;
use uam::mechanics::planar::{Rotation, Vec2};
use uam::parameters::PathAxes;

use super::{Check, Now};
use crate::case::Case;
use crate::draw::clock::Clock;
use crate::draw::path::External;

/// Nearest and farthest from the first joint, as shares of the stretched arm.
const REACH: [f64; 2] = [0.2, 0.85];

/// How much larger than its threshold the smallest singular value is.
const REGULAR: f64 = 1.5;

/// Rolls by less \[rad\].
const UPRIGHT: f64 = 0.5;

/// How long nothing is in the way at the end, if the reference rests \[s\].
const LATE: f64 = 3.0;

pub struct Met<'a> {
    case: &'a Case,
    near: [f64; 2],
    singular: f64,
    duration: f64,
    /// Whether nothing was in the way so far.
    free: bool,
    /// How far it is from the reference now, and may be \[m\].
    off: [f64; 2],
    looked: bool,
}

impl<'a> Met<'a> {
    /// Unless the path asks for more than one joint can do, or leaves an axis open, or jumps without coming to rest.
    pub fn of(case: &'a Case) -> Option<Self> {
        let jumps = case.path.external.as_ref().is_some_and(External::jumps);
        if case.structure.links < 2
            || case.parameters.ik.path_axes != PathAxes::Both
            || (jumps && case.path.at_rest.is_infinite())
        {
            return None;
        }
        let (reach, mount) = (case.reach(), &case.parameters.mount);
        let links = &case.parameters.links[..case.structure.links];
        let longest = links.iter().map(|link| link.length).fold(0.0, f64::max);
        let near = [(REACH[0] * reach).max(2.0 * longest - (1.0 - 0.1) * reach), REACH[1] * reach];
        let singular = REGULAR * PATH_THRESHOLD * (reach + Vec2::new(mount.x, mount.y).norm());
        let duration = case.steps.steps.iter().map(|(_, size)| size).sum();
        Some(Self { case, near, singular, duration, free: true, off: [0.0; 2], looked: false })
    }

    /// Whether nothing is in the way here.
    fn is_free(&self, now: &Now<'_>) -> bool {
        let [x, y, roll] = now.seen.pose();
        let mount = &self.case.parameters.mount;
        let joint = Vec2::new(x, y) + Rotation::by(roll).apply(Vec2::new(mount.x, mount.y));
        let [x, y] = now.seen.reference();
        let distance = (Vec2::new(x, y) - joint).norm();
        let reachable = (self.near[0]..=self.near[1]).contains(&distance) && roll.abs() < UPRIGHT;
        let limited = ["rate_limited", "path_limited"].contains(&now.seen.status());
        if self.case.path.at_rest.is_finite() {
            // A joint at its stop may be in the way for ever.
            let stopped = now.seen.status() == "path_limited";
            return reachable && !stopped && !(limited && self.case.limits.are_narrow());
        }
        reachable && !limited && now.seen.singular_value() > self.singular
    }
}

impl Check for Met<'_> {
    fn name(&self) -> &'static str {
        "path met"
    }

    fn see(&mut self, now: &Now<'_>) -> Result<(), String> {
        let rests = self.case.path.at_rest.is_finite();
        if rests && now.time < self.duration - LATE {
            return Ok(());
        }
        // An interval that is too long for its motion says so.
        let inexact = !rests && now.seen.status() == "inexact";
        self.free &= !inexact && self.is_free(now);
        let steps = &self.case.steps;
        // Between plans the end effector is near the path.
        if !now.count.is_multiple_of(steps.per_plan.unwrap_or(1)) {
            return Ok(());
        }
        let [x, y] = now.seen.miss();
        let exact = steps.clock == Clock::Even || (rests && steps.per_plan.is_some());
        let uneven = if exact { 0.0 } else { 1e-4 };
        self.off = [(x * x + y * y).sqrt(), 1e-6 + uneven + now.unforeseen];
        Ok(())
    }

    fn end(&mut self) -> Result<(), String> {
        self.looked = self.free;
        let [off, near] = self.off;
        if self.free && off > near {
            return Err(format!("ends {off:.2e} m from the reference"));
        }
        Ok(())
    }

    fn looked(&self) -> bool {
        self.looked
    }
}
