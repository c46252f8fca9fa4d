//! The exported functions, called as a host calls them: through declarations of its own.

use std::cell::Cell;
use std::ffi::{CStr, CString, c_char, c_int, c_uint, c_void};
use std::ptr::{null, null_mut};

use crate::fmi::Identity;
use crate::fmi::v2::phase::{Call, Phase};
use crate::fmi::v2::toy::{Size, Toy, vr};
use host::{ERROR, Host, OK, TRUE};

mod allocation;
mod derivatives;
mod environment;
mod host;
mod misuse;
mod modes;
mod states;

crate::export_fmi2!(Toy);

#[rustfmt::skip]
#[allow(non_snake_case)]
unsafe extern "C" {
    fn fmi2GetTypesPlatform() -> *const c_char;
    fn fmi2GetVersion() -> *const c_char;
    fn fmi2Instantiate(name: *const c_char, fmu_type: c_int, guid: *const c_char, resources: *const c_char,
        callbacks: *const host::Callbacks, visible: c_int, logging_on: c_int) -> *mut c_void;
    fn fmi2FreeInstance(c: *mut c_void);
    fn fmi2SetDebugLogging(c: *mut c_void, on: c_int, n: usize, categories: *const *const c_char) -> c_int;
    fn fmi2SetupExperiment(c: *mut c_void, tolerance_defined: c_int, tolerance: f64, start: f64, stop_defined: c_int, stop: f64) -> c_int;
    fn fmi2EnterInitializationMode(c: *mut c_void) -> c_int;
    fn fmi2ExitInitializationMode(c: *mut c_void) -> c_int;
    fn fmi2Terminate(c: *mut c_void) -> c_int;
    fn fmi2Reset(c: *mut c_void) -> c_int;
    fn fmi2GetReal(c: *mut c_void, vr: *const c_uint, n: usize, values: *mut f64) -> c_int;
    fn fmi2GetInteger(c: *mut c_void, vr: *const c_uint, n: usize, values: *mut c_int) -> c_int;
    fn fmi2GetBoolean(c: *mut c_void, vr: *const c_uint, n: usize, values: *mut c_int) -> c_int;
    fn fmi2GetString(c: *mut c_void, vr: *const c_uint, n: usize, values: *mut *const c_char) -> c_int;
    fn fmi2SetReal(c: *mut c_void, vr: *const c_uint, n: usize, values: *const f64) -> c_int;
    fn fmi2SetInteger(c: *mut c_void, vr: *const c_uint, n: usize, values: *const c_int) -> c_int;
    fn fmi2SetBoolean(c: *mut c_void, vr: *const c_uint, n: usize, values: *const c_int) -> c_int;
    fn fmi2SetString(c: *mut c_void, vr: *const c_uint, n: usize, values: *const *const c_char) -> c_int;
    fn fmi2DoStep(c: *mut c_void, from: f64, size: f64, never_back: c_int) -> c_int;
    fn fmi2CancelStep(c: *mut c_void) -> c_int;
    fn fmi2GetStatus(c: *mut c_void, kind: c_int, value: *mut c_int) -> c_int;
    fn fmi2GetRealStatus(c: *mut c_void, kind: c_int, value: *mut f64) -> c_int;
    fn fmi2GetIntegerStatus(c: *mut c_void, kind: c_int, value: *mut c_int) -> c_int;
    fn fmi2GetBooleanStatus(c: *mut c_void, kind: c_int, value: *mut c_int) -> c_int;
    fn fmi2GetStringStatus(c: *mut c_void, kind: c_int, value: *mut *const c_char) -> c_int;
    fn fmi2SetRealInputDerivatives(c: *mut c_void, vr: *const c_uint, n: usize, orders: *const c_int, values: *const f64) -> c_int;
    fn fmi2GetRealOutputDerivatives(c: *mut c_void, vr: *const c_uint, n: usize, orders: *const c_int, values: *mut f64) -> c_int;
    fn fmi2GetDirectionalDerivative(c: *mut c_void, unknowns: *const c_uint, nu: usize, knowns: *const c_uint, nk: usize, seed: *const f64, values: *mut f64) -> c_int;
    fn fmi2GetFMUstate(c: *mut c_void, state: *mut *mut c_void) -> c_int;
    fn fmi2SetFMUstate(c: *mut c_void, state: *mut c_void) -> c_int;
    fn fmi2FreeFMUstate(c: *mut c_void, state: *mut *mut c_void) -> c_int;
    fn fmi2SerializedFMUstateSize(c: *mut c_void, state: *mut c_void, size: *mut usize) -> c_int;
    fn fmi2SerializeFMUstate(c: *mut c_void, state: *mut c_void, bytes: *mut c_char, size: usize) -> c_int;
    fn fmi2DeSerializeFMUstate(c: *mut c_void, bytes: *const c_char, size: usize, state: *mut *mut c_void) -> c_int;
    fn fmi2EnterEventMode(c: *mut c_void) -> c_int;
    fn fmi2NewDiscreteStates(c: *mut c_void, info: *mut c_void) -> c_int;
    fn fmi2EnterContinuousTimeMode(c: *mut c_void) -> c_int;
    fn fmi2CompletedIntegratorStep(c: *mut c_void, never_back: c_int, event: *mut c_int, terminate: *mut c_int) -> c_int;
    fn fmi2SetTime(c: *mut c_void, time: f64) -> c_int;
    fn fmi2SetContinuousStates(c: *mut c_void, x: *const f64, n: usize) -> c_int;
    fn fmi2GetDerivatives(c: *mut c_void, derivatives: *mut f64, n: usize) -> c_int;
    fn fmi2GetEventIndicators(c: *mut c_void, indicators: *mut f64, n: usize) -> c_int;
    fn fmi2GetContinuousStates(c: *mut c_void, x: *mut f64, n: usize) -> c_int;
    fn fmi2GetNominalsOfContinuousStates(c: *mut c_void, nominals: *mut f64, n: usize) -> c_int;
}

