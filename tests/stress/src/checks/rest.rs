//! A reference at rest brings rest: four seconds later joint rates are below 0.2 rad/s, or at most 0.1 rad/s above those
//! of minimum_norm in the same case, 0.5 rad/s where the UAV rolled by more than 2 degrees on the way. Nothing is promised
//! where limits or the path still contradict the second task.

use crate::case::Case;
use crate::course::Course;

/// This slow is rest \[rad/s\].
const REST: f64 = 0.2;

/// How much faster than minimum_norm joints may be \[rad/s\], if the UAV kept upright, and if not.
const FASTER: [f64; 2] = [0.1, 0.5];

/// Rolls by more \[rad\].
const UPRIGHT: f64 = 0.0349;

/// Least damping \[1/s\] and longest washout \[s\] of motions that come to rest in time.
const DAMPED: (f64, f64) = (2.0, 0.5);

/// Whether a case promises rest: free motion is damped, and by a washout that is shorter than the rest.
pub fn promises_rest(case: &Case) -> bool {
    let other = |name: &str, usual: f64| {
        case.others.iter().find(|(other, _)| *other == name).map_or(usual, |(_, value)| *value)
    };
    let damped = other("ik.moment_damping", DAMPED.0) >= DAMPED.0 && other("ik.moment_washout", DAMPED.1) <= DAMPED.1;
    case.path.at_rest.is_finite() && case.is_exact() && (damped || !case.cancels_moment())
}

/// Whether a run ends at rest; `minimum_norm` gives the same case with that resolution.
pub fn rest(run: &Course, minimum_norm: impl FnOnce() -> Result<Course, String>) -> Result<(), String> {
    if run.last_rate <= REST || run.on_the_way || run.contradicted {
        return Ok(());
    }
    let other = minimum_norm()?;
    let more = FASTER[usize::from(run.roll.max(other.roll) > UPRIGHT)];
    if run.last_rate <= other.last_rate + more {
        return Ok(());
    }
    Err(format!(
        "{:.3} rad/s at rest, minimum_norm {:.3}, largest roll {:.3} rad",
        run.last_rate, other.last_rate, run.roll
    ))
}
