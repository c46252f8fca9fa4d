//! Reading and setting variables.

use super::Player;
use crate::hostile::{integer, length, pointer, pointer_mut, real, text};

// SAFETY, for all calls: every pointer is null, misaligned or good for ROOM elements, and every length is at
// most ROOM or more than any memory has, which a unit must notice without reading.
impl Player<'_> {
    /// Fills the list of references: known ones, mostly; returns its length.
    pub fn choose_references(&mut self, hostile: bool) -> usize {
        let count = self.rng.usize(1..5);
        let known = &self.unit.variables;
        for place in &mut self.references[..count] {
            *place = match self.rng.u32(0..40) {
                0 if hostile => self.rng.u32(..),
                1 if hostile => u32::try_from(known.len()).unwrap_or(u32::MAX),
                _ => known[self.rng.usize(0..known.len())].reference,
            };
        }
        count
    }

    pub fn get_real(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        let done = self.call("fmi2GetReal", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            let values = pointer_mut(&mut p.rng, p.reals.as_mut_ptr());
            unsafe { p.unit.functions.get_real(c, references, count, values) }
        })?;
        if done {
            self.reals.iter().for_each(|value| self.digest.take(&value.to_bits().to_le_bytes()));
        }
        Ok(())
    }

    pub fn get_integer(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.call("fmi2GetInteger", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            let values = pointer_mut(&mut p.rng, p.integers.as_mut_ptr());
            unsafe { p.unit.functions.get_integer(c, references, count, values) }
        })?;
        self.integers.iter().for_each(|value| self.digest.take(&value.to_le_bytes()));
        Ok(())
    }

    pub fn get_boolean(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.call("fmi2GetBoolean", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            let values = pointer_mut(&mut p.rng, p.integers.as_mut_ptr());
            unsafe { p.unit.functions.get_boolean(c, references, count, values) }
        })?;
        self.integers.iter().for_each(|value| self.digest.take(&value.to_le_bytes()));
        Ok(())
    }

    /// Sets any variable to any number; `usual`: to one that makes sense for most.
    pub fn set_real(&mut self, usual: bool) -> Result<(), String> {
        let count = self.choose_references(!usual);
        for value in &mut self.reals[..count] {
            *value = if usual { self.rng.f64() } else { real(&mut self.rng) };
        }
        self.call("fmi2SetReal", |p, c| {
            let (references, values) = (p.references.as_ptr(), p.reals.as_ptr());
            if usual {
                return unsafe { p.unit.functions.set_real(c, references, count, values) };
            }
            let (references, count) = (pointer(&mut p.rng, references), length(&mut p.rng, count));
            let values = pointer(&mut p.rng, values);
            unsafe { p.unit.functions.set_real(c, references, count, values) }
        })
        .map(drop)
    }

    pub fn set_integer(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.integers[..count].fill_with(|| integer(&mut self.rng));
        self.call("fmi2SetInteger", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            let values = pointer(&mut p.rng, p.integers.as_ptr());
            unsafe { p.unit.functions.set_integer(c, references, count, values) }
        })
        .map(drop)
    }

    pub fn set_boolean(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.integers[..count].fill_with(|| integer(&mut self.rng));
        self.call("fmi2SetBoolean", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            let values = pointer(&mut p.rng, p.integers.as_ptr());
            unsafe { p.unit.functions.set_boolean(c, references, count, values) }
        })
        .map(drop)
    }

    pub fn get_string(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.call("fmi2GetString", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            unsafe { p.unit.functions.get_string(c, references, count, p.texts.as_mut_ptr()) }
        })
        .map(drop)
    }

    pub fn set_string(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.texts.fill_with(|| text(&mut self.rng));
        self.call("fmi2SetString", |p, c| {
            let (references, count) = (pointer(&mut p.rng, p.references.as_ptr()), length(&mut p.rng, count));
            unsafe { p.unit.functions.set_string(c, references, count, p.texts.as_ptr()) }
        })
        .map(drop)
    }
}
