//! The C interface for any model: arguments become references, errors become a status and a message.
//!
//! [`export_fmi2!`](crate::export_fmi2) gives these functions their names in C.
//!
//! # Safety
//!
//! For all functions: handles are null or come from [`instantiate`] of the same model and are not freed;
//! no two threads use one instance at a time; pointers are null or good for what the standard says of
//! them, lists for the number of elements that goes with them, texts up to their terminating zero.
#![allow(clippy::missing_safety_doc, reason = "the same for all, said once above")]

use std::borrow::Cow;

use super::arguments;
use super::c_types::{self as c, Boolean, Component as Handle, Status, ValueReference, status_kind};
use super::component::{self, Component};
use super::error::Error;
use super::instance::{Instance, Scalar};
use super::logger::{Category, Logger};
use super::phase::{Call, Phase};
use crate::fmi::environment::Host;
use crate::fmi::identity::Identity;
use crate::fmi::model::Model;
use crate::fmi::panics;

mod derivatives;
mod states;

pub use derivatives::{get_real_output_derivatives, set_real_input_derivatives};
pub use states::{
    deserialize_fmu_state, free_fmu_state, get_fmu_state, serialize_fmu_state, serialized_fmu_state_size, set_fmu_state,
};

/// `fmi2GetTypesPlatform`.
#[must_use]
pub fn types_platform() -> c::Text {
    c"default".as_ptr()
}

/// `fmi2GetVersion`.
#[must_use]
pub fn version() -> c::Text {
    c"2.0".as_ptr()
}

/// `fmi2Instantiate`: null, and a message if there are callbacks, unless the name is given, the type is
/// co-simulation and the GUID is that of a unit of the model. Resources are needed only if its start values are
/// not the library's own, and are found beside the library, too. An empty name does no harm: the model's identifier
/// stands in for it.
pub unsafe fn instantiate<M: Model>(
    name: c::Text,
    fmu_type: c::FmuType,
    guid: c::Text,
    resources: c::Text,
    callbacks: *const c::CallbackFunctions,
    logging_on: Boolean,
) -> Handle {
    panics::silence();
    let host = Host::leave();
    // SAFETY: promised by the caller.
    let (name, guid) = unsafe { (arguments::text("instanceName", name), arguments::text("fmuGUID", guid)) };
    // SAFETY: promised by the caller.
    let resources = unsafe { arguments::text("fmuResourceLocation", resources) }.ok();
    // SAFETY: promised by the caller.
    let callbacks = unsafe { arguments::copy("functions", callbacks) }.ok();
    let known_as = name.as_deref().ok().filter(|name| !name.is_empty()).unwrap_or(M::IDENTIFIER);
    let logger = Logger::new(callbacks.as_ref(), known_as, logging_on.holds());

    let instance =
        panics::caught(&host, || new_instance::<M>(name.as_ref(), fmu_type, guid.as_ref(), resources.as_deref()));
    match instance.map_err(Error::Panic).flatten() {
        Ok(instance) => {
            if known_as != name.as_deref().unwrap_or_default() {
                let name = M::IDENTIFIER;
                logger.log(
                    &host,
                    Category::StatusWarning,
                    format_args!("instanceName is empty; messages come from {name}"),
                );
            }
            Component::into_handle(logger, instance)
        }
        Err(error) => {
            logger.log(&host, Category::StatusError, format_args!("fmi2Instantiate: {error}"));
            std::ptr::null_mut()
        }
    }
}

fn new_instance<M: Model>(
    name: Result<&Cow<str>, &Error>,
    fmu_type: c::FmuType,
    guid: Result<&Cow<str>, &Error>,
    resources: Option<&str>,
) -> Result<Instance<M>, Error> {
    name.map_err(Error::clone)?;
    if fmu_type != c::CO_SIMULATION {
        return Err(Error::Argument {
            argument: "fmuType",
            expected: format!("{} (co-simulation)", c::CO_SIMULATION),
            found: fmu_type.to_string(),
        });
    }
    Ok(Instance::new(Identity::find(guid.map_err(Error::clone)?, resources)?))
}

