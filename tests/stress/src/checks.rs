//! What must hold: each promise in a file of its own.

mod clock;
mod finite;
mod inside;
mod limits;
mod met;
mod prediction;
mod rest;
mod stops;
mod truth;

pub use clock::{clock, comparable};
pub use finite::NAME as FINITE;
pub use rest::{promises_rest, rest};

use std::fmt;

use crate::case::Case;
use crate::seen::Seen;

/// A communication point of a run.
#[derive(Clone, Copy)]
pub struct Now<'a> {
    /// How many steps have been made.
    pub count: usize,
    /// Time from the start \[s\].
    pub time: f64,
    /// Length of the step just made \[s\].
    pub size: f64,
    /// How far the reference is from what was to be foreseen of it at the point before \[m\].
    pub unforeseen: f64,
    /// What both units show.
    pub seen: Seen<'a>,
}

impl fmt::Display for Now<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { time, size, seen, .. } = self;
        let ([x, y], late) = (seen.miss(), seen.late_miss().unwrap_or(f64::NAN));
        write!(f, "{time:.9}, step {size:.9}, {}, miss {:.2e}, late {late:.2e}, ", seen.status(), x.hypot(y))?;
        write!(f, "singular value {:.4}, pose {:.4?}, ", seen.singular_value(), seen.pose())?;
        write!(
            f,
            "positions {:.4?}, rates {:.4?}, accelerations {:.1?}",
            seen.positions(),
            seen.rates(),
            seen.accelerations()
        )
    }
}

/// A promise over one run.
pub trait Check {
    /// Short name.
    fn name(&self) -> &'static str;

    /// Looks at a communication point, the start included; says what does not hold.
    fn see(&mut self, now: &Now<'_>) -> Result<(), String>;

    /// Looks back from the end.
    fn end(&mut self) -> Result<(), String> {
        Ok(())
    }

    /// Whether there was anything to look at.
    fn looked(&self) -> bool {
        true
    }
}

/// Those that a run of this case is looked at by.
pub fn all(case: &Case) -> Vec<Box<dyn Check + '_>> {
    let mut checks: Vec<Box<dyn Check + '_>> = vec![Box::new(finite::Finite), Box::new(limits::Limits::of(case))];
    if case.has_stops() {
        checks.push(Box::new(stops::Stops::of(case)));
        checks.extend(inside::Inside::of(case).map(|check| Box::new(check) as Box<dyn Check>));
    }
    if case.is_exact() {
        checks.push(Box::new(truth::Truth::of(case)));
        checks.extend(met::Met::of(case).map(|check| Box::new(check) as Box<dyn Check>));
        checks.extend(prediction::Prediction::of(case).map(|check| Box::new(check) as Box<dyn Check>));
    }
    checks
}
