//! An uneven clock costs little where on an even one the path is always kept: roll and rates are at most 1.2 times those
//! on the even clock (and 0.03 degrees, 0.1 rad/s); the path is kept to 1e-6 m, 1e-4 m with steps of 0.1 to 20 ms, and to what it bends in an interval.

use uam::parameters::Resolution;
use uam::reference::ReferenceKind;

use crate::case::Case;
use crate::course::Course;
use crate::draw::clock::Clock;

/// What roll and rates may be larger by, as a factor.
const LARGER: f64 = 1.2;

/// And beside it \[rad, rad/s\].
const MORE: [f64; 2] = [5.2e-4, 0.1];

/// A plan for an interval H that is held for a time T leaves a T (H - T) / 2 <= a H^2 / 8 of an acceleration a; a
/// little more where that changes.
const LEFT: f64 = 1.5 / 8.0;

/// Whether a case is to be compared with the same on an even clock.
pub fn comparable(case: &Case) -> bool {
    case.steps.clock != Clock::Even && case.is_exact() && case.change.is_none()
}

/// Compares a run with that of the same case on an even clock.
pub fn clock(case: &Case, run: &Course, even: &Course) -> Result<(), String> {
    if !even.kept {
        return Ok(());
    }
    for (what, found, usual, more) in [("roll", run.roll, even.roll, MORE[0]), ("rate", run.rate, even.rate, MORE[1])] {
        if found > LARGER * usual + more {
            return Err(format!("largest {what} {found:.2e} instead of {usual:.2e} on an even clock"));
        }
    }
    let longest = match case.steps.clock {
        Clock::Random => 0.02,
        Clock::Alternating => 2.0 * case.steps.step,
        Clock::Jittered => 1.5 * case.steps.step,
        _ => 0.0,
    };
    let reach: f64 = case.parameters.links[..case.structure.links].iter().map(|link| link.length).sum();
    // The path bends, and so do the ways of the links.
    let bends = case.path_acceleration() + run.rate * run.rate * reach;
    // By accelerations, the place is made good by and by.
    let slack = if case.parameters.ik.resolution == Resolution::AccelerationLevel { 10.0 } else { 1.0 };
    let least = if case.steps.clock == Clock::Random { 1e-4 } else { 1e-6 };
    let near = slack * f64::max(least, 1e-6 + LEFT * bends * longest * longest);
    // From outside not all is foreseen; between plans the end effector is somewhere near the path.
    let foreseen = case.parameters.reference.kind != ReferenceKind::External && case.steps.per_plan == Some(1);
    if foreseen && run.miss > even.miss + near {
        return Err(format!("misses by {:.2e} instead of {:.2e} on an even clock", run.miss, even.miss));
    }
    Ok(())
}
