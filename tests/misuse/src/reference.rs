//! A short run whose results are known: every new instance must give them, bit by bit.

use crate::functions::{Component, OK};
use crate::guest::Guest;
use crate::unit::Unit;

/// What a new instance gives in the short run.
///
/// # Errors
/// If a call is refused.
pub fn of_new(unit: &Unit) -> Result<Vec<u64>, String> {
    run(unit, Guest::new(unit)?.component)
}

/// Runs a new instance for two steps, the plant with a rate; the bits of all real outputs.
///
/// # Errors
/// If a call is refused.
pub fn run(unit: &Unit, component: Component) -> Result<Vec<u64>, String> {
    let functions = &unit.functions;
    let outputs = unit.variables.iter().filter(|variable| variable.real_output());
    let references: Vec<_> = outputs.map(|variable| variable.reference).collect();
    let mut values = vec![f64::NAN; references.len()];
    // SAFETY: the instance is alive, all lists have the length that goes with them.
    let statuses = unsafe {
        let begun = [
            functions.setup_experiment(component, 0, 0.0, 0.0, 0, 0.0),
            functions.enter_initialization(component),
            functions.exit_initialization(component),
        ];
        if let Some(rate) = unit.reference("joint[1].rate_command").filter(|rate| !references.contains(rate)) {
            functions.set_real(component, &raw const rate, 1, &0.5);
        }
        let stepped = [functions.do_step(component, 0.0, 2e-3, 1), functions.do_step(component, 2e-3, 2e-3, 1)];
        let read = functions.get_real(component, references.as_ptr(), references.len(), values.as_mut_ptr());
        [begun.as_slice(), &stepped, &[read]].concat()
    };
    if statuses.iter().all(|status| *status == OK) {
        Ok(values.into_iter().map(f64::to_bits).collect())
    } else {
        Err(format!("{}: the reference run is refused: {statuses:?}", unit.name))
    }
}
