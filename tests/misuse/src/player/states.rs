//! Saving, going back, and states as bytes.

use std::ptr;

use super::{Player, Saved};
use crate::functions::{OK, State};
use crate::hostile::{damage, length, one_in, pointer_mut};

/// Room for the bytes of a state.
const BYTES: usize = 1 << 14;

// SAFETY, for all calls: every pointer is null, misaligned or good for ROOM elements, and every length is at
// most ROOM or more than any memory has, which a unit must notice without reading.
impl Player<'_> {
    /// A state of this sequence, or what is none: null, freed, or any address.
    pub fn any_state(&mut self) -> State {
        match self.rng.u32(0..12) {
            0 => ptr::null_mut(),
            1 => ptr::without_provenance_mut(self.rng.usize(..)),
            2 => self.component,
            _ if self.states.is_empty() => ptr::null_mut(),
            _ => self.states[self.rng.usize(0..self.states.len())].state,
        }
    }

    pub fn get_state(&mut self) -> Result<(), String> {
        // Into a new place, or over a state that is there.
        let old = (self.rng.bool() && !self.states.is_empty()).then(|| self.rng.usize(0..self.states.len()));
        let mut state = old.map_or(ptr::null_mut(), |old| self.states[old].state);
        let given = state;
        let done = self.call("fmi2GetFMUstate", |p, c| {
            let place = pointer_mut(&mut p.rng, &raw mut state);
            unsafe { p.unit.functions.get_state(c, place) }
        })?;
        if done {
            let saved = Saved { state, stage: self.stage, start: self.start, time: self.time };
            match old {
                Some(old) => {
                    self.require(state == given, "fmi2GetFMUstate: another place for a state that is there")?;
                    self.states[old] = saved;
                }
                None => self.states.push(saved),
            }
        }
        Ok(())
    }

    pub fn set_state(&mut self) -> Result<(), String> {
        let state = self.any_state();
        if self.call("fmi2SetFMUstate", |p, c| unsafe { p.unit.functions.set_state(c, state) })? {
            let saved = self.states.iter().find(|saved| saved.state == state);
            let &Saved { stage, start, time, .. } = saved.ok_or("fmi2SetFMUstate: fmi2OK for what is no state")?;
            (self.stage, self.start, self.time) = (stage, start, time);
        }
        Ok(())
    }

    pub fn free_state(&mut self) -> Result<(), String> {
        let given = self.any_state();
        let mut state = given;
        let done = self.call("fmi2FreeFMUstate", |p, c| unsafe { p.unit.functions.free_state(c, &raw mut state) })?;
        if done {
            self.require(state.is_null(), "fmi2FreeFMUstate: the freed state is not null")?;
            self.states.retain(|saved| saved.state != given);
        }
        Ok(())
    }

    pub fn state_size(&mut self) -> Result<(), String> {
        let state = self.any_state();
        let mut size = 0;
        let done = self.call("fmi2SerializedFMUstateSize", |p, c| {
            let place = pointer_mut(&mut p.rng, &raw mut size);
            unsafe { p.unit.functions.state_size(c, state, place) }
        })?;
        self.require(!done || (1..=BYTES).contains(&size), &format!("fmi2SerializedFMUstateSize: {size}"))
    }

    pub fn serialize_state(&mut self) -> Result<(), String> {
        let state = self.any_state();
        let size = if one_in(&mut self.rng, 4) { self.rng.usize(0..BYTES) } else { BYTES };
        let mut bytes = vec![0_u8; BYTES];
        let done = self.call("fmi2SerializeFMUstate", |p, c| {
            let (place, size) = (pointer_mut(&mut p.rng, bytes.as_mut_ptr()), length(&mut p.rng, size));
            unsafe { p.unit.functions.serialize_state(c, state, place.cast(), size) }
        })?;
        if done {
            self.digest.take(&bytes);
            self.bytes = bytes;
        }
        Ok(())
    }

    pub fn deserialize_state(&mut self) -> Result<(), String> {
        let mut bytes = self.bytes.clone();
        if bytes.is_empty() || one_in(&mut self.rng, 3) {
            damage(&mut self.rng, &mut bytes);
        }
        let mut state = ptr::null_mut();
        let done = self.call("fmi2DeSerializeFMUstate", |p, c| {
            let size = length(&mut p.rng, bytes.len());
            unsafe { p.unit.functions.deserialize_state(c, bytes.as_ptr().cast(), size, &raw mut state) }
        })?;
        if done {
            // Nobody knows of which instant these bytes were; the instance does not go there.
            let mut freed = state;
            let status = unsafe { self.unit.functions.free_state(self.component, &raw mut freed) };
            self.require(status == OK, "fmi2FreeFMUstate: a state from bytes cannot be freed")?;
        }
        Ok(())
    }
}
