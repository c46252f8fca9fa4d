//! Connections by equal names.

use super::Unit;
use crate::variables::Causality;

/// An input or output of a unit, as far as connections depend on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Port<'a> {
    /// Structured public name.
    pub name: &'a str,
    /// Whether it is an input or an output.
    pub causality: Causality,
    /// Name of its type; only equal ones are connected.
    pub data_type: &'static str,
}

/// Connections from the outputs of one unit to the inputs of another that have the same name and type.
#[derive(Debug)]
pub struct Wires<A: Unit, B: Unit> {
    from: A::Selection,
    to: B::Selection,
    values: A::Values,
    count: usize,
}

impl<A: Unit, B: Unit<Values = A::Values, Error = A::Error>> Wires<A, B> {
    /// All connections from `from` to `to`.
    ///
    /// # Errors
    /// If a unit does not know its own variables.
    pub fn between(from: &A, to: &B) -> Result<Self, A::Error> {
        let inputs = to.ports();
        let has_input = |output: &Port<'_>| inputs.contains(&Port { causality: Causality::Input, ..*output });
        let outputs = from.ports().into_iter().filter(|port| port.causality == Causality::Output);
        let names: Vec<&str> = outputs.filter(has_input).map(|output| output.name).collect();
        // Same names and types in the same order: the values of one selection fit the other.
        let ((outputs, values), (inputs, _)) = (from.select(&names)?, to.select(&names)?);
        Ok(Self { from: outputs, to: inputs, values, count: names.len() })
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Hands all values over.
    ///
    /// # Errors
    /// If a unit refuses.
    #[inline]
    pub fn carry(&mut self, from: &mut A, to: &mut B) -> Result<(), A::Error> {
        if self.count == 0 {
            return Ok(());
        }
        from.read(&self.from, &mut self.values)?;
        to.write(&self.to, &self.values)
    }
}
