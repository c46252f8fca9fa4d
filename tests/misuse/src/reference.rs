//! A short run whose results are known: every new instance must give them, bit by bit.

use crate::functions::Component;
use crate::host;
use crate::unit::Unit;

/// A new instance of a unit.
///
/// # Errors
/// If the unit does not give one.
pub fn instantiate(unit: &Unit) -> Result<Component, String> {
    let callbacks = host::callbacks();
    let (name, nowhere) = (c"reference".as_ptr(), c"file:///nowhere".as_ptr());
    // SAFETY: all texts end with a zero, the callbacks live as long as the call.
    let component =
        unsafe { (unit.functions.instantiate)(name, 1, unit.guid.as_ptr(), nowhere, &raw const callbacks, 0, 0) };
    if component.is_null() { Err(format!("{}: no instance", unit.name)) } else { Ok(component) }
}

/// What a new instance gives in the short run.
///
/// # Errors
/// If a call is refused.
pub fn of_new(unit: &Unit) -> Result<Vec<u64>, String> {
    let new = Stranger::new(unit)?;
    run(unit, new.component)
}

/// An instance that only stands there.
pub struct Stranger<'a> {
    unit: &'a Unit,
    pub component: Component,
}

impl<'a> Stranger<'a> {
    /// A new one.
    ///
    /// # Errors
    /// If the unit does not give one.
    pub fn new(unit: &'a Unit) -> Result<Self, String> {
        Ok(Self { unit, component: instantiate(unit)? })
    }
}

impl Drop for Stranger<'_> {
    fn drop(&mut self) {
        // SAFETY: not used again.
        unsafe { (self.unit.functions.free_instance)(self.component) };
    }
}

/// Runs a new instance for two steps, the plant with a rate; the bits of all real outputs.
///
/// # Errors
/// If a call is refused.
pub fn run(unit: &Unit, component: Component) -> Result<Vec<u64>, String> {
    let functions = &unit.functions;
    let references = unit.real_outputs();
    let mut values = vec![f64::NAN; references.len()];
    // SAFETY: the instance is alive, all lists have the length that goes with them.
    let statuses = unsafe {
        let begun = [
            (functions.setup_experiment)(component, 0, 0.0, 0.0, 0, 0.0),
            (functions.enter_initialization)(component),
            (functions.exit_initialization)(component),
        ];
        if let Some(rate) = unit.reference("joint[1].rate_command").filter(|rate| !references.contains(rate)) {
            (functions.set_real)(component, &raw const rate, 1, &0.5);
        }
        let stepped = [(functions.do_step)(component, 0.0, 2e-3, 1), (functions.do_step)(component, 2e-3, 2e-3, 1)];
        let read = (functions.get_real)(component, references.as_ptr(), references.len(), values.as_mut_ptr());
        [begun.as_slice(), &stepped, &[read]].concat()
    };
    if statuses.iter().all(|status| *status == 0) {
        Ok(values.into_iter().map(f64::to_bits).collect())
    } else {
        Err(format!("{}: the reference run is refused: {statuses:?}", unit.name))
    }
}
