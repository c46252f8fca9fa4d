//! Getting and setting variables by their value references.

use super::values::{self, Scalar};
use super::{Instance, Snapshot};
use crate::fmi::model::Model;
use crate::fmi::v2::error::Error;
use crate::fmi::v2::phase::{Call, Phase};
use crate::variables::{Causality, Variability, Variable};

impl<M: Model> Instance<M> {
    /// Reads variables. Before the simulation, outputs are those that initialization would give.
    ///
    /// # Errors
    /// If a reference is unknown, a variable cannot be read as `T`, an output is asked for while the parameters do not
    /// go together, or the outputs of the finished step have no values.
    pub fn get<T: Scalar>(&mut self, references: &[u32], values: &mut [T]) -> Result<(), Error> {
        self.permit(T::GET)?;
        let is_output = |reference: &u32| {
            lookup(self.table.variables(), *reference).is_ok_and(|variable| variable.causality == Causality::Output)
        };
        if self.now.phase.precedes_simulation() && references.iter().any(is_output) {
            self.initialize()?;
        }
        let (variables, now) = (self.table.variables(), &mut self.now);
        for (reference, value) in references.iter().zip(values) {
            let variable = lookup(variables, *reference)?;
            if variable.on_demand {
                now.observe()?;
            }
            *value = T::read(variable, &now.data).ok_or_else(|| values::mismatch(variable, T::TYPES))?;
        }
        Ok(())
    }

    /// Sets parameters and inputs: all of them, or none if one is refused.
    ///
    /// # Errors
    /// If a reference is unknown, a variable cannot be set (now, or at all, or as `T`), or a value is
    /// not admissible.
    pub fn set<T: Scalar>(&mut self, references: &[u32], values: &[T]) -> Result<(), Error> {
        self.permit(T::SET)?;
        let (variables, phase) = (self.table.variables(), self.now.phase);
        let Snapshot { data, retuned, .. } = &mut self.now;
        for (reference, value) in references.iter().zip(values) {
            let variable = lookup(variables, *reference)?;
            if !settable(variable, phase) {
                return Err(not_settable(variable));
            }
            if !value.fits(variable, data) {
                return Err(value.refusal(variable, data));
            }
        }
        for (reference, value) in references.iter().zip(values) {
            let variable = lookup(variables, *reference)?;
            *retuned |= variable.causality == Causality::Parameter;
            value.assign(variable, data);
        }
        if self.now.phase.precedes_simulation() && !references.is_empty() {
            self.now.model = None;
        }
        Ok(())
    }

    /// Answers a call that reads or writes text: there are no variables of type String.
    ///
    /// # Errors
    /// If there is any reference.
    pub fn no_text(&self, call: Call, references: &[u32]) -> Result<(), Error> {
        self.permit(call)?;
        references.iter().try_for_each(|reference| {
            let variable = lookup(self.table.variables(), *reference)?;
            Err(values::mismatch(variable, "String"))
        })
    }
}

/// The variable with this value reference.
#[inline]
pub(super) fn lookup<D>(variables: &[Variable<D>], reference: u32) -> Result<&Variable<D>, Error> {
    match usize::try_from(reference).ok().and_then(|position| variables.get(position)) {
        Some(variable) => Ok(variable),
        None => Err(Error::UnknownReference { reference, count: variables.len() }),
    }
}

/// Whether causality and variability of a variable allow that it is set in `state`.
#[inline]
fn settable<D>(variable: &Variable<D>, phase: Phase) -> bool {
    // Inputs first: they are set most often.
    variable.causality == Causality::Input
        || variable.causality == Causality::Parameter
            && (variable.variability != Variability::Fixed || phase.precedes_simulation())
}

/// Why it is not [`settable`].
#[cold]
fn not_settable<D>(variable: &Variable<D>) -> Error {
    let name = variable.name.clone();
    match variable.causality {
        Causality::Output => Error::ReadOnly { name, role: "an output" },
        Causality::Independent => Error::ReadOnly { name, role: "the independent variable" },
        Causality::Parameter | Causality::Input => Error::Fixed { name },
    }
}
