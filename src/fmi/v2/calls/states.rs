//! The functions for states: get, set, free, and as bytes.

use super::{Handle, arguments, c};
use crate::fmi::model::Model;
use crate::fmi::v2::c_types::Status;
use crate::fmi::v2::component;
use crate::fmi::v2::error::Error;
use crate::fmi::v2::instance::Saved;
use crate::fmi::v2::phase::Call;
use crate::fmi::v2::states;

/// `fmi2GetFMUstate`: a state that is there already is overwritten.
pub unsafe fn get_fmu_state<M: Model>(handle: Handle, state: *mut c::FmuState) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::call::<M>(handle, Call::GetFMUstate, move |instance| {
            hand_out(handle, arguments::place("FMUstate", state)?, instance.save()?)
        })
    }
}

/// `fmi2SetFMUstate`.
pub unsafe fn set_fmu_state<M: Model>(handle: Handle, state: c::FmuState) -> Status {
    let body = |instance: &mut super::Instance<M>| with(state, |saved| instance.restore(saved));
    // SAFETY: promised by the caller.
    unsafe { component::call::<M>(handle, Call::SetFMUstate, body) }
}

/// `fmi2FreeFMUstate`: no state, nothing to do. What is freed is null afterwards.
pub unsafe fn free_fmu_state<M: Model>(handle: Handle, state: *mut c::FmuState) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::call::<M>(handle, Call::FreeFMUstate, move |_| {
            if state.is_null() {
                return Ok(());
            }
            let state = arguments::place("FMUstate", state)?;
            if !state.is_null() && !states::free::<Saved<M>>(*state) {
                return Err(Error::NoState);
            }
            *state = std::ptr::null_mut();
            Ok(())
        })
    }
}

/// `fmi2SerializedFMUstateSize`.
pub unsafe fn serialized_fmu_state_size<M: Model>(handle: Handle, state: c::FmuState, size: *mut c::Size) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::call::<M>(handle, Call::SerializedFMUstateSize, move |instance| {
            *arguments::place("size", size)? = with(state, |saved| instance.write_saved(saved))?.len();
            Ok(())
        })
    }
}

/// `fmi2SerializeFMUstate`: more room than needed is filled with zeros.
pub unsafe fn serialize_fmu_state<M: Model>(
    handle: Handle,
    state: c::FmuState,
    place: *mut c::Byte,
    size: c::Size,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::call::<M>(handle, Call::SerializeFMUstate, move |instance| {
            let bytes = with(state, |saved| instance.write_saved(saved))?;
            let place = arguments::bytes_mut("serializedState", place, size)?;
            let Some((room, rest)) = place.split_at_mut_checked(bytes.len()) else {
                return Err(Error::Argument {
                    argument: "size",
                    expected: format!("at least {}", bytes.len()),
                    found: size.to_string(),
                });
            };
            room.copy_from_slice(&bytes);
            rest.fill(0);
            Ok(())
        })
    }
}

/// `fmi2DeSerializeFMUstate`: like `fmi2GetFMUstate`, a state that is there already is overwritten.
pub unsafe fn deserialize_fmu_state<M: Model>(
    handle: Handle,
    bytes: *const c::Byte,
    size: c::Size,
    state: *mut c::FmuState,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::call::<M>(handle, Call::DeSerializeFMUstate, move |instance| {
            let bytes = arguments::bytes("serializedState", bytes, size)?;
            hand_out(handle, arguments::place("FMUstate", state)?, instance.read_saved(bytes)?)
        })
    }
}

/// Gives a state to the host: in place of the one that is there, or else as a new one.
fn hand_out<M: Model>(owner: Handle, place: &mut c::FmuState, saved: Saved<M>) -> Result<(), Error> {
    if place.is_null() {
        *place = states::keep(saved, owner.addr());
        return Ok(());
    }
    states::with(*place, |there| *there = saved).ok_or(Error::NoState)
}

/// Calls `body` with a state of this unit.
fn with<M: Model, R>(state: c::FmuState, body: impl FnOnce(&Saved<M>) -> Result<R, Error>) -> Result<R, Error> {
    states::with(state, |saved| body(saved)).ok_or(Error::NoState)?
}
