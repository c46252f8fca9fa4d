//! The functions for derivatives with respect to time.

use super::{Handle, arguments, c};
use crate::fmi::model::Model;
use crate::fmi::v2::c_types::{Status, ValueReference};
use crate::fmi::v2::component;
use crate::fmi::v2::phase::Call;

/// `fmi2SetRealInputDerivatives`.
pub unsafe fn set_real_input_derivatives<M: Model>(
    handle: Handle,
    references: *const ValueReference,
    count: c::Size,
    orders: *const c::Integer,
    values: *const c::Real,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::call::<M>(handle, Call::SetRealInputDerivatives, move |instance| {
            let references = arguments::list("vr", references, count)?;
            let orders = arguments::list("order", orders, count)?;
            instance.set_input_derivatives(references, orders, arguments::list("value", values, count)?)
        })
    }
}

/// `fmi2GetRealOutputDerivatives`.
pub unsafe fn get_real_output_derivatives<M: Model>(
    handle: Handle,
    references: *const ValueReference,
    count: c::Size,
    orders: *const c::Integer,
    values: *mut c::Real,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::call::<M>(handle, Call::GetRealOutputDerivatives, move |instance| {
            let references = arguments::list("vr", references, count)?;
            let orders = arguments::list("order", orders, count)?;
            instance.output_derivatives(references, orders, arguments::list_mut("value", values, count)?)
        })
    }
}
