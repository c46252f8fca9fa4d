//! States that no unit has saved: their content is changed behind a checksum that is right.
//!
//! Whatever the content, it is refused, or it is the state of an instance that goes on like any other: without a
//! panic, without hanging, with finite outputs. And the instance can always go back.

use std::ffi::c_int;
use std::ptr;

use fastrand::Rng;

use crate::functions::State;
use crate::guest::{Fate, Guest};
use crate::hostile::{integer, one_in, real};
use crate::unit::Unit;

/// Room for the bytes of a state.
const BYTES: usize = 1 << 14;

/// Lengths of the steps that follow \[s\].
const SIZES: [f64; 4] = [1e-3, 1e-2, 0.0, 1e-13];

/// Saves a state of an instance in some situation, and lets it go on from what forgers make of that.
///
/// # Errors
/// What the unit did that it must not do.
pub fn play(unit: &Unit, seed: u64) -> Result<Fate, String> {
    let mut rng = Rng::with_seed(seed);
    let guest = Guest::new(unit)?;
    somewhere(&guest, &mut rng)?;
    let (mut honest, here) = (save(&guest)?, guest.time());
    let bytes = serialize(&guest, honest)?;
    let onwards = || {
        let went_well = guest.step(here, 1e-2)?;
        Ok::<_, String>((went_well, guest.bits()))
    };
    let expected = onwards()?;

    let mut fate = Fate::default();
    for _ in 0..8 {
        let forged = forge(&mut rng, &bytes);
        let mut state = ptr::null_mut();
        // SAFETY: as many bytes as said; states are looked up, not read.
        unsafe {
            let (bytes, size) = (forged.as_ptr().cast(), forged.len());
            let status = guest.functions.deserialize_state(guest.component, bytes, size, &raw mut state);
            fate.tried += 1;
            if guest.well("fmi2DeSerializeFMUstate", status)? {
                fate.accepted += 1;
                guest.must("fmi2SetFMUstate", guest.functions.set_state(guest.component, state))?;
                go_on(&guest, &mut rng)?;
                guest.must("fmi2FreeFMUstate", guest.functions.free_state(guest.component, &raw mut state))?;
            }
            guest.must("fmi2SetFMUstate", guest.functions.set_state(guest.component, honest))?;
        }
        if onwards()? != expected {
            return Err("after a forged state the instance does not go on from a true one as before".to_owned());
        }
    }
    fate.points = guest.points.get();
    // SAFETY: a state of this instance.
    guest.must("fmi2FreeFMUstate", unsafe { guest.functions.free_state(guest.component, &raw mut honest) })?;
    Ok(fate)
}

/// Brings a new instance into some situation.
fn somewhere(guest: &Guest<'_>, rng: &mut Rng) -> Result<(), String> {
    change(guest, rng, 6)?;
    if one_in(rng, 10) {
        return Ok(());
    }
    if !guest.initialize()? {
        // What was changed does not go together.
        guest.must("fmi2Reset", unsafe { guest.functions.reset(guest.component) })?;
        guest.initialize()?;
    }
    for _ in 0..rng.u32(0..6) {
        change(guest, rng, 3)?;
        guest.step(guest.time(), SIZES[rng.usize(0..SIZES.len())])?;
    }
    Ok(())
}

/// Sets some variables, if they can be set.
fn change(guest: &Guest<'_>, rng: &mut Rng, count: usize) -> Result<(), String> {
    let (functions, component) = (guest.functions, guest.component);
    for _ in 0..count {
        let variable = &guest.variables[rng.usize(0..guest.variables.len())];
        let (place, number, value) = (&raw const variable.reference, rng.i32(0..5), rng.f64());
        // SAFETY: all lists have one element.
        unsafe {
            if variable.real {
                guest.well("fmi2SetReal", functions.set_real(component, place, 1, &raw const value))?;
            } else {
                guest.well("fmi2SetInteger", functions.set_integer(component, place, 1, &raw const number))?;
                guest.well("fmi2SetBoolean", functions.set_boolean(component, place, 1, &raw const number))?;
            }
        }
    }
    Ok(())
}

/// What a host does next, wherever the instance believes to be.
fn go_on(guest: &Guest<'_>, rng: &mut Rng) -> Result<(), String> {
    guest.finite("in a state that was accepted")?;
    if one_in(rng, 4) {
        guest.initialize()?;
    }
    for _ in 0..3 {
        guest.step(guest.time(), SIZES[rng.usize(0..SIZES.len())])?;
        change(guest, rng, 1)?;
    }
    let mut state = save(guest)?;
    serialize(guest, state)?;
    // SAFETY: a state of this instance.
    guest.must("fmi2FreeFMUstate", unsafe { guest.functions.free_state(guest.component, &raw mut state) })
}

/// A state; if the outputs have no values, the instance fails in the attempt, and that is its state.
fn save(guest: &Guest<'_>) -> Result<State, String> {
    let mut state = ptr::null_mut();
    // SAFETY: there is a place for the state.
    let mut get = || unsafe { guest.functions.get_state(guest.component, &raw mut state) };
    if !guest.well("fmi2GetFMUstate", get())? {
        guest.must("fmi2GetFMUstate", get())?;
    }
    Ok(state)
}

fn serialize(guest: &Guest<'_>, state: State) -> Result<Vec<u8>, String> {
    let (mut size, mut bytes) = (0, vec![0; BYTES]);
    // SAFETY: the bytes have the length that is said.
    let statuses: [c_int; 2] = unsafe {
        [
            guest.functions.state_size(guest.component, state, &raw mut size),
            guest.functions.serialize_state(guest.component, state, bytes.as_mut_ptr().cast(), bytes.len()),
        ]
    };
    guest.must("fmi2SerializedFMUstateSize", statuses[0])?;
    guest.must("fmi2SerializeFMUstate", statuses[1])?;
    bytes.truncate(size);
    Ok(bytes)
}

/// Other content in the same form: a line that says of what, the content's length, words of 8 bytes, a checksum.
fn forge(rng: &mut Rng, bytes: &[u8]) -> Vec<u8> {
    let title = bytes.iter().position(|&byte| byte == b'\n').map_or(0, |end| end + 1);
    let (content, checksum) = (title + 8, bytes.len() - 8);
    debug_assert_eq!(bytes[checksum..], fnv1a(&bytes[..checksum]).to_le_bytes(), "the form is known");
    let mut words: Vec<u64> =
        bytes[content..checksum].as_chunks().0.iter().map(|word| u64::from_le_bytes(*word)).collect();
    let any = rng.usize(0..words.len());
    match rng.u32(0..20) {
        0 => words.truncate(any),
        1 => words.extend_from_within(any..),
        2 => drop(words.remove(any)),
        3 => words.insert(any, 1),
        4 => words[any..].fill(rng.u64(..)),
        _ => {
            for _ in 0..rng.u32(1..4) {
                let word = rng.usize(0..words.len());
                words[word] = match rng.u32(0..4) {
                    0 => integer(rng).cast_unsigned().into(),
                    1 => words[word] ^ (1 << rng.u32(0..64)),
                    _ => real(rng).to_bits(),
                };
            }
        }
    }
    let mut forged = bytes[..title].to_vec();
    forged.extend((8 * words.len() as u64).to_le_bytes());
    forged.extend(words.into_iter().flat_map(u64::to_le_bytes));
    forged.extend(fnv1a(&forged).to_le_bytes());
    forged
}

/// The checksum of states: FNV-1a with 64 bits.
fn fnv1a(bytes: &[u8]) -> u64 {
    let mut digest = crate::digest::Digest::EMPTY;
    digest.take(bytes);
    digest.value()
}
