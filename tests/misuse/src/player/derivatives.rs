//! Derivatives of inputs and outputs, and those that no unit has.

use super::Player;
use crate::hostile::{integer, length, one_in, pointer, pointer_mut, real};

// SAFETY, for all calls: every pointer is null, misaligned or good for ROOM elements, and every length is at
// most ROOM or more than any memory has, which a unit must notice without reading.
impl Player<'_> {
    pub fn choose_derivatives(&mut self) -> usize {
        let count = self.choose_references(true);
        self.orders[..count].fill_with(|| if one_in(&mut self.rng, 3) { integer(&mut self.rng) } else { 1 });
        self.reals[..count].fill_with(|| real(&mut self.rng));
        count
    }

    pub fn set_input_derivatives(&mut self) -> Result<(), String> {
        let count = self.choose_derivatives();
        self.call("fmi2SetRealInputDerivatives", |p, c| {
            let (references, orders) =
                (pointer(&mut p.rng, p.references.as_ptr()), pointer(&mut p.rng, p.orders.as_ptr()));
            let (values, count) = (pointer(&mut p.rng, p.reals.as_ptr()), length(&mut p.rng, count));
            unsafe { p.unit.functions.set_input_derivatives(c, references, count, orders, values) }
        })
        .map(drop)
    }

    pub fn get_output_derivatives(&mut self) -> Result<(), String> {
        let count = self.choose_derivatives();
        self.call("fmi2GetRealOutputDerivatives", |p, c| {
            let (references, orders) =
                (pointer(&mut p.rng, p.references.as_ptr()), pointer(&mut p.rng, p.orders.as_ptr()));
            let (values, count) = (pointer_mut(&mut p.rng, p.reals.as_mut_ptr()), length(&mut p.rng, count));
            unsafe { p.unit.functions.get_output_derivatives(c, references, count, orders, values) }
        })
        .map(drop)
    }

    pub fn get_directional_derivative(&mut self) -> Result<(), String> {
        let count = self.choose_references(true);
        self.call("fmi2GetDirectionalDerivative", |p, c| {
            let (list, values) = (pointer(&mut p.rng, p.references.as_ptr()), p.reals.as_mut_ptr());
            let (unknowns, knowns) = (length(&mut p.rng, count), length(&mut p.rng, count));
            unsafe { p.unit.functions.get_directional_derivative(c, list, unknowns, list, knowns, values, values) }
        })
        .map(drop)
    }
}