/// `fmi2FreeInstance`: does nothing if the handle is null.
pub unsafe fn free_instance<M: Model>(handle: Handle) {
    // SAFETY: promised by the caller.
    unsafe { Component::<M>::free(handle) }
}

/// `fmi2SetDebugLogging`: no categories stand for all of them; those that are unknown are passed over.
pub unsafe fn set_debug_logging<M: Model>(
    handle: Handle,
    on: Boolean,
    count: c::Size,
    categories: *const c::Text,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::switch_logging::<M>(handle, |logger, host| {
            let categories = arguments::list("categories", categories, count)?;
            let names: Vec<_> = categories.iter().map(|name| arguments::text("categories", *name).ok()).collect();
            logger.switch(host, on.holds(), &names);
            Ok(())
        })
    }
}

/// `fmi2SetupExperiment`: the tolerance is ignored.
pub unsafe fn setup_experiment<M: Model>(
    handle: Handle,
    start_time: c::Real,
    stop_time_defined: Boolean,
    stop_time: c::Real,
) -> Status {
    let stop_time = stop_time_defined.holds().then_some(stop_time);
    // SAFETY: promised by the caller.
    unsafe { component::call::<M>(handle, Call::SetupExperiment, move |i| i.setup_experiment(start_time, stop_time)) }
}

/// `fmi2EnterInitializationMode`.
pub unsafe fn enter_initialization_mode<M: Model>(handle: Handle) -> Status {
    // SAFETY: promised by the caller.
    unsafe { component::call::<M>(handle, Call::EnterInitializationMode, Instance::enter_initialization) }
}

/// `fmi2ExitInitializationMode`.
pub unsafe fn exit_initialization_mode<M: Model>(handle: Handle) -> Status {
    // SAFETY: promised by the caller.
    unsafe { component::milestone::<M>(handle, Call::ExitInitializationMode, Instance::exit_initialization) }
}

/// `fmi2Terminate`.
pub unsafe fn terminate<M: Model>(handle: Handle) -> Status {
    // SAFETY: promised by the caller.
    unsafe { component::milestone::<M>(handle, Call::Terminate, Instance::terminate) }
}

/// `fmi2Reset`.
pub unsafe fn reset<M: Model>(handle: Handle) -> Status {
    let body = |instance: &mut Instance<M>| {
        instance.reset();
        Ok(())
    };
    // SAFETY: promised by the caller.
    unsafe { component::milestone::<M>(handle, Call::Reset, body) }
}

/// `fmi2GetReal`, `fmi2GetInteger`, `fmi2GetBoolean`.
pub unsafe fn get<M: Model, T: Scalar>(
    handle: Handle,
    references: *const ValueReference,
    count: c::Size,
    values: *mut T,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::call::<M>(handle, T::GET, move |instance| {
            let references = arguments::list("vr", references, count)?;
            instance.get(references, arguments::list_mut("value", values, count)?)
        })
    }
}

/// `fmi2SetReal`, `fmi2SetInteger`, `fmi2SetBoolean`.
pub unsafe fn set<M: Model, T: Scalar>(
    handle: Handle,
    references: *const ValueReference,
    count: c::Size,
    values: *const T,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::call::<M>(handle, T::SET, move |instance| {
            let references = arguments::list("vr", references, count)?;
            instance.set(references, arguments::list("value", values, count)?)
        })
    }
}

/// `fmi2GetString`, `fmi2SetString`: there are no variables of this type.
pub unsafe fn text<M: Model>(handle: Handle, call: Call, references: *const ValueReference, count: c::Size) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::call::<M>(handle, call, move |instance| {
            instance.no_text(call, arguments::list("vr", references, count)?)
        })
    }
}

