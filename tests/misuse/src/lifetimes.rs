//! Instances one after the other, each through a whole life: what a leak checker watches.

use std::ptr;

use crate::reference;
use crate::unit::Unit;

/// Lets `count` instances come and go.
///
/// # Errors
/// If a call is refused.
pub fn run(unit: &Unit, count: u32) -> Result<(), String> {
    let functions = &unit.functions;
    let mut bytes = vec![0; 1 << 14];
    for number in 0..count {
        let component = reference::instantiate(unit)?;
        reference::run(unit, component)?;
        let (mut state, mut copy) = (ptr::null_mut(), ptr::null_mut());
        // SAFETY: the instance is alive, the bytes have the length that is said.
        let statuses = unsafe {
            let statuses = [
                (functions.get_state)(component, &raw mut state),
                (functions.get_state)(component, &raw mut state),
                (functions.serialize_state)(component, state, bytes.as_mut_ptr(), bytes.len()),
                (functions.deserialize_state)(component, bytes.as_ptr(), bytes.len(), &raw mut copy),
                (functions.set_state)(component, copy),
                (functions.free_state)(component, &raw mut state),
                (functions.do_step)(component, 4e-3, 1e-3, 1),
                (functions.terminate)(component),
                (functions.reset)(component),
            ];
            // The other state goes with the instance.
            (functions.free_instance)(component);
            statuses
        };
        if statuses.iter().any(|status| *status != 0) {
            return Err(format!("{}, instance {number}: {statuses:?}", unit.name));
        }
    }
    println!("{}: {count} instances came and went", unit.name);
    Ok(())
}
