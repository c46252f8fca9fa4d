//! With least_squares a joint that starts outside of its stops comes inside as fast as its limits allow, within twice the
//! time of that and 50 ms, and as long as it is outside the status does not say that all is well.

use super::{Check, Now};
use crate::case::Case;

/// What it may take longer than with the largest rate and acceleration, as a factor and beside it \[s\].
const LONGER: (f64, f64) = (2.0, 0.05);

/// Nearer than this it is inside \[rad\].
const ROUNDING: f64 = 1e-6;

pub struct Inside<'a> {
    case: &'a Case,
    /// Which joint, how far outside it starts \[rad\], and when it must be inside \[s\].
    outside: Vec<(usize, f64, f64)>,
}

impl<'a> Inside<'a> {
    /// If a joint starts outside.
    pub fn of(case: &'a Case) -> Option<Self> {
        let outside = |(i, joint): (usize, &uam::parameters::Joint)| {
            let distance = (joint.lower - joint.start).max(joint.start - joint.upper);
            let (rate, acceleration) = (joint.rate_limit, joint.acceleration_limit);
            let time = if distance < 0.5 * rate * rate / acceleration {
                (2.0 * distance / acceleration).sqrt()
            } else {
                distance / rate + 0.5 * rate / acceleration
            };
            (distance > 0.0).then_some((i, distance, LONGER.0 * time + LONGER.1))
        };
        let joints = case.parameters.joints[..case.structure.links].iter().enumerate();
        let outside: Vec<_> = joints.filter_map(outside).collect();
        (case.has_stops() && !outside.is_empty()).then_some(Self { case, outside })
    }
}

impl Check for Inside<'_> {
    fn name(&self) -> &'static str {
        "inside"
    }

    fn see(&mut self, now: &Now<'_>) -> Result<(), String> {
        let past = |i: usize| {
            let joint = &self.case.parameters.joints[i];
            let position = now.seen.positions()[i];
            (joint.lower - position).max(position - joint.upper)
        };
        // Who has come inside has kept the promise; a step longer than all before may lead past the stop again.
        self.outside.retain(|(i, ..)| past(*i) > ROUNDING);
        for (i, distance, time) in &self.outside {
            let past = past(*i);
            if now.time > time + 3.0 * now.size {
                return Err(format!("joint {}, {distance:.3} rad outside at the start, is still by {past:.3}", i + 1));
            }
            if now.seen.status() == "ok" {
                return Err(format!("joint {} is {past:.3} rad outside, and the status is ok", i + 1));
            }
        }
        Ok(())
    }
}
