//! Every call returns fmi2OK, and every output is a finite number.

use super::{Check, Now};

/// Calls that are refused are reported under the same name.
pub const NAME: &str = "finite";

pub struct Finite;

impl Check for Finite {
    fn name(&self) -> &'static str {
        NAME
    }

    fn see(&mut self, now: &Now<'_>) -> Result<(), String> {
        let mut values = now.seen.controller.iter().chain(now.seen.plant);
        match values.position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(place) => Err(format!("output number {place} is no finite number")),
        }
    }
}
