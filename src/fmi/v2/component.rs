//! What hides behind the host's handle, and the one way from a C call into an instance.

use super::c_types::{Component as Handle, Status};
use super::error::Error;
use super::instance::Instance;
use super::logger::{Category, Logger};
use super::phase::Call;
use super::states;
use crate::fmi::environment::Host;
use crate::fmi::hash::fnv1a;
use crate::fmi::model::Model;
use crate::fmi::panics;

/// An instance and its way to the host's log.
///
/// Both are always reached through raw pointers to the single fields: a host may call functions of the
/// same instance from within its logger.
#[repr(C)]
pub struct Component<M: Model> {
    /// [`Component::MAGIC`] while the component lives.
    magic: u64,
    logger: Logger,
    instance: Instance<M>,
}

impl<M: Model> Component<M> {
    /// Marks memory that holds a component of this model, and not that of another library.
    const MAGIC: u64 = fnv1a(M::IDENTIFIER.as_bytes());

    /// A component in a place of its own; it lives until [`Component::free`].
    pub fn into_handle(logger: Logger, instance: Instance<M>) -> Handle {
        Box::into_raw(Box::new(Self { magic: Self::MAGIC, logger, instance })).cast()
    }

    /// The component behind a handle; `None` if the handle is null or, as far as can be seen, none.
    ///
    /// # Safety
    /// A handle that is neither null nor misaligned must point to readable memory.
    unsafe fn find(handle: Handle) -> Option<*mut Self> {
        let this: *mut Self = handle.cast();
        if this.is_null() || !this.is_aligned() {
            return None;
        }
        // SAFETY: readable by the caller's promise.
        let magic = unsafe { (&raw const (*this).magic).read_volatile() };
        (magic == Self::MAGIC).then_some(this)
    }

    /// Ends the life of a component and of the states that it gave out; anything else is left alone.
    ///
    /// # Safety
    /// Like [`call`]; the handle must not be used again.
    pub unsafe fn free(handle: Handle) {
        // SAFETY: promised by the caller.
        let Some(this) = (unsafe { Self::find(handle) }) else { return };
        // Nobody can do anything about a destructor that panics.
        let _ = panics::caught(&Host::leave(), || {
            states::free_all(handle.addr());
            // SAFETY: alive, as its mark says, and made by `into_handle`. The mark is removed by a write
            // that cannot be optimised away, so that most uses after this are noticed.
            unsafe {
                (&raw mut (*this).magic).write_volatile(0);
                drop(Box::from_raw(this));
            }
        });
    }
}

/// Calls `body` with the instance behind the handle. An error, or a panic, is logged with the name of
/// the call and becomes `fmi2Error`; after a panic the instance has failed. A handle that is none is
/// `fmi2Error` too, without a message, for there is nobody to tell.
///
/// # Safety
/// The handle must be null or come from `fmi2Instantiate` of this model and not be freed; no other
/// thread may use it during the call.
#[inline]
pub unsafe fn call<M: Model>(
    handle: Handle,
    call: Call,
    mut body: impl FnMut(&mut Instance<M>) -> Result<(), Error>,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe { run(handle, call, false, &mut body) }
}

/// Like [`call`], and the host hears of a success in the category of events.
///
/// # Safety
/// Like [`call`].
#[inline]
pub unsafe fn milestone<M: Model>(
    handle: Handle,
    call: Call,
    mut body: impl FnMut(&mut Instance<M>) -> Result<(), Error>,
) -> Status {
    // SAFETY: promised by the caller.
    unsafe { run(handle, call, true, &mut body) }
}

/// The one way of all calls with an instance, from the host's floating-point environment and back.
///
/// It is behind an address for the sake of size, and because the compiler does not know of environments: it might
/// compute with numbers that the host hands over in registers before its own is in force.
///
/// # Safety
/// Like [`call`].
#[inline(never)]
unsafe fn run<M: Model>(
    handle: Handle,
    call: Call,
    is_milestone: bool,
    body: &mut dyn FnMut(&mut Instance<M>) -> Result<(), Error>,
) -> Status {
    // SAFETY: promised by the caller.
    let Some(this) = (unsafe { Component::<M>::find(handle) }) else { return Status::Error };
    let host = Host::leave();
    // SAFETY: alive, and only this call uses the instance until `body` returns. Errors are long, and most calls have none:
    // in a box, nothing is copied.
    let outcome = panics::caught(&host, || body(unsafe { &mut (*this).instance }).map_err(Box::new));
    if !is_milestone && matches!(outcome, Ok(Ok(()))) {
        return Status::Ok;
    }
    // SAFETY: alive.
    unsafe { conclude(this, &host, call, outcome) }
}

/// What becomes of an instance that has panicked, and what the host is told in the end.
///
/// # Safety
/// The component must be alive.
#[cold]
#[inline(never)]
unsafe fn conclude<M: Model>(
    this: *mut Component<M>,
    host: &Host,
    call: Call,
    outcome: Result<Result<(), Box<Error>>, String>,
) -> Status {
    // SAFETY: alive; loggers change in `switch_logging` only. The instance is free for what the host calls from its
    // logger.
    let (logger, time) = unsafe {
        if outcome.is_err() {
            (*this).instance.fail();
        }
        (&(*this).logger, (*this).instance.time())
    };
    match outcome.map_err(|message| Box::new(Error::Panic(message))).flatten() {
        Ok(()) => {
            logger.log(host, Category::Events, format_args!("{call} at t = {time} s"));
            Status::Ok
        }
        Err(error) => refuse(logger, host, call, &error),
    }
}

/// Calls `body` with the logger of the instance; otherwise like [`call`].
///
/// # Safety
/// Like [`call`].
pub unsafe fn switch_logging<M: Model>(
    handle: Handle,
    body: impl FnOnce(&mut Logger, &Host) -> Result<(), Error>,
) -> Status {
    // SAFETY: promised by the caller.
    let Some(this) = (unsafe { Component::<M>::find(handle) }) else { return Status::Error };
    let host = Host::leave();
    // SAFETY: alive, and only this call uses the logger until `body` returns.
    let outcome = panics::caught(&host, || body(unsafe { &mut (*this).logger }, &host));
    // SAFETY: alive.
    let logger = unsafe { &(*this).logger };
    match outcome.map_err(Error::Panic).flatten() {
        Ok(()) => Status::Ok,
        Err(error) => refuse(logger, &host, Call::SetDebugLogging, &error),
    }
}

fn refuse(logger: &Logger, host: &Host, call: Call, error: &Error) -> Status {
    logger.log(host, Category::StatusError, format_args!("{call}: {error}"));
    Status::Error
}
