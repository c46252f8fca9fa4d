//! When a plan is due and for how long it is made, from the steps that the host has made so far.
//!
//! Steps are never exactly even: hosts add up times, count them in single precision or from 1970, or choose their steps
//! by an error estimate. A plan is therefore due when the next step would probably end later than a sample time after
//! the last plan; nothing follows from the equality of two steps.

use crate::bytes::{Memory, Tape};
use crate::error::{Error, Result};
use crate::pass;

/// A plan is on time until this share of a sample time later: jitter of a percent does not make a plan early by a step.
const ON_TIME: f64 = 0.01;

/// Steps that sum up to less than this share of a sample time are none: some hosts end with one of 1e-13 s.
const NO_STEP: f64 = 1e-6;

/// By this share of the time that has passed, long steps and intervals are forgotten. A plan for an interval much
/// shorter than the one that comes would correct more than there is, and diverge; a longer one lags a little. Where long and
/// short steps are mixed, intervals planned for different times would shake the UAV.
const FORGETTING: f64 = 0.1;

/// The host's steps as far as they tell when to plan. All times in seconds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Clock {
    sample_time: f64,
    /// Time since the last plan: the sum of the steps.
    pub since_plan: f64,
    /// Length of the interval for which the last plan was made.
    pub horizon: f64,
    /// How long the last plan was really held.
    pub previous_duration: f64,
    /// The next step is hardly longer than this.
    expected: f64,
    /// The longest step so far.
    longest: f64,
}

impl Clock {
    /// Before the first step: a sample time is all that is known.
    pub fn new(sample_time: f64) -> Self {
        Self {
            sample_time,
            since_plan: 0.0,
            horizon: sample_time,
            previous_duration: sample_time,
            expected: 0.0,
            longest: 0.0,
        }
    }

    /// The host has made a step of this `size`.
    pub fn advance(&mut self, size: f64) {
        self.since_plan += size;
        self.expected = self.expected.max(size);
        self.longest = self.longest.max(size);
    }

    /// Whether the next step would end too late for a plan, if it is as long as expected.
    pub fn is_due(&self) -> bool {
        self.since_plan > NO_STEP * self.sample_time && self.since_plan + self.expected > self.latest()
    }

    /// A plan is made after a step of this `size`: chooses the interval for which it is made.
    pub fn begin_interval(&mut self, size: f64) {
        self.previous_duration = self.since_plan;
        self.since_plan = 0.0;
        // As many steps of this size as will pass until the next plan.
        let room = self.latest() - self.expected;
        let fitting = if room < size { size } else { size * ((room / size).floor() + 1.0) };
        let forgotten = FORGETTING * self.previous_duration;
        self.horizon = fitting.max(self.previous_duration).max(self.horizon - forgotten);
        self.expected = size.max(self.expected - forgotten);
    }

    /// The longest that a plan is held, if no step is longer than the sample time or the longest so far: within it,
    /// limits must hold. It is never forgotten, for the host may make such a step again.
    pub fn longest_hold(&self) -> f64 {
        self.longest.max((1.0 + ON_TIME) * self.sample_time)
    }

    /// After this time without a plan it is late. Where many steps make a sample time, the tolerance is less than one.
    fn latest(&self) -> f64 {
        self.sample_time + (ON_TIME * self.sample_time).min(0.5 * self.expected)
    }

    /// Whether a host's clock can stand like this.
    ///
    /// # Errors
    /// Names a time that it cannot show.
    pub fn check_memory(&self) -> Result<()> {
        let Self { sample_time: _, since_plan, horizon, previous_duration, expected, longest } = *self;
        let times = [
            ("time since the last plan", since_plan),
            ("length of the planned interval", horizon),
            ("length of the last interval", previous_duration),
            ("expected step", expected),
            ("longest step", longest),
        ];
        match times.into_iter().find(|(_, time)| !(0.0..=f64::MAX).contains(time)) {
            Some((quantity, value)) => Err(Error::Impossible { quantity, value }),
            None => Ok(()),
        }
    }
}

impl Memory for Clock {
    fn pass(&mut self, tape: &mut Tape<'_>) {
        let Self { sample_time: _, since_plan, horizon, previous_duration, expected, longest } = self;
        pass!(tape: since_plan, horizon, previous_duration, expected, longest);
    }
}
