//! What a unit can do beyond the minimum of the standard: the flags of its model description.

use crate::variables::{Causality, Table};

/// The flags of the element `CoSimulation` that differ between units or say no.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Capabilities {
    /// `canInterpolateInputs`: some input takes derivatives.
    pub interpolates_inputs: bool,
    /// `maxOutputDerivativeOrder`: 1 if some output has a derivative.
    pub output_derivative_order: u32,
}

impl Capabilities {
    /// What a unit with these variables can do.
    #[must_use]
    pub fn of<D>(table: &Table<D>) -> Self {
        let some = |causality| {
            table.variables().iter().any(|variable| variable.causality == causality && variable.derivative.is_some())
        };
        Self {
            interpolates_inputs: some(Causality::Input),
            output_derivative_order: u32::from(some(Causality::Output)),
        }
    }

    /// All flags as attributes of `CoSimulation`, in the order of the standard's schema.
    ///
    /// State and serialization are there for every unit, as every [`Model`](crate::fmi::Model) can be saved.
    #[must_use]
    pub fn attributes(&self) -> [(&'static str, &'static str); 10] {
        [
            ("needsExecutionTool", NO),
            ("canHandleVariableCommunicationStepSize", YES),
            ("canInterpolateInputs", if self.interpolates_inputs { YES } else { NO }),
            ("maxOutputDerivativeOrder", if self.output_derivative_order == 0 { "0" } else { "1" }),
            ("canRunAsynchronuously", NO),
            ("canBeInstantiatedOnlyOncePerProcess", NO),
            ("canNotUseMemoryManagementFunctions", YES),
            ("canGetAndSetFMUstate", YES),
            ("canSerializeFMUstate", YES),
            ("providesDirectionalDerivative", NO),
        ]
    }
}

const YES: &str = "true";
const NO: &str = "false";
