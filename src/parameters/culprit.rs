//! Which parameter is to blame where a simulation cannot begin.
//!
//! What goes wrong in the first plan or the first outputs is a number that is not finite, or a step that takes for
//! ever, and says nothing of the parameter that brought it about. That is found by trial: a parameter with whose start
//! value all would be well.

use crate::error::{Error, Result};
use crate::fmi::Model;
use crate::variables::{Causality, Kind, Variable};

/// Why `begin` cannot begin with `data`, in terms of a parameter wherever one alone is to blame.
#[cold]
#[inline(never)]
pub fn blame<M: Model>(
    structure: M::Structure,
    data: &M::Data,
    begin: &dyn Fn(&mut M::Data) -> Result<M>,
    error: Error,
) -> Error {
    if error.parameter().is_some() {
        return error;
    }
    let known = M::start(structure);
    let table = M::table(structure);
    for variable in table.variables().iter().filter(|variable| variable.causality == Causality::Parameter) {
        let mut changed = data.clone();
        let [found, start] = [&changed, &known].map(|data| spelled(variable, data));
        if found != start {
            take_over(variable, &mut changed, &known);
            if begin(&mut changed).is_ok() {
                return Error::Unsuited { name: variable.name.clone(), found, start, reason: Box::new(error) };
            }
        }
    }
    error
}

fn spelled<D>(variable: &Variable<D>, data: &D) -> String {
    match variable.kind {
        Kind::Real { at, .. } => format!("{:?}", at.get(data)),
        Kind::Boolean { at } => at.get(data).to_string(),
        Kind::Enumeration { at } => at.get(data).name().to_owned(),
    }
}

fn take_over<D>(variable: &Variable<D>, data: &mut D, from: &D) {
    match variable.kind {
        Kind::Real { at, .. } => *at.get_mut(data) = *at.get(from),
        Kind::Boolean { at } => *at.get_mut(data) = *at.get(from),
        Kind::Enumeration { at } => {
            at.get_mut(data).choose(at.get(from).number());
        }
    }
}