/// `fmi2DoStep`: the host's promise not to go back is ignored, as hosts give it and go back.
pub unsafe fn do_step<M: Model>(handle: Handle, from: c::Real, size: c::Real) -> Status {
    // SAFETY: promised by the caller.
    unsafe { component::call::<M>(handle, Call::DoStep, move |instance| instance.do_step(from, size)) }
}

/// `fmi2GetStatus`: the result of the last step.
pub unsafe fn get_status<M: Model>(handle: Handle, kind: c::StatusKind, value: *mut Status) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        answer::<M, _>(handle, Call::GetStatus, (kind, status_kind::DO_STEP_STATUS), value, |instance| {
            if instance.phase() == Phase::Failed { Status::Error } else { Status::Ok }
        })
    }
}

/// `fmi2GetRealStatus`: the end of the last step that went well.
pub unsafe fn get_real_status<M: Model>(handle: Handle, kind: c::StatusKind, value: *mut c::Real) -> Status {
    let kinds = (kind, status_kind::LAST_SUCCESSFUL_TIME);
    // SAFETY: promised by the caller.
    unsafe { answer::<M, _>(handle, Call::GetRealStatus, kinds, value, |instance| instance.time()) }
}

/// `fmi2GetIntegerStatus`: the standard has no status of this type.
pub unsafe fn get_integer_status<M: Model>(handle: Handle, kind: c::StatusKind) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::call::<M>(handle, Call::GetIntegerStatus, move |instance| {
            instance.permit(Call::GetIntegerStatus)?;
            Err(Error::Argument {
                argument: "the kind of status",
                expected: "asked for by a function of another type".to_owned(),
                found: kind.to_string(),
            })
        })
    }
}

/// `fmi2GetBooleanStatus`: never does a unit want to end the simulation.
pub unsafe fn get_boolean_status<M: Model>(handle: Handle, kind: c::StatusKind, value: *mut Boolean) -> Status {
    let kinds = (kind, status_kind::TERMINATED);
    // SAFETY: promised by the caller.
    unsafe { answer::<M, _>(handle, Call::GetBooleanStatus, kinds, value, |_| Boolean::FALSE) }
}

/// `fmi2GetStringStatus`: no step is ever pending.
pub unsafe fn get_string_status<M: Model>(handle: Handle, kind: c::StatusKind, value: *mut c::Text) -> Status {
    let kinds = (kind, status_kind::PENDING_STATUS);
    // SAFETY: promised by the caller.
    unsafe { answer::<M, _>(handle, Call::GetStringStatus, kinds, value, |_| c"".as_ptr()) }
}

/// Writes a status to `place` if the kind that is asked for is the one that has this type.
unsafe fn answer<M: Model, T>(
    handle: Handle,
    call: Call,
    (asked, served): (c::StatusKind, c::StatusKind),
    place: *mut T,
    status: impl Fn(&Instance<M>) -> T,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe {
        component::call::<M>(handle, call, move |instance| {
            instance.permit(call)?;
            if asked != served {
                return Err(Error::Argument {
                    argument: "the kind of status",
                    expected: served.to_string(),
                    found: asked.to_string(),
                });
            }
            *arguments::place("value", place)? = status(instance);
            Ok(())
        })
    }
}

/// Any function of the standard that belongs to a capability which the unit does not declare.
pub unsafe fn not_offered<M: Model>(handle: Handle, call: Call, flag: &'static str, value: &'static str) -> Status {
    // SAFETY: promised by the caller.
    unsafe { component::call::<M>(handle, call, move |_| Err(Error::NotOffered { flag, value })) }
}

/// Any function of model exchange: never allowed.
pub unsafe fn model_exchange<M: Model>(handle: Handle, call: Call) -> Status {
    // SAFETY: promised by the caller.
    unsafe { component::call::<M>(handle, call, move |_| Err(Error::ModelExchange)) }
}

#[cfg(test)]
mod tests;
