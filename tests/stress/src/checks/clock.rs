//! An uneven clock costs little where on an even one the path is always kept: roll and rates are at most 1.2 times those
//! on the even clock (and 0.03 degrees, 0.1 rad/s); the path is kept to 1e-6 m, 1e-4 m with steps of 0.1 to 20 ms.

use uam::reference::ReferenceKind;

use crate::case::Case;
use crate::course::Course;
use crate::draw::clock::Clock;

/// What roll and rates may be larger by, as a factor.
const LARGER: f64 = 1.2;

/// And beside it \[rad, rad/s\].
const MORE: [f64; 2] = [5.2e-4, 0.1];

/// Long steps in turn may miss by more \[s\].
const SHORT: f64 = 2.5e-3;

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
    let near = match case.steps.clock {
        Clock::Random => 1e-4,
        Clock::Alternating | Clock::Jittered if case.steps.step > SHORT => 1e-4,
        _ => 1e-6,
    };
    // From outside not all is foreseen; between plans the end effector is somewhere near the path.
    let foreseen = case.parameters.reference.kind != ReferenceKind::External && case.steps.per_plan == Some(1);
    if foreseen && run.miss > even.miss + near {
        return Err(format!("misses by {:.2e} instead of {:.2e} on an even clock", run.miss, even.miss));
    }
    Ok(())
}
