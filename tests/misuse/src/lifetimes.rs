//! Instances one after the other, each through a whole life: what a leak checker watches.

use std::ptr;

use crate::functions::OK;
use crate::guest::Guest;
use crate::reference;
use crate::unit::Unit;

/// Lets `count` instances come and go.
///
/// # Errors
/// If a call is refused.
pub fn run(unit: &Unit, count: u32) -> Result<(), String> {
    let mut bytes = vec![0; 1 << 14];
    for number in 0..count {
        let guest = Guest::new(unit)?;
        let Guest { component, functions, .. } = guest;
        reference::run(unit, component)?;
        let (mut state, mut copy) = (ptr::null_mut(), ptr::null_mut());
        // SAFETY: the instance is alive, the bytes have the length that is said.
        let statuses = unsafe {
            [
                functions.get_state(component, &raw mut state),
                functions.get_state(component, &raw mut state),
                functions.serialize_state(component, state, bytes.as_mut_ptr(), bytes.len()),
                functions.deserialize_state(component, bytes.as_ptr(), bytes.len(), &raw mut copy),
                functions.set_state(component, copy),
                // The copy goes with the instance.
                functions.free_state(component, &raw mut state),
                functions.do_step(component, 4e-3, 1e-3, 1),
                functions.terminate(component),
                functions.reset(component),
            ]
        };
        if statuses.iter().any(|status| *status != OK) {
            return Err(format!("{}, instance {number}: {statuses:?}", unit.name));
        }
    }
    println!("{}: {count} instances came and went", unit.name);
    Ok(())
}
