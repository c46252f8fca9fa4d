//! A reference at rest brings rest: four seconds later joint rates are below 0.2 rad/s, or at most 0.1 rad/s above those
//! of minimum_norm in the same case, 0.5 rad/s where the UAV rolled by more than 2 degrees on the way.

use super::Now;
use crate::case::Case;

/// This slow is rest \[rad/s\].
const REST: f64 = 0.2;

/// How much faster than minimum_norm joints may be \[rad/s\], if the UAV kept upright, and if not.
const FASTER: [f64; 2] = [0.1, 0.5];

/// Rolls by more \[rad\].
const UPRIGHT: f64 = 0.0349;

/// Least damping \[1/s\] and longest washout \[s\] of motions that come to rest in time.
const DAMPED: (f64, f64) = (2.0, 0.5);

/// How long before the end rates count \[s\].
const LATE: f64 = 0.2;

/// How a run ends.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ending {
    /// Largest rate of a joint shortly before \[rad/s\].
    pub rate: f64,
    /// Largest roll on the way \[rad\].
    pub roll: f64,
    /// Whether narrow limits or the way were still in the way shortly before.
    pub on_the_way: bool,
}

/// Whether a case promises rest: free motion is damped, and by a washout that is shorter than the rest.
pub fn promises_rest(case: &Case) -> bool {
    let other = |name: &str, usual: f64| {
        case.others.iter().find(|(other, _)| *other == name).map_or(usual, |(_, value)| *value)
    };
    let damped = other("ik.moment_damping", DAMPED.0) >= DAMPED.0 && other("ik.moment_washout", DAMPED.1) <= DAMPED.1;
    case.path.at_rest.is_finite() && case.is_exact() && (damped || !case.cancels_moment())
}

impl Ending {
    /// Looks at a communication point of a run that takes `duration` \[s\].
    pub fn see(&mut self, case: &Case, duration: f64, now: &Now<'_>) {
        self.roll = self.roll.max(now.seen.pose()[2].abs());
        if now.time > duration - LATE {
            let rates = &now.seen.rates()[..case.structure.links];
            self.rate = rates.iter().fold(self.rate, |largest, rate| largest.max(rate.abs()));
            let limited = ["rate_limited", "path_limited", "catching_up"].contains(&now.seen.status());
            self.on_the_way |= limited && case.limits.are_narrow();
        }
    }
}

/// Whether an ending is rest; `minimum_norm` gives that of the same case with that resolution.
pub fn rest(ending: Ending, minimum_norm: impl FnOnce() -> Result<Ending, String>) -> Result<(), String> {
    if ending.rate <= REST || ending.on_the_way {
        return Ok(());
    }
    let other = minimum_norm()?;
    let more = FASTER[usize::from(ending.roll.max(other.roll) > UPRIGHT)];
    if ending.rate <= other.rate + more {
        return Ok(());
    }
    Err(format!(
        "{:.3} rad/s at rest, minimum_norm {:.3}, largest roll {:.3} rad",
        ending.rate, other.rate, ending.roll
    ))
}
