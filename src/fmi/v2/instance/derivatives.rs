//! First derivatives of inputs and outputs with respect to time.

use super::Instance;
use super::access::lookup;
use crate::fmi::model::Model;
use crate::fmi::v2::capabilities::Capabilities;
use crate::fmi::v2::error::Error;
use crate::fmi::v2::phase::{Call, Phase};
use crate::variables::{Bounds, Derivative, Variable};

/// The highest order of derivatives.
const ORDER: i32 = 1;

impl<M: Model> Instance<M> {
    /// Gives derivatives of inputs for the next step: all of them, or none if one is refused.
    ///
    /// # Errors
    /// If the unit takes none, or not of this order of this variable, or a value is not finite.
    pub fn set_input_derivatives(&mut self, references: &[u32], orders: &[i32], values: &[f64]) -> Result<(), Error> {
        self.permit(Call::SetRealInputDerivatives)?;
        if !Capabilities::of(&self.table).interpolates_inputs {
            return Err(Error::NotOffered { flag: "canInterpolateInputs", value: "false" });
        }
        for ((reference, order), value) in references.iter().zip(orders).zip(values) {
            let variable = lookup(self.table.variables(), *reference)?;
            if !(takes_derivative(variable) && *order == ORDER) {
                return Err(none(variable, *order, "an input"));
            }
            if !value.is_finite() {
                let name = format!("the derivative of {}", variable.name);
                return Err(Error::OutOfBounds { name, expected: Bounds::ANY, found: *value });
            }
        }
        for (reference, value) in references.iter().zip(values) {
            let variable = lookup(self.table.variables(), *reference)?;
            if let Some(Derivative::Given(take, index)) = variable.derivative {
                take(&mut self.now.data, index, *value);
            }
        }
        Ok(())
    }

    /// Reads derivatives of outputs at the end of the finished step.
    ///
    /// # Errors
    /// If a variable has no derivative of this order, or it has no value at this instant.
    pub fn output_derivatives(&mut self, references: &[u32], orders: &[i32], values: &mut [f64]) -> Result<(), Error> {
        self.permit(Call::GetRealOutputDerivatives)?;
        self.now.observe()?;
        let elapsed = self.now.time - self.now.start_time;
        // After a failure nothing is computed any more.
        if let (Phase::Running | Phase::Terminated, Some(model)) = (self.now.phase, &self.now.model) {
            model.differentiate(&mut self.now.data, elapsed);
        }
        for ((reference, order), value) in references.iter().zip(orders).zip(values) {
            let variable = lookup(self.table.variables(), *reference)?;
            *value = match (variable.derivative, *order) {
                (Some(Derivative::Variable(position)), ORDER) => self.table.variables()[position].real(&self.now.data),
                (Some(Derivative::Read(read, index)), ORDER) => Some(read(&self.now.data, index)),
                _ => None,
            }
            .ok_or_else(|| none(variable, *order, "an output"))?;
            if !value.is_finite() {
                let reason = format!("the derivative of {} is {value}", variable.name);
                return Err(Error::Outputs { time: self.now.time, reason });
            }
        }
        Ok(())
    }
}

fn takes_derivative<D>(variable: &Variable<D>) -> bool {
    matches!(variable.derivative, Some(Derivative::Given(..)))
}

fn none<D>(variable: &Variable<D>, order: i32, role: &'static str) -> Error {
    Error::NoDerivative { name: variable.name.clone(), order, role }
}