#[test]
fn the_interface_says_what_it_is() {
    // SAFETY: both return static texts.
    unsafe {
        assert_eq!(CStr::from_ptr(fmi2GetTypesPlatform()), c"default");
        assert_eq!(CStr::from_ptr(fmi2GetVersion()), c"2.0");
    }
}

#[test]
fn a_host_can_simulate() {
    let host = Host::new();
    let toy = host.running();
    assert_eq!(toy.set_real(&[vr::RATE, vr::LEAK], &[2.0, 0.0]), OK);
    for n in 0..10 {
        assert_eq!(toy.step(f64::from(n) * 0.1, 0.1), OK);
    }
    assert!((toy.real(vr::POSITION) - 3.0).abs() < 1e-12);
    assert!((toy.real(vr::TIME) - 1.0).abs() < 1e-12);
    assert_eq!(host.messages(), []);
}

#[test]
fn instances_do_not_know_of_each_other() {
    let host = Host::new();
    let (fast, slow) = (host.running(), host.running());
    fast.set_real(&[vr::RATE], &[2.0]);
    slow.set_real(&[vr::RATE], &[1.0]);
    for (toy, from) in [(&fast, 0.0), (&slow, 0.0), (&slow, 1.0), (&fast, 1.0)] {
        assert_eq!(toy.step(from, 1.0), OK);
    }
    assert_eq!((fast.real(vr::POSITION), slow.real(vr::POSITION)), (5.0, 3.0));
}

#[test]
fn many_threads_simulate_at_a_time() {
    std::thread::scope(|scope| {
        for rate in 0..8 {
            scope.spawn(move || {
                let host = Host::new();
                let toy = host.running();
                toy.set_real(&[vr::RATE], &[f64::from(rate)]);
                for n in 0..200 {
                    assert_eq!(toy.step(f64::from(n), 1.0), OK);
                }
                assert_eq!(toy.real(vr::POSITION), 1.0 + 200.0 * f64::from(rate));
            });
        }
    });
}

#[test]
fn a_panic_is_an_error_of_that_instance_only() {
    let host = Host::new();
    let (bad, good) = (host.running(), host.running());
    bad.set_real(&[vr::FAULT], &[3.0]);
    assert_eq!(bad.step(0.0, 1.0), ERROR);
    let message = host.last();
    assert_eq!(message.text, "fmi2DoStep: internal error: told to panic: 100 % ##1");
    assert_eq!(message.format, "%s");
    assert_eq!((message.status, message.category.as_str()), (ERROR, "logStatusError"));

    assert_eq!(bad.step(0.0, 1.0), ERROR);
    assert_eq!(bad.real(vr::FAULT), 3.0);
    assert_eq!(good.step(0.0, 1.0), OK);
    assert_eq!(bad.reset(), OK);
    bad.initialize();
    assert_eq!(bad.step(0.0, 1.0), OK);
}

#[test]
fn messages_without_a_percent_sign_are_their_own_format() {
    let host = Host::new();
    let toy = host.running();
    assert_eq!(toy.set_real(&[vr::RATE], &[f64::NAN]), ERROR);
    let message = host.last();
    assert_eq!(message.text, "fmi2SetReal: rate must be a finite number, but is NaN");
    assert_eq!(message.format, message.text);
    assert_eq!(message.instance, "toy instance");
}

#[test]
fn the_host_decides_what_it_hears() {
    let host = Host::new();
    let toy = host.instantiate();
    let switch = |on: c_int, names: &[&CStr]| {
        let names: Vec<_> = names.iter().map(|name| name.as_ptr()).collect();
        // SAFETY: texts and list outlive the call.
        unsafe { fmi2SetDebugLogging(toy.handle, on, names.len(), names.as_ptr()) }
    };
    let heard = || {
        host.clear();
        toy.reset();
        toy.step(0.0, 1.0);
        host.messages().iter().map(|message| message.category.clone()).collect::<Vec<_>>()
    };
    assert_eq!(heard(), ["logStatusError"], "errors are no debug messages");
    assert_eq!(switch(TRUE, &[c"logEvents", c"logSingularLinearSystems"]), OK);
    assert_eq!(heard(), ["logEvents", "logStatusError"]);
    assert_eq!(switch(0, &[c"logStatusError"]), OK);
    assert_eq!(heard(), ["logEvents"]);
    assert_eq!(switch(TRUE, &[c"logAll"]), OK);
    assert_eq!(heard(), ["logEvents", "logStatusError"]);

    // SAFETY: no categories are allowed to be null.
    assert_eq!(unsafe { fmi2SetDebugLogging(toy.handle, 0, 0, null()) }, OK);
    assert_eq!(heard(), [""; 0]);
    // SAFETY: as above.
    assert_eq!(unsafe { fmi2SetDebugLogging(toy.handle, TRUE, 0, null()) }, OK);
    assert_eq!(heard(), ["logEvents", "logStatusError"]);
}

