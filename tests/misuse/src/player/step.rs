//! Communication steps, and what is said of them.

use super::{Player, Stage};
use crate::functions::{ERROR, OK};
use crate::hostile::{integer, pointer_mut, real};
use crate::{host, outputs};

// SAFETY, for all calls: every pointer is null, misaligned or good for ROOM elements, and every length is at
// most ROOM or more than any memory has, which a unit must notice without reading.
impl Player<'_> {
    /// Beginning and size of a step that no good host asks for, or of an odd one that some do.
    pub fn odd_step(&mut self) -> (f64, f64) {
        let size = match self.rng.u32(0..100) {
            // Every one takes as long as a hundred sequences without.
            0 => 1e3,
            1..=15 => real(&mut self.rng),
            16..=30 => 1e-13,
            31..=45 => 0.0,
            46..=60 => 0.009_999_999_999_998_455,
            _ => 0.05 * self.rng.f64(),
        };
        let from = match self.rng.u32(0..5) {
            0 => real(&mut self.rng),
            1 => self.time + 1e-9,
            _ => self.time,
        };
        (from, size)
    }

    pub fn cancel_step(&mut self) -> Result<(), String> {
        self.call("fmi2CancelStep", |p, c| unsafe { p.unit.functions.cancel_step(c) }).map(drop)
    }

    pub fn do_step(&mut self, from: f64, size: f64) -> Result<(), String> {
        let name = "fmi2DoStep";
        let mut ours = false;
        let done = self.call(name, |p, c| {
            ours = c == p.component;
            let never_back = integer(&mut p.rng);
            unsafe { p.unit.functions.do_step(c, from, size, never_back) }
        })?;
        if done {
            self.require_stage(name, &[Stage::Running])?;
            if size != 0.0 {
                self.time = from + size;
            }
            let mut end = f64::NAN;
            let status = unsafe { self.unit.functions.get_real_status(self.component, 2, &raw mut end) };
            self.require(
                status == OK && end.to_bits() == self.time.to_bits(),
                &format!("{name}: ends at {end}, not at {} = {from} + {size}", self.time),
            )?;
            return self.look(&format!("after the step from {from} by {size}"));
        }
        if ours && !self.component.is_null() && self.stage == Stage::Running {
            // Either the arguments were refused, or the instance has failed: then this is fmi2Error.
            let mut status = OK;
            unsafe { self.unit.functions.get_status(self.component, 0, &raw mut status) };
            if status == ERROR {
                self.stage = Stage::Failed;
            }
        }
        Ok(())
    }

    /// Every real output is a number, and so is its derivative, and all go into the fingerprint; or that is refused with
    /// a reason.
    pub fn look(&mut self, when: &str) -> Result<(), String> {
        let (before, mut digest) = (host::messages(), self.digest);
        let take = |value: f64| digest.take(&value.to_bits().to_le_bytes());
        let numbers = self.unit.variables.iter().filter(|variable| variable.real_output());
        let points = outputs::read(&self.unit.functions, self.component, numbers, self.told, take)
            .map_err(|message| format!("{message} {when}"))?;
        self.digest = digest;
        self.listen(before);
        self.tally.points = self.tally.points.and(points);
        if points.without_outputs > 0 {
            self.stage = Stage::Failed;
        }
        Ok(())
    }

    pub fn statuses(&mut self) -> Result<(), String> {
        let (kind, which) = (integer(&mut self.rng), self.rng.u32(0..5));
        let name = [
            "fmi2GetStatus",
            "fmi2GetRealStatus",
            "fmi2GetIntegerStatus",
            "fmi2GetBooleanStatus",
            "fmi2GetStringStatus",
        ][which as usize];
        self.call(name, |p, c| {
            let (number, real) =
                (pointer_mut(&mut p.rng, p.integers.as_mut_ptr()), pointer_mut(&mut p.rng, p.reals.as_mut_ptr()));
            let text = pointer_mut(&mut p.rng, p.texts.as_mut_ptr());
            let functions = &p.unit.functions;
            unsafe {
                match which {
                    0 => functions.get_status(c, kind, number),
                    1 => functions.get_real_status(c, kind, real),
                    2 => functions.get_integer_status(c, kind, number),
                    3 => functions.get_boolean_status(c, kind, number),
                    _ => functions.get_string_status(c, kind, text),
                }
            }
        })
        .map(drop)
    }
}
