//! No joint is commanded a rate above its limit, at the beginning of an interval or, on an even clock, at its end.

use super::{Check, Now};
use crate::case::Case;
use crate::draw::clock::Clock;

/// What rounding may add, as a share.
const ROUNDING: f64 = 1e-12;

pub struct Limits<'a> {
    case: &'a Case,
    even: bool,
}

impl<'a> Limits<'a> {
    pub fn of(case: &'a Case) -> Self {
        let even = case.steps.clock == Clock::Even && case.steps.sample_time >= case.steps.step;
        Self { case, even }
    }
}

impl Check for Limits<'_> {
    fn name(&self) -> &'static str {
        "rate limit"
    }

    fn see(&mut self, now: &Now<'_>) -> Result<(), String> {
        let joints = &self.case.parameters_after(now.count).joints[..self.case.structure.links];
        let ahead = if self.even { self.case.steps.step } else { 0.0 };
        for (i, joint) in joints.iter().enumerate() {
            let (rate, slope) = (now.seen.rates()[i], now.seen.accelerations()[i]);
            let largest = rate.abs().max((rate + slope * ahead).abs());
            if largest > joint.rate_limit * (1.0 + ROUNDING) {
                return Err(format!("joint {}: {largest:?} rad/s, limit {:?}", i + 1, joint.rate_limit));
            }
        }
        Ok(())
    }
}