/// What a host would like to hear of is no reason to end a simulation.
#[test]
fn categories_that_are_unknown_or_null_are_passed_over() {
    let host = Host::new();
    let toy = host.instantiate();
    let switch = |on: c_int, names: &[*const c_char]| {
        host.clear();
        // SAFETY: texts and list outlive the call.
        assert_eq!(unsafe { fmi2SetDebugLogging(toy.handle, on, names.len(), names.as_ptr()) }, OK);
        host.messages().iter().map(|message| (message.category.clone(), message.text.clone())).collect::<Vec<_>>()
    };
    // Warnings are off: nothing is said, and nothing else is switched on.
    assert_eq!(switch(TRUE, &[c"logEverything".as_ptr(), null()]), []);
    assert_eq!(switch(TRUE, &[c"".as_ptr()]), []);
    // What is known beside it is switched.
    let said = switch(TRUE, &[c"logEverything".as_ptr(), null(), c"logAll".as_ptr()]);
    assert_eq!(said.len(), 2, "{said:?}");
    for ((category, text), word) in said.iter().zip(["\"logEverything\"", "NULL"]) {
        assert_eq!(category, "logStatusWarning");
        assert!(text.starts_with("fmi2SetDebugLogging") && text.contains("logEvents") && text.contains(word), "{text}");
    }
    assert_eq!(switch(0, &[c"logAll".as_ptr(), c"\xff".as_ptr()]), []);
    toy.reset();
    assert!(host.messages().is_empty());
}

#[test]
fn a_logger_may_call_back() {
    extern "C" fn look(toy: *mut c_void, _: *const c_char, _: c_int, _: *const c_char, _: *const c_char) {
        // SAFETY: the environment points to the handle of the instance that logs.
        unsafe {
            let handle = (*toy.cast::<Cell<*mut c_void>>()).get();
            let mut value = 0.0;
            if !handle.is_null() {
                assert_eq!(fmi2GetReal(handle, &vr::GAIN, 1, &raw mut value), OK);
                assert_eq!(value, 1.0);
            }
        }
    }
    let handle = Cell::new(null_mut());
    let callbacks = host::Callbacks::new(look as *const c_void, (&raw const handle).cast_mut().cast());
    let guid = host::guid();
    // SAFETY: all texts outlive the call.
    unsafe {
        let toy = fmi2Instantiate(c"caller".as_ptr(), 1, guid.as_ptr(), null(), &raw const callbacks, 0, 1);
        handle.set(toy);
        assert_eq!(fmi2DoStep(toy, 0.0, 1.0, 0), ERROR);
        assert_eq!(fmi2Reset(toy), OK);
        fmi2FreeInstance(toy);
    }
}

#[test]
fn status_functions_answer_truthfully() {
    let host = Host::new();
    let toy = host.running();
    toy.step(0.0, 0.5);
    let (mut status, mut time, mut truth, mut text) = (-1, f64::NAN, -1, null());
    // SAFETY: all answers have a place.
    unsafe {
        assert_eq!(fmi2GetRealStatus(toy.handle, 2, &raw mut time), OK);
        assert_eq!(fmi2GetStatus(toy.handle, 0, &raw mut status), OK);
        assert_eq!(fmi2GetBooleanStatus(toy.handle, 3, &raw mut truth), OK);
        assert_eq!(fmi2GetStringStatus(toy.handle, 1, &raw mut text), OK);
        assert_eq!((time, status, truth, CStr::from_ptr(text)), (0.5, OK, 0, c""));

        toy.set_real(&[vr::FAULT], &[2.0]);
        toy.step(0.5, 0.5);
        assert_eq!(fmi2GetRealStatus(toy.handle, 2, &raw mut time), OK);
        assert_eq!(fmi2GetStatus(toy.handle, 0, &raw mut status), OK);
        assert_eq!((time, status), (0.5, ERROR));

        assert_eq!(fmi2GetRealStatus(toy.handle, 0, &raw mut time), ERROR);
        assert_eq!(fmi2GetRealStatus(toy.handle, 2, null_mut()), ERROR);
        assert_eq!(fmi2GetIntegerStatus(toy.handle, 99, &raw mut status), ERROR);
    }
}

/// `max` and `min` give either zero on different processors; hosts get the same from all of them.
#[test]
fn no_zero_has_a_sign() {
    let host = Host::new();
    let toy = host.running();
    toy.set_real(&[vr::LEAK], &[-0.0]);
    assert_eq!(toy.real(vr::LEAK).to_bits(), 0);
}
